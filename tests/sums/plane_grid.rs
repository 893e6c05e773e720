//! The grid of the plane: each way to make a set by all that can be asked of it.

use std::ops::ControlFlow;

use azulejo::analysis::coverage::coverage_2d;
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spectrum::periodogram;
use azulejo::dcr::{self, Density, Neighbourhood};
use azulejo::kdrt::{self, CountOptions, Kind, MergeOptions, Options, Piece, Plane, Progressive};
use azulejo::{Boundary, Classes, Context, Domain, Given, Points, Result, maximal, thin};

use super::list::{List, little_endian};
use super::plane::{SQUARE, TORUS};

/// Both halves of the grid have the same calls, on domains of this many radii and with this many samples.
struct Size {
    /// The radius of a set that is tiled, if that is worthwhile, in leaves of this size.
    tiled: f64,
    leaf_size: f64,
    /// The radius where a call makes many levels, or tiles nothing.
    untiled: f64,
    /// An exact number of samples.
    count: u64,
    /// The number of given samples.
    given: usize,
}

/// Sets that WebAssembly makes in a moment.
const SMALL: Size = Size { tiled: 0.009, leaf_size: 6.0, untiled: 0.04, count: 300, given: 40 };
const LARGE: Size = Size { tiled: 0.003, leaf_size: 20.0, untiled: 0.012, count: 4000, given: 700 };

/// A part of the domain that touches its boundary.
const WINDOW: [[f64; 2]; 2] = [[0.8, 0.3], [1.0, 0.6]];

/// Relaxation is shown by its first steps.
const ITERATIONS: u32 = 40;

type Make = fn(&Context, &Options) -> Result<Points<2>>;

/// The ways to make a set, or a part of one, and whether samples come in an order of theirs.
const SAMPLERS: [(&str, bool, Make); 4] = [
    ("whole", true, |context, options| kdrt::sample(context, options, None)),
    ("window", true, |context, options| kdrt::sample_window(context, options, WINDOW[0], WINDOW[1], None)),
    ("kept window", true, |context, options| Plane::new(context, options, None)?.window(WINDOW[0], WINDOW[1])),
    ("stream", false, |context, options| {
        let mut points = Points::default();
        let collect = |samples: &[[f32; 2]]| {
            points.positions.extend_from_slice(samples);
            ControlFlow::Continue(())
        };
        Plane::new(context, options, None)?.stream(context, collect, None)?;
        Ok(points)
    }),
];

/// Those that make sets of several classes.
const CLASS_SAMPLERS: [(&str, Make); 2] = [
    ("whole", |context, options| kdrt::sample(context, options, None)),
    ("window", |context, options| Plane::new(context, options, None)?.window(WINDOW[0], WINDOW[1])),
];

/// Adds the sums of small sets or of large ones.
pub fn sums(context: &Context, is_small: bool, list: &mut List) -> Result<()> {
    let size = if is_small { &SMALL } else { &LARGE };
    for (place, domain) in [("torus", TORUS), ("square", SQUARE)] {
        let untiled = maximal::Options::new(size.untiled).domain(domain).seed(61);
        list.samples(&format!("{place} untiled"), &maximal::sample(context, &untiled, None)?);
        around_nothing_and_given(context, place, domain, size, list)?;
        counted(context, place, domain, size, list)?;
        merged(context, place, domain, size, list)?;
        relaxed_and_measured(context, place, domain, size, list)?;
    }
    thinned(context, size, list)
}

/// The samplers, in any order and progressive, and in classes, each around nothing and around given samples.
fn around_nothing_and_given(
    context: &Context,
    place: &str,
    domain: Domain,
    size: &Size,
    list: &mut List,
) -> Result<()> {
    let positions: Vec<_> = points(size.given).into_iter().map(|[x, y]| [1.1 * x, y]).collect();
    let clearances: Vec<_> =
        (0..2 * positions.len()).map(|i| size.untiled * [0.0, 0.1, 1.0, 3.0, 0.5][i % 5]).collect();
    let own = Given::with_clearances(&positions, &clearances[..positions.len()]);
    let classes = Classes::of_radii(&[size.untiled, 1.5 * size.untiled], 0.9)?;
    for (around, given, of_classes) in [
        ("", Given::default(), Given::default()),
        (", given", own, Given::with_clearances(&positions, &clearances)),
        (", given alike", Given::at(&positions), Given::at(&positions)),
    ] {
        let ordered = Kind::Progressive(size.untiled, Progressive::new());
        for (in_order, is_ordered, kind) in [("", false, Kind::Plain(size.tiled)), (", ordered", true, ordered)] {
            let options = Options::of(kind).domain(domain).leaf_size(size.leaf_size).seed(62).given(given);
            for (name, _, make) in SAMPLERS.iter().filter(|(_, has_order, _)| !is_ordered || *has_order) {
                list.samples(&format!("{place} {name}{in_order}{around}"), &make(context, &options)?);
            }
        }
        let options = Options::classes(&classes).domain(domain).leaf_size(size.leaf_size).seed(63).given(of_classes);
        for (name, make) in CLASS_SAMPLERS {
            list.samples(&format!("{place} {name}, classes{around}"), &make(context, &options)?);
        }
    }
    Ok(())
}

