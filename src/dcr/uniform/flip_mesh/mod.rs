//! The Delaunay triangulation of a torus, kept while its points move and repaired by flips (`ground/flips.rs`), in
//! rings.
//!
//! The forces hold points back so that no triangle turns over; if one does all the same, the mesh says so and must be
//! built anew. The edges that may have to be flipped are found while points gather, so that flips need no pass over the
//! whole mesh: see [`FlipMesh::mend`].

use std::ops::Range;

use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::flips::must_flip;
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::uniform::rings::{Patch, RingList, Rings};
use crate::dcr::uniform::stars::{Gathered, Stars, Visitor};
use crate::dcr::uniform::tiles;
use crate::dcr::uniform::vectors::gather_in_stars;
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::geometry::circumradius_squared;
use crate::job::{Job, chunks};
use crate::simd::Level;

/// The number of consecutive points that form a patch. Flips in different patches are made in parallel.
const PATCH: usize = 4096;

/// An edge, from point to point.
pub(super) type Edge = [u32; 2];

/// A triangulation of a torus, all of whose edges are short.
pub(super) struct FlipMesh {
    torus: Torus,
    rings: Rings,
}

/// The result of flipping the edges of a patch.
struct Mended {
    /// Edges that may have to be flipped, with points of other patches.
    left: Vec<Edge>,
    is_sound: bool,
}

/// The result of a pass over all points that moves none.
#[derive(Default)]
struct Inspection {
    suspects: Vec<Edge>,
    is_unsound: bool,
    violated: usize,
}

impl Visitor for Inspection {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, gathered: &Gathered) {
        self.is_unsound |= !gathered.are_sound(points.len());
        self.violated += gathered.violated(points.len()).count();
        gathered.suspects(rings, points, &mut self.suspects);
    }
}

