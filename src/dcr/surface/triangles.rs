//! The triangulation of samples on a surface: what remeshing takes them for (thesis §4.4.4).
//!
//! Each sample finds its Delaunay star in its own tangent plane. A triangle that is in the stars of all three of its corners
//! is one of the mesh; where the surface is bent too much for the samples to agree, there are holes.

use crate::dcr::surface::near::Crowd;
use crate::dcr::surface::sheet::Sheet;
use crate::dcr::surface::view::View;
use crate::dcr::surface::walk::{Flat, Place};
use crate::dcr::surface::{check, hexagonal_distance, place};
use crate::error::Result;
use crate::job::{Context, Progress, chunks_of};
use crate::mesh::Mesh;

/// Neighbours are looked for up to this distance, in spacings: triangles of maximal sets are at most 1.6 wide.
const REACH: f64 = 2.2;

/// The triangles of a set of samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// The numbers of three samples each, counter-clockwise seen from the front of the mesh's triangle under the sample with
    /// the lowest number, which comes first.
    pub triangles: Vec<[u32; 3]>,
    /// The share of the corners of all samples' triangles that are corners of these: 1 where all agree. 1 for no triangle.
    pub agreement: f64,
}

/// Triangulates samples on a mesh, which shall be spread about evenly, as maximal and relaxed sets are: the triangles of their
/// Delaunay stars in which they agree. Those across open borders, and across gaps that are more than twice as wide as samples
/// are apart, are left out. The arguments are those of [`relax`](super::relax). O(n log n).
///
/// # Errors
/// Those of [`relax`](super::relax), and [`Error::Cancelled`](crate::Error::Cancelled).
pub fn triangulate(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Triangulation> {
    check(mesh, triangles, barycentrics)?;
    let sheet = Sheet::new(mesh)?;
    let spacing = hexagonal_distance(mesh, triangles.len());
    let places: Vec<Place> = triangles.iter().zip(barycentrics).map(place).collect();
    let positions: Vec<_> = places.iter().map(|place| mesh.point_exact(place.triangle, place.uv.into())).collect();
    let crowd = Crowd::new(&sheet, &places, &positions, REACH * spacing, 0.0);
    let chunks = chunks_of(places.len(), 512);
    let mut found = context.run(progress, |job| {
        let around = crowd.neighbourhoods(&job.part(0.0, 0.8), chunks, |_| true)?;
        job.part(0.8, 1.0).flat_map(chunks.len(), |chunk| {
            let mut view = View::default();
            let mut found = Vec::new();
            for sample in chunks.range(chunk) {
                let flat = Flat::new(&sheet, places[sample].triangle, spacing);
                view.look(&sheet, &flat, positions[sample], &around[sample].1, &positions);
                found.extend(view.triangles().map(|[a, b]| Corner::new([sample as u32, a, b])));
            }
            found
        })
    })?;
    found.sort_unstable();
    let agreed = found.chunk_by(|a, b| a.sorted == b.sorted).filter(|corners| corners.len() == 3);
    let triangles: Vec<[u32; 3]> = agreed.map(|corners| corners[0].turned).collect();
    let agreement = if found.is_empty() { 1.0 } else { 3.0 * triangles.len() as f64 / found.len() as f64 };
    Ok(Triangulation { triangles, agreement })
}

/// A triangle as it is seen from one of its corners.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Corner {
    sorted: [u32; 3],
    /// Whether it is not the view of the first corner.
    is_other: bool,
    /// The corners counter-clockwise, the lowest number first.
    turned: [u32; 3],
}

impl Corner {
    /// The triangle as its first corner sees it, counter-clockwise.
    fn new(corners: [u32; 3]) -> Self {
        let (mut sorted, mut turned) = (corners, corners);
        sorted.sort_unstable();
        while turned[0] != sorted[0] {
            turned.rotate_left(1);
        }
        Self { sorted, is_other: corners[0] != sorted[0], turned }
    }
}
