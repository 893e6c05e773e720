//! A plane of tiles: everything that is needed to make any part of it, and the making of a window.
//!
//! A window is a rectangle of fill blocks. Its samples are a function of the plane's options and the window's place
//! alone: it is made from the leaves that meet it and a margin around it, in memory of its own, whatever else is made
//! or not. The margin is at most 2 blocks (20 radii) to the left and right and 1 (10 radii) above and below for the
//! phases of filling, and 4 radii for the chains of elimination around what the filling sees.

use crate::error::Result;
use crate::job::Job;
use crate::lattice::{Lattice, Rect};
use crate::maximal::{CellAxis, CellGrid, Quadtree};
use crate::points::Boundary;

use super::blocks::{Blocks, PHASES};
use super::clip::{Pattern, pattern_side};
use super::conquer::{LONGEST_CHAIN, SeamCells, merge};
use super::divide::{Leaf, Tree};
use super::output::Output;
use super::{MIN_LEAF_SIZE, fill};

/// Fill blocks along the side of a window: about 50,000 samples, which fit a core's own cache.
const WINDOW_BLOCKS: i32 = 48;

/// A maximal set of a whole domain, of which any window can be made.
pub(super) struct Plane {
    lattice: Lattice,
    axes: [CellAxis; 2],
    tree: Tree,
    pattern: Pattern,
    blocks: Blocks,
}

impl Plane {
    /// Whether a domain can be tiled and is larger than the pattern that it would be tiled with.
    pub fn is_worthwhile(lattice: &Lattice, leaf_size: f64) -> bool {
        let [width, height] = lattice.size.map(|size| f64::from(size) / lattice.radius);
        width.min(height) > 2.0 * MIN_LEAF_SIZE + 1.0 && width * height > pattern_side(leaf_size).powi(2)
    }

    /// Makes the pattern of the plane. The lattice must be worthwhile to tile.
    pub fn new(job: &Job, lattice: Lattice, leaf_size: f64, seed: u64) -> Result<Self> {
        let units = |radii: f64| (radii * lattice.radius).ceil();
        let pattern = Pattern::new(job, &lattice, units(pattern_side(leaf_size)) as i32, seed)?;
        let shortest = lattice.size.map(|size| match lattice.boundary {
            // Nothing may be its own neighbour on a torus: its axes are split at least once.
            Boundary::Periodic => units(leaf_size).min(f64::from(size / 2)) as i32,
            Boundary::Bounded => units(leaf_size) as i32,
        });
        Ok(Self {
            axes: lattice.size.map(|size| CellAxis::new(size, lattice.radius)),
            tree: Tree::new(lattice.rect(), shortest, seed),
            blocks: Blocks::new(&lattice, seed),
            pattern,
            lattice,
        })
    }

    /// The plane cut into windows for [`Plane::window`].
    pub fn windows(&self) -> Vec<Rect> {
        self.windows_of(WINDOW_BLOCKS)
    }

    fn windows_of(&self, side: i32) -> Vec<Rect> {
        let all = Rect { min: [0; 2], max: self.blocks.counts() };
        let starts = |axis: usize| (0..all.max[axis]).step_by(side as usize);
        starts(1)
            .flat_map(|y| starts(0).map(move |x| Rect { min: [x, y], max: [x + side, y + side] }.intersection(&all)))
            .collect()
    }

    /// The samples in a rectangle of fill blocks.
    pub fn window(&self, window: &Rect) -> Vec<[f32; 2]> {
        let Lattice { threshold, reach, .. } = self.lattice;
        let filled = self.blocks.rect(&self.blocks.grown(window, PHASES[0].1));
        let known = self.inside(&filled.grown((1 + LONGEST_CHAIN) * reach));
        let leaves = self.leaves(&known);
        let mut grid = CellGrid::new(&self.axes, &known, threshold, reach);
        let mut output = Output::new(&self.lattice, self.blocks.rect(window));
        let eliminated = merge(&mut grid, &self.pattern, &leaves, &known, reach, &mut output);
        let seams = SeamCells::new(&grid, &leaves, &eliminated, reach);

        let mut quadtree = Quadtree::new(&grid, known, Vec::new());
        for (parity, margin) in PHASES {
            for (block, rect) in self.blocks.of_parity(&self.blocks.grown(window, margin), parity) {
                fill::fill(&mut grid, &mut quadtree, &seams, &rect, self.blocks.rng(block), &mut output);
            }
        }
        #[cfg(test)]
        grid.sanity_check();
        output.finish()
    }

    /// A rectangle without what lies beyond the border of a bounded domain.
    fn inside(&self, rect: &Rect) -> Rect {
        match self.lattice.boundary {
            Boundary::Periodic => *rect,
            Boundary::Bounded => rect.intersection(&self.lattice.rect()),
        }
    }

