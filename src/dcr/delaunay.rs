//! The Delaunay neighbourhood (thesis §4.3.3) of a torus or of a bounded rectangle.
//!
//! The triangulation itself is spade's. It knows no torus and no mirror, so it is given the points and their copies
//! in a margin around the domain (thesis §4.4.1 and Fig. 4.12 (b)), which the thesis takes for sufficient. Here it is
//! verified: the star of a point is that of the endless pattern when the circumcircles of its triangles lie where all
//! copies are known. If one does not, the margin is doubled.
//!
//! One whole ring of copies is always enough. Let an empty circle touch a point p of the domain and another site q.
//! Were q more than a period away along an axis, the chord of the circle through p or the one through q would be
//! longer than a period and contain another copy of its point. On mirrored domains the mirror images take that part.

use glam::DVec2;
use spade::handles::{FixedVertexHandle, VertexHandle};
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::frame::{Frame, Site};
use super::links::{Link, Links};
use crate::error::Result;
use crate::job::{Job, chunks};
use crate::points::Boundary;

/// The first margin, in spacings: a little more than the largest empty circle of a million random points is wide.
const MARGIN: f64 = 4.0;

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        // spade refuses coordinates below 2^-142.
        spade::mitigate_underflow(Point2::new(self.position.x, self.position.y))
    }
}

type Star<'a> = VertexHandle<'a, Site>;

/// The triangulation of the points and of enough of their copies.
pub(crate) struct Delaunay {
    triangulation: DelaunayTriangulation<Site>,
    boundary: Boundary,
    /// The vertex of each point; none for a point that coincides with another.
    vertices: Vec<Option<FixedVertexHandle>>,
}

impl Delaunay {
    /// Triangulates in O(n log n); every original vertex has the star that it has among all copies.
    pub(crate) fn new(job: &Job, frame: &Frame, positions: impl Iterator<Item = DVec2> + Clone) -> Result<Self> {
        let mut margin = MARGIN;
        loop {
            let delaunay = Self::within_margin(frame, positions.clone(), margin);
            if delaunay.is_enclosed(job, frame, margin)? {
                return Ok(delaunay);
            }
            margin *= 2.0;
        }
    }

    fn within_margin(frame: &Frame, positions: impl Iterator<Item = DVec2> + Clone, margin: f64) -> Self {
        let count = positions.clone().count();
        let triangulation = DelaunayTriangulation::bulk_load(frame.sites(positions, margin))
            .expect("sites are finite and neither too large nor too small for spade");
        let mut vertices = vec![None; count];
        for vertex in triangulation.vertices().filter(|vertex| vertex.data().is_original()) {
            vertices[vertex.data().source as usize] = Some(vertex.fix());
        }
        Self { triangulation, boundary: frame.boundary(), vertices }
    }

    /// Whether the circumcircles of all triangles at original vertices lie where all copies are known.
    fn is_enclosed(&self, job: &Job, frame: &Frame, margin: f64) -> Result<bool> {
        // Along an axis with a whole ring of copies there is nothing to fear.
        let reach = frame.size().map(|length| if margin < length { margin } else { f64::INFINITY });
        let knows = |(centre, radius): (DVec2, f64)| {
            (centre - radius).cmpge(-reach).all() && (centre + radius).cmple(frame.size() + reach).all()
        };
        let star_is_enclosed = |vertex: Star| {
            vertex.out_edges().all(|edge| {
                edge.face().as_inner().is_some_and(|face| {
                    let (centre, radius_squared) = face.circumcircle();
                    knows((DVec2::new(centre.x, centre.y), radius_squared.sqrt()))
                })
            })
        };
        if reach == DVec2::INFINITY {
            return Ok(true);
        }
        let chunks = chunks(self.vertices.len());
        let enclosed = job.map(chunks.len(), |chunk| {
            chunks.range(chunk).filter_map(|point| self.vertex(point)).all(star_is_enclosed)
        })?;
        Ok(enclosed.into_iter().all(|enclosed| enclosed))
    }

    fn vertex(&self, point: usize) -> Option<Star<'_>> {
        self.vertices[point].map(|vertex| self.triangulation.vertex(vertex))
    }

    /// The triangles that touch a point of the domain.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [Site; 3]> {
        self.triangulation
            .inner_faces()
            .map(|face| face.vertices().map(|vertex| *vertex.data()))
            .filter(|corners| corners.iter().any(Site::is_original))
    }
}

impl Links for Delaunay {
    /// On a bounded domain a point is linked across the border to its own mirror image only: an edge to the image of
    /// another point would cross the mirrored edge, so it is but an arbitrary diagonal of a symmetric cell.
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        let Some(star) = self.vertex(point) else { return };
        for edge in star.out_edges() {
            let neighbour = edge.to();
            let neighbour = neighbour.data();
            let mirrored = self.boundary == Boundary::Bounded && !neighbour.is_original();
            let straight = neighbour.source as usize == point && neighbour.side.contains(&0);
            if !mirrored || straight {
                let offset = neighbour.position - star.data().position;
                visit(Link { other: neighbour.source, offset, outgoing: true, incoming: true });
            }
        }
    }
}
