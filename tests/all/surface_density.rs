//! Relaxation on surfaces to a density, judged as in the plane: distances, numbers, and empty places that stay empty.

use std::ops::ControlFlow;

use azulejo::dcr::Stopped;
use azulejo::dcr::surface::{Options, Report, relax, relax_with_density};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Density, Radius, Scale, Texture};
use azulejo::{Context, Error, Points};

use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::surface_oracle as oracle;
use crate::common::triangle::distance;

fn mesh((positions, triangles): Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

/// A unit square of `side`² cells.
fn square(side: u32) -> Mesh {
    let at = |i: u32| i as f32 / side as f32;
    let positions = (0..=side).flat_map(|y| (0..=side).map(move |x| [at(x), at(y), 0.0])).collect();
    let corner = |x: u32, y: u32| y * (side + 1) + x;
    let cells = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let halves = |(x, y)| {
        let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
        [[a, b, d], [a, d, c]]
    };
    Mesh::new(positions, cells.flat_map(halves).collect()).unwrap()
}

/// Random samples of the area.
fn random(mesh: &Mesh, count: usize, seed: u64) -> Points<3> {
    let mut random = Random::new(seed);
    let mut ends = Vec::new();
    let mut total = 0.0;
    for triangle in 0..mesh.triangles().len() as u32 {
        total += mesh.triangle_area(triangle);
        ends.push(total);
    }
    let mut samples = Points::default();
    for _ in 0..count {
        let place = f64::from(random.unit()) * total;
        let triangle = ends.partition_point(|&end| end <= place).min(ends.len() - 1) as u32;
        let (along, across) = (random.unit().sqrt(), random.unit());
        let uv = [along * (1.0 - across), along * across];
        samples.triangles.push(triangle);
        samples.barycentrics.push(uv);
        samples.positions.push(mesh.point(triangle, uv));
    }
    samples
}

/// A maximal set with a density at vertices, of about so many samples.
fn maximal(mesh: &Mesh, density: Density, count: f64) -> Points<3> {
    let options = adaptive::Options::new(Radius::Density { density, scale: Scale::Count(count) });
    adaptive::sample(&Context::new(2).unwrap(), mesh, &options, None).unwrap().0
}

fn run_steps(mesh: &Mesh, samples: &Points<3>, density: Density, steps: u32) -> (Points<3>, Report) {
    let options = Options::default().max_iterations(steps);
    let runs = [1, 3].map(|threads| {
        let (context, barycentrics) = (Context::new(threads).unwrap(), &samples.barycentrics);
        relax_with_density(&context, mesh, &samples.triangles, barycentrics, density, &options, None).unwrap()
    });
    let [one, three] = runs;
    assert_eq!(one, three, "depends on the number of threads");
    assert_eq!(oracle::misplaced(mesh, &one.0), None);
    one
}

fn run(mesh: &Mesh, samples: &Points<3>, density: Density) -> (Points<3>, Report) {
    run_steps(mesh, samples, density, Options::default().max_iterations)
}

type Function<'a> = dyn Fn([f64; 3]) -> f64 + Sync + 'a;

/// The density of a place, and the mean of it over a mesh by random places.
struct Known<'a> {
    at: &'a Function<'a>,
    /// The share of the samples that belongs into each of ten bands along x.
    shares: [f64; 10],
    mean: f64,
    low: f64,
    high: f64,
}

impl<'a> Known<'a> {
    fn new(mesh: &Mesh, at: &'a Function<'a>) -> Self {
        let along: Vec<f64> = mesh.positions().iter().map(|place| place[0].into()).collect();
        let (low, high) = (along.iter().copied().fold(1e9, f64::min), along.iter().copied().fold(-1e9, f64::max));
        let mut known = Self { at, shares: [0.0; 10], mean: 0.0, low, high };
        let probes = random(mesh, 300_000, 99).positions;
        probes.iter().for_each(|&probe| known.shares[known.band(probe)] += at(probe.map(f64::from)));
        let total: f64 = known.shares.iter().sum();
        known.mean = total / probes.len() as f64;
        known.shares.iter_mut().for_each(|share| *share /= total);
        known
    }

    fn band(&self, place: [f32; 3]) -> usize {
        (((f64::from(place[0]) - self.low) / (self.high - self.low) * 10.0) as usize).min(9)
    }

