//! Sets of the plane, and the sets that other groups start from.

use std::ops::ControlFlow;

use azulejo::dcr::{self, Density};
use azulejo::kdrt::{self, CountOptions, Kind, MergeOptions, Options, Piece, Plane, Progressive};
use azulejo::{Boundary, Classes, Context, Domain, Given, Points, Result, maximal, thin};

use super::list::{List, little_endian};

/// The unit torus and the unit square.
pub const TORUS: Domain = rectangle([0.0; 2], [1.0; 2], Boundary::Periodic);
pub const SQUARE: Domain = rectangle([0.0; 2], [1.0; 2], Boundary::Bounded);

/// A torus far from the origin, where floats are coarse, and a square that is thin.
const FAR: Domain = rectangle([1000.0, -3.0], [1004.0, -1.0], Boundary::Periodic);
const FLAT: Domain = rectangle([-0.5, 0.25], [0.5, 0.28], Boundary::Bounded);

const fn rectangle(min: [f64; 2], max: [f64; 2], boundary: Boundary) -> Domain {
    Domain { min, max, boundary }
}

/// Positions in the plane.
type Positions = Vec<[f32; 2]>;

/// Sets that are relaxed and measured.
pub struct Sets {
    /// A large maximal set, and one of 1000 samples, on the [`TORUS`].
    pub large: Positions,
    pub thousand: Positions,
    /// A maximal set of 30,000 samples of the [`SQUARE`].
    pub bounded: Positions,
    /// Random points of the [`TORUS`].
    pub random: Positions,
}

/// Adds the sums.
pub fn sums(context: &Context, list: &mut List) -> Result<Sets> {
    let maximal =
        |radius, domain, seed| maximal::sample(context, &maximal::Options::new(radius).domain(domain).seed(seed), None);
    list.points("maximal periodic", &maximal(0.01, TORUS, 1)?.positions);
    list.points("maximal bounded", &maximal(0.004, FLAT, 2)?.positions);
    let large = tiled(context, list)?;
    windows(context, list)?;
    ordered(context, list)?;
    around(context, list)?;
    in_classes(context, list)?;
    let (thousand, bounded) = counted(context, list)?;
    merged(context, list)?;
    let random = dcr::scatter(context, &TORUS, &Density::Function(&|_| 1.0), 3000, 20, None)?;
    list.points("scatter", &random);
    thinned(context, &random, list)?;
    Ok(Sets { large, thousand, bounded, random })
}

/// Sets around given samples, with their own clearances and with that of the set, and in order.
fn around(context: &Context, list: &mut List) -> Result<()> {
    let positions: Vec<_> =
        (0..2000u32).map(|i| [(i * 619 % 2003) as f32 / 1900.0, (i * 415 % 1999) as f32 / 1999.0]).collect();
    let clearances: Vec<_> = (0..2000u32).map(|i| 1e-6 * f64::from(i % 500) * f64::from(i % 40)).collect();
    let given = Given::with_clearances(&positions, &clearances);
    let options = Options::new(0.004).given(given).seed(25);
    list.points("around periodic", &kdrt::sample(context, &options.domain(TORUS), None)?.positions);
    list.points(
        "around bounded",
        &kdrt::sample(context, &options.domain(SQUARE).kind(Kind::Plain(0.02)), None)?.positions,
    );
    list.points("around equal", &kdrt::sample(context, &options.given(Given::at(&positions)), None)?.positions);
    let ordered = options.kind(Kind::Progressive(0.004, Progressive::new().quotient(1.3)));
    list.samples("around, ordered", &kdrt::sample(context, &ordered, None)?);
    Ok(())
}

/// Sets in progressive order, with their ranks, whole and in parts.
fn ordered(context: &Context, list: &mut List) -> Result<()> {
    let mut set = |name: &str, set: Points<2>| list.samples(name, &set);
    let options = |radius, levels, domain| Options::progressive(radius, levels).domain(domain);
    let levels = Progressive::new();
    set("ordered periodic", kdrt::sample(context, &options(0.004, levels, TORUS).seed(23), None)?);
    set("ordered bounded", kdrt::sample(context, &options(0.004, levels.quotient(1.5), FLAT).seed(23), None)?);
    let tiled = options(0.003, levels.quotient(1.2).coarsest(0.005), SQUARE).seed(23);
    set("ordered tiled", kdrt::sample(context, &tiled, None)?);
    let far = options(0.02, levels.coarsest(0.1), FAR);
    set("ordered window", kdrt::sample_window(context, &far, [1000.0, -2.5], [1000.4, -1.5], None)?);
    let counted = CountOptions::new(5000).domain(TORUS).levels(Some(levels)).seed(24);
    set("ordered count", kdrt::sample_count(context, &counted, None)?.0);
    Ok(())
}

