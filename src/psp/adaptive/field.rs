//! The radius as a function on the surface: its value at a sample, and its bounds on a fragment.
//!
//! A sample is not exactly where its dart fell: its position and its barycentrics are rounded. This can bring its radius
//! out of the bounds of its fragment, but by no more than a quarter of the least radius. Of a function the slope is
//! limited for this. Of vertices, the barycentrics change the radius by 2^-24 of the difference of two corners, at most
//! four diagonals; these are at most 14 float spacings, and no radius is below 64.
//!
//! Levels of an ordered set (`levels.rs`) multiply all radii with a *scale*. Radii without it are *relative*; those
//! of a sample are. Whatever is compared with lengths has been multiplied: bounds, and what follows from them.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::math::{scalbn, square};
use crate::mesh::{Mesh, exact};
use crate::points::check_resolution;
use crate::psp::adaptive::bounds::{RadiusBounds, of_function, of_vertices};
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::limits::Verdict;
use crate::psp::adaptive::radius::{Radius, RadiusFunction};
use crate::psp::fill::rounds::TOLERANCE;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::samples::Sample;

/// Bounds that are no farther apart than this share of the longest edge of a fragment are good enough for it: what is
/// proved covered falls short of what is by half of that.
const FLAT: f64 = 0.1;

/// How much, as a share, rounding can add to a radius.
const ROUNDING: f64 = 1e-9;

/// On a piece of the surface where a density falls to nothing radii are at most this many times the least one: it has
/// one radius as far as lengths and octaves go. The few samples that this adds stand at less than a sixteenth of the
/// piece's largest density.
const STEEPEST: f64 = 4.0;

