//! A triangulation without boundary, as the ring of neighbours of each point, counter-clockwise.
//!
//! A point gathers from its ring, which is one run of memory. A flip changes the rings of four points, so flips in
//! different [`Patch`]es, the rings of consecutive points, can be made in parallel.
//!
//! Rings have few slots, as points have few neighbours at a constant density. Where the density varies, some points have
//! hundreds, and every ring would need as many slots: there the mesh is one of half-edges
//! (`density/half_edge_mesh.rs`).

use glam::DVec2;
use spade::handles::VertexHandle;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::dcr::torus::{Torus, TorusPoint, nudge};
use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;

/// The number of neighbours that any point can gain by flips before the slots are full.
const SPARE: usize = 3;

/// The number of slots is a multiple of this, which is a cache line.
const LINE: usize = 16;

/// The largest number of slots: for points with more neighbours all others would waste too much memory.
const MOST: usize = 64;

/// An edge, from point to point, each by its name in rings ([`Copies`]).
pub type Edge = [u32; 2];

/// The names of points in rings.
///
/// On a torus that is large beside its edges, the name of a neighbour is its index. On a small one several copies of a
/// point, or copies of the point itself, are neighbours: there the highest bits of a name are the number of periods
/// from the point to its copy, modulo 8, along `x` and along `y`. Positions are those on a torus of eight periods each,
/// whose offsets are unambiguous.
#[derive(Clone, Copy)]
pub struct Copies {
    /// The bits of a name that are numbers of periods along `x` and along `y`.
    along: [u32; 2],
}

/// The bits of a number of periods.
pub const PERIOD_BITS: u32 = 3;

impl Copies {
    /// Names without copies.
    pub const NONE: Self = Self { along: [0; 2] };
    /// Names with copies.
    pub const MANY: Self = Self { along: [7 << 29, 7 << 26] };

    /// True if names have copies.
    pub fn are_named(self) -> bool {
        self.along != [0; 2]
    }

    /// The index of a point.
    #[inline(always)]
    pub fn point(self, name: u32) -> usize {
        (name & !(self.along[0] | self.along[1])) as usize
    }

    /// The copy of a point that is so many periods away.
    pub fn copy(self, point: u32, periods: [i32; 2]) -> u32 {
        let [x, y] = periods.map(i32::cast_unsigned);
        point | (x << 29 & self.along[0]) | (y << 26 & self.along[1])
    }

    /// The position of a point, of `places` on the torus of eight periods.
    #[inline(always)]
    pub fn place(self, places: &[TorusPoint], name: u32) -> TorusPoint {
        let [x, y] = places[self.point(name)];
        let [along_x, along_y] = self.along.map(|along| name & along);
        [x.wrapping_add(along_x), y.wrapping_add(along_y << PERIOD_BITS)]
    }

    /// The name of a point for one that names itself without periods, and another by the name `from`.
    #[inline(always)]
    fn seen_from(self, name: u32, from: u32) -> u32 {
        let [x, y] = self.along.map(|along| (name & along).wrapping_sub(from & along) & along);
        self.point(name) as u32 | x | y
    }

    /// The reverse of [`Copies::seen_from`].
    #[inline(always)]
    fn seen_as_from(self, name: u32, from: u32) -> u32 {
        let [x, y] = self.along.map(|along| (name & along).wrapping_add(from & along) & along);
        self.point(name) as u32 | x | y
    }
}

/// Rings of some points, in no order: the form in which a mesh is built.
#[derive(Default)]
pub struct RingList {
    /// The points, and the ends of their rings in `neighbours`.
    pub points: Vec<(u32, usize)>,
    pub neighbours: Vec<u32>,
}

/// The neighbours of every point.
pub struct Rings {
    copies: Copies,
    /// The number of neighbours that a point can have.
    slots: usize,
    degrees: Vec<u8>,
    /// The neighbours of point `p` from `slots · p` on. Slots after the last neighbour hold an arbitrary point.
    neighbours: Vec<u32>,
}

