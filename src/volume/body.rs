//! A mesh as a body that is filled: its box, its measures, and how deep places may stay open.

use std::sync::Arc;

use crate::interior::Interior;
use crate::mesh::Mesh;
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY_IN_SPACE};
use crate::volume::inside::Solid;

/// The probes along an axis of the box around a mesh by which its volume is estimated.
const PROBES: u32 = 16;

/// The radii by which a body has as many samples as one that is larger all around and has no boundary.
const BEYOND: f64 = 0.35;

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
    tolerance: f64,
    /// The box around it.
    pub domain: Domain<3>,
    volume: f64,
    area: f64,
    /// An estimate of the memory of its inside.
    pub bytes: f64,
}

impl Body {
    /// The inside of a mesh up to a tolerance, in radii.
    pub fn new(mesh: &Mesh, tolerance: f64) -> Self {
        let (interior, domain) = (Interior::of(mesh), bounds(mesh));
        let place = |axis: usize, number: u32| {
            (domain.min[axis] + domain.extent()[axis] * (f64::from(number) + 0.5) / f64::from(PROBES)) as f32
        };
        let probe = |k: u32| [place(0, k % PROBES), place(1, k / PROBES % PROBES), place(2, k / PROBES / PROBES)];
        let count = PROBES * PROBES * PROBES;
        let inside = (0..count).filter(|&number| interior.contains(probe(number))).count();
        let volume = domain.extent().iter().product::<f64>() * inside as f64 / f64::from(count);
        let bytes = BYTES_PER_TRIANGLE * mesh.triangles().len() as f64;
        Self { interior, tolerance, domain, volume, area: mesh.area(), bytes }
    }

    /// True if the triangles of the mesh cancel out.
    pub fn encloses_nothing(&self) -> bool {
        self.volume == 0.0 && self.interior.cancels_out()
    }

    /// True if no ray meets the inside, also of some bodies that are very thin.
    pub fn seems_empty(&self) -> bool {
        self.interior.volume() == 0.0
    }

    pub fn solid(&self) -> Solid<'_> {
        Solid { interior: &self.interior, tolerance: self.tolerance }
    }

    /// The depth of places that a set with this covering radius may leave open.
    pub fn depth(&self, covering_radius: f64) -> f64 {
        let spacing = float_spacing(self.domain.min.iter().chain(&self.domain.max));
        3f64.sqrt() * (1.001 * self.tolerance * covering_radius + 4.0 * spacing)
    }

    /// The approximate number of samples; at least one.
    pub fn expected_samples(&self, radius: f64) -> f64 {
        let [area, depth] = [self.area / radius / radius, BEYOND];
        (MAXIMAL_DENSITY_IN_SPACE * (self.volume / radius / radius / radius + depth * area)).max(1.0)
    }
}
