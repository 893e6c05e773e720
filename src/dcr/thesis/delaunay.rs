//! The Delaunay neighbourhood (thesis §4.3.3).

use glam::DVec2;

use crate::dcr::thesis::links::{Link, Links};
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::geometry::Frame;
use crate::job::Job;
use crate::points::Boundary;

/// The links between Delaunay neighbours.
pub(super) struct DelaunayLinks {
    delaunay: Delaunay,
    boundary: Boundary,
}

impl DelaunayLinks {
    /// Triangulates the points of a frame, in O(n log n).
    pub(super) fn new(job: &Job, frame: &Frame, positions: impl Iterator<Item = DVec2> + Clone) -> Result<Self> {
        Ok(Self { delaunay: Delaunay::new(job, frame, positions)?, boundary: frame.boundary() })
    }
}

impl Links for DelaunayLinks {
    /// On a bounded domain a point is linked across the boundary to its own mirror image only: an edge to the image of
    /// another point would cross the mirrored edge, so it is but an arbitrary diagonal of a symmetric cell.
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        for (site, offset) in self.delaunay.star(point) {
            let is_mirrored = self.boundary == Boundary::Bounded && !site.is_original();
            let is_own_image = site.source as usize == point && site.side.contains(&0);
            if !is_mirrored || is_own_image {
                visit(Link { other: site.source, offset, outgoing: true, incoming: true });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::points::Domain;
    use crate::rng::{Draw, Rng};

    /// On a mirrored square there are links to own images, and none to those of other points.
    #[test]
    fn links_are_mutual_and_cross_the_boundary_to_own_images_only() {
        let frame = Frame::new(Domain::unit(Boundary::Bounded), 200);
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let points: Vec<_> = (0..200).map(|_| frame.size() * DVec2::new(rng.unit(), rng.unit())).collect();
        let links = |job: &Job| DelaunayLinks::new(job, &frame, points.iter().copied());
        let links = Context::new(1).unwrap().run(None, links).unwrap();
        let (mut inside, mut own) = (Vec::new(), 0);
        for (point, &position) in points.iter().enumerate() {
            links.for_each(point, |link| {
                if link.other as usize == point {
                    let image = position + link.offset;
                    assert!(image.cmplt(DVec2::ZERO).any() || image.cmpgt(frame.size()).any());
                    own += 1;
                } else {
                    assert!((points[link.other as usize] - position).distance(link.offset) < 1e-9);
                    inside.push((point as u32, link.other));
                }
            });
        }
        assert!(own > 20 && inside.iter().all(|&(from, to)| inside.contains(&(to, from))));
    }
}
