//! The Delaunay triangulation of a torus, kept while its points move and repaired by flips (`torus::must_flip`), in
//! half-edges.
//!
//! The forces hold points back so that no triangle turns over; if one does nevertheless, the mesh reports it and must
//! be rebuilt.
//!
//! Points have few neighbours or hundreds where the spacing varies, as anchors and points beside dark edges do:
//! half-edges support both, rings with a fixed number of slots (`uniform/rings.rs`) do not. Half-edges are numbered
//! `4 t + k`: the edge from corner `k` to the next of triangle `t`, counter-clockwise.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::dcr::torus::{Torus, TorusPoint, must_flip};
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::index::Binned;
use crate::job::{Job, chunks_of};

/// The sum of two cotangents in `f32` below which it may be negative in `f64`.
const SUSPECT: f32 = 1e-3;

/// The longest edge, in 2^-32 of a period: a flip can double it, and half a period is the longest that is unambiguous.
const LONGEST: u32 = (1 << 30) - 1;

#[derive(Clone, Copy, Debug, Default)]
struct HalfEdgeTriangle {
    corners: [u32; 3],
    /// The half-edges on the other sides of its edges.
    twins: [u32; 3],
}

/// A triangulation of a torus, all of whose edges are short.
pub struct HalfEdgeMesh {
    torus: Torus,
    triangles: Vec<HalfEdgeTriangle>,
    /// A half-edge that starts at each point.
    first: Vec<u32>,
}

/// The next half-edge of the triangle.
fn next(edge: u32) -> u32 {
    if edge & 3 == 2 { edge - 2 } else { edge + 1 }
}

/// The half-edge of the triangle before.
fn previous(edge: u32) -> u32 {
    if edge & 3 == 0 { edge + 2 } else { edge - 1 }
}

impl HalfEdgeMesh {
    /// The mesh of a triangulation of the torus with its copies. None if edges are too long, as in sets of a few points
    /// or with large holes, or if copies are not triangulated alike, which happens to four points on one circle unless
    /// they are nudged.
    pub fn new(delaunay: &Delaunay, torus: &Torus, places: &[TorusPoint]) -> Option<Self> {
        // Exactly one of the translates of a triangle has its first point in the domain.
        let corners = delaunay.triangles().filter_map(|sites| {
            let least = sites.iter().min_by_key(|site| site.source)?;
            least.is_original().then(|| sites.map(|site| site.source))
        });
        let mut corners: Vec<[u32; 3]> = corners.collect();
        corners.sort_unstable_by_key(|corners| *corners.iter().min().expect("there are three"));
        if corners.len() != 2 * places.len() || places.len() > 1 << 28 {
            return None;
        }
        let triangles = corners.into_iter().map(|corners| HalfEdgeTriangle { corners, twins: [u32::MAX; 3] }).collect();
        let mut mesh = Self { torus: *torus, triangles, first: vec![u32::MAX; places.len()] };
        (mesh.find_twins() && mesh.triangles.iter().all(|triangle| mesh.cotangents(triangle, places).is_some()))
            .then_some(mesh)
    }

    /// Matches the half-edges; true if all could be.
    fn find_twins(&mut self) -> bool {
        let edges = || (0..self.triangles.len() as u32).flat_map(|triangle| (0..3).map(move |k| 4 * triangle + k));
        let outgoing = Binned::new(self.first.len(), edges().map(|edge| (self.origin(edge) as usize, edge)));
        let twin = |edge: u32| {
            let (from, to) = (self.origin(edge), self.origin(next(edge)) as usize);
            let mut back = outgoing.bin(to).iter().copied().filter(|&back| self.origin(next(back)) == from);
            // Two edges between the same points cannot be distinguished.
            back.next().filter(|_| back.next().is_none())
        };
        let Some(twins) = edges().map(twin).collect::<Option<Vec<u32>>>() else { return false };
        let matched = |(edge, &twin): (u32, &u32)| twins[(3 * (twin >> 2) + (twin & 3)) as usize] == edge;
        let matched = edges().zip(&twins).all(matched);
        let firsts: Vec<u32> = (0..outgoing.len()).filter_map(|point| outgoing.bin(point).first().copied()).collect();
        let complete = firsts.len() == self.first.len();
        for (triangle, twins) in self.triangles.iter_mut().zip(twins.chunks(3)) {
            triangle.twins.copy_from_slice(twins);
        }
        self.first = firsts;
        matched && complete
    }

