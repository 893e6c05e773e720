//! The figures of a set of the plane, measured together: its points are triangulated once for all figures that need it.

use crate::analysis::BYTES_PER_TRIANGULATED_POINT;
use crate::analysis::bonds::mean_order;
use crate::analysis::coverage::covering_radius;
use crate::analysis::spacing::nearest_distances;
use crate::analysis::triangles::{TriangleStatistics, triangles_of};
use crate::error::Result;
use crate::geometry::{Delaunay, Frame};
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::points::Domain;

/// The figures of a set of the plane.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Figures {
    /// The distance of each point to its nearest neighbour, as
    /// [`nearest_distances_2d`](super::spacing::nearest_distances_2d) gives them;
    /// [`spacing_2d`](super::spacing::spacing_2d) sums them up.
    pub nearest: Vec<f64>,
    /// The covering radius, as [`covering_radius_2d`](super::coverage::covering_radius_2d) finds it.
    pub covering_radius: f64,
    /// The [bond order](super::bonds::bond_order) ψ6.
    pub bond_order: f64,
    /// The statistics of the Delaunay triangles, as of [`triangle_statistics`](super::triangles::triangle_statistics).
    pub triangles: TriangleStatistics,
}

/// Measures a set of the plane. Takes O(n log n) for sets without large clusters.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain and for points outside it (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn figures_2d(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Figures> {
    domain.check_set(points)?;
    memory::require_points("positions", points.len(), BYTES_PER_TRIANGULATED_POINT)?;
    context.run(progress, |job| {
        let nearest = nearest_distances(&job.part(0.0, 0.1), domain, points)?;
        let covering_radius = covering_radius(&job.part(0.1, 0.5), domain, points)?;
        let (bond_order, triangles) = match points {
            [] => Default::default(),
            _ => order_and_triangles(&job.part(0.5, 1.0), domain, points)?,
        };
        Ok(Figures { nearest, covering_radius, bond_order, triangles })
    })
}

fn order_and_triangles(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<(f64, TriangleStatistics)> {
    let frame = Frame::new(*domain, points.len());
    let positions = frame.enter(points);
    let delaunay = Delaunay::new(&job.part(0.0, 0.7), &frame, positions.iter().copied())?;
    let order = mean_order(&job.part(0.7, 0.8), &delaunay)?;
    let triangles = triangles_of(&job.part(0.8, 0.9), domain, &frame, &positions, &delaunay)?;
    Ok((order, TriangleStatistics::shared(&job.part(0.9, 1.0), &triangles)?))
}
