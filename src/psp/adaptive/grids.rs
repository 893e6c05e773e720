//! The neighbour search in one cube: a grid for each octave of radii, so that a search meets few cells and few
//! samples in each, however far the radii are apart.

use glam::DVec3;

use crate::geometry::grid3::{Grid3, distance_squared};
use crate::mesh::exact;

/// A sample as others see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dot {
    pub position: [f32; 3],
    pub radius: f64,
    /// The normal of its triangle.
    pub normal: [f32; 3],
}

/// Which samples conflict with each other.
#[derive(Clone, Copy)]
pub(super) struct ConflictRule {
    /// Samples whose normals have a smaller cosine ignore each other, unless the normals are the same; -1: none do.
    pub cosine: f64,
}

impl ConflictRule {
    /// How far two samples must be apart: the mean of their radii. It is larger by 1e-14, dozens of units in the last
    /// place, so that it is kept in whatever order a caller evaluates distances.
    pub fn distance(a: f64, b: f64) -> f64 {
        0.5 * (1.0 + 1e-14) * (a + b)
    }

    /// Whether normals matter at all.
    pub fn asks_normals(self) -> bool {
        self.cosine > -1.0
    }

    /// Whether two samples with these normals matter to each other. Those of one triangle do: the square of a rounded
    /// normal can be below a cosine of 1, and a triangle would be sampled without end.
    pub fn sees(self, a: [f32; 3], b: [f32; 3]) -> bool {
        !self.asks_normals() || a == b || exact(a).dot(exact(b)) >= self.cosine
    }

    fn conflict(self, a: &Dot, b: &Dot) -> bool {
        let distance = Self::distance(a.radius, b.radius);
        distance_squared(a.position, b.position) < distance * distance && self.sees(a.normal, b.normal)
    }
}

/// The octave of a radius: it is in `2^octave .. 2^(octave + 1)`.
pub(super) fn octave(radius: f64) -> i32 {
    (radius.to_bits() >> 52) as i32 - 1023
}

/// What all radii of an octave are below.
pub(super) fn end_of_octave(octave: i32) -> f64 {
    f64::from(octave + 1).exp2()
}

/// Dots in and around a cube.
pub(super) struct OctaveGrids {
    pub rule: ConflictRule,
    /// Dots whose radii have the same octave, in no order.
    grids: Vec<OctaveGrid>,
}

struct OctaveGrid {
    octave: i32,
    /// What all radii are below; the side of a cell is twice that.
    end: f64,
    cells: Grid3,
    dots: Vec<Dot>,
}

impl OctaveGrids {
    pub fn new(rule: ConflictRule) -> Self {
        Self { rule, grids: Vec::new() }
    }

    pub fn add(&mut self, dot: Dot) {
        let octave = octave(dot.radius);
        let known = self.grids.iter().position(|grid| grid.octave == octave);
        let grid = known.unwrap_or_else(|| {
            let end = end_of_octave(octave);
            let cells = Grid3::new(dot.position.map(f64::from), 2.0 * end);
            self.grids.push(OctaveGrid { octave, end, cells, dots: Vec::new() });
            self.grids.len() - 1
        });
        self.grids[grid].cells.insert(dot.position);
        self.grids[grid].dots.push(dot);
    }

    /// Whether a dot conflicts with another one.
    pub fn rejects(&self, dot: &Dot) -> bool {
        let reach = |end| ConflictRule::distance(dot.radius, end);
        self.any_in_reach(dot.position.map(f64::from), reach, |other| self.rule.conflict(dot, other))
    }

    /// Visits the dots that are no farther from a place than `reach` and half of their radius and matter to a normal,
    /// as seen from there.
    pub fn near(&self, centre: DVec3, reach: f64, normal: [f32; 3], mut visit: impl FnMut(DVec3, f64)) {
        self.any_in_reach(
            centre.to_array(),
            |end| reach + 0.5 * end,
            |dot| {
                let (offset, limit) = (exact(dot.position) - centre, reach + 0.5 * dot.radius);
                if offset.length_squared() <= limit * limit && self.rule.sees(dot.normal, normal) {
                    visit(offset, dot.radius);
                }
                false
            },
        );
    }

    /// Whether the test holds for a dot in one of the cells that a ball touches, whose radius depends on the octave.
    fn any_in_reach(&self, centre: [f64; 3], reach: impl Fn(f64) -> f64, mut test: impl FnMut(&Dot) -> bool) -> bool {
        self.grids.iter().any(|grid| {
            let reach = reach(grid.end);
            let cells = (reach / grid.end + 1.0).powi(3);
            if cells < grid.dots.len() as f64 {
                grid.cells.candidates(centre, reach).any(|id| test(&grid.dots[id as usize]))
            } else {
                grid.dots.iter().any(&mut test)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn octaves_begin_at_powers_of_two() {
        for (radius, expected) in [(1.0, 0), (1.999, 0), (2.0, 1), (0.25, -2), (1e-38, -127), (3e38, 127)] {
            assert_eq!(octave(radius), expected);
            assert!(radius < end_of_octave(expected) && 2.0 * radius >= end_of_octave(expected));
        }
    }

    #[test]
    fn finds_what_a_loop_over_all_dots_finds() {
        for (cosine, ratio) in [(-1.0, 1.0), (-1.0, 1e3), (0.5, 30.0)] {
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            let mut dot = || Dot {
                position: std::array::from_fn(|_| rng.unit() as f32),
                radius: 0.1 * f64::powf(ratio, -rng.unit()),
                normal: DVec3::new(rng.unit() - 0.5, rng.unit() - 0.5, 0.3).normalize().as_vec3().to_array(),
            };
            let (mut grids, mut dots) = (OctaveGrids::new(ConflictRule { cosine }), Vec::<Dot>::new());
            let mut rejected = 0;
            for _ in 0..3000 {
                let (new, probe) = (dot(), dot());
                grids.add(new);
                dots.push(new);
                let sees = |other: &Dot| cosine == -1.0 || exact(other.normal).dot(exact(probe.normal)) >= cosine;
                let close = |other: &&Dot| {
                    let apart = (exact(other.position) - exact(probe.position)).length();
                    apart < 0.5 * (other.radius + probe.radius) && sees(other)
                };
                let expected = dots.iter().any(|other| close(&other));
                assert_eq!(grids.rejects(&probe), expected);
                rejected += u32::from(expected);

                let (centre, reach, mut found) = (exact(probe.position), 3.0 * probe.radius, 0);
                // A dot can come twice, which does no harm; the farthest one must come.
                let mut farthest = 0.0f64;
                grids.near(centre, reach, probe.normal, |offset, radius| {
                    assert!(offset.length() <= reach + 0.5 * radius + 1e-12);
                    found += 1;
                    farthest = farthest.max(offset.length());
                });
                let near = dots.iter().filter(|other| {
                    sees(other) && (exact(other.position) - centre).length() <= reach + 0.5 * other.radius
                });
                let distances: Vec<_> = near.map(|other| (exact(other.position) - centre).length()).collect();
                assert!(found >= distances.len());
                assert_eq!(farthest, distances.into_iter().fold(0.0, f64::max));
            }
            assert!((100..2900).contains(&rejected), "{rejected}");
        }
    }
}
