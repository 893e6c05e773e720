//! Virtual point lights (thesis fig. 3.22): the errors that the example program prints, of blue-noise lights and of as
//! many random ones.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use azulejo::{Error, Result};
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

use crate::verdict::{self, LEVEL, Mean, chance};

/// As many lights as in the thesis's figure, and fewer, whose errors are seen better.
const COUNTS: [usize; 2] = [2048, 500];
const QUICK_COUNTS: [usize; 1] = [100];
/// Pixels per side of the picture that the program draws, which is not kept: the fewest that it takes.
const PIXELS: &str = "16";

/// The section, by the program `lights` of `examples_c/`.
pub fn section(program: Option<&Path>, quick: bool) -> Result<String> {
    let text = "## Virtual point lights (thesis fig. 3.22)\n\nThe thesis renders a room with 2048 lights and says that blue noise \
        \"can alleviate some singularity problem, though not by a significant deal\"; it gives no figures. Here lights are on all \
        surfaces of a room, blue noise by PSP, an exact number of them, or as many random ones, and what they \
        reflect is gathered by Embree (`examples_c/lights.cpp`, of which [docs/integrating.md](integrating.md) has a picture). \
        The error is the root mean square over places of the picture, against many random lights, over the mean light.";
    let Some(program) = program else {
        return Ok(format!("{text}\n\n**The program was not given (`--lights PROGRAM`) and this is left out.**\n"));
    };
    let counts: &[usize] = if quick { &QUICK_COUNTS } else { &COUNTS };
    let run = |&count| Ok((count, watched("lights", |_| measured(program, count))?));
    let all = counts.iter().map(run).collect::<Result<Vec<_>>>()?;
    let differences: Vec<_> = all.iter().map(|(_, [blue, random])| random.above(blue)).collect();
    let mut text = format!(
        "{text} ± is the standard error, *n* the number of sets, *t* the difference over its standard error (Welch), *p* the chance \
         of as large a one where there is none, corrected for all comparisons (Holm): a claim is met where p is at most {LEVEL}, \
         not met where that of the opposite is, and otherwise not decided.\n\n\
         | claim | below | n | above | n | t | p | |\n|---|---|---|---|---|---|---|---|\n"
    );
    let verdicts = verdict::claims(&differences);
    for (((count, [blue, random]), difference), (p, verdict)) in all.iter().zip(&differences).zip(verdicts) {
        let cell = |Mean { mean, error, count }: &Mean| format!("{mean:.4} ± {error:.4} | {count}");
        let t = difference.map_or("-".to_owned(), |difference| format!("{:+.1}", difference.t));
        let (count, blue, random, p) = (grouped(*count), cell(blue), cell(random), chance(p));
        _ = writeln!(
            text,
            "| error of {count} lights: blue noise below random | {blue} | {random} | {t} | {p} | {verdict} |"
        );
    }
    _ = write!(text, "\nRandom lights have");
    for (i, (count, [blue, random])) in all.iter().enumerate() {
        let join = if i == 0 { "" } else { "," };
        _ = write!(
            text,
            "{join} {:.2} times the error of as many blue-noise ones at {}",
            random.mean / blue.mean,
            grouped(*count)
        );
    }
    Ok(text + ".\n")
}

/// The errors of blue-noise and of random lights.
fn measured(program: &Path, count: usize) -> Result<[Mean; 2]> {
    let failed = |reason: String| Error::Io { path: program.to_owned(), source: std::io::Error::other(reason) };
    let output = Command::new(program)
        .args(["/dev/null", &count.to_string(), PIXELS])
        .output()
        .map_err(|error| failed(error.to_string()))?;
    let said = String::from_utf8_lossy(&output.stdout);
    let errors = ["blue noise:", "random:"].map(|kind| printed(&said, kind));
    match errors {
        [Some(blue), Some(random)] if output.status.success() => Ok([blue, random]),
        _ => Err(failed(format!("printed no errors: {said}{}", String::from_utf8_lossy(&output.stderr)))),
    }
}

/// The line that the program prints of lights of one kind: "40 sets", then "random: error 0.1234 +- 0.0012".
fn printed(said: &str, kind: &str) -> Option<Mean> {
    let (before, _) = said.split_once(" sets")?;
    let (_, errors) = said.split_once(kind)?;
    let (mean, error) = errors.lines().next()?.trim().strip_prefix("error ")?.split_once(" +- ")?;
    let count = before.rsplit(' ').next()?.parse().ok()?;
    Some(Mean { mean: mean.parse().ok()?, error: error.parse().ok()?, count })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_errors_that_the_program_prints_are_read() {
        let said = "500 lights, 240 places, 40 sets each, reference of 500000 lights\n\
                    blue noise: error 0.0512 +- 0.0004\nrandom:     error 0.0712 +- 0.0011\nBlue-noise lights are better\n";
        assert_eq!(printed(said, "blue noise:"), Some(Mean { mean: 0.0512, error: 0.0004, count: 40 }));
        assert_eq!(printed(said, "random:"), Some(Mean { mean: 0.0712, error: 0.0011, count: 40 }));
        assert_eq!(printed("usage: lights", "random:"), None);
    }

    #[test]
    fn a_program_that_fails_is_said() {
        assert!(measured(Path::new("no such program"), 100).is_err() && measured(Path::new("false"), 100).is_err());
    }
}
