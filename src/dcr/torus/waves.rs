//! Removes long waves of the density.
//!
//! Constraints between neighbours cannot detect that a wide region is slightly denser than another, which is why no
//! force that depends on distances alone clears the low frequencies. Here the density is drawn on a grid, and the
//! displacement `u` whose divergence is its relative excess `δ` is found by Fourier transform, `u = -i k δ / k²`, as
//! particle-mesh codes find gravity (Hockney and Eastwood 1981). To first order, points that follow it have a constant
//! density.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, Vec2};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};

use crate::dcr::torus::{MirrorBoundary, TURN, Torus, TorusPoint};
use crate::error::Result;
use crate::job::{Job, chunks, chunks_of};
use crate::math::{exp, power, sin};

/// Waves are removed up to this frequency, in units of sqrt(density), once points have settled.
pub const LONG_WAVES: f64 = 0.25;

/// The width of the grid's cells in spacings. The finest waves that are removed are two cells long. Waves that alias to
/// long ones are about a spacing long, where the spline by which points are drawn has its zero.
const CELL: f64 = 0.9;

/// Waves above this frequency, in units of the highest, would be removed by less than rounding.
const CUTOFF: f64 = 2.4;

/// The number of grids on which points are drawn concurrently.
const LAYERS: usize = 4;

/// The numbers at the nodes of the grid, row by row.
pub type Field = Vec<Complex<f32>>;

/// The grid of a torus.
pub struct WaveGrid {
    torus: Torus,
    /// None for a periodic domain, and if the density at the boundary is to be that of the inside.
    boundary: Option<MirrorBoundary>,
    /// Columns and rows.
    cells: [usize; 2],
    /// The waves along columns and rows.
    bins: [Vec<Bin>; 2],
    /// The transforms along rows and along columns, forward and back.
    forward: [Arc<dyn Fft<f32>>; 2],
    back: [Arc<dyn Fft<f32>>; 2],
}

impl WaveGrid {
    /// The grid for `count` points.
    pub fn new(torus: &Torus, boundary: Option<MirrorBoundary>, count: usize) -> Self {
        Self { boundary, ..Self::of_spacing(torus, count, 1.0) }
    }

    /// The grid for points at a distance of `spacing`, in spacings of the torus; on a strip that is thinner than that
    /// it has no more columns than `count` points need.
    pub fn of_spacing(torus: &Torus, count: usize, spacing: f64) -> Self {
        let limit = (count + 8) as f64 / spacing;
        let along = |length: f64| smooth((length / (CELL * spacing)).ceil().min(limit) as usize);
        let cells = torus.frame.size().to_array().map(along);
        let mut planner = FftPlannerScalar::new();
        let forward = cells.map(|count| planner.plan_fft_forward(count));
        let back = cells.map(|count| planner.plan_fft_inverse(count));
        let bins = [0, 1].map(|axis: usize| bins(cells[axis], torus.frame.size()[axis]));
        Self { torus: *torus, boundary: None, cells, bins, forward, back }
    }

    /// The displacements, in spacings, of the first `count` points, by waves up to the frequency `highest` in units of
    /// sqrt(density), at which the fraction that is removed has fallen to a third.
    pub fn drift(&self, job: &Job, places: &[TorusPoint], count: usize, highest: f64) -> Result<Vec<Vec2>> {
        let density = self.draw(&job.part(0.0, 0.1), places.len(), |point| (places[point], 1.0))?;
        let field = self.displacements(&job.part(0.1, 0.8), density, places.len(), highest)?;
        let chunks = chunks(count);
        job.part(0.8, 1.0).concat(chunks.len(), |chunk| {
            places[chunks.range(chunk)].iter().map(|&place| self.read(&field, place)).collect()
        })
    }

    /// The displacements at the nodes that level a density, which is that of `count` points or the excess over it.
    pub fn displacements(&self, job: &Job, density: Field, count: usize, highest: f64) -> Result<Field> {
        let [width, height] = self.cells;
        let (mut field, mut transposed) = (density, vec![Complex::default(); width * height]);
        transform(&job.part(0.0, 0.1), &mut field, &self.forward[0])?;
        transpose(&job.part(0.1, 0.2), &field, &mut transposed, width)?;
        transform(&job.part(0.2, 0.4), &mut transposed, &self.forward[1])?;
        self.integrate(&job.part(0.4, 0.6), &mut transposed, count, highest)?;
        transform(&job.part(0.6, 0.7), &mut transposed, &self.back[1])?;
        transpose(&job.part(0.7, 0.8), &transposed, &mut field, height)?;
        transform(&job.part(0.8, 1.0), &mut field, &self.back[0])?;
        Ok(field)
    }

