//! The radius as a function of the lattice points of a domain, and its bounds in boxes.
//!
//! All lengths are in lattice units, a power of two, so that radii are those of the caller to the bit.

use crate::error::{Error, Result};
use crate::plane::{Lattice, Rect};
use crate::points::{Domain, MAXIMAL_DENSITY_IN_SPACE, check_resolution};
use crate::psp::adaptive::{FirstError, RadiusFunction, of_function};
use crate::volume::adaptive::options::Radius;
use crate::volume::adaptive::values::Values;
use crate::volume::search::Centre;

/// A place that is tested for a box is no farther outside than this, in lattice units: a rounded dart, along three axes.
pub const BEYOND: f64 = 2.25;

/// The share of a radius that rounding can add.
const ROUNDING: f64 = 1e-9;

/// The parts of a box along an axis, in whose centres the radius is asked for.
const PARTS: u32 = 4;

/// A part that is thinner than this, in radii, has as many samples as one of this thickness: those of a plane.
const THIN: f64 = 0.95;

/// The largest radius, in diagonals of the domain.
const LONGEST: f64 = 4.0;

/// The most float spacings by which a position and the place that it stands for differ.
const TOLERANCE: f64 = 6.0;

/// The radii that a caller states, and their bounds.
pub enum Source<'a> {
    Function { at: &'a RadiusFunction<'a>, bounds: [f64; 2], slope: f64 },
    Grid(Values<'a>),
}

impl<'a> Source<'a> {
    /// Checks what the caller states.
    pub fn new(domain: &Domain<3>, radius: Radius<'a>) -> Result<Self> {
        match radius {
            Radius::Function { at, smallest, largest, slope } => {
                of_function(smallest, largest, slope)?;
                Ok(Self::Function { at, bounds: [smallest, largest], slope })
            }
            Radius::Grid { values, size } => Ok(Self::Grid(Values::new(domain, values, size)?)),
        }
    }

    /// The least and the largest radius.
    pub fn bounds(&self) -> [f64; 2] {
        match self {
            Self::Function { bounds, .. } => *bounds,
            Self::Grid(values) => values.bounds,
        }
    }

    fn slope(&self) -> f64 {
        match self {
            Self::Function { slope, .. } => *slope,
            Self::Grid(values) => values.slope,
        }
    }

    /// The argument that is named where radii ask for too many samples.
    pub fn argument(&self) -> &'static str {
        match self {
            Self::Function { .. } => "radius_function",
            Self::Grid(_) => "grid_values",
        }
    }

    /// Those that are named where radii are too small, and too steep.
    fn of_bounds(&self) -> [&'static str; 2] {
        match self {
            Self::Function { .. } => ["smallest", "slope"],
            Self::Grid(_) => ["grid_values"; 2],
        }
    }
}

/// The radius in a domain, in lattice units.
pub struct RadiusField<'a> {
    source: &'a Source<'a>,
    lattice: &'a Lattice<3>,
    origin: [f64; 3],
    /// The largest radius that matters.
    limit: f64,
    /// The bounds of all radii.
    pub bounds: [f64; 2],
    pub slope: f64,
    /// The first error of the radii, if there is one.
    first_error: FirstError,
}

impl<'a> RadiusField<'a> {
    /// The field of a source; refuses radii that are too small or too steep for the lattice.
    pub fn new(source: &'a Source<'a>, lattice: &'a Lattice<3>) -> Result<Self> {
        let ([smallest, largest], slope, unit) = (source.bounds(), source.slope(), lattice.unit());
        let [too_small, too_steep] = source.of_bounds();
        check_resolution(too_small, smallest, unit, "the domain's largest coordinate")?;
        let steepest = smallest / (4.0 * TOLERANCE * unit);
        if slope > steepest {
            let reason =
                format!("{slope:?} is above {steepest:e}: the radius would change between neighbouring floats");
            return Err(Error::invalid(too_steep, reason));
        }
        let square: f64 = lattice.size.iter().map(|&size| f64::from(size) * f64::from(size)).sum();
        let limit = LONGEST * square.sqrt();
        let bounds = [smallest, largest].map(|radius| (radius / unit).min(limit));
        let origin = std::array::from_fn(|axis| lattice.coordinate(axis, 0));
        Ok(Self { source, lattice, origin, limit, bounds, slope, first_error: FirstError::default() })
    }

    /// The same radii with a first error of their own, for one task: its result depends on no other task.
    pub fn apart(&self) -> Self {
        Self { first_error: FirstError::default(), ..*self }
    }

    /// Fails if the radii have failed.
    pub fn check(&self) -> Result<()> {
        self.first_error.check()
    }

    /// True if the radii have failed already.
    pub fn has_failed(&self) -> bool {
        self.first_error.has_failed()
    }

