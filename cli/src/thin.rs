//! `azulejo thin`: some points of a cloud, far from each other, with all that the file has of them.

use std::path::PathBuf;
use std::time::Instant;

use azulejo::thin::{Options, thin};
use azulejo::{Context, Order, Result};
use clap::{Args, ValueEnum};

use crate::formats::{Input, blame};
use crate::generate::count;
use crate::output::{Report, Writing};
use crate::progress::watched;
use crate::text::grouped;

#[derive(Args)]
pub struct Thin {
    /// The cloud: a .ply, .csv, .xyz or .raw file. Of a mesh, the vertices.
    #[arg(value_name = "CLOUD")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    /// The file of the selected points, in the format of the cloud, with all its columns.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// The number of points to select, each the farthest from those before: `1000000` or `1e6`. A smaller cloud is
    /// selected whole.
    #[arg(long, value_name = "N", value_parser = count::<u64>, required_unless_present_any = ["radius", "order"])]
    count: Option<u64>,
    /// The smallest distance between selected points, above 0.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The order of the selected points. In progressive order they get a column `rank`, the distance of each from the
    /// nearest of those before it, where the columns of the file have names: not in .xyz and .raw files.
    #[arg(long, value_enum, default_value = "any")]
    order: Sequence,
    /// Another seed begins the progressive order, or the selection of a count, with another point.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
}

#[derive(Clone, Copy, ValueEnum)]
enum Sequence {
    /// That of the cloud.
    Any,
    /// Coarse to fine, the farthest from those before first; all points without a radius and a count.
    Progressive,
}

impl Thin {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.writing.at(&self.output)?;
        let cloud = self.format.read_cloud(&self.input)?;
        cloud.check_output(&self.output)?;
        if matches!(self.order, Sequence::Progressive) {
            cloud.check_ranks(&self.input)?;
        }
        let order = match self.order {
            Sequence::Any => Order::Any,
            Sequence::Progressive => Order::Progressive,
        };
        let number = self.count.map_or(0, |count| usize::try_from(count).unwrap_or(usize::MAX));
        let options = Options::default()
            .radius(self.radius.map_or(0.0, |radius| cloud.lengthened(radius)))
            .count(number)
            .order(order)
            .seed(self.seed);
        let start = Instant::now();
        let select = |progress: &azulejo::Progress| thin(context, &options, cloud.positions(), Some(progress));
        let selected = watched("thin", select).map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        cloud.write(&output, &selected.indices, &selected.ranks)?;
        let [selected, all] = [selected.indices.len(), cloud.positions().len()];
        let text = format!("{} of {} points", grouped(selected), grouped(all));
        output.report(&Report::default().fact("selected", selected, text).fact("points", all, "").seconds(seconds));
        Ok(())
    }
}
