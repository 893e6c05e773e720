//! The candidates of a block: the hits of its local projectors, chart by chart.
//!
//! There are two engines, with the same hits in the same order. Triangles are drawn over the plane of their chart row by
//! row (Pineda 1988), as the rasteriser of the global projectors does over its tiles (`raster.rs`). Or rays are traced
//! through the points of the pattern by Embree, which only says on which triangles a hit can be: whether it is one, and
//! its barycentrics, is calculated from the point of the pattern in both cases.

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::psp::fill::Block;
use crate::psp::fragment::Fragment;
use crate::psp::project::Pass;
use crate::psp::project::candidates::rank;
use crate::psp::project::local::charts::{Charts, Facet};
use crate::psp::project::local::projector::{LocalProjector, SeenTriangle};
use crate::psp::project::local::torus::Torus;
use crate::psp::project::rays::TraceSpace;
use crate::psp::set::Sample;
use crate::trace::{Hit, Ray};

/// The least distance of a hit from the edges of its triangle, in diagonals of the mesh's box.
const TOLERANCE: f64 = 1e-6;

/// The distance from a block at which rays start, in diagonals of the mesh's box. In Embree's floats the normal of a triangle
/// with hits, 2 10^-6 diagonals high at least, turns by up to about .1, and what lies far along it seems as much nearer:
/// behind the start of a ray it would be lost.
const START: f64 = 0.5;

/// The share of an edge by which barycentrics that are rounded to floats move a point at most.
const BARYCENTRIC_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

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
struct Plane<'a> {
    pub mesh: &'a Mesh,
    pub torus: &'a Torus,
    pub projector: LocalProjector,
    /// The least distance of a hit from the edges of its triangle, in the unit of the plane.
    pub tolerance: f64,
    pub pieces: &'a [Fragment],
    pub facets: Vec<&'a Facet>,
}

/// A facet on a plane.
struct Seen<'a> {
    triangle: SeenTriangle,
    piece: Option<&'a Fragment>,
}

impl Plane<'_> {
    /// A facet on the plane; `None` if it can have no hit there.
    fn see(&self, facet: &Facet) -> Option<Seen<'_>> {
        let triangle = SeenTriangle::new(facet.corners.map(|corner| self.projector.see(corner)), self.tolerance)?;
        Some(Seen { triangle, piece: facet.piece.map(|piece| &self.pieces[piece as usize]) })
    }

    /// The hits of rays through the points of the pattern, by facet and in the order in which they are drawn, each with
    /// the number of its point; and the number of rays.
    fn trace(&self, space: &TraceSpace, view: &View) -> (Vec<(u32, usize, [f64; 2])>, u64) {
        let mut cells = Vec::new();
        let seen: Vec<_> = self.facets.iter().map(|facet| self.see(facet)).collect();
        for seen in seen.iter().flatten() {
            each_row(seen.outline(), |row, [first, last]| cells.extend((first..=last).map(|column| [row, column])));
        }
        cells.sort_unstable();
        cells.dedup();
        let mut points = Vec::new();
        for [row, column] in cells {
            each_in_row(self.torus, row, [column; 2], |number, point| points.push((number, point)));
        }
        let forward = self.projector.forward();
        let ray = |&(_, point): &(usize, DVec2)| {
            let start = self.projector.lift(point) - view.reach * forward;
            space.ray(view.centre + view.radius * start, forward)
        };
        let (rays, mut hits): (Vec<Ray>, Vec<Hit>) = (points.iter().map(ray).collect(), Vec::new());
        space.all_hits(&rays, &mut hits);
        let mut by_triangle: Vec<_> = self.facets.iter().zip(0..).map(|(facet, n)| (facet.triangle, n)).collect();
        by_triangle.sort_unstable();
        let mut found: Vec<(u32, u32, [f64; 2])> = Vec::new();
        for hit in hits {
            let first = by_triangle.partition_point(|&(triangle, _)| triangle < hit.triangle);
            for &(_, facet) in by_triangle[first..].iter().take_while(|&&(triangle, _)| triangle == hit.triangle) {
                let barycentrics = seen[facet as usize].as_ref().and_then(|seen| seen.hit(points[hit.ray as usize].1));
                found.extend(barycentrics.map(|barycentrics| (facet, hit.ray, barycentrics)));
            }
        }
        found.sort_unstable_by_key(|&(facet, ray, _)| (facet, ray));
        let found = found.into_iter().map(|(facet, ray, barycentrics)| (facet, points[ray as usize].0, barycentrics));
        (found.collect(), rays.len() as u64)
    }
}

impl Seen<'_> {
    /// The corners of the triangle or its piece.
    fn outline(&self) -> [DVec2; 3] {
        self.piece.map_or(self.triangle.corners, |piece| piece.corners.map(|corner| self.triangle.at(corner)))
    }

    /// The barycentrics of a point that hits the triangle, in the piece if it is one.
    #[inline]
    fn hit(&self, point: DVec2) -> Option<[f64; 2]> {
        self.triangle
            .barycentrics(point)
            .filter(|&barycentrics| self.piece.is_none_or(|piece| holds(piece, barycentrics)))
    }
}

/// A block as rays see it.
struct View {
    pub centre: DVec3,
    pub radius: f64,
    /// The distance from the centre at which rays start, in radii: before the block.
    pub reach: f64,
}