    fn origin(&self, edge: u32) -> u32 {
        self.triangles[(edge >> 2) as usize].corners[(edge & 3) as usize]
    }

    fn twin(&self, edge: u32) -> u32 {
        self.triangles[(edge >> 2) as usize].twins[(edge & 3) as usize]
    }

    fn link(&mut self, edge: u32, twin: u32) {
        self.triangles[(edge >> 2) as usize].twins[(edge & 3) as usize] = twin;
        self.triangles[(twin >> 2) as usize].twins[(twin & 3) as usize] = edge;
    }

    /// The cotangents of the angles that face the edges of a triangle; none unless it is counter-clockwise and has
    /// short edges.
    fn cotangents(&self, triangle: &HalfEdgeTriangle, places: &[TorusPoint]) -> Option<[f32; 3]> {
        let [p, q, r] = triangle.corners.map(|corner| places[corner as usize]);
        let is_short = |from: TorusPoint, to: TorusPoint| {
            (0..2).all(|axis| to[axis].wrapping_sub(from[axis]).wrapping_add(LONGEST) <= 2 * LONGEST)
        };
        let [a, b, c] = [self.torus.offset_f32(p, q), self.torus.offset_f32(q, r), self.torus.offset_f32(r, p)];
        let area = a.perp_dot(b);
        let sound = area > 0.0 && is_short(p, q) && is_short(q, r) && is_short(r, p);
        sound.then(|| [b.dot(c), c.dot(a), a.dot(b)].map(|cosine| -cosine / area))
    }

    /// True if an edge is not locally Delaunay.
    fn must_flip(&self, edge: u32, places: &[TorusPoint]) -> bool {
        let twin = self.twin(edge);
        let corners = [edge, twin, previous(edge), previous(twin)];
        must_flip(&self.torus, corners.map(|corner| places[self.origin(corner) as usize]))
    }

    /// Replaces the edge `p q` of the triangles `p q r` and `q p s` by `s r`; returns the edges around the two.
    fn flip(&mut self, edge: u32) -> [u32; 4] {
        let twin = self.twin(edge);
        let [p, q, r, s] = [edge, twin, previous(edge), previous(twin)].map(|e| self.origin(e));
        let [qr, rp, ps, sq] = [next(edge), previous(edge), next(twin), previous(twin)].map(|e| self.twin(e));
        let (a, b) = (edge & !3, twin & !3);
        self.triangles[(a >> 2) as usize].corners = [p, s, r];
        self.triangles[(b >> 2) as usize].corners = [s, q, r];
        for (edge, twin) in [(a, ps), (a + 1, b + 2), (a + 2, rp), (b, sq), (b + 1, qr)] {
            self.link(edge, twin);
        }
        for (point, edge) in [(p, a), (q, b + 1), (r, a + 2), (s, b)] {
            self.first[point as usize] = edge;
        }
        [a, a + 2, b, b + 1]
    }

    /// Makes the mesh the Delaunay triangulation of points that have moved; false if a triangle has turned over.
    pub fn repair(&mut self, job: &Job, places: &[TorusPoint]) -> Result<bool> {
        let chunks = chunks_of(self.triangles.len(), 4096);
        let sound = AtomicBool::new(true);
        let cotangents = job.part(0.0, 0.5).concat(chunks.len(), |chunk| {
            let cotangents = |triangle| {
                self.cotangents(triangle, places).unwrap_or_else(|| {
                    sound.store(false, Ordering::Relaxed);
                    [0.0; 3]
                })
            };
            self.triangles[chunks.range(chunk)].iter().map(cotangents).collect()
        })?;
        if !sound.into_inner() {
            return Ok(false);
        }
        let found = job.part(0.5, 1.0).map(chunks.len(), |chunk| {
            let edges = chunks.range(chunk).flat_map(|triangle| (0..3).map(move |k| (triangle, k)));
            let suspects = edges.filter_map(|(triangle, k)| {
                let (edge, twin) = (4 * triangle as u32 + k as u32, self.triangles[triangle].twins[k]);
                let other = || cotangents[(twin >> 2) as usize][(twin & 3) as usize];
                (edge < twin && cotangents[triangle][k] + other() < SUSPECT).then_some(edge)
            });
            suspects.filter(|&edge| self.must_flip(edge, places)).collect::<Vec<u32>>()
        })?;
        let mut wrong = found.concat();
        while let Some(edge) = wrong.pop() {
            if self.must_flip(edge, places) {
                wrong.extend(self.flip(edge));
            }
        }
        Ok(true)
    }

