//! Sets of cuboids, and of the inside of a mesh; relaxed ones.

use std::sync::Arc;

use azulejo::dcr::volume::{InsideOptions as RelaxInsideOptions, Options as RelaxOptions, relax, relax_inside};
use azulejo::volume::adaptive::{self, Radius};
use azulejo::volume::{ClassesOptions, InsideOptions, Options, Surface, sample, sample_classes, sample_inside};
use azulejo::{Boundary, Classes, Context, Domain, Given, Order, Result};

use super::list::List;
use super::meshes::torus;

const fn cuboid(min: [f64; 3], max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min, max, boundary }
}

/// Cuboids of several blocks, of one, thin ones, and one far from the origin, where floats are coarse.
const CUBOIDS: [(&str, Domain<3>, f64); 6] = [
    ("volume torus", cuboid([0.0; 3], [1.0; 3], Boundary::Periodic), 0.02),
    ("volume cube", cuboid([0.0; 3], [1.0; 3], Boundary::Bounded), 0.025),
    ("volume small torus", cuboid([-0.5; 3], [0.5, 0.4, 0.7], Boundary::Periodic), 0.1),
    ("volume slab", cuboid([0.0; 3], [2.0, 3.0, 0.01], Boundary::Periodic), 0.03),
    ("volume bar", cuboid([0.25, -7.0, 0.0], [0.26, 7.0, 0.3], Boundary::Bounded), 0.05),
    ("volume far", cuboid([1e5, -3e4, 0.5], [1e5 + 20.0, -3e4 + 9.5, 8.0], Boundary::Periodic), 0.7),
];

/// Adds the sums; those of small sets are the same calls with three times the radius.
pub fn sums(context: &Context, is_small: bool, list: &mut List) -> Result<()> {
    for (seed, (name, domain, radius)) in (71..).zip(CUBOIDS) {
        let radius = if is_small { 3.0 * radius } else { radius };
        list.samples(name, &sample(context, &Options::new(radius).domain(domain).seed(seed), None)?.0);
    }
    // Smaller ones would not be tiled.
    for (place, boundary) in [("torus", Boundary::Periodic), ("cube", Boundary::Bounded)] {
        let options = Options::new(0.0288).domain(Domain::unit(boundary)).seed(87).leaf_size(7.0);
        list.samples(&format!("volume {place}, tiled"), &sample(context, &options, None)?.0);
    }
    let radius = if is_small { 0.1 } else { 0.04 };
    let positions: Vec<[f32; 3]> =
        (0..60u8).map(|i| [31, 47, 83].map(|step| f32::from(i.wrapping_mul(step)) / 256.0)).collect();
    let clearances: Vec<f64> = (0..60).map(|i| 0.3 / [1.0, 7.0, 60.0, 1000.0][i % 4]).collect();
    for (place, boundary) in [("torus", Boundary::Periodic), ("cube", Boundary::Bounded)] {
        let domain = Domain::unit(boundary);
        let free = Options::new(radius).domain(domain).seed(81);
        let given = Given::with_clearances(&positions, &clearances);
        let count = Options::by_count(if is_small { 300 } else { 5_000 }).domain(domain).seed(82);
        for (name, options) in [
            ("given", free.given(given)),
            ("given alike", free.given(Given::at(&positions))),
            ("progressive", free.order(Order::Progressive)),
            ("progressive, given", free.order(Order::Progressive).quotient(1.3).given(given)),
            ("count", count),
            ("count, progressive", count.order(Order::Progressive)),
            ("count, given", count.given(given)),
        ] {
            list.samples(&format!("volume {place}, {name}"), &sample(context, &options, None)?.0);
        }
    }
    for (place, boundary) in [("torus", Boundary::Periodic), ("cube", Boundary::Bounded)] {
        let domain = Domain { max: [1.0, 0.5, 0.75], ..Domain::unit(boundary) };
        let (start, _) = sample(context, &Options::new(radius).domain(domain).seed(85), None)?;
        let (relaxed, report) =
            relax(context, &RelaxOptions::new(domain).max_iterations(40).seed(86), &start.positions, None)?;
        list.samples(&format!("volume {place}, relaxed"), &relaxed.into());
        list.numbers(&format!("volume {place}, relaxed: report"), &[report.motion, report.smallest_distance]);
    }
    insides(context, radius, list)?;
    adaptives(context, radius, is_small, list)
}

