//! KDRT in space: leaves of a random kd-tree, into which parts of a pattern are laid, and the samples that stay where leaves
//! meet (thesis §2.3).
//!
//! # Conquer
//! A point of a clip goes if *any* point of the clip of a leaf of higher rank conflicts with it, whether that one stays or
//! not. Of two points in conflict the one in the leaf of lower rank goes, so none of those that stay conflict; and what
//! happens to a point depends on the clips within one reach of it, where the rule of the plane (`kdrt/conquer.rs`), by which
//! only points that stay eliminate others, has chains.
//!
//! # What is open then
//! The pattern is maximal: each lattice point of it conflicts with a sample of it. So a lattice point of the domain is open only
//! if such a sample lies outside of its leaf, and then it is within a reach of the leaf's faces; or if all such samples were
//! eliminated, by another leaf or in a given ball, and then it conflicts with an eliminated point. These places are the
//! ones that are filled (`exposed.rs`).

use std::sync::Arc;

use crate::error::Result;
use crate::job::Job;
use crate::kdrt::Tree;
use crate::plane::{Disk, Lattice, Rect};
use crate::points::{Boundary, MAXIMAL_DENSITY_IN_SPACE};
use crate::rng::{Draw, hash};
use crate::simd::Level;
use crate::volume::clip::{Clip, Pattern, pattern_side};
use crate::volume::exposed::Exposed;
use crate::volume::grid::Grid;
use crate::volume::search::Centre;

/// True if a cuboid is larger than the pattern that it would be tiled with, and if on a torus no leaf is its own neighbour.
pub fn is_worthwhile(lattice: &Lattice<3>, leaf_size: f64) -> bool {
    let (sides, pattern) = (lattice.size.map(|size| f64::from(size) / lattice.radius), pattern_side(leaf_size));
    let leaves = if lattice.boundary == Boundary::Periodic { 2.0 } else { 1.0 };
    let is_wide = |side: f64| side >= leaves * (leaf_size + 1.0);
    sides.into_iter().all(is_wide) && sides.into_iter().product::<f64>() > pattern * pattern * pattern
}

/// The leaves of a cuboid and its pattern.
pub struct Tiling<'a> {
    lattice: &'a Lattice<3>,
    pattern: Arc<Pattern>,
    tree: Tree<3>,
}

/// The samples of clips in a box that stay, and the others.
#[derive(Default)]
pub struct Conquered {
    pub samples: Vec<Centre>,
    pub eliminated: Vec<Centre>,
}

impl<'a> Tiling<'a> {
    /// The tiling of a cuboid that is worth it. The pattern is that of the context, if it keeps it, or made by instructions of
    /// some level.
    pub fn new(job: &Job, lattice: &'a Lattice<3>, leaf_size: f64, seed: u64, level: Level) -> Result<Self> {
        // Neither darts nor splits are those of the blocks.
        let [of_pattern, of_leaves] = [0, 1].map(|use_| hash(seed, Draw::Clip, &[use_]));
        let pattern = Pattern::kept(job, lattice, leaf_size, of_pattern, level)?;
        let shortest = (leaf_size * lattice.radius).ceil() as i32;
        Ok(Self { lattice, pattern, tree: Tree::new(lattice.rect(), [shortest; 3], of_leaves) })
    }

