//! `azulejo plane`: maximal Poisson-disk sets of a rectangle, or of a part of it.

use std::path::PathBuf;
use std::time::Instant;

use azulejo::kdrt::{self, CountOptions, Kind, Progressive};
use azulejo::{Boundary, Classes, Context, Domain, Points, Progress, Result};
use clap::Args;

use super::around::Around;
use super::{Common, Sequence, count, of_radius, report};
use crate::domain::DomainArgs;
use crate::formats::points::PointTable;
use crate::formats::{Input, blame};
use crate::output::Report;
use crate::progress::watched;
use crate::text::grouped;

/// The message about sets that are not of the plane.
const INSTEAD: &str = "only sets of the plane can be sampled around";

/// The density of a set of the plane.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples: above 0, and at least 64 float spacings at the largest coordinate.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The exact number of samples, such as 65536 or 1e6.
    #[arg(long, value_name = "N", value_parser = count::<u64>)]
    count: Option<u64>,
    /// Several classes of samples with their own radii, such as 0.04,0.02,0.01. The distance of samples of two classes
    /// follows from their radii (Wei 2010). The output, .ply, .npy or .csv, has a column `class`.
    #[arg(long, value_name = "R,R,..", value_delimiter = ',', allow_negative_numbers = true)]
    classes: Option<Vec<f64>>,
}

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help("The corners of the rectangle [default: the unit square]")))]
pub struct Plane {
    #[command(flatten)]
    density: Density,
    /// The factor of the smallest distances between samples of two classes: less than 1 leaves each class nearer to the
    /// density that it has alone, and lets samples of two classes come nearer.
    #[arg(
        long, value_name = "F", default_value_t = 1.0, conflicts_with_all = ["radius", "count"],
        allow_negative_numbers = true
    )]
    class_factor: f64,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: DomainArgs,
    /// A part of the rectangle: only its samples are made, the same as those of the whole set. The file names the
    /// window as its domain, bounded.
    #[arg(
        long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"], allow_negative_numbers = true, conflicts_with = "count"
    )]
    window: Option<Vec<f64>>,
    /// The order of the samples. In progressive order the output has the rank of each sample, except in XYZ and raw
    /// floats.
    #[arg(long, value_enum, default_value = "any")]
    order: Sequence,
    /// The ratio of the radii of two levels of the progressive order, 1.02 to 1.5: every prefix of 100 samples and more
    /// covers the rectangle within this times its last rank [default: 2^(1/8)].
    #[arg(long, value_name = "Q", requires = "order", allow_negative_numbers = true)]
    quotient: Option<f64>,
    /// The radius of the first level of the progressive order, at least that of the set [default: as coarse as the
    /// rectangle].
    #[arg(long, value_name = "R", requires = "order", allow_negative_numbers = true)]
    coarsest: Option<f64>,
    /// Existing points: a .ply, .npy, .csv, .xyz or .raw file. They stay, cover the area within their clearance, and
    /// are not written. The clearance of a point is in the column `clearance` or, without one, `radius`; without either
    /// it is the radius of the set.
    #[arg(long, visible_alias = "around", value_name = "FILE", conflicts_with = "count")]
    given: Option<PathBuf>,
    /// The clearance of all points of `--given`, in place of the columns of their file.
    #[arg(long, value_name = "C", requires = "given", allow_negative_numbers = true)]
    clearance: Option<f64>,
    #[command(flatten)]
    input: Input,
    /// The shortest side of the leaves that tile the rectangle, in radii, at least 6.
    #[arg(long, value_name = "RADII", default_value_t = kdrt::DEFAULT_LEAF_SIZE, allow_negative_numbers = true)]
    leaf_size: f64,
}

/// A set and its domain.
struct Made {
    samples: Points<2>,
    domain: Domain,
    radius: f64,
    about: Report,
}

impl Plane {
    pub fn run(&self, context: &Context) -> Result<()> {
        if let Some(own) = &self.density.classes {
            return self.of_classes(&Classes::of_radii(own, self.class_factor)?, context);
        }
        let output = self.common.destination.open_points()?;
        let start = Instant::now();
        let Made { samples, domain, radius, about } = match self.density.count {
            Some(count) => self.exactly(count, context)?,
            None => self.at(self.density.radius.unwrap_or(f64::NAN), context)?,
        };
        let seconds = start.elapsed().as_secs_f64();
        let table = PointTable { ranks: &samples.ranks, class_radii: &[radius], ..PointTable::of(&samples.positions) };
        output.write_points(&domain, &table)?;
        report(&output.output, samples.len(), about, seconds);
        Ok(())
    }

