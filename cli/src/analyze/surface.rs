//! Samples of a mesh, measured.

use azulejo::analysis::coverage::{surface_coverage, surface_covering_radius};
use azulejo::analysis::differential::{Differences, surface_differences};
use azulejo::analysis::spacing::smallest_distance_3d;
use azulejo::mesh::Mesh;
use azulejo::{Context, Error, Progress, Result};

use super::Set;
use super::figures::{Figure, Row};
use super::plane::{RADIUS_FIGURES, SHALLOW};
use crate::formats::blame;
use crate::generate::MAXIMAL_DENSITY;
use crate::progress::watched;

/// The direction that angles are counted from, and the seed of the random places that pairs are compared with.
const DIRECTION: [f64; 3] = [1.0, 0.0, 0.0];
const SEED: u64 = 0;

/// Where pairs are looked at for a direction, in mean spacings: around the first peak of their distances.
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

/// What is known of all sets.
pub struct Measured {
    pub rows: Vec<Row>,
    /// The differences of all pairs; none if a file has no normals.
    pub differences: Option<Differences>,
}

impl Measured {
    pub fn of(context: &Context, mesh: &Mesh, sets: &[Set], radius: Option<f64>) -> Result<Self> {
        let (mut figures, mut differences) = (Vec::new(), Vec::new());
        watched("measure", |progress: &Progress| {
            for (i, set) in sets.iter().enumerate() {
                figures.push(measure(context, mesh, set, radius).map_err(|error| blame(&set.path, error))?);
                if !set.points.normals.is_empty() {
                    differences.push(differences_of(context, mesh, set).map_err(|error| blame(&set.path, error))?);
                }
                _ = progress((i + 1) as f64 / sets.len() as f64);
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
        Ok(Self { rows, differences })
    }

    /// Frequency and power of the differential spectrum.
    pub fn power(differences: &Differences) -> Vec<[f64; 2]> {
        let frequencies: Vec<_> = (1..=FREQUENCIES).map(|i| i as f64 * FREQUENCY_STEP).collect();
        let power = differences.power(&frequencies);
        std::iter::zip(frequencies, power).map(|(frequency, power)| [frequency, power]).collect()
    }
}

fn measure(context: &Context, mesh: &Mesh, set: &Set, radius: Option<f64>) -> Result<Vec<f64>> {
    let positions = &set.points.positions;
    let smallest = smallest_distance_3d(context, positions, None)?;
    let covering = surface_covering_radius(context, mesh, positions, None)?;
    let maximal = (MAXIMAL_DENSITY * mesh.area() / positions.len() as f64).sqrt();
    let mut figures = vec![positions.len() as f64, smallest, smallest / maximal, covering, covering / maximal];
    if let Some(radius) = radius {
        let gaps = match surface_coverage(context, mesh, positions, radius * (1.0 + SHALLOW), None) {
            Ok(coverage) => coverage.gaps as f64,
            // Where nearly nothing is covered nobody counts gaps.
            Err(Error::TooLarge { .. }) => f64::NAN,
            Err(error) => return Err(error),
        };
        figures.extend([smallest / radius, covering / radius, gaps]);
    }
    Ok(figures)
}

fn differences_of(context: &Context, mesh: &Mesh, set: &Set) -> Result<Differences> {
    surface_differences(context, mesh, &set.points.positions, &set.points.normals, DIRECTION, SEED, None)
}
