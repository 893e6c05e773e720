//! Ranks: the distances of new samples of a block from the nearest ones before them.

use crate::index::Binned;
use crate::math::rounded_down;
use crate::plane::{Lattice, Rect};
use crate::volume::blocks::REACH;
use crate::volume::search::{Centre, square};

/// The ranks of new samples of a block, up to the largest one; see [`squares`].
pub fn up_to(
    largest: f64,
    lattice: &Lattice<3>,
    block: &Rect<3>,
    around: &[Centre],
    added: &[Centre],
    images: &[[i32; 3]],
) -> Vec<f32> {
    // The first square that is too long for the largest rank.
    let farthest = (largest / lattice.unit()).min(REACH * lattice.radius);
    let squares = squares(block, around, added, images, (farthest * farthest) as i64 + 1);
    squares.into_iter().map(|square| rounded_down(lattice.length(square).min(largest))).collect()
}

/// For each new sample of a block the squared distance to the nearest sample that was there before it, but no more than
/// `most`. `around` are the samples that were there at first, as far as they are nearer than that, and `images` the
/// displacements of the images of new ones; a sample's own images do not count.
fn squares(block: &Rect<3>, around: &[Centre], added: &[Centre], images: &[[i32; 3]], most: i64) -> Vec<i64> {
    if added.is_empty() {
        return Vec::new();
    }
    // Samples in cells as wide as they see; those beyond the block are in the cells at its border.
    let side = most.isqrt() as i32 + 1;
    let counts: [i32; 3] = std::array::from_fn(|axis| (block.length(axis) - 1) / side + 1);
    let cell = |axis: usize, x: i32| (x - block.min[axis]).div_euclid(side).clamp(0, counts[axis] - 1);
    let number = |[x, y, z]: [i32; 3]| ((z * counts[1] + y) * counts[0] + x) as usize;
    let seen = block.grown(side);

    // Each sample with its time.
    let moved = |sample: Centre, by: &[i32; 3]| -> Centre { std::array::from_fn(|axis| sample[axis] + by[axis]) };
    let images_of = |sample: Centre| std::iter::once(sample).chain(images.iter().map(move |by| moved(sample, by)));
    let before = around.iter().map(|&sample| (0, sample));
    let new = (1..).zip(added).flat_map(|(time, &sample)| images_of(sample).map(move |image| (time, image)));
    let timed: Vec<(u32, Centre)> = before.chain(new).filter(|&(_, sample)| seen.contains(sample)).collect();
    let cell_of = |sample: Centre| number([cell(0, sample[0]), cell(1, sample[1]), cell(2, sample[2])]);
    let binned = Binned::new(
        counts.iter().map(|&count| count as usize).product(),
        timed.iter().map(|&(time, sample)| (cell_of(sample), (time, sample))),
    );

    let nearest = |time: u32, sample: Centre| {
        let [low, high] = [-side, side].map(|by| -> [i32; 3] { std::array::from_fn(|k| cell(k, sample[k] + by)) });
        let mut least = most;
        for (z, y) in (low[2]..=high[2]).flat_map(|z| (low[1]..=high[1]).map(move |y| (z, y))) {
            let row = binned.range(number([low[0], y, z])..number([high[0], y, z]) + 1);
            for &(other, place) in &binned.items()[row] {
                if other < time {
                    least = least.min(square(sample, place));
                }
            }
        }
        least
    };
    (1..).zip(added).map(|(time, &sample)| nearest(time, sample)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn squares_are_those_of_all_pairs() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let (mut limited, mut seen) = (0, 0);
        for round in 0..60 {
            let size = [0; 3].map(|_| 1 + rng.below(200) as i32);
            let min = [-50, 7, 1000];
            let block = Rect { min, max: std::array::from_fn(|axis| min[axis] + size[axis]) };
            let mut samples = |rect: &Rect<3>, count: usize| -> Vec<Centre> {
                let mut along = |axis: usize| rect.min[axis] + rng.below(rect.length(axis) as u64) as i32;
                (0..count).map(|_| [along(0), along(1), along(2)]).collect()
            };
            let (around, added) = (samples(&block.grown(90), 60), samples(&block, 40));
            let images: &[[i32; 3]] = if round % 2 == 0 { &[] } else { &[[size[0], 0, 0], [-size[0], 0, 0]] };
            let most = 1 + (round * round * 3) as i64;
            for (i, found) in squares(&block, &around, &added, images, most).into_iter().enumerate() {
                let copies = added[..i].iter().flat_map(|sample| {
                    let moved = images.iter().map(|by| [0, 1, 2].map(|axis| sample[axis] + by[axis]));
                    moved.chain([*sample])
                });
                let all = around.iter().copied().chain(copies);
                let expected = all.map(|other| square(added[i], other)).min().unwrap_or(i64::MAX).min(most);
                assert_eq!(found, expected);
                limited += usize::from(found == most);
                seen += usize::from(found < most);
            }
        }
        assert!(limited > 300 && seen > 300, "{limited} {seen}");
    }
}
