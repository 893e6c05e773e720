//! The surroundings of samples: the samples within a ball that are reached on the surface without leaving it.
//!
//! A flood (`flood.rs`) starts from a sample's triangle and crosses all edges that the ball meets. So samples that are
//! near through space but not on the surface, as on the other side of a thin wall, are not found, and those behind a
//! sharp fold are. Neither normals nor winding are trusted.
//!
//! Where the flood meets a boundary it mirrors the samples found, as the thesis does on bounded domains (Fig. 4.12 (b)).

use glam::{DVec3, Vec3};

use crate::dcr::surface::cells::Cells;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::flood::Flood;
use crate::dcr::surface::patches::Patches;
use crate::dcr::surface::view::MOST;

/// Two positions on the boundary at which a sample is mirrored are farther apart than this fraction of the ball's
/// radius, or at least 60 degrees apart as seen from it: without its image by both sides of a corner, nothing keeps a
/// sample off one of them.
const APART: f64 = 0.2;

/// The mirror image of a sample by a half-edge of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Image {
    pub(super) sample: u32,
    pub(super) edge: u32,
}

/// The samples near one sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Surroundings {
    /// The samples that are reached on the surface. With the images no more than [`MOST`], the nearest.
    pub(super) reached: Vec<u32>,
    pub(super) images: Vec<Image>,
    /// All other samples within sight through space, on whatever parts of the surface.
    pub(super) others: Vec<u32>,
    /// The mean normal, on the front side of the sample's triangle; zero where there is none.
    pub(super) normal: Vec3,
}

/// All samples, found by their position. Lengths are in the units of the mesh.
pub(super) struct SampleSearch<'a> {
    pub(super) connected: &'a ConnectedMesh<'a>,
    pub(super) patches: &'a Patches,
    pub(super) cells: &'a Cells,
    pub(super) spacing: f64,
    /// The radius of the ball, and how far others are in sight; in spacings.
    pub(super) radius: f64,
    pub(super) sight: f64,
}

/// What is found around one sample after the other.
#[derive(Default)]
pub(super) struct Finds {
    flood: Flood,
    near: Vec<Near>,
}

#[derive(Clone, Copy)]
struct Near {
    squared: f32,
    sample: u32,
    position: Vec3,
}

