//! `azulejo plane`: maximal Poisson-disk sets of a rectangle, or of a part of it.

use std::time::Instant;

use azulejo::kdrt::{self, CountOptions};
use azulejo::{Boundary, Context, Domain, Progress, Result};
use clap::Args;

use super::{Common, count, report};
use crate::domain::DomainArgs;
use crate::progress::watched;
use crate::text::rounded;

/// The density of a set of the plane.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct RadiusOrCount {
    /// The smallest distance between samples.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The exact number of samples, such as 65536 or 1e6.
    #[arg(long, value_name = "N", value_parser = count::<u64>)]
    count: Option<u64>,
}

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help("The corners of the rectangle [default: the unit square]")))]
pub struct Plane {
    #[command(flatten)]
    density: RadiusOrCount,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: DomainArgs,
    /// Make only the samples within this part of the rectangle: the same ones that the whole set has there. The file
    /// names the window as its domain, bounded.
    #[arg(
        long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"], allow_negative_numbers = true, conflicts_with = "count"
    )]
    window: Option<Vec<f64>>,
    /// The size of the tiles of which the plane is made, in radii.
    #[arg(long, value_name = "RADII", default_value_t = kdrt::DEFAULT_LEAF_SIZE, allow_negative_numbers = true)]
    leaf_size: f64,
}

/// A set, its domain, and what is said of it.
type Made = (Vec<[f32; 2]>, Domain, String);

impl Plane {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_plane()?;
        let start = Instant::now();
        let (points, domain, about) = match self.density.count {
            Some(count) => self.exactly(count, context)?,
            None => self.at(self.density.radius.unwrap_or(f64::NAN), context)?,
        };
        let seconds = start.elapsed().as_secs_f64();
        output.write_plane(&domain, &points)?;
        report(&output.output, points.len(), &about, seconds);
        Ok(())
    }

    /// A set of this radius, or the part of it in the window.
    fn at(&self, radius: f64, context: &Context) -> Result<Made> {
        let domain = self.domain.or_unit();
        let options = kdrt::Options::new(radius).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let about = format!("radius {}", rounded(radius, 4));
        if let Some(&[x0, y0, x1, y1]) = self.window.as_deref() {
            let window = Domain { min: [x0, y0], max: [x1, y1], boundary: Boundary::Bounded };
            let sample =
                |progress: &Progress| kdrt::sample_window(context, &options, window.min, window.max, Some(progress));
            return Ok((watched("plane", sample)?, window, about));
        }
        let points = watched("plane", |progress| kdrt::sample(context, &options, Some(progress)))?;
        Ok((points, domain, about))
    }

    /// A set of exactly this many samples.
    fn exactly(&self, count: u64, context: &Context) -> Result<Made> {
        let domain = self.domain.or_unit();
        let options = CountOptions::new(count).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let made = watched("plane", |progress| kdrt::sample_count(context, &options, Some(progress)))?;
        let maximal = if made.report.is_maximal { "" } else { ", not maximal" };
        Ok((made.samples, domain, format!("radius {}{maximal}", rounded(made.report.radius, 4))))
    }
}
