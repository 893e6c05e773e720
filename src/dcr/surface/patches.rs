//! A mesh in coarse: patches of connected triangles, and the portals through which one leads into another.
//!
//! The triangles of a patch have their centres in one voxel, a little more than half a spacing wide, so that the number
//! of patches near a sample does not grow with the number of triangles. A triangle larger than a voxel is a patch.

use glam::Vec3;

use crate::dcr::surface::connected::ConnectedMesh;

/// The side of a voxel, in spacings.
const VOXEL: f64 = 0.6;

/// The voxel of triangles that are patches by themselves.
const ALONE: u64 = u64::MAX;

const NONE: u32 = u32::MAX;

/// A patch, or a triangle's patch, and whether its front is on the other side: that of the patch is the side of its
/// first triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side(u32);

impl Side {
    pub(super) fn new(patch: u32, is_turned: bool) -> Self {
        Self(patch << 1 | u32::from(is_turned))
    }

    pub(super) fn patch(self) -> u32 {
        self.0 >> 1
    }

    pub(super) fn is_turned(self) -> bool {
        self.0 & 1 == 1
    }
}

/// Where a patch leads into another one.
#[derive(Clone, Copy)]
pub(super) struct Portal {
    /// The other patch, and whether its front is on the other side than that of this one.
    pub(super) to: Side,
    /// The ends of the common edge or, of several edges, the corners of the box around them.
    ends: [[f32; 3]; 2],
    is_box: bool,
}

impl Portal {
    /// Whether a ball meets the portal. `unit` is 1 over a spacing, in which the radius is.
    #[inline]
    pub(super) fn meets(&self, place: Vec3, radius: f32, unit: f32) -> bool {
        let [a, b] = self.ends.map(Vec3::from);
        let offset = if self.is_box {
            place.clamp(a, b) - place
        } else {
            let (along, to) = ((b - a) * unit, (place - a) * unit);
            if to.length_squared() <= radius * radius {
                return true;
            }
            let share = (to.dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            return (to - share * along).length_squared() <= radius * radius;
        };
        (offset * unit).length_squared() <= radius * radius
    }

    fn extend(&mut self, ends: [[f32; 3]; 2]) {
        let [a, b] = ends.map(Vec3::from);
        let [low, high] = self.ends.map(Vec3::from);
        self.ends = [low.min(high).min(a).min(b), low.max(high).max(a).max(b)].map(|end| end.to_array());
        self.is_box = true;
    }
}

/// The patches of a mesh.
pub(super) struct Patches {
    /// For each triangle its patch.
    sides: Vec<Side>,
    /// Patch `p` has the portals `starts[p].portals..starts[p + 1].portals`, and so on.
    starts: Vec<Start>,
    portals: Vec<Portal>,
    /// The half-edges of boundaries.
    open: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Start {
    portals: u32,
    open: u32,
}

impl Patches {
    /// Divides a mesh. O(n).
    pub(super) fn new(connected: &ConnectedMesh, spacing: f64) -> Self {
        let (sides, triangles, starts) = divided(connected, spacing);
        let mut patches =
            Self { sides, starts: vec![Start { portals: 0, open: 0 }], portals: Vec::new(), open: Vec::new() };
        for (patch, range) in (0..).zip(starts.windows(2)) {
            triangles[range[0]..range[1]].iter().for_each(|&triangle| patches.leave(connected, patch, triangle));
            patches.starts.push(Start { portals: patches.portals.len() as u32, open: patches.open.len() as u32 });
        }
        patches
    }

    /// Adds the edges through which a triangle leads out of the last patch.
    fn leave(&mut self, connected: &ConnectedMesh, patch: u32, triangle: u32) {
        let first = self.starts[patch as usize].portals as usize;
        for edge in 3 * triangle..3 * triangle + 3 {
            let mut is_open = true;
            for other in connected.across(edge) {
                is_open = false;
                let side = self.sides[(other / 3) as usize];
                if side.patch() == patch {
                    continue;
                }
                let ends = connected.end_positions(edge);
                let same = self.portals[first..].iter_mut().find(|portal| portal.to.patch() == side.patch());
                match same {
                    Some(portal) => portal.extend(ends),
                    None => {
                        let here = self.sides[triangle as usize];
                        let is_turned = here.is_turned() ^ side.is_turned() ^ connected.run_alike(edge, other);
                        self.portals.push(Portal { to: Side::new(side.patch(), is_turned), ends, is_box: false });
                    }
                }
            }
            if is_open {
                self.open.push(edge);
            }
        }
    }

    /// The patch of a triangle.
    #[inline]
    pub(super) fn side(&self, triangle: u32) -> Side {
        self.sides[triangle as usize]
    }

    /// The portals of a patch.
    #[inline]
    pub(super) fn portals(&self, patch: u32) -> &[Portal] {
        let [start, end] = self.bounds(patch);
        &self.portals[start.portals as usize..end.portals as usize]
    }

    /// The half-edges of a patch that are at a boundary.
    #[inline]
    pub(super) fn open(&self, patch: u32) -> &[u32] {
        let [start, end] = self.bounds(patch);
        &self.open[start.open as usize..end.open as usize]
    }

    fn bounds(&self, patch: u32) -> [Start; 2] {
        [self.starts[patch as usize], self.starts[patch as usize + 1]]
    }
}

/// The patch of each triangle, the triangles by patches, and where each patch begins among these.
fn divided(connected: &ConnectedMesh, spacing: f64) -> (Vec<Side>, Vec<u32>, Vec<usize>) {
    let count = connected.mesh.triangles().len();
    let voxels = voxels(connected, spacing);
    let mut sides = vec![Side(NONE); count];
    let (mut triangles, mut starts) = (Vec::with_capacity(count), vec![]);
    for first in connected.mesh.sampled_triangles() {
        if sides[first as usize].0 != NONE {
            continue;
        }
        let (patch, voxel) = (starts.len() as u32, voxels[first as usize]);
        starts.push(triangles.len());
        sides[first as usize] = Side::new(patch, false);
        triangles.push(first);
        let mut next = triangles.len() - 1;
        while voxel != ALONE && next < triangles.len() {
            let triangle: u32 = triangles[next];
            next += 1;
            for edge in 3 * triangle..3 * triangle + 3 {
                for other in connected.across(edge) {
                    let reached = (other / 3) as usize;
                    if voxels[reached] == voxel && sides[reached].0 == NONE {
                        let is_turned = sides[triangle as usize].is_turned() ^ connected.run_alike(edge, other);
                        sides[reached] = Side::new(patch, is_turned);
                        triangles.push(reached as u32);
                    }
                }
            }
        }
    }
    starts.push(triangles.len());
    (sides, triangles, starts)
}

/// The voxel in which each triangle has its centre. Voxels far from each other may have the same number.
fn voxels(connected: &ConnectedMesh, spacing: f64) -> Vec<u64> {
    let mesh = connected.mesh;
    let (low, voxel) = (crate::mesh::exact(mesh.bounds().0), VOXEL * spacing);
    let of = |triangle: u32| {
        let [a, b, c] = mesh.exact_corners(triangle);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        if longest > voxel * voxel {
            return ALONE;
        }
        let place = ((a + b + c) / 3.0 - low) / voxel;
        let bits = |x: f64| x as u64 & 0x1f_ffff;
        bits(place.x) | bits(place.y) << 21 | bits(place.z) << 42
    };
    (0..mesh.triangles().len() as u32).map(of).collect()
}
