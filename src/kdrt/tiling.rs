//! A plane of tiles: everything that is needed to make any part of it, and the making of a window.
//!
//! A window is a rectangle of fill blocks. Its samples are a function of the plane's options and the window's place
//! alone: it is made from the leaves that meet it and a margin around it, in memory of its own, independently of all
//! other windows. The margin is 2 blocks (at most 11 radii) to the left and right and 1 (6 radii) above and below for
//! the phases of filling, and 5 radii for the chains of elimination around the region that filling reads.

use std::sync::Arc;

use crate::error::Result;
use crate::job::Job;
use crate::kdrt::{
    blocks::Blocks,
    clip::{Pattern, pattern_side},
    conquer::{LONGEST_CHAIN, Output, SeamCells, capacity, merge},
    divide::{Leaf, Tree},
    fill::{Filling, Footprints},
    options::MIN_LEAF_SIZE,
};
use crate::math::square;
use crate::plane::{CellAxis, CellGrid, GivenDisks, Lattice, Rect};
use crate::points::{Boundary, Domain};

/// Fill blocks along the side of a window: about 50,000 samples, which fit in a core's own cache.
pub const WINDOW_BLOCKS: i32 = 56;

/// A window between elimination and filling.
pub struct Merged<'a> {
    /// Everything that survived near seams.
    pub grid: CellGrid,
    pub eliminated: Vec<[i32; 2]>,
    /// The survivors in the window.
    pub output: Output<'a>,
}

/// A maximal set of a whole domain, of which any window can be made.
pub struct Tiling {
    lattice: Lattice,
    axes: [CellAxis; 2],
    tree: Tree,
    pattern: Arc<Pattern>,
    blocks: Blocks,
    footprints: Footprints,
    around: Arc<GivenDisks>,
}

impl Tiling {
    /// True if a domain can be tiled and is larger than the pattern that it would be tiled with.
    pub fn is_worthwhile(lattice: &Lattice, leaf_size: f64) -> bool {
        let [width, height] = lattice.size.map(|size| f64::from(size) / lattice.radius);
        is_wide(lattice) && width * height > square(pattern_side(leaf_size))
    }

    /// Makes the pattern of the plane, unless the context keeps it. The lattice must be worth tiling.
    pub fn new(job: &Job, lattice: Lattice, leaf_size: f64, seed: u64, around: Arc<GivenDisks>) -> Result<Self> {
        let side = (pattern_side(leaf_size) * lattice.radius).ceil() as i32;
        let pattern = Pattern::kept(job, &lattice, side, seed)?;
        Ok(Self::with_pattern(pattern, lattice, leaf_size, seed, around))
    }

    /// [`Tiling::new`] with another pattern, whose side must be at least twice the leaf size.
    pub fn with_pattern(
        pattern: Arc<Pattern>,
        lattice: Lattice,
        leaf_size: f64,
        seed: u64,
        around: Arc<GivenDisks>,
    ) -> Self {
        let axes = lattice.size.map(|size| CellAxis::new(size, lattice.radius));
        Self {
            footprints: Footprints::new(lattice.radius, [0, 1].map(|axis: usize| axes[axis].side())),
            axes,
            tree: tree(&lattice, leaf_size, seed),
            blocks: Blocks::new(&lattice, seed),
            pattern,
            lattice,
            around,
        }
    }

    /// Makes one part of the algorithm deterministic.
    #[cfg(feature = "stages")]
    pub fn fix(&mut self, fixed: crate::kdrt::divide::Fixed) {
        self.tree.fixed = fixed;
    }

    /// The lattice points of a window.
    #[cfg(feature = "stages")]
    pub fn rect(&self, window: &Rect) -> Rect {
        self.blocks.rect(window)
    }

    /// Lays the pattern in the leaves and discards it, to measure the time. Returns the number of points in the
    /// rectangle.
    #[cfg(feature = "stages")]
    pub fn clip(&self, rect: &Rect, leaves: &[Leaf]) -> usize {
        let mut points = 0;
        for leaf in leaves {
            self.pattern.rows(leaf, &leaf.rect.intersection(rect), |row| {
                points += row.points().filter(|&point| row.part.contains(point)).count();
            });
        }
        points
    }

    /// The plane cut into windows for [`Tiling::window`].
    pub fn windows(&self) -> Vec<Rect> {
        self.windows_of(WINDOW_BLOCKS)
    }

    fn windows_of(&self, side: i32) -> Vec<Rect> {
        cut(&Rect { min: [0; 2], max: self.blocks.counts() }, side)
    }

    /// All samples, in parallel.
    pub fn whole(&self, job: &Job) -> Result<Vec<[f32; 2]>> {
        let windows = self.windows();
        let expected = capacity(self.lattice.expected_samples());
        job.concat_about(expected, windows.len(), |i| self.window(&windows[i]))
    }

