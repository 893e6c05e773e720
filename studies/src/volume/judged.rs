//! The quality of a set in space, from the points that a sampler returned.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use azulejo::analysis::space::figures_3d;
use azulejo::{Boundary, Context, Domain, Result};
use rustc_hash::FxHasher;

use crate::reference::stream;

/// The quality of a set.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    pub samples: usize,
    /// Pairs nearer than the radius, in `f64`.
    pub conflicts: usize,
    /// The share of the places that are farther than the radius from all samples.
    pub uncovered: f64,
    /// The distance of the worst place from the samples: of a cuboid the covering radius, otherwise of random places.
    pub farthest: f64,
    /// The smallest distance of two samples.
    pub smallest: f64,
    /// The distance of neighbours if as many samples stood in the densest packing of the volume.
    pub packed: f64,
}

type Cells = HashMap<[i64; 3], Vec<[f64; 3]>, BuildHasherDefault<FxHasher>>;

/// Points in cells twice as wide as the radius.
struct Grid {
    side: f64,
    cells: Cells,
}

impl Grid {
    fn cell(&self, point: &[f64; 3]) -> [i64; 3] {
        point.map(|x| (x / self.side).floor() as i64)
    }

    /// The squared distances from a place of the points in the cells up to `ring` around its own, but not nearer ones.
    fn ring(&self, place: &[f64; 3], ring: i64) -> impl Iterator<Item = f64> {
        let ([x, y, z], place) = (self.cell(place), *place);
        let cells = (-ring..=ring).flat_map(move |k| {
            (-ring..=ring).flat_map(move |j| {
                let is_face = k.abs() == ring || j.abs() == ring;
                let row = (-ring..=ring).filter(move |i| is_face || i.abs() == ring);
                row.map(move |i| [x + i, y + j, z + k])
            })
        });
        let points = cells.filter_map(|cell| self.cells.get(&cell)).flatten();
        points.map(move |other| squared(&place, other))
    }

    /// The distance of the nearest point, of which there is one.
    fn nearest(&self, place: &[f64; 3]) -> f64 {
        let mut least = f64::INFINITY;
        // A distance within the rings that have been searched is final.
        for ring in 0i64.. {
            if least.sqrt() <= (ring - 1) as f64 * self.side {
                break;
            }
            least = self.ring(place, ring).fold(least, f64::min);
        }
        least.sqrt()
    }
}

fn squared(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Puts points into cells, and finds the pairs nearer than the radius and the smallest distance, if that is at most two radii.
fn gridded(points: &[[f64; 3]], radius: f64) -> (Grid, usize, f64) {
    let mut grid = Grid { side: 2.0 * radius, cells: Cells::default() };
    let (mut conflicts, mut smallest) = (0, f64::INFINITY);
    for point in points {
        for squared in (0..=1).flat_map(|ring| grid.ring(point, ring)) {
            smallest = smallest.min(squared.sqrt());
            // As squares, and so exactly as azulejo promises it.
            conflicts += usize::from(squared < radius * radius);
        }
        let cell = grid.cell(point);
        grid.cells.entry(cell).or_default().push(*point);
    }
    (grid, conflicts, smallest)
}

/// Judges a set of the unit cube by the radius that was asked for, or that its number stands for.
pub fn of_cuboid(context: &Context, points: &[[f64; 3]], radius: f64, probes: usize) -> Result<Judged> {
    let mut unit = stream(1);
    let places: Vec<[f64; 3]> = (0..probes).map(|_| std::array::from_fn(|_| f64::from(unit()))).collect();
    let judged = at_places(points, radius, &places, 1.0);
    // Some return 1, or what becomes 1 as a float.
    let rounded: Vec<[f32; 3]> =
        points.iter().map(|point| point.map(|x| (x as f32).clamp(0.0, 1.0f32.next_down()))).collect();
    let domain = Domain { min: [0.0; 3], max: [1.0; 3], boundary: Boundary::Bounded };
    let figures = figures_3d(context, &domain, &rounded, 0.0, None)?;
    Ok(Judged { farthest: figures.covering_radius, smallest: figures.smallest.min(judged.smallest), ..judged })
}

/// Judges a set by given places of its volume.
pub fn at_places(points: &[[f64; 3]], radius: f64, places: &[[f64; 3]], volume: f64) -> Judged {
    let (grid, conflicts, smallest) = gridded(points, radius);
    let distances: Vec<f64> = places.iter().map(|place| grid.nearest(place)).collect();
    let uncovered = distances.iter().filter(|&&distance| distance > radius).count();
    Judged {
        samples: points.len(),
        conflicts,
        uncovered: uncovered as f64 / places.len() as f64,
        farthest: distances.into_iter().fold(0.0, f64::max),
        smallest,
        packed: (2f64.sqrt() * volume / points.len() as f64).cbrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_judged_is_what_all_pairs_say() {
        let mut unit = stream(3);
        let mut point = || std::array::from_fn(|_| f64::from(unit()));
        let points: Vec<[f64; 3]> = (0..300).map(|_| point()).collect();
        let places: Vec<[f64; 3]> = (0..100).map(|_| point()).collect();
        let radius = 0.1;
        let judged = at_places(&points, radius, &places, 1.0);
        let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let distances: Vec<f64> = pairs.map(|(i, j)| squared(&points[i], &points[j]).sqrt()).collect();
        assert_eq!(judged.conflicts, distances.iter().filter(|&&distance| distance < radius).count());
        assert_eq!(judged.smallest, distances.iter().copied().fold(f64::INFINITY, f64::min));
        let nearest = |place: &[f64; 3]| points.iter().map(|point| squared(place, point).sqrt()).fold(1e9, f64::min);
        let open = places.iter().filter(|place| nearest(place) > radius).count();
        assert!(open > 10 && open < 90 && judged.uncovered == open as f64 / 100.0, "{open}");
        assert_eq!(judged.farthest, places.iter().map(nearest).fold(0.0, f64::max));
        let context = Context::new(1).unwrap();
        let of_cuboid = of_cuboid(&context, &points, radius, 1000).unwrap();
        assert!(of_cuboid.conflicts == judged.conflicts && of_cuboid.farthest >= judged.farthest);
    }
}
