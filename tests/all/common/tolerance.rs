//! How much a maximal set on a mesh may leave uncovered beyond its radius, as documented at `psp::TOLERANCE`.

use azulejo::mesh::Mesh;
use azulejo::psp::TOLERANCE;

/// Some spacings of floats at the largest coordinate of the mesh.
pub fn tolerance(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    let largest = low.into_iter().chain(high).fold(0.0f32, |largest, x| largest.max(x.abs()));
    TOLERANCE * (f64::from(largest) - f64::from(largest.next_down()))
}
