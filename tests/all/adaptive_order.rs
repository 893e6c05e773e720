//! Progressive order where the radius varies, held against its definition by plain checkers.

use azulejo::mesh::Mesh;
use azulejo::psp::Report;
use azulejo::psp::adaptive::{self, Density, Options, Radius, Scale};
use azulejo::psp::{DEFAULT_QUOTIENT, TOLERANCE};
use azulejo::{Context, Error, Given, Order, Points};

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::Field;
use crate::common::meshes;
use crate::common::random::Random;
use crate::common::triangle::distance;

type Point = [f64; 3];

/// More than the documented tolerance on the meshes below, which are a few units long: floats of 4 to 8 are 2^-21 apart.
const WITHIN: f64 = 1e-5;
const _: () = assert!(WITHIN > 2.0 * TOLERANCE * 4.8e-7);

fn mesh((positions, triangles): meshes::Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

/// A rectangle 4 wide and 1 high, in as many strips.
fn strips(count: u32) -> Mesh {
    let x = |column: u32| 4.0 * column as f32 / count as f32;
    let positions = (0..=count).flat_map(|column| [[x(column), 0.0, 0.0], [x(column), 1.0, 0.0]]).collect();
    let triangles = (0..count).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]).collect();
    Mesh::new(positions, triangles).unwrap()
}

/// 1:50 along the rectangle.
fn ramp([x, ..]: Point) -> f64 {
    (1.0 + 49.0 * x / 4.0) / 50.0
}

fn at_vertices(mesh: &Mesh, value: impl Fn(Point) -> f64) -> Vec<f32> {
    mesh.positions().iter().map(|position| value(position.map(f64::from)) as f32).collect()
}

fn of_density(density: Density, scale: Scale) -> Options {
    Options::new(Radius::Density { density, scale }).order(Order::Progressive)
}

/// A set in progressive order, on one thread and on two.
fn sample(mesh: &Mesh, options: &Options) -> (Points<3>, Report) {
    let [(set, report), (again, _)] =
        [1, 2].map(|threads| adaptive::sample(&Context::new(threads).unwrap(), mesh, options, None).unwrap());
    assert_eq!(set, again, "depends on the number of threads");
    (set, report)
}

fn prefix(samples: &Points<3>, count: usize) -> Points<3> {
    let mut first = samples.clone();
    first.positions.truncate(count);
    first.normals.truncate(count);
    first.triangles.truncate(count);
    first.barycentrics.truncate(count);
    first.ranks.truncate(count);
    first
}

/// The radii of the samples where all are multiplied with 1.
fn relative(set: &Points<3>, report: &Report) -> Vec<f64> {
    set.radii.iter().map(|radius| radius / report.radius).collect()
}

/// Ranks never rise, and no sample is nearer to one before it than its rank allows. So all prefixes keep their ranks.
fn check_ranks(set: &Points<3>, report: &Report, cosine: f64) {
    let Points { positions, ranks, normals, .. } = set;
    let radii = relative(set, report);
    assert_eq!(ranks.len(), positions.len());
    assert!(ranks.is_sorted_by(|a, b| a >= b) && ranks.iter().all(|&rank| f64::from(rank.next_up()) >= report.radius));
    let sees = |i: usize, j: usize| {
        let dot: f64 = (0..3).map(|axis| f64::from(normals[i][axis]) * f64::from(normals[j][axis])).sum();
        cosine == -1.0 || normals[i] == normals[j] || dot >= cosine
    };
    for i in 1..ranks.len() {
        let ratio = |j: usize| distance(positions[i], positions[j]) / (0.5 * (radii[i] + radii[j]));
        let least = (0..i).filter(|&j| sees(i, j)).map(ratio).fold(f64::INFINITY, f64::min);
        let rank = f64::from(ranks[i]);
        assert!(least >= rank * (1.0 - 1e-15), "{i}: {rank} and {least}");
    }
    // Nor do two conflict at the radii that are returned.
    assert_eq!(oracle::conflict(set, &set.radii, cosine), None);
}

/// The largest ratio of cover and rank that a prefix may have. Ranks are rounded down.
fn ratio(quotient: f64, count: usize) -> f64 {
    (1.0 + 2e-7) * if count < Order::FIRST_COUNT { quotient.powi(2).max(2.0) } else { quotient }
}

/// Some prefixes, the whole set among them.
fn counts(len: usize) -> impl Iterator<Item = usize> {
    [2, 3, 5, 9, 20, 60, 99, 100, 101, 150, 333, 700, 1500, 3000].into_iter().filter(move |&i| i < len).chain([len])
}

