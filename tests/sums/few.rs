//! One small sum of each kind, for machines that are emulated.

use std::sync::Arc;

use azulejo::analysis::coverage::{coverage_2d, surface_coverage};
use azulejo::analysis::differential::surface_differences;
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spectrum::periodogram;
use azulejo::dcr::{self, Density, Neighbourhood};
use azulejo::kdrt::{self, CountOptions, MergeOptions, Piece};
use azulejo::psp::{self, Engine, adaptive};
use azulejo::{Boundary, Classes, Context, Domain, Given, Order, Result, maximal, thin};

use crate::list::{List, little_endian};
use crate::meshes;
use crate::plane::{SQUARE, TORUS};

/// Adds the sums.
pub fn sums(context: &Context, list: &mut List) -> Result<()> {
    let set = plane(context, list)?;
    relaxation(context, &set, list)?;
    surface(context, list)
}

/// Sets of the plane; gives one of 400 samples of the torus.
fn plane(context: &Context, list: &mut List) -> Result<Vec<[f32; 2]>> {
    list.points("maximal", &maximal::sample(context, &maximal::Options::new(0.03).domain(TORUS).seed(1), None)?);
    let options = kdrt::Options::new(0.006).leaf_size(8.0).domain(TORUS).seed(2);
    let whole = kdrt::sample(context, &options, None)?;
    list.points("kdrt", &whole);
    list.points("kdrt bounded", &kdrt::sample(context, &options.domain(SQUARE).radius(0.01), None)?);
    list.points("window", &kdrt::sample_window(context, &options, [0.9, 0.0], [1.0, 0.1], None)?);
    let given = whole[..500].iter().map(|&[x, y]| [0.5 * x, y]).collect::<Vec<_>>();
    let around = options.radius(0.02).given(Given::at(&given));
    list.points("around", &kdrt::sample(context, &around, None)?);
    let ordered = kdrt::sample_ranked(context, &options.radius(0.02).order(Order::Progressive), None)?;
    list.points("ordered", &ordered.samples);
    list.bytes("ordered: ranks", &little_endian(&ordered.ranks, f32::to_le_bytes));
    let classes = Classes::of_radii(&[0.02, 0.03], 1.0)?;
    let in_classes = kdrt::sample_classes(context, &kdrt::Options::new(0.0).domain(SQUARE).seed(3), &classes, None)?;
    list.points("classes", &in_classes.samples);
    list.bytes("classes: classes", &little_endian(&in_classes.classes, u32::to_le_bytes));
    let plane = kdrt::ClassPlane::new(
        context,
        &kdrt::Options::new(0.0).seed(14).given(Given::at(&given[..9])),
        &classes,
        None,
    )?;
    let part = plane.window([0.2, 0.5], [0.7, 1.0])?;
    list.points("classes around, window", &part.samples);
    list.bytes("classes around, window: classes", &little_endian(&part.classes, u32::to_le_bytes));
    let half = Domain { min: [0.0; 2], max: [0.5, 1.0], boundary: Boundary::Bounded };
    let samples = kdrt::sample(context, &options.radius(0.02).domain(half), None)?;
    let piece = Piece { samples: &samples, min: half.min, max: half.max };
    let merge = MergeOptions::new(0.02).domain(SQUARE).seed(4);
    list.points("merge", &kdrt::merge(context, &merge, &[piece], &[[0.5; 2]], None)?.0);
    let thinned = thin::thin(context, &thin::Options::progressive().seed(5), &given, None)?;
    list.bytes("thin", &little_endian(&thinned.indices, u32::to_le_bytes));
    let counted = kdrt::sample_count(context, &CountOptions::new(400).domain(TORUS).leaf_size(20.0).seed(6), None)?;
    list.points("count", &counted.samples);
    Ok(counted.samples)
}

