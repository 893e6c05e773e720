//! Several classes of samples in one plane (Wei 2010; future work in thesis §3.4.6 and ch. 5).
//!
//! Classes are processed by falling own radius; those of equal radii are a *group*, and are filled together at equal
//! rates. Each group fills the part that the samples of the groups before, given samples and its own samples leave it
//! (see Groups below), each of them a disk whose radius is the distance between the two classes (`filling.rs`). If the
//! first group is one class, and the domain is worth tiling, it is a set of KDRT.
//!
//! # Maximality
//! A group ends when for each of its classes every lattice point lies in a disk. Later groups only add disks.
//!
//! # Parts
//! Each group is made by blocks: a part of a group depends on the groups before in a part that is larger by a margin
//! (`stack.rs`).

mod filling;

use crate::classes::Classes;
use crate::error::Result;
use crate::given::Given;
use crate::job::{Job, chunks_of};
use crate::kdrt::{
    blocks::{Blocks, PHASES},
    classes::{filling::ClassFilling, filling::ExclusionDisk},
    options::{Options, Progressive},
    progressive,
    region::{Part, Placed, TiledSamples},
    stack::{Base, Cached, Layer, Stack},
    tiling::Tiling,
};
use crate::math::rounded_down;
use crate::memory;
use crate::plane::{CellAxis, GivenDisks, Lattice, Rect, Separation};
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, Rng, hash};
use crate::simd::{Lanes, Level, Work, run};

/// The groups of a plane of several classes on its lattice.
pub fn stack(job: &Job, lattice: &Lattice, options: &Options, classes: &Classes) -> Result<Stack<Group>> {
    let &Options { ref domain, leaf_size, seed, given, .. } = options;
    let groups = classes.groups();
    let base = match groups[0][..] {
        [class] => {
            let (radius, lattice) = (classes.own(class), lattice.with_radius(classes.own(class)));
            let clearances = given.clearances_of_class(class, classes.count());
            let given = Given { positions: given.positions, clearances: clearances.as_deref() };
            let around = || GivenDisks::new(domain, &lattice, radius, &given);
            let is_tiled = Tiling::is_worthwhile(&lattice, leaf_size);
            is_tiled.then(|| Base::new(job, lattice.clone(), leaf_size, seed, around().into())).transpose()?
        }
        _ => None,
    };
    let base = base.map(|base| (base, Sample { point: [0; 2], class: groups[0][0] as u16, layer: 0 }));
    let filled = (usize::from(base.is_some())..groups.len())
        .map(|number| {
            let stage = Stage { radius: classes.own(groups[number][0]), former: None, layer: 0 };
            Group::new(domain, lattice, classes, number, stage, &given, group_seed(seed, number))
        })
        .collect();
    Ok(Stack::new(lattice.clone(), base, filled))
}

/// The levels of all groups of a plane of several classes, each of which is in progressive order, and the rank of each
/// layer.
pub fn levels(
    lattice: &Lattice,
    options: &Options,
    classes: &Classes,
    levels: &Progressive,
) -> (Stack<Group>, Vec<f32>) {
    let &Options { ref domain, seed, given, .. } = options;
    let (mut layers, mut ranks) = (Vec::new(), Vec::new());
    for (number, members) in classes.groups().iter().enumerate() {
        let (own, seed) = (classes.own(members[0]), group_seed(seed, number));
        let mut former = None;
        for (step, radius) in (0..).zip(progressive::radii(domain, own, levels)) {
            let (stage, seed) = (Stage { radius, former, layer: ranks.len() as u16 }, hash(seed, Draw::Level, &[step]));
            layers.push(Group::new(domain, lattice, classes, number, stage, &given, seed));
            ranks.push(rounded_down(radius.min(progressive::longest(domain))));
            former = Some(radius);
        }
    }
    (Stack::new(lattice.clone(), None, layers), ranks)
}

fn group_seed(seed: u64, number: usize) -> u64 {
    hash(seed, Draw::Group, &[number as u64])
}

/// Puts samples in order, at their positions: in progressive order those of a level at random.
pub fn ordered(ranks: &[f32], mut samples: Vec<Sample>, position: impl Fn([i32; 2]) -> [f32; 2]) -> Points<2> {
    let shuffled = |[x, y]: [i32; 2]| {
        if ranks.is_empty() { 0 } else { hash(0, Draw::Level, &[x as u64, y as u64]) }
    };
    let key = |sample: &Sample| (sample.class, sample.layer, shuffled(sample.point), sample.point[1], sample.point[0]);
    samples.sort_unstable_by_key(key);
    let ranked = if ranks.is_empty() { &[][..] } else { &samples[..] };
    Points {
        positions: samples.iter().map(|sample| position(sample.point)).collect(),
        classes: samples.iter().map(|sample| sample.class.into()).collect(),
        ranks: ranked.iter().map(|sample| ranks[usize::from(sample.layer)]).collect(),
        ..Points::default()
    }
}