/// Every prefix covers the surface, where radii are those of a field of relative radii.
fn check_cover(mesh: &Mesh, set: &Points<3>, report: &Report, quotient: f64, field: &Field, cosine: f64) {
    let radii = relative(set, report);
    for count in counts(radii.len()).filter(|&count| set.ranks[count - 1].is_finite()) {
        let within = ratio(quotient, count) * f64::from(set.ranks[count - 1]);
        let scaled: Vec<_> = radii[..count].iter().map(|radius| within * radius).collect();
        let first = prefix(set, count);
        let gap = match field {
            Field::Function(at, slope) => {
                let at = |place| within * at(place);
                oracle::gap(mesh, &Field::Function(&at, within * slope), &first, &scaled, cosine, WITHIN)
            }
            Field::PerVertex(values) => {
                let values: Vec<f32> = values.iter().map(|&value| (within * f64::from(value)) as f32).collect();
                oracle::gap(mesh, &Field::PerVertex(&values), &first, &scaled, cosine, WITHIN)
            }
            Field::DensityPerVertex(_) => unreachable!("densities are probed"),
        };
        assert_eq!(gap, None, "the first {count} do not cover within {within}");
    }
}

/// Random places of density above 0 are as near as prefixes promise; the radius of a place is `1 / sqrt(density)`.
fn probe(mesh: &Mesh, set: &Points<3>, report: &Report, density: impl Fn(Point) -> f64, seed: u64) {
    let (radii, mut random, mut probes) = (relative(set, report), Random::new(seed), 0);
    let ranks = &set.ranks;
    while probes < 3000 {
        let triangle = (random.unit() * mesh.triangles().len() as f32) as u32;
        let [s, t] = [random.unit(), random.unit()];
        let uv = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
        let place = mesh.point(triangle.min(mesh.triangles().len() as u32 - 1), uv);
        let wanted = density(place.map(f64::from));
        if wanted > 0.0 {
            probes += 1;
            let radius = 1.0 / wanted.sqrt();
            let mut nearest = f64::INFINITY;
            for (i, &position) in set.positions.iter().enumerate() {
                nearest = nearest.min((distance(place, position) - WITHIN) / (0.5 * (radius + radii[i])));
                let within = ratio(DEFAULT_QUOTIENT, i + 1) * f64::from(ranks[i]);
                assert!(i == 0 || nearest <= within, "{place:?}: {nearest} after {}, {within}", i + 1);
            }
        }
    }
}

#[test]
fn every_prefix_is_a_set_of_its_rank_by_a_density_that_falls_to_a_fiftieth() {
    // Relative radii are 1 / sqrt(density), of this slope at most.
    let slope = 0.5 * 0.02f64.powf(-1.5) * 49.0 / 200.0;
    let at = |place| 1.0 / ramp(place).sqrt();
    let field = Field::Function(&at, slope);
    for (mesh, seed) in [(strips(1), 0), (strips(60), 1), (strips(60), 2)] {
        let values = at_vertices(&mesh, ramp);
        for density in [Density::PerVertex(&values), Density::Function { at: &ramp, largest: 1.0, slope: 0.25 }] {
            let (set, report) = sample(&mesh, &of_density(density, Scale::Count(2000.0)).seed(seed));
            assert_eq!((set.len(), report.samples), (2000, 2000));
            assert!(report.covering_radius.unwrap() <= DEFAULT_QUOTIENT * report.radius * (1.0 + 1e-6));
            assert_eq!(report.accepted + report.conflicts, report.darts);
            check_ranks(&set, &report, -1.0);
            check_cover(&mesh, &set, &report, DEFAULT_QUOTIENT, &field, -1.0);
        }
    }
}

