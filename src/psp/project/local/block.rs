//! The candidates of a block: the hits of its local projectors, chart by chart.
//!
//! Triangles are drawn over the plane of their chart row by row (Pineda 1988), as the rasteriser of the global projectors
//! does over its tiles (`raster.rs`).

use glam::DVec2;

use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::fragment::Fragment;
use crate::psp::project::candidates::rank;
use crate::psp::project::local::charts::Charts;
use crate::psp::project::local::projector::{LocalProjector, SeenTriangle};
use crate::psp::project::local::torus::Torus;
use crate::psp::set::Sample;

/// No candidate.
pub const NONE: u32 = u32::MAX;

/// A hit of a local projector.
#[derive(Clone, Copy)]
pub struct Candidate {
    pub sample: Sample,
    pub chart: u16,
    /// The lowest comes first: how far its facet is from being faced squarely.
    pub rank: u32,
    /// The candidate before it on the same ray.
    pub before: u32,
}

/// The candidates of a block in their order: by chart, by facet, by row.
#[derive(Default)]
pub struct Candidates {
    pub all: Vec<Candidate>,
    /// The points of the pattern that were compared with triangles.
    pub rays: u64,
}

/// A chart on its plane.
pub struct Plane<'a> {
    pub mesh: &'a Mesh,
    pub torus: &'a Torus,
    pub projector: LocalProjector,
    /// The least distance of a hit from the edges of its triangle, in the unit of the plane.
    pub tolerance: f64,
    pub pieces: &'a [Fragment],
}

impl Candidates {
    /// Adds the hits on the facets of a chart. `last` has the candidate that was found last on each point of the
    /// pattern, or any number.
    pub fn draw(&mut self, plane: &Plane, charts: &Charts, chart: usize, last: &mut [u32]) {
        let start = self.all.len() as u32;
        for facet in charts.facets(chart) {
            let Some(seen) =
                SeenTriangle::new(facet.corners.map(|corner| plane.projector.see(corner)), plane.tolerance)
            else {
                continue;
            };
            let corners = plane.mesh.corners(facet.triangle);
            let rank = rank(facet.normal.dot(charts.axes[chart]));
            let piece = facet.piece.map(|piece| &plane.pieces[piece as usize]);
            let outline = piece.map_or(seen.corners, |piece| piece.corners.map(|corner| seen.at(corner)));
            let rays = each_point(plane.torus, outline, |number, point| {
                let Some(barycentrics) = seen.barycentrics(point) else { return };
                if piece.is_some_and(|piece| !holds(piece, barycentrics)) {
                    return;
                }
                let sample = Sample::on(&corners, facet.triangle, round_barycentrics(barycentrics));
                let before = std::mem::replace(&mut last[number], self.all.len() as u32);
                let is_before = before != NONE && before >= start;
                let before = if is_before { before } else { NONE };
                self.all.push(Candidate { sample, chart: chart as u16, rank, before });
            });
            self.rays += rays;
        }
    }
}

/// True if a piece holds a point of its triangle.
fn holds(piece: &Fragment, point: [f64; 2]) -> bool {
    let ([a, b, c], point) = (piece.corners.map(DVec2::from_array), DVec2::from_array(point));
    let turn = (b - a).perp_dot(c - a);
    [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| (to - from).perp_dot(point - from) * turn >= 0.0)
}

/// Visits the points of the pattern in the cells that a triangle touches, with their numbers, and counts them.
#[inline(always)]
fn each_point(torus: &Torus, corners: [DVec2; 3], mut visit: impl FnMut(usize, DVec2)) -> u64 {
    let [a, b, c] = corners;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let width = [floor(low.x), floor(high.x)];
    let mut count = 0;
    for row in floor(low.y)..=floor(high.y) {
        let columns = if width[1] - width[0] < 2 {
            width
        } else {
            let [least, most] = between(&corners, f64::from(row));
            [floor(least), floor(most)]
        };
        for run in torus.runs(row, columns) {
            let corner = DVec2::from_array(run.corner);
            count += run.points.len() as u64;
            for (number, &[x, y]) in (run.first..).zip(run.points) {
                visit(number, corner + DVec2::new(x.into(), y.into()));
            }
        }
    }
    count
}

/// The largest integer not above a number.
fn floor(x: f64) -> i32 {
    x.floor() as i32
}

/// The least and the largest x of the part of a triangle in a row of cells, which is not empty.
#[inline]
fn between(corners: &[DVec2; 3], row: f64) -> [f64; 2] {
    let (low, high) = (row, row + 1.0);
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
    let mut add = |x: f64| extent = [extent[0].min(x), extent[1].max(x)];
    for i in 0..3 {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        if from.y >= low && from.y <= high {
            add(from.x);
        }
        for y in [low, high] {
            if (from.y < y) != (to.y < y) {
                add(from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y)));
            }
        }
    }
    extent
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    #[test]
    fn all_points_in_a_triangle_are_visited_once() {
        let torus = Context::new(1).unwrap().run(None, |job| Torus::new(job, 1)).unwrap();
        let all = || (-300..300).flat_map(|row| torus.runs(row, [-300, 299]).collect::<Vec<_>>());
        let points = all().flat_map(|run| {
            let corner = DVec2::from_array(run.corner);
            (run.first..)
                .zip(run.points)
                .map(move |(number, &[x, y])| (number, corner + DVec2::new(x.into(), y.into())))
        });
        let points: Vec<_> = points.collect();
        let (mut rng, mut count) = (Rng::at(1, Draw::Probe, &[]), 0);
        for round in 0..300 {
            let size = [0.7, 4.0, 60.0][round % 3];
            let mut place = |size: f64| size * DVec2::new(rng.unit() - 0.5, rng.unit() - 0.5);
            let around = place(400.0);
            let mut corners = [(); 3].map(|()| around + place(size));
            if round % 5 == 0 {
                // Edges along the rows and columns of cells.
                corners = corners.map(DVec2::round);
            }
            let Some(seen) = SeenTriangle::new(corners, 0.0) else { continue };
            let is_hit = |&(_, point): &(usize, DVec2)| seen.barycentrics(point).is_some();
            let (mut found, mut rays) = (Vec::new(), 0);
            let counted = each_point(&torus, corners, |number, point| {
                rays += 1;
                found.push((number, point));
            });
            assert_eq!(counted, rays);
            found.retain(is_hit);
            let mut expected: Vec<_> = points.iter().copied().filter(is_hit).collect();
            let key = |a: &(usize, DVec2), b: &(usize, DVec2)| {
                a.0.cmp(&b.0).then(a.1.x.total_cmp(&b.1.x)).then(a.1.y.total_cmp(&b.1.y))
            };
            found.sort_by(key);
            expected.sort_by(key);
            assert_eq!(found, expected);
            count += found.len();
        }
        assert!(count > 10_000, "{count}");
    }

    #[test]
    fn pieces_share_the_points_of_their_triangle() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let whole = Fragment::whole(0);
        let pieces: Vec<_> = whole.parts(5).collect();
        for _ in 0..10_000 {
            let point = rng.in_triangle();
            assert_eq!(pieces.iter().filter(|piece| holds(piece, point)).count(), 1);
        }
    }
}
