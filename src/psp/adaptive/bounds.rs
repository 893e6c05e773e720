//! Between which values the radius is.

use crate::error::{Error, Result};
use crate::mesh::Mesh;

/// Between which values the radius is on a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusBounds {
    pub least: f64,
    pub largest: f64,
}

impl RadiusBounds {
    /// The radius as far as it is known: what lengths are measured by. Where the bounds are far apart the least may
    /// be due to a distant corner, or to a bad bound; fragments become smaller then, but not by so much.
    pub fn scale(&self) -> f64 {
        self.least.max(self.largest / 16.0)
    }

    /// What areas are measured by: the mean of 1 / radius² where the radius grows evenly.
    pub fn density(&self) -> f64 {
        1.0 / (self.least * self.largest)
    }
}

/// Checks radii of vertices, and gives their bounds.
pub fn of_vertices(mesh: &Mesh, radii: &[f32]) -> Result<RadiusBounds> {
    let count = mesh.positions().len();
    if radii.len() != count {
        return Err(Error::invalid("vertex_count", format!("{} radii for {count} vertices", radii.len())));
    }
    if let Some(vertex) = radii.iter().position(|radius| !(radius.is_finite() && *radius > 0.0)) {
        let reason = format!("vertex {vertex} has {:?}, not a positive finite number", radii[vertex]);
        return Err(Error::invalid("vertex_radii", reason));
    }
    let used = mesh.triangles().iter().flatten().map(|&vertex| f64::from(radii[vertex as usize]));
    let start = RadiusBounds { least: f64::INFINITY, largest: 0.0 };
    Ok(used.fold(start, |all, x| RadiusBounds { least: all.least.min(x), largest: all.largest.max(x) }))
}

/// Checks what is said of a function, and gives its bounds.
pub fn of_function(smallest: f64, largest: f64, slope: f64) -> Result<RadiusBounds> {
    if !(smallest > 0.0 && smallest.is_finite()) {
        return Err(Error::invalid("smallest", format!("{smallest:?} is not a positive finite number")));
    }
    if !(largest >= smallest && largest.is_finite()) {
        return Err(Error::invalid("largest", format!("{largest:?} is not a finite number from {smallest:?} on")));
    }
    if !(slope >= 0.0 && slope.is_finite()) {
        return Err(Error::invalid("slope", format!("{slope:?} is not a finite number from 0 on")));
    }
    Ok(RadiusBounds { least: smallest, largest })
}