/// Where the radius comes from.
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
pub(super) struct RadiusField<'a> {
    mesh: &'a Mesh,
    source: Source<'a>,
    /// What all radii are multiplied by: 1, but on levels.
    scale: f64,
    /// Relative bounds for the whole surface.
    all: RadiusBounds,
    /// A relative radius. At the finest scale a sample of twice this radius excludes all others, so larger radii are
    /// taken as this. A density that asks for it asks for nothing.
    limit: f64,
    /// How far rounding moves a sample at most.
    rounding: f64,
    /// What is wrong with the radii.
    verdict: Verdict,
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
        check_resolution(argument, scale * all.least, spacing, "the largest coordinate of the mesh")?;
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
        Ok(Self { mesh, source, scale, all, limit, rounding, verdict: Verdict::default() })
    }

    /// The argument that asks for too many samples where there are too many.
    pub fn argument(&self) -> &'static str {
        match self.source {
            Source::Vertices(_) => "vertex_radii",
            Source::Function { .. } => "radius",
            Source::Density { .. } => "density",
        }
    }

    /// The same radii at another scale.
    pub fn at_scale(&self, scale: f64) -> Self {
        Self { scale, ..self.apart() }
    }

    /// What relative radii are multiplied by.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The least relative radius.
    pub fn least(&self) -> f64 {
        self.all.least
    }

    /// RadiusBounds for the whole surface.
    pub fn all(&self) -> RadiusBounds {
        RadiusBounds { least: self.scale * self.all.least, largest: self.scale * self.all.largest }
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
            Source::Density { .. } if !self.is_nothing(self.scale * radius) => {
                radius.clamp(bounds.least / self.scale, bounds.largest / self.scale)
            }
            _ => radius,
        }
    }

    /// Whether a radius is that of a density which asks for no samples.
    pub fn is_nothing(&self, radius: f64) -> bool {
        matches!(self.source, Source::Density { .. }) && radius >= self.scale * self.limit
    }

    /// Bounds for a piece of the surface that the radius does not change much on: of density, no farther apart than
    /// [`STEEPEST`].
    pub fn settled(&self, bounds: RadiusBounds) -> RadiusBounds {
        match self.source {
            Source::Density { .. } => RadiusBounds { largest: bounds.largest.min(STEEPEST * bounds.least), ..bounds },
            _ => bounds,
        }
    }

    /// RadiusBounds on a fragment that is part of one with bounds `within`.
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
                let change = self.scale * slope * shape.extent;
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
                // What asks for nothing is told from what asks for little. On a settled piece even the least radius of
                // a part may be above what is taken for the largest.
                if self.is_nothing(least) {
                    return RadiusBounds { least, largest: least };
                }
                let [least, largest] = [least, largest].map(|radius| radius.min(within.largest).max(within.least));
                RadiusBounds { least, largest }
            }
        }
    }

    /// Bounds on a fragment that is part of one with bounds `within`: these, where they are good enough.
    pub fn narrowed(&self, fragment: &Fragment, shape: &Shape, within: RadiusBounds) -> RadiusBounds {
        if within.largest - within.least <= FLAT * shape.longest {
            within
        } else {
            self.bounds(fragment, shape, within)
        }
    }

    /// Radii for the corners of a fragment with these bounds, such that no point of it has a smaller one than these give
    /// it when they change evenly.
    pub fn radii_from(&self, fragment: &Fragment, bounds: RadiusBounds) -> [f64; 3] {
        match self.source {
            Source::Vertices(radii) => {
                fragment.corners.map(|corner| self.scale * self.interpolate(radii, fragment.triangle, corner))
            }
            Source::Function { .. } | Source::Density { .. } => [bounds.least; 3],
        }
    }

    /// What is known of the radius at a sample of a fragment with these bounds, unless a function is called for it.
    pub fn known_at(&self, sample: &Sample, bounds: RadiusBounds) -> RadiusBounds {
        if self.calls_functions() {
            return bounds;
        }
        let radius = self.scale * self.at_within(sample, bounds);
        RadiusBounds { least: radius, largest: radius }
    }

    /// What no radius on a fragment exceeds, even where rounding has moved a sample.
    pub fn above(&self, bounds: RadiusBounds) -> f64 {
        let slack = match self.source {
            // The barycentrics, with the difference of two corners.
            Source::Vertices(_) => scalbn(1.0, -22) * self.all().largest,
            Source::Function { slope, .. } => self.scale * slope * self.rounding,
            Source::Density { .. } => 0.0,
        };
        bounds.largest * (1.0 + ROUNDING) + slack
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

    /// The same radii with a verdict of their own, for one task: what it finds out depends on no other.
    pub fn apart(&self) -> Self {
        Self { verdict: Verdict::default(), ..*self }
    }

    /// Fails where the radii have failed.
    pub fn check(&self) -> Result<()> {
        self.verdict.check()
    }

    /// Whether the radii have failed: the rest of the work is in vain.
    pub fn has_failed(&self) -> bool {
        self.verdict.is_given()
    }

    /// Fails since too much work is of no avail.
    pub fn give_up(&self, place: DVec3) {
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
        self.verdict.add(place, Error::too_large(argument, reason));
    }

    fn interpolate(&self, radii: &[f32], triangle: u32, [u, v]: [f64; 2]) -> f64 {
        let corners = self.mesh.triangles()[triangle as usize];
        let [a, b, c] = corners.map(|vertex| f64::from(radii[vertex as usize]).min(self.limit));
        (1.0 - u - v) * a + u * b + v * c
    }

    /// Whether the caller's function is called for a radius.
    fn calls_functions(&self) -> bool {
        match self.source {
            Source::Vertices(_) => false,
            Source::Function { .. } => true,
            Source::Density { density, .. } => density.slope().is_some(),
        }
    }

    /// The relative radius that the caller's function gives, or the least it may give if that is nothing good.
    fn call(&self, at: &RadiusFunction, position: [f64; 3]) -> f64 {
        let Source::Function { smallest, largest, .. } = self.source else { return self.all.least };
        let radius = at(position);
        if !(smallest..=largest).contains(&radius) {
            let reason = format!("{radius:?} at {position:?} is not in {smallest:?}..={largest:?}");
            self.verdict.add(position, Error::invalid("radius", reason));
            return self.all.least;
        }
        radius.min(self.limit)
    }

    /// The density at a place of a triangle, or the largest if a function gives nothing good.
    fn density(&self, triangle: u32, uv: [f64; 2], position: DVec3) -> f64 {
        let Source::Density { density, .. } = self.source else { return 0.0 };
        density.at(triangle, uv, position.to_array()).unwrap_or_else(|found| {
            let (place, largest) = (position.to_array(), density.largest);
            let reason = format!("{found:?} at {place:?} is not in 0..={largest:?}");
            self.verdict.add(place, Error::invalid("density", reason));
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

    /// Tests a radius at a place with the bounds that a slope gave for it. A density has to keep only the lower one.
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
            let argument = if self.argument() == "density" { "density" } else { "radius" };
            self.verdict.add(place, Error::invalid(argument, reason));
        }
    }
}
