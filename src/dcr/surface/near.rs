//! The surroundings of samples: the samples within a ball that are reached on the surface without leaving it.
//!
//! A [`Flood`] starts from a sample's triangle and crosses all edges that the ball meets. So samples that are
//! near through space but not on the surface, as on the other side of a thin wall, are not found, and those behind a
//! sharp fold are. Neither normals nor winding are trusted.
//!
//! At a boundary the flood mirrors the samples found, as the thesis does on bounded domains (Fig. 4.12 (b)).

use glam::{DVec2, DVec3, Vec3};

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::grading::{Even, Grading, between, level};
use crate::dcr::surface::spread::along_curve;
use crate::dcr::surface::view::MOST;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::index::{LEVELS, MovingGrid3};
use crate::job::{Job, chunks};
use crate::mesh::{Mesh, exact};

/// Two positions on the boundary at which a sample is mirrored are farther apart than this fraction of the ball's
/// radius, or at least 60 degrees apart as seen from it: without its image by both sides of a corner, nothing keeps a
/// sample off one of them.
const APART: f64 = 0.2;

/// The mirror image of a sample by a half-edge of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Image {
    pub sample: u32,
    pub edge: u32,
}

/// The samples near one sample.
#[derive(Clone, Debug, Default)]
pub struct Surroundings {
    /// The samples that are reached on the surface: the nearest, with the images no more than [`MOST`].
    pub reached: Vec<u32>,
    pub images: Vec<Image>,
    /// All other samples within sight through space, on any parts of the surface.
    pub others: Vec<u32>,
    /// The mean normal, on the front side of the sample's triangle; zero where there is none.
    pub normal: Vec3,
}

/// All samples, found by their position. Lengths are in the units of the mesh.
pub struct SampleSearch<'a, G> {
    pub connected: &'a ConnectedMesh<'a>,
    pub patches: &'a Patches,
    pub cells: &'a MovingGrid3,
    pub grading: &'a G,
    /// The grade of each sample where it varies.
    pub grades: &'a [f32],
    pub spacing: f64,
    /// The radius of the ball, and the distance up to which others are in sight; in spacings.
    pub radius: f64,
    pub sight: f64,
}

/// Receives the surroundings of one sample after the other.
#[derive(Default)]
pub struct Finds {
    flood: Flood,
    near: Vec<Near>,
}

#[derive(Clone, Copy)]
struct Near {
    squared: f32,
    sample: u32,
    position: Vec3,
}

impl<'a> SampleSearch<'a, Even> {
    /// A search within a radius, in spacings, where all are the same.
    pub fn even(
        connected: &'a ConnectedMesh<'a>,
        patches: &'a Patches,
        cells: &'a MovingGrid3,
        spacing: f64,
        radius: f64,
    ) -> Self {
        Self { connected, patches, cells, grading: &Even, grades: &[], spacing, radius, sight: 0.0 }
    }
}

/// The side of the cells in which samples are found.
pub fn cell_side(spacing: f64, radius: f64, sight: f64) -> f64 {
    // Slightly larger, for the rounding of positions in cells.
    radius.max(sight) * spacing * (1.0 + 1e-6)
}

/// The radius of the ball in which a flood spreads, over that of the search by the sample's own grade: those of coarser
/// samples count too.
const COARSER: f32 = 1.5;

/// The number of levels below its own on which a sample finds others. Those on finer levels find it.
const FINER: u32 = 2;

