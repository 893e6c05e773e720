//! What a mesh file holds.

/// What a file holds, not yet checked.
#[derive(Default)]
pub(super) struct Soup {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Normals, as [`Mesh::with_normals`](crate::mesh::Mesh::with_normals) takes them, except that they need not be
    /// finite; none at all if it is empty.
    pub normals: Vec<[f32; 3]>,
    pub normal_indices: Option<Vec<[u32; 3]>>,
}