impl Candidates {
    /// All candidates of a block: traced if there is a space for rays, otherwise drawn.
    pub fn of(pass: &Pass, block: &Block, radius: f64, tori: &[Torus], space: Option<&TraceSpace>) -> Self {
        let [low, high] = block.extent.corners().map(exact);
        let centre = 0.5 * low + 0.5 * high;
        let charts = Charts::new(pass.mesh, block, centre, 1.0 / radius);
        // Hits are moved by the rounding of their barycentrics and positions.
        let moved = 2.0 * pass.mesh.float_spacing() / radius + charts.longest * BARYCENTRIC_ROUNDING;
        let unit = 1.0 + moved + 1e-9;
        let (box_low, box_high) = pass.mesh.bounds();
        let diagonal = exact(box_low).distance(exact(box_high)) / radius;
        let tolerance = TOLERANCE * diagonal / unit;
        let reach = 0.5 * (high - low).length() / radius + 1.0 + START * diagonal;
        let view = View { centre, radius, reach };
        let traced = space.map(|space| (space, &view));
        let mut candidates = Candidates::default();
        let mut last = vec![NONE; tori.iter().map(Torus::len).max().unwrap_or(0)];
        for (chart, &axis) in charts.axes.iter().enumerate() {
            let [x, y, z] = block.cube.key();
            let place = [pass.iteration.into(), x, y, z, chart as u64];
            let projector = LocalProjector::at(pass.options.seed, &place, axis, 1.0 / unit);
            let plane = Plane {
                mesh: pass.mesh,
                torus: &tori[projector.pattern],
                projector,
                tolerance,
                pieces: &block.items.pieces,
                facets: charts.facets(chart).collect(),
            };
            candidates.add(&plane, chart, &mut last, traced);
        }
        candidates
    }

    /// Adds the hits on the facets of a chart. `last` has the candidate that was found last on each point of the
    /// pattern, or any number.
    fn add(&mut self, plane: &Plane, chart: usize, last: &mut [u32], traced: Option<(&TraceSpace, &View)>) {
        let start = self.all.len() as u32;
        let mut push = |on: &OnFacet, number: usize, barycentrics: [f64; 2]| {
            let sample = Sample::on(&on.corners, on.triangle, round_barycentrics(barycentrics));
            let before = std::mem::replace(&mut last[number], self.all.len() as u32);
            let before = if before != NONE && before >= start { before } else { NONE };
            self.all.push(Candidate { sample, chart: chart as u16, rank: on.rank, before });
        };
        let on = |facet: &Facet| OnFacet {
            triangle: facet.triangle,
            corners: plane.mesh.corners(facet.triangle),
            rank: rank(facet.normal.dot(plane.projector.forward())),
        };
        self.rays += match traced {
            Some((space, view)) => {
                let (hits, rays) = plane.trace(space, view);
                for of_facet in hits.chunk_by(|a, b| a.0 == b.0) {
                    let on = on(plane.facets[of_facet[0].0 as usize]);
                    of_facet.iter().for_each(|&(_, number, barycentrics)| push(&on, number, barycentrics));
                }
                rays
            }
            None => {
                let mut rays = 0;
                for &facet in &plane.facets {
                    let Some(seen) = plane.see(facet) else { continue };
                    let on = on(facet);
                    each_row(seen.outline(), |row, columns| {
                        rays += each_in_row(plane.torus, row, columns, |number, point| {
                            if let Some(barycentrics) = seen.hit(point) {
                                push(&on, number, barycentrics);
                            }
                        });
                    });
                }
                rays
            }
        };
    }
}

/// A facet on which there are hits.
struct OnFacet {
    triangle: u32,
    corners: [[f32; 3]; 3],
    rank: u32,
}

/// True if a piece holds a point of its triangle.
fn holds(piece: &Fragment, point: [f64; 2]) -> bool {
    let ([a, b, c], point) = (piece.corners.map(DVec2::from_array), DVec2::from_array(point));
    let turn = (b - a).perp_dot(c - a);
    [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| (to - from).perp_dot(point - from) * turn >= 0.0)
}

/// Visits the rows of cells that a triangle touches, each with its first and last column.
#[inline(always)]
fn each_row(corners: [DVec2; 3], mut visit: impl FnMut(i32, [i32; 2])) {
    let [a, b, c] = corners;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let width = [floor(low.x), floor(high.x)];
    for row in floor(low.y)..=floor(high.y) {
        let columns = if width[1] - width[0] < 2 {
            width
        } else {
            let [least, most] = between(&corners, f64::from(row));
            [floor(least), floor(most)]
        };
        visit(row, columns);
    }
}

/// Visits the points of the pattern in some cells of a row, with their numbers, and counts them.
#[inline(always)]
fn each_in_row(torus: &Torus, row: i32, columns: [i32; 2], mut visit: impl FnMut(usize, DVec2)) -> u64 {
    let mut count = 0;
    for run in torus.runs(row, columns) {
        let corner = DVec2::from_array(run.corner);
        count += run.points.len() as u64;
        for (number, &[x, y]) in (run.first..).zip(run.points) {
            visit(number, corner + DVec2::new(x.into(), y.into()));
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
            let mut counted = 0;
            each_row(corners, |row, columns| {
                counted += each_in_row(&torus, row, columns, |number, point| {
                    rays += 1;
                    found.push((number, point));
                });
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
