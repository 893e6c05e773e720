//! Results: samples of the plane or of a mesh.

use azulejo_core::SurfaceSamples;
use azulejo_core::psp::adaptive::AdaptiveSamples;

use crate::boundary::{self, array};

/// The samples that a call made. Immutable: several threads may read it at once. All its arrays
/// have one entry per sample, in the same order, and are valid until azulejo_points_free.
pub struct azulejo_points {
    pub(crate) samples: Samples,
    /// The radius of each sample, where it varies.
    radii: Vec<f64>,
}

pub(crate) enum Samples {
    Plane(Vec<[f32; 2]>),
    Surface(SurfaceSamples),
}

impl azulejo_points {
    pub(crate) fn plane(samples: Vec<[f32; 2]>) -> Self {
        Self { samples: Samples::Plane(samples), radii: Vec::new() }
    }

    pub(crate) fn surface(samples: SurfaceSamples) -> Self {
        Self { samples: Samples::Surface(samples), radii: Vec::new() }
    }

    pub(crate) fn adaptive(AdaptiveSamples { samples, radii, .. }: AdaptiveSamples) -> Self {
        Self { samples: Samples::Surface(samples), radii }
    }
}

fn surface(points: Option<&azulejo_points>) -> Option<&SurfaceSamples> {
    match points.map(|points| &points.samples) {
        Some(Samples::Surface(samples)) => Some(samples),
        _ => None,
    }
}

/// The number of samples; 0 for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_count(points: Option<&azulejo_points>) -> usize {
    match points.map(|points| &points.samples) {
        Some(Samples::Plane(samples)) => samples.len(),
        Some(Samples::Surface(samples)) => samples.len(),
        None => 0,
    }
}

/// The number of coordinates of a position: 2 for samples of the plane, 3 for samples on a mesh; 0
/// for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_dimension(points: Option<&azulejo_points>) -> u32 {
    match points.map(|points| &points.samples) {
        Some(Samples::Plane(_)) => 2,
        Some(Samples::Surface(_)) => 3,
        None => 0,
    }
}

/// The positions, x y or x y z of each sample, interleaved; NULL for NULL and for an empty set.
///
/// Samples of the plane lie in domain_min <= x < domain_max. Samples on a mesh lie on their
/// triangle, up to the rounding of the floats: they are computed from the barycentrics in double
/// arithmetic and rounded once.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_positions(points: Option<&azulejo_points>) -> *const f32 {
    match points.map(|points| &points.samples) {
        Some(Samples::Plane(samples)) => array(samples),
        Some(Samples::Surface(samples)) => array(&samples.positions),
        None => std::ptr::null(),
    }
}

/// The unit normals of the samples' triangles, x y z each, on the side from which their vertices
/// appear counter-clockwise, whether or not the mesh carries normals of its own. NULL for NULL, an
/// empty set and samples of the plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_normals(points: Option<&azulejo_points>) -> *const f32 {
    surface(points).map_or(std::ptr::null(), |samples| array(&samples.normals))
}

/// The normals that the mesh carries, from azulejo_mesh_with_normals or from its file, interpolated
/// with the samples' barycentrics and normalised, x y z each; the normal of the triangle where the
/// sum is zero. NULL for a mesh without normals, NULL, an empty set and samples of the plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_interpolated_normals(points: Option<&azulejo_points>) -> *const f32 {
    surface(points).map_or(std::ptr::null(), |samples| array(&samples.interpolated_normals))
}

/// The index of each sample's triangle; NULL for NULL, an empty set and samples of the plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_triangles(points: Option<&azulejo_points>) -> *const u32 {
    surface(points).map_or(std::ptr::null(), |samples| array(&samples.triangles))
}

/// The barycentric coordinates u v of each sample in its triangle (a, b, c), as in Embree: the
/// position is (1-u-v)*a + u*b + v*c, and other attributes of the vertices are interpolated in the
/// same manner. NULL for NULL, an empty set and samples of the plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_barycentrics(points: Option<&azulejo_points>) -> *const f32 {
    surface(points).map_or(std::ptr::null(), |samples| array(&samples.barycentrics))
}

/// The radius of each sample of azulejo_psp_adaptive_sample, in the units of the mesh; NULL for
/// NULL, an empty set and all other sets.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_radii(points: Option<&azulejo_points>) -> *const f64 {
    points.map_or(std::ptr::null(), |points| array(&points.radii))
}

/// Frees the set with all its arrays. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_points_free(points: Option<Box<azulejo_points>>) {
    boundary::free(points);
}
