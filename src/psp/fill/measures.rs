//! Measures of a mesh that a fill needs for any radius: areas, lengths, and balls around clusters of triangles.
//!
//! A *cluster* is a run of sixteen consecutive triangles of the mesh. If one sample covers the ball around a cluster, a
//! pass need not read its triangles, and if the ball lies in a cube, all of them do.
//!
//! Balls are kept with the mesh, if consecutive triangles lie close together. Sorting triangles into cubes gains more
//! by them than they cost, and so does the second pass over a mesh that is filled in one piece; the first pass alone
//! would not. The result of a pass is the same with and without them; whether cubes use them depends on mesh and radius
//! alone, not on those that are kept.

use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::Vec3A;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::rounded_up;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::extent::Extent;
use crate::simd::{Lanes, Level, Work, run};

/// Triangles in a cluster. The first darts pass more clusters if these are smaller; larger ones need less memory.
pub const CLUSTER: usize = 16;

/// The number of clusters per expected sample from which balls around them pay off.
const CLUSTERS_PER_SAMPLE: f64 = 2.0;
/// Balls are made if most are no larger than this share of the radius.
const LARGEST: f64 = 0.5;

/// The areas of a cluster of triangles, and the squares of their longest edges.
pub type Sizes = ([f64; CLUSTER], [f64; CLUSTER]);

/// Some triangles of a mesh.
#[derive(Clone, Copy)]
pub enum Triangles<'a> {
    /// All triangles of the mesh, by their number.
    All(usize),
    /// The listed triangles.
    Listed(&'a [u32]),
}

impl Triangles<'_> {
    pub fn len(self) -> usize {
        match self {
            Self::All(count) => count,
            Self::Listed(triangles) => triangles.len(),
        }
    }

    /// The number of clusters.
    pub fn clusters(self) -> usize {
        self.len().div_ceil(CLUSTER)
    }

    /// The triangle at an index.
    #[inline(always)]
    pub fn at(self, index: usize) -> u32 {
        match self {
            Self::All(_) => index as u32,
            Self::Listed(triangles) => triangles[index],
        }
    }

    /// The indices of a cluster.
    pub fn cluster(self, cluster: usize) -> Range<usize> {
        self.indices(cluster..cluster + 1)
    }

    /// The indices of some clusters.
    pub fn indices(self, clusters: Range<usize>) -> Range<usize> {
        clusters.start * CLUSTER..(clusters.end * CLUSTER).min(self.len())
    }

    /// The areas of a cluster, and the squares of the longest edges; zero after its end.
    pub fn measure(self, mesh: &Mesh, cluster: usize) -> Sizes {
        run(Level::widest(), Measure { triangles: self, mesh, cluster })
    }
}

/// [`Triangles::measure`]: loops over lanes, which compilers vectorize.
struct Measure<'a> {
    triangles: Triangles<'a>,
    mesh: &'a Mesh,
    cluster: usize,
}

impl Work for Measure<'_> {
    type Out = Sizes;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Sizes {
        let Self { triangles, mesh, cluster } = self;
        let mut edges = [[[0.0f64; CLUSTER]; 3]; 2];
        for (lane, index) in triangles.cluster(cluster).enumerate() {
            let [a, b, c] = mesh.corners(triangles.at(index));
            for axis in 0..3 {
                edges[0][axis][lane] = f64::from(b[axis]) - f64::from(a[axis]);
                edges[1][axis][lane] = f64::from(c[axis]) - f64::from(a[axis]);
            }
        }
        let (mut areas, mut longest) = ([0.0; CLUSTER], [0.0; CLUSTER]);
        let [[ex, ey, ez], [fx, fy, fz]] = &edges;
        for lane in 0..CLUSTER {
            let (e, f) = ([ex[lane], ey[lane], ez[lane]], [fx[lane], fy[lane], fz[lane]]);
            let square = |[x, y, z]: [f64; 3]| x * x + y * y + z * z;
            let cross = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
            areas[lane] = 0.5 * square(cross).sqrt();
            longest[lane] = square(e).max(square(f)).max(square([f[0] - e[0], f[1] - e[1], f[2] - e[2]]));
        }
        (areas, longest)
    }
}

/// The measures of a mesh, for any radius: one pass over the triangles.
pub struct Measures {
    /// The triangles that the mask includes, if there is a mask.
    sampled: Option<Vec<u32>>,
    /// The number of triangles.
    count: usize,
    /// The area of each cluster of triangles.
    pub areas: Vec<f64>,
    /// The number of triangles with a longest edge up to a length, and above the length before it.
    lengths: Vec<(f64, u32)>,
    balls: Balls,
}