#[test]
fn sets_of_smaller_counts_are_prefixes_to_the_bit() {
    let mesh = mesh(meshes::torus());
    let density = |[x, _, z]: Point| (x - 0.5 * z + 0.3).max(0.0);
    let values = at_vertices(&mesh, density);
    for (seed, quotient) in [(3, DEFAULT_QUOTIENT), (4, 1.5), (5, 1.02)] {
        let options =
            |count: f64| of_density(Density::PerVertex(&values), Scale::Count(count)).seed(seed).quotient(quotient);
        let (whole, _) = sample(&mesh, &options(3000.0));
        check_ranks(&whole, &sample(&mesh, &options(3000.0)).1, -1.0);
        for count in [1, 2, 7, 99, 100, 101, 640, 1999, 2999] {
            let (set, report) = sample(&mesh, &options(count as f64));
            assert_eq!(set.len(), count);
            assert_eq!(set.ranks, whole.ranks[..count]);
            assert_eq!(set.positions, whole.positions[..count]);
            assert_eq!(set.triangles, whole.triangles[..count]);
            assert_eq!(set.barycentrics, whole.barycentrics[..count]);
            let last = f64::from(whole.ranks[count - 1]);
            assert!(count == 1 || report.radius == last, "the radius at density 1 is the last rank");
            let scale = report.radius / f64::from(*whole.ranks.last().unwrap());
            let pairs = set.radii.iter().zip(&whole.radii);
            assert!(pairs.into_iter().all(|(a, b)| (a / (b * scale) - 1.0).abs() < 1e-12));
        }
        // A set by its radius shares the levels above.
        let radius = f64::from(whole.ranks[1500]);
        let (by_radius, report) = sample(
            &mesh,
            &of_density(Density::PerVertex(&values), Scale::Radius(radius)).seed(seed).quotient(quotient),
        );
        assert_eq!(report.radius, radius);
        let common = whole.ranks.iter().filter(|&&rank| f64::from(rank) >= quotient * radius).count();
        assert!(common > 100 && by_radius.positions[..common] == whole.positions[..common]);
        check_ranks(&by_radius, &report, -1.0);
    }
}

/// Nothing stands where the density is 0, and all else is covered by every prefix.
#[test]
fn zeros_stay_empty_and_what_is_beside_them_is_covered() {
    let mesh = mesh(meshes::sphere());
    for seed in 0..3 {
        let cap = |[_, _, z]: Point| (z - 0.2).max(0.0);
        let (set, report) = sample(&mesh, &of_density(Density::AtVertices(&cap), Scale::Count(700.0)).seed(seed));
        // Between vertices, of which some are above the edge of the cap, the density is interpolated.
        assert!(set.len() == 700 && set.positions.iter().all(|position| position[2] > 0.1));
        check_ranks(&set, &report, -1.0);
        probe(&mesh, &set, &report, cap, seed);
    }
}

/// By radii of vertices and by a function the last level is at the radii themselves: ranks are what they are multiplied by.
#[test]
fn radii_of_vertices_and_of_a_function_end_with_a_set_of_these_radii() {
    let torus = mesh(meshes::torus());
    let radius = |[x, _, _]: Point| 0.05 + 0.05 * (x + 1.4);
    let values = at_vertices(&torus, radius);
    let by_vertex = Radius::PerVertex(&values);
    let by_place = Radius::Function { at: &radius, smallest: 0.04, largest: 0.2, slope: 0.0501 };
    for (how, field) in [(by_vertex, Field::PerVertex(&values)), (by_place, Field::Function(&radius, 0.0501))] {
        for quotient in [DEFAULT_QUOTIENT, 1.4] {
            let options = Options::new(how).order(Order::Progressive).seed(8).quotient(quotient);
            let (set, report) = sample(&torus, &options);
            assert_eq!((report.radius, report.covering_radius), (1.0, Some(1.0)));
            assert!(set.len() > 700, "{}", set.len());
            assert_eq!(oracle::wrong_radius(&torus, &field, &set, &set.radii), None);
            check_ranks(&set, &report, -1.0);
            check_cover(&torus, &set, &report, quotient, &field, -1.0);
            assert_eq!(oracle::gap(&torus, &field, &set, &set.radii, -1.0, WITHIN), None, "is not maximal");
        }
    }
}

#[test]
fn sides_of_a_thin_wall_are_ordered_as_if_they_were_far_apart() {
    let (positions, mut triangles) = meshes::sheets(0.01);
    let half = triangles.len() / 2;
    triangles[half..].iter_mut().for_each(|triangle| triangle.swap(1, 2));
    let sheets = mesh((positions, triangles));
    let radius = |[x, ..]: Point| 0.04 + 0.03 * x;
    let how = Radius::Function { at: &radius, smallest: 0.04, largest: 0.0701, slope: 0.031 };
    let options = Options::new(how).order(Order::Progressive).cosine(0.5);
    let (set, report) = sample(&sheets, &options);
    check_ranks(&set, &report, 0.5);
    check_cover(&sheets, &set, &report, DEFAULT_QUOTIENT, &Field::Function(&radius, 0.031), 0.5);
}