    /// The leaves that meet `rect` by falling rank; on a torus all their images that do.
    fn leaves(&self, rect: &Rect) -> Vec<Leaf> {
        let turns = |axis: usize| {
            let size = self.lattice.size[axis];
            (rect.min[axis].div_euclid(size)..=(rect.max[axis] - 1).div_euclid(size)).map(move |turn| turn * size)
        };
        let mut ranked = Vec::new();
        for [x, y] in turns(1).flat_map(|y| turns(0).map(move |x| [x, y])) {
            for leaf in self.tree.leaves(&rect.translated([-x, -y])) {
                ranked.push((leaf.rank(), Leaf { rect: leaf.rect.translated([x, y]), ..leaf }));
            }
        }
        ranked.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.rect.min.cmp(&b.1.rect.min)));
        ranked.into_iter().map(|(_, leaf)| leaf).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::points::Domain;
    use crate::rng::{Draw, Rng};

    /// The plane of a domain, made by windows of one size.
    fn samples(plane: &Plane, window_blocks: i32) -> Vec<[f32; 2]> {
        let windows = plane.windows_of(window_blocks);
        let mut samples: Vec<_> = windows.iter().flat_map(|window| plane.window(window)).collect();
        samples.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        samples
    }

    fn plane(domain: Domain, radius: f64, leaf_size: f64, seed: u64) -> Plane {
        let lattice = Lattice::new(&domain, radius).unwrap();
        assert!(Plane::is_worthwhile(&lattice, leaf_size));
        let context = Context::new(1).unwrap();
        context.run(None, |job| Plane::new(job, lattice.clone(), leaf_size, seed)).unwrap()
    }

    #[test]
    fn every_partition_into_windows_gives_the_same_samples() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (seed, leaf_size) in [(0, 6.0), (1, 6.0), (2, 20.0), (3, 26.0)] {
                for extent in [[1.3, 1.0], [11.0, 0.11]] {
                    let domain = Domain { min: [0.3, -0.4], max: [0.3 + extent[0], -0.4 + extent[1]], boundary };
                    let plane = plane(domain, 0.0079, leaf_size, seed);
                    let whole = samples(&plane, WINDOW_BLOCKS);
                    for window_blocks in [1, 2, 5, 16] {
                        assert!(samples(&plane, window_blocks) == whole, "{window_blocks} blocks, seed {seed}");
                    }
                }
            }
        }
    }

    /// A torus in which a window's margin meets the window itself.
    #[test]
    fn the_smallest_torus_is_its_own_neighbour() {
        let domain = Domain { min: [0.0; 2], max: [0.131, 12.0], boundary: Boundary::Periodic };
        let plane = plane(domain, 0.01, 6.0, 5);
        assert_eq!(plane.blocks.counts()[0], 2);
        assert!(samples(&plane, 1) == samples(&plane, 1000));
    }

    /// The elimination of small windows around the leaves' corners, where chains are longest, against its definition on
    /// all points of the plane.
    #[test]
    fn survivors_are_those_that_no_survivor_of_a_higher_leaf_conflicts_with() {
        let domain = Domain { min: [0.0; 2], max: [1.2, 1.0], boundary: Boundary::Bounded };
        for seed in 0..4 {
            let plane = plane(domain, 0.009, 6.0, seed);
            let Lattice { threshold, reach, .. } = plane.lattice;
            let all = plane.lattice.rect();
            let leaves = plane.leaves(&all);
            let mut survivors: Vec<[i32; 2]> = Vec::new();
            for leaf in &leaves {
                let higher = survivors.len();
                for point in plane.pattern.clip(leaf, &leaf.rect) {
                    let conflicts = |other: &[i32; 2]| {
                        let [dx, dy] = [0, 1].map(|axis: usize| i64::from(other[axis] - point[axis]));
                        dx * dx + dy * dy < threshold
                    };
                    if !survivors[..higher].iter().any(conflicts) {
                        survivors.push(point);
                    }
                }
            }
            let mut rng = Rng::at(seed, Draw::Probe, &[]);
            for corner in leaves.iter().flat_map(|leaf| [leaf.rect.min; 50]) {
                let near = corner.map(|x| x - reach + rng.below(2 * reach as u64) as i32);
                let core = Rect { min: near, max: near.map(|x| x + reach) }.intersection(&all);
                if core.is_empty() {
                    continue;
                }
                let window = core.grown(LONGEST_CHAIN * reach).intersection(&all);
                let mut grid = CellGrid::new(&plane.axes, &window, threshold, reach);
                let mut output = Output::new(&plane.lattice, core);
                merge(&mut grid, &plane.pattern, &plane.leaves(&window), &window, reach, &mut output);
                let mut positions = output.finish();
                let mut found: Vec<_> = grid.samples_in(&core).collect();
                let mut expected: Vec<_> = survivors.iter().copied().filter(|&point| core.contains(point)).collect();
                found.sort_unstable();
                expected.sort_unstable();
                assert_eq!(found, expected);
                let mut expected: Vec<_> = expected.into_iter().map(|point| plane.lattice.position(point)).collect();
                positions.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap());
                expected.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap());
                assert_eq!(positions, expected);
            }
        }
    }
}
