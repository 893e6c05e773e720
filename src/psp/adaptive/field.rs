//! The radius as a function on the surface: its value at a sample, and its bounds on a fragment.
//!
//! A sample is not exactly where its dart fell: its position and its barycentrics are rounded. This can take its radius
//! out of the bounds of its fragment, but by no more than a quarter of the least radius. For a function, the slope is
//! limited to ensure this. For vertices, the barycentrics change the radius by 2^-24 of the difference of two corners,
//! at most four diagonals; these are at most 14 float spacings, and no radius is below 64.
//!
//! Levels of an ordered set (`psp/levels.rs`) multiply all radii by a *scale*. Radii without it are *relative*, as are
//! those of samples. Everything that is compared with lengths has been multiplied: bounds, and all that follows from
//! them.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use glam::DVec3;

use crate::error::{Error, Result};
use crate::math::{scalbn, square};
use crate::memory;
use crate::mesh::{Mesh, exact};
use crate::points::check_resolution;
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::options::{Radius, RadiusFunction, Scale};
use crate::psp::fill::TOLERANCE;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::set::Sample;

/// Bounds that differ by no more than this share of the longest edge of a fragment are good enough for it: the region
/// proved covered falls short of the covered one by half of that.
const FLAT: f64 = 0.1;

/// The share of a radius that rounding can add.
const ROUNDING: f64 = 1e-9;

/// On a piece of the surface where a density falls to 0, radii are at most this many times the least one: the piece has
/// one radius as far as lengths and octaves are concerned. The few samples that this adds lie where the density is
/// below a sixteenth of the piece's largest.
const STEEPEST: f64 = 4.0;

/// The source of the radius.
#[derive(Clone, Copy)]
enum Source<'a> {
    Vertices(&'a [f32]),
    Function {
        at: &'a RadiusFunction<'a>,
        smallest: f64,
        largest: f64,
        slope: f64,
    },
    Density {
        density: &'a DensityField<'a>,
        /// The relative radius at density 1.
        unit: f64,
    },
}

/// The radius on a mesh.
pub struct RadiusField<'a> {
    mesh: &'a Mesh,
    source: Source<'a>,
    /// The factor of all radii: 1, except on levels.
    scale: f64,
    /// Relative bounds for the whole surface.
    all: RadiusBounds,
    /// The relative radius that replaces all larger ones: at the finest scale a sample of twice this radius excludes
    /// all others. A density of this radius counts as 0: no samples.
    limit: f64,
    /// The largest distance by which rounding moves a sample.
    rounding: f64,
    /// The first error of the radii, if there is one.
    first_error: FirstError,
}

impl<'a> RadiusField<'a> {
    /// Checks the radii of the caller.
    ///
    /// `density` is the density where the radius follows from one, with the relative radius at density 1. The scale is
    /// the finest.
    pub fn new(
        mesh: &'a Mesh,
        radius: Radius<'a>,
        density: Option<(&'a DensityField<'a>, f64)>,
        scale: f64,
    ) -> Result<Self> {
        let (source, all) = match (radius, density) {
            (Radius::PerVertex(radii), _) => (Source::Vertices(radii), of_vertices(mesh, radii)?),
            (Radius::Function { at, smallest, largest, slope }, _) => {
                let source = Source::Function { at, smallest, largest, slope };
                (source, of_function(smallest, largest, slope)?)
            }
            (Radius::Density { .. }, Some((density, unit))) => {
                let least = unit / density.largest.sqrt();
                (Source::Density { density, unit }, RadiusBounds { least, largest: f64::INFINITY })
            }
            (Radius::Density { .. }, None) => unreachable!("a density is checked first"),
        };
        let (low, high) = mesh.bounds();
        let limit = 4.0 * (exact(high) - exact(low)).length() / scale;
        let argument = match source {
            Source::Vertices(_) => "vertex_radii",
            Source::Function { .. } => "smallest",
            Source::Density { .. } => "density",
        };
        let spacing = mesh.float_spacing();
        let place = "the largest coordinate of the mesh";
        check_resolution(argument, scale * all.least, spacing, place).map_err(|error| match (radius, error) {
            (Radius::Density { scale: Scale::Count(count), .. }, Error::InvalidArgument { reason, .. }) => {
                Error::invalid("count", format!("for {count} samples the smallest radius, {reason}"))
            }
            (_, error) => error,
        })?;
        let rounding = TOLERANCE * spacing;
        if let Source::Function { smallest, slope, .. } = source
            && 4.0 * slope * rounding > smallest
        {
            let steepest = smallest / (4.0 * rounding);
            let reason =
                format!("{slope:?} is above {steepest:e}: the radius would change between neighbouring floats");
            return Err(Error::invalid("slope", reason));
        }
        let all = RadiusBounds { least: all.least.min(limit), largest: all.largest.min(limit) };
        Ok(Self { mesh, source, scale, all, limit, rounding, first_error: FirstError::default() })
    }

