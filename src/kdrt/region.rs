//! Samples of a part of the plane, from which those of any smaller part can be extracted.

use crate::index::Binned;
use crate::plane::{Lattice, Rect};
use crate::points::Boundary;

/// The side of a tile in radii.
const TILE: f64 = 16.0;

/// A rectangle of lattice points, anywhere on the images of a torus. Along an axis of the torus it is at most one
/// period long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    pub rect: Rect,
    /// The period along those axes that the rectangle spans entirely.
    periods: [Option<i32>; 2],
}

impl Part {
    /// The part of the domain in a rectangle: on a bounded domain clipped, on a torus at most one period per axis.
    pub fn new(lattice: &Lattice, rect: &Rect) -> Self {
        match lattice.boundary {
            Boundary::Bounded => Self { rect: rect.intersection(&lattice.rect()), periods: [None; 2] },
            Boundary::Periodic => {
                let (mut rect, mut periods) = (*rect, [None; 2]);
                for (axis, size) in lattice.size.into_iter().enumerate() {
                    if rect.length(axis) >= size {
                        (rect.min[axis], rect.max[axis], periods[axis]) = (0, size, Some(size));
                    }
                }
                Self { rect, periods }
            }
        }
    }

    /// The whole domain.
    pub fn whole(lattice: &Lattice) -> Self {
        Self::new(lattice, &lattice.rect())
    }

    /// The pieces of this part that `rect` consists of, each with the translation from it to its image in `rect`.
    pub fn images(&self, rect: &Rect) -> impl Iterator<Item = (Rect, [i32; 2])> {
        let turns = |axis: usize| {
            let (period, turns) = match self.periods[axis] {
                Some(size) => (size, rect.min[axis].div_euclid(size)..=(rect.max[axis] - 1).div_euclid(size)),
                None => (0, 0..=0),
            };
            turns.map(move |turn| turn * period)
        };
        let (part, rect) = (self.rect, *rect);
        let shifts = turns(1).flat_map(move |y| turns(0).map(move |x| [x, y]));
        shifts.map(move |shift| (rect.translated(shift.map(|x| -x)).intersection(&part), shift))
    }
}

/// A sample with its attributes.
pub trait Placed: Copy + Default {
    /// The position of the sample.
    fn point(&self) -> [i32; 2];

    /// The same sample at another position.
    fn moved_to(self, point: [i32; 2]) -> Self;
}

/// The samples of a part, by tiles.
pub struct TiledSamples<S> {
    part: Part,
    /// The side of a tile in lattice points, and the number of tiles along each axis.
    side: i32,
    counts: [i32; 2],
    tiles: Binned<S>,
}

impl<S: Placed> TiledSamples<S> {
    /// The samples of a part, which are farther apart than a radius in lattice units.
    pub fn new(part: Part, samples: &[S], radius: f64) -> Self {
        let side = (TILE * radius) as i32;
        let counts = [0, 1].map(|axis: usize| (part.rect.length(axis) - 1).max(0) / side + 1);
        let tile = |point: [i32; 2]| {
            let [column, row] = [0, 1].map(|axis: usize| (point[axis] - part.rect.min[axis]) / side);
            (row * counts[0] + column) as usize
        };
        let tiles =
            Binned::new((counts[0] * counts[1]) as usize, samples.iter().map(|&sample| (tile(sample.point()), sample)));
        Self { part, side, counts, tiles }
    }

    /// All samples.
    pub fn samples(&self) -> &[S] {
        self.tiles.items()
    }

    /// Visits the samples in a rectangle, which lies in the part or in images of all of it.
    #[inline(always)]
    pub fn visit(&self, rect: &Rect, mut visit: impl FnMut(S)) {
        for (piece, shift) in self.part.images(rect).filter(|(piece, _)| !piece.is_empty()) {
            let min = self.part.rect.min;
            let [columns, rows] = [0, 1].map(|axis: usize| {
                (piece.min[axis] - min[axis]) / self.side..(piece.max[axis] - 1 - min[axis]) / self.side + 1
            });
            for row in rows {
                let first = (row * self.counts[0]) as usize;
                let run = self.tiles.range(first + columns.start as usize..first + columns.end as usize);
                for sample in self.tiles.items()[run].iter().filter(|sample| piece.contains(sample.point())) {
                    let [x, y] = sample.point();
                    visit(sample.moved_to([x + shift[0], y + shift[1]]));
                }
            }
        }
    }

    /// The samples of a part of this part.
    pub fn samples_of(&self, part: &Part) -> Vec<S> {
        if *part == self.part {
            return self.samples().to_vec();
        }
        let mut samples = Vec::new();
        self.visit(&part.rect, |sample| samples.push(sample));
        samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kdrt::progressive::Sample;
    use crate::points::Domain;
    use crate::rng::{Draw, Rng};

    /// All images of all samples, against those visited.
    #[test]
    fn a_rectangle_has_the_images_that_lie_in_it() {
        let mut rng = Rng::at(0, Draw::Probe, &[]);
        for boundary in [Boundary::Bounded, Boundary::Periodic] {
            let domain = Domain { min: [1.0; 2], max: [1.0003, 1.0001], boundary };
            let lattice = Lattice::new(&domain, 1e-5).unwrap();
            let any = |rng: &mut Rng, low: i32, high: i32| low + rng.below((high - low) as u64) as i32;
            let samples: Vec<_> = (0..300)
                .map(|i| Sample { point: lattice.size.map(|size| any(&mut rng, 0, size)), square: i })
                .collect();
            let region = TiledSamples::new(Part::whole(&lattice), &samples, lattice.radius);
            for _ in 0..200 {
                let min = lattice.size.map(|size| any(&mut rng, -2 * size, 2 * size));
                let rect = Rect { min, max: [0, 1].map(|axis| min[axis] + any(&mut rng, 1, 3 * lattice.size[axis])) };
                let turns = if boundary == Boundary::Periodic { -8..=8 } else { 0..=0 };
                let mut expected = Vec::new();
                for [x, y] in turns.clone().flat_map(|y| turns.clone().map(move |x| [x, y])) {
                    let [width, height] = lattice.size;
                    let images = samples.iter().map(|s| ([s.point[0] + x * width, s.point[1] + y * height], s.square));
                    expected.extend(images.filter(|&(point, _)| rect.contains(point)));
                }
                let mut visited = Vec::new();
                region.visit(&rect, |sample| visited.push((sample.point, sample.square)));
                visited.sort_unstable();
                expected.sort_unstable();
                assert_eq!(visited, expected);
                // A smaller part keeps each sample once, and returns those that lie in it.
                let part = Part::new(&lattice, &rect);
                if part.rect.is_empty() {
                    continue;
                }
                let within = TiledSamples::new(part, &region.samples_of(&part), lattice.radius);
                let inner = Rect { min: part.rect.min, max: part.rect.max.map(|x| x - 1) };
                let mut visited = Vec::new();
                within.visit(&inner, |sample| visited.push((sample.point, sample.square)));
                let mut expected = Vec::new();
                region.visit(&inner, |sample| expected.push((sample.point, sample.square)));
                visited.sort_unstable();
                expected.sort_unstable();
                assert_eq!(visited, expected);
            }
        }
    }
}
