//! Sets of a cuboid, measured.

use azulejo::analysis::coverage::coverage_3d;
use azulejo::analysis::space::figures_3d;
use azulejo::analysis::spectrum::{MAX_AXIS_COUNT, axis_power};
use azulejo::{Context, Domain, Error, Progress, Result};

use super::Set;
use super::classes::ByClass;
use super::figures::{Figure, Row};
use super::plane::{RADIUS_FIGURES, SHALLOW};
use crate::formats::blame;
use crate::formats::set::SampleSet;
use crate::progress::{part, watched};

/// The frequencies at which the power on the axes is measured, those around the first ring of blue noise: in waves per mean
/// spacing, 2^(1/6) of which are the distance in the densest packing.
const RING: [f64; 2] = [0.8, 1.4];
const PACKED_SPACING: f64 = 1.122_462_048_309_373;

const FIGURES: [Figure; 7] = [
    Figure::new("points", "points", ""),
    Figure::new("smallest_distance", "smallest distance", ""),
    Figure::new("rho", "smallest distance, relative (ρ)", "densest packing"),
    Figure::new("nearest_mean", "distance of nearest, mean", "densest packing"),
    Figure::new("covering_radius", "covering radius", ""),
    Figure::new("covering_radius_relative", "covering radius, relative", "densest packing"),
    Figure::new("axis_power", "power on the axes, first ring", ""),
];
const CONFLICTS: Figure = Figure::new("conflicts", "pairs nearer than the radius", "");

/// The figures of all sets.
pub struct Measured {
    pub rows: Vec<Row>,
    pub classes: ByClass,
}

impl Measured {
    pub fn of(context: &Context, domain: &Domain<3>, sets: &[Set<SampleSet>], radius: Option<f64>) -> Result<Self> {
        let mut figures = Vec::new();
        watched("measure", |progress: &Progress| {
            for (i, set) in sets.iter().enumerate() {
                let share = |done: f64| (i as f64 + done) / sets.len() as f64;
                let measuring = part(progress, share(0.0), share(1.0));
                let measured = measure(context, domain, &set.loaded.positions, radius, &measuring);
                figures.push(measured.map_err(|error| blame(&set.path, error))?);
            }
            Ok(())
        })?;
        let of_radius = RADIUS_FIGURES.iter().chain([&CONFLICTS]).filter(|_| radius.is_some());
        let row = |(i, &figure): (usize, &Figure)| Row { figure, values: figures.iter().map(|of| of[i]).collect() };
        let rows = FIGURES.iter().chain(of_radius).enumerate().map(row).collect();
        let classes =
            ByClass::of(sets, &FIGURES, |positions, progress| measure(context, domain, positions, None, progress))?;
        Ok(Self { rows, classes })
    }
}

/// The figures of a set, and those of a radius.
fn measure(
    context: &Context,
    domain: &Domain<3>,
    positions: &[[f32; 3]],
    radius: Option<f64>,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let found = figures_3d(context, domain, positions, radius.unwrap_or(0.0), Some(&part(progress, 0.0, 0.5)))?;
    let (rho, mean) = (found.rho(), found.mean / found.packed);
    let relative = found.relative_covering_radius();
    let axes = power_on_axes(context, domain, positions, found.packed / PACKED_SPACING, &part(progress, 0.5, 0.6))?;
    let mut figures = vec![found.count as f64, found.smallest, rho, mean, found.covering_radius, relative, axes];
    if let Some(radius) = radius {
        let counting = part(progress, 0.6, 1.0);
        let gaps = match coverage_3d(context, domain, positions, radius * (1.0 + SHALLOW), Some(&counting)) {
            Ok(coverage) => coverage.gaps as f64,
            // There are too many gaps to count where next to nothing is covered.
            Err(Error::TooLarge { .. }) => f64::NAN,
            Err(error) => return Err(error),
        };
        figures.extend([found.smallest / radius, found.covering_radius / radius, gaps, found.conflicts as f64]);
    }
    Ok(figures)
}

/// The mean power on the three axes in the [`RING`], where planes across them, such as faces of blocks, add up. Unknown if no
/// frequency is in it.
fn power_on_axes(
    context: &Context,
    domain: &Domain<3>,
    positions: &[[f32; 3]],
    spacing: f64,
    progress: &Progress,
) -> Result<f64> {
    let mut power = Vec::new();
    for (axis, length) in domain.extent().into_iter().enumerate() {
        let share = |axis: usize| axis as f64 / 3.0;
        let measuring = part(progress, share(axis), share(axis + 1));
        let [below, last] = RING.map(|frequency| ((frequency * length / spacing) as usize).min(MAX_AXIS_COUNT));
        if below < last {
            power.extend_from_slice(&axis_power(context, domain, positions, axis, last, Some(&measuring))?[below..]);
        }
    }
    Ok(power.iter().sum::<f64>() / power.len() as f64)
}
