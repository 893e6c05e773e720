//! What keeps samples apart: straight distances through space, whatever sheets they are on.
//!
//! Forces see the surface laid into a plane. On a fin that is thinner than samples are apart, and where it is sharply bent, they
//! lead two samples nearer to each other through space that get away from each other in the plane. So what samples want to
//! do is corrected twice.
//!
//! * They are *held off*: a way is shortened in the direction of another to half of what is left between them, and those that
//!   are too near already give way. Directions and distances are those of space, as the triangle's plane cuts them.
//! * They are *checked*: a move is made only if it ends no nearer than the floor to where any other was, and to where any
//!   other wanted to get. So whoever moves: if both do, the second test has held, if one does, the first, and if none does,
//!   nothing has changed. No two get nearer than the floor.

use glam::{DVec2, DVec3};

use crate::dcr::ground::constraints::STIFFENING;
use crate::dcr::surface::walk::Flat;

/// The distance, in spacings, up to which samples that are near on the surface are held off in the end. It is a little less
/// than the conflict radius, at which forces stop.
const NEAR: f64 = 0.855;

/// The same for those that are near through space only, as a share of the floor: from that of a maximal set to that of a
/// relaxed one, but no farther than sheets allow on which samples began as if there were no others.
const FAR: f64 = 1.1;

/// How often a way is corrected by all that are close.
const ROUNDS: usize = 2;

/// How near samples may get, in the units of the mesh.
#[derive(Clone, Copy)]
pub(super) struct Floor {
    distance: f64,
    /// A square that is above that of the distance, whatever the rounding.
    above: f64,
}

impl Floor {
    pub(super) fn new(distance: f64) -> Self {
        Self { distance, above: distance * distance * (1.0 + 1e-9) }
    }

    pub(super) fn distance(self) -> f64 {
        self.distance
    }

    /// Whether two places are far enough from each other.
    pub(super) fn admits(self, a: DVec3, b: DVec3) -> bool {
        let squared = a.distance_squared(b);
        squared > self.above || squared.sqrt() >= self.distance
    }
}

/// Up to which distances samples are held off in a step, in the units of the mesh.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// From those near on the surface; it grows as constraints get stiffer.
    pub(super) near: f64,
    /// From all others.
    pub(super) far: f64,
}

impl Limits {
    pub(super) fn of_step(iterations: u32, floor: Floor, spacing: f64) -> Self {
        let stiff = f64::from(iterations.min(STIFFENING)) / f64::from(STIFFENING);
        let near = floor.distance.max(NEAR * stiff * spacing);
        Self { near, far: near.min(FAR * floor.distance) }
    }
}

/// Those that are close to one sample.
#[derive(Default)]
pub(super) struct Contacts(Vec<Contact>);

struct Contact {
    squared: f64,
    /// In the plane of the sample's triangle, of length 1.
    direction: DVec2,
    /// How far the sample may go in that direction, in spacings; less than 0 if it has to give way.
    most: f64,
}

impl Contacts {
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds a sample at `offset` that shall be held off up to a distance, both in the units of the mesh.
    pub(super) fn add(&mut self, flat: &Flat, offset: DVec3, limit: f64) {
        let (seen, squared) = (flat.seen(offset), offset.length_squared());
        let across = seen.length();
        // Who is straight above or below is in no direction.
        if across > 0.0 {
            let left = (squared.sqrt() - limit) / flat.spacing();
            // Along the plane it is as much farther as the plane leads away; but nobody gives way by more than all that lacks.
            let most = (0.5 * left * squared.sqrt() / (across * flat.spacing())).max(left.min(0.0));
            self.0.push(Contact { squared, direction: seen / across, most });
        }
    }

    /// The way, corrected. The nearest comes last: where not all can be held off, it is.
    pub(super) fn hold_off(&mut self, mut way: DVec2) -> DVec2 {
        self.0.sort_unstable_by(|a, b| b.squared.total_cmp(&a.squared));
        for _ in 0..ROUNDS {
            for Contact { direction, most, .. } in &self.0 {
                way -= (way.dot(*direction) - most).max(0.0) * direction;
            }
        }
        way
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dcr::surface::sheet::Sheet;
    use crate::mesh::Mesh;

    const SPACING: f64 = 0.5;

    /// What is left of a way along the plane z = 0, with others at these offsets that are held off up to 1. In the units of
    /// the mesh.
    fn held_off(others: &[DVec3], way: DVec2) -> DVec2 {
        let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
        let flat = Flat::new(&Sheet::new(&mesh).unwrap(), 0, SPACING);
        let mut contacts = Contacts::default();
        others.iter().for_each(|&other| contacts.add(&flat, other, 1.0));
        contacts.hold_off(way / SPACING) * SPACING
    }

    #[test]
    fn ways_are_cut_where_they_lead_too_near_and_nowhere_else() {
        let is_near = |a: DVec2, b: DVec2| a.distance(b) < 1e-12;
        let ahead = [DVec3::new(1.2, 0.0, 0.0)];
        assert!(is_near(held_off(&ahead, DVec2::new(0.3, 0.2)), DVec2::new(0.1, 0.2)));
        for free in [DVec2::new(0.09, 0.2), DVec2::new(-0.5, 0.0)] {
            assert_eq!(held_off(&ahead, free), free);
        }
        // Two that are too near part by half of what lacks each.
        assert!(is_near(held_off(&[DVec3::new(0.0, 0.8, 0.0)], DVec2::ZERO), DVec2::new(0.0, -0.1)));
        // Where the plane leads away slowly the way is longer, but never longer than what lacks.
        assert!(is_near(held_off(&[DVec3::new(0.64, 0.0, 0.48)], DVec2::ZERO), DVec2::new(-0.125, 0.0)));
        let above = DVec3::new(1e-3, 0.0, 0.8);
        assert!(is_near(held_off(&[above], DVec2::ZERO), DVec2::new(above.length() - 1.0, 0.0)));
        assert_eq!(held_off(&[DVec3::new(0.0, 0.0, 0.8)], DVec2::Y), DVec2::Y);
    }

    #[test]
    fn of_two_in_opposite_directions_the_nearer_is_held_off() {
        let others = [DVec3::new(-0.7, 0.0, 0.0), DVec3::new(0.9, 0.0, 0.0)];
        for others in [others, [others[1], others[0]]] {
            assert!((held_off(&others, DVec2::ZERO) - DVec2::new(0.15, 0.0)).length() < 1e-12);
        }
    }

    #[test]
    fn a_floor_admits_its_own_distance_and_nothing_less() {
        for step in 1..2000 {
            let to = DVec3::new(0.1, 0.37 * f64::from(step), 1e-3);
            let floor = Floor::new(to.length_squared().sqrt());
            assert!(floor.admits(DVec3::ZERO, to) && floor.admits(DVec3::ZERO, to * 1.0001));
            assert!(!floor.admits(DVec3::ZERO, to * (1.0 - 1e-15)));
        }
    }
}