/// Radii that grow along y.
fn adaptives(context: &Context, radius: f64, is_small: bool, list: &mut List) -> Result<()> {
    for (seed, (name, domain, least)) in (91..).zip(CUBOIDS) {
        let least = if is_small { 3.0 * least } else { least };
        let slope = 1.5 * least / domain.extent()[1];
        let at = |[_, y, _]: [f64; 3]| least + slope * (y - domain.min[1]);
        let field = Radius::Function { at: &at, smallest: least, largest: 2.51 * least, slope: 1.000001 * slope };
        let options = adaptive::Options::new(field).domain(domain).seed(seed);
        list.samples(&format!("{name}, adaptive"), &adaptive::sample(context, &options, None)?.0);
    }
    let mesh = Arc::new(torus(60, 30, false)?);
    let values = [radius as f32, 3.0 * radius as f32];
    let options = adaptive::InsideOptions::new(Radius::Grid { values: &values, size: [2, 1, 1] }).seed(98);
    list.samples("volume inside, adaptive", &adaptive::sample_inside(context, &mesh, &options, None)?.0);
    Ok(())
}

fn insides(context: &Context, radius: f64, list: &mut List) -> Result<()> {
    let mesh = Arc::new(torus(60, 30, false)?);
    let given = Given::with_clearances(&[[1.0, 0.0, 0.1], [0.0, -0.9, 0.0]], &[0.3, 0.05]);
    let (free, count) = (InsideOptions::new(radius).seed(83), InsideOptions::by_count(800).seed(84));
    for (name, options) in [
        ("open", free),
        ("fine tolerance", free.tolerance(1.0 / 64.0)),
        ("surface", free.surface(Surface::First)),
        ("surface, given", free.surface(Surface::First).given(given)),
        ("progressive", free.order(Order::Progressive)),
        ("count", count),
        ("count, given", count.given(given)),
        ("thin shell", free.thickness(0.7 * radius)),
        ("shell, surface", free.thickness(2.0 * radius).surface(Surface::First)),
        ("shell, count", count.thickness(0.06)),
    ] {
        list.samples(&format!("volume inside, {name}"), &sample_inside(context, &mesh, &options, None)?.0);
    }
    let classes = Classes::of_radii(&[0.09, 0.09, 0.05], 0.9)?;
    for (name, boundary) in [("torus", Boundary::Periodic), ("bounded", Boundary::Bounded)] {
        let options = ClassesOptions::default().domain(Domain::unit(boundary)).seed(89);
        list.samples(&format!("volume classes, {name}"), &sample_classes(context, &options, &classes, None)?);
    }
    for (name, surface) in [("free", Surface::Open), ("around the surface", Surface::First)] {
        let (start, of) = sample_inside(context, &mesh, &free.surface(surface), None)?;
        let fixed: Vec<bool> = (0..start.len()).map(|index| index < of.surface_samples).collect();
        let options = RelaxInsideOptions::default().max_iterations(40).seed(87).fixed(&fixed);
        let (relaxed, report) = relax_inside(context, &mesh, &options, &start.positions, None)?;
        list.samples(&format!("volume inside, relaxed {name}"), &relaxed.into());
        list.numbers(&format!("volume inside, relaxed {name}: report"), &[report.motion, report.smallest_distance]);
    }
    let (start, of) = sample_inside(context, &mesh, &free.surface(Surface::First), None)?;
    let sliding: Vec<bool> = (0..start.len()).map(|index| index < of.surface_samples).collect();
    let options = RelaxInsideOptions::default().max_iterations(40).seed(88).sliding(&sliding);
    let relaxed = relax_inside(context, &mesh, &options, &start.positions, None)?.0;
    list.samples("volume inside, relaxed with a sliding surface", &relaxed.into());
    Ok(())
}
