//! Samples of meshes, and their relaxation.

use std::sync::Arc;

use azulejo::dcr::surface::{Options as RelaxOptions, relax, triangulate};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Density, Radius, Scale, Texture};
use azulejo::psp::{self, ClassOptions, Engine, Options, Priority, ProjectionOptions, Projectors};
use azulejo::{Classes, Context, Given, Order, Points, Result};

use super::list::{List, little_endian};
use super::meshes;

/// The sets that are measured: a closed torus with a maximal set, and an open one with a set of few samples.
pub struct Surface {
    pub closed: Arc<Mesh>,
    pub maximal: Points<3>,
    pub open: Arc<Mesh>,
    pub few: Points<3>,
}

/// Adds the sums.
pub fn sums(context: &Context, list: &mut List) -> Result<Surface> {
    let closed = Arc::new(meshes::torus(96, 64, false)?);
    let open = Arc::new(meshes::torus(40, 24, true)?);
    let maximal = uniform(context, &closed, &open, list)?;
    ordered(context, &closed, &open, list)?;
    in_classes(context, &closed, &maximal, list)?;
    in_varying_classes(context, &closed, list)?;
    adaptive(context, &closed, &open, list)?;
    with_density(context, &open, list)?;
    deformed(&closed, &maximal, list)?;
    let few = relaxed(context, &closed, &maximal, &open, list)?;
    Ok(Surface { closed, maximal, open, few })
}

/// The options of a set, with projectors and an engine that are not left to defaults.
fn options(radius: f64, seed: u64) -> ProjectionOptions<'static> {
    ProjectionOptions::new(radius).seed(seed).projectors(Projectors::Global).engine(Engine::Rasteriser)
}

/// Gives [`Surface::maximal`].
fn uniform(context: &Context, closed: &Arc<Mesh>, open: &Arc<Mesh>, list: &mut List) -> Result<Points<3>> {
    let mut project = |name: &str, mesh: &Arc<Mesh>, options: ProjectionOptions, iterations, maximal| {
        let (samples, report) = psp::project(context, mesh, &options, iterations, maximal, None)?;
        list.samples(name, &samples);
        let counts = [report.samples, report.darts, report.conflicts].map(|count| count as f64);
        list.numbers(&format!("{name}: report"), &[&counts[..], &[report.rho]].concat());
        Ok(samples)
    };
    let maximal = project("fill only", closed, options(0.02, 28), 0, true)?;
    project("rasteriser 1", closed, options(0.02, 29), 1, true)?;
    let by_projector = |options: ProjectionOptions<'static>| options.priority(Priority::Projector);
    project("rasteriser 3, projector, not maximal", open, by_projector(options(0.01, 30)), 3, false)?;
    project("rasteriser 2, projector", open, by_projector(options(0.01, 32)), 2, true)?;
    let mask = (0..open.triangles().len()).map(|i| i % 7 != 0).collect();
    let masked = Arc::new(Mesh::clone(open).with_mask(mask)?);
    project("masked", &masked, options(0.03, 33), 1, true)?;
    let soup = Arc::new(meshes::soup()?);
    project("soup", &soup, options(0.05, 34), 1, true)?;
    let (positions, clearances) = obstacles(&maximal);
    let around = Given::with_clearances(&positions, &clearances);
    project("given", closed, options(0.02, 38).given(around), 0, true)?;
    project("given, rasteriser 1", closed, options(0.03, 39).given(around), 1, true)?;
    project("given, of the same radius", closed, options(0.02, 40).given(Given::at(&positions)), 0, true)?;
    project("cosine", open, options(0.05, 41).given(around).cosine(0.3), 0, true)?;
    // The lines of all engines are the same.
    let of_engine = |engine| -> Result<List> {
        let mut list = List::default();
        let meshes = [closed, open, &masked, &soup];
        local_projectors(context, meshes, options(0.02, 29).projectors(Projectors::Local).engine(engine), &mut list)?;
        Ok(list)
    };
    let lines = of_engine(Engine::Rasteriser)?;
    for &engine in Engine::AVAILABLE {
        assert_eq!(of_engine(engine)?.to_string(), lines.to_string(), "{engine:?}");
    }
    list.append(lines);
    Ok(maximal)
}

