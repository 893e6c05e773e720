//! The ground of a fill where radii vary: a cuboid with its radii, or the solid in it.

use crate::plane::Lattice;
use crate::simd::{self, Level};
use crate::volume::adaptive::field::RadiusField;
use crate::volume::adaptive::fill::Fill;
use crate::volume::adaptive::grid::{Ball, LONGEST_UNIT};
use crate::volume::inside::Solid;
use crate::volume::shape::Whole;

/// The ground of a fill.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// The cuboid.
    pub lattice: &'a Lattice<3>,
    pub field: &'a RadiusField<'a>,
    /// The solid in it, if not all of it is filled.
    pub solid: Option<Solid<'a>>,
}

impl Ground<'_> {
    /// The unit of the grid of a region with these bounds of the radius. Voxels at a surface are as small as the least one
    /// requires.
    pub fn unit(&self, [least, most]: [f64; 2]) -> f64 {
        if self.solid.is_some() {
            // The solid is in units of the radius of a lattice, which has a limit.
            self.lattice.with_radius(least * self.lattice.unit()).radius
        } else {
            (0.5 * (least + most)).min(LONGEST_UNIT * least)
        }
    }

    /// The new samples of a fill, in the part of its region that belongs to the ground, by instructions of some level.
    pub fn run(&self, level: Level, fill: Fill<()>) -> Vec<Ball> {
        match self.solid {
            None => simd::run(level, fill.of_shape(Whole)),
            Some(solid) => {
                let lattice = &self.lattice.with_radius(fill.unit * self.lattice.unit());
                let inside = solid.within(lattice, fill.region);
                simd::run(level, fill.of_shape(inside))
            }
        }
    }
}
