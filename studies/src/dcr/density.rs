//! Density: images in dots, by PSP alone and relaxed, and how well blurred dots agree with the image (thesis §4.2.3).

mod images;
mod picture;
mod tone;

use std::fmt::Write;
use std::time::Instant;

use azulejo::{Context, Given, Progress, Result};

use super::sets::FIRST_SEED;
use super::study::Study;
use crate::verdict::verdict;
use azulejo_cli::progress::watched;
use azulejo_cli::stipple::darkness::Darkness;
use azulejo_cli::stipple::dots;
use azulejo_cli::text::{grouped, rounded};
use tone::{Tone, WIDTHS};

/// The methods that make dots, in the order of the table.
const METHODS: [&str; 4] = ["random", "PSP", "PSP, relaxed", "random, relaxed"];

/// The methods that are compared with PSP alone, and their names in the table of the goal.
const JUDGED: [(usize, &str); 2] = [(2, "from PSP"), (3, "from random")];

/// Dots that were made by one method, and what they are like.
struct Dots {
    points: Vec<[f32; 2]>,
    /// Errors of tone, by the widths of the filter.
    errors: [f64; WIDTHS.len()],
    /// The smallest distance over the local spacing, and the largest distance from the set.
    rho: f64,
    cover: f64,
    seconds: f64,
}

/// An image in dots, by each of the [`METHODS`].
struct Stippled {
    image: &'static str,
    count: usize,
    dots: Vec<Dots>,
}

/// Measures and writes; the section's text.
pub fn section(study: &Study) -> Result<String> {
    let counts: &[usize] = if study.quick { &[1000] } else { &[10_000, 50_000] };
    let output = study.picture("density")?;
    let mut all = Vec::new();
    for (name, image) in images::all(study.context, study.quick)? {
        for &count in counts {
            let stippled = watched("dots", |progress| Stippled::measure(study.context, name, &image, count, progress))?;
            if name == "knot" && count == counts[0] {
                picture::draw(&image, &stippled.dots.iter().map(|dots| &dots.points[..]).collect::<Vec<_>>(), &output)?;
            }
            all.push(stippled);
        }
    }
    Ok(text(&all, counts[0]))
}

impl Stippled {
    fn measure(
        context: &Context,
        name: &'static str,
        image: &Darkness,
        count: usize,
        progress: &Progress,
    ) -> Result<Self> {
        let tone = Tone::new(image, count);
        let measure = |points: Vec<[f32; 2]>, seconds: f64| -> Result<Dots> {
            let (points, report) = dots::relaxed(context, image, &points, 0, progress)?;
            Ok(Dots {
                errors: tone.errors(&points),
                points,
                rho: report.rho,
                cover: report.relative_covering_radius,
                seconds,
            })
        };
        let relax = |points: &[[f32; 2]]| -> Result<Dots> {
            let start = Instant::now();
            let (points, _) = dots::relaxed(context, image, points, 100, progress)?;
            measure(points, start.elapsed().as_secs_f64())
        };
        let start = Instant::now();
        let points = dots::random(context, image, count, FIRST_SEED)?;
        let random = measure(points, start.elapsed().as_secs_f64())?;
        let start = Instant::now();
        let points = dots::poisson(context, image, count as f64, Given::default(), FIRST_SEED, progress)?;
        let poisson = measure(points, start.elapsed().as_secs_f64())?;
        let relaxed = [relax(&poisson.points)?, relax(&random.points)?];
        Ok(Self { image: name, count, dots: [random, poisson].into_iter().chain(relaxed).collect() })
    }
}

fn text(all: &[Stippled], pictured: usize) -> String {
    let mut text = format!(
        "## Density (thesis §4.2.3)\n\n\
         The thesis has its radii multiplied by a map of the user's, and shows no result. Here images are drawn with dots of one \
         size: a *ramp* from 2 % to black, a shaded *sphere* with a sharp shadow on white, a rendered *knot*, of 512 by 512 \
         pixels. PSP puts a maximal Poisson-disk set on a mesh with a radius for each pixel; random dots are drawn from \
         the density, and there are exactly as many as asked for. Both are relaxed in 100 steps. Settings were chosen on \
         the ramp, the sphere and bars, with another seed and 10,000 dots.\n\n\
         *Error* is that of the tone: dots, each of its share of the ink, and image both go through a Gaussian filter, and \
         the root mean square of their difference over the image is given in parts of full black. The filter's standard \
         deviation is {} times the mean spacing 1 / √(dots / area). *ρ* is the smallest of all distances \
         over the mean of the two local spacings, in units of d_max of the local density, *cover* the largest circumradius in those of \
         the density at its centre. Seconds are those of what the row adds.\n\n\
         ### Goal\n\n\
         Relaxed dots shall have smaller errors than those of PSP alone at every width: times smaller\n\n\
         | image | dots | relaxed | {} | |\n{}|\n",
        WIDTHS.map(|width| rounded(width, 2)).join(", "),
        heads(),
        "|---".repeat(WIDTHS.len() + 4),
    );
    for Stippled { image, count, dots } in all {
        for (method, from) in JUDGED {
            let gains: [f64; WIDTHS.len()] = std::array::from_fn(|i| dots[1].errors[i] / dots[method].errors[i]);
            let (cells, met) =
                (gains.map(|gain| format!("{gain:.1}")).join(" | "), gains.iter().all(|&gain| gain > 1.0));
            _ = writeln!(text, "| {image} | {} | {from} | {cells} | {} |", grouped(*count), verdict(met));
        }
    }
    _ = write!(
        text,
        "\n### Errors\n\n| image | dots | | {} | ρ | cover | seconds |\n{}|\n",
        heads(),
        "|---".repeat(WIDTHS.len() + 6),
    );
    for Stippled { image, dots, .. } in all {
        for (name, dots) in METHODS.iter().zip(dots) {
            let errors = dots.errors.map(|error| format!("{} %", rounded(100.0 * error, 2))).join(" | ");
            let (count, seconds) = (grouped(dots.points.len()), rounded(dots.seconds, 2));
            let (rho, cover) = (dots.rho, dots.cover);
            _ = writeln!(text, "| {image} | {count} | {name} | {errors} | {rho:.3} | {cover:.3} | {seconds} |");
        }
    }
    text + &format!(
        "\n![The knot in {} dots and a detail: random, PSP, PSP relaxed, random relaxed](dcr/density.png)\n",
        grouped(pictured)
    )
}

/// The heads of the columns of widths.
fn heads() -> String {
    WIDTHS.map(|width| format!("width {}", rounded(width, 2))).join(" | ")
}