    /// The size of a cell, in spacings.
    pub fn cell(&self) -> DVec2 {
        let [columns, rows] = self.cells;
        self.torus.frame.size() / DVec2::new(columns as f64, rows as f64)
    }

    /// The displacement at a point.
    pub fn read(&self, field: &Field, place: TorusPoint) -> Vec2 {
        let mut sums = [Complex::<f32>::default(); 4];
        self.for_each_run(place, |start, weights| {
            let run = &field[start..start + weights.len()];
            sums.iter_mut().zip(run).zip(weights).for_each(|((sum, value), weight)| *sum += value * weight);
        });
        let sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
        Vec2::new(sum.re, sum.im)
    }

    /// Visits the runs of nodes around a point: the first node and the weights, by a cubic B-spline along each axis.
    #[inline(always)]
    fn for_each_run(&self, place: TorusPoint, mut visit: impl FnMut(usize, &[f32])) {
        let [width, height] = self.cells;
        let along = |axis: usize| {
            let scaled = u64::from(place[axis]) * self.cells[axis] as u64;
            let t = scaled as u32 as f32 / TURN as f32;
            let u = 1.0 - t;
            let inner = |x: f32| ((3.0 * x - 6.0) * x * x + 4.0) / 6.0;
            ((scaled >> 32) as usize + self.cells[axis] - 1, [u * u * u / 6.0, inner(t), inner(u), t * t * t / 6.0])
        };
        let ((left, across), (bottom, up)) = (along(0), along(1));
        let left = wrapped(left, width);
        for (j, up) in up.into_iter().enumerate() {
            let row = wrapped(bottom + j, height) * width;
            let weights = across.map(|across| up * across);
            if left + weights.len() <= width {
                visit(row + left, &weights);
            } else {
                // Across the seam of the torus, node by node.
                for (i, weight) in weights.chunks(1).enumerate() {
                    visit(row + wrapped(left + i, width), weight);
                }
            }
        }
    }

    /// The density of `count` weighted points. They are drawn on a fixed number of grids, which are then added up, so
    /// that the sums do not depend on the number of threads.
    pub fn draw(&self, job: &Job, count: usize, weighted: impl Fn(usize) -> (TorusPoint, f32) + Sync) -> Result<Field> {
        let layers = chunks_of(count, count.div_ceil(LAYERS).max(8192));
        let cells = self.cells[0] * self.cells[1];
        let drawn = job.part(0.0, 0.8).map(layers.len(), |layer| {
            let mut density = vec![0.0; cells];
            for (place, whole) in layers.range(layer).map(&weighted) {
                self.for_each_run(place, |start, weights| {
                    // One by one: a run overlaps parts of those before it, so that vector loads would wait for the
                    // stores.
                    (start..).zip(weights).for_each(|(node, weight)| density[node] += whole * weight);
                });
            }
            density
        })?;
        let chunks = chunks_of(cells, 8192);
        job.part(0.8, 1.0).concat(chunks.len(), |chunk| {
            let sum = |cell: usize| Complex::from(drawn.iter().map(|density| density[cell]).sum::<f32>());
            chunks.range(chunk).map(sum).collect()
        })
    }

    /// Turns the waves of the density of `count` points into those of the displacement, `x` in the real and `y` in the
    /// imaginary part: both are real, so one transform carries both. `waves` are given column by column.
    fn integrate(&self, job: &Job, waves: &mut Field, count: usize, highest: f64) -> Result<()> {
        let size = self.torus.frame.size();
        let per_point = (size.x * size.y / count as f64).sqrt() / (TAU * highest);
        let [columns, rows] = &self.bins;
        let finest = self.finest();
        let size = chunks_of(columns.len(), 1 + 8192 / rows.len()).size();
        let parts = waves.chunks_mut(size * rows.len()).zip(columns.chunks(size));
        job.map_each(parts.collect(), |(waves, columns)| {
            for (column, x) in waves.chunks_mut(rows.len()).zip(columns) {
                for (wave, y) in column.iter_mut().zip(rows) {
                    let k = DVec2::new(x.number, y.number);
                    let relative = k.length() * per_point;
                    if k == DVec2::ZERO || relative > CUTOFF || k.length() > finest {
                        *wave = Complex::default();
                        continue;
                    }
                    if let Some(boundary) = &self.boundary {
                        // Through the spline, as points are drawn.
                        *wave -= (boundary.wave([x.turns, y.turns]) * f64::sqrt(x.spline * y.spline)) as f32;
                    }
                    let share = exp(-power(relative, 4)) / (x.spline * y.spline).max(0.01) / count as f64;
                    let integral = DVec2::new(k.y, -k.x) * (share / k.length_squared());
                    *wave *= Complex::new(integral.x as f32, integral.y as f32);
                }
            }
        })?;
        Ok(())
    }

