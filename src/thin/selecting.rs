//! The loop that selects, by either rule.

use super::tree::{Nearer, Tree};
use super::{Options, Selection};
use crate::error::Result;
use crate::job::Job;
use crate::math::rounded_down;
use crate::order::Order;
use crate::rng::{Draw, Rng};
use crate::simd::{Lanes, Level, Work, run};

/// The points that are selected between two reports of progress.
const REPORTED: usize = 1024;

/// The share of the progress until the tree is made.
const TREE_SHARE: f64 = 0.3;

/// Selects points of a cloud, of which there is at least one.
pub(super) fn select<const D: usize>(
    job: &Job,
    level: Level,
    options: &Options,
    positions: &[[f32; D]],
) -> Result<Selection> {
    let count = if options.count == 0 { positions.len() } else { options.count.min(positions.len()) };
    let end = End { squared: least_square(options.radius), count };
    // By radius, a point that is far enough from the selected ones is as far as any other, and one that is not is out:
    // so the farthest is the one of lowest index of those that can be selected.
    let by_radius = options.order == Order::Any && options.count == 0;
    let (start, nearer) = if by_radius { (end.squared, Nearer::Zero) } else { (f64::INFINITY, Nearer::Distance) };
    let tree = Tree::new(&job.part(0.0, TREE_SHARE), positions, start, nearer)?;
    let mut selecting = Selecting { positions, tree, indices: Vec::new(), squared: Vec::new() };
    if !by_radius {
        selecting.select(Rng::at(options.seed, Draw::Thin, &[]).below(positions.len() as u64) as u32, f64::INFINITY);
    }
    let job = job.part(TREE_SHARE, 1.0);
    while run(level, Advance { selecting: &mut selecting, end: &end, count: REPORTED }) {
        job.report(if by_radius { selecting.share_of_indices() } else { selecting.share_of(&end) })?;
    }
    if !by_radius && end.squared == 0.0 {
        selecting.select_coincident(end.count);
    }
    let Selecting { mut indices, squared, .. } = selecting;
    let radius = match squared[..] {
        [] | [_] => f64::INFINITY,
        _ if by_radius => options.radius,
        [.., last] => last.sqrt(),
    };
    let ranks = match options.order {
        Order::Any => {
            indices.sort_unstable();
            Vec::new()
        }
        Order::Progressive => squared.into_iter().map(rank).collect(),
    };
    Ok(Selection { indices, ranks, radius })
}

/// The end of a selection.
pub(super) struct End {
    /// The least squared distance of a point that may be selected.
    squared: f64,
    /// The number of points, at most those of the cloud.
    count: usize,
}

/// The selected points, and the tree that knows the distances of the others from them.
pub(super) struct Selecting<'a, const D: usize> {
    positions: &'a [[f32; D]],
    tree: Tree<D>,
    indices: Vec<u32>,
    /// The squared distance of each from the nearest of those before it.
    squared: Vec<f64>,
}

impl<const D: usize> Selecting<'_, D> {
    #[inline(always)]
    fn select(&mut self, index: u32, squared: f64) {
        self.indices.push(index);
        self.squared.push(squared);
        self.tree.select(&self.positions[index as usize].map(f64::from));
    }

    /// Selects points up to `count` of the remaining ones, which coincide with selected ones: the lowest indices first.
    fn select_coincident(&mut self, count: usize) {
        let mut is_selected = vec![false; self.positions.len()];
        self.indices.iter().for_each(|&index| is_selected[index as usize] = true);
        let left = (0u32..).zip(is_selected).filter(|(_, is_selected)| !is_selected).map(|(index, _)| index);
        self.indices.extend(left.take(count - self.indices.len()));
        self.squared.resize(self.indices.len(), 0.0);
    }

    /// The progress of indices that ascend.
    fn share_of_indices(&self) -> f64 {
        self.indices.last().map_or(0.0, |&index| f64::from(index) / self.positions.len() as f64)
    }

    /// The share of a progressive selection that is done, by number or by distance: on a surface, and about in general,
    /// the number grows as the square of the distance falls.
    fn share_of(&self, end: &End) -> f64 {
        let by_count = self.indices.len() as f64 / end.count as f64;
        self.squared.last().map_or(0.0, |&squared| by_count.max(end.squared / squared).min(1.0))
    }
}

/// Selects up to `count` more points, the farthest each time. Returns true if there may be more. Points that coincide
/// with selected ones are not selected.
struct Advance<'a, 'b, const D: usize> {
    selecting: &'a mut Selecting<'b, D>,
    end: &'a End,
    count: usize,
}

impl<const D: usize> Work for Advance<'_, '_, D> {
    type Out = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> bool {
        let Self { selecting, end, count } = self;
        for _ in 0..count {
            let farthest = selecting.tree.farthest();
            if farthest.squared < end.squared || farthest.squared == 0.0 || selecting.indices.len() == end.count {
                return false;
            }
            selecting.select(farthest.index, farthest.squared);
        }
        true
    }
}

/// The least number whose root is at least `radius`: squares are compared with it, and the guarantee holds for roots.
fn least_square(radius: f64) -> f64 {
    let mut square = radius * radius;
    while square > 0.0 && square.next_down().sqrt() >= radius {
        square = square.next_down();
    }
    while square.sqrt() < radius {
        square = square.next_up();
    }
    square
}

/// A squared distance as a rank: the largest float that is no longer than the distance.
fn rank(squared: f64) -> f32 {
    rounded_down(squared.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;

    #[test]
    fn a_least_square_is_the_border_of_roots() {
        let mut rng = Rng::at(5, Draw::Probe, &[]);
        let random = (0..2000).map(|_| (rng.unit() + 0.1) * 10f64.powi(rng.below(300) as i32 - 200));
        for radius in random.chain([1.0, 2.0, 1e-300, 5e-324, 1e200, f64::MAX]) {
            let square = least_square(radius);
            assert!(square.sqrt() >= radius && square.next_down().sqrt() < radius, "{radius:e}");
        }
        assert_eq!(least_square(0.0), 0.0);
    }

    #[test]
    fn a_rank_is_no_longer_than_the_distance() {
        for squared in [0.0, 1.0, 2.0, 3.0, 0.1, 1e-90, 1e70, 1e77, f64::INFINITY] {
            let rank = rank(squared);
            assert!(f64::from(rank) <= squared.sqrt());
            assert!(rank == f32::INFINITY || f64::from(rank.next_up()) > squared.sqrt(), "{squared:e}");
        }
    }

    fn check<const D: usize>(count: usize) {
        let mut rng = Rng::at(D as u64, Draw::Probe, &[]);
        // A quarter of them on a lattice, with many ties.
        let cloud: Vec<[f32; D]> = (0..count)
            .map(|i| [(); D].map(|()| if i % 4 == 0 { rng.below(9) as f32 / 8.0 } else { rng.unit() as f32 }))
            .collect();
        let context = Context::new(1).unwrap();
        for options in [Options::by_radius(0.05), Options::progressive().seed(3)] {
            let select = |level| context.run(None, |job| select(job, level, &options, &cloud)).unwrap();
            let expected: Selection = select(Level::Portable);
            assert!(expected.indices.len() > 200);
            assert!(Level::available().into_iter().all(|level| select(level) == expected), "{options:?}");
        }
    }

    #[test]
    fn all_levels_select_the_same() {
        check::<2>(5000);
        check::<3>(3000);
    }
}
