//! What one sample sees: its neighbours in the tangent plane, and its Delaunay star among them.

use glam::{DQuat, DVec3, Vec2};

use crate::dcr::ground::constraints::{Constraints, Force};
use crate::dcr::surface::near::{Neighbour, Neighbourhood, mirrored};
use crate::dcr::surface::sheet::Sheet;
use crate::dcr::surface::star::Near;
use crate::dcr::surface::walk::Flat;
use crate::dcr::uniform::gather::WIDE;

/// The view of one sample after the other.
#[derive(Default)]
pub(super) struct View {
    near: Near,
    /// Who is where in `near`.
    seen: Vec<Neighbour>,
    /// The star, by places in `near`, and whether it is closed.
    star: Vec<usize>,
    is_closed: bool,
    ring: Vec<Vec2>,
}

impl View {
    /// Looks around from a sample at `from` on the triangle `flat`. Offsets keep their length, which is the straight distance
    /// in spacings. The plane is that of the mean normal, turned into that of the triangle: so samples on a fold, or on
    /// one of many small facets, see what is around them from all sides.
    pub(super) fn look(
        &mut self,
        sheet: &Sheet,
        flat: &Flat,
        from: DVec3,
        around: &Neighbourhood,
        positions: &[DVec3],
    ) {
        let turn = DQuat::from_rotation_arc(around.normal, flat.normal());
        self.near.clear();
        self.seen.clear();
        for &neighbour in &around.neighbours {
            let position = positions[neighbour.sample as usize];
            let position = neighbour.mirror.map_or(position, |border| mirrored(position, sheet.ends(border)));
            let offset = flat.turned(turn * (position - from)).as_vec2();
            // Who is at the same place is in no direction.
            if offset != Vec2::ZERO {
                self.near.add(offset);
                self.seen.push(neighbour);
            }
        }
        self.is_closed = self.near.star(&mut self.star);
    }

    /// The force by the neighbours. Who is not surrounded by them is only pushed.
    pub(super) fn force(&mut self, constraints: &Constraints) -> Force {
        if self.is_closed {
            self.ring.clear();
            self.ring.extend(self.star.iter().map(|&place| self.near.offset(place)));
            return constraints.force(&self.ring);
        }
        let offsets = (0..self.seen.len()).map(|place| self.near.offset(place));
        Force { sum: offsets.map(|offset| constraints.push(offset, offset.length_squared())).sum(), room: WIDE }
    }

    /// The triangles of the star, but for mirror images: the samples at their two other corners, counter-clockwise.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 2]> {
        let pairs = self.star.iter().zip(self.star.iter().cycle().skip(1));
        let count = if self.is_closed { self.star.len() } else { self.star.len().saturating_sub(1) };
        pairs.take(count).filter_map(|(&one, &other)| {
            let corners = [self.seen[one], self.seen[other]];
            corners.iter().all(|corner| corner.mirror.is_none()).then(|| corners.map(|corner| corner.sample))
        })
    }
}
