//! Lines with a sum and the name of what it is of.

use std::fmt;

use azulejo::Points;
use sha2::{Digest, Sha256};

/// Sums, in the order in which they were taken.
#[derive(Default)]
pub struct List {
    lines: Vec<String>,
}

impl List {
    /// Adds the sum of some bytes.
    pub fn bytes(&mut self, name: &str, bytes: &[u8]) {
        let digits: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        self.lines.push(format!("{digits}  {name} ({} bytes)", bytes.len()));
    }

    /// Adds another list.
    pub fn append(&mut self, mut other: Self) {
        self.lines.append(&mut other.lines);
    }

    /// Adds that of points of the plane.
    pub fn points(&mut self, name: &str, points: &[[f32; 2]]) {
        self.bytes(name, &little_endian(points.as_flattened(), f32::to_le_bytes));
    }

    /// Adds that of numbers.
    pub fn numbers(&mut self, name: &str, numbers: &[f64]) {
        self.bytes(name, &little_endian(numbers, f64::to_le_bytes));
    }

    /// Adds that of all that is known of samples, one field after the other.
    pub fn samples<const D: usize>(&mut self, name: &str, samples: &Points<D>) {
        let fields = [
            little_endian(samples.positions.as_flattened(), f32::to_le_bytes),
            little_endian(samples.normals.as_flattened(), f32::to_le_bytes),
            little_endian(samples.interpolated_normals.as_flattened(), f32::to_le_bytes),
            little_endian(&samples.triangles, u32::to_le_bytes),
            little_endian(samples.barycentrics.as_flattened(), f32::to_le_bytes),
            little_endian(&samples.ranks, f32::to_le_bytes),
            little_endian(&samples.classes, u32::to_le_bytes),
            little_endian(&samples.radii, f64::to_le_bytes),
        ];
        self.bytes(name, &fields.concat());
    }
}

impl fmt::Display for List {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

/// The bytes of numbers, in the same order on all machines.
pub fn little_endian<T: Copy, const N: usize>(numbers: &[T], encode: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    numbers.iter().flat_map(|&number| encode(number)).collect()
}