    /// The samples in a rectangle of fill blocks.
    pub fn window(&self, window: &Rect) -> Vec<[f32; 2]> {
        self.window_on(&self.lattice, window)
    }

    /// The samples in a part of the domain, in the order of all windows one after the other.
    pub fn part(&self, job: &Job, part: &Domain) -> Result<Vec<[f32; 2]>> {
        let points = self.lattice.points_in(part);
        if points.is_empty() {
            return Ok(Vec::new());
        }
        let inside = |mut samples: Vec<[f32; 2]>| {
            samples.retain(|&sample| part.contains(sample));
            samples
        };
        let blocks = self.blocks.holding(&points);
        let windows = cut(&blocks, WINDOW_BLOCKS);
        if blocks.length(0).max(blocks.length(1)) > WINDOW_BLOCKS {
            let expected = capacity(self.lattice.samples_in(&points));
            return job.concat_about(expected, windows.len(), |i| inside(self.window(&windows[i])));
        }
        // Smaller than one window, so made at once even where it meets several: their surroundings would be made
        // repeatedly. The order of samples is the same in each of them.
        let samples = inside(self.window(&blocks));
        if windows.len() == 1 {
            return Ok(samples);
        }
        let mut ordered = Vec::with_capacity(samples.len());
        for window in &windows {
            let Rect { min, max } = self.blocks.rect(window);
            let (first, last) = (self.lattice.position(min), self.lattice.position(max.map(|x| x - 1)));
            let is_inside =
                |sample: &&[f32; 2]| (0..2).all(|axis| first[axis] <= sample[axis] && sample[axis] <= last[axis]);
            ordered.extend(samples.iter().filter(is_inside));
        }
        Ok(ordered)
    }

    /// The lattice of the domain.
    #[cfg(feature = "stages")]
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// About how many samples lie in a rectangle.
    pub fn expected(&self, rect: &Rect) -> f64 {
        self.lattice.samples_in(rect)
    }

    /// The samples in a rectangle of the domain, as lattice points.
    pub fn points(&self, job: &Job, rect: &Rect) -> Result<Vec<[i32; 2]>> {
        let windows = cut(&self.blocks.holding(rect), WINDOW_BLOCKS);
        job.flat_map(windows.len(), |i| {
            // The lattice of a wide plane is finer than floats: those of a window suffice.
            let near = self.lattice.seen_from(self.blocks.rect(&windows[i]).min);
            let samples = self.window_on(&near, &windows[i]).into_iter().map(|sample| near.point(sample));
            samples.filter(|&point| rect.contains(point)).collect()
        })
    }

    /// A window, at the coordinates of a lattice of the same points.
    fn window_on(&self, lattice: &Lattice, window: &Rect) -> Vec<[f32; 2]> {
        self.window_within(lattice, &self.surroundings(window), window)
    }

    /// A window, given its surroundings.
    fn window_within(&self, lattice: &Lattice, known: &Rect, window: &Rect) -> Vec<[f32; 2]> {
        let leaves = self.leaves(known);
        let merged = self.merge(lattice, known, window, &leaves);
        self.fill(window, &leaves, merged)
    }

