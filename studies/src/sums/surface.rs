//! Samples of meshes, and their relaxation.

use std::sync::Arc;

use azulejo::dcr::surface::{Options as RelaxOptions, relax, triangulate};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Radius};
use azulejo::psp::{self, Engine, Options, Priority};
use azulejo::{Context, Result, SurfaceSamples};

use super::{meshes, print};

/// What is measured: a closed torus with a maximal set, and an open one with a set of few samples.
pub struct Surface {
    pub closed: Arc<Mesh>,
    pub maximal: SurfaceSamples,
    pub open: Arc<Mesh>,
    pub few: SurfaceSamples,
}

/// Prints the sums.
pub fn print(context: &Context) -> Result<Surface> {
    let closed = Arc::new(meshes::torus(96, 64, false)?);
    let open = Arc::new(meshes::torus(40, 24, true)?);
    let maximal = uniform(context, &closed, &open)?;
    adaptive(context, &closed, &open)?;
    let few = relaxed(context, &closed, &maximal, &open)?;
    Ok(Surface { closed, maximal, open, few })
}

/// The options of a set, with an engine that is not left to a default.
fn options(radius: f64, iterations: u32, engine: Engine, seed: u64) -> Options {
    Options::new(radius).iterations(iterations).maximal(true).seed(seed).engine(engine)
}

/// Gives [`Surface::maximal`].
fn uniform(context: &Context, closed: &Arc<Mesh>, open: &Arc<Mesh>) -> Result<SurfaceSamples> {
    use Engine::{Embree, Rasteriser};
    let sample = |name: &str, mesh: &Arc<Mesh>, options: Options| {
        let (samples, report) = psp::sample(context, mesh, &options, None)?;
        print::samples(name, &samples)?;
        let counts = [report.samples, report.darts, report.conflicts].map(|count| count as f64);
        print::numbers(&format!("{name}: report"), &[&counts[..], &[report.rho]].concat())?;
        Ok(samples)
    };
    let maximal = sample("fill only", closed, options(0.02, 0, Rasteriser, 28))?;
    sample("rasteriser 1", closed, options(0.02, 1, Rasteriser, 29))?;
    let by_projector = |options: Options| options.priority(Priority::Projector);
    let projected = by_projector(options(0.01, 3, Rasteriser, 30)).maximal(false);
    sample("rasteriser 3, projector, not maximal", open, projected)?;
    sample("embree 1", closed, options(0.02, 1, Embree, 31))?;
    sample("embree 2, projector", open, by_projector(options(0.01, 2, Embree, 32)))?;
    let mask = (0..open.triangles().len()).map(|i| i % 7 != 0).collect();
    let masked = Arc::new(Mesh::clone(open).with_mask(mask)?);
    sample("masked", &masked, options(0.03, 1, Rasteriser, 33))?;
    sample("soup", &Arc::new(meshes::soup()?), options(0.05, 1, Rasteriser, 34))?;
    Ok(maximal)
}

fn adaptive(context: &Context, closed: &Mesh, open: &Mesh) -> Result<()> {
    let radii: Vec<f32> = closed.positions().iter().map(|[x, ..]| 0.02 + 0.03 * (x + 1.4)).collect();
    let options = adaptive::Options::new(Radius::PerVertex(&radii)).seed(35);
    let (set, _) = adaptive::sample(context, closed, &options, None)?;
    print::samples("adaptive vertices", &set.samples)?;
    print::numbers("adaptive radii", &set.radii)?;
    let radius = Radius::Function { at: &|[_, _, z]| 0.03 + 0.01 * z, smallest: 0.02, largest: 0.04, slope: 0.011 };
    let options = adaptive::Options::new(radius).seed(36).cosine(0.5);
    print::samples("adaptive function", &adaptive::sample(context, open, &options, None)?.0.samples)
}

/// Gives [`Surface::few`].
fn relaxed(context: &Context, closed: &Mesh, maximal: &SurfaceSamples, open: &Arc<Mesh>) -> Result<SurfaceSamples> {
    let options = RelaxOptions::default().max_iterations(30);
    let (samples, report) = relax(context, closed, &maximal.triangles, &maximal.barycentrics, &options, None)?;
    print::samples("relax surface", &samples)?;
    print::numbers("relax surface: report", &[report.motion, report.rho])?;
    let (few, _) = psp::sample(context, open, &self::options(0.06, 0, Engine::Rasteriser, 37), None)?;
    let options = RelaxOptions::default();
    let (samples, _) = relax(context, open, &few.triangles, &few.barycentrics, &options, None)?;
    print::samples("relax surface open", &samples)?;
    let remeshed = triangulate(context, open, &samples.triangles, &samples.barycentrics, None)?;
    let corners = remeshed.triangles.as_flattened();
    print::bytes("triangulate", &print::little_endian(corners, |vertex: u32| vertex.to_le_bytes()))?;
    Ok(few)
}