// # Groups
//
// A group: classes of one own radius, filled together around the samples of the groups before and given samples.
//
// By fill blocks and phases like the gaps of KDRT (`blocks.rs`), but blocks are so wide that the largest distance
// between classes of the group does not reach over them, and in two passes (see below). Blocks of one phase share
// nothing; each is filled with regard to the groups before and to the samples so far of the blocks around it. A torus
// that is too narrow for blocks is filled as a whole.

/// Blocks that one task fills, one after the other.
const BLOCKS_PER_TASK: usize = 64;

/// The radius by which the samples of the groups before are sorted into tiles ([`TiledSamples::new`]), as a share of their
/// smallest own radius: chosen so that a tile has a few of them.
const TILE: f64 = 0.25;

/// Darts of the first pass for each cell that is not covered. With half as many, sets have 0.1 % more samples; with
/// twice as many it takes longer.
const FIRST_DARTS: usize = 2;

/// Available memory is checked for fillings only where they take more than this, as the query is slow.
const FEWEST_BYTES: f64 = 1e7;

/// A sample of a class.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub point: [i32; 2],
    pub class: u16,
    /// The number of its layer in the stack, in progressive order; otherwise 0.
    pub layer: u16,
}

impl Placed for Sample {
    fn point(&self) -> [i32; 2] {
        self.point
    }

    fn moved_to(self, point: [i32; 2]) -> Self {
        Self { point, ..self }
    }
}

/// A group of a plane.
pub struct Group {
    /// The lattice with the own radius of the classes.
    lattice: Lattice,
    classes: Vec<usize>,
    /// For each class of the group, and each class of the plane, the separation of samples of the latter from those of
    /// the former. None where they ignore each other and where there is no sample yet.
    separations: Vec<Vec<Option<Separation>>>,
    /// For each class of the group, the disks of the given samples.
    around: Vec<GivenDisks>,
    /// The largest distance, along each axis, at which samples of the layers before matter.
    sight: [i32; 2],
    /// The largest distance, along an axis, at which samples of the group matter.
    reach: i32,
    /// The smallest own radius of the layers before, in lattice units.
    before: f64,
    /// None on a torus on which blocks could see themselves: it is filled as a whole.
    blocks: Option<Blocks>,
    seed: u64,
    layer: u16,
    pub level: Level,
}

/// The samples known when a block is filled.
pub struct Known<'a> {
    blocks: &'a Blocks,
    /// The samples of the groups before.
    before: &'a TiledSamples<Sample>,
    /// The samples of the group made so far.
    made: &'a BlockSamples,
}

/// The stage at which a group is made: the whole of it or, in progressive order, a level.
#[derive(Clone, Copy)]
pub struct Stage {
    /// The own radius. Those between the classes of the group are multiplied as it is.
    pub radius: f64,
    /// The own radius of the level before.
    pub former: Option<f64>,
    /// The number of the layer in the stack.
    pub layer: u16,
}

impl Group {
    /// The group with this number, in the order of falling own radius. The lattice is that of the domain.
    pub fn new(
        domain: &Domain,
        lattice: &Lattice,
        classes: &Classes,
        number: usize,
        stage: Stage,
        given: &Given<2>,
        seed: u64,
    ) -> Self {
        let groups = classes.groups();
        let (before, members) = (groups[..number].concat(), groups[number].clone());
        let own = classes.own(members[0]);
        let scale = stage.radius / own;
        let between = |class: usize, other: usize| {
            classes.radius(class, other) * if members.contains(&other) { scale } else { 1.0 }
        };
        let lattice = lattice.with_radius(stage.radius);
        let separations: Vec<Vec<_>> = members
            .iter()
            .map(|&class| {
                let known = |other: &usize| before.contains(other) || members.contains(other);
                let kept = |other| Some(between(class, other)).filter(|&radius| radius > 0.0 && known(&other));
                (0..classes.count())
                    .map(|other| kept(other).map(|radius| lattice.with_radius(radius).separation))
                    .collect()
            })
            .collect();
        let longest = |others: &[usize]| {
            let pairs = members.iter().flat_map(|&class| others.iter().map(move |&other| between(class, other)));
            pairs.fold(0.0, f64::max)
        };
        let in_group = if stage.former.is_some() { longest(&members) } else { 0.0 };
        let sight = lattice.with_radius(longest(&before).max(in_group)).separation.reach;
        let sight = lattice.size.map(|size| match lattice.boundary {
            // Of a sample whose disk reaches around the torus, the nearest image excludes all that any image does.
            Boundary::Periodic => sight.min(size / 2 + 1),
            Boundary::Bounded => sight,
        });
        let widest = lattice.with_radius(longest(&members));
        let around = |&class: &usize| {
            let clearances = given.clearances_of_class(class, classes.count());
            let given = Given { positions: given.positions, clearances: clearances.as_deref() };
            GivenDisks::new(domain, &lattice.with_radius(own), own, &given)
        };
        let smallest = groups[..number].last().map(|group| classes.own(group[0]));
        let smallest = stage.former.into_iter().chain(smallest).reduce(f64::min);
        Self {
            around: members.iter().map(around).collect(),
            separations,
            sight,
            reach: widest.separation.reach,
            before: smallest.map_or(lattice.radius, |radius| lattice.with_radius(radius).radius),
            blocks: Blocks::fit(&widest).then(|| Blocks::new(&widest, seed)),
            seed,
            layer: stage.layer,
            level: Level::widest(),
            classes: members,
            lattice,
        }
    }

