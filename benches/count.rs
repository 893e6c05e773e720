//! Exactly N samples: `kdrt::sample_count` beside the two methods of thesis §2.5.3, as a table.
//!
//! *Insertion* (after Kanamori et al. 2011) starts with too few samples and puts the others at the centres of the
//! largest Delaunay circles. *Elimination* (after Yuksel 2015) starts with too many and drops those of the largest
//! weight. Both start from KDRT sets of the same radius as tuning; by chance these have some samples too few or too
//! many. Lengths are in units of d_max, the distance in the hexagonal arrangement of as many samples: rho is the
//! smallest distance of two samples, cover the largest distance of the torus from them. A set is maximal if cover <=
//! rho.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::time::Instant;

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::smallest_distance_2d;
use azulejo::kdrt::{CountOptions, Options, sample, sample_count};
use azulejo::{Boundary, Context, Domain};
use spade::{DelaunayTriangulation, Point2, Triangulation};

const DOMAIN: Domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary: Boundary::Periodic };

fn main() {
    let context = Context::new(0).expect("threads");
    println!("{:>9} {:>5} {:>12} {:>8} {:>8} {:>9} {:>8}", "samples", "seed", "way", "rho", "cover", "cover/rho", "s");
    for (count, seeds) in [(1_000, 5), (10_000, 5), (100_000, 3), (1_000_000, 2)] {
        for seed in 0..seeds {
            row(&context, count, seed, "tuning", || {
                let options = CountOptions::new(count as u64).domain(DOMAIN).seed(seed);
                sample_count(&context, &options, None).expect("a good domain").0.positions
            });
            row(&context, count, seed, "insertion", || inserted(start(&context, count, seed, Ordering::Less), count));
            row(&context, count, seed, "elimination", || {
                eliminated(start(&context, count, seed, Ordering::Greater), count)
            });
        }
    }
}

fn row(context: &Context, count: usize, seed: u64, way: &str, make: impl Fn() -> Vec<[f32; 2]>) {
    let start = Instant::now();
    let samples = make();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(samples.len(), count);
    let distance = DOMAIN.hexagonal_distance(count);
    let rho = smallest_distance_2d(context, &DOMAIN, &samples, None).expect("samples of the domain") / distance;
    let cover = covering_radius_2d(context, &DOMAIN, &samples, None).expect("samples of the domain") / distance;
    println!("{count:>9} {seed:>5} {way:>12} {rho:>8.4} {cover:>8.4} {:>9.4} {seconds:>8.3}", cover / rho);
}

/// A KDRT set with fewer or more samples than `count`, at the radius at which tuning starts too.
fn start(context: &Context, count: usize, seed: u64, wanted: Ordering) -> Vec<[f32; 2]> {
    let radius = (0.69656 * 1.0045 / count as f64).sqrt();
    let set = |attempt: u64| {
        let options = Options::new(radius).domain(DOMAIN).seed(seed + (attempt << 32));
        sample(context, &options, None).expect("a good domain").positions
    };
    (0..).map(set).find(|samples| samples.len().cmp(&count) == wanted).expect("either happens")
}

/// The distance on the torus, squared.
fn distance_squared(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [dx, dy] = DOMAIN.offset(a, b);
    dx * dx + dy * dy
}

/// Adds the centres of the largest circles, a pass of circles that do not meet each other at a time.
fn inserted(mut samples: Vec<[f32; 2]>, count: usize) -> Vec<[f32; 2]> {
    while samples.len() < count {
        let mut circles = circles(&samples);
        circles.sort_by(|a, b| b.0.total_cmp(&a.0));
        let first = samples.len();
        for (radius_squared, centre) in circles {
            let meets = |other: &[f32; 2]| distance_squared(other.map(f64::from), centre) < 4.0 * radius_squared;
            if samples.len() < count && !samples[first..].iter().any(meets) {
                samples.push(centre.map(|x| (x as f32).min(1.0f32.next_down())));
            }
        }
    }
    samples
}