impl SampleSearch<'_> {
    /// The side of the cells in which samples are found.
    pub(super) fn cell_side(spacing: f64, radius: f64, sight: f64) -> f64 {
        // A little more, for the rounding of positions in cells.
        radius.max(sight) * spacing * (1.0 + 1e-6)
    }

    /// The surroundings of a sample. `seen` has the triangle that each sample is on, and the normal of it.
    pub(super) fn around(&self, sample: u32, seen: impl Fn(u32) -> (u32, Vec3), finds: &mut Finds) -> Surroundings {
        let unit = (1.0 / self.spacing) as f32;
        let (position, triangle) = (self.cells.position(sample), seen(sample).0);
        let Finds { flood, near } = finds;
        flood.spread(self.patches, triangle, position, self.radius as f32, unit);
        near.clear();
        let mut around = Surroundings::default();
        let (limit, in_sight) = ((self.radius * self.radius) as f32, (self.sight * self.sight) as f32);
        let mut normal = Vec3::ZERO;
        self.cells.around(position, |other, place| {
            let squared = ((place - position) * unit).length_squared();
            if squared <= limit {
                let (triangle, front) = seen(other);
                if let Some(is_turned) = flood.is_turned(self.patches.side(triangle)) {
                    let weight = 1.0 - squared / limit;
                    normal += if is_turned { -weight } else { weight } * front;
                    near.push(Near { squared, sample: other, position: place });
                    return;
                }
            }
            if squared <= in_sight && other != sample {
                around.others.push(other);
            }
        });
        around.normal = normal.normalize_or_zero();
        let boundary = flood.boundary();
        if !boundary.is_empty() {
            self.mirror_all(boundary, position.as_dvec3(), near, &mut around.images);
        }
        self.keep_nearest(sample, position, in_sight, near, &mut around);
        around
    }

    /// Takes what was found, and if that is too much the nearest of it.
    fn keep_nearest(
        &self,
        sample: u32,
        position: Vec3,
        in_sight: f32,
        near: &mut Vec<Near>,
        around: &mut Surroundings,
    ) {
        near.retain(|near| near.sample != sample);
        if near.len() + around.images.len() > MOST {
            let unit = (1.0 / self.spacing) as f32;
            let image_squared = |image: &Image| {
                let place = self.cells.position(image.sample).as_dvec3();
                let place = mirrored(place, self.connected.ends(image.edge));
                ((place - position.as_dvec3()).as_vec3() * unit).length_squared()
            };
            let images: Vec<(f32, Image)> = around.images.iter().map(|image| (image_squared(image), *image)).collect();
            let mut all: Vec<f32> = near.iter().map(|near| near.squared).chain(images.iter().map(|i| i.0)).collect();
            all.sort_unstable_by(f32::total_cmp);
            let farthest = all[MOST - 1];
            near.sort_by(|a, b| a.squared.total_cmp(&b.squared).then(a.sample.cmp(&b.sample)));
            around.images = images.into_iter().filter(|image| image.0 <= farthest).map(|image| image.1).collect();
            around.images.truncate(MOST);
            let room = MOST - around.images.len();
            let left_out = near.drain(near.len().min(room)..).filter(|near| near.squared <= in_sight);
            around.others.extend(left_out.map(|near| near.sample));
        }
        around.reached.extend(near.iter().map(|near| near.sample));
    }

    /// Mirrors the samples at the edges of the boundary that the ball meets.
    fn mirror_all(&self, boundary: &[u32], centre: DVec3, near: &[Near], images: &mut Vec<Image>) {
        let radius = self.radius * self.spacing;
        let is_met = |&edge: &u32| {
            let [a, b] = self.connected.ends(edge);
            nearest_on(a, b, centre).distance_squared(centre) <= radius * radius
        };
        let met: Vec<u32> = boundary.iter().copied().filter(is_met).collect();
        if !met.is_empty() {
            near.iter().for_each(|near| self.mirror(&met, near.sample, near.position.as_dvec3(), centre, images));
        }
    }

    /// Adds the mirror images of a sample: by the position on the boundary that is nearest to it, and by all other
    /// edges that it is beside. Along a boundary with many corners one image replaces several.
    fn mirror(&self, boundary: &[u32], sample: u32, position: DVec3, centre: DVec3, images: &mut Vec<Image>) {
        let radius = self.radius * self.spacing;
        let mirrors = boundary.iter().map(|&edge| {
            let [a, b] = self.connected.ends(edge);
            let mirror = nearest_on(a, b, position);
            (mirror.distance_squared(position), edge, mirror, mirror != a && mirror != b)
        });
        let mut mirrors: Vec<_> = mirrors.collect();
        mirrors.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<DVec3> = Vec::new();
        for (_, edge, mirror, is_beside) in mirrors {
            let is_apart = taken.iter().all(|&other| {
                let (one, other) = (mirror - position, other - position);
                one.distance(other) > APART * radius || 2.0 * one.dot(other) <= one.length() * other.length()
            });
            if taken.is_empty() || (is_beside && is_apart) {
                taken.push(mirror);
                if (2.0 * mirror - position).distance_squared(centre) <= radius * radius {
                    images.push(Image { sample, edge });
                }
            }
        }
    }
}

/// The point of a segment that is nearest to a position.
fn nearest_on(a: DVec3, b: DVec3, place: DVec3) -> DVec3 {
    let (along, offset) = (b - a, place - a);
    match offset.dot(along) / along.length_squared() {
        share if share <= 0.0 => a,
        share if share >= 1.0 => b,
        share => a + share * along,
    }
}

