//! Points in cells, to find those near a place: for algorithms of others.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use glam::{IVec3, Vec3};
use rustc_hash::FxHasher;

/// Points, each with something of its own, in cells twice as wide as the radius: at most eight are looked at.
pub struct Near<T> {
    radius: f32,
    cells: HashMap<IVec3, Vec<(Vec3, T)>, BuildHasherDefault<FxHasher>>,
}

impl<T: Copy> Near<T> {
    pub fn new(radius: f32) -> Self {
        Self { radius, cells: HashMap::default() }
    }

    fn cell(&self, point: Vec3) -> IVec3 {
        (point / (2.0 * self.radius)).floor().as_ivec3()
    }

    pub fn add(&mut self, point: Vec3, own: T) {
        self.cells.entry(self.cell(point)).or_default().push((point, own));
    }

    /// The points closer to a place than the radius.
    pub fn around(&self, place: Vec3) -> impl Iterator<Item = (Vec3, T)> + '_ {
        let [low, high] = [-self.radius, self.radius].map(|reach| self.cell(place + reach));
        let cells = (low.z..=high.z)
            .flat_map(move |z| (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| IVec3::new(x, y, z))));
        let points = cells.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        points.filter(move |(other, _)| other.distance_squared(place) < self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::stream;

    #[test]
    fn those_found_are_those_of_all_pairs() {
        let mut unit = stream(1);
        let points: Vec<_> = (0..400).map(|_| 8.0 * Vec3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5)).collect();
        let mut near = Near::new(0.9);
        points.iter().zip(0..).for_each(|(&point, i)| near.add(point, i));
        for &place in &points {
            let mut found: Vec<usize> = near.around(place).map(|(_, i)| i).collect();
            found.sort_unstable();
            let is_near = |i: &usize| points[*i].distance_squared(place) < 0.9f32 * 0.9;
            assert_eq!(found, (0..points.len()).filter(is_near).collect::<Vec<_>>());
        }
    }
}
