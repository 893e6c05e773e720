//! A million samples of each kind: samples, spectrum, zone plate and a rendered scene (thesis fig. 2.12).

mod hall;
mod pictures;

use std::fmt::Write;

use azulejo::analysis::spectrum::Periodogram;
use azulejo::dcr::relax;
use azulejo::kdrt::DEFAULT_LEAF_SIZE;
use azulejo::{Boundary, Context, Domain, Result};

use super::claims::{Claim, Part, cell, number};
use super::study::{Figure, Study, mean_of, timed, times};
use crate::dcr::sets::METHODS;
use crate::gallery::zone_plate;
use crate::kdrt::Sampler;
use crate::reference::{jittered, random};
use crate::verdict::Mean;
use azulejo_cli::draw::spectra::{FREQUENCY_LIMIT, spectrum_up_to};
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};
use hall::Hall;

/// Frequencies per side of a spectrum, at most.
const GRID: usize = 1001;

/// The largest difference of the errors of KDRT from those of the unbiased sampler that counts as "similar", in
/// percent.
const SIMILAR: f64 = 5.0;

/// The columns, as in the thesis, but for the second.
#[derive(Clone, Copy, PartialEq)]
pub enum Column {
    Random,
    /// Relaxed sets, in place of BNOT (de Goes et al. 2012).
    Relaxed,
    /// The flat quadtree: MPS (Ebeida et al. 2012).
    Maximal,
    Kdrt,
}

const COLUMNS: [Column; 4] = [Column::Random, Column::Relaxed, Column::Maximal, Column::Kdrt];

impl Column {
    fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Relaxed => "DCR",
            Self::Maximal => "flat quadtree",
            Self::Kdrt => "KDRT",
        }
    }

    fn sample(self, context: &Context, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        let kdrt = || Sampler::Leaves(DEFAULT_LEAF_SIZE).sample(context, count as f64, seed);
        match self {
            Self::Random => Ok(random(count, seed)),
            Self::Relaxed => {
                let options = METHODS[0].options(Domain::unit(Boundary::Periodic), seed);
                Ok(relax(context, &options, &kdrt()?, None)?.0)
            }
            Self::Maximal => Sampler::Maximal.sample(context, count as f64, seed),
            Self::Kdrt => kdrt(),
        }
    }
}

/// A set: its errors, each a root mean square over pixels, and its seconds.
struct Set {
    plate: zone_plate::Errors,
    hall: f64,
    seconds: f64,
    samples: usize,
}

/// A column of the figure.
pub struct Measured {
    column: Column,
    sets: Vec<Set>,
    spectra: Vec<Periodogram>,
    /// The first set, and the pictures that it makes.
    first: Vec<[f32; 2]>,
    plate: Vec<f64>,
    hall: Vec<f64>,
}

/// The size of each part.
struct Effort {
    count: usize,
    /// Pixels along the side of a picture.
    side: usize,
    /// Sets, and those of relaxed samples, which take long.
    sets: u64,
    relaxed: u64,
    /// Samples along the side of the reference of the hall.
    reference: usize,
}

pub fn section(study: &Study) -> Result<Part> {
    let full = Effort { count: 1_000_000, side: 256, sets: 7, relaxed: 2, reference: 4096 };
    let effort = study.effort(full, Effort { count: 32_000, side: 64, sets: 2, relaxed: 1, reference: 512 });
    let hall = Hall::new(study.effort(64, 8), study.context.num_threads())?;
    let (reference, all) = watched("samplers", |progress| {
        let reference = hall.picture(&jittered(effort.reference, 1), effort.side)?;
        let new =
            |column| Measured { column, sets: vec![], spectra: vec![], first: vec![], plate: vec![], hall: vec![] };
        let mut all = COLUMNS.map(new);
        for seed in 0..effort.sets {
            let due = |measured: &&mut Measured| measured.column != Column::Relaxed || seed < effort.relaxed;
            for measured in all.iter_mut().filter(due) {
                measured.add(study.context, &effort, &hall, &reference, seed)?;
            }
            _ = progress((seed + 1) as f64 / effort.sets as f64);
        }
        Ok((reference, all))
    })?;
    pictures::draw(&all, effort.side, &reference, &study.files.picture("samplers")?)?;
    Ok(Part { text: text(study, &effort, &all), claims: claims(&all), facts: Vec::new() })
}