    /// The clips of the leaves that meet a box, with all their images that do, by falling rank. The box may reach beyond the
    /// domain.
    pub fn clips(&self, rect: &Rect<3>) -> Vec<Clip<'_>> {
        let Lattice { size, boundary, .. } = *self.lattice;
        let rect = if boundary == Boundary::Bounded { rect.intersection(&self.lattice.rect()) } else { *rect };
        let turns = |axis: usize| {
            let turns = rect.min[axis].div_euclid(size[axis])..=(rect.max[axis] - 1).div_euclid(size[axis]);
            turns.map(move |turn| turn * size[axis])
        };
        let images = turns(2).flat_map(|z| turns(1).flat_map(move |y| turns(0).map(move |x| [x, y, z])));
        let mut ranked = Vec::new();
        for image in images {
            for leaf in self.tree.leaves(&rect.translated(image.map(|x| -x))) {
                ranked.push((leaf.rank(), self.pattern.clip(&leaf).translated(image)));
            }
        }
        ranked.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.rect.min.cmp(&b.1.rect.min)));
        ranked.into_iter().map(|(_, clip)| clip).collect()
    }

    /// The samples of the clips in a block, and what of them is eliminated, also by given balls, which may have points of the
    /// block. The grid's memory is used.
    pub fn conquer(&self, block: &Rect<3>, given: &[Disk<3>], grid: &mut Grid) -> Conquered {
        let Lattice { radius, separation, .. } = *self.lattice;
        let clips = self.clips(&block.grown(separation.reach));
        if !given.is_empty() {
            grid.reset(block, radius, separation, given);
        }
        let most =
            1.1 * MAXIMAL_DENSITY_IN_SPACE * (0..3).map(|k| f64::from(block.length(k)) / radius).product::<f64>();
        let mut conquered = Conquered { samples: Vec::with_capacity(most as usize), eliminated: Vec::new() };
        for (number, clip) in clips.iter().enumerate() {
            let part = clip.rect.intersection(block);
            // Deeper inside than this, no point of another leaf conflicts.
            let inside = clip.rect.grown(-separation.reach);
            let beyond = part.grown(separation.reach);
            let rivals: Vec<_> =
                clips[..number].iter().filter(|rival| !rival.rect.intersection(&beyond).is_empty()).collect();
            let conflicts = |point: Centre| {
                rivals.iter().any(|rival| rival.conflicts(point, separation.reach, separation.threshold))
            };
            clip.find(&part, |point| {
                let is_lost = !inside.contains(point) && conflicts(point);
                if is_lost || !given.is_empty() && grid.given_covers(point) {
                    conquered.eliminated.push(point);
                } else {
                    conquered.samples.push(point);
                }
                false
            });
        }
        conquered.samples.shrink_to_fit();
        conquered
    }

    /// The places of a region that may be open, by the eliminated points whose balls may have some, with their images.
    pub fn exposed(&self, region: &Rect<3>, eliminated: Vec<Centre>) -> Exposed {
        let reach = self.lattice.separation.reach;
        let inside = self.clips(region).into_iter().map(|clip| clip.rect.grown(-reach)).filter(|rect| !rect.is_empty());
        Exposed::new(region, inside.collect(), eliminated, reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::Given;
    use crate::job::Context;
    use crate::plane::GivenDisks;
    use crate::points::Domain;
    use crate::rng::Rng;
    use crate::volume::search::square;
    use crate::volume::set::Set;
    use crate::volume::space::Space;

    const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

    const SPACING: f64 = f32::EPSILON as f64;

    /// The radius in lattice units: the cells of a grid need 15.6 at least, and each lattice point is looked at.
    const RADIUS: f64 = 16.0;

    /// A cuboid of so many floats.
    fn coarse(size: [i32; 3], boundary: Boundary) -> (Domain<3>, Lattice<3>) {
        let domain = Domain { min: [1.0; 3], max: size.map(|x| 1.0 + f64::from(x) * SPACING), boundary };
        let lattice = Lattice::of_any_size(&domain, 64.0 * SPACING).unwrap().with_radius(RADIUS * SPACING);
        assert_eq!(lattice.size, size);
        (domain, lattice)
    }

    fn tiled(context: &Context, space: Space, leaf_size: f64, seed: u64, level: Level) -> Vec<Centre> {
        context.run(None, |job| Set::tiled(job, space, leaf_size, seed, level)).unwrap().into_points()
    }

    /// The lattice points that lie nearer than the radius to a sample, one after the other: a bit of `covered` for each. On a
    /// torus no period is below twice the radius.
    fn cover(lattice: &Lattice<3>, samples: &[Centre], covered: &mut [bool]) {
        let [width, height, depth] = lattice.size;
        let steps = -lattice.separation.reach..=lattice.separation.reach;
        for sample in samples {
            for (z, y) in steps.clone().flat_map(|z| steps.clone().map(move |y| (z, y))) {
                for x in steps.clone().filter(|&x| square([x, y, z], [0; 3]) < lattice.separation.threshold) {
                    let mut point = [sample[0] + x, sample[1] + y, sample[2] + z];
                    if lattice.boundary == Boundary::Periodic {
                        point = std::array::from_fn(|axis| point[axis].rem_euclid(lattice.size[axis]));
                    }
                    if lattice.rect().contains(point) {
                        covered[((point[2] * height + point[1]) * width + point[0]) as usize] = true;
                    }
                }
            }
        }
        assert_eq!(covered.len(), (width * height * depth) as usize);
    }

    fn conflict(lattice: &Lattice<3>, samples: &[Centre]) -> Option<[Centre; 2]> {
        let along = |axis: usize, a: Centre, b: Centre| {
            let d = (a[axis] - b[axis]).abs();
            if lattice.boundary == Boundary::Periodic { d.min(lattice.size[axis] - d) } else { d }
        };
        let squared = |a: Centre, b: Centre| square(std::array::from_fn(|axis| along(axis, a, b)), [0; 3]);
        let pairs = samples.iter().enumerate().flat_map(|(i, &a)| samples[..i].iter().map(move |&b| [a, b]));
        pairs.into_iter().find(|&[a, b]| squared(a, b) < lattice.separation.threshold)
    }

    /// Cuboids of few floats with leaves from a third of a side to the whole, in which every lattice point is tested.
    #[test]
    fn tiled_sets_leave_no_lattice_point_open_and_have_no_conflict() {
        let context = Context::new(2).unwrap();
        // The last are thinner than a block, a leaf, and a radius.
        let sizes = [
            ([100, 96, 113], 6.0),
            ([160, 150, 170], 6.0),
            ([170, 75, 60], 3.0),
            ([96, 97, 40], 2.5),
            ([150, 130, 24], 1.5),
        ];
        let flat = [([200, 240, 50], 3.0), ([360, 60, 12], 6.0), ([80, 80, 80], 6.0)];
        for (boundary, (size, leaf_size)) in
            BOUNDARIES.into_iter().flat_map(|b| sizes.into_iter().chain(flat).map(move |c| (b, c)))
        {
            if boundary == Boundary::Periodic && size.into_iter().any(|size| f64::from(size) < 2.0 * RADIUS * leaf_size)
            {
                continue;
            }
            for seed in 0..2 {
                let (domain, lattice) = coarse(size, boundary);
                for balls in [0, 12] {
                    let mut rng = Rng::at(seed, Draw::Probe, &[]);
                    let place = |rng: &mut Rng| {
                        [0, 1, 2].map(|k: usize| 1.0 + (rng.unit() * f64::from(size[k]) * SPACING) as f32)
                    };
                    let positions: Vec<_> = (0..balls).map(|_| place(&mut rng)).collect();
                    let clearances: Vec<_> = (0..balls).map(|i| [8.0, 18.0, 42.0][i % 3] * SPACING).collect();
                    let given = Given::with_clearances(&positions, &clearances);
                    let given = GivenDisks::new(&domain, &lattice, RADIUS * SPACING, &given);
                    let space = Space { lattice: &lattice, given: &given, solid: None };
                    let samples = tiled(&context, space, leaf_size, seed, Level::widest());
                    assert_eq!(conflict(&lattice, &samples), None, "{size:?} {leaf_size} {boundary:?} {seed}");
                    let mut covered = vec![false; size.into_iter().product::<i32>() as usize];
                    cover(&lattice, &samples, &mut covered);
                    let disks = given.near(&lattice.rect());
                    let in_disk = |point: Centre| {
                        disks.iter().any(|disk| disk.reaches(|axis| f64::from(point[axis]) - disk.centre[axis]))
                    };
                    assert!(samples.iter().all(|&sample| lattice.rect().contains(sample) && !in_disk(sample)));
                    for index in (0..covered.len()).filter(|&index| !covered[index]) {
                        let [width, height] = [size[0] as usize, size[1] as usize];
                        let point = [index % width, index / width % height, index / width / height].map(|x| x as i32);
                        assert!(in_disk(point), "{point:?} of {size:?} {leaf_size} {boundary:?} {seed}");
                    }
                }
            }
        }
    }

    #[test]
    fn all_levels_of_vector_instructions_and_any_threads_make_the_same_tiled_set() {
        for boundary in BOUNDARIES {
            let (_, lattice) = coarse([460, 380, 400], boundary);
            let given = GivenDisks::default();
            let space = Space { lattice: &lattice, given: &given, solid: None };
            // Each makes its own pattern.
            let made = |threads: usize, level: Level| tiled(&Context::new(threads).unwrap(), space, 6.0, 4, level);
            let portable = made(1, Level::Portable);
            assert!(portable.len() > 11_000);
            assert!(Level::available().into_iter().all(|level| made(2, level) == portable));
        }
    }

    /// The rule of conquering in words, over all points of all clips at once, and the lattice points that are open then: all
    /// lie where the block looks for them.
    #[test]
    fn a_point_goes_if_any_point_of_a_higher_leaf_conflicts() {
        let context = Context::new(1).unwrap();
        for (boundary, seed) in BOUNDARIES.into_iter().flat_map(|b| (0..3).map(move |seed| (b, seed))) {
            let (_, lattice) = coarse([240, 200, 220], boundary);
            let tiling = context.run(None, |job| Tiling::new(job, &lattice, 5.0, seed, Level::widest())).unwrap();
            let all = |grown: i32| -> Vec<(usize, Centre)> {
                let rect = lattice.rect().grown(grown);
                let clips = tiling.clips(&rect).into_iter().enumerate();
                let mut points = Vec::new();
                for (rank, clip) in clips {
                    clip.find(&clip.rect.intersection(&rect), |point| {
                        points.push((rank, point));
                        false
                    });
                }
                points
            };
            // Clips with their images, so that no distance wraps.
            let near = all(lattice.separation.reach);
            let goes = |rank: usize, point: Centre| {
                let conflicts = |other: Centre| square(point, other) < lattice.separation.threshold;
                near.iter().any(|&(higher, other)| higher < rank && conflicts(other))
            };
            let inside = near.iter().filter(|(_, point)| lattice.rect().contains(*point));
            let [mut stay, mut others] = [Vec::new(), Vec::new()];
            inside.for_each(|&(rank, point)| if goes(rank, point) { others.push(point) } else { stay.push(point) });
            let Conquered { samples: mut found, mut eliminated } =
                tiling.conquer(&lattice.rect(), &[], &mut Grid::default());
            assert!(others.len() > 50 && stay.len() > 1_000, "{} {}", others.len(), stay.len());
            [&mut stay, &mut others, &mut found, &mut eliminated].into_iter().for_each(|points| points.sort_unstable());
            assert_eq!((found, eliminated), (stay, others));
        }
    }

    #[test]
    fn cuboids_that_are_smaller_than_the_pattern_or_two_leaves_are_not_tiled() {
        let is_tiled = |sides: [f64; 3], leaf_size: f64, boundary: Boundary| {
            let lattice = Lattice::of_any_size(&Domain { min: [0.0; 3], max: sides, boundary }, 1.0).unwrap();
            is_worthwhile(&lattice, leaf_size)
        };
        assert!(is_tiled([36.0; 3], 6.0, Boundary::Periodic) && !is_tiled([34.0; 3], 6.0, Boundary::Periodic));
        assert!(!is_tiled([41.0; 3], 20.5, Boundary::Bounded) && is_tiled([42.0; 3], 20.5, Boundary::Bounded));
        assert!(is_tiled([70.0, 200.0, 22.0], 20.0, Boundary::Bounded));
        assert!(!is_tiled([70.0, 200.0, 22.0], 20.0, Boundary::Periodic));
        assert!(!is_tiled([100.0; 3], 1e300, Boundary::Bounded));
    }
}