fn counted(context: &Context, place: &str, domain: Domain, size: &Size, list: &mut List) -> Result<()> {
    for (in_order, levels) in [("", None), (", ordered", Some(Progressive::new()))] {
        let options = CountOptions::new(size.count).domain(domain).leaf_size(size.leaf_size).levels(levels).seed(64);
        let (points, report) = kdrt::sample_count(context, &options, None)?;
        list.samples(&format!("{place} count{in_order}"), &points);
        list.numbers(&format!("{place} count{in_order}: radius"), &[report.radius]);
    }
    Ok(())
}

/// Of the left half's samples, and around fixed points.
fn merged(context: &Context, place: &str, domain: Domain, size: &Size, list: &mut List) -> Result<()> {
    let half = Domain { min: [0.0; 2], max: [0.5, 1.0], boundary: Boundary::Bounded };
    let samples = kdrt::sample(context, &Options::new(size.untiled).domain(half).seed(65), None)?.positions;
    let piece = Piece { samples: &samples, min: half.min, max: half.max };
    let options = MergeOptions::new(size.untiled).domain(domain).seed(66);
    let (points, report) = kdrt::merge(context, &options, &[piece], &[[0.5; 2], [0.25, 0.75]], None)?;
    list.samples(&format!("{place} merge"), &points);
    let counts = [report.kept, report.eliminated, report.inserted].map(|count| count as f64);
    list.numbers(&format!("{place} merge: report"), &counts);
    Ok(())
}

/// Random points, some iterations of each method of relaxation, and what is measured of a relaxed set.
fn relaxed_and_measured(context: &Context, place: &str, domain: Domain, size: &Size, list: &mut List) -> Result<()> {
    let count = size.count as usize;
    let start = dcr::scatter(context, &domain, &Density::Function(&|_| 1.0), count, 67, None)?;
    let of: Vec<u32> = (0..start.len() as u32).map(|i| i % 3).collect();
    let mut relaxed = Vec::new();
    for (name, neighbourhood) in [("nearest", Neighbourhood::Nearest), ("delaunay", Neighbourhood::Delaunay)] {
        let options = dcr::Options::new(domain, neighbourhood).seed(68).max_iterations(ITERATIONS);
        let (positions, report) = dcr::relax(context, &options, &start, None)?;
        list.points(&format!("{place} relax {name}"), &positions);
        list.numbers(
            &format!("{place} relax {name}: report"),
            &[report.motion, report.rho, report.relative_covering_radius],
        );
        let thesis = dcr::Options::thesis(domain, neighbourhood).max_iterations(ITERATIONS / 4);
        list.points(&format!("{place} relax {name}, thesis"), &dcr::relax(context, &thesis, &start, None)?.0);
        relaxed = positions;
    }
    let options = dcr::DelaunayOptions::new(domain).seed(69).max_iterations(ITERATIONS);
    list.points(&format!("{place} relax classes"), &dcr::relax_classes(context, &options, &start, &of, None)?.0);
    let density = |[x, y]: [f64; 2]| 0.1 + x * y;
    let density = Density::Function(&density);
    let start = dcr::scatter(context, &domain, &density, count, 70, None)?;
    let by_density = dcr::relax_with_density(context, &options, &density, &start, None)?.0;
    list.points(&format!("{place} relax, density"), &by_density);

    let spectrum = periodogram(context, &TORUS, &relaxed, 24, None)?;
    list.bytes(&format!("{place} spectrum"), &little_endian(spectrum.power(), f32::to_le_bytes));
    let distribution = radial_distribution(context, &domain, &relaxed, 4.0, 32, None)?;
    list.numbers(&format!("{place} radial distribution"), &distribution.density());
    list.bytes(&format!("{place} figures"), format!("{:?}", figures_2d(context, &domain, &relaxed, None)?).as_bytes());
    let coverage = coverage_2d(context, &domain, &start, size.untiled, None)?;
    list.bytes(&format!("{place} coverage"), format!("{coverage:?}").as_bytes());
    Ok(())
}

/// Of a cloud in the plane, and of one in space with all points in it twice.
fn thinned(context: &Context, size: &Size, list: &mut List) -> Result<()> {
    let cloud = points(size.count as usize);
    let raised: Vec<_> = cloud.iter().chain(&cloud).map(|&[x, y]| [x, y, x * y]).collect();
    for (name, options) in [
        ("by radius", thin::Options::by_radius(size.untiled)),
        ("by count", thin::Options::by_count(size.given).seed(71)),
        ("progressive", thin::Options::progressive().seed(72)),
    ] {
        let selections = [thin::thin(context, &options, &cloud, None)?, thin::thin(context, &options, &raised, None)?];
        for (selection, space) in selections.iter().zip(["plane", "space"]) {
            let fields = [
                little_endian(&selection.indices, u32::to_le_bytes),
                little_endian(&selection.ranks, f32::to_le_bytes),
            ];
            list.bytes(&format!("cloud in {space}, thinned {name}"), &fields.concat());
        }
    }
    Ok(())
}

/// Points of the unit square, no two of which coincide.
fn points(count: usize) -> Vec<[f32; 2]> {
    (0..count as u32).map(|i| [(i * 619 % 9973) as f32 / 9973.0, (i * 4157 % 9967) as f32 / 9967.0]).collect()
}
