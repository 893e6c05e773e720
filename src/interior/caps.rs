//! Caps, which close the holes of a mesh.
//!
//! Edges that an odd number of triangles shares form rings, since each vertex has an even number of them. Each ring gets a cap:
//! the triangulation of least area (Barequet and Sharir 1995, "Filling gaps in the boundary of a polyhedron"; Liepa 2003, "Filling
//! holes in meshes"), whose edges are then halved until they are short beside the ring. Each new vertex is moved to where the
//! generalised winding number (`winding.rs`; Jacobson et al. 2013, "Robust inside-outside segmentation using generalized winding
//! numbers") is 1/2, or as near to it as halves of edges allow, at first and again when all others are there: where the surface is on one
//! side of a flat ring, the cap stays flat.
//!
//! The mesh with its caps is closed by construction, however floats are rounded: edges of rings are not changed, and where vertices
//! are put on them, triangles of no area are between the old edge and the new ones. The cap of a loose triangle is that triangle.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc;

use glam::DVec3;

use crate::error::Result;
use crate::interior::{Interior, WOUND};
use crate::memory;
use crate::mesh::{Mesh, exact};

/// No edge of a cap is longer than this part of the length of its ring, where there are up to `IN_FULL` rings of one length; the caps of
/// more rings have as many triangles together.
const PIECES: f64 = 48.0;
const IN_FULL: f64 = 16.0;

/// The most edges of a cap that are halved.
const MOST_HALVED: usize = 4096;

/// The most vertices of a ring whose triangulation is the best. A longer one is triangulated by so many of its vertices, and
/// then between them.
const BEST: usize = 64;

/// The weight of squared edges beside areas: it decides between triangulations of a flat ring.
const SHORTNESS: f64 = 1e-3;

/// A vertex is moved by at most this share of the edge that it halves.
const REACH: f64 = 0.5;

/// The numbers are asked for along a line at most so often, until one is right to this.
const TRIALS: usize = 7;
const GOOD: f64 = 1e-3;

/// After all vertices are made, each is moved again so many times, along the normal that it has by then.
const SWEEPS: usize = 3;

/// A place is on the surface if it is nearer than this, in lengths of the ring.
const ON_SURFACE: f64 = 1e-6;

/// No triangle: beyond an edge of the ring.
const NONE: usize = usize::MAX;

/// The most bytes, while caps are made, for each edge of a ring and for each triangle of the mesh.
const BYTES_PER_EDGE: f64 = 200.0;
const BYTES_PER_TRIANGLE: f64 = 40.0;

/// A mesh with its caps, as it is kept.
struct Capped(Arc<Mesh>);

impl Mesh {
    /// The mesh with caps in its holes, made the first time and then kept; none if it is closed. The triangles that the mask leaves out
    /// are not in it. O(n log n), and for each ring of edges some thousands of questions for winding numbers.
    pub(crate) fn with_caps(&self) -> Result<Option<Arc<Self>>> {
        let sides = self.sides();
        if sides.odd_edges == 0 {
            return Ok(None);
        }
        let make = || {
            let (count, triangles) = (sides.odd_edges, self.triangles().len());
            let bytes = BYTES_PER_EDGE * count as f64 + BYTES_PER_TRIANGLE * triangles as f64;
            memory::require(bytes, "mesh", &format!("caps at {count} edges of {triangles} triangles"))?;
            Ok(Capped(Arc::new(capped(self, &sides.boundary, &Interior::of(self))?)))
        };
        Ok(Some(self.kept(|| Ok(()), make)?.0.clone()))
    }
}

fn capped(mesh: &Mesh, boundary: &[[u32; 2]], interior: &Interior) -> Result<Mesh> {
    let mut positions = mesh.positions().to_vec();
    let mut triangles: Vec<_> = mesh.sampled_triangles().map(|number| mesh.triangles()[number as usize]).collect();
    let rings = rings(boundary);
    let places = |ring: &[u32]| ring.iter().map(|&vertex| mesh.positions()[vertex as usize]).collect::<Vec<_>>();
    let lengths: Vec<f64> = rings.iter().map(|ring| length(&places(ring))).collect();
    let common = (lengths.iter().map(|length| length * length).sum::<f64>() / IN_FULL).sqrt();
    for (ring, length) in rings.iter().zip(lengths) {
        // On the surface the number jumps from 1/2 to -1/2, as of a sheet, which is its own cap.
        let on_surface = ON_SURFACE * length;
        let winding = |place: [f32; 3]| match interior.nearest(place.map(f64::from), on_surface) {
            Some(_) => WOUND,
            None => interior.winding(place),
        };
        let cap = Cap::new(places(ring), length, length.max(common) / PIECES, winding);
        let first = positions.len();
        let vertex = |number: u32| match ring.get(number as usize) {
            Some(&vertex) => vertex,
            None => (first + number as usize - ring.len()) as u32,
        };
        triangles.extend(cap.triangles.iter().chain(&cap.on_edges).map(|corners| corners.map(vertex)));
        positions.extend(&cap.places[ring.len()..]);
    }
    Mesh::new(positions, triangles)
}