/// The rings of consecutive points, mutable.
pub struct Patch<'a> {
    copies: Copies,
    first: u32,
    slots: usize,
    degrees: &'a mut [u8],
    neighbours: &'a mut [u32],
}

/// A flip is impossible: a ring has no slot left, or too few neighbours.
#[derive(Debug)]
pub struct Impossible;

impl Rings {
    /// The rings of `count` points; none if a point has fewer than three neighbours, or more than there are slots.
    pub fn new(count: usize, stars: &[RingList]) -> Option<Self> {
        let rings = || {
            stars.iter().flat_map(|stars| {
                let starts = std::iter::once(0).chain(stars.points.iter().map(|&(_, end)| end));
                starts.zip(&stars.points).map(|(start, &(point, end))| (point as usize, &stars.neighbours[start..end]))
            })
        };
        let longest = rings().map(|(_, ring)| ring.len()).max()?;
        let slots = (longest + SPARE).next_multiple_of(LINE);
        if slots > MOST {
            return None;
        }
        let (mut degrees, mut neighbours) = (vec![0; count], vec![0; count * slots]);
        for (point, ring) in rings() {
            let slots_of_point = &mut neighbours[point * slots..(point + 1) * slots];
            slots_of_point[..ring.len()].copy_from_slice(ring);
            slots_of_point[ring.len()..].fill(*ring.first()?);
            degrees[point] = ring.len() as u8;
        }
        degrees.iter().all(|&degree| degree >= 3).then_some(Self { copies: Copies::NONE, slots, degrees, neighbours })
    }

    /// The rings of `count` points on a torus on which only the first, and with it its copies, are in triangles: the
    /// halves of the rectangle between four of them.
    pub fn of_first(count: usize) -> Self {
        let (copies, slots) = (Copies::MANY, 2 * LINE);
        let (mut degrees, mut neighbours) = (vec![0; count], vec![0; count * slots]);
        let around = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];
        neighbours.iter_mut().zip(around).for_each(|(neighbour, periods)| *neighbour = copies.copy(0, periods));
        degrees.iter_mut().take(1).for_each(|degree| *degree = around.len() as u8);
        Self { copies, slots, degrees, neighbours }
    }

    /// These rings on the torus itself, with names without copies.
    pub fn without_copies(&self) -> Self {
        let neighbours = self.neighbours.iter().map(|&name| self.copies.point(name) as u32).collect();
        Self { copies: Copies::NONE, slots: self.slots, degrees: self.degrees.clone(), neighbours }
    }

    /// The names of points in these rings.
    #[inline(always)]
    pub fn copies(&self) -> Copies {
        self.copies
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.degrees.len()
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.degrees.iter().map(|&degree| usize::from(degree)).sum::<usize>() / 2
    }

    /// The neighbours of a point.
    #[inline]
    pub fn ring(&self, point: usize) -> &[u32] {
        &self.slots_of(point)[..self.degree(point)]
    }

    /// The number of neighbours of a point.
    #[inline]
    pub fn degree(&self, point: usize) -> usize {
        self.degrees[point].into()
    }

    /// The slots of a point, the first of which hold its neighbours.
    #[inline]
    pub fn slots_of(&self, point: usize) -> &[u32] {
        &self.neighbours[point * self.slots..][..self.slots]
    }

    /// True if for every neighbour `q` of a point and the one that follows it, `r`, the point follows `r` in the ring
    /// of `q`: then the rings describe triangles on which all corners agree.
    pub fn agree(&self, point: usize) -> bool {
        let ring = self.ring(point);
        let is_distinct = (1..ring.len()).all(|k| !ring[..k].contains(&ring[k]));
        is_distinct
            && ring.iter().zip(ring.iter().cycle().skip(1)).all(|(&q, &r)| {
                let ring = self.ring(self.copies.point(q));
                let [r, point] = [r, point as u32].map(|name| self.copies.seen_from(name, q));
                ring.iter().position(|&p| p == r).is_some_and(|k| ring[(k + 1) % ring.len()] == point)
            })
    }

    /// The rings in patches of `size` points.
    pub fn patches(&mut self, size: usize) -> impl Iterator<Item = Patch<'_>> {
        let (copies, slots) = (self.copies, self.slots);
        let parts = self.degrees.chunks_mut(size).zip(self.neighbours.chunks_mut(size * slots));
        parts.enumerate().map(move |(i, (degrees, neighbours))| {
            let first = (i * size) as u32;
            Patch { copies, first, slots, degrees, neighbours }
        })
    }
}

