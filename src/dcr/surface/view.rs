//! The tangent plane of one sample: its neighbours there, and its Delaunay star among them.

use glam::{DQuat, DVec3, Vec2};

use crate::dcr::ground::constraints::{Constraints, FREE_CLEARANCE, Force};
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::near::{NearSample, Surroundings, mirrored};
use crate::dcr::surface::star::StarCandidates;
use crate::dcr::surface::walk::FlatTriangle;

/// The tangent plane of one sample after the other.
#[derive(Default)]
pub(super) struct View {
    candidates: StarCandidates,
    /// The samples of the candidates.
    samples: Vec<NearSample>,
    /// The star, by indices of candidates, and whether it is closed.
    star: Vec<usize>,
    is_closed: bool,
    ring: Vec<Vec2>,
}

impl View {
    /// Projects the neighbours of a sample at `from` on the triangle `flat`. Offsets keep their length, which is the
    /// straight distance in spacings. The plane is that of the mean normal, rotated into that of the triangle: so
    /// samples on a fold, or on one of many small facets, have neighbours on all sides.
    pub(super) fn project(
        &mut self,
        connected: &ConnectedMesh,
        flat: &FlatTriangle,
        from: DVec3,
        around: &Surroundings,
        positions: &[DVec3],
    ) {
        let turn = DQuat::from_rotation_arc(around.normal, flat.normal());
        self.candidates.clear();
        self.samples.clear();
        for &neighbour in &around.neighbours {
            let position = positions[neighbour.sample as usize];
            let position = neighbour.mirror.map_or(position, |edge| mirrored(position, connected.ends(edge)));
            let offset = flat.turned(turn * (position - from)).as_vec2();
            // A sample at the same position is in no direction.
            if offset != Vec2::ZERO {
                self.candidates.add(offset);
                self.samples.push(neighbour);
            }
        }
        self.is_closed = self.candidates.star(&mut self.star);
    }

    /// The force by the neighbours. A sample that they do not surround is only pushed.
    pub(super) fn force(&mut self, constraints: &Constraints) -> Force {
        if self.is_closed {
            self.ring.clear();
            self.ring.extend(self.star.iter().map(|&candidate| self.candidates.offset(candidate)));
            return constraints.force(&self.ring);
        }
        let offsets = (0..self.samples.len()).map(|candidate| self.candidates.offset(candidate));
        Force {
            sum: offsets.map(|offset| constraints.push(offset, offset.length_squared())).sum(),
            clearance: FREE_CLEARANCE,
        }
    }

    /// The triangles of the star, but for mirror images: the samples at their two other corners, counter-clockwise.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 2]> {
        let pairs = self.star.iter().zip(self.star.iter().cycle().skip(1));
        let count = if self.is_closed { self.star.len() } else { self.star.len().saturating_sub(1) };
        pairs.take(count).filter_map(|(&one, &other)| {
            let corners = [self.samples[one], self.samples[other]];
            corners.iter().all(|corner| corner.mirror.is_none()).then(|| corners.map(|corner| corner.sample))
        })
    }
}