/// The length of a ring.
fn length(ring: &[[f32; 3]]) -> f64 {
    (0..ring.len()).map(|k| exact(ring[k]).distance(exact(ring[(k + 1) % ring.len()]))).sum()
}

/// The rings of the edges that occur an odd number of times in a boundary, each vertex once in a ring; against no direction where
/// that is possible.
fn rings(boundary: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let same = boundary.chunk_by(|a, b| a == b);
    let odd: Vec<[u32; 2]> = same.filter(|same| !same.len().is_multiple_of(2)).map(|same| same[0]).collect();
    let mut around: BTreeMap<u32, Vec<_>> = BTreeMap::new();
    for (edge, &[from, to]) in odd.iter().enumerate() {
        around.entry(from).or_default().push(Reverse((false, to, edge)));
        around.entry(to).or_default().push(Reverse((true, from, edge)));
    }
    around.values_mut().for_each(|edges| edges.sort_unstable());
    let (mut is_passed, mut rings) = (vec![false; odd.len()], Vec::new());
    for &[start, _] in &odd {
        let (mut path, mut places) = (vec![start], BTreeMap::from([(start, 0)]));
        while let Some(edges) = around.get_mut(&path[path.len() - 1])
            && let Some(Reverse((_, next, edge))) = edges.pop()
        {
            if std::mem::replace(&mut is_passed[edge], true) {
                continue;
            }
            if let Some(&from) = places.get(&next) {
                let ring = path.split_off(from);
                ring.iter().for_each(|vertex| _ = places.remove(vertex));
                rings.push(ring);
            }
            places.insert(next, path.len());
            path.push(next);
        }
    }
    rings
}

/// The cap of a ring. The vertices of the ring are the first ones.
struct Cap {
    places: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The triangles of no area between edges of the ring and their pieces.
    on_edges: Vec<[u32; 3]>,
    /// The triangles at each edge.
    edges: BTreeMap<[u32; 2], [usize; 2]>,
}

impl Cap {
    /// The cap of a ring of a length, with edges of at most `longest`, up to those of a triangle.
    fn new(ring: Vec<[f32; 3]>, length: f64, longest: f64, winding: impl Fn([f32; 3]) -> f64) -> Self {
        let is_triangle = ring.len() == 3;
        let mut cap = Self { places: ring, triangles: Vec::new(), on_edges: Vec::new(), edges: BTreeMap::new() };
        let pieces = if is_triangle { vec![0, 1, 2] } else { cap.divide_ring(longest) };
        let places: Vec<_> = cap.places.iter().map(|&place| exact(place)).collect();
        triangulate(&places, &pieces, &mut cap.triangles);
        if !is_triangle {
            let moved = |start, direction, reach| level(start, direction, [reach, length], &winding);
            let first = cap.places.len();
            cap.halve(longest, moved);
            cap.settle(first, moved);
        }
        cap
    }

    /// Puts vertices on the edges of the ring, and gives the ring with them.
    fn divide_ring(&mut self, longest: f64) -> Vec<u32> {
        let (count, mut pieces) = (self.places.len() as u32, Vec::new());
        for from in 0..count {
            let to = (from + 1) % count;
            let [a, b] = [from, to].map(|vertex| exact(self.places[vertex as usize]));
            let parts = ((b - a).length() / longest).ceil().max(1.0) as u32;
            let first = self.places.len() as u32;
            pieces.push(from);
            for part in 1..parts {
                pieces.push(self.places.len() as u32);
                self.places.push((a + (b - a) * (f64::from(part) / f64::from(parts))).as_vec3().to_array());
            }
            let path: Vec<u32> = (first..self.places.len() as u32).chain([to]).collect();
            self.on_edges.extend(path.windows(2).map(|ends| [from, ends[0], ends[1]]));
        }
        pieces
    }

