//! The neighbour search in one cube where the radius varies: the fill's pages, with the radius as fourth axis.
//!
//! A cell lists every sample whose ball is near enough to overlap that of any place in the cell. This requires that the
//! largest radius on the surface of the cube is known beforehand; the size of the cells suits the usual one.

use glam::DVec3;

use crate::math::{distance_squared, square};
use crate::mesh::Mesh;
use crate::psp::fill::{BEYOND, Cells, LANES, Pages, Place, Space};
use crate::psp::fragment::Facing;

/// The share by which rounding can increase the distance at which a sample matters, and some more.
const SLACK: f64 = 1e-4;

/// A place, and half of the radius there.
type Ball = [f32; 4];

/// A sample with its radius, as others are tested against it.
#[derive(Clone, Copy, Debug)]
pub struct GradedSample {
    pub position: [f32; 3],
    pub radius: f64,
    /// The normal of its triangle, where normals matter.
    pub normal: [f32; 3],
}

impl GradedSample {
    /// The least distance that two samples keep: the mean of their radii. It is larger by 1e-14, dozens of units in the
    /// last place, so that it is kept in whatever order a caller evaluates distances.
    fn distance(a: f64, b: f64) -> f64 {
        0.5 * (1.0 + 1e-14) * (a + b)
    }

    /// The distance of two samples, as a multiple of the mean of their radii.
    fn ratio(&self, other: &Self) -> f64 {
        distance_squared(self.position, other.position).sqrt() / (0.5 * (self.radius + other.radius))
    }

    /// True if two samples are too close to each other.
    fn conflicts(&self, other: &Self) -> bool {
        let distance = Self::distance(self.radius, other.radius);
        distance_squared(self.position, other.position) < distance * distance
    }
}

/// Samples in and around a cube.
pub struct Grid {
    pub pages: Pages<4>,
    /// For each page, the numbers of its samples.
    numbers: Vec<[u32; LANES]>,
    samples: Vec<GradedSample>,
    /// Half of the largest radius of darts and of the surface that they fall on, in the unit of the space.
    half: f64,
    /// The distance up to which samples are listed, as a multiple of the distance of conflicts.
    stretch: f64,
    /// The box of the darts and of the surface that they fall on.
    low: Place,
    high: Place,
}

impl Grid {
    /// A grid for the surface in a box where no radius exceeds `largest` and most are about `usual`. Ratios of samples
    /// are known up to `stretch`, at least 1.
    pub fn new(mesh: &Mesh, facing: Facing, [low, high]: [DVec3; 2], [usual, largest]: [f64; 2], stretch: f64) -> Self {
        let space = Space::new(mesh, usual.max(0.5 * largest));
        let scale = f64::from(space.scale());
        // Positions are rounded, but by a small part of a radius.
        let margin = 0.25 * space.radius();
        let low = (low * scale - margin).as_vec3().to_array();
        let high = (high * scale + margin).as_vec3().to_array();
        let half = 0.5 * largest * scale;
        let pages = Pages::new(space, Cells::anywhere(), facing);
        Self { pages, numbers: vec![[0; LANES]], samples: Vec::new(), half, stretch, low, high }
    }

    /// A ball in the unit of the space.
    pub fn ball(&self, position: [f32; 3], radius: f64) -> Ball {
        let [x, y, z] = self.pages.space.place(position);
        [x, y, z, (0.5 * radius * f64::from(self.pages.space.scale())) as f32]
    }

    /// Adds a sample, unless it matters to no place in the box.
    pub fn add(&mut self, sample: GradedSample) {
        let (ball, number) = (self.ball(sample.position, sample.radius), self.samples.len() as u32);
        let reach = (self.stretch * (f64::from(ball[3]) + self.half) * (1.0 + SLACK)) as f32;
        let inside = |by: f32| [0, 1, 2].map(|axis| (ball[axis] + by).clamp(self.low[axis], self.high[axis]));
        let [x, y, z] = inside(0.0);
        let squared = square(x - ball[0]) + square(y - ball[1]) + square(z - ball[2]);
        if squared > reach * reach {
            return;
        }
        let cells = [-reach, reach].map(|reach| self.pages.space.cell(inside(reach)));
        self.samples.push(sample);
        let numbers = &mut self.numbers;
        self.pages.list(cells, ball, sample.normal, |page, lane| {
            if page == numbers.len() {
                numbers.push([0; LANES]);
            }
            numbers[page][lane] = number;
        });
    }

    /// True if a sample conflicts with one in the grid: in `f64`, without tolerance.
    pub fn rejects(&self, sample: &GradedSample) -> bool {
        self.any_near(sample, BEYOND, |other| sample.conflicts(other))
    }

