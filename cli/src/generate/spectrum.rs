//! Spectra that `azulejo relax` gives sets: by name, or those of another set.

use std::path::Path;
use std::str::FromStr;

use azulejo::analysis::distribution::radial_distribution;
use azulejo::dcr::PairCorrelation;
use azulejo::{Context, Domain, Result};

/// The most that is measured of another set, in units of d_max, and the bins of it.
const REACH: f64 = 12.0;
const BIN: f64 = 0.005;

/// A spectrum by its name, or the path of a set that has it.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    Step(f64),
    Peak { frequency: f64, width: f64, height: f64 },
    OfSet(String),
}

impl FromStr for Spectrum {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let mut parts = text.split(':');
        let (name, numbers) = (parts.next().unwrap_or_default(), parts.map(str::parse).collect::<Vec<_>>());
        let number = |index: usize, default: f64| match numbers.get(index) {
            None => Ok(default),
            Some(number) => number.clone().map_err(|_| format!("`{text}` has something else than numbers")),
        };
        match (name, numbers.len()) {
            ("step", 0..=1) => Ok(Self::Step(number(0, 0.5)?)),
            ("peak", 0..=3) => {
                Ok(Self::Peak { frequency: number(0, 0.6)?, width: number(1, 0.06)?, height: number(2, 1.0)? })
            }
            ("step" | "peak", _) => Err(format!("`{text}` has too many numbers")),
            _ => Ok(Self::OfSet(text.to_owned())),
        }
    }
}

impl Spectrum {
    /// The pair correlation; `read` gives the points and the domain of a set.
    pub fn correlation(
        &self,
        context: &Context,
        read: impl FnOnce(&Path) -> Result<(Vec<[f32; 2]>, Domain)>,
    ) -> Result<PairCorrelation> {
        match self {
            &Self::Step(frequency) => PairCorrelation::step(frequency),
            &Self::Peak { frequency, width, height } => PairCorrelation::peak(frequency, width, height),
            Self::OfSet(path) => {
                let (points, domain) = read(Path::new(path))?;
                let [width, height] = domain.extent();
                let reach = REACH.min(0.499 * width.min(height) / domain.hexagonal_distance(points.len().max(1)));
                let bins = (reach / BIN).ceil() as usize;
                let measured = radial_distribution(context, &domain, &points, reach, bins.max(1), None)?;
                // Over the density of all points instead of that of all others.
                let share = 1.0 - 1.0 / points.len() as f64;
                let values: Vec<f64> = measured.density().iter().map(|value| value * share).collect();
                PairCorrelation::new(reach, &values)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectra_have_names_with_numbers_or_are_files() {
        let read = |text: &str| text.parse::<Spectrum>();
        assert_eq!(read("step"), Ok(Spectrum::Step(0.5)));
        assert_eq!(read("step:0.4"), Ok(Spectrum::Step(0.4)));
        let peak = Spectrum::Peak { frequency: 0.7, width: 0.1, height: 1.0 };
        assert_eq!(read("peak:0.7:0.1"), Ok(peak));
        assert_eq!(read("steps.ply"), Ok(Spectrum::OfSet("steps.ply".to_owned())));
        assert_eq!(read("step:x"), Err("`step:x` has something else than numbers".to_owned()));
        assert_eq!(read("step:1:2"), Err("`step:1:2` has too many numbers".to_owned()));
        assert!(read("peak:1:2:3:4").is_err());
    }
}
