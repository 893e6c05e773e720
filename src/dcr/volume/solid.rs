//! Relaxation inside of meshes.

use crate::check;
use crate::dcr::relaxation::Limits;
use crate::dcr::volume::inside::Inside;
use crate::dcr::volume::relaxation::VolumeRelaxation;
use crate::dcr::volume::{Report, relax_set};
use crate::error::{Error, Result};
use crate::interior::Interior;
use crate::job::{Context, Progress};
use crate::memory;
use crate::mesh::Mesh;
use crate::setters::setters;

/// The options of [`relax_inside`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InsideOptions<'a> {
    /// As [`Options::max_iterations`](super::Options::max_iterations).
    pub max_iterations: u32,
    /// The key of the moves of coincident points. Used for nothing else.
    pub seed: u64,
    /// As [`Options::tolerance`](super::Options::tolerance).
    pub tolerance: f64,
    /// True for each point that stays where it is, as samples of the surface may; empty, the default, if none does.
    pub fixed: &'a [bool],
    /// True for each point that stands on the surface and moves along it, as the samples of the surface may; empty, the default, if
    /// none does.
    pub sliding: &'a [bool],
}

impl Default for InsideOptions<'_> {
    /// At most 100 steps, tolerance 0.001, no point fixed or sliding.
    fn default() -> Self {
        Self { max_iterations: 100, seed: 0, tolerance: 0.001, fixed: &[], sliding: &[] }
    }
}

impl InsideOptions<'_> {
    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.limits().check()
    }

    /// The conditions that end the steps.
    fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(InsideOptions<'a> {
    max_iterations: u32,
    seed: u64,
    tolerance: f64,
    fixed: &'a [bool],
    sliding: &'a [bool],
});

/// The peak memory for a point and all of its data, and for what is made for the inside of a mesh, for each triangle.
const BYTES_PER_POINT: f64 = 350.0;
const BYTES_PER_TRIANGLE: f64 = 200.0;

/// Relaxes points inside a mesh as [`relax`](fn@super::relax) does those of a bounded cuboid: returns as
/// many, in the same order, of which those that are `fixed` are where they were.
///
/// Those that are `sliding` lie on the surface, before and after. Before: no farther from it than 0.001 spacings; after: than two
/// float spacings of the box around the mesh, and 10^-7 of its size. They pass edges, and are pushed by all others, but do not
/// change to another sheet.
///
/// All others are inside, before and after, by [`Interior::contains`] of the returned floats, of the mesh with the caps that close its
/// holes in [`volume::sample_inside`](crate::volume::sample_inside); no point slides on a cap. A step that would leave the inside ends
/// at the surface and goes on along it, or is shortened. Those that are fixed lie anywhere in the box around the mesh; the others are
/// pushed by them twice as far as by each other.
///
/// Made for sets of [`volume::sample_inside`](crate::volume::sample_inside), in which the samples of the surface, if they come
/// first, are the ones to be fixed or to slide. Points that are clustered are not redistributed, and get no farther than the steps lead. A
/// single point and an empty set are returned unchanged. Coincident points are first moved by 0.001 to 0.002 spacings.
///
/// The unit of length of the forces is that of as many points, fixed ones included, in the volume of the inside and a layer of 0.1
/// spacings all along the surface. The result is the same for every number of threads. A call that is cancelled succeeds, and
/// says so in its report: the set after the last whole step is returned.
///
/// O(n log t) time for `n` points and `t` triangles, then O(n) for each step and O(log t) for those of its points that are near the
/// surface; O(n + t) memory. The inside is made once for a mesh, in O(t log t): [`Interior::of`].
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of their range, for a `fixed` or `sliding` of another
/// length than the points, for a point that is both, and for `positions` that are not finite, outside, or sliding off the surface
/// (with the index); [`Error::TooLarge`] for more than 2^32 - 1 points or the available memory.
pub fn relax_inside(
    context: &Context,
    mesh: &Mesh,
    options: &InsideOptions,
    points: &[[f32; 3]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 3]>, Report)> {
    options.check()?;
    let &InsideOptions { max_iterations, seed, fixed, sliding, .. } = options;
    for (name, entries) in [("fixed", fixed), ("sliding", sliding)] {
        if !entries.is_empty() && entries.len() != points.len() {
            return Err(Error::invalid(name, format!("has {} entries for {} points", entries.len(), points.len())));
        }
    }
    if let Some(point) = fixed.iter().zip(sliding).position(|(&fixed, &sliding)| fixed && sliding) {
        return Err(Error::invalid("sliding", format!("point {point} is fixed")));
    }
    check::indexable("positions", "points", points.len())?;
    check::finite("positions", "point", points)?;
    let capped = mesh.with_caps()?;
    let solid = capped.as_deref().unwrap_or(mesh);
    let triangles = solid.triangles().len();
    let bytes = BYTES_PER_POINT * points.len() as f64 + BYTES_PER_TRIANGLE * triangles as f64;
    memory::require(bytes, "positions", &format!("{} points inside {triangles} triangles", points.len()))?;
    let (interior, surface) = (Interior::of(solid), Interior::of(mesh));
    let inside = Inside::new(solid, [&interior, &surface], points, [fixed, sliding]);
    inside.check(context)?;
    let mut set = VolumeRelaxation::new(*inside.torus(), points, max_iterations, seed).inside(inside);
    let domain = inside.torus().domain();
    relax_set(context, options.limits(), &mut set, &domain, inside.packed_distance(), points, progress)
}
