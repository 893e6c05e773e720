//! `azulejo volume`: maximal Poisson-disk sets of a cuboid.

use std::path::PathBuf;

use azulejo::volume::{Amount, Options, sample};
use azulejo::{Context, Result};
use clap::Args;

use super::around::Around;
use super::{Common, Sequence, count, report};
use crate::domain::CuboidArgs;
use crate::formats::points::PointTable;
use crate::formats::{blame, read_given};
use crate::progress::watched;
use crate::text::rounded;

/// The density of a set of a cuboid.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples: above 0, and at least 64 float spacings at the largest coordinate.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The exact number of samples, such as 65536 or 1e6: the radius is found.
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    count: Option<usize>,
}

#[derive(Args)]
pub struct Volume {
    #[command(flatten)]
    density: Density,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: CuboidArgs,
    /// The order of the samples. In progressive order the output has the rank of each sample, except in XYZ and raw
    /// floats.
    #[arg(long, value_enum, default_value = "any")]
    order: Sequence,
    /// Progressive order: every prefix of 100 samples and more covers the cuboid within this times its last rank, 1.02 to
    /// 1.5 [default: 2^(1/8)].
    #[arg(long, value_name = "Q", requires = "order", allow_negative_numbers = true)]
    quotient: Option<f64>,
    /// Existing points, x y z each: a .ply, .npy, .csv, .xyz or .raw file. They stay, cover the volume within their
    /// clearance, and are not written. The clearance of a point is in the column `clearance` or, without one, `radius`;
    /// without either it is the radius of the set, and a count needs clearances.
    #[arg(long, visible_alias = "around", value_name = "FILE")]
    given: Option<PathBuf>,
    /// The clearance of all points of `--given`, in place of the columns of their file.
    #[arg(long, value_name = "C", requires = "given", allow_negative_numbers = true)]
    clearance: Option<f64>,
}

impl Volume {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_points()?;
        let around = self.around()?;
        let domain = self.domain.or_unit();
        let amount = match self.density.count {
            Some(count) => Amount::Count(count),
            None => Amount::Radius(self.density.radius.unwrap_or(f64::NAN)),
        };
        let options = Options::of(amount);
        let options = options
            .domain(domain)
            .seed(self.common.seed)
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(options.quotient))
            .given(around.given());
        let made = watched("volume", |progress| sample(context, &options, Some(progress)));
        let (samples, done) = made.map_err(|error| match &self.given {
            Some(path) => blame(path, error),
            None => error,
        })?;
        output.write_points(
            &domain,
            &PointTable { ranks: &samples.ranks, class_radii: &[done.radius], ..PointTable::of(&samples.positions) },
        )?;
        let covered = if done.covering_radius > done.radius {
            format!(", covered within {}", rounded(done.covering_radius, 4))
        } else {
            String::new()
        };
        let about = format!("radius {}{covered}", rounded(done.radius, 4));
        report(&output.output, samples.len(), &about, done.seconds);
        Ok(())
    }

    /// The given points.
    fn around(&self) -> Result<Around<3>> {
        let Some(path) = &self.given else { return Ok(Around::default()) };
        let given = read_given(path, [0.0; 3])?;
        Ok(Around::new(given.positions, given.clearances, self.clearance))
    }
}