    /// The argument that is named in the error if there are too many samples.
    pub fn argument(&self) -> &'static str {
        match self.source {
            Source::Vertices(_) => "vertex_radii",
            Source::Function { .. } => "radius_function",
            Source::Density { .. } => "density",
        }
    }

    /// The same radii at another scale.
    pub fn at_scale(&self, scale: f64) -> Self {
        Self { scale, ..self.apart() }
    }

    /// The factor of relative radii.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The least relative radius.
    pub fn least(&self) -> f64 {
        self.all.least
    }

    /// Bounds for the whole surface.
    pub fn all(&self) -> RadiusBounds {
        self.all.times(self.scale)
    }

    /// The relative radius at a sample.
    pub fn at(&self, sample: &Sample) -> f64 {
        let uv = sample.barycentrics.map(f64::from);
        match self.source {
            Source::Vertices(radii) => self.interpolate(radii, sample.triangle, uv),
            Source::Function { at, .. } => self.call(at, sample.position.map(f64::from)),
            Source::Density { .. } => self.radius_of(self.density(sample.triangle, uv, exact(sample.position))),
        }
    }

    /// [`RadiusField::at`] for a sample of a fragment with these bounds, which are tested with it.
    pub fn at_within(&self, sample: &Sample, bounds: RadiusBounds) -> f64 {
        let radius = self.at(sample);
        self.test_slope(exact(sample.position), self.scale * radius, bounds);
        match self.source {
            Source::Density { .. } if !self.is_empty_radius(self.scale * radius) => {
                radius.clamp(bounds.least / self.scale, bounds.largest / self.scale)
            }
            _ => radius,
        }
    }

    /// True if a radius is that of a density of 0: no samples.
    pub fn is_empty_radius(&self, radius: f64) -> bool {
        matches!(self.source, Source::Density { .. }) && radius >= self.scale * self.limit
    }

    /// Bounds for a piece of the surface on which the radius changes little: for a density, no farther apart than
    /// [`STEEPEST`].
    pub fn settled(&self, bounds: RadiusBounds) -> RadiusBounds {
        match self.source {
            Source::Density { .. } => RadiusBounds { largest: bounds.largest.min(STEEPEST * bounds.least), ..bounds },
            _ => bounds,
        }
    }

    /// Bounds on a fragment that is part of one with bounds `within`.
    pub fn bounds(&self, fragment: &Fragment, shape: &Shape, within: RadiusBounds) -> RadiusBounds {
        match self.source {
            Source::Vertices(radii) => {
                let [a, b, c] =
                    fragment.corners.map(|corner| self.scale * self.interpolate(radii, fragment.triangle, corner));
                RadiusBounds { least: a.min(b).min(c), largest: a.max(b).max(c) }
            }
            Source::Function { at, slope, .. } => {
                let radius = self.scale * self.call(at, shape.centre.to_array());
                self.test_slope(shape.centre, radius, within);
                let change = self.scale * slope * shape.extent();
                let [least, largest] =
                    [radius - change, radius + change].map(|x| x.clamp(within.least, within.largest));
                RadiusBounds { least, largest }
            }
            Source::Density { density, .. } => {
                let mut centre = 0.0;
                if density.slope().is_some() {
                    centre = self.density(fragment.triangle, fragment.at([1.0 / 3.0; 2]), shape.centre);
                    self.test_slope(shape.centre, self.scale * self.radius_of(centre), within);
                }
                let [largest, least] =
                    density.bounds(fragment, shape, centre).map(|density| self.scale * self.radius_of(density));
                // A density of 0 is distinguished from a low one. On a settled piece even the least radius of a part
                // may exceed the radius taken as the largest.
                if self.is_empty_radius(least) {
                    return RadiusBounds { least, largest: least };
                }
                let [least, largest] = [least, largest].map(|radius| radius.min(within.largest).max(within.least));
                RadiusBounds { least, largest }
            }
        }
    }

    /// Bounds on a fragment that is part of one with bounds `within`: the latter, where they are good enough.
    pub fn narrowed(&self, fragment: &Fragment, shape: &Shape, within: RadiusBounds) -> RadiusBounds {
        if within.largest - within.least <= FLAT * shape.longest {
            within
        } else {
            self.bounds(fragment, shape, within)
        }
    }

    /// Radii for the corners of a fragment with these bounds, such that no point of it has a smaller radius than their
    /// linear interpolation.
    pub fn radii_from(&self, fragment: &Fragment, bounds: RadiusBounds) -> [f64; 3] {
        match self.source {
            Source::Vertices(radii) => {
                fragment.corners.map(|corner| self.scale * self.interpolate(radii, fragment.triangle, corner))
            }
            Source::Function { .. } | Source::Density { .. } => [bounds.least; 3],
        }
    }

    /// The radius at a sample of a fragment with these bounds, or the bounds if a function would have to be called for
    /// it.
    pub fn known_at(&self, sample: &Sample, bounds: RadiusBounds) -> RadiusBounds {
        if self.calls_functions() {
            return bounds;
        }
        let radius = self.scale * self.at_within(sample, bounds);
        RadiusBounds { least: radius, largest: radius }
    }

    /// An upper bound of the radii of samples on a fragment with this largest one, even where rounding has moved them.
    pub fn above(&self, largest: f64) -> f64 {
        let slack = match self.source {
            // The rounding of barycentrics times the difference of two corners.
            Source::Vertices(_) => scalbn(1.0, -22) * self.all().largest,
            Source::Function { slope, .. } => self.scale * slope * self.rounding,
            Source::Density { .. } => 0.0,
        };
        largest * (1.0 + ROUNDING) + slack
    }

    /// The radius at the centre of a fragment.
    pub fn centre(&self, fragment: &Fragment, shape: &Shape) -> f64 {
        let uv = fragment.at([1.0 / 3.0; 2]);
        self.scale
            * match self.source {
                Source::Vertices(radii) => self.interpolate(radii, fragment.triangle, uv),
                Source::Function { at, .. } => self.call(at, shape.centre.to_array()),
                Source::Density { .. } => self.radius_of(self.density(fragment.triangle, uv, shape.centre)),
            }
    }

    /// The same radii with a first error of their own, for one task: its result depends on no other task.
    pub fn apart(&self) -> Self {
        Self { first_error: FirstError::default(), ..*self }
    }

    /// Fails if the radii have failed.
    pub fn check(&self) -> Result<()> {
        self.first_error.check()
    }

    /// True if the call has failed already.
    pub fn has_failed(&self) -> bool {
        self.first_error.has_failed()
    }

    /// Reports that the work limit was exceeded.
    pub fn exceed_work(&self, place: DVec3) {
        let (argument, what) = match self.source {
            Source::Vertices(_) => ("vertex_radii", "the radii".to_owned()),
            Source::Function { slope, .. } => ("slope", format!("{slope:?}: radii of this slope, or a steeper one,")),
            Source::Density { density, .. } => match density.slope() {
                Some(slope) => ("slope", format!("{slope:?}: densities of this slope, near 0,")),
                None => ("density", "the densities".to_owned()),
            },
        };
        let place = place.to_array();
        let reason = format!("{what} change too fast at {place:?} to find out what is covered");
        self.first_error.add(place, Error::too_large(argument, reason));
    }

    fn interpolate(&self, radii: &[f32], triangle: u32, [u, v]: [f64; 2]) -> f64 {
        let corners = self.mesh.triangles()[triangle as usize];
        let [a, b, c] = corners.map(|vertex| f64::from(radii[vertex as usize]).min(self.limit));
        (1.0 - u - v) * a + u * b + v * c
    }

    /// True if the caller's function is called for a radius.
    fn calls_functions(&self) -> bool {
        match self.source {
            Source::Vertices(_) => false,
            Source::Function { .. } => true,
            Source::Density { density, .. } => density.slope().is_some(),
        }
    }

    /// The relative radius that the caller's function gives, or the least it may give if the value is invalid.
    fn call(&self, at: &RadiusFunction, position: [f64; 3]) -> f64 {
        let Source::Function { smallest, largest, .. } = self.source else { return self.all.least };
        let radius = at(position);
        if !(smallest..=largest).contains(&radius) {
            let reason = format!("{radius:?} at {position:?} is not in {smallest:?}..={largest:?}");
            self.first_error.add(position, Error::invalid("radius_function", reason));
            return self.all.least;
        }
        radius.min(self.limit)
    }

    /// The density at a place of a triangle, or the largest if the value of a function is invalid.
    fn density(&self, triangle: u32, uv: [f64; 2], position: DVec3) -> f64 {
        let Source::Density { density, .. } = self.source else { return 0.0 };
        density.at(triangle, uv, position.to_array()).unwrap_or_else(|found| {
            let (place, largest) = (position.to_array(), density.largest);
            let reason = format!("{found:?} at {place:?} is not in 0..={largest:?}");
            self.first_error.add(place, Error::invalid("density", reason));
            largest
        })
    }

    /// The relative radius of a density.
    fn radius_of(&self, density: f64) -> f64 {
        match self.source {
            Source::Density { unit, .. } if density > 0.0 => (unit / density.sqrt()).min(self.limit),
            _ => self.limit,
        }
    }

    /// Tests the radius at a place against the bounds that follow from the slope. A density has to keep only the lower
    /// one.
    fn test_slope(&self, position: DVec3, radius: f64, RadiusBounds { least, largest }: RadiusBounds) {
        let (slope, lowest, highest) = match self.source {
            Source::Vertices(_) => return,
            Source::Function { slope, .. } => {
                let slack = ROUNDING * radius + self.scale * slope * self.rounding;
                (slope, least - slack, largest + slack)
            }
            Source::Density { density, unit } => {
                let Some(slope) = density.slope() else { return };
                let unit = self.scale * unit;
                let highest = square(unit / least) * (1.0 + ROUNDING) + slope * self.rounding;
                (slope, unit / highest.sqrt(), f64::INFINITY)
            }
        };
        if !(lowest..=highest).contains(&radius) {
            let place = position.to_array();
            let reason =
                format!("{radius:?} at {place:?} is farther than slope {slope:?} allows from the values around");
            self.first_error.add(place, Error::invalid(self.argument(), reason));
        }
    }
}

