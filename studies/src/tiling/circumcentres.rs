//! Algorithms 3 and 4 of the thesis, which insert circumcentres, beside filling by darts: bias and time (§2.3.3).

use std::fmt::Write;

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::{nearest_distances_2d, smallest_distance_2d};
use azulejo::kdrt::{MergeOptions, Piece, merge};
use azulejo::{Boundary, Context, Domain, Result};

use super::claims::{Claim, Fact, Part, cell};
use super::spectra::{LIMIT, Reference, contrast, spectrum};
use super::study::{Figure, Study, excess, mean_of, timed, times};
use super::thesis::conquer::eliminate_and_insert;
use super::thesis::divide::{Block, building_blocks};
use super::thesis::tiles::{Laid, Pattern};
use crate::kdrt::{Sampler, radius};
use crate::verdict::Mean;
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

/// R_leaf and the side of the pattern in radii: those with which azulejo tiles.
const LEAVES: [(f64, f64); 2] = [(6.0, 108.0), (20.0, 200.0)];

/// The largest distance of a position from all samples beyond the radius, relative to it, that is rounding to floats.
const ROUNDING: f64 = 1e-4;

/// The methods that repair seams.
#[derive(Clone, Copy, PartialEq)]
enum Repair {
    /// Nothing to repair: the unbiased reference.
    None,
    /// Algorithm 4.
    Circumcentres,
    /// The same blocks with the same positions in the pattern, without margins, by `kdrt::merge`.
    Darts,
    /// All by `kdrt::sample`.
    Kdrt,
}

/// A set and its figures.
struct Set {
    excess: f64,
    contrast: f64,
    deviation: f64,
    /// The mean distance of a sample to the nearest one, in radii.
    nearest: f64,
    changes: Option<Changes>,
    /// The smallest distance and the covering radius, in radii.
    smallest: f64,
    covering: f64,
    seconds: f64,
    samples: usize,
}

struct Row {
    repair: Repair,
    leaf_size: f64,
    sets: Vec<Set>,
}

impl Row {
    fn name(&self) -> String {
        match self.repair {
            Repair::None => "reference".to_owned(),
            Repair::Circumcentres => format!("{}r, Algorithm 4", self.leaf_size),
            Repair::Darts => format!("{}r, darts", self.leaf_size),
            Repair::Kdrt => format!("{}r, azulejo's tiling", self.leaf_size),
        }
    }

    fn nearest_off(&self, reference: f64) -> Mean {
        mean_of(&self.sets, |set| (set.nearest - reference).abs())
    }
}

/// The statistics of a repair.
#[derive(Clone, Copy)]
struct Changes {
    /// Samples that went, and new ones: the last of the set.
    eliminated: usize,
    inserted: usize,
    /// Samples in the conflict area of the thesis.
    processed: Option<usize>,
    /// Iterations of its second loop.
    iterations: Option<usize>,
}

impl Changes {
    /// The number of samples that were laid, of which so many became.
    fn laid(&self, samples: f64) -> f64 {
        samples + self.eliminated as f64 - self.inserted as f64
    }
}

/// Samples, what was done to them where it is known, and the seconds of the repair.
struct Made {
    samples: Vec<[f32; 2]>,
    changes: Option<Changes>,
    seconds: f64,
}

fn make(context: &Context, repair: Repair, (leaf_size, side): (f64, f64), count: f64, seed: u64) -> Result<Made> {
    let radius = radius(count);
    let whole = |sampler: Sampler| {
        let (samples, seconds) = timed(|| sampler.sample(context, count, seed))?;
        Ok(Made { samples, changes: None, seconds })
    };
    let tiles = |margin: f64| {
        let blocks = building_blocks(leaf_size * radius, seed);
        let tiles = Pattern::new(context, radius, side, seed)?.lay(&blocks, margin, seed);
        Ok::<_, azulejo::Error>((blocks, tiles))
    };
    match repair {
        Repair::None => whole(Sampler::Maximal),
        Repair::Kdrt => whole(Sampler::Leaves(leaf_size)),
        Repair::Circumcentres => {
            let (_, tiles) = tiles(radius)?;
            let (made, seconds) = timed(|| Ok(eliminate_and_insert(&tiles, radius)))?;
            let changes = Changes {
                eliminated: made.eliminated,
                inserted: made.inserted,
                processed: Some(made.processed),
                iterations: Some(made.iterations),
            };
            Ok(Made { samples: made.samples, changes: Some(changes), seconds })
        }
        Repair::Darts => {
            let (blocks, tiles) = tiles(0.0)?;
            let inside: Vec<_> = blocks.iter().zip(&tiles).map(|(block, tile)| inside(block, tile)).collect();
            let piece = |(block, samples): (&Block, _)| Piece { samples, min: block.min, max: block.max };
            let pieces: Vec<_> = blocks.iter().zip(inside.iter().map(Vec::as_slice)).map(piece).collect();
            let options = MergeOptions::new(radius).domain(Domain::unit(Boundary::Periodic)).seed(seed);
            let ((samples, report), seconds) = timed(|| merge(context, &options, &pieces, &[], None))?;
            let changes =
                Changes { eliminated: report.eliminated, inserted: report.inserted, processed: None, iterations: None };
            Ok(Made { samples: samples.positions, changes: Some(changes), seconds })
        }
    }
}

