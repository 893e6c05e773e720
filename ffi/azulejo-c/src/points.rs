//! Results: samples of the plane, of a mesh or of a cuboid.

use azulejo_core::Points;

use crate::boundary::array;
use crate::handles::{self, handle};

/// The samples that a call made. Each array has an entry per sample, in the same order, and is NULL
/// for an empty set and where a set has no such array.
pub struct azulejo_points {
    pub(crate) samples: Samples,
    /// The radius of each sample, where it varies.
    radii: Vec<f64>,
    /// The rank of each sample of a progressive set.
    ranks: Vec<f32>,
    /// The class of each sample of a set of several.
    classes: Vec<u32>,
    /// The id of each sample of a set that is edited.
    pub(crate) ids: Vec<u64>,
}

handle!(azulejo_points);

pub(crate) enum Samples {
    Plane(Vec<[f32; 2]>),
    Space(Box<Points<3>>),
}

impl azulejo_points {
    fn of(samples: Samples) -> Self {
        Self { samples, radii: Vec::new(), ranks: Vec::new(), classes: Vec::new(), ids: Vec::new() }
    }

    /// Samples of the plane, with their ranks, classes or ids if they have any.
    pub(crate) fn plane(points: impl Into<Points<2>>) -> Self {
        let Points { positions, ranks, classes, ids, .. } = points.into();
        Self { ranks, classes, ids, ..Self::of(Samples::Plane(positions)) }
    }

    /// Samples of a mesh or of a cuboid, with all that they have.
    pub(crate) fn space(mut samples: Points<3>) -> Self {
        let (ranks, classes) = (std::mem::take(&mut samples.ranks), std::mem::take(&mut samples.classes));
        let (radii, ids) = (std::mem::take(&mut samples.radii), std::mem::take(&mut samples.ids));
        Self { ranks, classes, radii, ids, ..Self::of(Samples::Space(Box::new(samples))) }
    }
}

/// The samples of a handle, if they are those of a mesh or of a cuboid, where the arrays of meshes are empty.
///
/// # Safety
/// As [`handles::get`].
unsafe fn surface<'a>(points: *const azulejo_points) -> Option<&'a Points<3>> {
    // SAFETY: handed on from the caller.
    match unsafe { handles::peek("points", points) }.map(|points| &points.samples) {
        Some(Samples::Space(samples)) => Some(samples),
        _ => None,
    }
}

/// The number of samples; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_count(points: *const azulejo_points) -> usize {
    // SAFETY: handed on from the caller.
    match unsafe { handles::peek("points", points) }.map(|points| &points.samples) {
        Some(Samples::Plane(samples)) => samples.len(),
        Some(Samples::Space(samples)) => samples.len(),
        None => 0,
    }
}

/// The number of coordinates of a position: 2 in the plane, 3 in space; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_dimension(points: *const azulejo_points) -> u32 {
    // SAFETY: handed on from the caller.
    match unsafe { handles::peek("points", points) }.map(|points| &points.samples) {
        Some(Samples::Plane(_)) => 2,
        Some(Samples::Space(_)) => 3,
        None => 0,
    }
}

/// The positions, x y or x y z of each sample, interleaved. Samples on a mesh lie on their
/// triangle: they are computed from the barycentrics in double arithmetic and rounded once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_positions(points: *const azulejo_points) -> *const f32 {
    // SAFETY: handed on from the caller.
    match unsafe { handles::peek("points", points) }.map(|points| &points.samples) {
        Some(Samples::Plane(samples)) => array(samples),
        Some(Samples::Space(samples)) => array(&samples.positions),
        None => std::ptr::null(),
    }
}

/// On a mesh, the unit normals of the samples' triangles, x y z each, on the side from which their
/// vertices appear counter-clockwise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_normals(points: *const azulejo_points) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { surface(points) }.map_or(std::ptr::null(), |samples| array(&samples.normals))
}

/// On a mesh that carries normals, these, interpolated with the barycentrics and normalised, x y z
/// each; the normal of the triangle where the sum is zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_interpolated_normals(points: *const azulejo_points) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { surface(points) }.map_or(std::ptr::null(), |samples| array(&samples.interpolated_normals))
}

/// On a mesh, the index of each sample's triangle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_triangles(points: *const azulejo_points) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { surface(points) }.map_or(std::ptr::null(), |samples| array(&samples.triangles))
}

/// On a mesh, the barycentric coordinates u v of each sample in its triangle (a, b, c), as in
/// Embree: the position is (1-u-v)*a + u*b + v*c, and so are other attributes of the vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_barycentrics(points: *const azulejo_points) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { surface(points) }.map_or(std::ptr::null(), |samples| array(&samples.barycentrics))
}

/// The radius of each sample of the calls that have `adaptive` in their names, and the local radius
/// of each of azulejo_psp_classes_with_density.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_radii(points: *const azulejo_points) -> *const f64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("points", points) }.map_or(std::ptr::null(), |points| array(&points.radii))
}

/// The ranks of the samples of a set in progressive order: for each sample the distance to the
/// nearest one before it, or on meshes a little less, rounded down to a float. They never rise. The
/// first i samples are at least as far apart as the i-th rank, and no place is farther from all of
/// them than the `quotient` of the options times that rank, and 6 float spacings; if i is below
/// 100, than twice the rank or, if that is more, the square of the quotient times it.
///
/// In the plane this holds from the samples of the coarsest level on, those with the rank of the
/// first: one sample only, unless the options have a `coarsest`. On meshes it holds for every i;
/// the first rank is infinite. Where radii vary, distances are divided by the mean of two radii:
/// see azulejo_psp_adaptive_sample, and for a density azulejo_psp_adaptive_with_density.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_ranks(points: *const azulejo_points) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("points", points) }.map_or(std::ptr::null(), |points| array(&points.ranks))
}

/// The class of each sample of a set of several classes: its row in the matrix of azulejo_classes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_classes(points: *const azulejo_points) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("points", points) }.map_or(std::ptr::null(), |points| array(&points.classes))
}

/// The ids of the samples of a set that has been edited (azulejo_plane_erase, azulejo_psp_erase): a
/// sample keeps its id as long as it stands, and no other one ever gets it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_ids(points: *const azulejo_points) -> *const u64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("points", points) }.map_or(std::ptr::null(), |points| array(&points.ids))
}

/// The index of each sample's instance, from azulejo_psp_sample_instances: they never fall.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_instances(points: *const azulejo_points) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { surface(points) }.map_or(std::ptr::null(), |samples| array(&samples.instances))
}

/// Frees the set with all its arrays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_points_free(points: *mut azulejo_points) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("points", points) };
}
