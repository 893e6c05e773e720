//! The first triangulation of large sets, tile by tile.
//!
//! Each tile of the torus is triangulated with the points in a margin around it. The star of a point is that of the
//! whole set if the circumcircles of its triangles lie where all points are known; if one does not, there is no result,
//! and the set must be triangulated as a whole.

use glam::DVec2;
use spade::handles::VertexHandle;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::dcr::ground::torus::{Torus, TorusPoint, nudge};
use crate::dcr::uniform::rings::RingList;
use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;

/// The least number of points of a tile on average; it can be four times as high.
const POINTS: usize = 2000;

/// The margin, in spacings: slightly more than the diameter of the largest empty circle of a million random points.
const MARGIN: f64 = 4.0;

/// A point in a tile or its margin.
#[derive(Clone, Copy)]
struct Vertex {
    /// From the lower corner of the tile, in spacings.
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
pub(super) fn triangulate(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Result<Option<Vec<RingList>>> {
    let level = (places.len() / POINTS).max(1).ilog2() / 2;
    let narrow = torus.frame.size().min_element() / f64::from(1u32 << level) < 2.0 * MARGIN;
    // With three tiles along an axis, those on both sides of one are different.
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