    /// The number of samples in each band over the number that belongs there.
    fn excess(&self, samples: &Points<3>) -> [f64; 10] {
        let mut counts = [0.0; 10];
        samples.positions.iter().for_each(|&place| counts[self.band(place)] += 1.0);
        std::array::from_fn(|band| counts[band] / samples.len() as f64 / self.shares[band])
    }

    /// The smallest distance over the mean of the two spacings, by all pairs.
    fn rho(&self, mesh: &Mesh, samples: &Points<3>) -> f64 {
        let d_max = (2.0 * mesh.area() / (3f64.sqrt() * samples.len() as f64)).sqrt();
        let spacing = |i: usize| d_max * (self.mean / (self.at)(samples.positions[i].map(f64::from))).sqrt();
        let spacings: Vec<f64> = (0..samples.len()).map(spacing).collect();
        let pairs = (0..samples.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let relative = |(i, j): (usize, usize)| {
            distance(samples.positions[i], samples.positions[j]) / (0.5 * (spacings[i] + spacings[j]))
        };
        pairs.map(relative).fold(f64::INFINITY, f64::min)
    }
}

/// From random samples of the area, from a maximal set of the density, and from samples that are all on one triangle.
#[test]
fn densities_are_met_and_samples_spread_wherever_they_began() {
    for mesh in [square(60), mesh(meshes::fine_torus(120, 60))] {
        let low = mesh.positions().iter().map(|place| place[0]).fold(f32::INFINITY, f32::min);
        let share = move |[x, ..]: [f64; 3]| (x - f64::from(low)) / (2.0 * f64::from(low).abs()).max(1.0);
        let ramp = move |place| 1.0 + 15.0 * share(place);
        let step = move |place| if share(place) < 0.5 { 1.0 } else { 4.0 };
        let half = move |place| if share(place) < 0.5 { 0.0 } else { 3.0 };
        let densities: [(_, &Function, f64); 3] = [("ramp", &ramp, 16.0), ("step", &step, 4.0), ("half", &half, 3.0)];
        for (name, at, largest) in densities {
            let known = Known::new(&mesh, at);
            let mut clustered = random(&mesh, 3000, 2);
            clustered.triangles.fill(7);
            let starts = [random(&mesh, 3000, 1), clustered, maximal(&mesh, Density::AtVertices(at), 3000.0)];
            for (start, samples) in starts.iter().enumerate() {
                let (relaxed, report) = run(&mesh, samples, Density::Function { at, largest, slope: 1e6 });
                let rho = known.rho(&mesh, &relaxed);
                assert!((report.rho / rho - 1.0).abs() < 0.01, "{name} {start}: {rho} {report:?}");
                assert!(report.rho > 0.82, "{name} {start}: {report:?}");
                assert!(relaxed.positions.iter().all(|place| at(place.map(f64::from)) > 0.0), "{name} {start}");
                // Samples beside a step are as those of a maximal set, which it begins with.
                let excess = known.excess(&relaxed);
                for (band, excess) in excess.into_iter().enumerate().filter(|(_, excess)| !excess.is_nan()) {
                    let limit = if name == "step" && (3..6).contains(&band) { 0.25 } else { 0.1 };
                    assert!((excess - 1.0).abs() < limit, "{name} {start} {band}: {excess}");
                }
            }
        }
    }
}

/// By vertices, at vertices, by a function and by images.
#[test]
fn a_density_is_the_same_however_it_is_given() {
    let mesh = square(40);
    let at = |[x, ..]: [f64; 3]| 1.0 + 3.0 * x;
    let values: Vec<f32> = mesh.positions().iter().map(|place| at(place.map(f64::from)) as f32).collect();
    let pixels: Vec<f32> = (0..2 * 101).map(|i| at([f64::from(i % 101) / 100.0, 0.0, 0.0]) as f32).collect();
    let places: Vec<[f32; 2]> = mesh.positions().iter().map(|&[x, y, _]| [(x * 100.0 + 0.5) / 101.0, y]).collect();
    let corners: Vec<_> = mesh.triangles().iter().map(|corners| corners.map(|i| places[i as usize])).collect();
    let image = |texture| Density::Image { values: &pixels, width: 101, height: 2, texture };
    let samples = random(&mesh, 1500, 4);
    let expected = run(&mesh, &samples, Density::PerVertex(&values));
    for density in [
        Density::AtVertices(&at),
        Density::Function { at: &at, largest: 4.0, slope: 3.0 },
        image(Texture::PerVertex(&places)),
        image(Texture::PerCorner(&corners)),
    ] {
        let (relaxed, report) = run(&mesh, &samples, density);
        assert!((report.rho - expected.1.rho).abs() < 0.02 && report.rho > 0.83, "{report:?} {:?}", expected.1);
        let excess = Known::new(&mesh, &at).excess(&relaxed);
        assert!(excess.into_iter().all(|excess| (excess - 1.0).abs() < 0.08), "{excess:?}");
    }
}

/// A function whose stated largest value is far above all that it gives, and an image whose brightest pixel is nowhere on
/// the mesh.
#[test]
fn largest_values_that_are_nowhere_do_not_matter() {
    let mesh = square(20);
    let one = |_: [f64; 3]| 1.0;
    let pixels: Vec<f32> = (0..64).map(|i| if i == 63 { 1e9 } else { 1.0 }).collect();
    let places: Vec<[f32; 2]> = mesh.positions().iter().map(|&[x, y, _]| [0.1 + 0.5 * x, 0.1 + 0.5 * y]).collect();
    let image = Density::Image { values: &pixels, width: 8, height: 8, texture: Texture::PerVertex(&places) };
    for density in [Density::Function { at: &one, largest: 1e9, slope: 0.0 }, image] {
        let (_, report) = run(&mesh, &random(&mesh, 1000, 6), density);
        assert!(report.rho > 0.82, "{report:?}");
    }
}

/// Samples that lie where none are wanted come one after the other, and go everywhere.
#[test]
fn samples_that_leave_an_empty_place_are_spread_over_all_others() {
    let mesh = square(30);
    let at = |[x, ..]: [f64; 3]| if x < 0.02 { 0.0 } else { 1.0 };
    let density = Density::Function { at: &at, largest: 1.0, slope: 1e6 };
    let mut samples = random(&mesh, 4000, 11);
    let mut order: Vec<usize> = (0..4000).collect();
    order.sort_by(|&a, &b| samples.positions[a][0].total_cmp(&samples.positions[b][0]));
    samples.triangles = order.iter().map(|&i| samples.triangles[i]).collect();
    samples.barycentrics = order.iter().map(|&i| samples.barycentrics[i]).collect();
    let strays = order.iter().take_while(|&&i| samples.positions[i][0] < 0.02).count();
    let (moved, _) = run_steps(&mesh, &samples, density, 1);
    assert!(strays > 50);
    let quarters = moved.positions[..strays].iter().map(|&[x, y, _]| [x, y].map(|x| usize::from(x > 0.5)));
    let mut counts = [[0usize; 2]; 2];
    quarters.for_each(|[x, y]| counts[y][x] += 1);
    assert!(counts.as_flattened().iter().all(|count| count.abs_diff(strays / 4) <= 4), "{strays} {counts:?}");
}

#[test]
fn the_same_density_everywhere_gives_what_none_gives() {
    let mesh = mesh(meshes::fine_torus(60, 30));
    let one = |_: [f64; 3]| 0.3;
    let samples = maximal(&mesh, Density::AtVertices(&one), 2000.0);
    let context = Context::new(2).unwrap();
    let (triangles, barycentrics) = (&samples.triangles, &samples.barycentrics);
    let plain = relax(&context, &mesh, triangles, barycentrics, &Options::default(), None).unwrap().1;
    let (relaxed, report) = run(&mesh, &samples, Density::AtVertices(&one));
    assert!((report.rho - plain.rho).abs() < 0.02 && report.rho > 0.84, "{report:?} {plain:?}");
    assert!((report.rho / report.smallest_distance / (plain.rho / plain.smallest_distance) - 1.0).abs() < 1e-4);
    // No sample is redistributed.
    let d_max = report.smallest_distance / report.rho;
    let moved = relaxed.positions.iter().zip(&samples.positions).map(|(&to, &from)| distance(to, from));
    assert!(moved.fold(0.0, f64::max) < 2.0 * d_max);
}

#[test]
fn samples_where_none_are_wanted_leave_with_the_first_step() {
    let mesh = square(30);
    let at = |[x, y, _]: [f64; 3]| if x > 0.4 && x < 0.6 && y > 0.4 && y < 0.6 { 0.0 } else { 1.0 };
    let density = Density::Function { at: &at, largest: 1.0, slope: 1e6 };
    let samples = random(&mesh, 900, 8);
    let inside = |samples: &Points<3>| samples.positions.iter().filter(|place| at(place.map(f64::from)) == 0.0).count();
    assert!(inside(&samples) > 20);
    let (unmoved, report) = run_steps(&mesh, &samples, density, 0);
    assert!(unmoved.positions == samples.positions && report.iterations == 0);
    for steps in [1, 7, 100] {
        assert_eq!(inside(&run_steps(&mesh, &samples, density, steps).0), 0);
    }
}

/// Needles, a billion times as long as high, whose integral is a sum over as few places as that of any mesh.
#[test]
fn needles_are_integrated_over_few_places() {
    let positions = vec![[0.0, 0.0, 0.0], [1e9, 0.0, 0.0], [0.0, 1e-3, 0.0], [1e9, 0.0, 1e-2], [5.0, 7.0, 1.0]];
    let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 1, 3], [0, 2, 4]]).unwrap();
    let at = |[x, ..]: [f64; 3]| 1.0 + x.abs();
    let (relaxed, _) = run_steps(&mesh, &random(&mesh, 50, 12), Density::AtVertices(&at), 5);
    assert_eq!(relaxed.len(), 50);
}

