//! The part of a surface that is reached from a sample without leaving a ball, in patches.

use glam::Vec3;

use crate::dcr::surface::patches::{Patches, Side};

/// The patches that the flood from one sample has reached.
pub(super) struct Flood {
    /// By a hash of the patch: the flood that has reached it last, and its side. More than twice as many as patches.
    reached: Vec<(u32, Side)>,
    /// The number of this flood.
    flood: u32,
    queue: Vec<Side>,
    /// The half-edges of the boundary in these patches.
    boundary: Vec<u32>,
}

impl Default for Flood {
    fn default() -> Self {
        Self { reached: vec![(0, Side::new(0, false)); 256], flood: 0, queue: Vec::new(), boundary: Vec::new() }
    }
}

impl Flood {
    /// Floods the patches around a place on a triangle, within a radius in spacings; `unit` is 1 over a spacing.
    pub(super) fn spread(&mut self, patches: &Patches, triangle: u32, place: Vec3, radius: f32, unit: f32) {
        self.clear();
        // The sides of patches as seen from the front of this triangle.
        self.enter(patches.side(triangle));
        let mut next = 0;
        while let Some(&here) = self.queue.get(next) {
            next += 1;
            for portal in patches.portals(here.patch()) {
                if self.find(portal.to.patch()).is_err() && portal.meets(place, radius, unit) {
                    self.enter(Side::new(portal.to.patch(), here.is_turned() ^ portal.to.is_turned()));
                }
            }
            self.boundary.extend_from_slice(patches.open(here.patch()));
        }
    }

    /// Whether a triangle of a patch was reached, and if so whether its front is on the other side than that of the
    /// triangle where the flood began.
    pub(super) fn is_turned(&self, triangle: Side) -> Option<bool> {
        self.find(triangle.patch()).ok().map(|side| side.is_turned() ^ triangle.is_turned())
    }

    /// The half-edges of the boundary in the patches.
    pub(super) fn boundary(&self) -> &[u32] {
        &self.boundary
    }

    fn clear(&mut self) {
        self.queue.clear();
        self.boundary.clear();
        self.flood = self.flood.wrapping_add(1);
        if self.flood == 0 {
            self.reached.fill((0, Side::new(0, false)));
            self.flood = 1;
        }
    }

    /// The side of a patch, or the free slot for it.
    #[inline]
    fn find(&self, patch: u32) -> Result<Side, usize> {
        let mask = self.reached.len() - 1;
        // One product (Knuth, TAOCP 3, §6.4).
        let mut slot = (patch.wrapping_mul(0x9e37_79b9) >> 8) as usize & mask;
        loop {
            let (flood, side) = self.reached[slot];
            if flood != self.flood {
                return Err(slot);
            }
            if side.patch() == patch {
                return Ok(side);
            }
            slot = (slot + 1) & mask;
        }
    }

    fn enter(&mut self, side: Side) {
        if 2 * self.queue.len() >= self.reached.len() {
            self.reached = vec![(0, side); 2 * self.reached.len()];
            self.flood = 1;
            let queue = std::mem::take(&mut self.queue);
            queue.into_iter().for_each(|side| self.enter(side));
        }
        if let Err(slot) = self.find(side.patch()) {
            self.reached[slot] = (self.flood, side);
            self.queue.push(side);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dcr::surface::connected::ConnectedMesh;
    use crate::job::Context;
    use crate::mesh::{Mesh, exact};
    use std::collections::BTreeSet;

    /// A strip of `2 * count` triangles on the unit square, every third turned over, folded at its middle.
    fn folded(count: u32) -> Mesh {
        let place = |i: u32, y: f32| {
            let x = i as f32 / count as f32;
            if x <= 0.5 { [x, y, 0.0] } else { [1.0 - x, y, 0.1 * (x - 0.5)] }
        };
        let positions = (0..=count).flat_map(|i| [place(i, 0.0), place(i, 1.0)]).collect();
        let triangles = (0..count).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 1], [2 * i + 1, 2 * i + 2, 2 * i + 3]]);
        let turned = |(k, [a, b, c]): (usize, [u32; 3])| if k % 3 == 0 { [a, c, b] } else { [a, b, c] };
        Mesh::new(positions, triangles.enumerate().map(turned).collect()).unwrap()
    }

    /// The triangles reached through edges that the ball meets.
    fn reached(connected: &ConnectedMesh, triangle: u32, place: Vec3, radius: f64) -> BTreeSet<u32> {
        let (mut all, mut queue) = (BTreeSet::from([triangle]), vec![triangle]);
        while let Some(triangle) = queue.pop() {
            for edge in 3 * triangle..3 * triangle + 3 {
                let [a, b] = connected.ends(edge);
                let share = ((place.as_dvec3() - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                if (a + share * (b - a)).distance(place.as_dvec3()) <= radius {
                    queue.extend(connected.across(edge).map(|other| other / 3).filter(|&other| all.insert(other)));
                }
            }
        }
        all
    }

    /// Of patches a flood reaches all that one of triangles does, and nothing far beyond, on whatever side it faces.
    #[test]
    fn patches_are_reached_as_their_triangles_are() {
        for (count, spacing) in [(10, 0.05), (200, 0.1), (1000, 0.2), (1000, 0.05)] {
            let mesh = folded(count);
            let connected = ConnectedMesh::new(&mesh).unwrap();
            let context = Context::new(1).unwrap();
            let patches = context.run(None, |job| Patches::new(job, &connected, spacing)).unwrap();
            let (mut flood, mut beyond) = (Flood::default(), 0);
            for start in (0..2 * count).step_by(7) {
                let [a, b, c] = mesh.corners(start).map(Vec3::from);
                let place = (a + b + c) / 3.0;
                flood.spread(&patches, start, place, 2.0, (1.0 / spacing) as f32);
                let expected = reached(&connected, start, place, 2.0 * spacing * 0.9999);
                let far = reached(&connected, start, place, 4.0 * spacing);
                for triangle in 0..2 * count {
                    let found = flood.is_turned(patches.side(triangle));
                    assert!(found.is_some() || !expected.contains(&triangle), "{start} {triangle}");
                    assert!(found.is_none() || far.contains(&triangle), "{start} {triangle}");
                    beyond += usize::from(found.is_some() && !expected.contains(&triangle));
                    // The first half faces up as it was made, the second too; both turned over every third.
                    let faces = |triangle: u32| triangle.is_multiple_of(3);
                    assert!(found.is_none_or(|is_turned| is_turned == (faces(triangle) ^ faces(start))));
                }
                let open = flood.boundary().iter().copied().collect::<BTreeSet<u32>>();
                assert!(open.iter().all(|&edge| connected.across(edge).next().is_none()));
                let edges = expected.iter().flat_map(|&triangle| 3 * triangle..3 * triangle + 3);
                assert!(edges.filter(|&edge| connected.across(edge).next().is_none()).all(|edge| open.contains(&edge)));
            }
            assert!(exact(mesh.bounds().1).x > 0.4 && (count == 10 || beyond > 0));
        }
    }
}