    /// The levels of a progressive order.
    fn levels(&self) -> Option<Progressive> {
        match self.order {
            Sequence::Any => None,
            Sequence::Progressive => {
                let usual = Progressive::new();
                let (quotient, coarsest) = (self.quotient.unwrap_or(usual.quotient), self.coarsest);
                Some(usual.quotient(quotient).coarsest(coarsest.unwrap_or(usual.coarsest)))
            }
        }
    }

    /// A set of this radius, or the part of it in the window.
    fn at(&self, radius: f64, context: &Context) -> Result<Made> {
        let domain = self.domain.or_unit();
        let kind = self.levels().map_or(Kind::Plain(radius), |levels| Kind::Progressive(radius, levels));
        let around = self.around()?;
        let options = kdrt::Options::of(kind).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let options = options.given(around.given());
        let about = of_radius(radius);
        if let Some(window) = self.window() {
            let sample =
                |progress: &Progress| kdrt::sample_window(context, &options, window.min, window.max, Some(progress));
            return Ok(Made { samples: self.blaming(watched("plane", sample))?, domain: window, radius, about });
        }
        let samples = self.blaming(watched("plane", |progress| kdrt::sample(context, &options, Some(progress))))?;
        Ok(Made { samples, domain, radius, about })
    }

    /// The given points.
    fn around(&self) -> Result<Around<2>> {
        let Some(path) = &self.given else { return Ok(Around::default()) };
        let given = self.input.read_plane(path, INSTEAD)?;
        Ok(Around::new(given.points, given.clearances, self.clearance))
    }

    /// An error about the given points, with their file.
    fn blaming<T>(&self, made: Result<T>) -> Result<T> {
        made.map_err(|error| match &self.given {
            Some(path) => blame(path, error),
            None => error,
        })
    }

    /// The window, if there is one.
    fn window(&self) -> Option<Domain> {
        match self.window.as_deref() {
            Some(&[x0, y0, x1, y1]) => Some(Domain { min: [x0, y0], max: [x1, y1], boundary: Boundary::Bounded }),
            _ => None,
        }
    }

    /// Writes a set of several classes, or the part of it in the window.
    fn of_classes(&self, classes: &Classes, context: &Context) -> Result<()> {
        let output = self.common.destination.open_classes()?;
        let start = Instant::now();
        let around = self.around()?;
        let around = around.of_classes(classes.count());
        let domain = self.domain.or_unit();
        let kind = self.levels().map_or(Kind::Classes(classes), |levels| Kind::ProgressiveClasses(classes, levels));
        let options = kdrt::Options::of(kind).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let options = options.given(around.given());
        let (set, domain) = match self.window() {
            Some(window) => {
                let make = |progress: &Progress| kdrt::Plane::new(context, &options, Some(progress));
                (self.blaming(watched("plane", make))?.window(window.min, window.max)?, window)
            }
            None => {
                let make = |progress: &Progress| kdrt::sample(context, &options, Some(progress));
                (self.blaming(watched("plane", make))?, domain)
            }
        };
        let seconds = start.elapsed().as_secs_f64();
        let own: Vec<_> = (0..classes.count()).map(|class| classes.radius(class, class)).collect();
        let table = PointTable {
            ranks: &set.ranks,
            classes: &set.classes,
            class_radii: &own,
            ..PointTable::of(&set.positions)
        };
        output.write_points(&domain, &table)?;
        report(&output.output, set.len(), shares(classes, &set), seconds);
        Ok(())
    }

    /// A set of exactly this many samples.
    fn exactly(&self, count: u64, context: &Context) -> Result<Made> {
        let domain = self.domain.or_unit();
        let options = CountOptions::new(count).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let options = options.levels(self.levels());
        let (samples, done) = watched("plane", |progress| kdrt::sample_count(context, &options, Some(progress)))?;
        // Progressive sets are maximal at their levels only.
        let is_fault = !done.is_maximal && options.levels.is_none();
        let maximal = if is_fault { "not maximal" } else { "" };
        let about = of_radius(done.radius).fact("maximal", done.is_maximal, maximal);
        Ok(Made { samples, domain, radius: done.radius, about })
    }
}

/// The number of samples of each class.
fn shares(classes: &Classes, set: &Points<2>) -> Report {
    let mut counts = vec![0; classes.count()];
    set.classes.iter().for_each(|&class| counts[class as usize] += 1);
    let text = counts.iter().copied().map(grouped).collect::<Vec<_>>().join(" + ");
    Report::default().fact("classes", counts, format!("by classes {text}"))
}
