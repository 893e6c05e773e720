//! Samples as they come and as they are returned: triangles and barycentrics.

use glam::DVec2;

use crate::dcr::surface::walk::SurfacePoint;
use crate::error::{Error, Result};
use crate::mesh::{Mesh, round_barycentrics};
use crate::points::Points;

/// The amount by which rounding may have moved barycentrics out of their triangle.
const ROUNDING: f64 = 1e-6;

/// The distance of neighbours in the hexagonal arrangement of as many samples on the area of the mesh.
pub(super) fn hexagonal_distance(mesh: &Mesh, count: usize) -> f64 {
    (2.0 * mesh.area() / (3f64.sqrt() * count.max(1) as f64)).sqrt()
}

/// Refuses what is not a point of the mesh.
pub(super) fn check(mesh: &Mesh, triangles: &[u32], barycentrics: &[[f32; 2]]) -> Result<()> {
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

/// The points of samples.
pub(super) fn enter(triangles: &[u32], barycentrics: &[[f32; 2]]) -> Vec<SurfacePoint> {
    triangles.iter().zip(barycentrics).map(point).collect()
}

fn point((&triangle, &uv): (&u32, &[f32; 2])) -> SurfacePoint {
    let [u, v] = round_barycentrics(uv.map(f64::from)).map(f64::from);
    SurfacePoint { triangle, uv: DVec2::new(u, v) }
}

/// The points as samples, by rounded barycentrics.
pub(super) fn leave(mesh: &Mesh, points: &[SurfacePoint]) -> Points<3> {
    let triangles = points.iter().map(|point| point.triangle).collect();
    mesh.samples(triangles, points.iter().map(|point| round_barycentrics(point.uv.into())).collect())
}