/// Relaxation of a set of the torus, by both methods and with a density; and what is measured of it.
fn relaxation(context: &Context, set: &[[f32; 2]], list: &mut List) -> Result<()> {
    let mut relax = |name: &str, options: dcr::Options| {
        let (relaxed, report) = dcr::relax(context, &options.max_iterations(40), set, None)?;
        list.points(name, &relaxed);
        list.numbers(&format!("{name}: report"), &[report.motion, report.rho, report.coverage]);
        Ok::<_, azulejo::Error>(relaxed)
    };
    let relaxed = relax("relax", dcr::Options::new(TORUS, Neighbourhood::Delaunay).seed(7))?;
    relax("relax nearest", dcr::Options::new(SQUARE, Neighbourhood::Nearest).seed(8))?;
    relax("relax, thesis", dcr::Options::thesis(TORUS, Neighbourhood::Delaunay))?;
    let options = dcr::Options::new(TORUS, Neighbourhood::Delaunay).seed(15).max_iterations(40);
    let classes: Vec<u32> = (0..set.len() as u32).map(|i| i % 3).collect();
    list.points("relax classes", &dcr::relax_classes(context, &options, set, &classes, None)?.0);
    let density = |[x, y]: [f64; 2]| 0.1 + x * y;
    let density = Density::Function(&density);
    let start = dcr::scatter(context, &SQUARE, &density, 300, 9, None)?;
    let options = dcr::Options::new(SQUARE, Neighbourhood::Delaunay).seed(10).max_iterations(40);
    list.points("relax, density", &dcr::relax_with_density(context, &options, &density, &start, None)?.0);
    let spectrum = periodogram(context, &TORUS, &relaxed, 24, None)?;
    list.bytes("spectrum", &little_endian(spectrum.power(), f32::to_le_bytes));
    list.bytes("figures", format!("{:?}", figures_2d(context, &TORUS, &relaxed, None)?).as_bytes());
    list.bytes("coverage", format!("{:?}", coverage_2d(context, &SQUARE, &start, 0.1, None)?).as_bytes());
    Ok(())
}

/// Sets on a torus, one of them relaxed, and what is measured of it.
fn surface(context: &Context, list: &mut List) -> Result<()> {
    let mesh = Arc::new(meshes::torus(24, 16, false)?);
    let options = psp::Options::new(0.08).maximal(true).iterations(0).engine(Engine::Rasteriser).seed(11);
    let mut sample = |name: &str, options: psp::Options| {
        let (samples, report) = psp::sample(context, &mesh, &options, None)?;
        list.samples(name, &samples);
        list.numbers(&format!("{name}: report"), &[report.rho, report.radius]);
        Ok::<_, azulejo::Error>(samples)
    };
    let filled = sample("fill", options)?;
    sample("rasteriser", options.iterations(1))?;
    sample("around on the mesh", options.radius(0.1).given(Given::at(&filled.positions[..20])).cosine(0.3))?;
    sample("ordered on the mesh", options.radius(0.15).order(Order::Progressive))?;
    let classes = Classes::of_radii(&[0.1, 0.2], 1.0)?;
    let (in_classes, _) = psp::sample_classes(context, &mesh, &psp::Options::new(0.0).seed(12), &classes, None, None)?;
    list.samples("classes on the mesh", &in_classes);
    let given = psp::Options::new(0.0).seed(16).given(Given::at(&filled.positions[..20]));
    list.samples("classes around on the mesh", &psp::sample_classes(context, &mesh, &given, &classes, None, None)?.0);
    let moved = mesh.deformed(mesh.positions().iter().map(|&[x, y, z]| [x, 2.0 * y, z - 0.1 * x * y]).collect())?;
    list.samples("deformed", &moved.samples_at(&filled.triangles, &filled.barycentrics)?);
    let weights: Vec<f32> = mesh.positions().iter().map(|[x, ..]| x.max(0.0)).collect();
    let density = adaptive::Density::PerVertex(&weights);
    let by_density = adaptive::Radius::Density { density, scale: adaptive::Scale::Count(300.0) };
    let options = adaptive::Options::new(by_density).seed(17);
    list.samples("adaptive, density", &adaptive::sample(context, &mesh, &options, None)?.0);
    let radii: Vec<f32> = mesh.positions().iter().map(|[x, ..]| 0.1 + 0.05 * (x + 1.4)).collect();
    let by_vertex = adaptive::Options::new(adaptive::Radius::PerVertex(&radii)).seed(13);
    list.samples("adaptive", &adaptive::sample(context, &mesh, &by_vertex, None)?.0);
    let (ordered, _) = adaptive::sample(context, &mesh, &by_vertex.order(Order::Progressive).quotient(1.3), None)?;
    list.samples("adaptive, ordered", &ordered);
    list.bytes("adaptive, ordered: ranks", &little_endian(&ordered.ranks, f32::to_le_bytes));
    let options = dcr::surface::Options::default().max_iterations(20);
    let (relaxed, _) = dcr::surface::relax(context, &mesh, &filled.triangles, &filled.barycentrics, &options, None)?;
    list.samples("relax on the mesh", &relaxed);
    let triangulation = dcr::surface::triangulate(context, &mesh, &relaxed.triangles, &relaxed.barycentrics, None)?;
    list.bytes("triangulate", &little_endian(triangulation.triangles.as_flattened(), u32::to_le_bytes));
    let coverage = surface_coverage(context, &mesh, &relaxed.positions, 0.1, None)?;
    list.bytes("coverage of the mesh", format!("{coverage:?}").as_bytes());
    let (positions, normals) = (&relaxed.positions, &relaxed.normals);
    let differences = surface_differences(context, &mesh, positions, normals, [1.0, 0.0, 0.0], 16, None)?;
    list.numbers("differences", &differences.density());
    Ok(())
}