impl FlipMesh {
    /// The Delaunay triangulation of points. None in sets of a few points or with large holes or with points that have
    /// too many neighbours, or if copies are not triangulated alike, which happens to four points on one circle unless
    /// they are nudged.
    pub(super) fn new(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Result<Option<Self>> {
        match tiles::triangulate(&job.part(0.0, 0.8), torus, places)? {
            Some(stars) => Self::of_stars(&job.part(0.8, 1.0), torus, places, &stars),
            None => {
                let delaunay = Delaunay::new(&job.part(0.0, 0.8), &torus.frame, torus.nudged(places).into_iter())?;
                Self::of_delaunay(&job.part(0.8, 1.0), torus, places, &delaunay)
            }
        }
    }

    /// The mesh of a triangulation of the torus and its copies.
    pub(super) fn of_delaunay(
        job: &Job,
        torus: &Torus,
        places: &[TorusPoint],
        delaunay: &Delaunay,
    ) -> Result<Option<Self>> {
        let mut stars = RingList::default();
        for point in 0..places.len() {
            stars.neighbours.extend(delaunay.neighbours(point));
            stars.points.push((point as u32, stars.neighbours.len()));
        }
        Self::of_stars(job, torus, places, &[stars])
    }

    /// The mesh of rings, if they are those of a triangulation of the torus.
    fn of_stars(job: &Job, torus: &Torus, places: &[TorusPoint], stars: &[RingList]) -> Result<Option<Self>> {
        let Some(rings) = Rings::new(places.len(), stars) else { return Ok(None) };
        let mut mesh = Self { torus: *torus, rings };
        let chunks = chunks(places.len());
        let agree =
            job.part(0.0, 0.5).map(chunks.len(), |chunk| chunks.range(chunk).all(|point| mesh.rings.agree(point)))?;
        // Triangles that agree form a surface without boundary; with three edges per point it is a torus.
        let is_torus = agree.into_iter().all(|agree| agree) && mesh.rings.edges() == 3 * places.len();
        Ok((is_torus && mesh.repair(&job.part(0.5, 1.0), places)?).then_some(mesh))
    }

    /// Gathers for a range of points and passes the results to `visitor`.
    pub(super) fn gather(
        &self,
        level: Level,
        places: &[TorusPoint],
        constraints: &Constraints,
        points: Range<usize>,
        visitor: &mut impl Visitor,
    ) {
        let stars = Stars { rings: &self.rings, torus: &self.torus, places, constraints };
        gather_in_stars(level, &stars, points, visitor);
    }

    /// Makes the mesh the Delaunay triangulation of these points; false if a triangle has turned over.
    pub(super) fn repair(&mut self, job: &Job, places: &[TorusPoint]) -> Result<bool> {
        let found = self.inspect(&job.part(0.0, 0.5), places, places.len())?;
        Ok(!found.is_unsound && self.mend(&job.part(0.5, 1.0), places, found.suspects)?)
    }

    /// How many of the first `count` points have their constraints violated.
    pub(super) fn violated(&self, job: &Job, places: &[TorusPoint], count: usize) -> Result<usize> {
        Ok(self.inspect(job, places, count)?.violated)
    }

    /// Inspects the first `count` points.
    fn inspect(&self, job: &Job, places: &[TorusPoint], count: usize) -> Result<Inspection> {
        let chunks = chunks(count);
        let level = Level::widest();
        let still = Constraints { conflict_radius: 0.0, coverage_radius: f32::INFINITY, push: 0.0, pull: 0.0 };
        let parts = job.map(chunks.len(), |chunk| {
            let mut found = Inspection::default();
            self.gather(level, places, &still, chunks.range(chunk), &mut found);
            found
        })?;
        let mut all = Inspection::default();
        for part in parts {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.violated += part.violated;
        }
        Ok(all)
    }

    /// Flips edges that must be, and those around them, until all are locally Delaunay; false if one could not be
    /// flipped.
    ///
    /// `suspects` are those of before the points moved, ordered by the points at which they start. An edge that was not
    /// suspect then and must be flipped now is left for the next step.
    pub(super) fn mend(&mut self, job: &Job, places: &[TorusPoint], suspects: Vec<Edge>) -> Result<bool> {
        let torus = self.torus;
        let mut rest = suspects.as_slice();
        let tasks = self.rings.patches(PATCH).map(|patch| {
            let count = rest.partition_point(|&[from, _]| (from as usize) < patch.end());
            let (own, others) = rest.split_at(count);
            rest = others;
            (patch, own.to_vec())
        });
        let tasks: Vec<_> = tasks.collect();
        let mended =
            job.part(0.0, 0.7).map_each(tasks, |(mut patch, edges)| mend(&mut patch, &torus, places, edges))?;
        let mut is_sound = mended.iter().all(|mended| mended.is_sound);
        let left = mended.into_iter().flat_map(|mended| mended.left).collect();
        let whole = self.rings.patches(places.len()).next();
        if let Some(mut whole) = whole {
            is_sound &= mend(&mut whole, &torus, places, left).is_sound;
        }
        Ok(is_sound)
    }

    /// The largest circumradius.
    pub(super) fn coverage(&self, job: &Job, places: &[TorusPoint]) -> Result<f64> {
        let chunks = chunks(self.rings.len());
        let largest = job.map(chunks.len(), |chunk| {
            let squared = |point: usize| {
                let ring = self.rings.ring(point);
                let offset = |other: u32| self.torus.offset(places[point], places[other as usize]);
                let triangle = |(&q, &r): (&u32, &u32)| {
                    let (a, b) = (offset(q), offset(r));
                    circumradius_squared(a, b, a - b)
                };
                ring.iter().zip(ring.iter().cycle().skip(1)).map(triangle).fold(0.0, f64::max)
            };
            chunks.range(chunk).map(squared).fold(0.0, f64::max)
        })?;
        Ok(largest.into_iter().fold(0.0, f64::max).sqrt())
    }
}

/// Flips the edges that must be, and those around them, if their points are in the patch.
fn mend(patch: &mut Patch, torus: &Torus, places: &[TorusPoint], mut edges: Vec<Edge>) -> Mended {
    let mut left = Vec::new();
    while let Some(edge) = edges.pop() {
        let [p, q] = edge;
        if !patch.holds(p) {
            left.push(edge);
            continue;
        }
        let Some([r, s]) = patch.apices(edge) else { continue };
        if !must_flip(torus, [p, q, r, s].map(|point| places[point as usize])) {
            continue;
        }
        if ![q, r, s].into_iter().all(|point| patch.holds(point)) {
            left.push(edge);
            continue;
        }
        if patch.flip(edge, [r, s]).is_err() {
            return Mended { left, is_sound: false };
        }
        edges.extend([[p, r], [r, q], [q, s], [s, p]]);
    }
    Mended { left, is_sound: true }
}

#[cfg(test)]
mod tests;