impl Measures {
    pub fn of(mesh: &Mesh) -> Self {
        let count = mesh.sampled_triangles().count();
        let sampled = (count < mesh.triangles().len()).then(|| mesh.sampled_triangles().collect());
        let areas = Vec::with_capacity(count.div_ceil(CLUSTER));
        let mut measures = Self { sampled, count, areas, lengths: Vec::new(), balls: Balls::default() };
        // Sorted by the exponents of their squares, half an octave each.
        let mut counts = vec![0u32; 1 << 11];
        for cluster in 0..measures.triangles().clusters() {
            let (areas, longest) = measures.triangles().measure(mesh, cluster);
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

    /// An upper bound of all edge lengths: at most sqrt(2) times too large.
    pub fn longest(&self) -> f64 {
        self.lengths.last().map_or(0.0, |&(end, _)| end)
    }

    /// A ball around each cluster, for a pass at a radius, if a few clusters fit into a sample's ball.
    pub fn balls(&self, job: &Job, mesh: &Mesh, radius: f64) -> Result<Option<&[Ball]>> {
        let clusters_per_sample = self.areas.len() as f64 / self.expected_samples(mesh, radius);
        if clusters_per_sample < CLUSTERS_PER_SAMPLE {
            return Ok(None);
        }
        self.balls.for_pass(job, mesh, self.triangles(), LARGEST * radius)
    }

    /// A ball around each cluster, if most are no larger than `largest`.
    pub fn balls_up_to(&self, job: &Job, mesh: &Mesh, largest: f64) -> Result<Option<&[Ball]>> {
        self.balls.get(job, mesh, self.triangles(), largest)
    }

    /// The balls around clusters, by cluster, if they have been made; otherwise none.
    pub fn known_balls(&self) -> &[Ball] {
        self.balls.made.get().map_or(&[], Vec::as_slice)
    }

    /// The sum of the longest edges of all triangles that are longer than a length; at most sqrt(2) times too large.
    pub fn longer_than(&self, length: f64) -> f64 {
        self.lengths.iter().filter(|&&(end, _)| end > length).map(|&(end, count)| end * f64::from(count)).sum()
    }
}

/// The length of the longest edge of a triangle.
pub fn longest_edge(mesh: &Mesh, triangle: u32) -> f64 {
    let [a, b, c] = mesh.corners(triangle).map(exact);
    (b - a).length().max((c - b).length()).max((a - c).length())
}

/// A ball, in the unit of the mesh.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    pub centre: [f32; 3],
    pub radius: f32,
}

/// The number of balls that decide whether all are worth making.
const PROBES: usize = 64;

/// Clusters per task.
const CHUNK: usize = 1 << 12;

/// A ball around each cluster of the triangles of a mesh, once they have been made.
#[derive(Default)]
pub struct Balls {
    /// True if there has been a pass.
    is_second: AtomicBool,
    made: OnceLock<Vec<Ball>>,
}

impl Balls {
    /// The balls, by cluster, for a pass over all triangles: none in the first one.
    pub fn for_pass(&self, job: &Job, mesh: &Mesh, triangles: Triangles, largest: f64) -> Result<Option<&[Ball]>> {
        match self.is_second.swap(true, Ordering::Relaxed) {
            true => self.get(job, mesh, triangles, largest),
            false => Ok(None),
        }
    }

