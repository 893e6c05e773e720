//! The bias of the sets of each variant: by the angle to the projectors, in their differences, along the projection.

use std::sync::Arc;

use azulejo::analysis::coverage::surface_uncovered_fraction;
use azulejo::analysis::differential::{Differences, surface_differences};
use azulejo::analysis::facing::density_by_facing;
use azulejo::mesh::Mesh;
use azulejo::psp::{ProjectionOptions, Projectors, Psp};
use azulejo::{Context, MAXIMAL_DENSITY, Points, Progress, Result};
use glam::DVec3;

use super::Effort;
use super::scenes::{in_one_piece, radius, sphere};
use super::variants::Variant;
use crate::verdict::Mean;

/// The bins of the density by facing angle, in degrees. No normal is farther than 54.7 degrees from the nearest of
/// three orthogonal directions, and hardly any as far.
pub const FACING_BIN: f64 = 5.0;
const FACING_BINS: usize = 11;

/// Angles between the normal of a plane and the nearest projector, in degrees; the last is equally far from all three.
pub const TILTS: [f64; 3] = [0.0, 30.0, 54.7];

/// The lengths of neighbours, in mean spacings: from about the radius of a maximal set, 0.83.
pub const NEIGHBOURS: std::ops::Range<f64> = 0.8..1.05;

/// Frequencies of the spectra, in units of sqrt(density).
pub fn frequencies() -> Vec<f64> {
    (4..=125).map(|i| 0.02 * f64::from(i)).collect()
}

/// The figures of the sets of one variant.
pub struct Bias {
    pub variant: Variant,
    /// Samples on a sphere, over those of the jamming limit.
    pub count: Mean,
    /// The part of the sphere that is left uncovered.
    pub uncovered: f64,
    /// Density over that of the jamming limit by facing angle, from 0 degrees.
    pub facing: Vec<Mean>,
    /// The power at the [`frequencies`], on the sphere.
    pub power: Vec<f64>,
    /// On planes at the [`TILTS`].
    pub planes: Vec<Tilted>,
}

/// Sets on planes at one angle to their nearest projector.
pub struct Tilted {
    /// Samples over those of the jamming limit. More of them fit along the boundary of the plane.
    pub count: Mean,
    /// The differences; x is the direction in which the pattern is stretched.
    pub differences: Differences,
}

impl Bias {
    /// The largest difference of the spectrum from another.
    pub fn difference(&self, other: &Self) -> f64 {
        self.power.iter().zip(&other.power).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// Frequency and power of the first ring.
    pub fn peak(&self) -> [f64; 2] {
        let points = frequencies().into_iter().zip(&self.power).map(|(frequency, &power)| [frequency, power]);
        points.max_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or_default()
    }

    /// The bias of each of the variants, of which the first is the reference.
    pub fn measure(context: &Context, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let (variants, measure) = (Variant::COMPARED, Measure { context, effort, sphere: sphere()? });
        let of = |(i, variant): (usize, Variant)| {
            measure.of(variant, &|done| progress((i as f64 + done) / variants.len() as f64))
        };
        variants.into_iter().enumerate().map(of).collect()
    }
}

/// The context of all measurements.
struct Measure<'a> {
    context: &'a Context,
    effort: &'a Effort,
    sphere: Arc<Mesh>,
}

