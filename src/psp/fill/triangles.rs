//! Triangles in groups, and what passes over all of them have to know: areas and longest edges.

use std::ops::Range;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::estimate::expected_samples;
use crate::psp::fill::balls::{Ball, Balls};
use crate::psp::fill::vectors;
use crate::simd::Level;

/// Triangles in a group. Of smaller groups more stay dry when the first darts fall; larger ones need less memory.
pub(in crate::psp) const GROUP: usize = 16;

/// So many groups for each expected sample are worth balls around them, ...
const GROUPS_PER_SAMPLE: f64 = 2.0;
/// ... which are made if most are no larger than this part of the radius.
const LARGEST: f64 = 0.5;

/// The areas of a group of triangles, and the squares of their longest edges.
pub(in crate::psp) type Sizes = ([f64; GROUP], [f64; GROUP]);

/// Some triangles of a mesh.
#[derive(Clone, Copy)]
pub(in crate::psp) enum Triangles<'a> {
    /// The first so many: all of the mesh.
    All(usize),
    /// Those listed.
    Listed(&'a [u32]),
}

impl Triangles<'_> {
    pub fn len(self) -> usize {
        match self {
            Self::All(count) => count,
            Self::Listed(triangles) => triangles.len(),
        }
    }

    /// The number of groups.
    pub fn groups(self) -> usize {
        self.len().div_ceil(GROUP)
    }

    /// The triangle at an index.
    #[inline(always)]
    pub fn at(self, index: usize) -> u32 {
        match self {
            Self::All(_) => index as u32,
            Self::Listed(triangles) => triangles[index],
        }
    }

    /// The indices of a group.
    pub fn group(self, group: usize) -> Range<usize> {
        self.indices(group..group + 1)
    }

    /// The indices of some groups.
    pub fn indices(self, groups: Range<usize>) -> Range<usize> {
        groups.start * GROUP..(groups.end * GROUP).min(self.len())
    }

    /// The areas of a group, and the squares of the longest edges; zero behind its end.
    pub fn measure(self, mesh: &Mesh, group: usize) -> Sizes {
        vectors::measure(Level::widest(), self, mesh, group)
    }

    /// The same without vectors.
    #[inline(always)]
    pub(super) fn measure_portable(self, mesh: &Mesh, group: usize) -> Sizes {
        let mut edges = [[[0.0f64; GROUP]; 3]; 2];
        for (lane, index) in self.group(group).enumerate() {
            let [a, b, c] = mesh.corners(self.at(index));
            for axis in 0..3 {
                edges[0][axis][lane] = f64::from(b[axis]) - f64::from(a[axis]);
                edges[1][axis][lane] = f64::from(c[axis]) - f64::from(a[axis]);
            }
        }
        let (mut areas, mut longest) = ([0.0; GROUP], [0.0; GROUP]);
        let [[ex, ey, ez], [fx, fy, fz]] = &edges;
        for lane in 0..GROUP {
            let (e, f) = ([ex[lane], ey[lane], ez[lane]], [fx[lane], fy[lane], fz[lane]]);
            let square = |[x, y, z]: [f64; 3]| x * x + y * y + z * z;
            let cross = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
            areas[lane] = 0.5 * square(cross).sqrt();
            longest[lane] = square(e).max(square(f)).max(square([f[0] - e[0], f[1] - e[1], f[2] - e[2]]));
        }
        (areas, longest)
    }
}

/// What a fill has to know of a mesh, whatever the radius: one pass over the triangles.
pub(in crate::psp) struct Measures {
    /// Those that the mask does not leave out, where there is a mask.
    sampled: Option<Vec<u32>>,
    /// The number of triangles.
    count: usize,
    /// The area of each group of them.
    pub areas: Vec<f64>,
    /// How many triangles have a longest edge up to a length, and above the length before it.
    lengths: Vec<(f64, u32)>,
    balls: Balls,
}

