//! `azulejo plane`, `surface`, `volume` and `relax`: the samplers of the library, from files and into files.

mod around;
mod attributes;
mod plane;
mod relax;
mod spectrum;
mod surface;
mod volume;

use azulejo::Order;
use clap::{Args, ValueEnum};

use crate::formats::Destination;
use crate::output::{Output, Report};
use crate::text::rounded;

pub use plane::Plane;
pub use relax::Relax;
pub use surface::Surface;
pub use volume::Volume;

/// The arguments that all samplers have.
#[derive(Args)]
pub struct Common {
    #[command(flatten)]
    pub destination: Destination,
    /// Another seed gives another set of the same kind.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
}

/// The order of samples.
#[derive(Clone, Copy, ValueEnum)]
pub enum Sequence {
    /// The fastest order.
    Any,
    /// Coarse to fine: every prefix is blue noise.
    Progressive,
}

impl From<Sequence> for Order {
    fn from(sequence: Sequence) -> Self {
        match sequence {
            Sequence::Any => Self::Any,
            Sequence::Progressive => Self::Progressive,
        }
    }
}

/// A number of samples, at least one, as on the command line: `1000000` or `1e6`.
pub fn count<N: TryFrom<u64>>(text: &str) -> Result<N, String> {
    // Above 2^53 floats are not exact.
    let whole =
        |number: f64| (number.fract() == 0.0 && (0.0..=2f64.powi(53)).contains(&number)).then_some(number as u64);
    let number = text.parse().ok().or_else(|| whole(text.parse().ok()?)).ok_or("not a whole number")?;
    match N::try_from(number) {
        Ok(count) if number > 0 => Ok(count),
        Ok(_) => Err("at least 1 is needed".to_owned()),
        Err(_) => Err("too many".to_owned()),
    }
}

/// The number that was asked for, and the deviation of a count from it.
pub fn compared(count: usize, asked: u64) -> Report {
    let excess = count as f64 / asked as f64 - 1.0;
    let (percent, how) = (rounded(100.0 * excess.abs(), 2), if excess < 0.0 { "fewer" } else { "more" });
    let text = if count as u64 == asked { String::new() } else { format!("{percent} % {how} than asked for") };
    Report::default().fact("asked", asked, text)
}

/// A radius that may differ from the one that was asked for.
pub fn of_radius(radius: f64) -> Report {
    Report::default().fact("radius", radius, format!("radius {}", rounded(radius, 4)))
}

/// Radii that differ from sample to sample.
pub fn of_radii(radii: &[f64]) -> Report {
    let end = |choose: fn(f64, f64) -> f64| radii.iter().copied().reduce(choose).unwrap_or(f64::NAN);
    let ends = [end(f64::min), end(f64::max)];
    let [least, largest] = ends.map(|radius| rounded(radius, 4));
    Report::default().fact("radii", ends.to_vec(), format!("radii {least} to {largest}"))
}

/// The covering radius, in words where it is more than the radius.
pub fn covered(radius: f64, covering_radius: f64) -> Report {
    let text = if covering_radius > radius {
        format!("covered within {}", rounded(covering_radius, 4))
    } else {
        String::new()
    };
    Report::default().fact("covering_radius", covering_radius, text)
}

/// Reports the number of samples that were written, and how they were made.
pub fn report(output: &Output, count: usize, about: Report, seconds: f64) {
    let what = if count == 1 { "sample" } else { "samples" };
    output.report(&Report::default().count("samples", count, what).and(about).seconds(seconds));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_whole_numbers_in_either_notation() {
        let texts = ["1", "1000000", "1e6", "1.5e3", "18446744073709551615"].map(count::<u64>);
        assert_eq!(texts, [1, 1_000_000, 1_000_000, 1500, u64::MAX].map(Ok));
        for text in ["0", "-1", "1.5", "1e-3", "1e300", "nan", "inf", "many", ""] {
            assert!(count::<u64>(text).is_err(), "{text}");
        }
        assert_eq!((count::<u32>("4e9"), count::<u32>("5e9")), (Ok(4_000_000_000), Err("too many".to_owned())));
    }
}