/// Sets of several classes: with a radius each, and of equal radii; around given samples; windows of kept planes.
fn in_classes(context: &Context, list: &mut List) -> Result<()> {
    let mut set = |name: &str, set: Points<2>| list.samples(name, &set);
    for (name, own, factor, domain) in [
        ("classes falling", &[0.004, 0.008, 0.016][..], 1.0, TORUS),
        ("classes equal", &[0.01; 4][..], 0.7, SQUARE),
        ("classes far", &[0.03, 0.02, 0.03][..], 1.0, FAR),
    ] {
        let classes = Classes::of_radii(own, factor)?;
        set(name, kdrt::sample(context, &Options::classes(&classes).domain(domain).seed(26), None)?);
    }
    let positions: Vec<_> =
        (0..300u32).map(|i| [(i * 619 % 307) as f32 / 300.0, (i * 41 % 301) as f32 / 301.0]).collect();
    let clearances: Vec<_> = (0..600u32).map(|i| 1e-3 * f64::from(i % 23) * f64::from(i % 2)).collect();
    let classes = Classes::of_radii(&[0.015, 0.008], 0.9)?;
    let given = Options::classes(&classes).seed(26).given(Given::with_clearances(&positions, &clearances));
    set("classes around", kdrt::sample(context, &given, None)?);
    set("classes around equal", kdrt::sample(context, &given.given(Given::at(&positions)), None)?);
    let around = Plane::new(context, &given, None)?;
    set("classes around, window", around.window([0.8, 0.3], [1.0, 0.6])?);
    let classes = Classes::of_radii(&[0.0002, 0.0004, 0.0002], 1.0)?;
    let plane = Plane::new(context, &Options::classes(&classes).domain(SQUARE).seed(26), None)?;
    set("classes window", plane.window([0.31, 0.52], [0.34, 0.55])?);
    Ok(())
}

/// Of the plane, and of space with all points in it twice.
fn thinned(context: &Context, points: &[[f32; 2]], list: &mut List) -> Result<()> {
    let raised: Vec<_> = points.iter().chain(points).map(|&[x, y]| [x, y, x * y]).collect();
    for (name, options) in [
        ("by radius", thin::Options::by_radius(0.02)),
        ("by count", thin::Options::by_count(1000).seed(21)),
        ("progressive", thin::Options::progressive().seed(22)),
    ] {
        let selections = [thin::thin(context, &options, points, None)?, thin::thin(context, &options, &raised, None)?];
        for (thin::Selection { indices, ranks, .. }, place) in std::iter::zip(&selections, ["plane", "space"]) {
            let fields = [little_endian(indices, u32::to_le_bytes), little_endian(ranks, f32::to_le_bytes)];
            list.bytes(&format!("thin {name}, {place}"), &fields.concat());
        }
    }
    Ok(())
}

fn options(radius: f64, domain: Domain, leaf_size: f64, seed: u64) -> Options<'static> {
    Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed)
}

fn tiled(context: &Context, list: &mut List) -> Result<Positions> {
    let sample = |radius, domain, leaf_size, seed| {
        kdrt::sample(context, &options(radius, domain, leaf_size, seed), None).map(|set| set.positions)
    };
    let large = sample(0.002, TORUS, 20.0, 3)?;
    list.points("kdrt 20r", &large);
    list.points("kdrt 6r", &sample(0.002, TORUS, 6.0, 4)?);
    list.points("kdrt 40r", &sample(0.001, TORUS, 40.0, 5)?);
    list.points("kdrt 80r bounded", &sample(0.001, SQUARE, 80.0, 6)?);
    list.points("kdrt far", &sample(0.01, FAR, 20.0, 7)?);
    list.points("kdrt thin", &sample(0.0001, FLAT, 9.5, 8)?);
    list.points("kdrt one", &sample(3.0, TORUS, 20.0, 9)?);
    Ok(large)
}

fn windows(context: &Context, list: &mut List) -> Result<()> {
    let torus = options(0.0001, TORUS, 20.0, 10);
    list.points("window", &kdrt::sample_window(context, &torus, [0.93, 0.0], [1.0, 0.05], None)?.positions);
    let square = options(0.0001, SQUARE, 40.0, 11);
    list.points("window bounded", &kdrt::sample_window(context, &square, [0.31, 0.52], [0.37, 0.55], None)?.positions);
    let mut all = Vec::new();
    let collect = |samples: &[[f32; 2]]| {
        all.extend_from_slice(samples);
        ControlFlow::Continue(())
    };
    Plane::new(context, &options(0.0045, FAR, 20.0, 12), None)?.stream(context, collect, None)?;
    list.points("stream", &all);
    Ok(())
}

/// Gives [`Sets::thousand`] and [`Sets::bounded`].
fn counted(context: &Context, list: &mut List) -> Result<(Positions, Positions)> {
    let sample = |count, domain, seed| {
        kdrt::sample_count(context, &CountOptions::new(count).domain(domain).leaf_size(20.0).seed(seed), None)
    };
    list.points("count 1", &sample(1, TORUS, 13)?.0.positions);
    let thousand = sample(1000, TORUS, 14)?.0.positions;
    list.points("count 1000", &thousand);
    let (bounded, report) = sample(30_000, SQUARE, 15)?;
    list.points("count 30000 bounded", &bounded.positions);
    list.numbers("count 30000 radius", &[report.radius]);
    Ok((thousand, bounded.positions))
}

fn merged(context: &Context, list: &mut List) -> Result<()> {
    let half = |min, max, seed| {
        let domain = rectangle(min, max, Boundary::Bounded);
        kdrt::sample(context, &options(0.005, domain, 20.0, seed), None).map(|set| set.positions)
    };
    let left = half([0.0, 0.0], [0.5, 1.0], 16)?;
    let right = half([0.5, 0.0], [1.0, 1.0], 17)?;
    let pieces = [
        Piece { samples: &left, min: [0.0, 0.0], max: [0.5, 1.0] },
        Piece { samples: &right, min: [0.5, 0.0], max: [1.0, 1.0] },
    ];
    let merge = |domain, seed, pieces: &[Piece], fixed: &[[f32; 2]]| {
        kdrt::merge(context, &MergeOptions::new(0.005).domain(domain).seed(seed), pieces, fixed, None)
    };
    list.points("merge", &merge(TORUS, 18, &pieces, &[[0.25, 0.75], [0.5, 0.5]])?.0.positions);
    list.points("merge bounded", &merge(SQUARE, 19, &pieces[..1], &[])?.0.positions);
    Ok(())
}
