//! The width that a maximal set may leave uncovered beyond its radius: spacings of floats.

use azulejo::Domain;
use azulejo::mesh::Mesh;
use azulejo::psp::TOLERANCE;

/// Some spacings of floats at the largest coordinate of the mesh, as documented at `psp::TOLERANCE`.
pub fn tolerance(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    let largest = low.into_iter().chain(high).fold(0.0f32, |largest, x| largest.max(x.abs()));
    TOLERANCE * (f64::from(largest) - f64::from(largest.next_down()))
}

/// The distance between neighbouring floats below the domain's largest coordinate.
pub fn float_spacing<const D: usize>(domain: &Domain<D>) -> f64 {
    let largest = domain.min.iter().chain(&domain.max).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let mut above = largest as f32;
    if f64::from(above) < largest {
        above = f32::from_bits(above.to_bits() + 1);
    }
    f64::from(above) - f64::from(f32::from_bits(above.to_bits() - 1))
}
