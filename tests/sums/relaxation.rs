//! Relaxation of sets of the plane.

use azulejo::dcr::{
    self, Convergence, CorrelationOptions, DelaunayOptions, Density, Distribution, Method, Neighbourhood, Options,
    PairCorrelation, Thesis, Visits,
};
use azulejo::{Context, Result};

use super::list::List;
use super::plane::{SQUARE, Sets, TORUS};

const DELAUNAY: Neighbourhood = Neighbourhood::Delaunay;
const NEAREST: Neighbourhood = Neighbourhood::Nearest;

/// The thesis's algorithm is slow: a sum needs no set that has come to rest.
const THESIS_ITERATIONS: u32 = 60;

/// Adds the sums.
pub fn sums(context: &Context, sets: &Sets, list: &mut List) -> Result<()> {
    let mut relax = |name: &str, options: Options, points: &[[f32; 2]]| {
        let (relaxed, report) = dcr::relax(context, &options, points, None)?;
        list.points(name, &relaxed);
        list.numbers(&format!("{name}: report"), &[report.motion, report.rho, report.relative_covering_radius]);
        Ok(())
    };
    relax("relax delaunay", Options::new(TORUS, DELAUNAY).seed(21), &sets.random)?;
    relax("relax nearest", Options::new(TORUS, NEAREST).seed(22), &sets.random)?;
    relax("relax delaunay bounded", Options::new(SQUARE, DELAUNAY).seed(23), &sets.random)?;
    relax("relax nearest bounded", Options::new(SQUARE, NEAREST).seed(24), &sets.random)?;
    relax("relax 30000 bounded", Options::new(SQUARE, DELAUNAY).seed(25), &sets.bounded)?;
    relax("relax large", Options::new(TORUS, DELAUNAY).seed(25), &sets.large)?;

    let thesis = |domain, neighbourhood| Options::thesis(domain, neighbourhood).max_iterations(THESIS_ITERATIONS);
    relax("thesis delaunay", thesis(TORUS, DELAUNAY), &sets.random)?;
    relax("thesis nearest", thesis(SQUARE, NEAREST), &sets.thousand)?;
    let variant = Thesis::default()
        .distribution(Distribution::EightyTwenty)
        .visits(Visits::OneEnd)
        .convergence(Convergence::Variance);
    relax("thesis one end", thesis(TORUS, DELAUNAY).method(Method::Thesis(variant)), &sets.random)?;
    to_correlations(context, sets, list)?;
    by_density(context, list)?;
    in_classes(context, sets, list)
}

fn to_correlations(context: &Context, sets: &Sets, list: &mut List) -> Result<()> {
    for (name, target) in [("step", PairCorrelation::step(0.5)?), ("peak", PairCorrelation::peak(0.6, 0.06, 1.0)?)] {
        let options = CorrelationOptions::new(TORUS).max_iterations(20);
        let (relaxed, report) = dcr::relax_to_correlation(context, &options, &sets.random, &target, None)?;
        list.points(&format!("relax to a {name} of power"), &relaxed);
        list.numbers(&format!("relax to a {name} of power: residual"), &[report.residual]);
    }
    Ok(())
}

/// Several classes at once: of equal shares from a maximal set, and of unequal ones from random points.
fn in_classes(context: &Context, sets: &Sets, list: &mut List) -> Result<()> {
    for (name, domain, points, classes) in [
        ("relax classes", TORUS, &sets.thousand, &[0, 1, 2][..]),
        ("relax classes bounded", SQUARE, &sets.random, &[0, 3, 0, 0, 1]),
    ] {
        let of: Vec<u32> = classes.iter().copied().cycle().take(points.len()).collect();
        let options = DelaunayOptions::new(domain).seed(28);
        let (relaxed, report, each) = dcr::relax_classes(context, &options, points, &of, None)?;
        list.points(name, &relaxed);
        let each = each.iter().flat_map(|class| [class.rho, class.relative_covering_radius]);
        list.numbers(
            &format!("{name}: report"),
            &[report.motion, report.rho].into_iter().chain(each).collect::<Vec<_>>(),
        );
    }
    Ok(())
}

fn by_density(context: &Context, list: &mut List) -> Result<()> {
    let inside = |[x, y]: [f64; 2]| (x - 0.5) * (x - 0.5) + (y - 0.4) * (y - 0.4) < 0.09;
    let disc = |place: [f64; 2]| if inside(place) { 1.0 } else { 0.1 * place[0] };
    let disc = Density::Function(&disc);
    let start = dcr::scatter(context, &SQUARE, &disc, 4000, 26, None)?;
    let options = DelaunayOptions::new(SQUARE).seed(26);
    let (relaxed, report) = dcr::relax_with_density(context, &options, &disc, &start, None)?;
    list.points("density function", &relaxed);
    list.numbers("density function: report", &[report.rho, report.relative_covering_radius]);

    let value = |i: usize| if i % 64 < 20 { 0.0 } else { ((i * 37) % 101) as f32 };
    let values: Vec<f32> = (0..64 * 48).map(value).collect();
    let image = Density::Image { values: &values, width: 64, height: 48 };
    let start = dcr::scatter(context, &TORUS, &image, 2000, 27, None)?;
    let options = DelaunayOptions::new(TORUS).seed(27);
    list.points("density image", &dcr::relax_with_density(context, &options, &image, &start, None)?.0);
    Ok(())
}
