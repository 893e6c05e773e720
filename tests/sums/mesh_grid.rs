//! The grid of meshes: each way to make a set by all that can be asked of it.

use std::sync::Arc;

use azulejo::analysis::coverage::surface_coverage;
use azulejo::analysis::differential::surface_differences;
use azulejo::dcr::surface::{self, relax, triangulate};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Density, Radius, Scale, Texture};
use azulejo::psp::{self, ClassOptions, Engine, Options, ProjectionOptions, Projectors, Report};
use azulejo::{Classes, Context, Given, Order, Points, Result};

use super::list::{List, little_endian};
use super::meshes;

/// Both halves of the grid have the same calls, on tori of these many columns and rows of quads.
struct Size {
    columns: u32,
    rows: u32,
    /// The radius of a set that is filled by cubes, where that is worthwhile.
    filled: f64,
    /// The radius where a call makes many levels, or projects.
    coarse: f64,
    /// An exact number of samples.
    count: usize,
}

/// Sets that WebAssembly makes in a moment.
const SMALL: Size = Size { columns: 24, rows: 16, filled: 0.1, coarse: 0.15, count: 300 };
const LARGE: Size = Size { columns: 40, rows: 24, filled: 0.018, coarse: 0.08, count: 1500 };

/// A cosine by which triangles of neighbouring rows of the tube ignore each other.
const COSINE: f64 = 0.99;

/// Adds the sums of small sets or of large ones.
pub fn sums(context: &Context, is_small: bool, list: &mut List) -> Result<()> {
    let size = if is_small { &SMALL } else { &LARGE };
    let closed = meshes::torus(size.columns, size.rows, false)?;
    let open = meshes::torus(size.columns, size.rows, true)?;
    let mask = (0..open.triangles().len()).map(|i| i % 7 != 0).collect();
    let masked = Mesh::clone(&open).with_mask(mask)?;
    for (place, mesh, cosine) in [("closed", closed, -1.0), ("masked", masked, -1.0), ("cosine", open, COSINE)] {
        let mesh = Arc::new(mesh);
        let options = Options::new(size.coarse).seed(80);
        let (start, _) = psp::sample(context, &mesh, &options, None)?;
        let given: Vec<_> = start.positions.iter().step_by(30).copied().collect();
        uniform(context, place, &mesh, (cosine, &given), size, list)?;
        adaptive(context, place, &mesh, (cosine, &given), size, list)?;
        if place != "cosine" {
            projected(context, place, &mesh, &given, size, list)?;
            relaxed_and_measured(context, place, &mesh, &start, size, list)?;
        }
    }
    Ok(())
}

/// Clearances of given samples from each class, over four orders.
fn clearances(given: &[[f32; 3]], classes: usize) -> Vec<f64> {
    (0..classes * given.len()).map(|i| 0.2 / [1.0, 7.0, 60.0, 1000.0, 20000.0][i % 5]).collect()
}

/// Adds a set and what is reported of it, of which times differ.
fn add(list: &mut List, name: &str, (samples, report): (Points<3>, Report)) {
    list.samples(name, &samples);
    let counts = [report.samples, report.darts, report.conflicts].map(|count| count as f64);
    let numbers = [report.rho, report.radius, report.covering_radius.unwrap_or(-1.0)];
    list.numbers(&format!("{name}: report"), &[counts, numbers].concat());
}

/// Sets of one radius, filled and by the default, by count, in order, in classes; around nothing and around given samples.
fn uniform(
    context: &Context,
    place: &str,
    mesh: &Arc<Mesh>,
    (cosine, positions): (f64, &[[f32; 3]]),
    size: &Size,
    list: &mut List,
) -> Result<()> {
    let [own, of_classes] = [1, 2].map(|classes| clearances(positions, classes));
    let classes = Classes::of_radii(&[size.coarse, 1.5 * size.coarse], 0.9)?;
    let masks: Vec<u32> = (0..mesh.triangles().len() as u32).map(|i| if i % 9 < 5 { 3 } else { i % 4 }).collect();
    for (around, given, of_classes) in [
        ("", Given::default(), Given::default()),
        (", given", Given::with_clearances(positions, &own), Given::with_clearances(positions, &of_classes)),
    ] {
        for (name, options) in [
            ("fill", Options::new(size.filled).projected(false)),
            ("by the faster way", Options::new(size.filled)),
            ("count", Options::by_count(size.count)),
            ("ordered", Options::new(size.coarse).order(Order::Progressive)),
            ("ordered count", Options::by_count(size.count).order(Order::Progressive).quotient(1.3)),
        ] {
            let options = options.seed(81).cosine(cosine).given(given);
            add(list, &format!("{place}, {name}{around}"), psp::sample(context, mesh, &options, None)?);
        }
        let options = ClassOptions::default().seed(82).cosine(cosine).given(of_classes);
        for (name, masks) in [("classes", None), ("classes of triangles", Some(&masks[..]))] {
            let set = psp::sample_classes(context, mesh, &options, &classes, masks, None)?;
            add(list, &format!("{place}, {name}{around}"), set);
        }
    }
    Ok(())
}