/// The samples of a tile whose floats lie in its block.
fn inside(block: &Block, tile: &[Laid]) -> Vec<[f32; 2]> {
    let is_inside =
        |place: &[f32; 2]| (0..2).all(|axis| (block.min[axis]..block.max[axis]).contains(&f64::from(place[axis])));
    tile.iter().map(|laid| laid.place).filter(is_inside).collect()
}

impl Set {
    fn measure(context: &Context, made: &Made, reference: &Reference, count: f64) -> Result<Self> {
        let (torus, radius, samples) = (Domain::unit(Boundary::Periodic), radius(count), &made.samples);
        let spectrum = spectrum(context, samples, count, LIMIT)?;
        let distances = nearest_distances_2d(context, &torus, samples, None)?;
        Ok(Self {
            excess: excess(samples.len(), radius),
            contrast: contrast(&spectrum)?,
            deviation: reference.deviation(&spectrum)?,
            nearest: distances.iter().sum::<f64>() / distances.len() as f64 / radius,
            changes: made.changes,
            smallest: smallest_distance_2d(context, &torus, samples, None)? / radius,
            covering: covering_radius_2d(context, &torus, samples, None)? / radius,
            seconds: made.seconds,
            samples: samples.len(),
        })
    }
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, sets) = study.effort((5e4, 8), (3e3, 2));
    let one = Context::new(1)?;
    let kinds = LEAVES
        .iter()
        .flat_map(|&leaves| [Repair::Circumcentres, Repair::Darts, Repair::Kdrt].map(|repair| (repair, leaves)));
    let kinds: Vec<_> = [(Repair::None, (0.0, 0.0))].into_iter().chain(kinds).collect();
    let mut rows: Vec<_> =
        kinds.iter().map(|&(repair, (leaf_size, _))| Row { repair, leaf_size, sets: Vec::new() }).collect();
    watched("repair", |progress| {
        // The curve is of other seeds than the sets that are held against it.
        let reference = Reference::measure(study.context, count, 100..100 + 2 * sets)?;
        for seed in 0..sets {
            for (row, &(repair, leaves)) in rows.iter_mut().zip(&kinds) {
                let made = make(&one, repair, leaves, count, seed)?;
                row.sets.push(Set::measure(study.context, &made, &reference, count)?);
            }
            _ = progress((seed + 1) as f64 / sets as f64);
        }
        Ok(())
    })?;
    let (claims, facts) = (claims(&rows), facts(&rows));
    Ok(Part { text: text(count, sets, &rows), claims, facts })
}

fn claims(rows: &[Row]) -> Vec<Claim> {
    let nearest = mean_of(&rows[0].sets, |set| set.nearest).mean;
    let of = |repair: Repair, size: f64| rows.iter().find(|row| (row.repair, row.leaf_size) == (repair, size));
    let claims = |(size, _): (f64, f64)| {
        let (Some(ours), Some(theirs)) = (of(Repair::Darts, size), of(Repair::Circumcentres, size)) else {
            return Vec::new();
        };
        let less = |what: &str, figure: &dyn Fn(&Row) -> Mean| {
            Claim::less(format!("{what}, {size}r: darts below Algorithm 4"), figure(ours), figure(theirs))
        };
        vec![
            less("percent that the density is off", &|row| mean_of(&row.sets, |set| set.excess.abs())),
            less("deviation of the radial mean", &|row| mean_of(&row.sets, |set| set.deviation)),
            less("how far the mean distance to the nearest is from the reference's", &|row| row.nearest_off(nearest)),
        ]
    };
    LEAVES.into_iter().flat_map(claims).collect()
}

