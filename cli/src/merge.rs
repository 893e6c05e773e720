//! `azulejo merge`: sets that were sampled separately, and points that must stay, become one maximal set.

use std::path::PathBuf;
use std::time::Instant;

use azulejo::kdrt::{self, MergeOptions, Piece};
use azulejo::{Boundary, Context, Domain, Error, Result};
use clap::{ArgAction, Args};

use crate::domain::DomainArgs;
use crate::formats::Input;
use crate::formats::points::PointTable;
use crate::generate::{Common, of_radius, report};
use crate::progress::watched;

/// The message about sets that are not of the plane.
const INSTEAD: &str = "only sets of the plane can be merged";

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help("The corners of the rectangle [default: the smallest around the pieces]")))]
pub struct Merge {
    /// The pieces: sets on rectangles that do not overlap. A PLY file names its rectangle, as `azulejo plane` writes
    /// it.
    #[arg(value_name = "PIECE", required_unless_present = "fixed")]
    pieces: Vec<PathBuf>,
    /// Points that are not moved or dropped: they are the first of the output. May be given several times.
    #[arg(long, value_name = "POINTS")]
    fixed: Vec<PathBuf>,
    /// The smallest distance between samples, that of the pieces: above 0, and at least 64 float spacings at the
    /// largest coordinate.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: f64,
    /// The rectangle of a piece whose file does not name it: once for each piece, in their order.
    #[arg(long, num_args = 4, action = ArgAction::Append, value_names = ["X0", "Y0", "X1", "Y1"], allow_negative_numbers = true)]
    rectangle: Vec<f64>,
    /// The pieces are maximal sets of the radius, at least farther than it from their edges, as `azulejo plane` makes
    /// them: only their seams are tested, which takes a fraction of the time.
    #[arg(long)]
    maximal_pieces: bool,
    #[command(flatten)]
    input: Input,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: DomainArgs,
}

impl Merge {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_points()?;
        let loaded = self.load()?;
        let mut fixed = Vec::new();
        for path in &self.fixed {
            fixed.extend(self.input.read_plane(path, INSTEAD)?.points);
        }
        let rectangles: Vec<_> = loaded.iter().map(|piece| piece.rectangle).collect();
        let pieces: Vec<_> = loaded
            .iter()
            .map(|Loaded { rectangle, samples }| Piece { samples, min: rectangle.min, max: rectangle.max })
            .collect();
        let domain = self.domain.or_box_of(&rectangles);
        let options =
            MergeOptions::new(self.radius).domain(domain).seed(self.common.seed).maximal_pieces(self.maximal_pieces);
        let start = Instant::now();
        let merge = |progress: &azulejo::Progress| kdrt::merge(context, &options, &pieces, &fixed, Some(progress));
        let (samples, done) = watched("merge", merge).map_err(|error| self.name_pieces(error))?;
        let seconds = start.elapsed().as_secs_f64();
        output.write_points(&domain, &PointTable::of(&samples.positions))?;
        let about = of_radius(self.radius)
            .count("kept", done.kept, "kept")
            .count("eliminated", done.eliminated, "eliminated")
            .count("inserted", done.inserted, "inserted");
        report(&output.output, samples.len(), about, seconds);
        Ok(())
    }

    /// The error with the files of the pieces where the library has their numbers.
    fn name_pieces(&self, error: Error) -> Error {
        match error {
            Error::InvalidArgument { argument: "pieces", reason } => {
                let named = |reason: String, (i, path): (usize, &PathBuf)| {
                    reason.replace(&format!("[{i}]"), &path.display().to_string())
                };
                let reason = self.pieces.iter().enumerate().fold(reason, named);
                Error::InvalidArgument { argument: "pieces", reason }
            }
            other => other,
        }
    }

    /// The pieces, each with the rectangle that is given for it or that its file names.
    fn load(&self) -> Result<Vec<Loaded>> {
        let given = self.rectangle.as_chunks::<4>().0;
        if !given.is_empty() && given.len() != self.pieces.len() {
            let reason = format!("there are {} for {} pieces", given.len(), self.pieces.len());
            return Err(Error::InvalidArgument { argument: "--rectangle", reason });
        }
        let boundary = Boundary::Bounded;
        let given = given.iter().map(|&[x0, y0, x1, y1]| Some(Domain { min: [x0, y0], max: [x1, y1], boundary }));
        let load = |(path, given): (&PathBuf, Option<Domain>)| {
            let set = self.input.read_plane(path, INSTEAD)?;
            let rectangle = given.or(set.domain).ok_or_else(|| Error::Format {
                path: path.clone(),
                reason: "does not name its rectangle: give --rectangle for each piece".to_owned(),
            })?;
            Ok(Loaded { rectangle, samples: set.points })
        };
        std::iter::zip(&self.pieces, given.chain(std::iter::repeat(None))).map(load).collect()
    }
}

/// A piece and its rectangle.
struct Loaded {
    rectangle: Domain,
    samples: Vec<[f32; 2]>,
}
