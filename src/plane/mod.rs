//! The plane in exact integers, shared by [`maximal`](crate::maximal) and [`kdrt`](crate::kdrt): a lattice of floats,
//! cells that hold one sample at most, and the flat quadtree of voxels in which darts are thrown (Ebeida et al. 2012).

mod cells;
mod lattice;
mod list;
mod near;
mod obstacles;
mod quadtree;
mod rect;
mod rows;

pub(crate) use cells::{CellAxis, CellGrid};
pub(crate) use lattice::{Lattice, Separation, estimate, float_spacing};
pub(crate) use list::List;
pub(crate) use obstacles::{Disk, GivenDisks};
pub(crate) use quadtree::{Quadtree, darts};
pub(crate) use rect::Rect;