    /// The balls, by cluster, if half of a selection from all over the mesh have at most this radius. That depends on
    /// nothing else. Threads that make them at the same time do not wait for each other, and those of the first one are
    /// kept.
    pub fn get(&self, job: &Job, mesh: &Mesh, triangles: Triangles, largest: f64) -> Result<Option<&[Ball]>> {
        if !are_small(mesh, triangles, largest) {
            return Ok(None);
        }
        if self.made.get().is_none() {
            let chunks = chunks_of(triangles.clusters(), CHUNK);
            let around = |cluster: usize| Ball::around(mesh, triangles, cluster);
            let made = job.map(chunks.len(), |chunk| chunks.range(chunk).map(around).collect::<Vec<_>>())?.concat();
            self.made.get_or_init(|| made);
        }
        Ok(self.made.get().map(Vec::as_slice))
    }
}

/// True if half of a selection of balls from all over the mesh have at most this radius.
fn are_small(mesh: &Mesh, triangles: Triangles, largest: f64) -> bool {
    let probes = PROBES.min(triangles.clusters());
    let ball = |probe: usize| Ball::around(mesh, triangles, probe * triangles.clusters() / probes);
    let small = (0..probes).filter(|&probe| f64::from(ball(probe).radius) <= largest).count();
    2 * small >= probes
}

impl Ball {
    /// The ball around the box of a cluster.
    fn around(mesh: &Mesh, triangles: Triangles, cluster: usize) -> Self {
        let (mut low, mut high) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        for index in triangles.cluster(cluster) {
            let [a, b, c] = mesh.corners(triangles.at(index)).map(Vec3A::from_array);
            low = low.min(a.min(b.min(c)));
            high = high.max(a.max(b.max(c)));
        }
        // Halved first: their sum may overflow.
        let centre = (0.5 * low + 0.5 * high).to_array();
        let [from_low, from_high] = [low, high].map(|end| (exact(end.to_array()) - exact(centre)).abs());
        // Larger by more than the roundings of squares, sums and root.
        let radius = from_low.max(from_high).length() * (1.0 + 1e-15);
        Self { centre, radius: rounded_up(radius) }
    }

    /// The lowest and the highest coordinates. All points of the ball that are floats lie between them, however they
    /// are rounded.
    pub fn ends(&self) -> [[f64; 3]; 2] {
        [-1.0, 1.0].map(|side| self.centre.map(|x| f64::from(x) + side * f64::from(self.radius)))
    }

    /// The box around it, rounded to floats.
    pub fn extent(&self) -> Extent {
        Extent::of(self.ends().map(|end| end.map(|x| x as f32)))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::job::Context;
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
            for (cluster, triangles) in triangles.chunks(CLUSTER).enumerate() {
                let (areas, longest) = measures.triangles().measure(&mesh, cluster);
                let triangles_of = measures.triangles();
                let at = |level| run(level, Measure { triangles: triangles_of, mesh: &mesh, cluster });
                assert!(Level::available().into_iter().all(|level| at(level) == (areas, longest)));
                for (lane, &triangle) in triangles.iter().enumerate() {
                    assert!((areas[lane] / mesh.triangle_area(triangle) - 1.0).abs() < 1e-12);
                    assert!((longest[lane].sqrt() / longest_edge(&mesh, triangle) - 1.0).abs() < 1e-12);
                }
                assert!((measures.areas[cluster] / areas.iter().sum::<f64>() - 1.0).abs() < 1e-12);
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

    /// Clusters of all sizes that floats have, down to points.
    #[test]
    fn each_ball_holds_its_cluster_and_not_much_more() {
        let mut rng = Rng::at(6, Draw::Probe, &[]);
        for size in [1e-44, 1e-20, 1.0, 3e38] {
            let positions: Vec<[f32; 3]> = (0..300)
                .map(|i| [(); 3].map(|()| (size * (0.5 + i as f64 / 700.0 - 0.1 * rng.unit())) as f32))
                .collect();
            let mesh = Mesh::new(positions, (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap();
            let (balls, triangles) = (Balls::default(), Triangles::All(100));
            let get = |is_pass: bool, largest: f64| {
                let get = if is_pass { Balls::for_pass } else { Balls::get };
                Context::new(1).unwrap().run(None, |job| get(&balls, job, &mesh, triangles, largest)).unwrap()
            };
            assert!(get(true, size).is_none(), "in the first pass");
            assert!(get(true, 1e-3 * size).is_none() && get(false, 1e-3 * size).is_none(), "larger than asked for");
            for is_pass in [true, false] {
                let balls = get(is_pass, size).unwrap();
                assert_eq!(balls.len(), triangles.clusters());
                for (cluster, ball) in balls.iter().enumerate() {
                    let mut corners = triangles.cluster(cluster).flat_map(|index| mesh.exact_corners(index as u32));
                    let farthest =
                        corners.clone().map(|corner| corner.distance(exact(ball.centre))).fold(0.0, f64::max);
                    assert!(farthest <= ball.radius.into(), "{ball:?} {farthest}");
                    let [low, high] = ball.ends().map(DVec3::from_array);
                    assert!(corners.all(|corner| low.cmple(corner).all() && corner.cmple(high).all()));
                    assert!(f64::from(ball.radius) <= 2.0 * farthest + 3e-45, "{ball:?} {farthest}");
                }
            }
        }
    }
}