    /// Halves edges, the longest one first, and moves the vertices.
    fn halve(&mut self, longest: f64, moved: impl Fn(DVec3, DVec3, f64) -> [f32; 3]) {
        for triangle in 0..self.triangles.len() {
            self.sides(triangle).into_iter().for_each(|edge| self.put(edge, NONE, triangle));
        }
        let mut queue: BinaryHeap<_> = self.edges.keys().filter_map(|&edge| self.long(edge, longest)).collect();
        for _ in 0..MOST_HALVED {
            let Some((_, Reverse(edge))) = queue.pop() else { break };
            let [low, high] = edge.map(|vertex| exact(self.places[vertex as usize]));
            let sides = self.edges.remove(&edge).unwrap_or([NONE; 2]);
            let direction = sides.iter().map(|&side| self.normal(side)).sum::<DVec3>().normalize_or_zero();
            let vertex = self.places.len() as u32;
            self.places.push(moved((low + high) / 2.0, direction, REACH * low.distance(high)));
            for side in sides {
                // The old triangle keeps the lower vertex.
                let (old, other) = (self.triangles[side], self.triangles.len());
                self.triangles[side] = old.map(|corner| if corner == edge[1] { vertex } else { corner });
                self.triangles.push(old.map(|corner| if corner == edge[0] { vertex } else { corner }));
                self.put(sorted([vertex, edge[0]]), NONE, side);
                self.put(sorted([vertex, edge[1]]), NONE, other);
                for apex in old.into_iter().filter(|corner| !edge.contains(corner)) {
                    self.put(sorted([apex, edge[1]]), side, other);
                    self.edges.insert(sorted([apex, vertex]), [side, other]);
                    queue.extend(self.long(sorted([apex, vertex]), longest));
                }
            }
            queue.extend(edge.into_iter().filter_map(|end| self.long(sorted([end, vertex]), longest)));
        }
    }

    /// Moves the vertices from a first one on once more, by no more than a share of their shortest edge.
    fn settle(&mut self, first: usize, moved: impl Fn(DVec3, DVec3, f64) -> [f32; 3]) {
        let mut around = vec![Vec::new(); self.places.len() - first];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            corners
                .iter()
                .filter(|&&corner| corner as usize >= first)
                .for_each(|&c| around[c as usize - first].push(triangle));
        }
        for _ in 0..SWEEPS {
            for (vertex, triangles) in (first..).zip(&around) {
                let place = exact(self.places[vertex]);
                let direction =
                    triangles.iter().map(|&triangle| self.normal(triangle)).sum::<DVec3>().normalize_or_zero();
                let ends = triangles
                    .iter()
                    .flat_map(|&triangle| self.triangles[triangle])
                    .filter(|&end| end as usize != vertex);
                let shortest =
                    ends.map(|end| place.distance(exact(self.places[end as usize]))).fold(f64::INFINITY, f64::min);
                self.places[vertex] = moved(place, direction, REACH * shortest);
            }
        }
    }

    fn sides(&self, triangle: usize) -> [[u32; 2]; 3] {
        let [a, b, c] = self.triangles[triangle];
        [[a, b], [b, c], [c, a]].map(sorted)
    }

    /// Puts a triangle at an edge, in place of another one.
    fn put(&mut self, edge: [u32; 2], old: usize, new: usize) {
        let sides = self.edges.entry(edge).or_insert([NONE; 2]);
        if let Some(side) = sides.iter_mut().find(|side| **side == old) {
            *side = new;
        }
    }

    /// The entry of an edge between two triangles if it is too long.
    fn long(&self, edge: [u32; 2], longest: f64) -> Option<(u64, Reverse<[u32; 2]>)> {
        let [a, b] = edge.map(|vertex| exact(self.places[vertex as usize]));
        let length = a.distance(b);
        // Bits of positive numbers have their order.
        (length > longest && !self.edges[&edge].contains(&NONE)).then_some((length.to_bits(), Reverse(edge)))
    }

    /// The area of a triangle along its normal, twice.
    fn normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.triangles[triangle].map(|vertex| exact(self.places[vertex as usize]));
        (b - a).cross(c - a)
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The place along a direction, no farther than a reach, where the winding number is nearest to 1/2 in size of those that the
/// method of secants asks for.
fn level(start: DVec3, direction: DVec3, [reach, length]: [f64; 2], winding: impl Fn([f32; 3]) -> f64) -> [f32; 3] {
    let at = |along: f64| {
        let place = (start + along * direction).as_vec3().to_array();
        (place, winding(place))
    };
    let (first, number) = at(0.0);
    let (mut last, mut excess) = (0.0, number.abs() - WOUND);
    // The slope in the middle of a round hole is one over its diameter.
    let mut along = (number.signum() * excess * length / std::f64::consts::PI).clamp(-reach, reach);
    let (mut best, mut least) = (first, excess.abs());
    for _ in 1..TRIALS {
        if least <= GOOD || along == last {
            break;
        }
        let (place, number) = at(along);
        let found = number.abs() - WOUND;
        if found.abs() < least {
            (best, least) = (place, found.abs());
        }
        let next = along - found * (along - last) / (found - excess);
        (last, excess) = (along, found);
        along = if next.is_finite() { next.clamp(-reach, reach) } else { last };
    }
    best
}