    /// The lattice points whose samples of the groups before matter to a rectangle.
    fn seen_from(&self, rect: &Rect) -> Rect {
        let [x, y] = self.sight;
        Rect { min: [rect.min[0] - x, rect.min[1] - y], max: [rect.max[0] + x, rect.max[1] + y] }
    }

    /// Fills a narrow torus as a whole.
    fn fill_torus(&self, job: &Job, before: &[Sample]) -> Result<Vec<Sample>> {
        self.require_memory(self.lattice.size, 1)?;
        let [width, height] = self.lattice.size;
        let images: Vec<_> = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x * width, y * height])).collect();
        let mut filling = ClassFilling::default();
        self.begin(&mut filling, &self.lattice.rect());
        before.iter().for_each(|sample| self.exclude_images(&mut filling, sample, &images));
        let mut rng = Rng::at(self.seed, Draw::Darts, &[]);
        let samples = self.throw(&mut filling, &mut rng, Pass::Only, &images);
        job.report(1.0)?;
        Ok(samples)
    }

    /// Refuses fillings of a size, for a number of threads, that do not fit in memory.
    fn require_memory(&self, size: [i32; 2], threads: usize) -> Result<()> {
        let cells: f64 =
            size.into_iter().map(|size| f64::from(CellAxis::new(size, self.lattice.radius).count())).product();
        let bytes = cells * self.classes.len() as f64 * ClassFilling::BYTES_PER_CELL;
        if bytes < FEWEST_BYTES {
            return Ok(());
        }
        memory::require(bytes * threads as f64, "radii", &format!("fill blocks of {cells:.0} cells"))
    }

    /// Begins with a rectangle and the given samples around it.
    #[inline(always)]
    fn begin(&self, filling: &mut ClassFilling, rect: &Rect) {
        filling.begin(rect, self.classes.len(), self.lattice.radius);
        for (class, around) in self.around.iter().enumerate() {
            around.near(rect).iter().for_each(|disk| filling.exclude(class, &ExclusionDisk::of_given(disk)));
        }
    }

    /// Puts the disks of a sample in a filling.
    #[inline(always)]
    fn exclude(&self, filling: &mut ClassFilling, sample: &Sample) {
        for (class, separations) in self.separations.iter().enumerate() {
            if let Some(separation) = separations[sample.class as usize] {
                filling.exclude(class, &ExclusionDisk::around(sample.point, separation.threshold));
            }
        }
    }

    /// Puts the disks of images of a sample in a filling.
    #[inline(always)]
    fn exclude_images(&self, filling: &mut ClassFilling, sample: &Sample, images: &[[i32; 2]]) {
        for [x, y] in images {
            self.exclude(filling, &Sample { point: [sample.point[0] + x, sample.point[1] + y], ..*sample });
        }
    }

    /// Throws the darts of a pass, and puts the disks of the images of each new sample in the filling.
    #[inline(always)]
    fn throw(&self, filling: &mut ClassFilling, rng: &mut Rng, pass: Pass, images: &[[i32; 2]]) -> Vec<Sample> {
        let mut samples = Vec::new();
        filling.open(if pass == Pass::Last { 0 } else { FIRST_DARTS });
        let next = |filling: &mut ClassFilling, rng: &mut Rng| match pass {
            Pass::First => filling.next_before_cut(rng),
            Pass::Last | Pass::Only => filling.next_sample(rng),
        };
        while let Some((class, point)) = next(filling, rng) {
            let sample = Sample { point, class: self.classes[class] as u16, layer: self.layer };
            self.exclude_images(filling, &sample, images);
            samples.push(sample);
        }
        samples
    }
}