    /// The highest wave number that the grid has in all directions: removing waves up to the corners of the square
    /// would leave a square in the spectrum.
    fn finest(&self) -> f64 {
        let size = self.torus.frame.size().to_array();
        let along = |axis: usize| PI * self.cells[axis] as f64 / size[axis];
        f64::min(along(0), along(1))
    }
}

/// The bins of the transform along an axis of so many cells and of this length.
fn bins(cells: usize, length: f64) -> Vec<Bin> {
    let cells = cells as i64;
    let bin = |bin: i64| {
        let turns = if 2 * bin > cells { bin - cells } else { bin };
        let half = PI * turns as f64 / cells as f64;
        let spline = if bin == 0 { 1.0 } else { power(sin(half) / half, 8) };
        Bin { turns, number: TAU * turns as f64 / length, spline }
    };
    (0..cells).map(bin).collect()
}

/// A bin of waves along an axis.
struct Bin {
    /// Waves per period.
    turns: i64,
    /// Their wave number.
    number: f64,
    /// The factor that the spline applies to them by drawing and reading together.
    spline: f64,
}

/// The remainder of numbers most of which are less than twice the divisor: a division would take longer than all other
/// work for a node.
fn wrapped(number: usize, count: usize) -> usize {
    match number.checked_sub(count) {
        None => number,
        Some(rest) if rest < count => rest,
        Some(rest) => rest % count,
    }
}

/// The least number that is at least `count` and has only the factors 2, 3 and 5, for which transforms are fast.
fn smooth(count: usize) -> usize {
    let rest = |number: usize| {
        [2, 3, 5].iter().fold(number, |rest, factor| {
            let mut rest = rest;
            while rest % factor == 0 {
                rest /= factor;
            }
            rest
        })
    };
    (count.max(1)..).find(|&number| rest(number) == 1).expect("there is always a larger power of two")
}

/// Transforms a field row by row.
fn transform(job: &Job, field: &mut Field, fft: &Arc<dyn Fft<f32>>) -> Result<()> {
    let rows = chunks_of(field.len() / fft.len(), 1 + 8192 / fft.len()).size();
    job.map_each(field.chunks_mut(rows * fft.len()).collect(), |rows| fft.process(rows))?;
    Ok(())
}

/// Transposes a field with rows of this width.
fn transpose(job: &Job, field: &Field, transposed: &mut Field, width: usize) -> Result<()> {
    let height = field.len() / width;
    let columns = chunks_of(width, 1 + 8192 / height).size();
    let parts = transposed.chunks_mut(columns * height).enumerate();
    job.map_each(parts.collect(), |(chunk, part)| {
        for (column, part) in (chunk * columns..).zip(part.chunks_mut(height)) {
            part.iter_mut().zip(field[column..].iter().step_by(width)).for_each(|(to, from)| *to = *from);
        }
    })?;
    Ok(())
}

// Levels sets that are clustered: crowded in some places and empty in others.
//
// In a step a point moves by half a spacing at most, less in a crowd, and where holes are as wide as the domain no
// triangulation can be kept: from a corner, a line or a single place, forces do not spread a set in a hundred steps. So
// before the first step such sets are spread by the displacement `u` that removes long waves, pass after pass. That is
// of first order in the excess; `2 / (1 + √ρ)` times `u`, where the density is `ρ` times the mean, turns a disk of any
// density into one of density 1 in one pass: its radius `r` becomes `r + u = (1 + ρ) r / 2` by `u` alone, but it should
// be `√ρ r`. Clusters of other shapes become lower.

/// The limits up to which forces can even out a set.
pub struct Bounds {
    /// The longest displacement of a point, in spacings, or in cells of the grid if these are wider.
    farthest: f32,
    /// The highest density over the mean.
    densest: f32,
}

/// Sets beyond these bounds are clustered. A million uniform random points are moved by 3.3 and have a density of 3.6;
/// only on domains that are very long for their width they may be moved farther.
pub const CLUSTERED: Bounds = Bounds { farthest: 4.0, densest: 5.0 };

