//! Spatial indices and their building blocks. Look here before you write another one.
//!
//! | what is asked | of what | index |
//! |---|---|---|
//! | what is within a radius, and nearest | points of a domain or torus, all known at first | [`SortedGrid`], of the plane [`Grid2`] |
//! | what is within a radius | points in space whose number grows | [`Grid3`] |
//! | what is within a radius | points in space that move | [`MovingGrid3`] |
//! | what is nearest, however far | points in space, clustered or not, all known at first | [`PointTree`] |
//! | which boxes meet a box | boxes, all known at first | [`BoxTree`] |
//! | which items have this number | items that are known at first, of few numbers | [`Binned`] |
//! | which items have this key | items that parallel tasks find, of any keys | [`Buckets`] |
//! | a random item by its weight | triangles, cells | [`Weights`] |
//! | an order in which neighbours are close in memory | cells of the plane and of space | [`curve`] |
//!
//! Some indices stay with the algorithm that they were made for, as they hold more than positions:
//!
//! | index | why it is none of the above |
//! |---|---|
//! | `plane/cells`, `plane/quadtree` | integers, a cell holds at most one sample; exactness rests on both |
//! | `kdrt/region`, `kdrt/fill`, `kdrt/classes` | rows of exact integers that are swept in order; bits of a block |
//! | `psp/fill/pages` | pages of coordinates and radii for vector code, each sample in all cells that it touches |
//! | `psp/given` | balls of very different sizes, a grid for each tier of sizes |
//! | `dcr/uniform/cells` | moving points of a torus, coordinates for vector code; sorted anew, not re-linked |
//! | `dcr/correlation/rows` | moving points of a torus in reaches of many spacings, for vector code |
//! | `interior/tree` | boxes of triangles in rows of eight, for rays along one axis and for boxes |
//! | `thin/tree` | each node knows the point of it that is farthest from all selected ones, and loses it |

mod binned;
mod box_tree;
pub mod curve;
mod grid3;
mod moving_grid3;
mod point_tree;
mod sorted_grid;
mod weighted;

pub use binned::{Binned, Buckets};
pub use box_tree::{BoxTree, Extent, meet};
pub use grid3::{Grid3, smallest_distance};
pub use moving_grid3::{LEVELS, MovingGrid3};
pub use point_tree::PointTree;
pub use sorted_grid::{Entry, Grid2, SortedGrid};
pub use weighted::Weights;
