//! White glazed ceramic in soft light, by casting rays.
//!
//! Each pixel is seen through a grid of places. At each of them the light of an even sky is gathered by rays spread by
//! the cosine (ambient occlusion with the sky's colour), a large lamp throws soft shadows, and the glaze reflects both.

use std::f32::consts::TAU;

use azulejo::trace::Ray;
use azulejo::{Progress, Result};
use glam::{Vec2, Vec3};

use super::camera::Window;
use super::palette::{Colour, PAPER};
use super::rows;
use super::stage::{Seen, Stage};

/// Places per side of a pixel, and rays to the sky from each.
const GRID: usize = 4;
const SKY_RAYS: usize = 4;

/// The direction of the lamp and its width; its share of the light, and that of the sky.
const LAMP: Vec3 = Vec3::new(-0.48, 0.74, 0.47);
const LAMP_WIDTH: f32 = 0.22;
const LAMP_SHARE: f32 = 0.66;
const SKY_SHARE: f32 = 0.68;

/// The strength of the shadow that the object casts on the page below it, the distance from the object within which it
/// falls, and the outer part of the whole view in which it fades out: the page has no edge.
const SHADOW: f32 = 0.5;
const SHADOW_REACH: f32 = 1.1;
const FADE: f32 = 0.3;

/// Secondary rays start this far from the surface.
const OFFSET: f32 = 2e-4;

/// The whole object in a square picture of `side` pixels per side, row by row from the top.
pub fn square(stage: &Stage, side: usize, num_threads: usize, progress: &Progress) -> Result<Vec<Colour>> {
    let window = stage.camera.window_on(stage.positions(), 1.0, 0.04);
    render(stage, &window, &window, [side; 2], num_threads, progress)
}

/// The picture of a `window` inside of the `whole` view, row by row from the top.
pub(super) fn render(
    stage: &Stage,
    whole: &Window,
    window: &Window,
    [columns, rows]: [usize; 2],
    num_threads: usize,
    progress: &Progress,
) -> Result<Vec<Colour>> {
    let floor = stage.floor();
    let row = |row| Row { stage, whole, window, size: [columns, rows], row, floor }.render();
    Ok(rows::in_parallel(num_threads, rows, progress, row)?.concat())
}

/// One row of pixels in the making.
struct Row<'a> {
    stage: &'a Stage,
    whole: &'a Window,
    window: &'a Window,
    size: [usize; 2],
    row: usize,
    floor: f32,
}

/// A place to be lit, and its material.
struct Place {
    pixel: usize,
    /// The number of the place among those of its pixel, which share the directions of the sky.
    sample: usize,
    seen: Seen,
    ground: Ground,
}

#[derive(Clone, Copy)]
enum Ground {
    Glaze,
    Paint(Colour),
    /// The page; the shadow fades out with the distance.
    Page {
        shadow: f32,
    },
}

