//! A group: classes of one own radius, filled together around the samples of the groups before and given samples.
//!
//! By fill blocks and phases like the gaps of KDRT (`blocks.rs`), but blocks are so wide that the largest distance
//! between classes of the group does not reach over them, and in two passes (`passes.rs`). Blocks of one phase share
//! nothing; each is filled with regard to the groups before and to what the blocks around it have so far. A torus that is
//! too narrow for blocks is filled as a whole.

use crate::classes::Classes;
use crate::error::Result;
use crate::given::Given;
use crate::job::{Job, chunks_of};
use crate::memory;
use crate::plane::CellAxis;
use crate::plane::lattice::{Lattice, Separation};
use crate::plane::rect::Rect;
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng, hash};

use crate::kdrt::around::Around;
use crate::kdrt::blocks::{Blocks, PHASES};
use crate::kdrt::classes::passes::{Made, Pass, first_window};
use crate::kdrt::classes::room::{Circle, Room};
use crate::kdrt::region::{Part, Placed, Region};
use crate::kdrt::stack::Layer;
use crate::simd::Level;

/// Blocks that one task fills, one after the other.
const BLOCKS_PER_TASK: usize = 64;

/// The radius by which the samples of the groups before are sorted in tiles ([`Region::new`]), as a share of the
/// smallest of theirs: so that a tile has a few of them.
const TILE: f64 = 0.25;

/// Darts of the first pass for each cell that is not covered. With half as many, sets have 0.1 % more samples; with
/// twice as many it takes longer.
const FIRST_DARTS: usize = 2;

/// Memory is asked for rooms only where they take more than this: it takes long to ask.
const FEWEST_BYTES: f64 = 1e7;

/// A sample of a class.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub point: [i32; 2],
    pub class: u32,
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
    /// With the own radius of the classes.
    lattice: Lattice,
    classes: Vec<usize>,
    /// For each class of the group, and each class of the plane, what samples of the latter keep from those of the
    /// former. None where they ignore each other and where there is no sample yet.
    separations: Vec<Vec<Option<Separation>>>,
    /// For each class of the group, what given samples keep from it.
    around: Vec<Around>,
    /// Along each axis the largest distance at which samples of the groups before matter.
    sight: [i32; 2],
    /// Along an axis the largest distance at which samples of the group matter.
    reach: i32,
    /// The smallest own radius of the groups before, in lattice units.
    before: f64,
    /// None on a torus on which blocks could see themselves: it is filled as a whole.
    blocks: Option<Blocks>,
    seed: u64,
    pub level: Level,
}

/// What is known where a block is filled.
pub struct Known<'a> {
    blocks: &'a Blocks,
    /// The samples of the groups before.
    before: &'a Region<Sample>,
    /// Those of the group that there are so far.
    made: &'a Made,
}