/// The least and the largest radius on a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusBounds {
    pub least: f64,
    pub largest: f64,
}

impl RadiusBounds {
    /// Bounds of the radii at a scale, from those of relative ones.
    pub fn times(self, scale: f64) -> Self {
        Self { least: scale * self.least, largest: scale * self.largest }
    }

    /// The unit of lengths: the radius as far as it is known. If the bounds are far apart, the least may be due to a
    /// distant corner or to a poor bound; fragments then become smaller, but not by so much.
    pub fn scale(&self) -> f64 {
        self.least.max(self.largest / 16.0)
    }

    /// The unit of areas: the mean of 1 / radius² where the radius changes linearly.
    pub fn density(&self) -> f64 {
        1.0 / (self.least * self.largest)
    }
}

/// Checks radii of vertices, and gives their bounds.
pub fn of_vertices(mesh: &Mesh, radii: &[f32]) -> Result<RadiusBounds> {
    let count = mesh.positions().len();
    if radii.len() != count {
        return Err(Error::invalid("vertex_count", format!("{} radii for {count} vertices", radii.len())));
    }
    if let Some(vertex) = radii.iter().position(|radius| !(radius.is_finite() && *radius > 0.0)) {
        let reason = format!("vertex {vertex} has {:?}, not a positive finite number", radii[vertex]);
        return Err(Error::invalid("vertex_radii", reason));
    }
    let used = mesh.triangles().iter().flatten().map(|&vertex| f64::from(radii[vertex as usize]));
    let start = RadiusBounds { least: f64::INFINITY, largest: 0.0 };
    Ok(used.fold(start, |all, x| RadiusBounds { least: all.least.min(x), largest: all.largest.max(x) }))
}