    /// Visits the neighbours of a point, counter-clockwise.
    pub fn for_each_neighbour(&self, point: usize, mut visit: impl FnMut(u32)) {
        let start = self.first[point];
        let mut edge = start;
        loop {
            let triangle = &self.triangles[(edge >> 2) as usize];
            visit(triangle.corners[(next(edge) & 3) as usize]);
            edge = triangle.twins[(previous(edge) & 3) as usize];
            if edge == start {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::torus::random_sets::{random_places, wander, with_and_without_mesh};
    use crate::job::Context;
    use crate::points::Boundary;
    use crate::rng::{Draw, Rng};

    fn delaunay(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Delaunay {
        Delaunay::new(job, &torus.frame, torus.nudged(places).into_iter()).unwrap()
    }

    /// The corners of all triangles, each from its least corner on.
    fn triangles(mesh: &HalfEdgeMesh) -> Vec<[u32; 3]> {
        let turned = |triangle: &HalfEdgeTriangle| {
            let mut corners = triangle.corners;
            let least = (0..3).min_by_key(|&k| corners[k]).unwrap();
            corners.rotate_left(least);
            corners
        };
        let mut triangles: Vec<_> = mesh.triangles.iter().map(turned).collect();
        triangles.sort_unstable();
        triangles
    }

    fn check_links(mesh: &HalfEdgeMesh) {
        for edge in (0..4 * mesh.triangles.len() as u32).filter(|edge| edge & 3 < 3) {
            let twin = mesh.twin(edge);
            assert_eq!(mesh.twin(twin), edge);
            assert_eq!((mesh.origin(twin), mesh.origin(next(twin))), (mesh.origin(next(edge)), mesh.origin(edge)));
        }
        assert!((0..mesh.first.len()).all(|point| mesh.origin(mesh.first[point]) as usize == point));
    }

    /// Points wander; after every repair the mesh is a torus, locally Delaunay, and the one that spade builds from
    /// scratch.
    #[test]
    fn repaired_meshes_are_those_that_are_built_anew() {
        let context = Context::new(1).unwrap();
        for (boundary, width, count) in
            [(Boundary::Periodic, 1.0, 600), (Boundary::Periodic, 3.0, 900), (Boundary::Bounded, 1.5, 300)]
        {
            let (torus, mut places) = random_places(boundary, width, count);
            let mut rng = Rng::at(4, Draw::Probe, &[]);
            context
                .run(None, |job| {
                    let mut mesh = HalfEdgeMesh::new(&delaunay(job, &torus, &places), &torus, &places).unwrap();
                    let mut flipped = 0;
                    for _ in 0..25 {
                        let before = places.clone();
                        let offsets = |point: usize| {
                            let mut ring = Vec::new();
                            let offset = |other: u32| torus.offset_f32(before[point], before[other as usize]);
                            mesh.for_each_neighbour(point, |other| ring.push(offset(other)));
                            ring
                        };
                        wander(&torus, &mut places, count, offsets, &mut rng);
                        let before = triangles(&mesh);
                        assert!(mesh.repair(job, &places)?, "a triangle turned over");
                        flipped += usize::from(before != triangles(&mesh));
                        check_links(&mesh);
                        let edges = (0..4 * mesh.triangles.len() as u32).filter(|edge| edge & 3 < 3);
                        assert!(edges.into_iter().all(|edge| !mesh.must_flip(edge, &places)));
                        // The corners of a mirrored rectangle lie on one circle: there spade may take the other
                        // diagonal.
                        if boundary == Boundary::Periodic {
                            let anew = HalfEdgeMesh::new(&delaunay(job, &torus, &places), &torus, &places).unwrap();
                            assert_eq!(triangles(&mesh), triangles(&anew));
                        }
                    }
                    assert!(flipped > 10);
                    Ok(())
                })
                .unwrap();
        }
    }

    #[test]
    fn few_points_and_large_holes_have_no_mesh_and_turned_triangles_end_one() {
        let context = Context::new(1).unwrap();
        for (torus, mut places, has_mesh) in with_and_without_mesh() {
            context
                .run(None, |job| {
                    let mesh = HalfEdgeMesh::new(&delaunay(job, &torus, &places), &torus, &places);
                    assert_eq!(mesh.is_some(), has_mesh);
                    if let Some(mut mesh) = mesh {
                        places.swap(0, 250);
                        assert!(!mesh.repair(job, &places)?);
                    }
                    Ok(())
                })
                .unwrap();
        }
    }
}
