//! Places that hold the mesh where no points are wanted.
//!
//! The kept mesh has no edge longer than a quarter of the torus (`spread/mesh.rs`), but what is drawn with dots often stands
//! on wide white paper. So a coarse lattice of anchors stands there. They are corners of triangles and nothing else: they
//! do not move, push or count, and no hole is filled where the density is 0.

use crate::dcr::density::raster::Raster;
use crate::dcr::ground::torus::{Place, Torus};

/// Places of the lattice along each axis of the domain.
const LATTICE: u32 = 8;

/// The local spacing from which on there are anchors: as the spacing grows by half of the distance at most, they are twice
/// as far from where points are wanted.
const WIDE: f32 = 3.0;

/// The anchors of a domain and, where it is mirrored, their images.
pub(super) fn anchors(torus: &Torus, raster: &Raster) -> Vec<Place> {
    let lattice = (0..LATTICE).flat_map(|row| (0..LATTICE).map(move |column| [column, row]));
    let places = lattice.map(|cell| raster.place(cell.map(|index| (f64::from(index) + 0.5) / f64::from(LATTICE))));
    let wide: Vec<Place> = places.filter(|&place| raster.spacing(place) >= WIDE).collect();
    torus.with_images(&wide)
}