impl Patch<'_> {
    /// The names of points in the rings.
    pub fn copies(&self) -> Copies {
        self.copies
    }

    /// True if the ring of a point is in the patch.
    pub fn holds(&self, name: u32) -> bool {
        self.index(name) < self.degrees.len()
    }

    /// The index after the last point of the patch.
    pub fn end(&self) -> usize {
        self.first as usize + self.degrees.len()
    }

    /// The number of points of the patch.
    pub fn len(&self) -> usize {
        self.degrees.len()
    }

    /// The index of a point in the patch.
    fn index(&self, name: u32) -> usize {
        self.copies.point(name).wrapping_sub(self.first as usize)
    }

    /// The ring of a point, in the names for which its own has no periods.
    pub fn ring(&self, name: u32) -> &[u32] {
        let index = self.index(name);
        &self.neighbours[index * self.slots..][..self.degrees[index].into()]
    }

    /// The points on the left and on the right of the edge from `p` to `q`; none if that is no edge.
    pub fn apices(&self, [p, q]: [u32; 2]) -> Option<[u32; 2]> {
        let (ring, q) = (self.ring(p), self.copies.seen_from(q, p));
        let k = ring.iter().position(|&other| other == q)?;
        let [r, s] = [ring[(k + 1) % ring.len()], ring[(k + ring.len() - 1) % ring.len()]];
        Some([r, s].map(|apex| self.copies.seen_as_from(apex, p)))
    }

    /// Replaces the edge from `p` to `q` by the one between the points on its left and on its right. All four are held.
    pub fn flip(&mut self, [p, q]: [u32; 2], [r, s]: [u32; 2]) -> std::result::Result<(), Impossible> {
        // Two of them may be copies of one point.
        let are_copies = |a: u32, b: u32| usize::from(self.copies.point(a) == self.copies.point(b));
        let is_least = |a: u32, b: u32| self.ring(a).len() <= 3 + are_copies(a, b);
        let is_full = |a: u32, b: u32| self.ring(a).len() + are_copies(a, b) >= self.slots;
        if is_least(p, q) || is_least(q, p) || is_full(r, s) || is_full(s, r) {
            return Err(Impossible);
        }
        self.remove(p, q);
        self.remove(q, p);
        self.insert(r, s, p);
        self.insert(s, r, q);
        Ok(())
    }

    /// Divides the triangle with these corners, counter-clockwise, by a point in it that had no ring. All are held.
    pub fn divide(&mut self, [a, b, c]: [u32; 3], point: u32) -> std::result::Result<(), Impossible> {
        // All three may be copies of one point.
        if [a, b, c].into_iter().any(|corner| self.ring(corner).len() + 3 > self.slots) {
            return Err(Impossible);
        }
        let index = self.index(point);
        self.neighbours[index * self.slots..][..3].copy_from_slice(&[a, b, c]);
        self.degrees[index] = 3;
        self.insert(a, point, b);
        self.insert(b, point, c);
        self.insert(c, point, a);
        Ok(())
    }

    /// Removes `other` from a ring.
    fn remove(&mut self, point: u32, other: u32) {
        let (index, other) = (self.index(point), self.copies.seen_from(other, point));
        let degree = usize::from(self.degrees[index]);
        let ring = &mut self.neighbours[index * self.slots..][..degree];
        let k = ring.iter().position(|&neighbour| neighbour == other).expect("both ends know an edge");
        ring.copy_within(k + 1.., k);
        self.degrees[index] -= 1;
    }

    /// Inserts `other` into a ring, after `before`.
    fn insert(&mut self, point: u32, other: u32, before: u32) {
        let index = self.index(point);
        let [other, before] = [other, before].map(|name| self.copies.seen_from(name, point));
        let degree = usize::from(self.degrees[index]);
        let ring = &mut self.neighbours[index * self.slots..][..=degree];
        let k = ring.iter().position(|&neighbour| neighbour == before).expect("corners of a triangle are neighbours");
        ring.copy_within(k + 1..degree, k + 2);
        ring[k + 1] = other;
        self.degrees[index] += 1;
    }
}