impl<G: Grading> SampleSearch<'_, G> {
    /// The grade of a sample.
    #[inline]
    fn grade(&self, sample: u32) -> f32 {
        if G::VARIES { self.grades[sample as usize] } else { 1.0 }
    }

    /// Visits all samples that may be near one.
    #[inline]
    fn visit(&self, sample: u32, position: Vec3, mut visit: impl FnMut(u32, Vec3)) {
        if !G::VARIES {
            return self.cells.around(position, visit);
        }
        let own = self.grade(sample);
        let side = cell_side(self.spacing, self.radius, self.sight);
        for level in level(self.grading, own).saturating_sub(FINER)..LEVELS {
            let largest = self.grading.least() * (2u32 << level) as f32;
            self.cells.within(position, side * f64::from(0.5 * (own + largest)), level, &mut visit);
        }
    }

    /// The surroundings of a sample. `seen` has the triangle of each sample and its normal.
    pub fn around(&self, sample: u32, seen: impl Fn(u32) -> (u32, Vec3), finds: &mut Finds) -> Surroundings {
        let unit = (1.0 / self.spacing) as f32;
        let (position, triangle) = (self.cells.position(sample), seen(sample).0);
        let Finds { flood, near } = finds;
        let own = self.grade(sample);
        let reach = if G::VARIES { COARSER * own } else { 1.0 };
        flood.spread(self.patches, triangle, position, reach * self.radius as f32, unit);
        near.clear();
        let mut around = Surroundings::default();
        let (limit, in_sight) = ((self.radius * self.radius) as f32, (self.sight * self.sight) as f32);
        let mut normal = Vec3::ZERO;
        self.visit(sample, position, |other, place| {
            let unit = unit * between::<G>(own, self.grade(other));
            let squared = ((place - position) * unit).length_squared();
            if squared <= limit {
                let (triangle, front) = seen(other);
                if let Some(is_turned) = flood.is_turned(self.patches.side(triangle)) {
                    let weight = 1.0 - squared / limit;
                    normal += if is_turned { -weight } else { weight } * front;
                    near.push(Near { squared, sample: other, position: place });
                    return;
                }
            }
            if squared <= in_sight && other != sample {
                around.others.push(other);
            }
        });
        around.normal = normal.normalize_or_zero();
        let boundary = flood.boundary();
        if !boundary.is_empty() {
            self.mirror_all(boundary, position.as_dvec3(), own, near, &mut around.images);
        }
        self.keep_nearest(sample, position, in_sight, near, &mut around);
        around
    }

    /// Takes the samples found, or the nearest of them if there are too many.
    fn keep_nearest(
        &self,
        sample: u32,
        position: Vec3,
        in_sight: f32,
        near: &mut Vec<Near>,
        around: &mut Surroundings,
    ) {
        near.retain(|near| near.sample != sample);
        if near.len() + around.images.len() > MOST {
            let own = self.grade(sample);
            let image_squared = |image: &Image| {
                let unit = (1.0 / self.spacing) as f32 * between::<G>(own, self.grade(image.sample));
                let place = self.cells.position(image.sample).as_dvec3();
                let place = mirrored(place, self.connected.ends(image.edge));
                ((place - position.as_dvec3()).as_vec3() * unit).length_squared()
            };
            let images: Vec<(f32, Image)> = around.images.iter().map(|image| (image_squared(image), *image)).collect();
            let mut all: Vec<f32> = near.iter().map(|near| near.squared).chain(images.iter().map(|i| i.0)).collect();
            all.sort_unstable_by(f32::total_cmp);
            let farthest = all[MOST - 1];
            near.sort_by(|a, b| a.squared.total_cmp(&b.squared).then(a.sample.cmp(&b.sample)));
            around.images = images.into_iter().filter(|image| image.0 <= farthest).map(|image| image.1).collect();
            around.images.truncate(MOST);
            let room = MOST - around.images.len();
            let left_out = near.drain(near.len().min(room)..).filter(|near| near.squared <= in_sight);
            around.others.extend(left_out.map(|near| near.sample));
        }
        around.reached.extend(near.iter().map(|near| near.sample));
    }

    /// Mirrors the samples at the edges of the boundary that the ball meets.
    fn mirror_all(&self, boundary: &[u32], centre: DVec3, own: f32, near: &[Near], images: &mut Vec<Image>) {
        let radius = self.radius * self.spacing * f64::from(own);
        let is_met = |&edge: &u32| {
            let [a, b] = self.connected.ends(edge);
            nearest_on(a, b, centre).distance_squared(centre) <= radius * radius
        };
        let met: Vec<u32> = boundary.iter().copied().filter(is_met).collect();
        if !met.is_empty() {
            near.iter()
                .for_each(|near| self.mirror(&met, near.sample, near.position.as_dvec3(), (centre, radius), images));
        }
    }

    /// Adds the mirror images of a sample: by the position on the boundary that is nearest to it, and by all other
    /// edges that it is beside. Along a boundary with many corners one image replaces several.
    fn mirror(
        &self,
        boundary: &[u32],
        sample: u32,
        position: DVec3,
        (centre, radius): (DVec3, f64),
        images: &mut Vec<Image>,
    ) {
        let mirrors = boundary.iter().map(|&edge| {
            let [a, b] = self.connected.ends(edge);
            let mirror = nearest_on(a, b, position);
            (mirror.distance_squared(position), edge, mirror, mirror != a && mirror != b)
        });
        let mut mirrors: Vec<_> = mirrors.collect();
        mirrors.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<DVec3> = Vec::new();
        for (_, edge, mirror, is_beside) in mirrors {
            let is_apart = taken.iter().all(|&other| {
                let (one, other) = (mirror - position, other - position);
                one.distance(other) > APART * radius || 2.0 * one.dot(other) <= one.length() * other.length()
            });
            if taken.is_empty() || (is_beside && is_apart) {
                taken.push(mirror);
                if (2.0 * mirror - position).distance_squared(centre) <= radius * radius {
                    images.push(Image { sample, edge });
                }
            }
        }
    }
}

