//! `azulejo-studies pixels`: samples of pixels, whose mean is the estimate of what a box filter of one pixel shows:
//! errors of the library's sets beside those of samplers that renderers use.

mod integrands;
mod page;
mod patterns;

use azulejo::{Context, Progress, Result};
use clap::Args;

use crate::args::PageArgs;
use crate::verdict::Mean;
use azulejo_cli::progress::watched;
use integrands::{INTEGRANDS, Pixels};
use patterns::{PATTERNS, Pattern};

/// The first line of the page.
const SUBJECT: &str = "How well sets of azulejo estimate pixels, beside random, stratified and Sobol points.";

#[derive(Args)]
pub struct Study {
    #[command(flatten)]
    page: PageArgs,
}

/// The size of the study.
pub struct Effort {
    /// Pixels along a side of the image.
    pub side: usize,
    /// Images of each sampler and number of samples, each with a seed of its own.
    pub images: u64,
    /// Samples of a pixel: squares of powers of 2, from 1 on.
    pub counts: &'static [usize],
    /// The most samples of a whole image that is relaxed.
    pub relaxed: usize,
}

const FULL: Effort = Effort { side: 32, images: 20, counts: &[1, 4, 16, 64, 256], relaxed: 1 << 14 };
const QUICK: Effort = Effort { side: 8, images: 3, counts: &[1, 4], relaxed: 1 << 8 };

/// The errors of one sampler and number of samples, by integrand: root mean squares over the pixels of an image, of which
/// this is the mean over images.
pub struct Measured {
    pub pattern: Pattern,
    pub count: usize,
    pub errors: [Mean; INTEGRANDS.len()],
}

impl Measured {
    /// None if such a set takes too long.
    fn of(context: &Context, pattern: Pattern, count: usize, effort: &Effort) -> Result<Option<Self>> {
        if pattern == Pattern::RelaxedImage && effort.side * effort.side * count > effort.relaxed {
            return Ok(None);
        }
        let mut errors = vec![Vec::new(); INTEGRANDS.len()];
        for seed in 0..effort.images {
            let samples = pattern.sample(context, effort.side, count, seed)?;
            let pixels = Pixels::new(effort.side, seed);
            for (errors, integrand) in errors.iter_mut().zip(INTEGRANDS) {
                errors.push(pixels.error(integrand, &samples));
            }
        }
        let errors = std::array::from_fn(|i| Mean::of(&errors[i]));
        Ok(Some(Self { pattern, count, errors }))
    }
}

impl Study {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("pixels")?;
        let measure = |progress: &Progress| {
            let mut measured = Vec::new();
            for (done, pattern) in PATTERNS.into_iter().enumerate() {
                for &count in effort.counts {
                    measured.extend(Measured::of(context, pattern, count, &effort)?);
                }
                _ = progress((done + 1) as f64 / PATTERNS.len() as f64);
            }
            Ok(measured)
        };
        let measured = watched("pixels", measure)?;
        files.write("Samples of pixels, measured", SUBJECT, context.num_threads(), &page::text(&effort, &measured))
    }
}