/// Clustered sets are levelled until they are within these bounds: from there they need no more time than random sets.
pub const LEVEL: Bounds = Bounds { farthest: 0.75, densest: 2.0 };

/// A set is also clustered if this many points that follow each other on the curve are within [`CROWDED`] spacings: too
/// small a cluster for the grid to show, but forces would not separate such points. Coincident points, once they are
/// parted, are that close. A million random points have no crowd, except for one set in a thousand.
const CROWD: usize = 3;
const CROWDED: f32 = 0.004;

/// Waves are removed up to this frequency, in units of sqrt(density).
const HIGHEST: f64 = 0.4;

/// The largest number of passes: a single place needs ten.
const PASSES: usize = 24;

/// The displacement of a point, in spacings, and the density there over the mean.
#[derive(Clone, Copy, Default)]
struct Excess {
    displacement: Vec2,
    density: f32,
}

/// A set beyond `bounds` after it was levelled, parted so that no two points coincide; `places` are its points in the
/// order of the curve, and after them their images. None if the set is within the bounds.
pub fn leveled(
    job: &Job,
    torus: &Torus,
    waves: &WaveGrid,
    places: &[TorusPoint],
    bounds: &Bounds,
    seed: u64,
) -> Result<Option<Vec<TorusPoint>>> {
    let count = places.len() / torus.copies();
    let cell = waves.cell().as_vec2().max_element().max(1.0);
    let longest = torus.frame.size().as_vec2() / 4.0;
    let mut bounds = bounds;
    let mut leveled: Option<Vec<TorusPoint>> = None;
    for pass in 0..PASSES {
        let share = |pass: usize| pass as f64 / PASSES as f64;
        let now = leveled.as_deref().unwrap_or(places);
        let excess = excess(&job.part(share(pass), share(pass + 1)), waves, now, count)?;
        let is_beyond = |excess: &Excess| {
            excess.density >= bounds.densest || excess.displacement.length() >= bounds.farthest * cell
        };
        if !excess.iter().any(is_beyond) && !has_crowd(torus, &now[..count]) {
            break;
        }
        bounds = &LEVEL;
        let moved =
            |(&place, excess): (&TorusPoint, &Excess)| torus.moved(place, excess.displacement.clamp(-longest, longest));
        let moved: Vec<TorusPoint> = now.iter().zip(&excess).map(moved).collect();
        leveled = Some(torus.with_images(&moved));
    }
    Ok(leveled.map(|places| torus.parted(&places[..count], seed)))
}

/// The excess at each of the first `count` points.
fn excess(job: &Job, waves: &WaveGrid, places: &[TorusPoint], count: usize) -> Result<Vec<Excess>> {
    let density = waves.draw(&job.part(0.0, 0.2), places.len(), |point| (places[point], 1.0))?;
    let field = waves.displacements(&job.part(0.2, 0.8), density.clone(), places.len(), HIGHEST)?;
    let nodes_per_point = density.len() as f32 / places.len() as f32;
    let chunks = chunks(count);
    job.part(0.8, 1.0).concat(chunks.len(), |chunk| {
        let at = |&place: &TorusPoint| {
            let density = nodes_per_point * waves.read(&density, place).x;
            Excess { displacement: waves.read(&field, place) * (2.0 / (1.0 + density.sqrt())), density }
        };
        places[chunks.range(chunk)].iter().map(at).collect()
    })
}