    /// The least ratio of a sample to those that matter to it, or the stretch if that is less.
    pub fn ratio(&self, sample: &GradedSample) -> f64 {
        let mut least = self.stretch;
        self.any_near(sample, BEYOND * square(self.stretch) as f32, |other| {
            least = least.min(sample.ratio(other));
            false
        });
        least
    }

    /// True if the test holds for a sample that matters to another one and is near enough by the limit.
    #[inline(always)]
    fn any_near(&self, sample: &GradedSample, limit: f32, mut test: impl FnMut(&GradedSample) -> bool) -> bool {
        let ball = self.ball(sample.position, sample.radius);
        let cell = self.pages.space.cell([ball[0], ball[1], ball[2]]);
        self.pages.any_near(cell, ball, sample.normal, limit, |page, lane| {
            test(&self.samples[self.numbers[page][lane] as usize])
        })
    }

    /// The share of all radii at which the samples that certainly cover a triangle, by its corners and their radii, just
    /// cover it: the least of them. Infinite if none covers it.
    pub fn covering_share(&self, corners: &[Ball; 3], normal: [f32; 3]) -> f64 {
        let (mut least, [x, y, z, _]) = (f64::INFINITY, corners[0]);
        self.pages.any_page(self.pages.space.cell([x, y, z]), |page| {
            let mut covering = self.pages.covering(page, corners, normal);
            while covering != 0 {
                let ball = self.pages.sample(page, covering.trailing_zeros() as usize);
                let shares = corners.map(|corner| squared_share(ball, corner));
                least = least.min(shares[0].max(shares[1]).max(shares[2]));
                covering &= covering - 1;
            }
            false
        });
        least.sqrt()
    }

    /// Those of some sixteenths of a fragment that no single sample certainly covers. The fragment has a normal and, in
    /// its corners, radii such that no point has a smaller one than their linear interpolation.
    pub fn open_sixteenths(
        &self,
        corners: &[DVec3; 3],
        radii: [f64; 3],
        longest: f64,
        normal: [f32; 3],
        open: u16,
    ) -> u16 {
        let half = 0.5 * f64::from(self.pages.space.scale());
        let halves = radii.map(|radius| half * radius);
        // A sample that covers a sixteenth covers its centre. This is no farther from the centre of the fragment than
        // three quarters of the way to a corner, which is two thirds of the longest edge.
        let reach = (halves[0].max(halves[1]).max(halves[2]) + half * longest) as f32;
        let corners = corners.map(|corner| self.pages.space.scaled(corner));
        self.pages.open_parts(&corners, &halves, reach, normal, open)
    }
}