/// The point of a segment that is nearest to a position.
fn nearest_on(a: DVec3, b: DVec3, place: DVec3) -> DVec3 {
    let (along, offset) = (b - a, place - a);
    match offset.dot(along) / along.length_squared() {
        share if share <= 0.0 => a,
        share if share >= 1.0 => b,
        share => a + share * along,
    }
}

/// The mirror image of a position by an edge.
pub fn mirrored(place: DVec3, [a, b]: [DVec3; 2]) -> DVec3 {
    2.0 * nearest_on(a, b, place) - place
}

// The part of a surface that is reached from a sample without leaving a ball, in patches.

/// The patches that the flood from one sample has reached.
pub struct Flood {
    /// The last flood that has reached each patch, and the patch's side, by a hash of the patch. There are more than
    /// twice as many slots as patches.
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
    pub fn spread(&mut self, patches: &Patches, triangle: u32, place: Vec3, radius: f32, unit: f32) {
        self.clear();
        // The sides of patches relative to the front of this triangle.
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

    /// Some if a triangle of a patch was reached: true if its front is on the other side than that of the triangle
    /// where the flood began.
    pub fn is_turned(&self, triangle: Side) -> Option<bool> {
        self.find(triangle.patch()).ok().map(|side| side.is_turned() ^ triangle.is_turned())
    }

    /// The half-edges of the boundary in the patches.
    pub fn boundary(&self) -> &[u32] {
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
    fn find(&self, patch: u32) -> std::result::Result<Side, usize> {
        let mask = self.reached.len() - 1;
        // Multiplicative hashing (Knuth, TAOCP 3, §6.4).
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

// A coarse version of a mesh: patches of connected triangles, and the portals through which they connect.
//
// The triangles of a patch have their centres in one voxel, a little more than half a spacing wide, so that the number
// of patches near a sample does not grow with the number of triangles. A triangle larger than a voxel is a patch.

/// The side of a voxel, in spacings.
const VOXEL: f64 = 0.6;

/// The voxel of triangles that are patches on their own.
const ALONE: u64 = u64::MAX;

const NONE: u32 = u32::MAX;

/// A patch, or the patch of a triangle, and a bit that is set if its front is on the other side than that of the patch,
/// which is the side of the patch's first triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side(u32);

impl Side {
    pub fn new(patch: u32, is_turned: bool) -> Self {
        Self(patch << 1 | u32::from(is_turned))
    }

    pub fn patch(self) -> u32 {
        self.0 >> 1
    }

    pub fn is_turned(self) -> bool {
        self.0 & 1 == 1
    }
}

/// A portal from a patch into another one.
#[derive(Clone, Copy)]
pub struct Portal {
    /// The other patch, and true if its front is on the other side than that of this one.
    pub to: Side,
    /// The ends of the common edge or, of several edges, the corners of the box around them.
    ends: [[f32; 3]; 2],
    is_box: bool,
}

impl Portal {
    /// True if a ball meets the portal. `unit` is 1 over a spacing, in which the radius is.
    #[inline]
    pub fn meets(&self, place: Vec3, radius: f32, unit: f32) -> bool {
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
pub struct Patches {
    /// The patch of each triangle.
    sides: Vec<Side>,
    exits: Exits,
}

/// The exits of all patches.
#[derive(Default)]
struct Exits {
    /// The index at which the portals of each patch end and those of the next begin; the same for `open`.
    ends: Vec<[u32; 2]>,
    portals: Vec<Portal>,
    /// The half-edges of boundaries.
    open: Vec<u32>,
}

impl Patches {
    /// Divides a mesh. O(n).
    pub fn new(job: &Job, connected: &ConnectedMesh, spacing: f64) -> Result<Self> {
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
    pub fn side(&self, triangle: u32) -> Side {
        self.sides[triangle as usize]
    }

    /// The portals of a patch.
    #[inline]
    pub fn portals(&self, patch: u32) -> &[Portal] {
        let [[from, _], [to, _]] = self.exits.bounds(patch);
        &self.exits.portals[from as usize..to as usize]
    }

    /// The half-edges of a patch that are at a boundary.
    #[inline]
    pub fn open(&self, patch: u32) -> &[u32] {
        let [[_, from], [_, to]] = self.exits.bounds(patch);
        &self.exits.open[from as usize..to as usize]
    }
}

impl Exits {
    /// Adds the exits of the next patch.
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

    /// Adds the exits of the patches after these.
    fn append(&mut self, part: Self) {
        let [portals, open] = [self.portals.len() as u32, self.open.len() as u32];
        self.ends.extend(part.ends.iter().map(|end| [end[0] + portals, end[1] + open]));
        self.portals.extend(part.portals);
        self.open.extend(part.open);
    }

    /// The range of the exits of a patch.
    #[inline]
    fn bounds(&self, patch: u32) -> [[u32; 2]; 2] {
        let patch = patch as usize;
        [if patch == 0 { [0; 2] } else { self.ends[patch - 1] }, self.ends[patch]]
    }
}

/// The triangles of a mesh by patches.
struct Division {
    /// The patch of each triangle.
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

/// The voxels of a mesh, each a number. Voxels far from each other may have the same number.
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

#[cfg(test)]
mod tests {
    use super::*;

    use std::collections::BTreeSet;

    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    const RADIUS: f64 = 0.15;

    /// Unit squares at these heights, each of two triangles.
    fn squares(heights: &[f32]) -> Mesh {
        let positions = heights.iter().flat_map(|&z| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]]);
        let triangles =
            (0..heights.len() as u32).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
        Mesh::new(positions.collect(), triangles.collect()).unwrap()
    }

    fn places(mesh: &Mesh, count: u64) -> Vec<SurfacePoint> {
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let mut place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            SurfacePoint { triangle: rng.below(mesh.triangles().len() as u64) as u32, uv }
        };
        (0..count).map(|_| place()).collect()
    }

    /// The neighbours of all samples: the sample, and the position of it or its image.
    fn found(mesh: &Mesh, places: &[SurfacePoint]) -> Vec<Vec<(u32, DVec3)>> {
        let connected = &ConnectedMesh::new(mesh).unwrap();
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(mesh)).collect();
        let context = Context::new(1).unwrap();
        let patches = &context.run(None, |job| Patches::new(job, connected, RADIUS)).unwrap();
        let side = cell_side(RADIUS, 1.0, 0.0);
        let cells = &MovingGrid3::new(DVec3::ZERO, side, positions.iter().map(|position| position.as_vec3()));
        let search = SampleSearch::even(connected, patches, cells, RADIUS, 1.0);
        let seen = |sample: u32| (places[sample as usize].triangle, Vec3::Z);
        let mut finds = Finds::default();
        let around = |sample| {
            let around = search.around(sample, seen, &mut finds);
            let reached = around.reached.iter().map(|&other| (other, positions[other as usize]));
            let at = |image: &Image| mirrored(positions[image.sample as usize], connected.ends(image.edge));
            reached.chain(around.images.iter().map(|image| (image.sample, at(image)))).collect()
        };
        (0..places.len() as u32).map(around).collect()
    }

    fn sorted(mut neighbours: Vec<(u32, DVec3)>) -> Vec<(u32, [i64; 3])> {
        // Up to rounding.
        let key = |x: DVec3| x.to_array().map(|x| (x * 1e9).round() as i64);
        neighbours.sort_by_key(|&(sample, position)| (sample, key(position)));
        neighbours.into_iter().map(|(sample, position)| (sample, key(position))).collect()
    }

    #[test]
    fn on_a_square_they_are_all_that_are_near_and_the_images_by_its_sides() {
        let mesh = squares(&[0.0]);
        let places = places(&mesh, 400);
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(&mesh)).collect();
        let mut mirrored = 0;
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            let mut expected = Vec::new();
            for (sample, &position) in positions.iter().enumerate() {
                let DVec3 { x, y, .. } = position;
                let mut images = vec![position];
                images.extend([DVec3::new(-x, y, 0.0), DVec3::new(x, -y, 0.0)]);
                images.extend([DVec3::new(2.0 - x, y, 0.0), DVec3::new(x, 2.0 - y, 0.0)]);
                let near = images.into_iter().filter(|image| image.distance(positions[centre]) <= RADIUS);
                expected.extend(
                    near.filter(|&image| sample != centre || image != position).map(|image| (sample as u32, image)),
                );
            }
            expected.sort_by(|a, b| a.1.distance(positions[centre]).total_cmp(&b.1.distance(positions[centre])));
            expected.truncate(MOST);
            mirrored += expected.iter().filter(|(_, position)| position.min_element() < 0.0).count();
            assert_eq!(sorted(neighbours), sorted(expected), "around {}", positions[centre]);
        }
        assert!(mirrored > 100);
    }

    #[test]
    fn the_other_side_of_a_thin_wall_is_not_near() {
        let mesh = squares(&[0.0, 0.001]);
        let places = places(&mesh, 500);
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            assert!(neighbours.len() > 5);
            let side = |sample: usize| places[sample].triangle / 2;
            assert!(neighbours.iter().all(|&(sample, _)| side(sample as usize) == side(centre)));
        }
    }

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

    /// A flood of patches reaches all that a flood of triangles does, and nothing far beyond, whichever side it faces.
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