    /// Clips the leaves and eliminates conflicts. The samples get the coordinates of a lattice of the same points.
    pub fn merge<'a>(&self, lattice: &'a Lattice, known: &Rect, window: &Rect, leaves: &[Leaf]) -> Merged<'a> {
        let separation = self.lattice.separation;
        let mut grid = CellGrid::new(&self.axes, known, separation);
        grid.set_obstacles(self.around.near(known));
        let mut output = Output::new(lattice, self.blocks.rect(window));
        let eliminated = merge(&mut grid, &self.pattern, leaves, known, separation.reach, &mut output);
        Merged { grid, eliminated, output }
    }

    /// Fills the gaps: the samples of the window.
    pub fn fill(&self, window: &Rect, leaves: &[Leaf], merged: Merged) -> Vec<[f32; 2]> {
        let Merged { mut grid, eliminated, mut output } = merged;
        let reach = self.lattice.separation.reach;
        let seams = SeamCells::new(&grid, leaves, &eliminated, reach);
        let mut filling = Filling::new(&self.footprints, seams, reach);
        self.blocks.in_phases(&mut grid, window, |grid, block, place| {
            filling.fill(grid, block, || self.blocks.rng(place), &mut |_, sample| output.push(sample));
        });
        #[cfg(test)]
        grid.sanity_check();
        output.finish()
    }

    /// The lattice points on whose leaves the samples of a window depend.
    pub fn surroundings(&self, window: &Rect) -> Rect {
        let filled = self.blocks.rect(&self.blocks.filled(window));
        // The fill searches samples within a reach, and eliminated points within a reach of its cells, which extend
        // less than another reach beyond it.
        self.inside(&filled.grown((2 + LONGEST_CHAIN) * self.lattice.separation.reach))
    }

    /// A rectangle clipped to a bounded domain.
    fn inside(&self, rect: &Rect) -> Rect {
        match self.lattice.boundary {
            Boundary::Periodic => *rect,
            Boundary::Bounded => rect.intersection(&self.lattice.rect()),
        }
    }

    /// The leaves that meet `rect` by falling rank; on a torus all their images that do.
    pub fn leaves(&self, rect: &Rect) -> Vec<Leaf> {
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

/// The tree of a plane.
pub fn tree(lattice: &Lattice, leaf_size: f64, seed: u64) -> Tree {
    let shortest = (leaf_size * lattice.radius).ceil();
    let shortest = lattice.size.map(|size| match lattice.boundary {
        // Nothing may be its own neighbour on a torus: its axes are split at least once.
        Boundary::Periodic => shortest.min(f64::from(size / 2)) as i32,
        Boundary::Bounded => shortest as i32,
    });
    Tree::new(lattice.rect(), shortest, seed)
}

/// True if a lattice is so wide that leaves fit, and that its cells are no less than 0.67 radii wide.
pub fn is_wide(lattice: &Lattice) -> bool {
    lattice.size.into_iter().all(|size| f64::from(size) / lattice.radius > 2.0 * MIN_LEAF_SIZE + 1.0)
}

/// A rectangle of blocks, cut at the multiples of `side`.
pub fn cut(blocks: &Rect, side: i32) -> Vec<Rect> {
    let starts = |axis: usize| (blocks.min[axis].div_euclid(side) * side..blocks.max[axis]).step_by(side as usize);
    let cells = starts(1).flat_map(|y| starts(0).map(move |x| Rect { min: [x, y], max: [x + side, y + side] }));
    cells.map(|cell| cell.intersection(blocks)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::plane::Separation;
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

    /// The plane of a domain, made by windows of one size.
    fn samples(tiling: &Tiling, window_blocks: i32) -> Vec<[f32; 2]> {
        let windows = tiling.windows_of(window_blocks);
        let mut samples: Vec<_> = windows.iter().flat_map(|window| tiling.window(window)).collect();
        samples.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        samples
    }

    fn tiling(domain: Domain, radius: f64, leaf_size: f64, seed: u64) -> Tiling {
        let lattice = Lattice::new(&domain, radius).unwrap();
        assert!(Tiling::is_worthwhile(&lattice, leaf_size));
        let context = Context::new(1).unwrap();
        context.run(None, |job| Tiling::new(job, lattice.clone(), leaf_size, seed, Arc::default())).unwrap()
    }

    #[test]
    fn every_partition_into_windows_gives_the_same_samples() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (seed, leaf_size, radius) in [(0, 6.0, 0.0079), (1, 6.0, 0.0079), (2, 20.0, 0.0054), (3, 26.0, 0.0054)]
            {
                for extent in [[1.3, 1.0], [11.0, 0.11]] {
                    let domain = Domain { min: [0.3, -0.4], max: [0.3 + extent[0], -0.4 + extent[1]], boundary };
                    let tiling = tiling(domain, radius, leaf_size, seed);
                    let whole = samples(&tiling, WINDOW_BLOCKS);
                    for window_blocks in [1, 2, 5, 16] {
                        assert!(samples(&tiling, window_blocks) == whole, "{window_blocks} blocks, seed {seed}");
                    }
                }
            }
        }
    }

    /// A torus in which a window's margin meets the window itself.
    #[test]
    fn the_smallest_torus_is_its_own_neighbour() {
        let domain = Domain { min: [0.0; 2], max: [0.131, 12.0], boundary: Boundary::Periodic };
        let tiling = tiling(domain, 0.01, 6.0, 5);
        assert_eq!(tiling.blocks.counts()[0], 4);
        assert!(samples(&tiling, 1) == samples(&tiling, 1000));
    }

    /// The elimination of small windows around the leaves' corners, where chains are longest, against its definition on
    /// all points of the plane.
    #[test]
    fn survivors_are_those_that_no_survivor_of_a_higher_leaf_conflicts_with() {
        let domain = Domain { min: [0.0; 2], max: [1.2, 1.0], boundary: Boundary::Bounded };
        for seed in 0..4 {
            let tiling = tiling(domain, 0.009, 6.0, seed);
            let separation @ Separation { threshold, reach } = tiling.lattice.separation;
            let all = tiling.lattice.rect();
            let leaves = tiling.leaves(&all);
            let mut survivors: Vec<[i32; 2]> = Vec::new();
            for leaf in &leaves {
                let higher = survivors.len();
                for point in tiling.pattern.clip(leaf, &leaf.rect) {
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
                let mut grid = CellGrid::new(&tiling.axes, &window, separation);
                let mut output = Output::new(&tiling.lattice, core);
                merge(&mut grid, &tiling.pattern, &tiling.leaves(&window), &window, reach, &mut output);
                let mut positions = output.finish();
                let mut found: Vec<_> = grid.samples_in(&core).collect();
                let mut expected: Vec<_> = survivors.iter().copied().filter(|&point| core.contains(point)).collect();
                found.sort_unstable();
                expected.sort_unstable();
                assert_eq!(found, expected);
                let mut expected: Vec<_> = expected.into_iter().map(|point| tiling.lattice.position(point)).collect();
                positions.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap());
                expected.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap());
                assert_eq!(positions, expected);
            }
        }
    }

    #[test]
    fn all_vectors_fill_the_same() {
        for seed in 0..3 {
            let tiling = tiling(Domain::unit(Boundary::Periodic), 1.0 / 110.0, 6.0, seed);
            for window in tiling.windows_of(8) {
                let known = tiling.surroundings(&window);
                let leaves = tiling.leaves(&known);
                let filled = |vectors| {
                    let mut merged = tiling.merge(&tiling.lattice, &known, &window, &leaves);
                    merged.grid.set_vectors(vectors);
                    tiling.fill(&window, &leaves, merged)
                };
                let expected = filled(Level::Portable);
                assert!(Level::available().into_iter().all(|vectors| filled(vectors) == expected));
            }
        }
    }

    /// A sample may be anywhere in its block, and is independent of everything outside the block's surroundings.
    #[test]
    fn surroundings_reach_as_far_as_documented() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let widths = [13.1, 17.0, 22.6, 33.9, 34.0, 50.0, 110.0, 199.0, 201.0, 205.0, 500.0];
            for (seed, width) in widths.into_iter().enumerate() {
                let domain = Domain { min: [0.0; 2], max: [width, 12_000.0 / width], boundary };
                let tiling = tiling(domain, 1.0, 6.0, seed as u64);
                for block in tiling.windows_of(1) {
                    let (held, known) = (tiling.blocks.rect(&block), tiling.surroundings(&block));
                    for axis in 0..2 {
                        let radii = |length: i32| f64::from(length) / tiling.lattice.radius;
                        let size = radii(tiling.lattice.size[axis]);
                        let documented = [22.0, 18.0][axis];
                        let farthest = (held.max[axis] - known.min[axis]).max(known.max[axis] - held.min[axis]);
                        // Around a torus nothing is farther away than half of it.
                        let limit = if boundary == Boundary::Periodic { size / 2.0 } else { size };
                        let distance = radii(farthest).min(limit);
                        assert!(distance <= documented, "{distance} of {size} on axis {axis}");
                    }
                }
            }
        }
    }

    /// The smallest windows with the smallest leaves, where chains of elimination are as long as they get. The listed
    /// seeds, of 0 to 200, are those on which two reaches of the longest chain would be too few for some window.
    #[test]
    fn surroundings_are_enough_and_much_less_is_not() {
        let mut wrong = 0;
        for seed in (0..10).chain([23, 65, 111, 178, 198]) {
            let boundary = if seed % 2 == 0 { Boundary::Periodic } else { Boundary::Bounded };
            let tiling = tiling(Domain::unit(boundary), 1.0 / 110.0, 6.0, seed);
            let whole = samples(&tiling, WINDOW_BLOCKS);
            for block in tiling.windows_of(1) {
                let held = tiling.blocks.rect(&block);
                let (first, last) =
                    (tiling.lattice.position(held.min), tiling.lattice.position(held.max.map(|x| x - 1)));
                let inside = |sample: &&[f32; 2]| (0..2).all(|axis| (first[axis]..=last[axis]).contains(&sample[axis]));
                let expected: Vec<_> = whole.iter().filter(inside).copied().collect();
                let is_right = |known: &Rect| {
                    let mut found = tiling.window_within(&tiling.lattice, known, &block);
                    found.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
                    found == expected
                };
                let known = tiling.surroundings(&block);
                assert!(is_right(&known), "seed {seed}, {block:?}");
                // A boundary of the domain is not to be moved inwards.
                if boundary == Boundary::Periodic {
                    wrong += usize::from(!is_right(&known.grown(-4 * tiling.lattice.separation.reach)));
                }
            }
        }
        assert!(wrong > 0, "windows that know too little come out right");
    }
}
