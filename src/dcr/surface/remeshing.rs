//! A mesh whose vertices are samples (thesis fig. 1.12).
//!
//! The triangles of the samples' Delaunay stars ([`triangulate`]) are the candidates. Where four samples are almost on
//! a circle their stars may choose different diagonals, so that not all three corners agree. Candidates are therefore
//! taken one after the other, those found by more corners first, and of these the smallest circles first. One is
//! refused if a side of it already has its triangle, or if a vertex would get a second fan in addition to a closed one.
//! So no edge has more than two triangles, and these are wound alike.

use glam::Vec3;

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::lists::{List, Listed};
use crate::dcr::surface::moves::Local;
use crate::dcr::surface::near::{Finds, Patches, SampleSearch, cell_side};
use crate::dcr::surface::view::View;
use crate::dcr::surface::{check, enter, hexagonal_distance};
use crate::error::{Error, Result};
use crate::index::MovingGrid3;
use crate::job::{Context, Progress, chunks_of};
use crate::mesh::{Mesh, Quality, exact};
use crate::simd::{Portable, Position};

/// The report of [`remesh`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RemeshReport {
    /// The number of triangles.
    pub triangles: u64,
    /// The number of triangles that not all three of their corners have in their stars.
    pub disputed: u64,
    /// The number of triangles of stars that were left out because they are incompatible with others.
    pub left_out: u64,
    /// The numbers of faces at the edges and vertices of the mesh, and its angles. Samples without a triangle are its
    /// unused vertices.
    pub quality: Quality,
}

/// Makes a mesh of samples that are spread about evenly on another mesh, as maximal and relaxed sets are. Its vertices
/// are the samples, in their order, its triangles those of their Delaunay stars that are compatible, wound as the
/// mesh's triangles under their corners. The arguments are those of [`relax`](fn@super::relax). O(n log n).
///
/// No edge has more than two triangles, and two triangles at an edge are wound alike; the rest is in the report.
/// Samples that resolve the features of a closed surface, wound alike everywhere, give a closed manifold of the same
/// topology. Otherwise, as on thin blades and between faces of opposite winding, there are holes. Triangles do not
/// cross open boundaries: the new boundary is that of the outermost samples.
///
/// # Errors
/// Those of [`relax`](fn@super::relax), [`Error::InvalidArgument`] for samples that form no triangle, and
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn remesh(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Mesh, RemeshReport)> {
    let found = found_corners(context, mesh, triangles, barycentrics, progress)?;
    let positions = mesh.samples_at(triangles, barycentrics)?.positions;
    let mut candidates: Vec<_> = found
        .chunk_by(|a, b| a.sorted == b.sorted)
        .map(|corners| (corners.len(), squared_circumradius(&positions, corners[0].turned), corners[0].turned))
        .collect();
    candidates.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let mut fans = vec![Fan::default(); positions.len()];
    candidates.retain(|&(_, _, corners)| take(&mut fans, corners));
    let disputed = candidates.iter().filter(|candidate| candidate.0 < 3).count();
    let all = found.chunk_by(|a, b| a.sorted == b.sorted).count();
    let mut taken: Vec<[u32; 3]> = candidates.into_iter().map(|(.., corners)| corners).collect();
    if taken.is_empty() {
        return Err(Error::invalid("triangles", format!("{} samples form no triangle", positions.len())));
    }
    taken.sort_unstable();
    let count = taken.len();
    let made = Mesh::new(positions, taken)?.with_origin(mesh.origin());
    let quality = made.quality();
    let report =
        RemeshReport { triangles: count as u64, disputed: disputed as u64, left_out: (all - count) as u64, quality };
    Ok((made, report))
}

/// The squared circumradius; infinite for a triangle without area.
fn squared_circumradius(positions: &[[f32; 3]], corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| exact(positions[corner as usize]));
    let lengths = a.distance_squared(b) * b.distance_squared(c) * c.distance_squared(a);
    let squared = 4.0 * (b - a).cross(c - a).length_squared();
    if squared > 0.0 { lengths / squared } else { f64::INFINITY }
}

/// The triangles of a vertex that have been taken.
#[derive(Clone, Default)]
struct Fan {
    /// The sides opposite the vertex, each from one corner to the next.
    sides: Vec<[u32; 2]>,
    /// True if the sides form a ring.
    is_closed: bool,
}

impl Fan {
    /// Some if the triangle with this opposite side can be added: true if it closes the ring.
    fn fits(&self, [from, to]: [u32; 2]) -> Option<bool> {
        if self.is_closed || self.sides.iter().any(|side| side[0] == from || side[1] == to) {
            return None;
        }
        let (mut end, mut length) = (to, 1);
        while let Some(next) = self.sides.iter().find(|side| side[0] == end) {
            (end, length) = (next[1], length + 1);
        }
        match end == from {
            true => (length == self.sides.len() + 1).then_some(true),
            false => Some(false),
        }
    }
}

/// Takes a triangle if it fits at all of its corners; returns true if it does.
fn take(fans: &mut [Fan], [a, b, c]: [u32; 3]) -> bool {
    let places = [(a, [b, c]), (b, [c, a]), (c, [a, b])];
    let fits = places.map(|(corner, side)| fans[corner as usize].fits(side));
    let [Some(at_a), Some(at_b), Some(at_c)] = fits else { return false };
    for ((corner, side), is_closed) in places.into_iter().zip([at_a, at_b, at_c]) {
        let fan = &mut fans[corner as usize];
        fan.sides.push(side);
        fan.is_closed = is_closed;
    }
    true
}

// The triangulation of relaxed samples on a surface, for remeshing (thesis §4.4.4).
//
// Each sample finds its Delaunay star in its own tangent plane. A triangle that is in the stars of all three of its
// corners is one of the mesh; where the surface is bent too much for the samples to agree, there are holes.

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

/// The triangles of all stars, each once for every corner that found it, sorted.
pub fn found_corners(
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
    let side = cell_side(spacing, REACH, 0.0);
    let cells =
        MovingGrid3::new(exact(mesh.bounds().0), side, positions.iter().map(|&[x, y, z, _]| Vec3::new(x, y, z)));
    let (connected, patches, cells) = (&connected, &patches, &cells);
    let search = SampleSearch::even(connected, patches, cells, spacing, REACH);
    let all = Listed::new(connected, search.grading, &positions, (1.0 / spacing) as f32);
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
                list.show(Portable, positions[sample], &all, &mut view);
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
pub struct Corner {
    pub sorted: [u32; 3],
    /// True if it was found by a corner other than the first.
    is_other: bool,
    /// The corners counter-clockwise, the lowest number first.
    pub turned: [u32; 3],
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

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(triangles: &[[u32; 3]]) -> Vec<bool> {
        let mut fans = vec![Fan::default(); 9];
        triangles.iter().map(|&corners| take(&mut fans, corners)).collect()
    }

    #[test]
    fn a_vertex_has_no_fan_beside_a_closed_one() {
        assert_eq!(taken(&[[0, 1, 2], [0, 2, 3], [0, 3, 1], [0, 4, 5]]), [true, true, true, false]);
        assert_eq!(taken(&[[0, 4, 5], [0, 1, 2], [0, 2, 3], [0, 3, 1]]), [true, true, true, false]);
    }

    #[test]
    fn a_side_has_one_triangle_in_each_direction() {
        assert_eq!(taken(&[[0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 0, 5]]), [true, true, false, false]);
    }
}