/// Sets by local projectors on a closed, an open and a masked mesh and on a soup.
fn local_projectors(
    context: &Context,
    [closed, open, masked, soup]: [&Arc<Mesh>; 4],
    options: ProjectionOptions,
    list: &mut List,
) -> Result<()> {
    let (positions, clearances) = obstacles(&psp::project(context, closed, &options, 1, false, None)?.0);
    let around = options.given(Given::with_clearances(&positions, &clearances));
    for (name, mesh, options, iterations, maximal) in [
        ("local 1, not maximal", closed, options, 1, false),
        ("local 1", closed, options, 1, true),
        ("local 3, projector", open, options.priority(Priority::Projector), 3, true),
        ("local, masked", masked, options, 1, true),
        ("local, soup", soup, options, 2, false),
        ("local, given", closed, around, 1, true),
    ] {
        let (samples, report) = psp::project(context, mesh, &options, iterations, maximal, None)?;
        list.samples(name, &samples);
        let counts = [report.samples, report.hits, report.restart_conflicts].map(|count| count as f64);
        list.numbers(&format!("{name}: report"), &counts);
    }
    Ok(())
}

/// Some samples of a set, with clearances over four orders.
fn obstacles(set: &Points<3>) -> (Vec<[f32; 3]>, Vec<f64>) {
    let some = set.positions.iter().step_by(50).copied();
    some.enumerate().map(|(i, position)| (position, 0.2 / [1.0, 7.0, 60.0, 1000.0, 20000.0][i % 5])).unzip()
}

/// Sets of exact counts and in progressive order.
fn ordered(context: &Context, closed: &Arc<Mesh>, open: &Arc<Mesh>, list: &mut List) -> Result<()> {
    for (name, mesh, options) in [
        ("count", open, Options::by_count(777).seed(42)),
        ("ordered", closed, Options::new(0.05).order(Order::Progressive).seed(43)),
        ("ordered count", closed, Options::by_count(1234).order(Order::Progressive).quotient(1.3).seed(44)),
    ] {
        let (samples, report) = psp::sample(context, mesh, &options, None)?;
        list.samples(name, &samples);
        list.numbers(&format!("{name}: report"), &[report.radius, report.covering_radius.unwrap_or(-1.0)]);
    }
    Ok(())
}

/// A set of three classes, two of them with equal radii: each on some of the triangles, and around given samples.
fn in_classes(context: &Context, closed: &Arc<Mesh>, maximal: &Points<3>, list: &mut List) -> Result<()> {
    let classes = Classes::of_radii(&[0.05, 0.1, 0.05], 1.0)?;
    let masks: Vec<u32> = (0..closed.triangles().len() as u32).map(|i| if i % 9 < 5 { 7 } else { i % 8 }).collect();
    let options = ClassOptions::default().seed(46);
    let mut sample = |name: &str, options: ClassOptions, masks: Option<&[u32]>| {
        let (samples, _) = psp::sample_classes(context, closed, &options, &classes, masks, None)?;
        list.samples(name, &samples);
        Ok(())
    };
    sample("classes", options, Some(&masks))?;
    let (positions, clearances) = obstacles(maximal);
    let of_classes: Vec<f64> = clearances.iter().flat_map(|&clearance| [clearance, 0.0, 0.5 * clearance]).collect();
    sample("classes, given", options.given(Given::with_clearances(&positions, &of_classes)).cosine(0.3), None)?;
    sample("classes, given, of their radii", options.given(Given::at(&positions)), Some(&masks))
}

/// Sets of three classes whose radii vary, by a density and by vertex, in any order and in progressive order.
fn in_varying_classes(context: &Context, closed: &Arc<Mesh>, list: &mut List) -> Result<()> {
    let classes = Classes::of_radii(&[1.0, 2.0, 1.0], 1.0)?;
    let masks: Vec<u32> = (0..closed.triangles().len() as u32).map(|i| if i % 9 < 5 { 7 } else { i % 8 }).collect();
    let weights: Vec<f32> = closed.positions().iter().map(|[x, _, z]| (x + 0.5 * z).max(0.0)).collect();
    let radii: Vec<f32> = closed.positions().iter().map(|[x, ..]| 0.03 + 0.03 * (x + 1.4)).collect();
    let density = Radius::Density { density: Density::PerVertex(&weights), scale: Scale::Count(2000.0) };
    for (name, unit, order) in [
        ("classes, density", density, Order::Any),
        ("classes, radii of vertices", Radius::PerVertex(&radii), Order::Any),
        ("classes, radii of vertices, ordered", Radius::PerVertex(&radii), Order::Progressive),
    ] {
        let options = ClassOptions::default().seed(48).order(order).unit(Some(unit));
        list.samples(name, &psp::sample_classes(context, closed, &options, &classes, Some(&masks), None)?.0);
    }
    Ok(())
}

