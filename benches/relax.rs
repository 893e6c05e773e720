//! DCR: time per point and step, on one thread and on four, and their ratio; then whole calls and what they reach, in the
//! plane from KDRT's sets and from starts that are heaped, on meshes and in cuboids.
//!
//! Wall times of a shared machine vary: the least of several runs is printed, and ratios of one program.

#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use azulejo::dcr::{Method, Neighbourhood, Options, Thesis, relax, surface, volume};
use azulejo::kdrt::{self, CountOptions};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY, psp};

/// Steps of the short and of the long run: their difference does not contain the time before the first step.
const STEPS: [u32; 2] = [10, 40];

/// A jittered grid, relaxed a little: sets are like this during most steps.
fn start(side: usize, domain: Domain) -> Vec<[f32; 2]> {
    // The fractions of multiples of the golden ratio and of the root of 2 scatter well enough.
    let jitter = |k: usize, ratio: f64| 0.9 * (k as f64 * ratio).fract();
    let at = |k: usize| {
        let (x, y) = (k % side, k / side);
        [(x as f64 + jitter(k, 0.618_033_988_749_895)) as f32, (y as f64 + jitter(k, 0.414_213_562_373_095)) as f32]
    };
    let grid: Vec<_> = (0..side * side).map(|k| at(k).map(|x| x / side as f32)).collect();
    let options = Options::new(domain, Neighbourhood::Delaunay).max_iterations(10);
    relax(&Context::new(0).unwrap(), &options, &grid, None).unwrap().0
}

/// Nanoseconds per point and step; the steps of a run are scaled down for methods that are slow.
fn nanoseconds(context: &Context, options: &Options, points: &[[f32; 2]], share: u32) -> f64 {
    let steps = STEPS.map(|steps| steps / share);
    let seconds = |max_iterations| {
        let options = options.max_iterations(max_iterations).tolerance(0.0);
        let run = || {
            let start = Instant::now();
            relax(context, &options, black_box(points), None).unwrap();
            start.elapsed().as_secs_f64()
        };
        (0..3).map(|_| run()).fold(f64::INFINITY, f64::min)
    };
    let [short, long] = steps.map(seconds);
    1e9 * (long - short) / (f64::from(steps[1] - steps[0]) * points.len() as f64)
}

fn main() {
    let domain = Domain::unit(Boundary::Periodic);
    let (one, four) = (Context::new(1).unwrap(), Context::new(4).unwrap());
    println!("{:<28} {:>9} {:>12} {:>12} {:>7}", "ns per point and step", "points", "1 thread", "4 threads", "ratio");
    for side in [256, 1000] {
        let points = start(side, domain);
        for (name, neighbourhood) in [("Delaunay", Neighbourhood::Delaunay), ("nearest", Neighbourhood::Nearest)] {
            let momentum = Options::new(domain, neighbourhood);
            let thesis = momentum.method(Method::Thesis(Thesis::default()));
            for (method, options, share) in [("momentum", momentum, 1), ("thesis", thesis, 10)] {
                if side > 256 && method == "thesis" {
                    continue;
                }
                let [alone, together] = [&one, &four].map(|context| nanoseconds(context, &options, &points, share));
                let name = format!("{method}, {name}");
                println!("{name:<28} {:>9} {alone:>12.1} {together:>12.1} {:>7.2}", points.len(), alone / together);
            }
        }
    }
    let contexts = [("1", one), ("4", four)];
    whole_calls(domain, &contexts);
    any_start(&contexts[0].1);
    calls_on_meshes(&contexts);
    calls_in_cuboids(&contexts);
}

/// A million points of KDRT, all steps.
fn whole_calls(domain: Domain, contexts: &[(&str, Context)]) {
    println!(
        "\n{:<28} {:>9} {:>12} {:>7} {:>6} {:>6}",
        "whole calls from KDRT", "threads", "samples/s", "steps", "rho", "cover"
    );
    let count = CountOptions::new(1_000_000).domain(domain).seed(1);
    let points = kdrt::sample_count(&contexts[1].1, &count, None).unwrap().0.positions;
    for (name, neighbourhood) in [("Delaunay", Neighbourhood::Delaunay), ("nearest", Neighbourhood::Nearest)] {
        for (threads, context) in contexts {
            let start = Instant::now();
            let (_, report) = relax(context, &Options::new(domain, neighbourhood), &points, None).unwrap();
            let rate = points.len() as f64 / start.elapsed().as_secs_f64();
            let (steps, rho, cover) = (report.iterations, report.rho, report.relative_covering_radius);
            println!("momentum, {name:<18} {threads:>9} {rate:>12.0} {steps:>7} {rho:>6.3} {cover:>6.3}");
        }
    }
}