    /// The position of a place of the domain: exact for a lattice point.
    fn position(&self, place: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.origin[axis] + place[axis] * self.lattice.unit())
    }

    /// The radius at a place, which must lie in these bounds, up to rounding; or the lower one if it does not.
    pub fn at(&self, place: [f64; 3], [least, most]: [f64; 2]) -> f64 {
        let (position, unit) = (self.position(place), self.lattice.unit());
        let radius = match self.source {
            Source::Grid(values) => values.at(position),
            Source::Function { at, bounds: [smallest, largest], .. } => {
                let radius = at(position);
                if !(*smallest..=*largest).contains(&radius) {
                    let reason = format!("{radius:?} at {position:?} is not in {smallest:?}..={largest:?}");
                    self.first_error.add(position, Error::invalid("radius_function", reason));
                    return least;
                }
                radius
            }
        };
        let radius = (radius / unit).min(self.limit);
        let slack = self.slack(radius);
        if radius < least - slack || radius > most + slack {
            let (found, slope) = (radius * unit, self.slope);
            let reason = format!("{found:?} at {position:?} is farther than slope {slope:?} allows from values around");
            self.first_error.add(position, Error::invalid("radius_function", reason));
            return least;
        }
        radius
    }

    /// The distance by which rounding can take a radius out of its bounds.
    pub fn slack(&self, radius: f64) -> f64 {
        ROUNDING * radius + BEYOND * self.slope
    }

    /// The radius at a lattice point.
    pub fn at_point(&self, point: Centre, bounds: [f64; 2]) -> f64 {
        self.at(point.map(f64::from), bounds)
    }

    /// Bounds of the radius within a distance of a place, which are no wider than some that hold around it.
    pub fn around(&self, place: [f64; 3], distance: f64, bounds: [f64; 2]) -> [f64; 2] {
        if self.slope == 0.0 && bounds[0] == bounds[1] {
            return bounds;
        }
        let (radius, change) = (self.at(place, bounds), self.slope * (distance + BEYOND));
        [(radius - change).max(bounds[0]), (radius + change).min(bounds[1])]
    }

    /// Bounds of the radius in a box, no wider than some that hold around it, and the approximate number of samples.
    pub fn in_box(&self, rect: &Rect<3>, bounds: [f64; 2]) -> ([f64; 2], f64) {
        let sides: [f64; 3] = std::array::from_fn(|axis| f64::from(rect.length(axis)) / f64::from(PARTS));
        let half = 0.5 * sides.iter().map(|side| side * side).sum::<f64>().sqrt();
        let ([mut least, mut most], mut samples) = ([f64::INFINITY, 0.0f64], 0.0);
        for part in 0..PARTS * PARTS * PARTS {
            let numbers = [part % PARTS, part / PARTS % PARTS, part / PARTS / PARTS];
            let along = |axis: usize| f64::from(rect.min[axis]) + (f64::from(numbers[axis]) + 0.5) * sides[axis];
            let place = std::array::from_fn(along);
            let radius = self.at(place, bounds);
            let change = self.slope * (half + BEYOND);
            (least, most) = (least.min(radius - change), most.max(radius + change));
            samples += self.samples(radius, sides, sides.map(|side| f64::from(PARTS) * side));
        }
        ([least.max(bounds[0]), most.min(bounds[1])], samples)
    }

    /// The approximate number of samples of a radius in a part, with these sides, of a box.
    pub fn samples(&self, radius: f64, part: [f64; 3], whole: [f64; 3]) -> f64 {
        let along = |axis: usize| part[axis] / radius * (THIN * radius / whole[axis]).max(1.0);
        MAXIMAL_DENSITY_IN_SPACE * along(0) * along(1) * along(2)
    }

    /// The refusal of too many samples.
    pub fn too_many(&self) -> Error {
        let reason = format!("asks for more samples than memory holds, or the limit of {:.2e}", f64::from(u32::MAX));
        Error::too_large(self.source.argument(), reason)
    }

    /// Reports that the limit of work was exceeded.
    pub fn exceed_work(&self, place: Centre) {
        let place = self.position(place.map(f64::from));
        let reason = match self.source {
            Source::Function { slope, .. } => format!("{slope:?}: radii of this slope, or a steeper one,"),
            Source::Grid(_) => "the radii".to_owned(),
        };
        let reason = format!("{reason} change too fast at {place:?} to find out what is covered");
        self.first_error.add(place, Error::too_large(self.source.of_bounds()[1], reason));
    }

    /// Reports that a radius was not the same at the same place.
    pub fn reject(&self, point: Centre) {
        let position = self.position(point.map(f64::from));
        let reason = format!("at {position:?} it changes faster than slope {:?} or between calls", self.slope);
        self.first_error.add(position, Error::invalid("radius_function", reason));
    }
}
