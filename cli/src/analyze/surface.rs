//! Samples of a mesh, measured.

use azulejo::analysis::coverage::{surface_coverage, surface_covering_radius};
use azulejo::analysis::differential::{Differences, surface_differences};
use azulejo::analysis::spacing::smallest_distance_3d;
use azulejo::mesh::Mesh;
use azulejo::{Context, Error, MAXIMAL_DENSITY, Progress, Result};

use super::Set;
use super::classes::ByClass;
use super::figures::{Figure, Row};
use super::plane::{RADIUS_FIGURES, SHALLOW};
use crate::formats::blame;
use crate::formats::set::SampleSet;
use crate::progress::{part, watched};

/// The direction that angles are counted from, and the seed of the random points that pairs are compared with.
const DIRECTION: [f64; 3] = [1.0, 0.0, 0.0];
const SEED: u64 = 0;

/// The distances of the pairs whose direction is measured, in mean spacings: around the first peak of all distances.
const NEIGHBOURS: std::ops::Range<f64> = 0.5..1.5;

/// Frequencies of the power spectrum, in units of sqrt(density).
const FREQUENCIES: usize = 250;
const FREQUENCY_STEP: f64 = 0.01;

const FIGURES: [Figure; 5] = [
    Figure::new("samples", "samples", ""),
    Figure::new("smallest_distance", "smallest distance", ""),
    Figure::new("smallest_relative", "smallest distance, relative", "radius of a maximal set"),
    Figure::new("covering_radius", "covering radius", ""),
    Figure::new("covering_relative", "covering radius, relative", "radius of a maximal set"),
];
const ELONGATION: Figure = Figure::new("elongation", "elongation of p(d) along x", "");

/// The figures and curves of all sets.
pub struct Measured {
    pub rows: Vec<Row>,
    /// The differences of all pairs; none if a file has no normals.
    pub differences: Option<Differences>,
    pub classes: ByClass,
}

impl Measured {
    pub fn of(context: &Context, mesh: &Mesh, sets: &[Set<SampleSet>], radius: Option<f64>) -> Result<Self> {
        let (mut figures, mut differences) = (Vec::new(), Vec::new());
        watched("measure", |progress: &Progress| {
            for (i, set) in sets.iter().enumerate() {
                let blamed = |error| blame(&set.path, error);
                let share = |done: f64| (i as f64 + done) / sets.len() as f64;
                let measuring = part(progress, share(0.0), share(0.4));
                figures.push(measure(context, mesh, &set.loaded.positions, radius, &measuring).map_err(blamed)?);
                if !set.loaded.normals.is_empty() {
                    let comparing = part(progress, share(0.4), share(1.0));
                    differences.push(differences_of(context, mesh, set, &comparing).map_err(blamed)?);
                }
            }
            Ok(())
        })?;
        let names = FIGURES.iter().chain(RADIUS_FIGURES.iter().filter(|_| radius.is_some()));
        let row = |(i, &figure): (usize, &Figure)| Row { figure, values: figures.iter().map(|of| of[i]).collect() };
        let mut rows: Vec<_> = names.enumerate().map(row).collect();
        let differences =
            if differences.len() == sets.len() { Some(Differences::together(&differences)?) } else { None };
        let elongation = differences.as_ref().map(|differences| differences.elongation(NEIGHBOURS));
        rows.extend(elongation.map(|value| Row { figure: ELONGATION, values: vec![value] }));
        let classes =
            ByClass::of(sets, &FIGURES, |positions, progress| measure(context, mesh, positions, None, progress))?;
        Ok(Self { rows, differences, classes })
    }

    /// Frequency and power of the differential spectrum.
    pub fn power(differences: &Differences) -> Vec<[f64; 2]> {
        let frequencies: Vec<_> = (1..=FREQUENCIES).map(|i| i as f64 * FREQUENCY_STEP).collect();
        let power = differences.power(&frequencies);
        std::iter::zip(frequencies, power).map(|(frequency, power)| [frequency, power]).collect()
    }
}

fn measure(
    context: &Context,
    mesh: &Mesh,
    positions: &[[f32; 3]],
    radius: Option<f64>,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let smallest = smallest_distance_3d(context, positions, Some(&part(progress, 0.0, 0.1)))?;
    let covering = surface_covering_radius(context, mesh, positions, Some(&part(progress, 0.1, 0.5)))?;
    let maximal = (MAXIMAL_DENSITY * mesh.area() / positions.len() as f64).sqrt();
    let mut figures = vec![positions.len() as f64, smallest, smallest / maximal, covering, covering / maximal];
    if let Some(radius) = radius {
        let counting = part(progress, 0.5, 1.0);
        let gaps = match surface_coverage(context, mesh, positions, radius * (1.0 + SHALLOW), Some(&counting)) {
            Ok(coverage) => coverage.gaps as f64,
            // There are too many gaps to count where next to nothing is covered.
            Err(Error::TooLarge { .. }) => f64::NAN,
            Err(error) => return Err(error),
        };
        figures.extend([smallest / radius, covering / radius, gaps]);
    }
    Ok(figures)
}

fn differences_of(context: &Context, mesh: &Mesh, set: &Set<SampleSet>, progress: &Progress) -> Result<Differences> {
    surface_differences(context, mesh, &set.loaded.positions, &set.loaded.normals, DIRECTION, SEED, Some(progress))
}
