//! Keeps samples apart by straight distances through space, regardless of the parts of the surface that they are on.
//!
//! Forces see the surface laid into a plane. On a fin that is thinner than the distance of samples, and where it is
//! sharply bent, they lead two samples closer to each other through space that move apart in the plane. So the
//! displacements that forces ask for are corrected twice.
//!
//! * Samples are *held off*: a displacement is shortened in the direction of another sample to half of the distance
//!   left between them, and samples that are already too close move apart. Directions and distances are those of space,
//!   projected into the triangle's plane.
//! * Moves are *checked*: a move is made only if its end is no closer than the floor to the positions of all others and
//!   to those to which they would move. If both of two samples move, the second test has held; if one moves, the first;
//!   if neither does, nothing has changed. So no two get closer than the floor, and no refusal requires another.

use glam::{DVec3, Vec2, Vec3};

use crate::dcr::law::STIFFENING;

/// The distance, in spacings, up to which samples that are near on the surface are held off in the end. It is a little
/// less than the conflict radius, at which forces stop.
pub const NEAR: f32 = 0.855;

/// The distance, over the floor, up to which samples that are near through space only are held off: from that of a
/// maximal set to that of a relaxed one, but no farther than parts of the surface allow that were sampled independently
/// of each other.
const FAR: f32 = 1.1;

/// The number of times that a displacement is corrected by all close samples.
const ROUNDS: usize = 2;

/// The least distance of samples, in the units of the mesh.
#[derive(Clone, Copy)]
pub struct Floor {
    distance: f64,
    /// A square that is above that of the distance, for any rounding.
    above: f64,
}

impl Floor {
    pub fn new(distance: f64) -> Self {
        Self { distance, above: distance * distance * (1.0 + 1e-9) }
    }

    pub fn distance(self) -> f64 {
        self.distance
    }

    /// True if two positions, of this mean grade, are far enough from each other.
    pub fn admits(self, a: DVec3, b: DVec3, grade: f64) -> bool {
        let squared = a.distance_squared(b);
        squared > self.above * grade * grade || squared.sqrt() >= self.distance * grade
    }
}

/// The distances up to which samples are held off in a step, in spacings.
#[derive(Clone, Copy)]
pub struct Limits {
    /// The limit for samples near on the surface; it grows as constraints get stiffer.
    pub near: f32,
    /// The limit for all others.
    pub far: f32,
}

impl Limits {
    /// The limits of a step, of samples that are no closer than `floor` spacings.
    pub fn of_step(iterations: u32, floor: f32) -> Self {
        let stiff = iterations.min(STIFFENING) as f32 / STIFFENING as f32;
        let near = floor.max(NEAR * stiff);
        Self { near, far: near.min(FAR * floor) }
    }
}

/// The samples that are close to one sample.
#[derive(Default)]
pub struct Contacts(Vec<Contact>);

struct Contact {
    squared: f32,
    /// The direction in the plane of the sample's triangle, of length 1.
    direction: Vec2,
    /// The distance that the sample may move in that direction, in spacings; less than 0 if it must move back.
    most: f32,
}

impl Contacts {
    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds a sample at `offset`, seen in the plane of these axes, that is held off up to the distance `limit`, both in
    /// spacings.
    pub fn add(&mut self, axes: [Vec3; 2], offset: Vec3, limit: f32) {
        let projected = Vec2::new(offset.dot(axes[0]), offset.dot(axes[1]));
        let (across_squared, squared) = (projected.length_squared(), offset.length_squared());
        // A sample straight above or below has no direction.
        if across_squared > 0.0 {
            let (across, distance) = (across_squared.sqrt(), squared.sqrt());
            let left = distance - limit;
            // Along the plane the distance is longer, by the slope of the offset; but no sample moves back by more than
            // the distance falls short of the limit.
            let most = (0.5 * left * distance / across).max(left.min(0.0));
            self.0.push(Contact { squared, direction: projected / across, most });
        }
    }

    /// The corrected displacement. The nearest sample comes last: where not all can be held off, it is. (In the order
    /// of their numbers, pairs would stay stuck.)
    pub fn hold_off(&mut self, mut displacement: Vec2) -> Vec2 {
        let is_free = |contact: &Contact| displacement.dot(contact.direction) <= contact.most;
        if self.0.iter().all(is_free) {
            return displacement;
        }
        self.0.sort_by(|a, b| b.squared.total_cmp(&a.squared));
        for _ in 0..ROUNDS {
            for Contact { direction, most, .. } in &self.0 {
                displacement -= (displacement.dot(*direction) - most).max(0.0) * *direction;
            }
        }
        displacement
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The remaining displacement along the plane z = 0, with others at these offsets that are held off up to 1.
    fn held_off(others: &[Vec3], displacement: Vec2) -> Vec2 {
        let mut contacts = Contacts::default();
        others.iter().for_each(|&other| contacts.add([Vec3::X, Vec3::Y], other, 1.0));
        contacts.hold_off(displacement)
    }

    #[test]
    fn displacements_are_cut_where_they_lead_too_close_and_nowhere_else() {
        let is_near = |a: Vec2, b: Vec2| a.distance(b) < 1e-6;
        let ahead = [Vec3::new(1.2, 0.0, 0.0)];
        assert!(is_near(held_off(&ahead, Vec2::new(0.3, 0.2)), Vec2::new(0.1, 0.2)));
        for free in [Vec2::new(0.09, 0.2), Vec2::new(-0.5, 0.0)] {
            assert_eq!(held_off(&ahead, free), free);
        }
        // Two that are too close each move apart by half of the missing distance.
        assert!(is_near(held_off(&[Vec3::new(0.0, 0.8, 0.0)], Vec2::ZERO), Vec2::new(0.0, -0.1)));
        // If the offset is steep the displacement is longer, but never longer than the missing distance.
        assert!(is_near(held_off(&[Vec3::new(0.64, 0.0, 0.48)], Vec2::ZERO), Vec2::new(-0.125, 0.0)));
        let above = Vec3::new(1e-3, 0.0, 0.8);
        assert!(is_near(held_off(&[above], Vec2::ZERO), Vec2::new(above.length() - 1.0, 0.0)));
        assert_eq!(held_off(&[Vec3::new(0.0, 0.0, 0.8)], Vec2::Y), Vec2::Y);
    }

    #[test]
    fn of_two_in_opposite_directions_the_nearer_is_held_off() {
        let others = [Vec3::new(-0.7, 0.0, 0.0), Vec3::new(0.9, 0.0, 0.0)];
        for others in [others, [others[1], others[0]]] {
            assert!((held_off(&others, Vec2::ZERO) - Vec2::new(0.15, 0.0)).length() < 1e-6);
        }
    }

    #[test]
    fn a_floor_admits_its_own_distance_and_nothing_less() {
        for step in 1..2000 {
            let to = DVec3::new(0.1, 0.37 * f64::from(step), 1e-3);
            let floor = Floor::new(to.length_squared().sqrt());
            assert!(floor.admits(DVec3::ZERO, to, 1.0) && floor.admits(DVec3::ZERO, to * 1.0001, 1.0));
            assert!(!floor.admits(DVec3::ZERO, to * (1.0 - 1e-15), 1.0));
            assert!(floor.admits(DVec3::ZERO, 0.5 * to, 0.5) && !floor.admits(DVec3::ZERO, to, 1.0 + 1e-8));
        }
    }
}