/// True if there is a crowd among points in the order of the curve.
fn has_crowd(torus: &Torus, places: &[TorusPoint]) -> bool {
    places.windows(CROWD).any(|crowd| {
        let is_near = |&other: &TorusPoint| torus.offset_f32(crowd[0], other).length_squared() < CROWDED * CROWDED;
        crowd.iter().all(is_near)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::torus::CurveOrder;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// A lattice displaced by a long wave along both axes, on a domain that is not square.
    fn wavy(torus: &Torus, side: [u32; 2], height: f64) -> Vec<(TorusPoint, DVec2)> {
        let cells = (0..side[1]).flat_map(|j| (0..side[0]).map(move |i| [i, j]));
        let at = |[i, j]: [u32; 2]| {
            let turns = DVec2::new(f64::from(i) / f64::from(side[0]), f64::from(j) / f64::from(side[1]));
            let wave = DVec2::new((TAU * 2.0 * turns.x).sin(), (TAU * turns.y).cos()) * height;
            let place = turns.to_array().map(|x| (x * 2f64.powi(32)) as u32);
            (torus.moved(place, wave.as_vec2()), wave)
        };
        cells.map(at).collect()
    }

    #[test]
    fn a_long_wave_is_undone() {
        let domain = Domain { min: [0.0; 2], max: [2.0, 1.0], boundary: Boundary::Periodic };
        let side = [60, 30];
        let torus = Torus::new(domain, 1800);
        let (places, displaced): (Vec<_>, Vec<_>) = wavy(&torus, side, 0.1).into_iter().unzip();
        let waves = WaveGrid::new(&torus, None, places.len());
        for threads in [1, 3] {
            let context = Context::new(threads).unwrap();
            let drift = context.run(None, |job| waves.drift(job, &places, places.len(), 0.25)).unwrap();
            for (drift, displaced) in drift.iter().zip(&displaced) {
                assert!((drift.as_dvec2() + *displaced).length() < 0.01, "{drift} undoes {displaced}");
            }
        }
    }

    /// The start of so many points, whose places are made from random numbers, and the levelling of them.
    fn leveled_points(
        boundary: Boundary,
        max: [f64; 2],
        count: usize,
        place: impl Fn(usize, [f64; 2]) -> [f64; 2],
    ) -> Option<Vec<[f64; 2]>> {
        let torus = Torus::new(Domain { min: [0.0; 2], max, boundary }, count);
        let mut rng = Rng::at(9, Draw::Probe, &[count as u64]);
        let points: Vec<[f32; 2]> =
            (0..count).map(|i| place(i, [rng.unit() * max[0], rng.unit() * max[1]]).map(|x| x as f32)).collect();
        let start = torus.with_images(CurveOrder::new(&torus, &points, 1).start());
        let waves = WaveGrid::new(&torus, None, count);
        let [one, three] = [1, 3].map(|threads| {
            Context::new(threads).unwrap().run(None, |job| leveled(job, &torus, &waves, &start, &CLUSTERED, 1)).unwrap()
        });
        assert_eq!(one, three);
        one.map(|places| places.iter().map(|&place| torus.leave(place).map(f64::from)).collect())
    }

    #[test]
    fn random_sets_are_left_alone() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for count in [2, 10, 100, 1000, 30_000] {
                assert_eq!(leveled_points(boundary, [1.0; 2], count, |_, place| place), None, "{boundary:?} {count}");
            }
        }
    }

    /// Each cell of a coarse grid gets its share of the points.
    #[test]
    fn clusters_are_levelled() {
        type Start = fn(usize, [f64; 2]) -> [f64; 2];
        let starts: [Start; 6] = [
            |_, [x, y]| [0.05 * x, 0.05 * y],
            |_, _| [0.5, 0.5],
            |_, [x, _]| [x, 0.3],
            |i, [x, y]| if i % 2 == 0 { [1e-6 * x, 0.1] } else { [0.7, 0.9 + 1e-3 * y] },
            |_, [x, y]| [0.5 * x, y],
            |i, [x, y]| if i % 5 == 0 { [x, y] } else { [0.2 + 0.1 * x, 0.4] },
        ];
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (number, start) in starts.into_iter().enumerate() {
                for max in [[1.0, 1.0], [100.0, 0.01]] {
                    let place = |i: usize, [x, y]: [f64; 2]| {
                        let [x, y] = start(i, [x / max[0], y / max[1]]);
                        [x * max[0], y * max[1]]
                    };
                    let points = leveled_points(boundary, max, 5000, place).unwrap();
                    let mut cells = [0; 25];
                    for [x, y] in points {
                        let cell = match max[1] == 1.0 {
                            true => (5.0 * x) as usize + 5 * (5.0 * y) as usize,
                            false => (25.0 * x / max[0]) as usize,
                        };
                        cells[cell.min(24)] += 1;
                    }
                    let is_level = cells.iter().all(|count: &i32| (count - 200).abs() < 60);
                    assert!(is_level, "start {number}, {boundary:?}, {max:?}: {cells:?}");
                }
            }
        }
    }

    #[test]
    fn small_crowds_are_parted() {
        let points =
            leveled_points(Boundary::Periodic, [1.0; 2], 1000, |i, place| if i < 5 { [0.33, 0.61] } else { place });
        let points = points.unwrap();
        for i in 0..5 {
            let is_apart = |j: usize| (points[i][0] - points[j][0]).hypot(points[i][1] - points[j][1]) > 0.004 * 0.03;
            assert!((0..i).filter(|&j| !is_apart(j)).count() < 2, "{:?}", &points[..5]);
        }
    }
}
