//! A mesh in coarse: patches of connected triangles, and the portals through which one leads into another.
//!
//! The triangles of a patch have their centres in one voxel, a little more than half a spacing wide, so that the number
//! of patches near a sample does not grow with the number of triangles. A triangle larger than a voxel is a patch.

use glam::{DVec2, DVec3, Vec3};

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::curve::along_curve;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::job::{Job, chunks};
use crate::mesh::{Mesh, exact};

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
    exits: Exits,
}

/// What leads out of patches.
#[derive(Default)]
struct Exits {
    /// The portals of each patch end, and the next one's begin, at this number of them; the same for `open`.
    ends: Vec<[u32; 2]>,
    portals: Vec<Portal>,
    /// The half-edges of boundaries.
    open: Vec<u32>,
}

impl Patches {
    /// Divides a mesh. O(n).
    pub(super) fn new(job: &Job, connected: &ConnectedMesh, spacing: f64) -> Result<Self> {
        let Division { sides, triangles, starts } = Division::new(job, connected, spacing)?;
        let chunks = chunks(starts.len() - 1);
        let parts = job.map(chunks.len(), |chunk| {
            let mut part = Exits::default();
            for patch in chunks.range(chunk) {
                part.add(connected, &sides, patch as u32, &triangles[starts[patch]..starts[patch + 1]]);
            }
            part
        })?;
        let mut exits = Exits::default();
        parts.into_iter().for_each(|part| exits.append(part));
        Ok(Self { sides, exits })
    }

    /// The patch of a triangle.
    #[inline]
    pub(super) fn side(&self, triangle: u32) -> Side {
        self.sides[triangle as usize]
    }

    /// The portals of a patch.
    #[inline]
    pub(super) fn portals(&self, patch: u32) -> &[Portal] {
        let [[from, _], [to, _]] = self.exits.bounds(patch);
        &self.exits.portals[from as usize..to as usize]
    }

    /// The half-edges of a patch that are at a boundary.
    #[inline]
    pub(super) fn open(&self, patch: u32) -> &[u32] {
        let [[_, from], [_, to]] = self.exits.bounds(patch);
        &self.exits.open[from as usize..to as usize]
    }
}

impl Exits {
    /// Adds what leads out of the next patch.
    fn add(&mut self, connected: &ConnectedMesh, sides: &[Side], patch: u32, triangles: &[u32]) {
        let first = self.portals.len();
        for edge in triangles.iter().flat_map(|&triangle| 3 * triangle..3 * triangle + 3) {
            let mut is_open = true;
            for other in connected.across(edge) {
                is_open = false;
                let side = sides[(other / 3) as usize];
                if side.patch() == patch {
                    continue;
                }
                let ends = connected.end_positions(edge);
                match self.portals[first..].iter_mut().find(|portal| portal.to.patch() == side.patch()) {
                    Some(portal) => portal.extend(ends),
                    None => {
                        let here = sides[(edge / 3) as usize];
                        let is_turned = here.is_turned() ^ side.is_turned() ^ connected.run_alike(edge, other);
                        self.portals.push(Portal { to: Side::new(side.patch(), is_turned), ends, is_box: false });
                    }
                }
            }
            if is_open {
                self.open.push(edge);
            }
        }
        self.ends.push([self.portals.len() as u32, self.open.len() as u32]);
    }

    /// Adds what leads out of the patches after these.
    fn append(&mut self, part: Self) {
        let [portals, open] = [self.portals.len() as u32, self.open.len() as u32];
        self.ends.extend(part.ends.iter().map(|end| [end[0] + portals, end[1] + open]));
        self.portals.extend(part.portals);
        self.open.extend(part.open);
    }

    /// Where the exits of a patch begin and end.
    #[inline]
    fn bounds(&self, patch: u32) -> [[u32; 2]; 2] {
        let patch = patch as usize;
        [if patch == 0 { [0; 2] } else { self.ends[patch - 1] }, self.ends[patch]]
    }
}

/// The triangles of a mesh by patches.
struct Division {
    /// For each triangle its patch.
    sides: Vec<Side>,
    /// Patch `p` has the triangles `starts[p]..starts[p + 1]` of these.
    triangles: Vec<u32>,
    starts: Vec<usize>,
}

impl Division {
    fn new(job: &Job, connected: &ConnectedMesh, spacing: f64) -> Result<Self> {
        let count = connected.mesh.triangles().len();
        let chunks = chunks(count);
        let voxels = Voxels::new(connected.mesh, spacing);
        let voxels: Vec<u64> = job.concat(chunks.len(), |chunk| {
            chunks.range(chunk).map(|triangle| voxels.of(connected.mesh, triangle as u32)).collect()
        })?;
        let mut sides = vec![Side(NONE); count];
        let (mut triangles, mut starts) = (Vec::with_capacity(count), vec![]);
        for first in connected.mesh.sampled_triangles() {
            if sides[first as usize].0 != NONE {
                continue;
            }
            let (patch, voxel) = (starts.len() as u32, voxels[first as usize]);
            let mut next = triangles.len();
            starts.push(next);
            sides[first as usize] = Side::new(patch, false);
            triangles.push(first);
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
        Ok(Self { sides, triangles, starts }.along_curve(connected.mesh))
    }

    /// The same patches in the order in which samples are: those of one flood are found in the cache.
    fn along_curve(self, mesh: &Mesh) -> Self {
        let Self { mut sides, triangles: divided, starts: before } = self;
        let middle = |&start: &usize| SurfacePoint { triangle: divided[start], uv: DVec2::splat(1.0 / 3.0) };
        let middles: Vec<_> = before[..before.len() - 1].iter().map(middle).collect();
        let (mut triangles, mut starts) = (Vec::with_capacity(divided.len()), vec![0]);
        for (patch, (_, old)) in (0..).zip(along_curve(mesh, &middles)) {
            let members = &divided[before[old as usize]..before[old as usize + 1]];
            for &triangle in members {
                let side = &mut sides[triangle as usize];
                *side = Side::new(patch, side.is_turned());
            }
            triangles.extend_from_slice(members);
            starts.push(triangles.len());
        }
        Self { sides, triangles, starts }
    }
}

/// The voxels of a mesh, each a number. Voxels far from each other may have the same.
struct Voxels {
    low: DVec3,
    side: f64,
}

impl Voxels {
    fn new(mesh: &Mesh, spacing: f64) -> Self {
        Self { low: exact(mesh.bounds().0), side: VOXEL * spacing }
    }

    /// The voxel in which a triangle has its centre.
    fn of(&self, mesh: &Mesh, triangle: u32) -> u64 {
        let [a, b, c] = mesh.exact_corners(triangle);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        if longest > self.side * self.side {
            return ALONE;
        }
        let place = ((a + b + c) / 3.0 - self.low) / self.side;
        let bits = |x: f64| x as u64 & 0x1f_ffff;
        bits(place.x) | bits(place.y) << 21 | bits(place.z) << 42
    }
}