/// The mirror image of a position by an edge.
pub(super) fn mirrored(place: DVec3, [a, b]: [DVec3; 2]) -> DVec3 {
    2.0 * nearest_on(a, b, place) - place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dcr::surface::walk::SurfacePoint;
    use crate::job::Context;
    use crate::mesh::Mesh;
    use crate::rng::{Draw, Rng};
    use glam::DVec2;

    const RADIUS: f64 = 0.15;

    /// Unit squares at these heights, each of two triangles.
    fn squares(heights: &[f32]) -> Mesh {
        let positions = heights.iter().flat_map(|&z| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]]);
        let triangles =
            (0..heights.len() as u32).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
        Mesh::new(positions.collect(), triangles.collect()).unwrap()
    }

    fn places(mesh: &Mesh, count: u64) -> Vec<SurfacePoint> {
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let mut place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            SurfacePoint { triangle: rng.below(mesh.triangles().len() as u64) as u32, uv }
        };
        (0..count).map(|_| place()).collect()
    }

    /// The neighbours of all samples: sample, and where it or its image is.
    fn found(mesh: &Mesh, places: &[SurfacePoint]) -> Vec<Vec<(u32, DVec3)>> {
        let connected = &ConnectedMesh::new(mesh).unwrap();
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(mesh)).collect();
        let context = Context::new(1).unwrap();
        let patches = &context.run(None, |job| Patches::new(job, connected, RADIUS)).unwrap();
        let side = SampleSearch::cell_side(RADIUS, 1.0, 0.0);
        let cells = &Cells::new(DVec3::ZERO, side, positions.iter().map(|position| position.as_vec3()));
        let search = SampleSearch { connected, patches, cells, spacing: RADIUS, radius: 1.0, sight: 0.0 };
        let seen = |sample: u32| (places[sample as usize].triangle, Vec3::Z);
        let mut finds = Finds::default();
        let around = |sample| {
            let around = search.around(sample, seen, &mut finds);
            let reached = around.reached.iter().map(|&other| (other, positions[other as usize]));
            let at = |image: &Image| mirrored(positions[image.sample as usize], connected.ends(image.edge));
            reached.chain(around.images.iter().map(|image| (image.sample, at(image)))).collect()
        };
        (0..places.len() as u32).map(around).collect()
    }

    fn sorted(mut neighbours: Vec<(u32, DVec3)>) -> Vec<(u32, [i64; 3])> {
        // Up to rounding.
        let key = |x: DVec3| x.to_array().map(|x| (x * 1e9).round() as i64);
        neighbours.sort_by_key(|&(sample, position)| (sample, key(position)));
        neighbours.into_iter().map(|(sample, position)| (sample, key(position))).collect()
    }

    #[test]
    fn on_a_square_they_are_all_that_are_near_and_the_images_by_its_sides() {
        let mesh = squares(&[0.0]);
        let places = places(&mesh, 400);
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(&mesh)).collect();
        let mut mirrored = 0;
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            let mut expected = Vec::new();
            for (sample, &position) in positions.iter().enumerate() {
                let DVec3 { x, y, .. } = position;
                let mut images = vec![position];
                images.extend([DVec3::new(-x, y, 0.0), DVec3::new(x, -y, 0.0)]);
                images.extend([DVec3::new(2.0 - x, y, 0.0), DVec3::new(x, 2.0 - y, 0.0)]);
                let near = images.into_iter().filter(|image| image.distance(positions[centre]) <= RADIUS);
                expected.extend(
                    near.filter(|&image| sample != centre || image != position).map(|image| (sample as u32, image)),
                );
            }
            expected.sort_by(|a, b| a.1.distance(positions[centre]).total_cmp(&b.1.distance(positions[centre])));
            expected.truncate(MOST);
            mirrored += expected.iter().filter(|(_, position)| position.min_element() < 0.0).count();
            assert_eq!(sorted(neighbours), sorted(expected), "around {}", positions[centre]);
        }
        assert!(mirrored > 100);
    }

    #[test]
    fn the_other_side_of_a_thin_wall_is_not_near() {
        let mesh = squares(&[0.0, 0.001]);
        let places = places(&mesh, 500);
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            assert!(neighbours.len() > 5);
            let side = |sample: usize| places[sample].triangle / 2;
            assert!(neighbours.iter().all(|&(sample, _)| side(sample as usize) == side(centre)));
        }
    }
}
