//! Windows of a kept plane, and the plane on two threads.

use azulejo::kdrt::{self, Options, Plane};
use azulejo::{Boundary, Domain, MAXIMAL_DENSITY, Result};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::grouped;

/// Samples of the plane that is kept; those of its windows, and the milliseconds that one may take.
const KEPT: f64 = 1e9;
const WINDOWS: [(f64, f64); 2] = [(2000.0, 0.5), (64.0, 0.25)];
/// Windows that are made in a row: their mean counts.
const PLACES: usize = 50;

/// Samples of the plane that is made on one thread and on two, and the leaf sizes in radii.
const WHOLE: f64 = 1e7;
const LEAVES: [f64; 3] = [20.0, 40.0, 80.0];
const TWO_THREADS: f64 = 1.9;

pub fn section(study: &Study) -> Result<String> {
    let mut rows = windows(study)?;
    rows.extend(threads(study)?);
    let about = format!(
        "A window is the mean of {PLACES} in different places of a plane that is kept; the pattern is made before. A set on two \
         threads is the whole call, pattern included."
    );
    Ok(rows_in("The plane", &about, &rows))
}

/// Windows at places all over a plane of radius 1.
fn windows(study: &Study) -> Result<Vec<Row>> {
    let kept = study.effort.of(KEPT);
    let side = (kept / MAXIMAL_DENSITY).sqrt();
    let domain = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic };
    let plane = Plane::new(&study.one, &Options::new(1.0).domain(domain).seed(1), None)?;
    // Multiples of the golden ratio and of the root of 2 scatter well enough.
    let place = |i: usize| [0.618_033_988_749_895, 0.414_213_562_373_095].map(|ratio| 0.9 * (i as f64 * ratio).fract());
    let all = |samples: f64| {
        let width = (samples / MAXIMAL_DENSITY).sqrt();
        let window = |i: usize| {
            let min = place(i).map(|x| side * x);
            Ok(plane.window(min, min.map(|x| x + width))?.len())
        };
        (1..=PLACES).map(window).sum::<Result<usize>>()
    };
    let calls = WINDOWS.map(|(samples, _)| move || all(samples));
    let [large, small] = &calls;
    let measured = in_turns(study.effort.rounds, &[large, small])?;
    let row = |((samples, goal), rounds): ((f64, f64), &Rounds)| {
        let asked =
            format!("a window of {} samples in a kept plane of {}", grouped(samples as usize), grouped(kept as usize));
        Row::new(asked, Figure::time(rounds, 1e3 / PLACES as f64), "ms", Goal::AtMost(goal))
    };
    Ok(WINDOWS.into_iter().zip(&measured).map(row).collect())
}

/// One thread over two.
fn threads(study: &Study) -> Result<Vec<Row>> {
    let count = study.effort.of(WHOLE);
    let row = |leaves: f64| {
        let options = Options::new((MAXIMAL_DENSITY / count).sqrt()).leaf_size(leaves).seed(1);
        let [one, two] =
            [&study.one, &study.two].map(|context| move || Ok(kdrt::sample(context, &options, None)?.len()));
        let measured = in_turns(study.effort.rounds, &[&one, &two])?;
        let asked = format!("{} samples, leaves of {leaves}r: one thread over two", grouped(measured[0].samples));
        Ok(Row::new(asked, Figure::ratio(&measured[0], &measured[1]), "×", Goal::AtLeast(TWO_THREADS)))
    };
    LEAVES.into_iter().map(row).collect()
}
