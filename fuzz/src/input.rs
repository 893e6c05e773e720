//! Bytes as numbers of every kind.

use libfuzzer_sys::arbitrary::{Arbitrary, Unstructured};

/// The bytes that are left. Once they are used up everything is 0.
pub struct Input<'a> {
    bytes: Unstructured<'a>,
}

impl<'a> Input<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: Unstructured::new(bytes) }
    }

    /// A number of any value.
    pub fn any<T: Arbitrary<'a> + Default>(&mut self) -> T {
        self.bytes.arbitrary().unwrap_or_default()
    }

    /// A number below `end`, which is above 0.
    pub fn below(&mut self, end: u32) -> u32 {
        self.any::<u32>() % end
    }

    /// True in one of `n` cases.
    pub fn one_in(&mut self, n: u8) -> bool {
        self.any::<u8>() % n == n - 1
    }

    /// A coordinate: mostly one of a coarse lattice, so that points coincide and stand in lines and on circles; some
    /// times a float of any value.
    pub fn coordinate(&mut self) -> f32 {
        const NAMED: [f32; 8] =
            [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-45];
        match self.any::<u8>() {
            0 => f32::from_bits(self.any()),
            1 => NAMED[self.below(8) as usize],
            2..100 => f32::from(self.any::<i16>()) / 32768.0,
            kind => f32::from(self.any::<i8>()) * if kind < 250 { 1.0 / 16.0 } else { 1e6 },
        }
    }

    /// A number of an option: of a usual size, from 1/256 to 256, or of any.
    pub fn number(&mut self) -> f64 {
        match self.any::<u8>() {
            0 => f64::from_bits(self.any()),
            1 => self.coordinate().into(),
            _ => 2f64.powf(f64::from(self.any::<i16>()) / 4096.0),
        }
    }

    /// Coordinates, at most `most` rows of them.
    pub fn rows<const N: usize>(&mut self, most: u32) -> Vec<[f32; N]> {
        let count = self.below(most + 1);
        (0..count).map(|_| std::array::from_fn(|_| self.coordinate())).collect()
    }

    /// All bytes that are left.
    pub fn rest(&mut self) -> &'a [u8] {
        let left = self.bytes.len();
        self.bytes.bytes(left).unwrap_or_default()
    }
}