/// Sets of projectors, filled afterwards or not.
fn projected(
    context: &Context,
    place: &str,
    mesh: &Arc<Mesh>,
    positions: &[[f32; 3]],
    size: &Size,
    list: &mut List,
) -> Result<()> {
    let own = clearances(positions, 1);
    for (around, given) in [
        ("", Given::default()),
        (", given", Given::with_clearances(positions, &own)),
        (", given alike", Given::at(positions)),
    ] {
        for (name, iterations, maximal) in [("projected", 2, false), ("projected and filled", 1, true)] {
            let options = ProjectionOptions::new(size.coarse)
                .seed(83)
                .given(given)
                .projectors(Projectors::Global)
                .engine(Engine::Rasteriser);
            let set = psp::project(context, mesh, &options, iterations, maximal, None)?;
            add(list, &format!("{place}, {name}{around}"), set);
        }
    }
    Ok(())
}

/// Sets of radii that vary, by each way to say how, in any order and progressive, around nothing and given samples.
fn adaptive(
    context: &Context,
    place: &str,
    mesh: &Mesh,
    (cosine, positions): (f64, &[[f32; 3]]),
    size: &Size,
    list: &mut List,
) -> Result<()> {
    let own = clearances(positions, 1);
    let (coarse, count) = (size.coarse, Scale::Count(size.count as f64));
    let of_vertices = |at: &dyn Fn(f32) -> f32| mesh.positions().iter().map(|[x, ..]| at(*x)).collect::<Vec<_>>();
    let radii = of_vertices(&|x| coarse as f32 * (0.6 + 0.4 * (x + 1.4)));
    let weights = of_vertices(&|x| (x + 0.5).max(0.0));
    let texture: Vec<[f32; 2]> = mesh.positions().iter().map(|&[x, y, _]| [x, y]).collect();
    let values: Vec<f32> = (0..12 * 10).map(|i| if i % 5 == 0 { 0.0 } else { (i % 7) as f32 }).collect();
    let image = Density::Image { values: &values, width: 12, height: 10, texture: Texture::PerVertex(&texture) };
    let at = |[_, _, z]: [f64; 3]| coarse * (1.0 + 0.5 * z);
    let function = Radius::Function { at: &at, smallest: 0.7 * coarse, largest: 1.3 * coarse, slope: 0.6 * coarse };
    for (name, radius) in [
        ("radii of vertices", Radius::PerVertex(&radii)),
        ("radii of a function", function),
        ("density of vertices", Radius::Density { density: Density::PerVertex(&weights), scale: count }),
        ("density of an image", Radius::Density { density: image, scale: count }),
    ] {
        for (in_order, order) in [("", Order::Any), (", ordered", Order::Progressive)] {
            for (around, given) in [("", Given::default()), (", given", Given::with_clearances(positions, &own))] {
                let options = adaptive::Options::new(radius).seed(84).cosine(cosine).order(order).quotient(1.3);
                let (set, report) = adaptive::sample(context, mesh, &options.given(given), None)?;
                add(list, &format!("{place}, {name}{in_order}{around}"), (set, report));
            }
        }
    }
    Ok(())
}

/// Some iterations of relaxation, the mesh of what they give, and what is measured of it.
fn relaxed_and_measured(
    context: &Context,
    place: &str,
    mesh: &Mesh,
    start: &Points<3>,
    size: &Size,
    list: &mut List,
) -> Result<()> {
    let options = surface::Options::default().max_iterations(20);
    let (relaxed, report) = relax(context, mesh, &start.triangles, &start.barycentrics, &options, None)?;
    list.samples(&format!("{place}, relax"), &relaxed);
    list.numbers(&format!("{place}, relax: report"), &[report.motion, report.rho]);
    let remeshed = triangulate(context, mesh, &relaxed.triangles, &relaxed.barycentrics, None)?;
    let corners = remeshed.triangles.as_flattened();
    list.bytes(&format!("{place}, triangulate"), &little_endian(corners, u32::to_le_bytes));
    let moved = mesh.deformed(mesh.positions().iter().map(|&[x, y, z]| [x, 2.0 * y, z - 0.1 * x * y]).collect())?;
    list.samples(&format!("{place}, deformed"), &moved.samples_at(&start.triangles, &start.barycentrics)?);
    let coverage = surface_coverage(context, mesh, &relaxed.positions, size.coarse, None)?;
    list.bytes(&format!("{place}, coverage"), format!("{coverage:?}").as_bytes());
    let (positions, normals) = (&relaxed.positions, &relaxed.normals);
    let differences = surface_differences(context, mesh, positions, normals, [1.0, 0.0, 0.0], 16, None)?;
    list.numbers(&format!("{place}, differences"), &differences.density());
    Ok(())
}
