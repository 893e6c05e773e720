//! A mesh as a body that is filled: its box, its measures, and how deep places may stay open.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::interior::Interior;
use crate::math::hypot;
use crate::mesh::Mesh;
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY_IN_SPACE};
use crate::volume::inside::Solid;
use crate::volume::shell::{self, Thickness};

/// The probes along an axis of the box around a mesh by which its volume is estimated.
const PROBES: u32 = 16;

/// No place inside is farther from the surface than half the smallest side of the box around the mesh: a shell of this share of the
/// side is all of the inside.
const ALL: f64 = 0.501;

/// The probes in a shell from which on they estimate its volume.
const ENOUGH: usize = 200;

/// The radii by which a body has as many samples as one that is larger all around and has no boundary.
const BEYOND: f64 = 0.35;

/// A cap beside a sheet encloses, where both are rounded, up to so many float spacings times the area of both.
const ROUNDED: f64 = 2.0;

/// The most bytes per triangle of what is made for the inside of a mesh.
const BYTES_PER_TRIANGLE: f64 = 200.0;

/// The box around a mesh. The upper planes do not belong to it, as they do not to the inside.
fn bounds(mesh: &Mesh) -> Domain<3> {
    let (low, high) = mesh.bounds();
    let (min, mut max) = (low.map(f64::from), high.map(f64::from));
    let longest = (0..3).map(|axis| max[axis] - min[axis]).fold(0.0, f64::max);
    for axis in 0..3 {
        // A flat mesh, in a box that is none.
        max[axis] = max[axis].max(min[axis] + 1e-6 * longest);
    }
    Domain { min, max, boundary: Boundary::Bounded }
}

/// A mesh as what is filled, and its measures.
pub struct Body {
    interior: Arc<Interior>,
    has_caps: bool,
    tolerance: f64,
    thickness: Option<Thickness>,
    /// The box around it.
    pub domain: Domain<3>,
    volume: f64,
    /// That of the surface, and once more if there is an inner border.
    area: f64,
    /// An estimate of the memory of its inside.
    pub bytes: f64,
}

impl Body {
    /// The inside of a mesh, with caps in its holes, up to a tolerance, in radii: all of it, or a shell of a thickness above 0.
    /// Refuses a mesh whose triangles cancel out, and sheets.
    pub fn new(mesh: &Mesh, tolerance: f64, thickness: f64) -> Result<Self> {
        let capped = mesh.with_caps()?;
        let (mesh, has_caps) = (capped.as_deref().unwrap_or(mesh), capped.is_some());
        let (interior, domain) = (Interior::of(mesh), bounds(mesh));
        let [x, y, z] = domain.extent();
        let is_shell = 0.0 < thickness && thickness < ALL * x.min(y).min(z);
        let thickness =
            is_shell.then(|| Thickness { distance: thickness, error: shell::ERROR * hypot(hypot(x, y), z) });
        let place = |axis: usize, number: u32| {
            (domain.min[axis] + domain.extent()[axis] * (f64::from(number) + 0.5) / f64::from(PROBES)) as f32
        };
        let probe = |k: u32| [place(0, k % PROBES), place(1, k / PROBES % PROBES), place(2, k / PROBES / PROBES)];
        let count = PROBES * PROBES * PROBES;
        let inside: Vec<u32> = (0..count).filter(|&number| interior.contains(probe(number))).collect();
        let of_probes = |probes: usize| x * y * z * probes as f64 / f64::from(count);
        let (mut volume, mut area) = (of_probes(inside.len()), mesh.area());
        if let Some(thickness) = thickness {
            let is_near = |&&number: &&u32| thickness.holds(&interior, probe(number));
            let near = inside.iter().filter(is_near).count();
            if near < inside.len() {
                volume = if near < ENOUGH { volume.min(area * thickness.distance) } else { of_probes(near) };
                area *= 2.0;
            }
        }
        let bytes = BYTES_PER_TRIANGLE * mesh.triangles().len() as f64;
        let body = Self { interior, has_caps, tolerance, thickness, domain, volume, area, bytes };
        let is_empty = || body.interior.cancels_out() || has_caps && body.seems_empty();
        if body.volume == 0.0 && is_empty() { Err(body.encloses_nothing()) } else { Ok(body) }
    }

    /// The refusal of a mesh in which no place for a sample was found.
    pub fn encloses_nothing(&self) -> Error {
        let reason = if self.has_caps {
            "encloses nothing: caps close its holes, and leave nothing inside, as of loose triangles"
        } else {
            "encloses nothing: where parts of a surface coincide they cancel out"
        };
        Error::invalid("mesh", reason)
    }

    /// True if no ray meets the inside, also of some bodies that are very thin, or if only rounding parts caps from the mesh.
    pub fn seems_empty(&self) -> bool {
        let rounded = if self.has_caps { ROUNDED * self.float_spacing() * self.area } else { 0.0 };
        self.interior.volume() <= rounded
    }

    fn float_spacing(&self) -> f64 {
        float_spacing(self.domain.min.iter().chain(&self.domain.max))
    }

    pub fn solid(&self) -> Solid<'_> {
        Solid { interior: &self.interior, tolerance: self.tolerance, thickness: self.thickness }
    }

    /// The depth of places that a set with this covering radius may leave open.
    pub fn depth(&self, covering_radius: f64) -> f64 {
        let spacing = self.float_spacing();
        let side = self.solid().tolerance_of(covering_radius) * covering_radius;
        // The error of two distances, by which a box is known to reach the inner border.
        let error = self.thickness.map_or(0.0, |thickness| 2.0 * thickness.error);
        3f64.sqrt() * (1.001 * side + 4.0 * spacing) + error
    }

    /// The approximate number of samples; at least one.
    pub fn expected_samples(&self, radius: f64) -> f64 {
        let [area, depth] = [self.area / radius / radius, BEYOND];
        (MAXIMAL_DENSITY_IN_SPACE * (self.volume / radius / radius / radius + depth * area)).max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::volume::{InsideOptions, sample_inside};

    /// The memory and the first radius of a count are estimated by it. Planes of probes blur the inner border of a cube's shell.
    #[test]
    fn the_number_of_samples_is_about_the_expected_one() {
        let positions = (0..8).map(|k| [(k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32]).collect();
        let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = squares.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect();
        let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
        for (thickness, error) in [(0.0, 0.03), (0.3, 0.1), (0.1, 0.3), (0.03, 0.5), (0.001, 0.5)] {
            let options = InsideOptions::new(0.04).thickness(thickness);
            let found = sample_inside(&Context::new(1).unwrap(), &mesh, &options, None).unwrap().0.len() as f64;
            let expected = Body::new(&mesh, 1.0 / 16.0, thickness).unwrap().expected_samples(0.04);
            assert!((expected / found - 1.0).abs() < error, "{thickness}: {expected} of {found}");
        }
    }
}
