//! A mesh whose vertices are samples (thesis fig. 1.12).
//!
//! The triangles of the samples' Delaunay stars (`triangles.rs`) are the candidates. Where four samples are about on a
//! circle their stars may choose different diagonals, so that not all of three corners agree. Candidates are therefore
//! taken one after the other, those first that more corners have found, and of these the smallest circles first. One is
//! refused if a side of it has its triangle already, or if a vertex would get a second fan beside a closed one. So no edge
//! has more than two triangles, and these are wound alike.

use crate::dcr::surface::triangles::found_corners;
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::mesh::{Mesh, Quality, exact};

/// What [`remesh`] made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RemeshReport {
    /// The number of triangles.
    pub triangles: u64,
    /// The number of triangles that not all three of their corners have in their stars.
    pub disputed: u64,
    /// The number of triangles of stars that were left out because they do not go with others.
    pub left_out: u64,
    /// What meets at the edges and vertices of the mesh, and its angles. Samples without a triangle are its unused
    /// vertices.
    pub quality: Quality,
}

/// Makes a mesh of samples that are spread about evenly on another mesh, as maximal and relaxed sets are. Its vertices are
/// the samples, in their order, its triangles those of their Delaunay stars that go together, wound as the mesh's
/// triangles under their corners. The arguments are those of [`relax`](fn@super::relax). O(n log n).
///
/// No edge has more than two triangles, and two triangles at an edge are wound alike; the rest is in the report. Samples
/// that resolve the features of a closed surface, wound alike everywhere, give a closed manifold of the same topology.
/// Where they do not, as on thin blades and between faces that are wound against each other, there are holes.
/// Triangles do not cross open boundaries: the new boundary is that of the outermost samples.
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
    let made = Mesh::new(positions, taken)?;
    let quality = made.quality();
    let report =
        RemeshReport { triangles: count as u64, disputed: disputed as u64, left_out: (all - count) as u64, quality };
    Ok((made, report))
}

/// Infinite for a triangle without area.
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
    /// Whether they are one ring.
    is_closed: bool,
}

impl Fan {
    /// Whether the triangle with this opposite side can be added; if so whether it closes the ring.
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

/// Takes a triangle if it fits at all of its corners; returns whether it does.
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
