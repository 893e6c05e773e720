//! Discs painted on a surface: the parts of it that are near to a sample.

use std::collections::HashMap;

use glam::{IVec3, Vec3};

/// Samples in cells four disc radii wide, so that a question rarely asks more than one.
pub struct Discs {
    radius: f32,
    cells: HashMap<IVec3, Vec<Vec3>>,
}

impl Discs {
    pub fn new(samples: impl Iterator<Item = Vec3>, radius: f32) -> Self {
        let mut cells: HashMap<_, Vec<_>> = HashMap::new();
        for sample in samples {
            cells.entry(cell(sample, radius)).or_default().push(sample);
        }
        Self { radius, cells }
    }

    /// Whether a point of the surface is within the radius of a sample.
    pub fn cover(&self, point: Vec3) -> bool {
        let [low, high] = [-self.radius, self.radius].map(|offset| cell(point + offset, self.radius));
        (low.z..=high.z)
            .any(|z| (low.y..=high.y).any(|y| (low.x..=high.x).any(|x| self.covers(IVec3::new(x, y, z), point))))
    }

    fn covers(&self, cell: IVec3, point: Vec3) -> bool {
        let near = |sample: &Vec3| sample.distance_squared(point) <= self.radius * self.radius;
        self.cells.get(&cell).is_some_and(|samples| samples.iter().any(near))
    }
}

fn cell(point: Vec3, radius: f32) -> IVec3 {
    (point / (4.0 * radius)).floor().as_ivec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covers_what_a_loop_over_all_samples_finds() {
        let place = |i: i32| Vec3::new((i * 37 % 101) as f32, (i * 53 % 97) as f32, (i * 71 % 89) as f32) / 100.0;
        let samples: Vec<_> = (0..300).map(place).collect();
        for radius in [0.001, 0.03, 0.1] {
            let discs = Discs::new(samples.iter().copied(), radius);
            for point in (0..500).map(|i| place(7 * i + 3) + 0.01) {
                let expected = samples.iter().any(|sample| sample.distance_squared(point) <= radius * radius);
                assert_eq!(discs.cover(point), expected);
            }
            assert!(samples.iter().all(|&sample| discs.cover(sample)));
        }
    }
}
