//! Levels where the radius varies: maximal sets at ever smaller scales, each around the samples of those before
//! (`psp/levels.rs`).
//!
//! A level is filled with all radii multiplied by its scale, and earlier samples count with theirs at this scale. So
//! distances are measured by the mean of two relative radii, and the properties of levels of one radius hold.

use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::square;
use crate::mesh::Mesh;
use crate::points::{check_resolution, finest_radius};
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::field::{Quota, RadiusField};
use crate::psp::adaptive::options::{Options, Radius, Scale};
use crate::psp::adaptive::pieces::checked_samples;
use crate::psp::adaptive::site::GradedSurface;
use crate::psp::fill::FillOptions;
use crate::psp::fragment::Facing;
use crate::psp::given::Obstacles;
use crate::psp::levels::{self, Levelled, LevelledSet, Levels, Ranked, top};
use crate::psp::samples::Sample;

/// A surface whose radius varies, at any scale.
struct ScaledSurface<'a> {
    mesh: &'a Mesh,
    field: RadiusField<'a>,
    facing: Facing,
    obstacles: &'a Obstacles,
    /// The scale at which the set is expected to be complete, and the approximate number of samples.
    last: f64,
    estimate: f64,
}

impl Ranked for (Sample, f64) {
    fn sample(&self) -> &Sample {
        &self.0
    }
}

impl Levelled for ScaledSurface<'_> {
    type Sample = (Sample, f64);

    fn top(&self) -> f64 {
        top(self.mesh) / self.field.least()
    }

    fn expected(&self, scale: f64) -> f64 {
        self.estimate * square(self.last / scale)
    }

    fn has_given(&self) -> bool {
        !self.obstacles.is_empty()
    }

    fn fill(
        &self,
        job: &Job,
        options: FillOptions,
        scale: f64,
        samples: &[Self::Sample],
    ) -> Result<(Vec<Self::Sample>, u64)> {
        let &Self { mesh, facing, obstacles, last, estimate, .. } = self;
        let (field, quota) = (&self.field.at_scale(scale), &Quota::new(self.expected(scale).max(estimate), mesh));
        let surface = GradedSurface { mesh, field, quota, facing, obstacles, finest: last };
        let (set, darts) = surface.fill(job, options, samples)?;
        Ok((set.into_samples(), darts))
    }
}

/// A set in progressive order: at the radii of the options, or at their density and its scale.
pub fn ordered(
    job: &Job,
    mesh: &Mesh,
    options: &Options,
    density: Option<&DensityField>,
    facing: Facing,
    obstacles: &Obstacles,
) -> Result<LevelledSet<(Sample, f64)>> {
    let spacing = mesh.float_spacing();
    let (last, count) = match (density, options.radius) {
        (Some(density), Radius::Density { scale, .. }) => {
            (density.unit(&job.part(0.0, 0.02), scale)?, whole_count(scale)?)
        }
        _ => (1.0, 0),
    };
    // A level does not depend on where the set ends. So neither does the region where a density requires no samples.
    let finest = density.map_or(1.0, |density| (1.0 + 1e-12) * finest_radius(spacing) * density.largest.sqrt());
    let field = RadiusField::new(mesh, options.radius, density.map(|density| (density, 1.0)), finest)?;
    if count == 0 {
        check_resolution("density", last * field.least(), spacing, "the largest coordinate of the mesh")?;
    }
    let estimate = checked_samples(&job.part(0.02, 0.05), mesh, &field.at_scale(last))?;
    let surface = ScaledSurface { mesh, field, facing, obstacles, last, estimate };
    let (job, start) = (&job.part(0.05, 1.0), Levels::new(surface, options.seed));
    match count {
        0 => levels::by_radius(job, start, options.quotient, last),
        _ => levels::by_count(job, start, options.quotient, count, finest),
    }
}

/// The count, if one is requested; otherwise 0.
fn whole_count(scale: Scale) -> Result<usize> {
    match scale {
        Scale::Radius(_) => Ok(0),
        Scale::Count(count) if count.fract() == 0.0 && count <= f64::from(u32::MAX) => Ok(count as usize),
        Scale::Count(count) => {
            let reason = format!("{count:?} is not a whole number up to {}, which progressive order needs", u32::MAX);
            Err(Error::invalid("count", reason))
        }
    }
}