#[test]
fn given_samples_keep_their_clearances_in_every_prefix() {
    let torus = mesh(meshes::torus());
    let density = |[x, ..]: Point| 0.5 + 0.3 * x;
    let (positions, clearances): (Vec<_>, Vec<_>) =
        (0..60).map(|i| (torus.positions()[(13 * i) % torus.positions().len()], [0.02, 0.1, 0.3][i % 3])).unzip();
    let balls: Vec<_> = positions.iter().map(|p| p.map(f64::from)).zip(clearances.iter().copied()).collect();
    let by_function = Density::Function { at: &density, largest: 0.93, slope: 0.31 };
    let given = Given::with_clearances(&positions, &clearances);
    let options = of_density(by_function, Scale::Count(900.0)).given(given);
    let (set, report) = sample(&torus, &options);
    assert_eq!(set.len(), 900);
    assert_eq!(oracle::too_near(&set, &balls), None);
    check_ranks(&set, &report, -1.0);
    let radii = relative(&set, &report);
    for count in counts(900) {
        let within = ratio(DEFAULT_QUOTIENT, count) * f64::from(set.ranks[count - 1]);
        let scaled: Vec<_> = radii[..count].iter().map(|radius| within * radius).collect();
        let at = |place| within / density(place).sqrt();
        // Densities are 0.08 and more.
        let field = Field::Function(&at, within * 0.5 * 0.08f64.powf(-1.5) * 0.3);
        let first = prefix(&set, count);
        assert_eq!(oracle::gap_around(&torus, &field, &first, &scaled, -1.0, WITHIN, &balls), None, "{count}");
    }
    let everywhere = Given::with_clearances(&positions[..1], &[100.0]);
    let refused = adaptive::sample(&Context::new(1).unwrap(), &torus, &options.given(everywhere), None).unwrap_err();
    assert_eq!(refused.to_string(), "count: 900, but given samples cover all of the surface");
}

/// The number of the first samples of some sets in each quarter of the ramp, over the number that the density asks for.
fn quarters(sets: &[Points<3>], count: usize) -> [f64; 4] {
    let mut shares = [0.0; 4];
    for position in sets.iter().flat_map(|set| &set.positions[..count]) {
        let quarter = (position[0] as usize).min(3);
        // The integral of the density over it, of that over all.
        let x = quarter as f64;
        let expected = (1.0 + 49.0 * (x + 0.5) / 4.0) / (4.0 * 25.5);
        shares[quarter] += 1.0 / (expected * (count * sets.len()) as f64);
    }
    shares
}

/// Where there are few samples those at the ends of the surface count more: a sample there covers half of its own area. The
/// boundary is 10 long and the surface 4 wide, so with n samples the share of these is some 2.5 / sqrt(n), more where
/// radii are large.
#[test]
fn prefixes_follow_the_density() {
    let mesh = strips(60);
    let values = at_vertices(&mesh, ramp);
    let options = |seed| of_density(Density::PerVertex(&values), Scale::Count(16_000.0)).seed(seed);
    let context = Context::new(2).unwrap();
    let sets: Vec<_> = (0..4).map(|seed| adaptive::sample(&context, &mesh, &options(seed), None).unwrap().0).collect();
    for count in [250, 1000, 4000, 16_000] {
        let shares = quarters(&sets, count);
        println!("{count}: {shares:.3?}");
        let bound = 2.5 / (count as f64).sqrt();
        assert!(shares.iter().all(|share| (share - 1.0).abs() < bound), "{count}: {shares:?}");
    }
}

#[test]
fn what_does_not_go_with_order_is_refused_by_name() {
    let mesh = strips(2);
    let refused = |options: &Options| match adaptive::sample(&Context::new(1).unwrap(), &mesh, options, None) {
        Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
        other => panic!("{other:?}"),
    };
    let values = [1.0; 6];
    let options = |scale| of_density(Density::PerVertex(&values), scale);
    for quotient in [0.0, 1.019, 1.51, f64::NAN] {
        assert_eq!(refused(&options(Scale::Count(9.0)).quotient(quotient)).0, "quotient");
    }
    for count in [0.5, 10.5, 1e10] {
        assert_eq!(refused(&options(Scale::Count(count))).0, "count");
    }
    assert_eq!(refused(&options(Scale::Radius(1e-7))).0, "density", "floats do not carry it");
    // In any order neither matters.
    let any = options(Scale::Count(10.5)).order(Order::Any).quotient(7.0);
    assert!(adaptive::sample(&Context::new(1).unwrap(), &mesh, &any, None).unwrap().0.ranks.is_empty());
    // A mesh so far from the origin that floats carry a few hundred samples.
    let (positions, triangles) = meshes::placed(meshes::plane(), 1.0, 16384.0);
    let far = Mesh::new(positions, triangles).unwrap();
    let ones = vec![1.0; far.positions().len()];
    let many = of_density(Density::PerVertex(&ones), Scale::Count(2000.0));
    let said = adaptive::sample(&Context::new(1).unwrap(), &far, &many, None).unwrap_err().to_string();
    assert!(said.starts_with("count: 2000 samples are more than the mesh can carry: "), "{said}");
}