impl Row<'_> {
    fn render(&self) -> Vec<Colour> {
        let paper = linear(PAPER);
        let (places, empty) = self.places();
        let rays: Vec<_> = places.iter().flat_map(|place| self.light_rays(place)).collect();
        let met = self.stage.meet(&rays);
        let mut light: Vec<Vec3> = empty.iter().map(|&count| count as f32 * paper).collect();
        for ((place, rays), met) in places.iter().zip(rays.chunks(1 + SKY_RAYS)).zip(met.chunks(1 + SKY_RAYS)) {
            light[place.pixel] += self.light(place, rays, met);
        }
        light.iter().map(|&light| encoded(light / (GRID * GRID) as f32)).collect()
    }

    /// All places of the row that are to be lit, and for each pixel the number of its places that show only the page.
    fn places(&self) -> (Vec<Place>, Vec<usize>) {
        let samples = GRID * GRID;
        let rays: Vec<_> = (0..self.size[0] * samples).map(|i| self.camera_ray(i / samples, i % samples)).collect();
        let mut empty = vec![0; self.size[0]];
        let mut places = Vec::new();
        for (i, (ray, seen)) in rays.iter().zip(self.stage.look(&rays)).enumerate() {
            let (pixel, sample) = (i / samples, i % samples);
            if let Some(seen) = seen {
                let ground = self.stage.discs.paint(seen.point).map_or(Ground::Glaze, Ground::Paint);
                places.push(Place { pixel, sample, seen, ground });
            } else if let Some((point, shadow)) = self.page(ray) {
                places.push(Place {
                    pixel,
                    sample,
                    seen: Seen { point, normal: Vec3::Y },
                    ground: Ground::Page { shadow },
                });
            } else {
                empty[pixel] += 1;
            }
        }
        (places, empty)
    }

    fn camera_ray(&self, column: usize, sample: usize) -> Ray {
        let inside = |i: usize| (i as f32 + 0.5) / GRID as f32;
        let x = (column as f32 + inside(sample % GRID)) / self.size[0] as f32;
        let y = (self.row as f32 + inside(sample / GRID)) / self.size[1] as f32;
        let camera = &self.stage.camera;
        Ray { origin: camera.eye.to_array(), direction: camera.direction(self.window.at(x, y)).to_array() }
    }

    /// The point where a ray meets the floor near the object, and the largest strength of the shadow there.
    fn page(&self, ray: &Ray) -> Option<(Vec3, f32)> {
        let [origin, direction] = [ray.origin, ray.direction].map(Vec3::from);
        let t = (self.floor - origin.y) / direction.y;
        let point = origin + t * direction;
        let far = Vec2::new(point.x, point.z).length() / SHADOW_REACH;
        let seen_at = (self.stage.camera.project(point) - self.whole.centre).abs() / self.whole.half;
        let fade = (2.0 * (1.0 - far)).min((1.0 - seen_at.max_element()) / FADE).min(1.0);
        (t > 0.0 && fade > 0.0).then_some((point, SHADOW * fade * fade * (3.0 - 2.0 * fade)))
    }

    /// The ray to the lamp, then the rays to the sky.
    fn light_rays(&self, place: &Place) -> [Ray; 1 + SKY_RAYS] {
        let Seen { point, normal } = place.seen;
        let origin = (point + OFFSET * normal).to_array();
        let turn = scramble(self.row as u32, place.pixel as u32);
        std::array::from_fn(|i| {
            let direction = match i {
                0 => lamp_direction(spread(turn, place.sample)),
                _ => sky_direction(normal, spread(turn, place.sample * SKY_RAYS + i - 1)),
            };
            Ray { origin, direction: direction.to_array() }
        })
    }

    fn light(&self, place: &Place, rays: &[Ray], met: &[bool]) -> Vec3 {
        let Seen { point, normal } = place.seen;
        let lamp = if met[0] { 0.0 } else { normal.dot(LAMP.normalize()).max(0.0) };
        let sky = rays[1..].iter().zip(&met[1..]).filter(|(_, met)| !**met);
        let sky = sky.map(|(ray, _)| sky_light(Vec3::from(ray.direction).y)).sum::<f32>() / SKY_RAYS as f32;
        let body = match place.ground {
            Ground::Page { shadow } => {
                let open = met.iter().filter(|met| !**met).count() as f32 / met.len() as f32;
                return linear(PAPER) * (1.0 - shadow * (1.0 - open));
            }
            Ground::Glaze => Vec3::new(0.90, 0.905, 0.91),
            Ground::Paint(colour) => linear(colour),
        };
        let view = (self.stage.camera.eye - point).normalize();
        let mirrored = 2.0 * normal.dot(view) * normal - view;
        // Schlick's Fresnel term of a glaze, and the lamp's reflection on it.
        let fresnel = 0.04 + 0.5 * (1.0 - normal.dot(view).max(0.0)).powi(5);
        let reflex = if met[0] { 0.0 } else { 0.35 * mirrored.dot(LAMP.normalize()).max(0.0).powi(48) };
        let gloss = fresnel * sky * sky_light(mirrored.y) + reflex;
        body * (LAMP_SHARE * lamp + SKY_SHARE * sky) + Vec3::splat(gloss)
    }
}