/// Returns the samples that a pass adds to a block.
struct FillBlock<'a> {
    group: &'a Group,
    filling: &'a mut ClassFilling,
    known: &'a Known<'a>,
    place: [i32; 2],
    pass: Pass,
}

impl Work for FillBlock<'_> {
    type Out = Vec<Sample>;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Vec<Sample> {
        let Self { group, filling, known: &Known { blocks, before, made }, place, pass } = self;
        let block = Rect { min: place, max: place.map(|index| index + 1) };
        let rect = blocks.rect(&block);
        group.begin(filling, &rect);
        // Loops, since the compiler does not inline closures as large as this, and so not for the level.
        let mut seen = Vec::new();
        before.visit(&group.seen_from(&rect), |sample| seen.push(sample));
        for sample in &seen {
            group.exclude(filling, sample);
            if filling.is_covered() {
                return Vec::new();
            }
        }
        let near = rect.grown(group.reach);
        for sample in made.of_blocks(&block.grown(1)).filter(|sample| near.contains(sample.point)) {
            group.exclude(filling, &sample);
        }
        let rng = &mut Rng::at(blocks.rng(place).bits(), Draw::Darts, &[pass as u64]);
        group.throw(filling, rng, pass, &[[0, 0]])
    }
}

impl Cached for Group {
    fn blocks(&self) -> Option<&Blocks> {
        self.blocks.as_ref()
    }
}

impl Layer for Group {
    type Sample = Sample;

    fn expected(&self, part: &Part) -> f64 {
        self.classes.len() as f64 * self.lattice.samples_in(&part.rect)
    }

    /// True if no part of the group can be made without the rest.
    fn is_kept(&self) -> bool {
        self.blocks.is_none()
    }

    fn around(&self, part: &Part) -> Part {
        match &self.blocks {
            Some(blocks) => {
                let filled = blocks.filled(&first_window(blocks, &blocks.holding(&part.rect)));
                Part::new(&self.lattice, &self.seen_from(&blocks.rect(&filled)))
            }
            None => Part::whole(&self.lattice),
        }
    }

    fn sorted(&self, part: Part, before: &[Sample]) -> TiledSamples<Sample> {
        TiledSamples::new(part, before, TILE * self.before)
    }

    fn fill(&self, job: &Job, before: &TiledSamples<Sample>, part: &Part) -> Result<Vec<Sample>> {
        let Some(blocks) = &self.blocks else {
            let samples = self.fill_torus(job, before.samples())?;
            return Ok(TiledSamples::new(Part::whole(&self.lattice), &samples, self.lattice.radius).samples_of(part));
        };
        self.require_memory(blocks.largest(), job.context().num_threads())?;
        let window = blocks.holding(&part.rect);
        let first = first_window(blocks, &window);
        let mut made = BlockSamples::new(&self.lattice, blocks, &window, &blocks.filled(&first));
        for (pass, window, [from, to]) in [(Pass::First, first, [0.0, 0.4]), (Pass::Last, window, [0.4, 1.0])] {
            let job = job.part(from, to);
            for (share, phase) in (0..).zip(PHASES) {
                let mut places = blocks.of_phase(&window, phase);
                places.retain(|&place| made.holds(place));
                let known = Known { blocks, before, made: &made };
                let tasks = chunks_of(places.len(), BLOCKS_PER_TASK);
                let job = job.part(f64::from(share) / 4.0, f64::from(share + 1) / 4.0);
                let filled = job.map(tasks.len(), |task| {
                    let mut filling = ClassFilling::default();
                    let mut fill = |place| {
                        run(self.level, FillBlock { group: self, filling: &mut filling, known: &known, place, pass })
                    };
                    places[tasks.range(task)].iter().map(|&place| fill(place)).collect::<Vec<_>>()
                })?;
                places
                    .into_iter()
                    .zip(filled.into_iter().flatten())
                    .for_each(|(place, samples)| made.add(place, samples));
            }
        }
        Ok(made.of_blocks(&window).filter(|sample| part.rect.contains(sample.point)).collect())
    }
}

// # The passes over the blocks of a group
//
// The passes over the blocks of a group, and the samples that they have made.
//
// One dart after the other, anywhere, would give the density of random sequential placement. If each block were filled
// completely, one next to a finished block would have its samples nearer to that edge than sequential placement puts
// them: sets would have 2 % more samples. So a first pass throws a few darts at each block, which make most of the
// samples at densities where edges matter little, and the last fills the rest. Sets still have up to 0.4 % more.