// The first triangulation of large sets, tile by tile.
//
// Each tile of the torus is triangulated with the points in a margin around it. The star of a point is that of the
// whole set if the circumcircles of its triangles lie where all points are known; otherwise there is no result, and the
// set must be triangulated as a whole.

/// The least number of points of a tile on average; it can be four times as high.
const POINTS: usize = 2000;

/// The margin, in spacings: slightly more than the diameter of the largest empty circle of a million random points.
const MARGIN: f64 = 4.0;

/// A point in a tile or its margin.
#[derive(Clone, Copy)]
struct Vertex {
    /// The offset from the lower corner of the tile, in spacings.
    position: DVec2,
    point: u32,
    is_inside: bool,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        // spade refuses coordinates below 2^-142.
        spade::mitigate_underflow(Point2::new(self.position.x, self.position.y))
    }
}

/// A torus cut into 2^`level` tiles along each axis, and the points of each.
struct Tiles<'a> {
    torus: &'a Torus,
    places: &'a [TorusPoint],
    level: u32,
    /// The points by tiles.
    points: Binned<u32>,
}

/// The rings of all points. None for sets that are too small, and if a star is not enclosed in the margin of its tile.
pub fn triangulate_by_tiles(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Result<Option<Vec<RingList>>> {
    let level = (places.len() / POINTS).max(1).ilog2() / 2;
    let narrow = torus.frame.size().min_element() / f64::from(1u32 << level) < 2.0 * MARGIN;
    // With at least three tiles along an axis, those on both sides of one differ.
    if level < 2 || narrow {
        return Ok(None);
    }
    let tiles = Tiles::new(torus, places, level);
    let stars = job.map(1 << (2 * level), |tile| tiles.stars(tile as u32))?;
    Ok(stars.into_iter().collect())
}

impl<'a> Tiles<'a> {
    fn new(torus: &'a Torus, places: &'a [TorusPoint], level: u32) -> Self {
        let tiles = Self { torus, places, level, points: Binned::default() };
        let points = (0..).zip(places).map(|(point, &place)| (tiles.tile(place), point));
        let points = Binned::new(1 << (2 * level), points);
        Self { points, ..tiles }
    }

    fn tile(&self, place: TorusPoint) -> usize {
        let [x, y] = place.map(|x| x >> (32 - self.level));
        (y << self.level | x) as usize
    }

    /// The size of a tile in spacings.
    fn size(&self) -> DVec2 {
        self.torus.frame.size() / f64::from(1u32 << self.level)
    }

    /// The rings of the points of a tile.
    fn stars(&self, tile: u32) -> Option<RingList> {
        let size = self.size();
        let knows = |centre: DVec2, radius: f64| {
            (centre - radius).cmpge(DVec2::splat(-MARGIN)).all() && (centre + radius).cmple(size + MARGIN).all()
        };
        let triangulation = DelaunayTriangulation::<Vertex>::bulk_load(self.vertices(tile)).ok()?;
        let is_enclosed = |star: &VertexHandle<'_, Vertex>| {
            star.out_edges().all(|edge| {
                edge.face().as_inner().is_some_and(|face| {
                    let (centre, radius_squared) = face.circumcircle();
                    knows(DVec2::new(centre.x, centre.y), radius_squared.sqrt())
                })
            })
        };
        let mut stars = RingList::default();
        for star in triangulation.vertices().filter(|star| star.data().is_inside) {
            if !is_enclosed(&star) {
                return None;
            }
            stars.neighbours.extend(star.out_edges().map(|edge| edge.to().data().point));
            stars.points.push((star.data().point, stars.neighbours.len()));
        }
        Some(stars)
    }

    /// The points of a tile and of its margin.
    fn vertices(&self, tile: u32) -> Vec<Vertex> {
        let (size, side) = (self.size(), 1 << self.level);
        let [column, row] = [tile % side, tile / side];
        // The middle of the tile: no point of the margin is half a period away from it.
        let middle = [column, row].map(|index| (2 * index + 1) << (31 - self.level));
        let around = [side - 1, 0, 1].map(|dy| [side - 1, 0, 1].map(|dx| [(column + dx) % side, (row + dy) % side]));
        let mut vertices = Vec::new();
        for [column, row] in around.into_iter().flatten() {
            let tile = (row * side + column) as usize;
            for &point in self.points.bin(tile) {
                let offset = self.torus.offset(middle, self.places[point as usize]) + nudge(point);
                let position = offset + 0.5 * size;
                if position.cmpge(DVec2::splat(-MARGIN)).all() && position.cmple(size + MARGIN).all() {
                    let is_inside = self.tile(self.places[point as usize]) == self.tile(middle);
                    vertices.push(Vertex { position, point, is_inside });
                }
            }
        }
        vertices
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The torus of 4 × 4 points whose squares are cut along one diagonal.
    fn lattice() -> Rings {
        let mut stars = RingList::default();
        for point in 0..16 {
            let (x, y) = (point % 4, point / 4);
            let at = |dx: u32, dy: u32| (x + dx) % 4 + (y + dy) % 4 * 4;
            stars.neighbours.extend([at(1, 0), at(1, 1), at(0, 1), at(3, 0), at(3, 3), at(0, 3)]);
            stars.points.push((point, stars.neighbours.len()));
        }
        Rings::new(16, &[stars]).unwrap()
    }

    #[test]
    fn a_flip_turns_an_edge_and_another_turns_it_back() {
        let mut rings = lattice();
        assert_eq!(rings.edges(), 48);
        let flip = |rings: &mut Rings, edge| {
            let mut patch = rings.patches(16).next().unwrap();
            let apices = patch.apices(edge).unwrap();
            patch.flip(edge, apices).unwrap();
            apices
        };
        let edge = flip(&mut rings, [0, 5]);
        assert_eq!(edge, [4, 1]);
        assert!(rings.ring(4).contains(&1) && !rings.ring(0).contains(&5));
        assert_eq!([0, 1, 4, 5].map(|point| rings.degree(point)), [5, 7, 7, 5]);
        assert!((0..16).all(|point| rings.agree(point)) && rings.edges() == 48);
        assert_eq!(rings.patches(16).next().unwrap().apices([0, 5]), None);
        flip(&mut rings, edge);
        assert!((0..16).all(|point| rings.agree(point) && rings.degree(point) == 6));
    }

    #[test]
    fn patches_hold_their_points_and_rings_that_are_full_refuse_flips() {
        let mut rings = lattice();
        let patches: Vec<_> = rings.patches(6).map(|patch| [0, 5, 6, 11, 12, 15].map(|p| patch.holds(p))).collect();
        let (yes, no) = (true, false);
        assert_eq!(patches, [[yes, yes, no, no, no, no], [no, no, yes, yes, no, no], [no, no, no, no, yes, yes]]);
        rings.slots = 6;
        rings.neighbours = (0..16).flat_map(|point| lattice().ring(point).to_vec()).collect();
        assert!(rings.patches(16).next().unwrap().flip([0, 5], [4, 1]).is_err());
    }

    #[test]
    fn rings_that_disagree_are_found() {
        let mut rings = lattice();
        rings.neighbours.swap(0, 1);
        assert!(!rings.agree(0));
        assert!(Rings::new(17, &[RingList::default()]).is_none());
    }
}