/// Samples that go with the triangles of a mesh whose vertices move.
fn deformed(closed: &Mesh, maximal: &Points<3>, list: &mut List) -> Result<()> {
    let bent = closed.positions().iter().map(|&[x, y, z]| [x + 0.3 * z * z, y * (1.0 - 0.2 * x), z - 0.1 * x * y]);
    let bent = closed.deformed(bent.collect())?;
    list.samples("deformed", &bent.samples_at(&maximal.triangles, &maximal.barycentrics)?);
    Ok(())
}

/// Sets that follow densities: a function's, an image's whose texture coordinates are x and y, and one of the vertices.
fn with_density(context: &Context, open: &Mesh, list: &mut List) -> Result<()> {
    let at = |[x, _, z]: [f64; 3]| 0.4 + 0.2 * x + 0.1 * z;
    let function = Density::Function { at: &at, largest: 1.0, slope: 0.25 };
    let values: Vec<f32> = (0..12 * 10).map(|i| if i % 5 == 0 { 0.0 } else { (i % 7) as f32 }).collect();
    let texture: Vec<[f32; 2]> = open.positions().iter().map(|&[x, y, _]| [x, y]).collect();
    let image = Density::Image { values: &values, width: 12, height: 10, texture: Texture::PerVertex(&texture) };
    let weights: Vec<f32> = open.positions().iter().map(|[x, _, z]| (x + 0.5 * z).max(0.0)).collect();
    let vertices = Density::PerVertex(&weights);
    for (name, density, scale) in [
        ("density function", function, Scale::Radius(0.04)),
        ("density image", image, Scale::Count(2000.0)),
        ("density of vertices", vertices, Scale::Count(1500.0)),
    ] {
        let options = adaptive::Options::new(Radius::Density { density, scale }).seed(45);
        list.samples(&format!("adaptive, {name}"), &adaptive::sample(context, open, &options, None)?.0);
    }
    let by_count = Radius::Density { density: function, scale: Scale::Count(1500.0) };
    let options = adaptive::Options::new(by_count).seed(47).order(Order::Progressive);
    let (ordered, report) = adaptive::sample(context, open, &options, None)?;
    list.samples("adaptive, ordered count", &ordered);
    list.numbers("adaptive, ordered count: report", &[report.radius, report.covering_radius.unwrap_or(-1.0)]);
    Ok(())
}

fn adaptive(context: &Context, closed: &Mesh, open: &Mesh, list: &mut List) -> Result<()> {
    let radii: Vec<f32> = closed.positions().iter().map(|[x, ..]| 0.02 + 0.03 * (x + 1.4)).collect();
    let options = adaptive::Options::new(Radius::PerVertex(&radii)).seed(35);
    let (set, _) = adaptive::sample(context, closed, &options, None)?;
    list.samples("adaptive vertices", &set);
    let radius = Radius::Function { at: &|[_, _, z]| 0.03 + 0.01 * z, smallest: 0.02, largest: 0.04, slope: 0.011 };
    let options = adaptive::Options::new(radius).seed(36).cosine(0.5);
    list.samples("adaptive function", &adaptive::sample(context, open, &options, None)?.0);
    Ok(())
}

/// Gives [`Surface::few`].
fn relaxed(
    context: &Context,
    closed: &Mesh,
    maximal: &Points<3>,
    open: &Arc<Mesh>,
    list: &mut List,
) -> Result<Points<3>> {
    let options = RelaxOptions::default().max_iterations(30);
    let (samples, report) = relax(context, closed, &maximal.triangles, &maximal.barycentrics, &options, None)?;
    list.samples("relax surface", &samples);
    list.numbers("relax surface: report", &[report.motion, report.rho]);
    let (few, _) = psp::sample(context, open, &Options::new(0.06).seed(37), None)?;
    let options = RelaxOptions::default();
    let (samples, _) = relax(context, open, &few.triangles, &few.barycentrics, &options, None)?;
    list.samples("relax surface open", &samples);
    let remeshed = triangulate(context, open, &samples.triangles, &samples.barycentrics, None)?;
    let corners = remeshed.triangles.as_flattened();
    list.bytes("triangulate", &little_endian(corners, |vertex: u32| vertex.to_le_bytes()));
    Ok(few)
}