/// Checks the stated bounds of a function, and gives them.
pub fn of_function(smallest: f64, largest: f64, slope: f64) -> Result<RadiusBounds> {
    if !(smallest > 0.0 && smallest.is_finite()) {
        return Err(Error::invalid("smallest", format!("{smallest:?} is not a positive finite number")));
    }
    if !(largest >= smallest && largest.is_finite()) {
        return Err(Error::invalid("largest", format!("{largest:?} is not a finite number from {smallest:?} on")));
    }
    if !(slope >= 0.0 && slope.is_finite()) {
        return Err(Error::invalid("slope", format!("{slope:?} is not a finite number from 0 on")));
    }
    Ok(RadiusBounds { least: smallest, largest })
}

/// The first error of a radius function that breaks its stated bounds. Of several it is the one at the first place,
/// axis by axis, so that it does not depend on the order in which they are found.
#[derive(Default)]
pub struct FirstError {
    first: Mutex<Option<([f64; 3], Error)>>,
    has_failed: AtomicBool,
}

impl FirstError {
    /// Adds a failure at a place.
    pub fn add(&self, place: [f64; 3], failure: Error) {
        let mut first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|(other, _)| place < *other) {
            *first = Some((place, failure));
        }
        self.has_failed.store(true, Ordering::Relaxed);
    }

    /// True if the call has failed.
    pub fn has_failed(&self) -> bool {
        self.has_failed.load(Ordering::Relaxed)
    }

    /// Fails if there is a failure.
    pub fn check(&self) -> Result<()> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner).take();
        first.map_or(Ok(()), |(_, failure)| Err(failure))
    }
}

