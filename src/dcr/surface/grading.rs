//! The spacing that samples shall have at each place: everywhere the same, or as a density asks for.
//!
//! Where it varies, distances are measured as in the plane (`dcr/density`), in the mean of the spacings of two samples:
//! each sample sees its surroundings so, and in that picture all else is as on a mesh of constant density. This stays
//! right to second order in the distance, for a metric that differs from that of space by a factor at each place: the
//! factor half-way between two places is the mean of those at them.
//!
//! A sample's *grade* is its spacing in units of the mean spacing. It stands beside its position.

use crate::dcr::surface::walk::SurfacePoint;
use crate::error::{Error, Result};
use crate::index::{LEVELS, MovingGrid3};
use crate::job::{Job, chunks};
use crate::mesh::Mesh;
use crate::psp::Fragment;
use crate::psp::adaptive::{Density, DensityField, FirstError};
use crate::simd::Position;

use glam::{DVec3, Vec3};

/// The largest grade over the least one of most samples: as where places ask for 64 times as many samples as others.
/// Beside places of density 0 it would grow without bound, and samples that stray there would clear their surroundings.
pub const WIDEST: f32 = (1u32 << (LEVELS - 1)) as f32;

/// The share of all samples whose grades may be below the least one: they are on a few peaks of the density.
const PEAKS: f64 = 1e-3;

/// The grades at the places of a mesh.
pub trait Grading: Sync {
    /// False if all are 1.
    const VARIES: bool;

    /// The grade at a place of the mesh; none where no samples are wanted.
    fn at(&self, mesh: &Mesh, place: SurfacePoint) -> Option<f32>;

    /// The least grade of most samples.
    fn least(&self) -> f32;

    /// The pieces of the surface over which samples are thrown, with the shares of samples that they shall have; none
    /// for whole triangles and their areas.
    fn pieces(&self, job: &Job) -> Result<Option<Vec<(Fragment, f64)>>>;

    /// Fails if the caller's density has.
    fn check(&self) -> Result<()>;

    /// A place as a position, with its grade: 0 where no samples are wanted.
    #[inline]
    fn position(&self, mesh: &Mesh, place: SurfacePoint) -> Position {
        let [x, y, z, _] = place.rounded(mesh);
        [x, y, z, if Self::VARIES { self.at(mesh, place).unwrap_or(0.0) } else { 0.0 }]
    }
}

/// The grade of a position.
#[inline(always)]
pub fn grade<G: Grading>(position: Position) -> f32 {
    if G::VARIES { position[3] } else { 1.0 }
}

/// The factor that takes distances of two samples, in mean spacings, to the mean of their own.
#[inline(always)]
pub fn between<G: Grading>(one: f32, other: f32) -> f32 {
    if G::VARIES { 2.0 / (one + other) } else { 1.0 }
}

/// The level of a grade in a [`MovingGrid3`].
#[inline]
pub fn level<G: Grading>(grading: &G, grade: f32) -> u32 {
    if !G::VARIES {
        return 0;
    }
    // The exponent of the quotient.
    let octave = ((grade / grading.least()).max(1.0).to_bits() >> (f32::MANTISSA_DIGITS - 1)) - 127;
    octave.min(LEVELS - 1)
}

/// The same spacing everywhere.
pub struct Even;

impl Grading for Even {
    const VARIES: bool = false;

    fn at(&self, _: &Mesh, _: SurfacePoint) -> Option<f32> {
        Some(1.0)
    }

    fn least(&self) -> f32 {
        1.0
    }

    fn pieces(&self, _: &Job) -> Result<Option<Vec<(Fragment, f64)>>> {
        Ok(None)
    }

    fn check(&self) -> Result<()> {
        Ok(())
    }
}

/// The spacing that a density asks for.
pub struct Graded<'a> {
    density: DensityField<'a>,
    /// The mean density of the surface.
    mean: f64,
    least: f32,
    first_error: FirstError,
}

