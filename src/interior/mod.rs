//! The inside of a mesh.
//!
//! Of a *closed* mesh (`sides.rs`) a point is inside if the ray from it crosses an odd number of triangles, counted without
//! error (`crossing.rs`): every float is inside or outside, whatever the mesh intersects. Of any other one it is inside if the
//! generalised winding number (`winding.rs`) is at least 1/2, or at most -1/2 for triangles that face inwards. Both ask a tree
//! of the triangles (`tree.rs`). What is made inside of a mesh that is not closed is made inside of it and its caps (`caps.rs`).

mod caps;
mod content;
mod crossing;
mod nearest;
mod sides;
mod tree;
mod winding;

use std::sync::{Arc, OnceLock};

use crate::check;
use crate::error::Result;
use crate::interior::tree::Tree;
use crate::interior::winding::{ERROR_OF_FEW, Fans};
use crate::job::{Context, Progress, chunks};
use crate::mesh::Mesh;

/// The winding number from which a point is inside.
const WOUND: f64 = 0.5;

/// The inside of a mesh, made for many questions. Made from a mesh by [`Interior::of`], which keeps it.
#[derive(Debug)]
pub struct Interior {
    tree: Tree,
    /// None of a closed mesh.
    fans: Option<Fans>,
    bounds: [[f32; 3]; 2],
    /// Measured when it is first asked for.
    volume: OnceLock<f64>,
}

impl Interior {
    /// The inside of a mesh, without the triangles that its mask leaves out. It is made the first time, O(n log n), and kept
    /// with the mesh: 63 bytes per triangle, and about 90 for each edge of a boundary.
    pub fn of(mesh: &Mesh) -> Arc<Self> {
        let kept = mesh.kept(|| Ok(()), || Ok(Self::new(mesh)));
        kept.unwrap_or_else(|_| Arc::new(Self::new(mesh)))
    }

    fn new(mesh: &Mesh) -> Self {
        let sides = mesh.sides();
        let triangles: Vec<_> = mesh.sampled_triangles().map(|number| mesh.corners(number)).collect();
        let (low, high) = mesh.bounds();
        let (tree, _) = Tree::new(&triangles);
        let fans = (sides.odd_edges > 0).then(|| Fans::new(mesh, &sides.boundary));
        Self { tree, fans, bounds: [low, high], volume: OnceLock::new() }
    }

    /// True if the mesh is closed, and points are decided without error: see [`Mesh::is_closed`].
    pub fn is_closed(&self) -> bool {
        self.fans.is_none()
    }

    /// True if a point is inside. Of a closed mesh: the ray from it along +x crosses an odd number of triangles, decided
    /// without error. A point on the surface belongs to one of its two sides, so that boxes of meshes that share a face share
    /// no point. Of any other mesh: the generalised winding number is at least 1/2 or at most -1/2, and the point is in the box
    /// around the mesh. The number is right to 10^-6 beside 1/2 if the boundary has up to 2,048 edges, otherwise to .02; a point on a
    /// sheet that encloses nothing is outside. No point that is not finite is inside. About O(log n).
    pub fn contains(&self, point: [f32; 3]) -> bool {
        let [low, high] = self.bounds;
        if !(0..3).all(|k| low[k] <= point[k] && point[k] <= high[k]) {
            return false;
        }
        match &self.fans {
            None => self.tree.crossings(point) % 2 != 0,
            Some(fans) => {
                // That of the surface with its fans, less that of the fans.
                let closed = f64::from(self.tree.crossings(point) + fans.tree.crossings(point));
                let is_open = |number: f64, error: f64| ((closed - number).abs() - WOUND).abs() <= error;
                let border = WOUND + if fans.are_few() { ERROR_OF_FEW } else { 0.0 };
                (closed - fans.number_if(point, is_open)).abs() >= border
            }
        }
    }

    /// The winding number of a mesh that is not closed at a place, to about 1/1000; beside 1/2 to 10^-6 if the boundary has few edges,
    /// so that level places of a flat hole are known as such.
    fn winding(&self, place: [f32; 3]) -> f64 {
        let crossings = self.tree.crossings(place);
        let Some(fans) = &self.fans else { return f64::from(crossings) };
        let closed = f64::from(crossings + fans.tree.crossings(place));
        let is_open = |number: f64, error: f64| ((closed - number).abs() - WOUND).abs() <= error;
        closed - fans.precise_number_if(place, is_open)
    }

    /// [`Interior::contains`] for many points, on all threads.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for `positions` that are not finite;
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn contains_each(
        &self,
        context: &Context,
        positions: &[[f32; 3]],
        progress: Option<&Progress>,
    ) -> Result<Vec<bool>> {
        check::finite("positions", "", positions)?;
        let chunks = chunks(positions.len());
        let of = |chunk: usize| positions[chunks.range(chunk)].iter().map(|&point| self.contains(point)).collect();
        context.run(progress, |job| job.flat_map(chunks.len(), of))
    }

    /// The place of the surface that is nearest to another, and the square of its distance, if that is less than that of `within`.
    /// The distance is right to 1e-7 of the size of triangles.
    pub(crate) fn nearest(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], f64)> {
        self.tree.nearest(place, within)
    }

    /// The place of the surface as [`Interior::nearest`] and the unit normal of its triangle; 0 of one without area.
    pub(crate) fn nearest_facing(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], [f64; 3])> {
        self.tree.nearest_facing(place, within)
    }

    /// A place of the surface and the square of its distance from another, if that is at most the square of `far`: the nearest
    /// place, or any whose square is at most that of `near`. The square is, to the bit, the one that all triangles give.
    pub(crate) fn nearest_in_band(&self, place: [f64; 3], band: [f64; 2]) -> Option<([f64; 3], f64)> {
        self.tree.nearest_in_band(place, band)
    }

    /// Visits the corners of the triangles whose boxes touch a box.
    pub(crate) fn for_each_near(&self, around: [[f32; 3]; 2], mut triangle: impl FnMut(&[[f32; 3]; 3])) {
        self.tree.for_each_near(around, |number| triangle(&self.tree.corners[number]));
    }
}

impl Mesh {
    /// True if a point is inside the mesh: see [`Interior::contains`], whose inside is kept with the mesh.
    pub fn contains(&self, point: [f32; 3]) -> bool {
        Interior::of(self).contains(point)
    }
}