fn facts(rows: &[Row]) -> Vec<Fact> {
    let repaired = |repair: Repair| rows.iter().filter(move |row| row.repair == repair).flat_map(|row| &row.sets);
    let fact = |(repair, name): (Repair, &str)| {
        let smallest = repaired(repair).map(|set| set.smallest).fold(f64::INFINITY, f64::min);
        let covering = repaired(repair).map(|set| set.covering).fold(0.0, f64::max);
        Fact {
            what: format!("{name}: conflict-free, and maximal up to {ROUNDING:e} r"),
            found: format!("distances from {smallest:.6} r, all places within {covering:.6} r"),
            is_met: smallest >= 1.0 && covering <= 1.0 + ROUNDING,
        }
    };
    let iterations = || repaired(Repair::Circumcentres).filter_map(|set| set.changes?.iterations);
    let ended = Fact {
        what: "Algorithm 4: ends after 2 iterations (§2.3.3: \"needed only 2 iterations\")".to_owned(),
        found: format!("{} to {}", iterations().min().unwrap_or(0), iterations().max().unwrap_or(0)),
        is_met: iterations().all(|iterations| iterations <= 2),
    };
    let names = [(Repair::Circumcentres, "Algorithm 4"), (Repair::Darts, "darts"), (Repair::Kdrt, "azulejo's tiling")];
    names.map(fact).into_iter().chain([ended]).collect()
}

fn text(count: f64, sets: u64, rows: &[Row]) -> String {
    let mut text = format!(
        "## Circumcentres or darts (thesis §2.3.3, Algorithms 3 and 4)\n\n\
         {sets} sets of about {} of each kind. *Algorithm 4* is the thesis's, on the tiles of its Algorithms 1 and 2 with their \
         margins of r, as this command has them: plain code on one thread, which shows what the algorithm does and not how fast \
         it can be made. What the thesis leaves open is said in `studies/src/tiling/thesis/conquer.rs`. *Darts* has the same \
         blocks and positions in the pattern without the margins, repaired by `kdrt::merge`, which throws darts on what is \
         uncovered. *Azulejo's tiling* is `kdrt::sample`, with its pattern. *Excess* is that of the density over an unbiased \
         set's, in percent; contrast is 1 where no part repeats ([docs/kdrt.md](kdrt.md)); *deviation* is how far the radial \
         mean is from that of the reference, root mean square of the power. *Nearest* is the mean distance of a sample to the one \
         nearest to it, in r. *Inserted* samples are percent of the result; *eliminated* ones and those *processed*, in the thesis's conflict area, are percent of \
         those that were laid: the thesis's table 2.2 has 63 % processed at 6r and 21 % at 20r. *Iterations* are those of the second loop of \
         Algorithm 4, the last of which inserts nothing: the thesis needed 2. Nanoseconds are those \
         of the repair per sample of the result, of the other two those of all.\n\n\
         | sets | excess | contrast | deviation | nearest | inserted | eliminated | processed | iterations | ns |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        grouped(count as usize),
    );
    for row in rows {
        let figure = |of: Figure<Set>| cell(&mean_of(&row.sets, of));
        let percent = |of: fn(&Changes, f64) -> Option<f64>| {
            let share = |set: &Set| of(&set.changes?, set.samples as f64).map(|share| 100.0 * share);
            let shares: Option<Vec<_>> = row.sets.iter().map(share).collect();
            shares.map_or("-".to_owned(), |shares| cell(&Mean::of(&shares)))
        };
        let iterations = row.sets.iter().filter_map(|set| set.changes?.iterations);
        let iterations = iterations.clone().min().zip(iterations.max()).map(|(low, high)| format!("{low} to {high}"));
        let per_sample: Vec<_> = row.sets.iter().map(|set| set.seconds / set.samples as f64).collect();
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.name(),
            figure(|set| set.excess),
            figure(|set| set.contrast),
            figure(|set| set.deviation),
            figure(|set| set.nearest),
            percent(|changes, samples| Some(changes.inserted as f64 / samples)),
            percent(|changes, samples| Some(changes.eliminated as f64 / changes.laid(samples))),
            percent(|changes, samples| Some(changes.processed? as f64 / changes.laid(samples))),
            iterations.unwrap_or_else(|| "-".to_owned()),
            times(&per_sample, 1e9),
        );
    }
    text
}