impl Measure<'_> {
    fn of(&self, variant: Variant, progress: &Progress) -> Result<Bias> {
        let Self { context, effort, sphere } = self;
        let radius = radius(sphere, variant.count(effort.bias));
        let mesh = if variant.is_one_piece { &in_one_piece(sphere, radius)? } else { sphere };
        let (mut counts, mut differences, mut uncovered) = (Vec::new(), Vec::new(), 0.0);
        let mut facing = vec![Vec::new(); FACING_BINS];
        let mut planes: Vec<_> = TILTS.iter().map(|_| (Vec::new(), Vec::new())).collect();
        let seeds = variant.seeds(effort.seeds);
        let sets = (seeds.end - seeds.start) as f64;
        for (i, seed) in seeds.enumerate() {
            let directions = directions(context, mesh, seed)?;
            let samples = variant.sample(context, mesh, radius, seed)?;
            let over_limit = |samples: f64, area: f64| samples * radius * radius / (area * MAXIMAL_DENSITY);
            counts.push(over_limit(samples.len() as f64, mesh.area()));
            let bins = (90.0 / FACING_BIN) as usize;
            let facings = density_by_facing(mesh, &samples.triangles, &directions, bins)?;
            facing.iter_mut().zip(&facings).for_each(|(all, one)| all.push(over_limit(one.samples as f64, one.area)));
            uncovered +=
                surface_uncovered_fraction(context, mesh, &samples.positions, radius, effort.probes, seed, None)?;
            differences.push(self.differences(mesh, &samples, [0.0, 0.0, 1.0], seed)?);
            for (tilt, (counts, differences)) in TILTS.into_iter().zip(&mut planes) {
                let (mesh, towards) = plane(&directions, (seed % 3) as usize, tilt.to_radians())?;
                let count = variant.count(effort.planes);
                let samples = variant.sample(context, &mesh, self::radius(&mesh, count), seed)?;
                counts.push(samples.len() as f64 / count);
                differences.push(self.differences(&mesh, &samples, towards, seed)?);
            }
            _ = progress((i + 1) as f64 / sets);
        }
        let together = |(counts, differences): (Vec<f64>, Vec<_>)| {
            Ok(Tilted { count: Mean::of(&counts), differences: Differences::together(&differences)? })
        };
        Ok(Bias {
            variant,
            count: Mean::of(&counts),
            uncovered: uncovered / sets,
            facing: facing.iter().map(|densities| Mean::of(densities)).collect(),
            power: Differences::together(&differences)?.power(&frequencies()),
            planes: planes.into_iter().map(together).collect::<Result<_>>()?,
        })
    }

    fn differences(&self, mesh: &Mesh, of: &Points<3>, towards: [f64; 3], seed: u64) -> Result<Differences> {
        surface_differences(self.context, mesh, &of.positions, &of.normals, towards, seed, None)
    }
}

/// The directions of the projectors of a seed's first iteration, on any mesh.
fn directions(context: &Context, mesh: &Arc<Mesh>, seed: u64) -> Result<[[f64; 3]; 3]> {
    let mut psp = Psp::new(mesh, &ProjectionOptions::new(1.0).projectors(Projectors::Global).seed(seed))?;
    psp.advance(context, 1, None)?;
    Ok(psp.directions().expect("there was an iteration"))
}

/// A square at an angle to the `nearest` of three orthogonal directions, equally far from the other two; and the
/// direction in which that one's pattern is stretched on it.
fn plane(directions: &[[f64; 3]; 3], nearest: usize, tilt: f64) -> Result<(Arc<Mesh>, [f64; 3])> {
    let [along, a, b] = [0, 1, 2].map(|i| DVec3::from(directions[(nearest + i) % 3]));
    let aside = (a + b).normalize();
    let towards = aside * tilt.cos() - along * tilt.sin();
    let across = (a - b).normalize();
    let corner = |[x, y]: [f64; 2]| (x * towards + y * across).as_vec3().to_array();
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(corner);
    Ok((Arc::new(Mesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])?), towards.to_array()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_tilted_from_the_nearest_direction() {
        let directions = [[0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 0.8, -0.6]];
        for (nearest, tilt) in [(0, 0.0), (1, 0.3), (2, 0.9)] {
            let (mesh, towards) = plane(&directions, nearest, tilt).unwrap();
            let cosine = |i: usize| {
                let normal = DVec3::from(mesh.normal(0).map(f64::from));
                normal.dot(DVec3::from(directions[i])).abs()
            };
            assert!((cosine(nearest) - tilt.cos()).abs() < 1e-6 && cosine((nearest + 1) % 3) < tilt.cos() + 1e-9);
            assert!((cosine((nearest + 1) % 3) - cosine((nearest + 2) % 3)).abs() < 1e-6);
            // The direction lies in the plane, as steeply towards the projector as it can.
            let steep = DVec3::from(towards).dot(DVec3::from(directions[nearest])).abs();
            assert!((steep - tilt.sin()).abs() < 1e-9 && (mesh.area() - 1.0).abs() < 1e-6);
        }
    }
}