/// Coincident samples, a few samples, soups, and densities of a few places.
#[test]
fn awkward_samples_and_meshes_are_relaxed() {
    let ridge = |[x, y, z]: [f64; 3]| 1e-9 + (1e3 * (x + y * z)).sin().max(0.0).powi(9);
    for (seed, mesh) in
        [meshes::random_soup(5, 30), meshes::sheets(1e-3), meshes::slivers()].map(mesh).iter().enumerate()
    {
        for count in [0, 1, 2, 60, 400] {
            let mut samples = random(mesh, count, seed as u64);
            samples.triangles.truncate(count);
            let half = count / 2;
            samples.triangles.copy_within(..half, half);
            samples.barycentrics.copy_within(..half, half);
            let (relaxed, report) = run_steps(mesh, &samples, Density::AtVertices(&ridge), 20);
            assert_eq!(relaxed.len(), count);
            assert!(count >= 2 || report.rho == f64::INFINITY, "{report:?}");
        }
    }
}

#[test]
fn a_cancelled_call_returns_its_last_whole_step() {
    let mesh = square(20);
    let (context, samples) = (Context::new(1).unwrap(), random(&mesh, 300, 3));
    let at = |[x, ..]: [f64; 3]| 1.0 + x;
    let progress = |done: f64| if done > 0.4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let options = Options::default();
    let (triangles, barycentrics) = (&samples.triangles, &samples.barycentrics);
    let density = Density::AtVertices(&at);
    let (cancelled, report) =
        relax_with_density(&context, &mesh, triangles, barycentrics, density, &options, Some(&progress)).unwrap();
    assert!(report.stopped == Stopped::Cancelled && (1..100).contains(&report.iterations), "{report:?}");
    assert_eq!(cancelled, run_steps(&mesh, &samples, density, report.iterations).0);
}