impl Measured {
    fn add(&mut self, context: &Context, effort: &Effort, hall: &Hall, reference: &[f64], seed: u64) -> Result<()> {
        let (torus, limit) = (Domain::unit(Boundary::Periodic), FREQUENCY_LIMIT + 0.02);
        let (points, seconds) = timed(|| self.column.sample(context, effort.count, seed))?;
        self.spectra.push(spectrum_up_to(context, &torus, &points, effort.count, limit, GRID, None)?);
        let (plate, rendered) = (zone_plate::sampled(&points, effort.side), hall.picture(&points, effort.side)?);
        self.sets.push(Set {
            plate: zone_plate::Errors::of(&plate, effort.side),
            hall: hall::error(&rendered, reference),
            seconds,
            samples: points.len(),
        });
        if seed == 0 {
            (self.first, self.plate, self.hall) = (points, plate, rendered);
        }
        Ok(())
    }
}

/// The names of the errors, and the error of a set.
const ERRORS: [(&str, Figure<Set>); 3] = [
    ("zone plate, low frequencies", |set| set.plate.low),
    ("zone plate, high frequencies", |set| set.plate.high),
    ("hall", |set| set.hall),
];

fn claims(all: &[Measured; 4]) -> Vec<Claim> {
    let [white, _, maximal, kdrt] = all;
    let seconds = |measured: &Measured| mean_of(&measured.sets, |set| set.seconds);
    let better = ERRORS.iter().map(|&(name, error)| {
        let what = format!("error, {name}: KDRT below random (fig. 2.12)");
        Claim::less(what, mean_of(&kdrt.sets, error), mean_of(&white.sets, error))
    });
    let similar = ERRORS.iter().map(|&(name, error)| {
        let apart =
            kdrt.sets.iter().zip(&maximal.sets).map(|(own, other)| 100.0 * (error(own) / error(other) - 1.0).abs());
        let what = format!(
            "percent between the errors of KDRT and flat quadtree, {name} (§2.4.3: \"similar\"; {SIMILAR} here)"
        );
        Claim::less(what, Mean::of(&apart.collect::<Vec<_>>()), number(SIMILAR))
    });
    let faster = Claim::less(
        "seconds: KDRT below flat quadtree (§2.4.3: \"clear advantage in sample generation speed\")",
        seconds(kdrt),
        seconds(maximal),
    );
    better.chain(similar).chain([faster]).collect()
}

fn text(study: &Study, effort: &Effort, all: &[Measured]) -> String {
    let mut text = format!(
        "## Samplers side by side (thesis fig. 2.12)\n\n\
         About {} samples of each, {} sets, of DCR {}. The thesis's columns are random samples, BNOT, MPS and KDRT. BNOT is not implemented; in \
         its place is *DCR*, KDRT's sets relaxed by the {} method. *Flat quadtree* is MPS. From above: a part of the \
         first set; the mean spectrum of all; the zone plate sin(x² + y²) as in [docs/gallery.md](gallery.md), in {} by {} pixels, so with \
         about {} samples a pixel; and a scene seen through as many camera rays. The thesis renders San Miguel with 200 million rays and \
         a path tracer; that scene is not at hand, so this is the hall of [docs/psp.md](psp.md), chequered, in a light that casts no shadows, its \
         picture through the same filter, beside one of {} jittered rays. Errors are root mean squares over pixels. Seconds are those of {} threads.\n\n\
         ![Samples, spectra, zone plates and a hall](tiling/samplers.png)\n\n\
         | sampler | {} | seconds |\n|---|---|---|---|---|\n",
        grouped(effort.count),
        effort.sets,
        effort.relaxed,
        METHODS[0].name,
        effort.side,
        effort.side,
        rounded(effort.count as f64 / (effort.side * effort.side) as f64, 2),
        grouped(effort.reference * effort.reference),
        study.context.num_threads(),
        ERRORS.map(|(name, _)| format!("error, {name}")).join(" | "),
    );
    for Measured { column, sets, .. } in all {
        let errors = ERRORS.map(|(_, error)| cell(&mean_of(sets, error)));
        let seconds: Vec<_> = sets.iter().map(|set| set.seconds).collect();
        let samples = mean_of(sets, |set| set.samples as f64).mean;
        let rate = samples / seconds.iter().copied().fold(f64::INFINITY, f64::min) / 1e6;
        let remark = if *column == Column::Random { String::new() } else { format!(", {} M/s", rounded(rate, 3)) };
        _ = writeln!(text, "| {} | {} | {}{remark} |", column.name(), errors.join(" | "), times(&seconds, 1.0));
    }
    text
}
