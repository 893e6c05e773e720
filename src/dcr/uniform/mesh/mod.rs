//! The Delaunay triangulation of a torus, kept while its points move and repaired by flips.
//!
//! As long as no triangle turns over, a triangulation stays one, and flipping the edges that are not locally Delaunay, in
//! any order, makes it the Delaunay triangulation again (Lawson 1977). The forces hold points back so that none turns
//! over; if one does all the same, the mesh says so and is to be built anew.
//!
//! Which edges may have to be flipped shows while points gather, so flips cost no look at the whole mesh: see
//! [`Mesh::mend`].

use std::array::from_fn;
use std::ops::Range;

use glam::DVec2;

use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::torus::{Place, Torus};
use crate::dcr::uniform::rings::{Patch, Rings, Stars};
use crate::dcr::uniform::stars::{Felt, LANES, Visit, feel};
use crate::dcr::uniform::tiles;
use crate::error::Result;
use crate::geometry::delaunay::Delaunay;
use crate::job::{Job, chunks};
use crate::simd::Level;

/// The sum of two cotangents that counts as negative: below the rounding of `f64`, flips could go on for ever.
const NEGATIVE: f64 = -1e-7;

/// So many points that follow each other make a patch, in which flips are made while others are made elsewhere.
const PATCH: usize = 4096;

/// An edge, from point to point.
pub(super) type Edge = [u32; 2];

/// A triangulation of a torus, all of whose edges are short.
pub(super) struct Mesh {
    torus: Torus,
    rings: Rings,
}

/// What is left of the edges of a patch.
struct Mended {
    /// Those that may have to be flipped, with points of other patches.
    left: Vec<Edge>,
    is_sound: bool,
}

/// What a look at all points finds.
#[derive(Default)]
struct Found {
    suspects: Vec<Edge>,
    is_unsound: bool,
    violated: usize,
}

impl Visit for Found {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, felt: &Felt) {
        self.is_unsound |= !felt.are_sound(points.len());
        self.violated += felt.violated(points.len()).count();
        felt.suspects(rings, points, &mut self.suspects);
    }
}

impl Mesh {
    /// The Delaunay triangulation of places. None in sets of a few points or with large holes or with points that have
    /// too many neighbours, or if copies are not triangulated alike, which happens to four points on one circle unless
    /// they are nudged.
    pub(super) fn new(job: &Job, torus: &Torus, places: &[Place]) -> Result<Option<Self>> {
        match tiles::triangulate(&job.part(0.0, 0.8), torus, places)? {
            Some(stars) => Self::of_stars(&job.part(0.8, 1.0), torus, places, &stars),
            None => {
                let delaunay = Delaunay::new(&job.part(0.0, 0.8), &torus.frame, torus.nudged(places).into_iter())?;
                Self::of_delaunay(&job.part(0.8, 1.0), torus, places, &delaunay)
            }
        }
    }

    /// The mesh of a triangulation of the torus with its copies.
    pub(super) fn of_delaunay(job: &Job, torus: &Torus, places: &[Place], delaunay: &Delaunay) -> Result<Option<Self>> {
        let mut stars = Stars::default();
        for point in 0..places.len() {
            stars.neighbours.extend(delaunay.neighbours(point));
            stars.points.push((point as u32, stars.neighbours.len()));
        }
        Self::of_stars(job, torus, places, &[stars])
    }

    /// The mesh of rings, if they are those of a triangulation of the torus.
    fn of_stars(job: &Job, torus: &Torus, places: &[Place], stars: &[Stars]) -> Result<Option<Self>> {
        let Some(rings) = Rings::new(places.len(), stars) else { return Ok(None) };
        let mut mesh = Self { torus: *torus, rings };
        let chunks = chunks(places.len());
        let agree =
            job.part(0.0, 0.5).map(chunks.len(), |chunk| chunks.range(chunk).all(|point| mesh.rings.agree(point)))?;
        // Triangles that agree make a surface without border; with three edges to a point it is a torus.
        let is_torus = agree.into_iter().all(|agree| agree) && mesh.rings.edges() == 3 * places.len();
        Ok((is_torus && mesh.repair(&job.part(0.5, 1.0), places)?).then_some(mesh))
    }

