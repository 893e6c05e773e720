//! Fixed points that hold the mesh where no points are wanted.
//!
//! The kept mesh has no edge longer than a quarter of the torus (`half_edge_mesh.rs`), but stippled images often have
//! wide white areas. So a coarse lattice of anchors is placed there. They are corners of triangles and nothing else:
//! they do not move, push or count, and no hole is filled where the density is 0.

use crate::dcr::density::raster::Raster;
use crate::dcr::ground::torus::{Torus, TorusPoint};

/// Points of the lattice along each axis of the domain.
const LATTICE: u32 = 8;

/// The least local spacing at an anchor: as the spacing grows by half of the distance at most, anchors are at twice this
/// distance from where points are wanted.
const WIDE: f32 = 3.0;

/// The anchors of a domain and, where it is mirrored, their images.
pub(super) fn anchors(torus: &Torus, raster: &Raster) -> Vec<TorusPoint> {
    let lattice = (0..LATTICE).flat_map(|row| (0..LATTICE).map(move |column| [column, row]));
    let places = lattice.map(|cell| raster.place(cell.map(|index| (f64::from(index) + 0.5) / f64::from(LATTICE))));
    let wide: Vec<TorusPoint> = places.filter(|&place| raster.spacing(place) >= WIDE).collect();
    torus.with_images(&wide)
}
