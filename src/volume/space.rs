//! The ground of a fill: a cuboid with given balls, or the solid in it.

use crate::plane::{GivenDisks, Lattice};
use crate::simd::{self, Level};
use crate::volume::exposed::Exposed;
use crate::volume::fill::Fill;
use crate::volume::inside::Solid;
use crate::volume::search::Centre;
use crate::volume::shape::Whole;

/// The ground of a fill.
#[derive(Clone, Copy)]
pub struct Space<'a> {
    /// The cuboid.
    pub lattice: &'a Lattice<3>,
    /// The balls that cover parts of it.
    pub given: &'a GivenDisks<3>,
    /// The solid in it, if not all of it is filled.
    pub solid: Option<Solid<'a>>,
}

impl Space<'_> {
    /// The new samples of a fill, in the part of its region that belongs to the space, or that is exposed in a tiled one, by
    /// instructions of some level.
    pub fn run(&self, level: Level, fill: Fill<()>, exposed: Option<Exposed>) -> Vec<Centre> {
        match (exposed, self.solid) {
            (Some(exposed), _) => simd::run(level, fill.of_shape(exposed)),
            (None, None) => simd::run(level, fill.of_shape(Whole)),
            (None, Some(solid)) => {
                let inside = solid.within(self.lattice, fill.region);
                simd::run(level, fill.of_shape(inside))
            }
        }
    }
}
