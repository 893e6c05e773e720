//! The triangulation of relaxed samples on a surface, for remeshing (thesis §4.4.4).
//!
//! Each sample finds its Delaunay star in its own tangent plane. A triangle that is in the stars of all three of its
//! corners is one of the mesh; where the surface is bent too much for the samples to agree, there are holes.

use glam::Vec3;

use crate::dcr::surface::cells::Cells;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::lists::List;
use crate::dcr::surface::local::Local;
use crate::dcr::surface::near::{Finds, SampleSearch};
use crate::dcr::surface::patches::Patches;
use crate::dcr::surface::samples::{check, enter, hexagonal_distance};
use crate::dcr::surface::view::View;
use crate::error::Result;
use crate::job::{Context, Progress, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::simd::{Portable, Position};

/// The distance up to which neighbours are searched, in spacings: triangles of maximal sets are at most 1.6 wide.
const REACH: f64 = 2.2;

/// The triangles of a set of samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// The numbers of three samples each, counter-clockwise as seen from the front of the mesh's triangle under the
    /// sample with the lowest number, which comes first.
    pub triangles: Vec<[u32; 3]>,
    /// The fraction of the corners of all samples' triangles that are corners of these: 1 where all agree. 1 for no
    /// triangle.
    pub agreement: f64,
}

/// Triangulates samples on a mesh that are spread about evenly, as maximal and relaxed sets are: the triangles of their
/// Delaunay stars on which they agree. Those across open boundaries, and across gaps wider than twice the distance of
/// samples, are left out. The arguments are those of [`relax`](fn@super::relax). O(n log n).
///
/// # Errors
/// Those of [`relax`](fn@super::relax), and [`Error::Cancelled`](crate::Error::Cancelled).
pub fn triangulate(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Triangulation> {
    let found = found_corners(context, mesh, triangles, barycentrics, progress)?;
    let agreed = found.chunk_by(|a, b| a.sorted == b.sorted).filter(|corners| corners.len() == 3);
    let triangles: Vec<[u32; 3]> = agreed.map(|corners| corners[0].turned).collect();
    let agreement = if found.is_empty() { 1.0 } else { 3.0 * triangles.len() as f64 / found.len() as f64 };
    Ok(Triangulation { triangles, agreement })
}

/// The triangles of all stars, each as often as it has corners that found it, one after the other.
pub(super) fn found_corners(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Vec<Corner>> {
    check(mesh, triangles, barycentrics)?;
    let connected = ConnectedMesh::new(mesh)?;
    let spacing = hexagonal_distance(mesh, triangles.len());
    let places = enter(triangles, barycentrics);
    let positions: Vec<Position> = places.iter().map(|place| place.rounded(mesh)).collect();
    let patches = context.run(None, |job| Patches::new(job, &connected, spacing))?;
    let side = SampleSearch::cell_side(spacing, REACH, 0.0);
    let cells = Cells::new(exact(mesh.bounds().0), side, positions.iter().map(|&[x, y, z, _]| Vec3::new(x, y, z)));
    let (connected, patches, cells) = (&connected, &patches, &cells);
    let search = SampleSearch { connected, patches, cells, spacing, radius: REACH, sight: 0.0 };
    let seen = |sample: u32| {
        let triangle = places[sample as usize].triangle;
        (triangle, Vec3::from(mesh.normal(triangle)))
    };
    let chunks = chunks_of(places.len(), 512);
    let mut found = context.run(progress, |job| {
        job.flat_map(chunks.len(), |chunk| {
            let (mut finds, mut view, mut found) = (Finds::default(), View::default(), Vec::new());
            for sample in chunks.range(chunk) {
                let around = search.around(sample as u32, seen, &mut finds);
                let local = Local::on(connected, spacing, places[sample].triangle, around.normal);
                let list = List::new(sample as u32, around);
                list.show(Portable, positions[sample], &positions, (1.0 / spacing) as f32, connected, &mut view);
                view.project(Portable, local.tangents);
                view.wrap(Portable);
                let (star, is_closed) = view.star();
                let neighbours: Vec<Option<u32>> =
                    star.iter().map(|&neighbour| list.sample(neighbour.into())).collect();
                let followers = neighbours.iter().cycle().skip(1);
                let count = neighbours.len() - usize::from(!is_closed && !neighbours.is_empty());
                // Images are in no triangle.
                let pairs = neighbours.iter().zip(followers).take(count).filter_map(|(a, b)| a.zip(*b));
                found.extend(pairs.map(|(a, b)| Corner::new([sample as u32, a, b])));
            }
            found
        })
    })?;
    found.sort_unstable();
    Ok(found)
}

/// A triangle as found by one of its corners.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Corner {
    pub(super) sorted: [u32; 3],
    /// Whether it was found by another corner than the first.
    is_other: bool,
    /// The corners counter-clockwise, the lowest number first.
    pub(super) turned: [u32; 3],
}

impl Corner {
    /// The triangle as found by its first corner, counter-clockwise.
    fn new(corners: [u32; 3]) -> Self {
        let (mut sorted, mut turned) = (corners, corners);
        sorted.sort_unstable();
        while turned[0] != sorted[0] {
            turned.rotate_left(1);
        }
        Self { sorted, is_other: corners[0] != sorted[0], turned }
    }
}