/// The darts that are thrown at a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pass {
    /// A few darts for each cell.
    First,
    /// Darts until everything is covered, after the first pass.
    Last,
    /// Both passes at once.
    Only,
}

/// The blocks in which the first pass must be done for the last to fill a window of blocks: those that it fills, and
/// those that touch them.
pub fn first_window(blocks: &Blocks, window: &Rect) -> Rect {
    blocks.grown(&blocks.filled(window), [1, 1])
}

/// The samples that a rectangle of blocks has so far.
pub struct BlockSamples {
    /// The blocks held; along an axis on which the window has all blocks of a torus, each of them once.
    blocks: Rect,
    /// The numbers of blocks and of lattice points along such an axis.
    periods: [Option<[i32; 2]>; 2],
    samples: Vec<Vec<Sample>>,
}

impl BlockSamples {
    /// No samples yet in the blocks that are filled for a window.
    pub fn new(lattice: &Lattice, blocks: &Blocks, window: &Rect, filled: &Rect) -> Self {
        let (mut held, mut periods) = (*filled, [None; 2]);
        for (axis, count) in blocks.counts().into_iter().enumerate() {
            if lattice.boundary == Boundary::Periodic && window.length(axis) >= count {
                (held.min[axis], held.max[axis]) = (window.min[axis], window.min[axis] + count);
                periods[axis] = Some([count, lattice.size[axis]]);
            }
        }
        let count = held.length(0) as usize * held.length(1) as usize;
        Self { blocks: held, periods, samples: vec![Vec::new(); count] }
    }

    /// True if a block is held here, and is not an image of one that is.
    pub fn holds(&self, place: [i32; 2]) -> bool {
        self.blocks.contains(place)
    }

    fn index(&self, [column, row]: [i32; 2]) -> usize {
        let [x, y] = [column - self.blocks.min[0], row - self.blocks.min[1]].map(|index| index as usize);
        y * self.blocks.length(0) as usize + x
    }

    /// Adds samples to a block that is held.
    pub fn add(&mut self, place: [i32; 2], samples: Vec<Sample>) {
        let index = self.index(place);
        match &mut self.samples[index] {
            made if made.is_empty() => *made = samples,
            made => made.extend(samples),
        }
    }

    /// The samples in a rectangle of blocks, row by row of them; images where it extends beyond the edges of the torus.
    #[inline(always)]
    pub fn of_blocks(&self, blocks: &Rect) -> impl Iterator<Item = Sample> {
        let Rect { min, max } = *blocks;
        let places = (min[1]..max[1]).flat_map(move |y| (min[0]..max[0]).map(move |x| [x, y]));
        places.flat_map(|mut place| {
            let mut shift = [0; 2];
            for (axis, period) in self.periods.into_iter().enumerate() {
                if let Some([count, size]) = period {
                    let turns = (place[axis] - self.blocks.min[axis]).div_euclid(count);
                    shift[axis] = turns * size;
                    place[axis] -= turns * count;
                }
            }
            let samples = if self.holds(place) { &self.samples[self.index(place)][..] } else { &[] };
            samples.iter().map(move |sample| Sample {
                point: [sample.point[0] + shift[0], sample.point[1] + shift[1]],
                ..*sample
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::classes::Classes;
    use crate::job::Context;
    use crate::kdrt::classes::stack;
    use crate::kdrt::options::Options;
    use crate::plane::Lattice;
    use crate::points::{Boundary, Domain};

    #[test]
    fn all_levels_make_the_same_samples() {
        let classes = Classes::new(
            4,
            &[0.04, 0.0, 0.03, 0.01, 0.0, 0.02, 0.015, 0.03, 0.03, 0.015, 0.02, 0.0, 0.01, 0.03, 0.0, 0.008],
        );
        let classes = classes.unwrap();
        let options = Options::classes(&classes).seed(5);
        let lattice = Lattice::of_any_size(&Domain::unit(Boundary::Periodic), f64::MAX).unwrap();
        let set = |level: Level| {
            Context::new(1).unwrap().run(None, |job| {
                let mut groups = stack(job, &lattice, &options, &classes)?;
                groups.layers_mut().iter_mut().for_each(|group| group.level = level);
                groups.whole(job)
            })
        };
        let portable = set(Level::Portable).unwrap();
        assert!(portable.len() > 1000);
        assert!(Level::available().into_iter().all(|level| set(level).unwrap() == portable));
    }
}