/// Triangulates a ring of vertices.
fn triangulate(places: &[DVec3], ring: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if ring.len() <= BEST {
        return triangulate_best(places, ring, triangles);
    }
    let step = ring.len().div_ceil(BEST);
    let coarse: Vec<u32> = ring.iter().copied().step_by(step).collect();
    triangulate_best(places, &coarse, triangles);
    for first in (0..ring.len()).step_by(step) {
        let path: Vec<u32> = ring[first..].iter().chain(&ring[..1]).take(step + 1).copied().collect();
        triangulate(places, &path, triangles);
    }
}

/// The triangulation of least area, and of short edges among those of about the same area: O(n³).
fn triangulate_best(places: &[DVec3], ring: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let count = ring.len();
    let place = |k: usize| places[ring[k] as usize];
    let cost = |i: usize, k: usize, j: usize| {
        let [u, v, w] = [place(k) - place(i), place(j) - place(k), place(i) - place(j)];
        u.cross(v).length() / 2.0 + SHORTNESS * (u.length_squared() + v.length_squared() + w.length_squared())
    };
    // Of the vertices between two: the least cost, and the vertex that forms a triangle with both.
    let mut costs = vec![(0.0, 0); count * count];
    for width in 2..count {
        for i in 0..count - width {
            let j = i + width;
            let of = |k: usize| (costs[i * count + k].0 + costs[k * count + j].0 + cost(i, k, j), k);
            let least = (i + 1..j).map(of).min_by(|a, b| a.0.total_cmp(&b.0));
            costs[i * count + j] = least.unwrap_or_default();
        }
    }
    let mut open = vec![(0, count.saturating_sub(1))];
    while let Some((i, j)) = open.pop() {
        if j >= i + 2 {
            let k = costs[i * count + j].1;
            triangles.push([i, k, j].map(|k| ring[k]));
            open.extend([(i, k), (k, j)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// A sheet of unit squares, each of two triangles, without some of its triangles, closed at its edges with another one below.
    fn pierced(side: u32, height: impl Fn(f32, f32) -> f32, is_left_out: impl Fn(u32) -> bool) -> Mesh {
        let count = side + 1;
        let place = |n: u32, z: f32| {
            let [x, y] = [n % count, n / count].map(|k| k as f32);
            [x, y, if x * y > 0.0 && x.max(y) < side as f32 { z + height(x, y) } else { 0.5 }]
        };
        let positions = (0..2).flat_map(|sheet| (0..count * count).map(move |n| (n, sheet as f32)));
        let positions = positions.map(|(n, z)| place(n, z)).collect();
        let square = |n: u32| {
            let a = n % side + n / side * count;
            let up = count * count;
            [[a, a + count, a + 1], [a + 1, a + count, a + count + 1]]
                .into_iter()
                .chain([[a, a + 1, a + count], [a + 1, a + count + 1, a + count]].map(|t| t.map(|v| v + up)))
        };
        let triangles: Vec<_> = (0..side * side).flat_map(square).collect();
        let kept = (0..).zip(triangles).filter(|&(number, _)| !is_left_out(number)).map(|(_, triangle)| triangle);
        Mesh::new(positions, kept.collect()).unwrap()
    }

    #[test]
    fn caps_close_every_mesh() {
        let whole = pierced(9, |x, y| 0.1 * (x - y), |_| false);
        assert!(whole.is_closed() && whole.with_caps().unwrap().is_none());
        for seed in 0..40 {
            let mut rng = Rng::at(seed, Draw::Probe, &[]);
            let share = rng.unit();
            let left_out: Vec<bool> = (0..324).map(|_| rng.unit() < share).collect();
            if left_out.iter().all(|&is_left_out| is_left_out) || !left_out.contains(&true) {
                continue;
            }
            let mesh = pierced(9, |x, y| 0.1 * (x - y), |number| left_out[number as usize]);
            let capped = mesh.with_caps().unwrap().unwrap();
            assert!(!mesh.is_closed() && capped.is_closed(), "{seed}");
            assert_eq!(capped.triangles()[..mesh.triangles().len()], *mesh.triangles());
            assert_eq!(capped.positions()[..mesh.positions().len()], *mesh.positions());
        }
        // An edge that three triangles share, and a triangle turned over.
        let positions = (0..6).map(|k| [k as f32, (k * k) as f32, (k % 3) as f32]).collect();
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 1, 3], [0, 1, 4], [4, 2, 1], [3, 4, 5]]).unwrap();
        assert!(mesh.with_caps().unwrap().unwrap().is_closed());
    }

    #[test]
    fn rings_pass_a_vertex_once() {
        let sorted = |boundary: &[[u32; 2]]| {
            let mut rings = rings(boundary);
            rings.sort_unstable();
            rings
        };
        assert_eq!(sorted(&[[0, 1], [1, 2], [2, 0]]), [[0, 1, 2]]);
        // Two triangles with one vertex in common, one of two edges twice, and one whose edges have no common direction.
        assert_eq!(sorted(&[[0, 1], [0, 3], [1, 2], [2, 0], [3, 4], [4, 0]]), [[0, 1, 2], [0, 3, 4]]);
        assert_eq!(sorted(&[[0, 1], [1, 2], [2, 0], [2, 7], [2, 7]]), [[0, 1, 2]]);
        assert_eq!(sorted(&[[0, 1], [2, 1], [2, 0]])[0].len(), 3);
    }

    #[test]
    fn vertices_of_caps_are_at_the_level_of_a_half() {
        let is_hole = |number: u32| {
            let (x, y) = (number / 4 % 20, number / 80);
            number % 4 > 1 && (5..15).contains(&x) && (5..15).contains(&y)
        };
        for (bend, flat) in [(0.0f32, true), (0.01, false)] {
            let mesh = pierced(20, |x, y| 3.0 + bend * ((x - 10.0).powi(2) - (y - 10.0).powi(2)), is_hole);
            let capped = mesh.with_caps().unwrap().unwrap();
            let interior = Interior::of(&mesh);
            let new = &capped.positions()[mesh.positions().len()..];
            // Within an edge of the rim they may be off.
            let is_inner = |p: &&[f32; 3]| (6.0..14.0).contains(&p[0]) && (6.0..14.0).contains(&p[1]);
            let inner: Vec<_> = new.iter().filter(is_inner).collect();
            assert!((100..3000).contains(&inner.len()), "{}", inner.len());
            let winding = |place: [f32; 3]| (place, interior.winding(place).abs());
            let off: Vec<_> = inner.iter().map(|&&p| winding(p)).filter(|(_, w)| (w - 0.5).abs() > 1e-2).collect();
            assert!(off.is_empty(), "{off:?}");
            assert_eq!(new.iter().all(|place| place[2] == 4.0), flat);
        }
    }

    #[test]
    fn the_cap_of_a_loose_triangle_is_that_triangle() {
        let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.1, 0.0], [0.2, 1.0, 0.3]], vec![[0, 1, 2]]).unwrap();
        let capped = mesh.with_caps().unwrap().unwrap();
        assert_eq!((capped.positions().len(), capped.triangles().len()), (3, 2));
    }

    /// A ring in a plane that is not convex, and one of more vertices than are triangulated at once.
    #[test]
    fn flat_rings_are_covered_once() {
        for (teeth, steps) in [(5, 10), (7, 400)] {
            let place = |k: usize| {
                let turn = std::f64::consts::TAU * k as f64 / f64::from(teeth * steps);
                DVec3::new(turn.cos(), turn.sin(), 0.0) * (1.0 + 0.4 * (f64::from(teeth) * turn).cos())
            };
            let places: Vec<_> = (0..(teeth * steps) as usize).map(place).collect();
            let ring: Vec<u32> = (0..places.len() as u32).collect();
            let mut triangles = Vec::new();
            triangulate(&places, &ring, &mut triangles);
            assert_eq!(triangles.len(), ring.len() - 2);
            let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).z / 2.0;
            let parts: Vec<_> = triangles.iter().map(|corners| area(corners.map(|k| places[k as usize]))).collect();
            let (whole, sum) = (parts.iter().sum::<f64>(), parts.iter().map(|part| part.abs()).sum::<f64>());
            assert!(whole > 3.0 && sum < whole * 1.02, "{whole} {sum}");
        }
    }
}
