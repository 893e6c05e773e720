//! The pattern of local projectors: a maximal periodic Poisson-disk set of radius 1, sorted by cells.

use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;
use crate::psp::project::pattern;

/// The side of the pattern in radii, and the number of its cells along an axis: more than a chart is long, so that no
/// chart meets a point of the pattern in two places of a plane.
const SIDE: i32 = 128;

/// A pattern that repeats along both axes.
pub struct Torus {
    /// The points by cells of side 1, row by row.
    cells: Binned<[f32; 2]>,
}

/// Neighbouring points of a row, and the corner of the repetition that they lie in.
pub struct Run<'a> {
    pub points: &'a [[f32; 2]],
    /// The number of the first of them in the pattern.
    pub first: usize,
    pub corner: [f64; 2],
}

impl Torus {
    pub fn new(job: &Job, seed: u64) -> Result<Self> {
        let (_, points) = pattern::torus(job, f64::from(SIDE), seed)?;
        let cell = |x: f32| (x as usize).min(SIDE as usize - 1);
        let cells = points.iter().map(|&[x, y]| (cell(y) * SIDE as usize + cell(x), [x, y]));
        Ok(Self { cells: Binned::new((SIDE * SIDE) as usize, cells) })
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.cells.items().len()
    }

    /// The points in some cells of a row of the plane that the pattern is repeated on.
    #[inline]
    pub fn runs(&self, row: i32, [first, last]: [i32; 2]) -> impl Iterator<Item = Run<'_>> {
        let start = (row.rem_euclid(SIDE) * SIDE) as usize;
        (first.div_euclid(SIDE)..=last.div_euclid(SIDE)).map(move |repetition| {
            let cell = |column: i32| start + (column - repetition * SIDE).clamp(0, SIDE) as usize;
            let range = self.cells.range(cell(first)..cell(last + 1));
            let corner = [repetition, row.div_euclid(SIDE)].map(|tile| f64::from(tile * SIDE));
            Run { points: &self.cells.items()[range.clone()], first: range.start, corner }
        })
    }
}