/// The square of the distance of two balls' centres over the sum of their radii.
fn squared_share([x, y, z, r]: Ball, [u, v, w, s]: Ball) -> f64 {
    distance_squared([x, y, z], [u, v, w]) / square(f64::from(r) + f64::from(s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::exact;
    use crate::psp::adaptive::field::RadiusField;
    use crate::psp::adaptive::options::Radius;
    use crate::psp::fill::Batch;
    use crate::psp::fill::page::WITHIN;
    use crate::psp::fragment::Fragment;
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

    /// Against exact distances, in space and with normals, near the origin and far from it.
    #[test]
    fn rejects_and_ratios_are_those_of_a_loop_over_all_samples() {
        for (cosine, ratio, at, stretch) in
            [(-1.0, 1.0, 0.0, 1.0), (-1.0, 1e3, 0.0, 1.1), (0.5, 30.0, 0.0, 2.0), (-1.0, 8.0, 1e3, 1.3)]
        {
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            let mesh = Mesh::new(vec![[at; 3], [at + 1.0; 3], [at, at, at + 1.0]], vec![[0, 1, 2]]).unwrap();
            let largest = 0.1;
            let mut sample = |spread: f64, times: f64| GradedSample {
                position: [(); 3].map(|()| (f64::from(at) + 0.5 + spread * (rng.unit() - 0.5)) as f32),
                radius: times * largest * f64::powf(ratio, -rng.unit()),
                normal: DVec3::new(rng.unit() - 0.5, rng.unit() - 0.5, 0.3).normalize().as_vec3().to_array(),
            };
            let bounds = [DVec3::splat(f64::from(at) + 0.2), DVec3::splat(f64::from(at) + 0.8)];
            let facing = Facing::new(cosine).unwrap();
            let mut grid = Grid::new(&mesh, facing, bounds, [0.6 * largest, largest], stretch);
            let (mut samples, mut rejected) = (Vec::<GradedSample>::new(), 0);
            for step in 0..3000 {
                // Samples may also lie outside and be large; darts are in the box and no larger than stated.
                let (new, probe) = (sample(1.0, if step % 10 == 0 { 4.0 } else { 1.0 }), sample(0.6, 1.0));
                if samples.len() < 600 {
                    grid.add(new);
                    samples.push(new);
                }
                let sees =
                    |other: &GradedSample| cosine == -1.0 || exact(other.normal).dot(exact(probe.normal)) >= cosine;
                let expected = samples.iter().any(|other| {
                    let apart = (exact(other.position) - exact(probe.position)).length();
                    apart < 0.5 * (other.radius + probe.radius) && sees(other)
                });
                assert_eq!(grid.rejects(&probe), expected);
                rejected += u32::from(expected);
                let ratio = |other: &GradedSample| {
                    let apart = (exact(other.position) - exact(probe.position)).length();
                    2.0 * apart / (other.radius + probe.radius)
                };
                let least = samples.iter().filter(|other| sees(other)).map(ratio).fold(stretch, f64::min);
                assert!((grid.ratio(&probe) / least - 1.0).abs() < 1e-12);
            }
            assert!((100..2950).contains(&rejected), "{rejected}");
        }
    }

    /// Against exact distances to the corners of a triangle and of its sixteenths: what no single sample covers is
    /// open, and what one covers with more than rounding to spare is not.
    #[test]
    fn only_what_is_covered_is_dropped_and_all_that_is_well_covered() {
        let (mut rng, mut counts) = (Rng::at(2, Draw::Probe, &[]), [0; 4]);
        for round in 0..3000 {
            let (size, ratio) = ([1.0, 0.1, 1e-3][round % 3], [1.0, 8.0, 500.0f64][round / 3 % 3]);
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            // The second triangle makes the mesh large: radii are cut at four diagonals.
            let corners = vec![corner(), corner(), corner(), [4.0; 3], [12.0; 3], [4.0, 12.0, 4.0]];
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5]]).unwrap();
            let radii: [f32; 6] = std::array::from_fn(|_| (1.0 + 0.5 * rng.unit()) as f32);
            let field = RadiusField::new(&mesh, Radius::PerVertex(&radii), None, 1.0).unwrap();
            let bounds = [DVec3::splat(8.0), DVec3::splat(9.0)];
            let mut grid = Grid::new(&mesh, Facing::ANY, bounds, [1.0, 1.5], 1.0);
            let mut samples = Vec::new();
            for _ in 0..20 {
                let radius = ratio.powf(rng.unit());
                let position = std::array::from_fn(|_| (8.0 + 1.2 * radius * (2.0 * rng.unit() - 1.0)) as f32);
                grid.add(GradedSample { position, radius, normal: [0.0; 3] });
                samples.push((exact(position), radius));
            }
            let whole = Fragment::whole(0);
            let shape = whole.shape(&mesh);
            let of = |part: &Fragment| field.radii_from(part, field.all());
            let mut open_at = |level| {
                grid.pages.level = level;
                grid.open_sixteenths(&shape.corners, of(&whole), shape.longest, [0.0; 3], u16::MAX)
            };
            let open = open_at(Level::Portable);
            assert!(Level::available().into_iter().all(|level| open_at(level) == open), "vectors find something else");
            let mut group = Batch::<4>::EMPTY;
            group.triangles[0] = [0, 1, 2].map(|i| grid.ball(mesh.corners(0)[i], radii[i].into()));
            let is_open = grid.pages.open_triangles(&mut group, 1, |_| [0.0; 3]) == 1;
            let share = grid.covering_share(&group.triangles[0], [0.0; 3]);
            let of_sample = |&(centre, radius): &(DVec3, f64)| {
                let of_corner = |i: usize| 2.0 * shape.corners[i].distance(centre) / (radius + of(&whole)[i]);
                of_corner(0).max(of_corner(1)).max(of_corner(2))
            };
            let least = samples.iter().map(of_sample).fold(f64::INFINITY, f64::min);
            assert!(if is_open { share == f64::INFINITY } else { (share / least - 1.0).abs() < 2e-6 });
            let parts = (0..16).map(|part| (open >> part & 1 == 1, whole.sixteenth(part)));
            for (is_open, part) in std::iter::once((is_open, whole)).chain(parts) {
                let (corners, radii) = (part.shape(&mesh).corners, of(&part));
                let covers = |share: f64| {
                    samples.iter().any(|&(centre, radius)| {
                        (0..3).all(|i| corners[i].distance(centre) < share * 0.5 * (radius + radii[i]))
                    })
                };
                assert!(is_open || covers(1.0));
                assert!(!(is_open && covers(1.0 - 1.2 * f64::from(1.0 - WITHIN))));
                counts[2 * usize::from(part.corners == whole.corners) + usize::from(is_open)] += 1;
            }
        }
        assert!(counts.into_iter().all(|count| count > 300), "{counts:?}");
    }
}