    /// Tells `visit` what each of a range of points feels.
    #[inline(always)]
    pub(super) fn feel_portable(
        &self,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        visit: &mut impl Visit,
    ) {
        for first in points.clone().step_by(LANES) {
            let eight = first..points.end.min(first + LANES);
            let lanes = from_fn(|lane| (first + lane).min(points.end - 1));
            visit.visit(&self.rings, eight, &feel(&self.rings, &self.torus, places, lanes, constraints));
        }
    }

    /// Makes the mesh the Delaunay triangulation of the places; false if a triangle has turned over.
    pub(super) fn repair(&mut self, job: &Job, places: &[Place]) -> Result<bool> {
        let found = self.look(&job.part(0.0, 0.5), places, places.len())?;
        Ok(!found.is_unsound && self.mend(&job.part(0.5, 1.0), places, found.suspects)?)
    }

    /// How many of the first `count` points have their constraints violated.
    pub(super) fn violated(&self, job: &Job, places: &[Place], count: usize) -> Result<usize> {
        Ok(self.look(job, places, count)?.violated)
    }

    /// Looks at the first `count` points.
    fn look(&self, job: &Job, places: &[Place], count: usize) -> Result<Found> {
        let chunks = chunks(count);
        let vectors = Level::widest();
        let still = Constraints { conflict_radius: 0.0, coverage_radius: f32::INFINITY, push: 0.0, pull: 0.0 };
        let parts = job.map(chunks.len(), |chunk| {
            let mut found = Found::default();
            self.feel(vectors, places, &still, chunks.range(chunk), &mut found);
            found
        })?;
        let mut all = Found::default();
        for part in parts {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.violated += part.violated;
        }
        Ok(all)
    }

    /// Flips edges that must be, and those around them, until all are locally Delaunay; false if one could not be flipped.
    ///
    /// Given the edges that were suspect before the points moved, it leaves those for the next time that were far from
    /// being flipped and yet must be. `suspects` are in the order of the points that they start from.
    pub(super) fn mend(&mut self, job: &Job, places: &[Place], suspects: Vec<Edge>) -> Result<bool> {
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
    pub(super) fn coverage(&self, job: &Job, places: &[Place]) -> Result<f64> {
        let chunks = chunks(self.rings.len());
        let largest = job.map(chunks.len(), |chunk| {
            let squared = |point: usize| {
                let ring = self.rings.ring(point);
                let way = |other: u32| self.torus.offset(places[point], places[other as usize]);
                let triangle = |(&q, &r): (&u32, &u32)| {
                    let (a, b) = (way(q), way(r));
                    let lengths = a.length_squared() * b.length_squared() * (a - b).length_squared();
                    lengths / (4.0 * a.perp_dot(b).powi(2))
                };
                ring.iter().zip(ring.iter().cycle().skip(1)).map(triangle).fold(0.0, f64::max)
            };
            chunks.range(chunk).map(squared).fold(0.0, f64::max)
        })?;
        Ok(largest.into_iter().fold(0.0, f64::max).sqrt())
    }
}

/// Flips those of the edges that must be, and those around them, as long as their points are in the patch.
fn mend(patch: &mut Patch, torus: &Torus, places: &[Place], mut edges: Vec<Edge>) -> Mended {
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

/// Whether the angles that face the edge from `p` to `q`, at `r` and at `s`, sum up to more than 180 degrees: the sum of
/// their cotangents is negative.
fn must_flip(torus: &Torus, [p, q, r, s]: [Place; 4]) -> bool {
    let angle = |apex: Place, from: Place, to: Place| -> [f64; 2] {
        let (from, to): (DVec2, DVec2) = (torus.offset(apex, from), torus.offset(apex, to));
        [from.dot(to), from.perp_dot(to)]
    };
    let ([cos_r, sin_r], [cos_s, sin_s]) = (angle(r, p, q), angle(s, q, p));
    cos_r * sin_s + cos_s * sin_r < NEGATIVE * sin_r * sin_s
}

#[cfg(test)]
mod tests;