/// An even sky, brightest above; from below the page reflects light.
fn sky_light(height: f32) -> f32 {
    if height > 0.0 { 0.72 + 0.38 * height } else { 0.72 + 0.25 * height }
}

/// Uniform on the lamp.
fn lamp_direction(at: Vec2) -> Vec3 {
    let towards = LAMP.normalize();
    let (across, along) = towards.any_orthonormal_pair();
    let (sin, cos) = (TAU * at.x).sin_cos();
    towards + LAMP_WIDTH * at.y.sqrt() * (cos * across + sin * along)
}

/// Spread by the cosine to the normal.
fn sky_direction(normal: Vec3, at: Vec2) -> Vec3 {
    let (across, along) = normal.any_orthonormal_pair();
    let (sin, cos) = (TAU * at.x).sin_cos();
    at.y.sqrt() * (cos * across + sin * along) + (1.0 - at.y).sqrt() * normal
}

/// Place `i` of the additive sequence of the plastic number in the unit square, which is even for any count (Roberts
/// 2018, "The unreasonable effectiveness of quasirandom sequences"), shifted by `turn`.
fn spread(turn: Vec2, i: usize) -> Vec2 {
    (turn + (i as f32 + 0.5) * Vec2::new(0.754_877_7, 0.569_840_3)).fract()
}

/// A random shift for each pixel, so that neighbours err differently.
fn scramble(row: u32, column: u32) -> Vec2 {
    let mut bits = row.wrapping_mul(0x9e37_79b9) ^ column.wrapping_mul(0x85eb_ca6b);
    let mut unit = || {
        bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
        bits ^= bits >> 16;
        (bits >> 8) as f32 / (1 << 24) as f32
    };
    Vec2::new(unit(), unit())
}

/// Light of a colour of the screen.
fn linear(colour: Colour) -> Vec3 {
    Vec3::from(colour.map(|part| (part as f32 / 255.0).powf(2.2)))
}

/// The colour of the screen for a light; light that is too bright is white.
fn encoded(light: Vec3) -> Colour {
    light.to_array().map(|part| (part.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::palette::COBALT;
    use crate::draw::stage;
    use std::ops::ControlFlow;

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn a_square_shows_glaze_paint_and_the_page_around_it() {
        let stage = stage::tests::square([10.5, 5.5, 7.0]);
        let window = stage.camera.window_on(stage.positions(), 1.0, 0.5);
        let picture = render(&stage, &window, &window, [60, 60], 2, &|_| ControlFlow::Continue(())).unwrap();
        let at = |x: f32, y: f32| {
            let place = (stage.camera.project(Vec3::new(x, y, 0.0)) - window.centre) / window.half;
            let [column, row] = [1.0 + place.x, 1.0 - place.y].map(|share| (share * 30.0) as usize);
            picture[row * 60 + column]
        };
        let (paint, glaze) = (at(0.25, 0.25), at(-0.35, -0.25));
        assert!(paint[2] > paint[0] + 60, "{paint:?}");
        assert!(glaze.iter().all(|&part| part > 150) && glaze[2] < glaze[0] + 12, "{glaze:?}");
        assert_eq!(picture[0], PAPER);
        // The square casts a shadow on the page behind it.
        assert!(picture.iter().any(|colour| colour[0] < PAPER[0] - 10 && colour[2] < colour[0]));
    }

    #[test]
    fn directions_follow_the_cosine() {
        let normal = Vec3::new(0.6, 0.0, 0.8);
        let count = 4096;
        let directions = (0..count).map(|i| sky_direction(normal, spread(Vec2::splat(0.3), i)));
        let mean = directions.inspect(|d| assert!((d.length() - 1.0).abs() < 1e-5 && d.dot(normal) >= 0.0));
        let mean = mean.sum::<Vec3>() / count as f32;
        assert!(mean.distance(normal * 2.0 / 3.0) < 0.01, "{mean}");
    }

    #[test]
    fn colours_survive_the_way_to_light_and_back() {
        for colour in [PAPER, COBALT, [0, 128, 255]] {
            assert_eq!(encoded(linear(colour)), colour);
        }
    }
}