impl Group {
    /// The group with this number, of those by falling own radius. The lattice is that of the domain.
    pub fn new(
        domain: &Domain,
        lattice: &Lattice,
        classes: &Classes,
        number: usize,
        given: &Given<2>,
        seed: u64,
    ) -> Self {
        let groups = classes.groups();
        let (before, members) = (groups[..number].concat(), groups[number].clone());
        let lattice = lattice.with_radius(classes.own(members[0]));
        let separations: Vec<Vec<_>> = members
            .iter()
            .map(|&class| {
                let known = |other: &usize| before.contains(other) || members.contains(other);
                let kept = |other| Some(classes.radius(class, other)).filter(|&radius| radius > 0.0 && known(&other));
                (0..classes.count())
                    .map(|other| kept(other).map(|radius| lattice.with_radius(radius).separation))
                    .collect()
            })
            .collect();
        let longest = |others: &[usize]| {
            let pairs = members.iter().flat_map(|&class| others.iter().map(move |&other| classes.radius(class, other)));
            pairs.fold(0.0, f64::max)
        };
        let sight = lattice.with_radius(longest(&before)).separation.reach;
        let sight = lattice.size.map(|size| match lattice.boundary {
            // Of a sample that reaches around, the nearest image is in the way of what any is.
            Boundary::Periodic => sight.min(size / 2 + 1),
            Boundary::Bounded => sight,
        });
        let seed = hash(seed, Draw::Group, &[number as u64]);
        let widest = lattice.with_radius(longest(&members));
        let around = |&class: &usize| {
            let clearances = given.clearances_of_class(class, classes.count());
            let given = Given { positions: given.positions, clearances: clearances.as_deref() };
            Around::new(domain, &lattice, classes.own(class), &given)
        };
        Self {
            around: members.iter().map(around).collect(),
            separations,
            sight,
            reach: widest.separation.reach,
            before: groups[..number]
                .last()
                .map_or(lattice.radius, |group| lattice.with_radius(classes.own(group[0])).radius),
            blocks: Blocks::fit(&widest).then(|| Blocks::new(&widest, seed)),
            seed,
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

    /// The samples that a pass adds to a block.
    #[inline(always)]
    pub fn fill_block_portable(&self, room: &mut Room, known: &Known, place: [i32; 2], pass: Pass) -> Vec<Sample> {
        let &Known { blocks, before, made } = known;
        let block = Rect { min: place, max: place.map(|index| index + 1) };
        let rect = blocks.rect(&block);
        self.begin(room, &rect);
        // Loops, since a closure as large as this is not compiled for the vectors of `vectors.rs`.
        let mut seen = Vec::new();
        before.visit(&self.seen_from(&rect), |sample| seen.push(sample));
        for sample in &seen {
            self.keep_out(room, sample);
            if room.is_covered() {
                return Vec::new();
            }
        }
        let near = rect.grown(self.reach);
        for sample in made.of_blocks(&block.grown(1)).filter(|sample| near.contains(sample.point)) {
            self.keep_out(room, &sample);
        }
        let rng = &mut Rng::at(blocks.rng(place).bits(), Draw::Darts, &[pass as u64]);
        self.throw(room, rng, pass, &[[0, 0]])
    }

    /// Fills a narrow torus as a whole.
    fn fill_torus(&self, job: &Job, before: &[Sample]) -> Result<Vec<Sample>> {
        self.require_rooms(self.lattice.size, 1)?;
        let [width, height] = self.lattice.size;
        let images: Vec<_> = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x * width, y * height])).collect();
        let mut room = Room::default();
        self.begin(&mut room, &self.lattice.rect());
        before.iter().for_each(|sample| self.keep_out_images(&mut room, sample, &images));
        let mut rng = Rng::at(self.seed, Draw::Darts, &[]);
        let samples = self.throw(&mut room, &mut rng, Pass::Only, &images);
        job.report(1.0)?;
        Ok(samples)
    }

    /// Refuses rooms of a size for a number of threads that are more than can be held.
    fn require_rooms(&self, size: [i32; 2], threads: usize) -> Result<()> {
        let cells: f64 =
            size.into_iter().map(|size| f64::from(CellAxis::new(size, self.lattice.radius).count())).product();
        let bytes = cells * self.classes.len() as f64 * Room::BYTES_PER_CELL;
        if bytes < FEWEST_BYTES {
            return Ok(());
        }
        memory::require(bytes * threads as f64, "radii", &format!("fill blocks of {cells:.0} cells"))
    }

    /// Begins with a rectangle and the given samples around it.
    #[inline(always)]
    fn begin(&self, room: &mut Room, rect: &Rect) {
        room.begin(rect, self.classes.len(), self.lattice.radius);
        for (class, around) in self.around.iter().enumerate() {
            around.near(rect).iter().for_each(|disk| room.keep_out(class, &Circle::of_disk(disk)));
        }
    }

    /// Puts the circles of a sample in a room.
    #[inline(always)]
    fn keep_out(&self, room: &mut Room, sample: &Sample) {
        for (class, separations) in self.separations.iter().enumerate() {
            if let Some(separation) = separations[sample.class as usize] {
                room.keep_out(class, &Circle::around(sample.point, separation.threshold));
            }
        }
    }

    /// Puts the circles of images of a sample in a room.
    #[inline(always)]
    fn keep_out_images(&self, room: &mut Room, sample: &Sample, images: &[[i32; 2]]) {
        for [x, y] in images {
            self.keep_out(room, &Sample { point: [sample.point[0] + x, sample.point[1] + y], ..*sample });
        }
    }

    /// Throws the darts of a pass, and puts the circles of the images of each new sample in the room.
    #[inline(always)]
    fn throw(&self, room: &mut Room, rng: &mut Rng, pass: Pass, images: &[[i32; 2]]) -> Vec<Sample> {
        let mut samples = Vec::new();
        room.open(if pass == Pass::Last { 0 } else { FIRST_DARTS });
        let next = |room: &mut Room, rng: &mut Rng| match pass {
            Pass::First => room.next_before_cut(rng),
            Pass::Last | Pass::Only => room.next_sample(rng),
        };
        while let Some((class, point)) = next(room, rng) {
            let sample = Sample { point, class: self.classes[class] as u32 };
            self.keep_out_images(room, &sample, images);
            samples.push(sample);
        }
        samples
    }
}

impl Layer for Group {
    type Sample = Sample;

    fn expected(&self, part: &Part) -> f64 {
        self.classes.len() as f64 * self.lattice.samples_in(&part.rect)
    }

    /// True if no part of it can be made without the rest.
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

    fn sorted(&self, part: Part, before: &[Sample]) -> Region<Sample> {
        Region::new(part, before, TILE * self.before)
    }

    fn fill(&self, job: &Job, before: &Region<Sample>, part: &Part) -> Result<Vec<Sample>> {
        let Some(blocks) = &self.blocks else {
            let samples = self.fill_torus(job, before.samples())?;
            return Ok(Region::new(Part::whole(&self.lattice), &samples, self.lattice.radius).samples_of(part));
        };
        self.require_rooms(blocks.largest(), job.context().num_threads())?;
        let window = blocks.holding(&part.rect);
        let first = first_window(blocks, &window);
        let mut made = Made::new(&self.lattice, blocks, &window, &blocks.filled(&first));
        for (pass, window, [from, to]) in [(Pass::First, first, [0.0, 0.4]), (Pass::Last, window, [0.4, 1.0])] {
            let job = job.part(from, to);
            for (share, phase) in (0..).zip(PHASES) {
                let mut places = blocks.of_phase(&window, phase);
                places.retain(|&place| made.holds(place));
                let known = Known { blocks, before, made: &made };
                let tasks = chunks_of(places.len(), BLOCKS_PER_TASK);
                let job = job.part(f64::from(share) / 4.0, f64::from(share + 1) / 4.0);
                let filled = job.map(tasks.len(), |task| {
                    let mut room = Room::default();
                    let places = places[tasks.range(task)].iter();
                    places.map(|&place| self.fill_block(&mut room, &known, place, pass)).collect::<Vec<_>>()
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