/// The squared radius and the centre of each Delaunay circle of the torus.
fn circles(samples: &[[f32; 2]]) -> Vec<(f64, [f64; 2])> {
    // Triangles are small: what is near a boundary and its images are enough beyond it.
    let margin = 4.0 / (samples.len() as f64).sqrt();
    let turns = [-1.0, 0.0, 1.0];
    let images = samples.iter().flat_map(|sample| {
        let image = |[x, y]: [f64; 2]| Point2::new(f64::from(sample[0]) + x, f64::from(sample[1]) + y);
        turns.into_iter().flat_map(move |y| turns.map(|x| image([x, y])))
    });
    let near = |point: &Point2<f64>| [point.x, point.y].iter().all(|x| (-margin..1.0 + margin).contains(x));
    let points: Vec<_> = images.filter(near).collect();
    let triangulation = DelaunayTriangulation::<_>::bulk_load(points).expect("finite points");
    let circle = |face: spade::handles::FaceHandle<'_, _, Point2<f64>, (), (), ()>| {
        let (centre, radius_squared) = face.circumcircle();
        (radius_squared, [centre.x, centre.y])
    };
    let inside = |circle: &(f64, [f64; 2])| circle.1.iter().all(|x| (0.0..1.0).contains(x));
    triangulation.inner_faces().map(circle).filter(inside).collect()
}

/// A sample in the heap of [`eliminated`], with its weight when it was put there.
struct Entry(f64, usize);

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

/// Weighted sample elimination with the weights of Yuksel 2015, §2 and §3.
fn eliminated(samples: Vec<[f32; 2]>, count: usize) -> Vec<[f32; 2]> {
    let longest = (1.0 / (2.0 * 3f64.sqrt() * count as f64)).sqrt();
    let shortest = longest * (1.0 - (count as f64 / samples.len() as f64).powf(1.5)) * 0.65;
    let neighbours = neighbours(&samples, 2.0 * longest);
    let weight = |distance: f64| (1.0 - distance.clamp(2.0 * shortest, 2.0 * longest) / (2.0 * longest)).powi(8);
    let mut weights: Vec<f64> =
        neighbours.iter().map(|near| near.iter().map(|&(_, distance)| weight(distance)).sum()).collect();
    let mut heap: BinaryHeap<_> = weights.iter().enumerate().map(|(i, &weight)| Entry(weight, i)).collect();
    let mut left = vec![true; samples.len()];
    let mut superfluous = samples.len() - count;
    while superfluous > 0 {
        let Entry(old, heaviest) = heap.pop().expect("more samples than wanted");
        // Entries stay behind when weights fall.
        if !left[heaviest] || old != weights[heaviest] {
            continue;
        }
        left[heaviest] = false;
        superfluous -= 1;
        for &(near, distance) in &neighbours[heaviest] {
            weights[near] -= weight(distance);
            heap.push(Entry(weights[near], near));
        }
    }
    samples.into_iter().zip(left).filter_map(|(sample, left)| left.then_some(sample)).collect()
}

/// The samples around each one that are nearer than `reach`, with their distances.
fn neighbours(samples: &[[f32; 2]], reach: f64) -> Vec<Vec<(usize, f64)>> {
    let side = (1.0 / reach).floor() as usize;
    let bucket = |sample: [f32; 2]| sample.map(|x| ((f64::from(x) * side as f64) as usize).min(side - 1));
    let mut buckets = vec![Vec::new(); side * side];
    for (i, &sample) in samples.iter().enumerate() {
        let [column, row] = bucket(sample);
        buckets[row * side + column].push(i);
    }
    let near = |(i, &sample): (usize, &[f32; 2])| {
        let [column, row] = bucket(sample);
        let around = [side - 1, 0, 1].into_iter().flat_map(|y| [side - 1, 0, 1].map(|x| [x, y]));
        let others = around.flat_map(|[x, y]| &buckets[(row + y) % side * side + (column + x) % side]);
        let distances = others
            .filter(|&&j| j != i)
            .map(|&j| (j, distance_squared(sample.map(f64::from), samples[j].map(f64::from)).sqrt()));
        distances.filter(|&(_, distance)| distance < reach).collect()
    };
    samples.iter().enumerate().map(near).collect()
}
