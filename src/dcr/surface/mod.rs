//! Relaxation on triangle meshes: what DCR does in the plane, done on a surface (the future work of thesis §4.5).
//!
//! Samples push their neighbours away and are pulled into holes by the constraints of the plane's best method, and with its
//! momentum. What differs:
//!
//! * neighbours are those that are reached on the surface without leaving a ball (`near.rs`), seen in the tangent plane,
//!   each at its straight distance through space; the other side of a thin wall plays no part;
//! * each sample finds its Delaunay star among them for itself (`star.rs`): there is no triangulation to be kept;
//! * samples walk straight on, from triangle to triangle (`walk.rs`), so they are on the surface at all times;
//! * at open borders neighbours are mirrored, so that samples neither leave nor crowd there;
//! * no two samples get nearer to each other through space than the nearest two were (`apart.rs`), on whatever sheets;
//! * long waves of the density stay: there is no Fourier transform on a mesh.
//!
//! Triangles are connected by common edges. A crack is a border: those on its two sides do not see each other, but keep their
//! distance through space.

mod apart;
mod near;
mod set;
mod sheet;
mod star;
mod triangles;
mod view;
mod walk;

pub use triangles::{Triangulation, triangulate};

use glam::DVec2;

use crate::dcr::Stopped;
use crate::error::{Error, Result};
use crate::geometry::grid3;
use crate::job::{Context, Job, Progress};
use crate::mesh::{Mesh, round_barycentrics};
use crate::points::SurfaceSamples;
use crate::rng::{Draw, Rng};
use crate::setters::setters;
use set::Set;
use sheet::Sheet;
use walk::Place;

/// How far rounding may have carried barycentrics out of their triangle.
const ROUNDING: f64 = 1e-6;

/// How far samples are moved that coincide with others, or lie on an edge of their triangle, in spacings.
const PARTING: f64 = 1e-3;

/// How often that is tried for those that would get too near to others.
const ATTEMPTS: u64 = 16;

/// The options of [`relax`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The largest number of steps. 0 returns the samples as they are, those that rounding has put outside their triangle on
    /// its edge.
    pub max_iterations: u32,
    /// The motion ([`Report::motion`]) at which the set has converged; 0 makes all steps unless nothing moves at all.
    pub tolerance: f64,
    /// Where samples that coincide are moved; used for nothing else.
    pub seed: u64,
}

impl Default for Options {
    /// At most 100 steps, tolerance 0.0005.
    fn default() -> Self {
        Self { max_iterations: 100, tolerance: 0.0005, seed: 0 }
    }
}

setters!(Options { max_iterations: u32, tolerance: f64, seed: u64 });

/// What [`relax`] did. `d_max = sqrt(2 A / (sqrt(3) N))` is the distance of neighbours if the samples stood in hexagonal
/// arrangement on a plane of the mesh's area A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// Why there were no more.
    pub stopped: Stopped,
    /// Half of how far samples got over the last 10 steps, or since the start if there were fewer: root mean square, in
    /// units of `d_max`.
    pub motion: f64,
    /// The smallest straight distance between two of the returned samples, in the units of the mesh, on whatever sheets
    /// they are; infinite for less than two.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; infinite for less than two samples. Relaxed maximal sets end at 0.85 on the
    /// bunny, 0.84 on the dragon, and lower, 0.75, on thin blades: parts nearer to each other than samples are.
    pub rho: f64,
}

