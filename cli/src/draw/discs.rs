//! Discs painted on a surface: the parts of it that are near to a sample.

use std::collections::HashMap;

use glam::{IVec3, Vec3};

use super::palette::Colour;

/// A disc around a sample.
#[derive(Clone, Copy)]
pub struct Disc {
    /// The sample.
    pub centre: Vec3,
    /// The radius.
    pub radius: f32,
    /// The colour.
    pub colour: Colour,
}

/// Discs in cells four times as wide as the radius of the largest, so that a query rarely reads more than one.
pub struct Discs {
    largest: f32,
    cells: HashMap<IVec3, Vec<Disc>>,
}

impl Discs {
    pub fn new(discs: Vec<Disc>) -> Self {
        let largest = discs.iter().map(|disc| disc.radius).fold(0.0, f32::max);
        let mut cells: HashMap<_, Vec<_>> = HashMap::new();
        for disc in discs {
            cells.entry(cell(disc.centre, largest)).or_default().push(disc);
        }
        Self { largest, cells }
    }

    /// The paint at a point of the surface, if it lies on a disc.
    pub fn paint(&self, point: Vec3) -> Option<Colour> {
        let [low, high] = [-self.largest, self.largest].map(|offset| cell(point + offset, self.largest));
        (low.z..=high.z)
            .flat_map(|z| (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| IVec3::new(x, y, z))))
            .find_map(|cell| self.paint_in(cell, point))
    }

    fn paint_in(&self, cell: IVec3, point: Vec3) -> Option<Colour> {
        let near = |disc: &&Disc| disc.centre.distance_squared(point) <= disc.radius * disc.radius;
        self.cells.get(&cell)?.iter().find(near).map(|disc| disc.colour)
    }
}

fn cell(point: Vec3, radius: f32) -> IVec3 {
    (point / (4.0 * radius)).floor().as_ivec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paints_what_a_loop_over_all_discs_finds() {
        let place = |i: i32| Vec3::new((i * 37 % 101) as f32, (i * 53 % 97) as f32, (i * 71 % 89) as f32) / 100.0;
        for radius in [0.001, 0.03, 0.1] {
            let disc =
                |i: i32| Disc { centre: place(i), radius: radius / (1 + i % 3) as f32, colour: [(i % 3) as u8; 3] };
            let all: Vec<_> = (0..300).map(disc).collect();
            let discs = Discs::new(all.clone());
            for point in (0..500).map(|i| place(7 * i + 3) + 0.01) {
                let near = |disc: &&Disc| disc.centre.distance_squared(point) <= disc.radius * disc.radius;
                let expected: Vec<_> = all.iter().filter(near).map(|disc| disc.colour).collect();
                match discs.paint(point) {
                    Some(colour) => assert!(expected.contains(&colour)),
                    None => assert!(expected.is_empty()),
                }
            }
            assert!(all.iter().all(|disc| discs.paint(disc.centre).is_some()));
        }
    }
}