/// The least limit of pieces and samples.
const FEWEST: f64 = 1e6;
/// The number of pieces and samples per estimated sample and per triangle. Where radii are as steep as possible there
/// are about ten.
const FACTOR: f64 = 64.0;
/// Memory per piece or sample.
const BYTES: f64 = 150.0;

/// The limit of pieces of the surface and samples: far more than estimated, but no more than memory holds.
pub struct Quota {
    used: AtomicU64,
    limit: u64,
}

impl Quota {
    /// The quota for about so many samples.
    pub fn new(estimate: f64, mesh: &Mesh) -> Self {
        let limit = FEWEST + FACTOR * (estimate + mesh.triangles().len() as f64);
        let held = memory::available().map_or(f64::INFINITY, |bytes| bytes / BYTES);
        Self { used: AtomicU64::new(0), limit: limit.min(held) as u64 }
    }

    pub fn take(&self, count: u64) {
        self.used.fetch_add(count, Ordering::Relaxed);
    }

    pub fn is_exceeded(&self) -> bool {
        self.used.load(Ordering::Relaxed) > self.limit
    }

    /// Fails if the quota is exceeded, because of `argument`.
    pub fn check(&self, argument: &'static str) -> Result<()> {
        if !self.is_exceeded() {
            return Ok(());
        }
        let limit = self.limit;
        Err(Error::too_large(argument, format!("asks for more than {limit} samples, and for far fewer at first sight")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_failure_at_the_first_place_counts() {
        let places = [[0.5, 1.0, 2.0], [0.5, 0.25, 7.0], [0.5, 0.25, 8.0], [3.0, -1.0, 0.0]];
        for first in 0..4 {
            let error = FirstError::default();
            assert!(!error.has_failed() && error.check().is_ok());
            for i in (first..4).chain(0..first) {
                error.add(places[i], Error::invalid("radius", i.to_string()));
            }
            assert!(error.has_failed());
            assert_eq!(error.check().unwrap_err().to_string(), "radius: 1");
        }
    }

    #[test]
    fn a_quota_is_exceeded_by_one_more() {
        let quota = Quota { used: AtomicU64::new(0), limit: 1000 };
        quota.take(1000);
        assert!(quota.check("radius").is_ok());
        quota.take(1);
        let said = quota.check("radius").unwrap_err().to_string();
        assert!(quota.is_exceeded() && said.starts_with("radius: asks for more than 1000 samples"), "{said}");
    }
}