/// Whole calls from heaped starts, against one from random points.
fn any_start(context: &Context) {
    let random = |k: usize| [0.754_877_666_246_693, 0.569_840_290_998_053].map(|ratio| scattered(k as f64 * ratio));
    // The part of the domain that they are in.
    let starts = [
        ("random", [1.0, 1.0]),
        ("corner", [0.05, 0.05]),
        ("line", [1.0, 0.0]),
        ("half", [0.5, 1.0]),
        ("place", [0.0, 0.0]),
    ];
    println!("\n{:<28} {:>9} {:>12} {:>7} {:>6} {:>6}", "from", "points", "seconds", "ratio", "rho", "cover");
    for count in [1000, 10_000, 100_000] {
        for max in [[1.0, 1.0], [10.0, 0.1]] {
            let domain = Domain { max, ..Domain::unit(Boundary::Periodic) };
            let mut expected = None;
            for (name, share) in starts {
                let at = |k: usize| {
                    let place = random(k);
                    std::array::from_fn(|axis| {
                        ((place[axis] * share[axis] * max[axis]) as f32).min((max[axis] as f32).next_down())
                    })
                };
                let points: Vec<[f32; 2]> = (0..count).map(at).collect();
                let options = Options::new(domain, Neighbourhood::Delaunay);
                let run = || {
                    let start = Instant::now();
                    let (_, report) = relax(context, &options, black_box(&points), None).unwrap();
                    (start.elapsed().as_secs_f64(), report)
                };
                let (seconds, report) =
                    (0..3).map(|_| run()).min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are three");
                let ratio = seconds / *expected.get_or_insert(seconds);
                let name = format!("{name}, {} by {}", max[0], max[1]);
                println!(
                    "{name:<28} {count:>9} {seconds:>12.4} {ratio:>7.2} {:>6.3} {:>6.3}",
                    report.rho, report.relative_covering_radius
                );
            }
        }
    }
}

/// A number from 0 to 1 that looks random.
fn scattered(x: f64) -> f64 {
    ((x.fract() * 12.9898 + x).sin() * 43_758.547).rem_euclid(1.0)
}
/// Maximal sets on a torus of few and of many triangles, 100 steps, everything in.
fn calls_on_meshes(contexts: &[(&str, Context)]) {
    println!(
        "\n{:<28} {:>9} {:>9} {:>9} {:>12} {:>6}",
        "whole calls on meshes", "samples", "triangles", "threads", "ns per step", "rho"
    );
    for (around_hole, around_tube, count) in [(400, 100, 1e5), (1500, 400, 1e5), (1500, 400, 2e3)] {
        let (positions, triangles) = meshes::fine_torus(around_hole, around_tube);
        let mesh = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
        let radius = (MAXIMAL_DENSITY * mesh.area() / count).sqrt();
        let samples = psp::sample(&contexts[1].1, &mesh, &psp::Options::new(radius), None).unwrap().0;
        for (threads, context) in contexts {
            let options = surface::Options::default().tolerance(0.0);
            let run = || {
                let start = Instant::now();
                let (_, report) =
                    surface::relax(context, &mesh, &samples.triangles, &samples.barycentrics, &options, None).unwrap();
                (start.elapsed().as_secs_f64(), report)
            };
            let (seconds, report) = (0..3).map(|_| run()).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            let nanoseconds = 1e9 * seconds / (samples.len() as f64 * f64::from(report.iterations));
            let (count, triangles) = (samples.len(), mesh.triangles().len());
            println!("{:<28} {count:>9} {triangles:>9} {threads:>9} {nanoseconds:>12.1} {:>6.3}", "torus", report.rho);
        }
    }
}

/// Random points of the unit cube, everything in.
fn calls_in_cuboids(contexts: &[(&str, Context)]) {
    println!(
        "\n{:<28} {:>9} {:>9} {:>9} {:>12} {:>6}",
        "whole calls in cuboids", "points", "steps", "threads", "ns per step", "rho"
    );
    for (count, steps) in [(4096, 100), (32_768, 100), (32_768, 500), (1_000_000, 100)] {
        let place = |k: usize| {
            [0.618_033_988_749_895, 0.414_213_562_373_095, 0.302_775_637_731_995]
                .map(|ratio| scattered(k as f64 * ratio) as f32)
        };
        let points: Vec<[f32; 3]> = (1..=count).map(place).collect();
        for (name, boundary) in [("periodic", Boundary::Periodic), ("bounded", Boundary::Bounded)] {
            for (threads, context) in contexts {
                let options = volume::Options::new(Domain::unit(boundary)).max_iterations(steps).tolerance(0.0);
                let start = Instant::now();
                let (_, report) = volume::relax(context, &options, black_box(&points), None).unwrap();
                let nanoseconds = 1e9 * start.elapsed().as_secs_f64() / (count as f64 * f64::from(report.iterations));
                println!("{name:<28} {count:>9} {steps:>9} {threads:>9} {nanoseconds:>12.1} {:>6.3}", report.rho);
            }
        }
    }
}
