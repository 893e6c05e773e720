//! Sets of the plane, and the sets that other groups start from.

use std::ops::ControlFlow;

use azulejo::dcr::{self, Density};
use azulejo::kdrt::{self, CountOptions, MergeOptions, Options, Piece};
use azulejo::{Boundary, Context, Domain, Result, maximal, thin};

use super::print;

/// The unit torus and the unit square.
pub const TORUS: Domain = rectangle([0.0; 2], [1.0; 2], Boundary::Periodic);
pub const SQUARE: Domain = rectangle([0.0; 2], [1.0; 2], Boundary::Bounded);

/// A torus far from the origin, where floats are coarse, and a square that is thin.
const FAR: Domain = rectangle([1000.0, -3.0], [1004.0, -1.0], Boundary::Periodic);
const FLAT: Domain = rectangle([-0.5, 0.25], [0.5, 0.28], Boundary::Bounded);

const fn rectangle(min: [f64; 2], max: [f64; 2], boundary: Boundary) -> Domain {
    Domain { min, max, boundary }
}

/// Points of the plane.
type Points = Vec<[f32; 2]>;

/// Sets that are relaxed and measured.
pub struct Sets {
    /// A large maximal set, and one of 1000 samples, on the [`TORUS`].
    pub large: Points,
    pub thousand: Points,
    /// A maximal set of 30,000 samples of the [`SQUARE`].
    pub bounded: Points,
    /// Random points of the [`TORUS`].
    pub random: Points,
}

/// Prints the sums.
pub fn print(context: &Context) -> Result<Sets> {
    let maximal =
        |radius, domain, seed| maximal::sample(context, &maximal::Options::new(radius).domain(domain).seed(seed), None);
    print::points("maximal periodic", &maximal(0.01, TORUS, 1)?)?;
    print::points("maximal bounded", &maximal(0.004, FLAT, 2)?)?;
    let large = tiled(context)?;
    windows(context)?;
    let (thousand, bounded) = counted(context)?;
    merged(context)?;
    let random = dcr::scatter(context, &TORUS, &Density::Function(&|_| 1.0), 3000, 20, None)?;
    print::points("scatter", &random)?;
    thinned(context, &random)?;
    Ok(Sets { large, thousand, bounded, random })
}

/// Of the plane, and of space with all points in it twice.
fn thinned(context: &Context, points: &[[f32; 2]]) -> Result<()> {
    let raised: Vec<_> = points.iter().chain(points).map(|&[x, y]| [x, y, x * y]).collect();
    for (name, options) in [
        ("by radius", thin::Options::by_radius(0.02)),
        ("by count", thin::Options::by_count(1000).seed(21)),
        ("progressive", thin::Options::progressive().seed(22)),
    ] {
        let selections = [thin::thin(context, &options, points, None)?, thin::thin(context, &options, &raised, None)?];
        for (thin::Selection { indices, ranks, .. }, place) in std::iter::zip(&selections, ["plane", "space"]) {
            let fields =
                [print::little_endian(indices, u32::to_le_bytes), print::little_endian(ranks, f32::to_le_bytes)];
            print::bytes(&format!("thin {name}, {place}"), &fields.concat())?;
        }
    }
    Ok(())
}

fn options(radius: f64, domain: Domain, leaf_size: f64, seed: u64) -> Options {
    Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed)
}

fn tiled(context: &Context) -> Result<Points> {
    let sample =
        |radius, domain, leaf_size, seed| kdrt::sample(context, &options(radius, domain, leaf_size, seed), None);
    let large = sample(0.002, TORUS, 20.0, 3)?;
    print::points("kdrt 20r", &large)?;
    print::points("kdrt 6r", &sample(0.002, TORUS, 6.0, 4)?)?;
    print::points("kdrt 40r", &sample(0.001, TORUS, 40.0, 5)?)?;
    print::points("kdrt 80r bounded", &sample(0.001, SQUARE, 80.0, 6)?)?;
    print::points("kdrt far", &sample(0.01, FAR, 20.0, 7)?)?;
    print::points("kdrt thin", &sample(0.0001, FLAT, 9.5, 8)?)?;
    print::points("kdrt one", &sample(3.0, TORUS, 20.0, 9)?)?;
    Ok(large)
}

fn windows(context: &Context) -> Result<()> {
    let torus = options(0.0001, TORUS, 20.0, 10);
    print::points("window", &kdrt::sample_window(context, &torus, [0.93, 0.0], [1.0, 0.05], None)?)?;
    let square = options(0.0001, SQUARE, 40.0, 11);
    print::points("window bounded", &kdrt::sample_window(context, &square, [0.31, 0.52], [0.37, 0.55], None)?)?;
    let mut all = Vec::new();
    let collect = |samples: &[[f32; 2]]| {
        all.extend_from_slice(samples);
        ControlFlow::Continue(())
    };
    kdrt::sample_stream(context, &options(0.0045, FAR, 20.0, 12), collect, None)?;
    print::points("stream", &all)
}

/// Gives [`Sets::thousand`] and [`Sets::bounded`].
fn counted(context: &Context) -> Result<(Points, Points)> {
    let sample = |count, domain, seed| {
        kdrt::sample_count(context, &CountOptions::new(count).domain(domain).leaf_size(20.0).seed(seed), None)
    };
    print::points("count 1", &sample(1, TORUS, 13)?.samples)?;
    let thousand = sample(1000, TORUS, 14)?.samples;
    print::points("count 1000", &thousand)?;
    let bounded = sample(30_000, SQUARE, 15)?;
    print::points("count 30000 bounded", &bounded.samples)?;
    print::numbers("count 30000 radius", &[bounded.report.radius])?;
    Ok((thousand, bounded.samples))
}

fn merged(context: &Context) -> Result<()> {
    let half = |min, max, seed| {
        let domain = rectangle(min, max, Boundary::Bounded);
        kdrt::sample(context, &options(0.005, domain, 20.0, seed), None)
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
    print::points("merge", &merge(TORUS, 18, &pieces, &[[0.25, 0.75], [0.5, 0.5]])?.0)?;
    print::points("merge bounded", &merge(SQUARE, 19, &pieces[..1], &[])?.0)
}
