//! Lines with a sum and the name of what it is of.

use azulejo::{Result, SurfaceSamples};
use azulejo_cli::output;
use sha2::{Digest, Sha256};

/// Prints the sum of some bytes.
pub fn bytes(name: &str, bytes: &[u8]) -> Result<()> {
    let digits: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    output::print(format!("{digits}  {name} ({} bytes)\n", bytes.len()).as_bytes())
}

/// Prints the sum of points of the plane.
pub fn points(name: &str, points: &[[f32; 2]]) -> Result<()> {
    bytes(name, &little_endian(points.as_flattened(), f32::to_le_bytes))
}

/// Prints the sum of numbers.
pub fn numbers(name: &str, numbers: &[f64]) -> Result<()> {
    bytes(name, &little_endian(numbers, f64::to_le_bytes))
}

/// Prints the sum of all that is known of samples.
pub fn samples(name: &str, samples: &SurfaceSamples) -> Result<()> {
    let fields = [
        little_endian(samples.positions.as_flattened(), f32::to_le_bytes),
        little_endian(samples.normals.as_flattened(), f32::to_le_bytes),
        little_endian(samples.interpolated_normals.as_flattened(), f32::to_le_bytes),
        little_endian(&samples.triangles, u32::to_le_bytes),
        little_endian(samples.barycentrics.as_flattened(), f32::to_le_bytes),
    ];
    bytes(name, &fields.concat())
}

/// The bytes of numbers, in the same order on all machines.
pub fn little_endian<T: Copy, const N: usize>(numbers: &[T], encode: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    numbers.iter().flat_map(|&number| encode(number)).collect()
}