/// Relaxes samples on a mesh: sample `i` is the point `barycentrics[i]` of `triangles[i]`, as in [`SurfaceSamples`], and
/// of any density. The samples are returned in their order, each on its triangle.
///
/// A cancelled call succeeds: it returns the samples after the last whole step, and says so in its report.
///
/// Takes O(triangles log triangles) and then, for each step, O(samples) for samples that are spread about evenly. Finding
/// neighbours, every few steps, takes O(triangles) besides. Memory is O(triangles + samples).
///
/// # Errors
/// [`Error::InvalidArgument`] for triangles that the mesh does not have, that its mask leaves out or that have no area
/// (`triangles`), for barycentrics that are not as many, not finite or outside the triangle by more than rounding
/// (`barycentrics`), and for a `tolerance` that is not at least 0; [`Error::TooLarge`] for more than 2^32 - 1 samples and
/// for a mesh of more than 2^32 / 3 triangles.
pub fn relax(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(SurfaceSamples, Report)> {
    check(mesh, triangles, barycentrics)?;
    if !(0.0..).contains(&options.tolerance) {
        return Err(Error::invalid("tolerance", format!("{} is not at least 0", options.tolerance)));
    }
    crate::dcr::require_memory("triangles", triangles.len())?;
    let sheet = Sheet::new(mesh)?;
    let spacing = hexagonal_distance(mesh, triangles.len());
    let places: Vec<Place> = triangles.iter().zip(barycentrics).map(place).collect();
    let positions = places.iter().map(|place| place.position(mesh).as_vec3().to_array()).collect::<Vec<_>>();
    let floor = context.run(None, |job| grid3::smallest_distance(job, &positions))?;
    let mut set = Set::new(&sheet, spacing, floor, places);
    let steps = context.run(progress, |job| make_steps(job, options, spacing, &mut set));
    let stopped = match steps {
        Err(Error::Cancelled) => Stopped::Cancelled,
        steps => steps?,
    };
    let samples = match set.iterations() {
        0 => {
            let on_triangle = |&uv: &[f32; 2]| round_barycentrics(uv.map(f64::from));
            mesh.samples(triangles.to_vec(), barycentrics.iter().map(on_triangle).collect())
        }
        _ => leave(mesh, set.places()),
    };
    let smallest_distance = context.run(None, |job| grid3::smallest_distance(job, &samples.positions))?;
    let report = Report {
        iterations: set.iterations(),
        stopped,
        motion: set.motion(),
        smallest_distance,
        rho: smallest_distance / spacing,
    };
    Ok((samples, report))
}

/// The distance of neighbours if so many samples stood in hexagonal arrangement on the area of the mesh.
fn hexagonal_distance(mesh: &Mesh, count: usize) -> f64 {
    (2.0 * mesh.area() / (3f64.sqrt() * count.max(1) as f64)).sqrt()
}

/// Refuses what is no place on the mesh.
fn check(mesh: &Mesh, triangles: &[u32], barycentrics: &[[f32; 2]]) -> Result<()> {
    let count = mesh.triangles().len();
    if triangles.len() > u32::MAX as usize {
        return Err(Error::too_large("triangles", format!("{} samples; the limit is {}", triangles.len(), u32::MAX)));
    }
    if barycentrics.len() != triangles.len() {
        let reason = format!("there are {}, and {} triangles", barycentrics.len(), triangles.len());
        return Err(Error::invalid("barycentrics", reason));
    }
    for (i, (&triangle, &[u, v])) in triangles.iter().zip(barycentrics).enumerate() {
        if triangle as usize >= count {
            return Err(Error::invalid("triangles", format!("[{i}] is {triangle}, and the mesh has {count}")));
        }
        if mesh.triangle_area(triangle) <= 0.0 {
            let reason = if mesh.is_sampled(triangle) { "has no area" } else { "is left out by the mesh's mask" };
            return Err(Error::invalid("triangles", format!("[{i}] is {triangle}, which {reason}")));
        }
        let weights = [u.into(), v.into(), 1.0 - f64::from(u) - f64::from(v)];
        // The comparison fails for NaN too.
        if !weights.iter().all(|&weight| weight >= -ROUNDING) {
            return Err(Error::invalid("barycentrics", format!("[{i}] is ({u}, {v}), outside the triangle")));
        }
    }
    Ok(())
}

/// A sample as a place.
fn place((&triangle, &uv): (&u32, &[f32; 2])) -> Place {
    let [u, v] = round_barycentrics(uv.map(f64::from)).map(f64::from);
    Place { triangle, uv: DVec2::new(u, v) }
}

/// The places of the set, none at that of another and none on an edge: a sample on the border would coincide with its mirror
/// image. Where it has to, a sample moves a little towards a random point of its triangle. None if none has to.
fn parted(set: &Set, spacing: f64, seed: u64, attempt: u64) -> Option<Vec<Place>> {
    let (mesh, mut places) = (set.mesh(), set.places().to_vec());
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    let bits = |i: u32| set.positions()[i as usize].to_array().map(f64::to_bits);
    order.sort_unstable_by_key(|&i| (bits(i), i));
    let repeated = order.windows(2).filter(|pair| bits(pair[0]) == bits(pair[1])).map(|pair| pair[1]);
    let on_edges = (0..places.len() as u32).filter(|&i| {
        let uv = places[i as usize].uv;
        uv.min_element() == 0.0 || uv.element_sum() == 1.0
    });
    let mut parted: Vec<u32> = repeated.chain(on_edges).collect();
    parted.sort_unstable();
    parted.dedup();
    for &i in &parted {
        let place = &mut places[i as usize];
        let mut rng = Rng::at(seed, Draw::Part, &[i.into(), attempt]);
        let (along, across) = (rng.unit().sqrt(), rng.unit());
        let aim = DVec2::new(along * (1.0 - across), along * across);
        let at = |uv: DVec2| mesh.point_exact(place.triangle, uv.into());
        let distance = at(place.uv).distance(at(aim));
        place.uv = place.uv.lerp(aim, (PARTING * spacing / distance).min(1.0));
    }
    (!parted.is_empty()).then_some(places)
}

/// The places as samples, by rounded barycentrics.
fn leave(mesh: &Mesh, places: &[Place]) -> SurfaceSamples {
    let triangles = places.iter().map(|place| place.triangle).collect();
    mesh.samples(triangles, places.iter().map(|place| round_barycentrics(place.uv.into())).collect())
}

/// Steps until the motion ends or the steps do.
fn make_steps(job: &Job, options: &Options, spacing: f64, set: &mut Set) -> Result<Stopped> {
    if set.places().len() < 2 {
        return Ok(Stopped::Converged);
    }
    let attempts = if options.max_iterations > 0 { ATTEMPTS } else { 0 };
    for attempt in 0..attempts {
        let Some(places) = parted(set, spacing, options.seed, attempt) else { break };
        set.shift(&job.part(0.0, 0.0), &places)?;
    }
    let share = |iteration: u32| f64::from(iteration) / f64::from(options.max_iterations);
    for iteration in 0..options.max_iterations {
        set.step(&job.part(share(iteration), share(iteration + 1)))?;
        if set.has_settled(options.tolerance) {
            return Ok(Stopped::Converged);
        }
    }
    Ok(Stopped::Steps)
}
