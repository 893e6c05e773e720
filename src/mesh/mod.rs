//! A checked triangle soup, and the points on it.
//!
//! Any topology is accepted: open, non-manifold, self-intersecting, duplicated and oppositely wound faces are all
//! welcome. The requirements are checked once, here, so that no later stage meets a bad number or index.

mod glb;
mod load;
mod obj;
mod off;
pub mod ply;
mod quality;
mod source;
mod stl;
mod surface;
mod text;

pub use quality::Quality;
pub use surface::Mesh;
pub(crate) use surface::{exact, exact_point, round_barycentrics};