impl Measures {
    pub fn of(mesh: &Mesh) -> Self {
        let count = mesh.sampled_triangles().count();
        let sampled = (count < mesh.triangles().len()).then(|| mesh.sampled_triangles().collect());
        let areas = Vec::with_capacity(count.div_ceil(GROUP));
        let mut measures = Self { sampled, count, areas, lengths: Vec::new(), balls: Balls::default() };
        // By the exponents of their squares, half an octave each.
        let mut counts = vec![0u32; 1 << 11];
        for group in 0..measures.triangles().groups() {
            let (areas, longest) = measures.triangles().measure(mesh, group);
            measures.areas.push(areas.iter().sum());
            longest.iter().for_each(|square| counts[(square.to_bits() >> 52) as usize] += 1);
        }
        let end = |exponent: usize| f64::from_bits((exponent as u64 + 1) << 52).sqrt();
        // Exponent 0 is that of lengths below any float's.
        measures.lengths = (1..).zip(&counts[1..]).filter(|&(_, &n)| n > 0).map(|(i, &n)| (end(i), n)).collect();
        measures
    }

    /// The triangles that are to be sampled.
    pub fn triangles(&self) -> Triangles<'_> {
        self.sampled.as_deref().map_or(Triangles::All(self.count), Triangles::Listed)
    }

    /// A length that no edge exceeds: at most sqrt(2) times too much.
    pub fn longest(&self) -> f64 {
        self.lengths.last().map_or(0.0, |&(end, _)| end)
    }

    /// A ball around each group, for a pass at a radius: where a few groups fit into a sample's ball.
    pub fn balls(&self, job: &Job, mesh: &Mesh, radius: f64) -> Result<Option<&[Ball]>> {
        let groups_per_sample = self.areas.len() as f64 / expected_samples(mesh, self, radius);
        if groups_per_sample < GROUPS_PER_SAMPLE {
            return Ok(None);
        }
        self.balls.for_pass(job, mesh, self.triangles(), LARGEST * radius)
    }

    /// A ball around each group, if most are no larger than this.
    pub fn balls_up_to(&self, job: &Job, mesh: &Mesh, largest: f64) -> Result<Option<&[Ball]>> {
        self.balls.get(job, mesh, self.triangles(), largest)
    }

    /// The sum of the longest edges of all triangles that are longer than a length; at most sqrt(2) times too much.
    pub fn longer_than(&self, length: f64) -> f64 {
        self.lengths.iter().filter(|&&(end, _)| end > length).map(|&(end, count)| end * f64::from(count)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::estimate::longest_edge;
    use crate::rng::{Draw, Rng};

    #[test]
    fn measures_are_those_of_the_triangles() {
        let mut rng = Rng::at(8, Draw::Probe, &[]);
        let positions: Vec<[f32; 3]> =
            (0..3000).map(|i| [(); 3].map(|()| (rng.unit() * f64::from(i + 1)) as f32)).collect();
        let triangles = (0..1000).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let masked = mesh.clone().with_mask((0..1000).map(|i| i % 3 != 1).collect()).unwrap();
        for mesh in [mesh, masked] {
            let measures = Measures::of(&mesh);
            let triangles: Vec<u32> = mesh.sampled_triangles().collect();
            assert_eq!(
                (0..measures.triangles().len()).map(|i| measures.triangles().at(i)).collect::<Vec<_>>(),
                triangles
            );
            for (group, triangles) in triangles.chunks(GROUP).enumerate() {
                let (areas, longest) = measures.triangles().measure(&mesh, group);
                let at = |level| vectors::measure(level, measures.triangles(), &mesh, group);
                assert!(Level::available().into_iter().all(|level| at(level) == (areas, longest)));
                for (lane, &triangle) in triangles.iter().enumerate() {
                    assert!((areas[lane] / mesh.triangle_area(triangle) - 1.0).abs() < 1e-12);
                    assert!((longest[lane].sqrt() / longest_edge(&mesh, triangle) - 1.0).abs() < 1e-12);
                }
                assert!((measures.areas[group] / areas.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            }
            let longest = triangles.iter().map(|&triangle| longest_edge(&mesh, triangle)).fold(0.0, f64::max);
            assert!((1.0..1.42).contains(&(measures.longest() / longest)));
            for length in [0.0, 1.0, 100.0, 1000.0] {
                let longest = triangles.iter().map(|&triangle| longest_edge(&mesh, triangle));
                let expected: f64 = longest.filter(|&longest| longest > length).sum();
                let ratio = measures.longer_than(length) / expected;
                assert!((1.0..1.6).contains(&ratio), "{length}: {ratio}");
            }
        }
    }
}