impl<'a> Graded<'a> {
    /// Checks the density of the caller.
    pub fn new(job: &Job, mesh: &'a Mesh, density: Density<'a>) -> Result<Self> {
        let density = DensityField::new(mesh, density)?;
        let mut pieces = density.at_pieces(job)?;
        let integral: f64 = pieces.iter().map(|piece| piece.1).sum();
        if integral <= 0.0 {
            return Err(Error::invalid("density", "0 everywhere on the mesh; there is no place for a sample"));
        }
        // The stated largest value of a function, and the brightest pixel of an image, need not be on the surface.
        pieces.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        let mut above = 0.0;
        let is_common = |&&(_, share): &&(f64, f64)| {
            above += share;
            above > PEAKS * integral
        };
        let largest = pieces.iter().find(is_common).map_or(density.largest, |piece| piece.0);
        let mean = integral / mesh.area();
        let least = (mean / largest).sqrt() as f32;
        Ok(Self { density, mean, least, first_error: FirstError::default() })
    }
}

impl Grading for Graded<'_> {
    const VARIES: bool = true;

    fn at(&self, mesh: &Mesh, place: SurfacePoint) -> Option<f32> {
        let position = place.position(mesh).to_array();
        match self.density.at(place.triangle, place.uv.into(), position) {
            Ok(density) if density > 0.0 => {
                let grade = (self.mean / density).sqrt() as f32;
                Some(grade.min(WIDEST * self.least()))
            }
            Ok(_) => None,
            Err(found) => {
                let reason = format!("{found:?} at {position:?} is not in 0..={:?}", self.density.largest);
                self.first_error.add(position, Error::invalid("density", reason));
                None
            }
        }
    }

    fn least(&self) -> f32 {
        self.least
    }

    fn pieces(&self, job: &Job) -> Result<Option<Vec<(Fragment, f64)>>> {
        self.density.pieces(job).map(Some)
    }

    fn check(&self) -> Result<()> {
        self.first_error.check()
    }
}

/// The least distance of two samples over the mean of their grades; infinite for less than two.
///
/// It is searched within a distance over that mean, which grows until there are two samples so near. Of two, the one of
/// the smaller grade finds the other.
pub fn smallest_relative(job: &Job, grading: &impl Grading, low: DVec3, unit: f64, set: &[Position]) -> Result<f64> {
    let place = |&[x, y, z, _]: &Position| Vec3::new(x, y, z);
    let side = unit * f64::from(2.0 * grading.least());
    let mut grid = MovingGrid3::new(low, side, set.iter().map(place));
    let mut widest = 0f64;
    for (sample, position) in (0..).zip(set) {
        widest = widest.max(position[3].into());
        grid.put(sample, place(position), level(grading, position[3]));
    }
    let tasks = chunks(set.len());
    let farthest = set.iter().map(|position| place(position).as_dvec3().distance(low)).fold(0.0, f64::max);
    let mut reach = 1.0;
    loop {
        let least = job.map(tasks.len(), |task| {
            let mut least = f64::INFINITY;
            for (sample, own) in tasks.range(task).map(|sample| (sample as u32, &set[sample])) {
                let (centre, own) = (place(own), f64::from(own[3]));
                for level in level(grading, own as f32)..LEVELS {
                    let largest = f64::from(grading.least()) * f64::from(2u32 << level);
                    let radius = reach * unit * 0.5 * (own + largest.min(widest));
                    grid.within(centre, radius * (1.0 + 1e-6), level, |other, at| {
                        if other != sample {
                            let mean = 0.5 * (own + f64::from(set[other as usize][3]));
                            least = least.min(centre.as_dvec3().distance(at.as_dvec3()) / mean);
                        }
                    });
                }
            }
            least
        })?;
        let least = least.into_iter().fold(f64::INFINITY, f64::min);
        if least <= reach * unit || reach * unit * f64::from(grading.least()) > 4.0 * farthest {
            return Ok(least);
        }
        reach *= 2.0;
    }
}