#[test]
fn densities_that_are_none_are_refused() {
    let mesh = square(4);
    let samples = random(&mesh, 20, 3);
    let refused = |density: Density| {
        let context = Context::new(1).unwrap();
        let (triangles, barycentrics) = (&samples.triangles, &samples.barycentrics);
        match relax_with_density(&context, &mesh, triangles, barycentrics, density, &Options::default(), None) {
            Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(Density::PerVertex(&[1.0; 3])).0, "vertex_count");
    assert_eq!(refused(Density::PerVertex(&[f32::NAN; 25])).0, "density");
    assert_eq!(refused(Density::PerVertex(&[0.0; 25])).0, "density");
    let steep = |[x, ..]: [f64; 3]| if x > 0.9 { 2.0 } else { 1.0 };
    let (argument, reason) = refused(Density::Function { at: &steep, largest: 1.0, slope: 1.0 });
    assert!(argument == "density" && reason.contains("is not in 0..=1.0"), "{reason}");
    let bad = Density::Function { at: &steep, largest: 0.0, slope: 1.0 };
    assert_eq!(refused(bad).0, "largest");
    let texture = Texture::PerVertex(&[]);
    assert_eq!(refused(Density::Image { values: &[1.0], width: 1, height: 1, texture }).0, "texture");
}
