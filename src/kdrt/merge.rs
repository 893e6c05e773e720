//! Merging (thesis §2.4.4, figure 2.14): sets that were made independently, on rectangles that do not overlap, become
//! one maximal set by the elimination and insertion of KDRT. Only the seams change.
//!
//! Of two samples in conflict where pieces meet, that of the piece of higher rank survives (see Elimination below), as
//! between the leaves of `conquer.rs`; the gaps are filled by blocks (see Insertion below), as those of a plane. Given
//! samples that must stay are a piece of the highest rank.
//!
//! # Exactness
//! Given points may be any floats of the domain; they are returned unchanged. The lattice of the domain cannot
//! represent them all: a piece near the origin may be finer. So conflicts *between given points* are decided on their
//! own coordinates, in `f64`, as the user's check does it. Conflicts *with new samples* are decided on the lattice,
//! where a given point stands for itself as the nearest lattice point, and the radius is longer by [`WIDENING`].
//!
//! Units are float spacings at the domain's largest coordinate, distances are those of the domain (on a torus wrapped
//! with its own period). The proof rests on two facts, each per axis: a given point is at most 1 from its lattice point
//! ([`Lattice::nearest`]), and the distance of two lattice points is their distance on the lattice or up to 1 more, on
//! a torus only ([`Lattice::of_any_size`]).
//!
//! * A new sample is at least r + 1.5 on the lattice from a given point's lattice point, so more than r + 1.5 - √2 > r
//!   from the given point. From other new samples it is r + 1.5 away.
//! * Every lattice point is within r + 1.5 on the lattice of a sample's lattice point; so within r + 1.5 + 2√2 of the
//!   sample. Every point of the domain is within 1 per axis of a lattice point. This adds up to r + 1.5 + 3√2, less
//!   than **r + 6 float spacings**.
//! * Two given points without conflict are more than r - 2√2 apart on the lattice, so that cells for the radius r - 3
//!   ([`NARROWING`]) hold one of them at most.
//! * A piece that covers every lattice point of its rectangle within r covers it on the lattice of the domain within
//!   r + √2, less than r + 1.5: nothing is inserted where its samples survive.

use std::ops::Range;

use crate::error::{Error, Result};
use crate::index::Binned;
use crate::job::{Context, Job, Progress, chunks_of};
use crate::kdrt::{
    blocks::{Blocks, PHASES},
    seams::Seams,
    tiling::{WINDOW_BLOCKS, cut},
};
use crate::memory;
use crate::plane::{CellAxis, CellGrid, Lattice, Quadtree, Rect};
use crate::points::{Boundary, Domain, Points};
use crate::rng::{Draw, Rng, hash};
use crate::setters::setters;

/// The excess of the radius for new samples, in float spacings.
const WIDENING: f64 = 1.5;

/// The reduction of the radius for which cells hold one sample, in float spacings.
const NARROWING: f64 = 3.0;

/// The most bytes that a sample of the result takes, three cells among them, and those of a given point.
const BYTES_PER_SAMPLE: f64 = 27.0;
const BYTES_PER_GIVEN: f64 = 27.0;

/// The share of the progress until the given points are sorted, and until their conflicts are found.
const SORT_SHARE: f64 = 0.15;
const ELIMINATE_SHARE: f64 = 0.3;

/// The options of a merge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MergeOptions {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate: that of the pieces.
    pub radius: f64,
    /// The domain that the result covers: any rectangle that contains the pieces and fixed points.
    pub domain: Domain,
    /// The same input and seed give the same samples.
    pub seed: u64,
    /// True if every piece is a conflict-free set of this radius and maximal in its rectangle, or at least farther than
    /// the radius from its edges, as [`sample`](super::sample), [`sample_window`](super::sample_window) and
    /// [`maximal::sample`](crate::maximal::sample) make them. Then only what is within two radii of an edge or a fixed
    /// point, or in no piece, is tested: the same result at a fraction of the time. Conflicts and gaps that there are
    /// elsewhere all the same stay.
    pub maximal_pieces: bool,
}

impl MergeOptions {
    /// This radius on the unit torus, with seed 0, of pieces about which nothing is known.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), seed: 0, maximal_pieces: false }
    }
}

setters!(MergeOptions { radius: f64, domain: Domain, seed: u64, maximal_pieces: bool });

/// A set of samples that was made independently, such as by [`sample`](super::sample) on a bounded domain or by
/// [`sample_window`](super::sample_window).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<'a> {
    /// Samples in `min <= x < max`, no two of them in conflict: any floats, in any number, maximal or not.
    pub samples: &'a [[f32; 2]],
    /// The lower corner of the piece's rectangle.
    pub min: [f64; 2],
    /// Its upper corner.
    pub max: [f64; 2],
}

/// The report of a merge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct MergeReport {
    /// Samples of the pieces that are in the result.
    pub kept: usize,
    /// Samples of the pieces that are not.
    pub eliminated: usize,
    /// New samples.
    pub inserted: usize,
}

/// Merges sets on rectangles that do not overlap, and points that must stay, into one maximal Poisson-disk set of the
/// domain.
///
/// The result has first all of `fixed`, then the samples of the pieces that survive, piece by piece, then new ones;
/// given points are returned bit for bit and in their order.
///
/// * Conflict-free: all distances, computed in `f64` as `sqrt(dx² + dy²)`, are at least `radius`, without tolerance. On
///   a torus they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 6 float spacings at the domain's
///   largest coordinate, whatever the pieces covered: pieces that are thinned, holes between them, and no piece at all
///   are filled.
/// * Only the seams change. A sample of a piece is removed only if it is closer than `radius` to a fixed point, or to a
///   surviving sample of another piece, or of its own across the seam of a torus. If the pieces are maximal as
///   [`sample`](super::sample) makes them, new samples lie within `radius` of a removed sample or of the boundary of a
///   piece's rectangle.
/// * Which of two pieces loses samples to the other depends on `seed` and their places in `pieces`.
/// * The same for every number of threads.
///
/// O(n) for the n samples given and made, and O(p²) at most for p pieces. A torus narrower than about 10 radii is
/// filled on one thread.
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range; for `pieces`, by index, if a rectangle is empty, leaves the
/// domain or overlaps another one, a sample lies outside its rectangle, or two samples of a piece are in conflict; for
/// `fixed`, by index, if a point lies outside the domain or two of them are in conflict, because then no set that has
/// both is conflict-free. [`Error::TooLarge`] for more than 2^32 samples or the available memory. All of them before
/// any sample is made. [`Error::Cancelled`].
///
/// ```
/// use azulejo::{Boundary, Context, Domain, kdrt};
///
/// let context = Context::new(0)?;
/// let half = |min: [f64; 2], max: [f64; 2], seed| {
///     let domain = Domain { min, max, boundary: Boundary::Bounded };
///     kdrt::sample(&context, &kdrt::Options::new(0.01).domain(domain).seed(seed), None)
/// };
/// let (left, right) = (half([0.0, 0.0], [0.5, 1.0], 1)?, half([0.5, 0.0], [1.0, 1.0], 2)?);
/// let pieces = [
///     kdrt::Piece { samples: &left.positions, min: [0.0, 0.0], max: [0.5, 1.0] },
///     kdrt::Piece { samples: &right.positions, min: [0.5, 0.0], max: [1.0, 1.0] },
/// ];
/// let options = kdrt::MergeOptions::new(0.01).seed(7);
/// let (points, report) = kdrt::merge(&context, &options, &pieces, &[[0.25, 0.75]], None)?;
/// assert_eq!(points.positions[0], [0.25, 0.75]);
/// assert_eq!(points.len(), 1 + report.kept + report.inserted);
/// # Ok::<(), azulejo::Error>(())
/// ```
pub fn merge(
    context: &Context,
    options: &MergeOptions,
    pieces: &[Piece],
    fixed: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Points<2>, MergeReport)> {
    let &MergeOptions { radius, domain, seed, maximal_pieces } = options;
    let lattice = Lattice::new(&domain, radius)?;
    check_points("fixed", "point", &domain, fixed)?;
    check_pieces(&domain, pieces)?;
    let sets: Vec<&[[f32; 2]]> = std::iter::once(fixed).chain(pieces.iter().map(|piece| piece.samples)).collect();
    let count: usize = sets.iter().map(|set| set.len()).sum();
    if count > u32::MAX as usize {
        return Err(Error::too_large("pieces", format!("{count} samples; the limit is {}", u32::MAX)));
    }
    let expected = lattice.expected_samples();
    let bytes = expected * BYTES_PER_SAMPLE + count as f64 * BYTES_PER_GIVEN;
    memory::require(bytes, "radius", &format!("about {expected:.0} samples"))?;

    let seed = hash(seed, Draw::Merge, &[]);
    context.run(progress, |job| {
        let wide = lattice.widened(WIDENING);
        let blocks = Blocks::fit(&wide).then(|| Blocks::new(&wide, seed));
        let rectangles = pieces.iter().map(|piece| [piece.min, piece.max]);
        let seams = blocks.as_ref().filter(|_| maximal_pieces);
        let seams = seams.map(|blocks| Seams::new(blocks, &wide, &domain, rectangles, fixed));
        let near = blocks.as_ref().zip(seams.as_ref());
        let near = near.map(|(blocks, seams)| seams.cells(blocks, &wide, &cell_axes(&lattice)));
        let sites = Sites::new(&job.part(0.0, SORT_SHARE), domain, &lattice, radius, &sets, near.as_deref())?;
        let survives = survivors(&job.part(SORT_SHARE, ELIMINATE_SHARE), &sites, seed)?;
        let gaps = Gaps { sites: &sites, survives: &survives, lattice: &wide, seams: seams.as_ref() };
        let inserted = gaps.insert(&job.part(ELIMINATE_SHARE, 1.0), blocks.as_ref(), seed)?;
        let mut samples = sites.in_order(&survives);
        let kept = samples.len() - fixed.len();
        let report = MergeReport { kept, eliminated: count - samples.len(), inserted: inserted.len() };
        samples.extend(inserted);
        Ok((samples.into(), report))
    })
}

fn check_pieces(domain: &Domain, pieces: &[Piece]) -> Result<()> {
    for (i, piece) in pieces.iter().enumerate() {
        let Piece { samples, min, max } = *piece;
        for axis in 0..2 {
            // Not the negation of an overlap: NaN is inside nothing.
            let inside = domain.min[axis] <= min[axis] && min[axis] < max[axis] && max[axis] <= domain.max[axis];
            if !inside {
                let (min, max, from, to) = (min[axis], max[axis], domain.min[axis], domain.max[axis]);
                let reason =
                    format!("[{i}] reaches on axis {axis} from {min} to {max}, which is no part of {from} to {to}");
                return Err(Error::invalid("pieces", reason));
            }
        }
        let rectangle = Domain { min, max, boundary: Boundary::Bounded };
        check_points("pieces", &format!("[{i}]: sample"), &rectangle, samples)?;
    }
    match first_overlap(pieces) {
        Some([i, j]) => Err(Error::invalid("pieces", format!("the rectangles of [{i}] and [{j}] overlap"))),
        None => Ok(()),
    }
}

/// Refuses a point that does not lie in the rectangle.
fn check_points(argument: &'static str, what: &str, rectangle: &Domain, points: &[[f32; 2]]) -> Result<()> {
    let Some(index) = points.iter().position(|&point| !rectangle.contains(point)) else { return Ok(()) };
    let ([x, y], Domain { min, max, .. }) = (points[index], rectangle);
    Err(Error::invalid(argument, format!("{what} {index} is ({x}, {y}), outside the rectangle {min:?} to {max:?}")))
}

/// Two pieces whose rectangles overlap, from left to right.
fn first_overlap(pieces: &[Piece]) -> Option<[usize; 2]> {
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&i, &j| pieces[i].min[0].total_cmp(&pieces[j].min[0]));
    order.iter().enumerate().find_map(|(place, &i)| {
        let beside = order[place + 1..].iter().take_while(|&&j| pieces[j].min[0] < pieces[i].max[0]);
        let overlaps = |j: usize| pieces[i].min[1] < pieces[j].max[1] && pieces[j].min[1] < pieces[i].max[1];
        beside.copied().find(|&j| overlaps(j)).map(|j| [i.min(j), i.max(j)])
    })
}

// # The points that are merged
//
// The points that are given, sorted by cells that hold at most one survivor, with the exact test of their conflicts.

/// Points per task.
const POINTS: usize = 1 << 14;

/// Stands for the cell of a point that does not matter.
const LEFT_OUT: usize = usize::MAX;

/// The set of the points that must stay.
pub const FIXED: u32 = 0;

/// A point of a set, and its index.
#[derive(Clone, Copy, Default)]
pub struct Site {
    pub position: [f32; 2],
    /// [`FIXED`], or `i + 1` for piece `i`.
    pub set: u32,
    pub index: u32,
}

/// All points of all sets that matter, sorted by cell and in it by set.
pub struct Sites<'a> {
    domain: Domain,
    radius: f64,
    lattice: Lattice,
    /// The cells of the domain's lattice points ([`cell_axes`]): so small that two points in one cell conflict.
    pub axes: [CellAxis; 2],
    /// For each column and row, the columns and rows that can hold a conflict with it, each once.
    near: [Vec<[Range<usize>; 2]>; 2],
    /// The sites of each cell.
    by_cell: Binned<Site>,
    sets: &'a [&'a [[f32; 2]]],
}

impl<'a> Sites<'a> {
    /// Sorts the sets, whose points lie in the domain: all, or those in the cells that are marked.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for two points of a set in the same cell, except across the seam of a torus: they
    /// conflict. (Later steps would find them too, but very many could make these slow.)
    pub fn new(
        job: &Job,
        domain: Domain,
        lattice: &Lattice,
        radius: f64,
        sets: &'a [&'a [[f32; 2]]],
        marked: Option<&[bool]>,
    ) -> Result<Self> {
        let axes = cell_axes(lattice);
        // Distances of given points are at most two units shorter per axis than those of their lattice points.
        let near = axes.each_ref().map(|axis| near_on_axis(axis, lattice.separation.reach + 3, domain.boundary));
        let lattice = lattice.clone();
        let mut sorted = Self { domain, radius, lattice, axes, near, by_cell: Binned::default(), sets };
        sorted.sort(job, marked)?;
        sorted.check_cells()?;
        Ok(sorted)
    }

    /// Sorts the points. Finding their cells is most of the work, and is shared by the threads.
    fn sort(&mut self, job: &Job, marked: Option<&[bool]>) -> Result<()> {
        let chunks: Vec<&[[f32; 2]]> = self.sets.iter().flat_map(|set| set.chunks(POINTS)).collect();
        let finders = self.axes.each_ref().map(|axis| axis.finder(0));
        let cell = |&point: &[f32; 2]| {
            let point = self.lattice_point(point);
            let [column, row] = [0, 1].map(|axis: usize| finders[axis].cell(point[axis]) as usize);
            let cell = row * self.columns() + column;
            if marked.is_none_or(|marked| marked[cell]) { cell } else { LEFT_OUT }
        };
        let cells = job.map(chunks.len(), |i| chunks[i].iter().map(cell).collect::<Vec<_>>())?;
        let sites = (0..)
            .zip(self.sets)
            .flat_map(|(set, points)| (0..).zip(*points).map(move |(index, &position)| Site { position, set, index }));
        let count = self.axes.iter().map(|axis| axis.count() as usize).product();
        let sorted = cells.iter().flatten().copied().zip(sites).filter(|(cell, _)| *cell != LEFT_OUT);
        self.by_cell = Binned::new(count, sorted);
        Ok(())
    }

    fn check_cells(&self) -> Result<()> {
        let crowded = |pair: &&[Site]| self.conflict(&pair[0], &pair[1]) && self.is_fault(&pair[0], &pair[1]);
        match self.all().windows(2).find(crowded) {
            Some(pair) => Err(self.refusal(&pair[0], &pair[1])),
            None => Ok(()),
        }
    }

    fn columns(&self) -> usize {
        self.axes[0].count() as usize
    }

    /// The number of sets, empty ones too.
    pub fn set_count(&self) -> usize {
        self.sets.len()
    }

    /// All points, by cells and in each by sets.
    pub fn all(&self) -> &[Site] {
        self.by_cell.items()
    }

    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.by_cell.len()
    }

    /// The lattice point that stands for a given one.
    pub fn lattice_point(&self, point: [f32; 2]) -> [i32; 2] {
        self.lattice.nearest(&self.domain, point)
    }

    /// True if two points are closer than the radius, by the user's own check in `f64`, with the root or without. (The
    /// root of a rounded square is the number itself, and rounding is monotone.)
    fn conflict(&self, a: &Site, b: &Site) -> bool {
        self.squared_distance(a, b) < self.radius * self.radius
    }

    fn squared_distance(&self, a: &Site, b: &Site) -> f64 {
        let extent = self.domain.extent();
        let [dx, dy] = offset(a, b).map(f64::abs);
        let [dx, dy] = match self.domain.boundary {
            Boundary::Periodic => [dx.min(extent[0] - dx), dy.min(extent[1] - dy)],
            Boundary::Bounded => [dx, dy],
        };
        dx * dx + dy * dy
    }

    /// True if a conflict is an error: neither of two fixed points can be removed, and a piece may conflict with itself
    /// across the seam of a torus only.
    fn is_fault(&self, a: &Site, b: &Site) -> bool {
        let [dx, dy] = offset(a, b);
        a.set == b.set && (a.set == FIXED || dx * dx + dy * dy < self.radius * self.radius)
    }

    /// Visits all conflicts of the sites of a cell, by their places in `sites`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a conflict in one set, unless it can be resolved.
    pub fn conflicts(&self, cell: usize, mut visit: impl FnMut(usize, usize)) -> Result<()> {
        let sites = self.by_cell.range(cell..cell + 1);
        if sites.is_empty() {
            return Ok(());
        }
        let (row, column) = (cell / self.columns(), cell % self.columns());
        let rows = self.near[1][row].iter().cloned().flatten();
        let runs = rows.flat_map(|row| self.near[0][column].iter().map(move |columns| self.places(row, columns)));
        for other in runs.flatten() {
            for site in sites.clone().filter(|&site| site != other) {
                let (a, b) = (&self.all()[site], &self.all()[other]);
                if !self.conflict(a, b) {
                    continue;
                }
                if self.is_fault(a, b) {
                    return Err(self.refusal(a, b));
                }
                visit(site, other);
            }
        }
        Ok(())
    }

    /// The places in `sites` of the points in a run of cells of one row.
    fn places(&self, row: usize, columns: &Range<usize>) -> Range<usize> {
        let first = row * self.columns();
        self.by_cell.range(first + columns.start..first + columns.end)
    }

    /// The places in `sites` of all points in the cells that hold the lattice points of `rect`, a part of the domain.
    pub fn places_in(&self, rect: &Rect) -> impl Iterator<Item = usize> {
        let [columns, rows] = [0, 1].map(|axis: usize| {
            let [first, last] = [rect.min[axis], rect.max[axis] - 1].map(|x| self.axes[axis].cell(x) as usize);
            if rect.is_empty() { 0..0 } else { first..last + 1 }
        });
        rows.flat_map(move |row| self.places(row, &columns))
    }

    /// The surviving points in the order in which they were given.
    pub fn in_order(&self, survives: &[bool]) -> Vec<[f32; 2]> {
        let mut stays: Vec<Vec<bool>> = self.sets.iter().map(|set| vec![true; set.len()]).collect();
        for (site, _) in self.all().iter().zip(survives).filter(|(_, survives)| !**survives) {
            stays[site.set as usize][site.index as usize] = false;
        }
        let points = self.sets.iter().copied().flatten().zip(stays.iter().flatten());
        points.filter(|(_, stays)| **stays).map(|(point, _)| *point).collect()
    }

    fn refusal(&self, a: &Site, b: &Site) -> Error {
        let [i, j] = [a.index.min(b.index), a.index.max(b.index)];
        let (distance, radius) = (self.squared_distance(a, b).sqrt(), self.radius);
        let apart = format!("{i} and {j} are {distance:?} apart, closer than the radius {radius:?}");
        match a.set {
            FIXED => Error::invalid("fixed", format!("points {apart}")),
            set => Error::invalid("pieces", format!("[{}]: samples {apart}", set - 1)),
        }
    }
}

/// The columns and rows of cells that hold one survivor at most.
fn cell_axes(lattice: &Lattice) -> [CellAxis; 2] {
    lattice.size.map(|size| CellAxis::new(size, lattice.radius - NARROWING))
}

fn offset(a: &Site, b: &Site) -> [f64; 2] {
    std::array::from_fn(|axis| f64::from(a.position[axis]) - f64::from(b.position[axis]))
}

/// For each cell of an axis the cells that hold points within `reach` of its own, as two runs that may be empty.
fn near_on_axis(axis: &CellAxis, reach: i32, boundary: Boundary) -> Vec<[Range<usize>; 2]> {
    let count = axis.count();
    let run = |first: i32, end: i32| first as usize..end as usize;
    let near = |cell: i32| {
        let (first, end) = (axis.cell(axis.edge(cell) - reach), axis.cell(axis.edge(cell + 1) - 1 + reach) + 1);
        match boundary {
            Boundary::Bounded => [run(first.max(0), end.min(count)), 0..0],
            Boundary::Periodic if end - first >= count => [run(0, count), 0..0],
            Boundary::Periodic if first < 0 => [run(0, end), run(first + count, count)],
            Boundary::Periodic => [run(first, end.min(count)), run(0, (end - count).max(0))],
        }
    };
    (0..count).map(near).collect()
}

// # Elimination
//
// Elimination: of two given points in conflict one is removed.
//
// The sets are ranked by hash, the fixed points before all; in a set, which can meet itself across the seam of a torus,
// points are ranked in their given order. A point survives if and only if no *surviving* point of higher rank conflicts
// with it, as in `conquer.rs`. Rectangles may be thin, so chains of such decisions have no bound; they are followed
// through all of the domain, but they have links only where sets meet.

/// Cells per task.
const CELLS: usize = 1 << 14;

/// The survival of each of the given points, in the order of its sites.
pub fn survivors(job: &Job, sites: &Sites, seed: u64) -> Result<Vec<bool>> {
    let ranks = ranks(sites.set_count(), seed);
    let rank = |site: usize| (ranks[sites.all()[site].set as usize], sites.all()[site].index);
    let chunks = chunks_of(sites.cells(), CELLS);
    let links = job.map(chunks.len(), |i| {
        let mut links = Vec::new();
        let mut visit = |site, other| {
            if rank(other) < rank(site) {
                links.push((site, other));
            }
        };
        chunks.range(i).try_for_each(|cell| sites.conflicts(cell, &mut visit)).map(|()| links)
    })?;
    let mut links = links.into_iter().collect::<Result<Vec<_>>>()?.concat();

    // When a point is reached, all that could eliminate it are decided.
    links.sort_unstable_by_key(|&(site, _)| rank(site));
    let mut survives = vec![true; sites.all().len()];
    for (site, other) in links {
        survives[site] &= !survives[other];
    }
    Ok(survives)
}

/// The position of each set in the order of falling rank.
fn ranks(sets: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<usize> = (1..sets).collect();
    order.sort_by_key(|&set| hash(seed, Draw::Priority, &[set as u64]));
    let mut ranks = vec![0; sets];
    for (rank, set) in (1..).zip(order) {
        ranks[set] = rank;
    }
    ranks
}

// # Insertion
//
// Insertion: the part that the survivors leave uncovered is filled, by the blocks and phases of KDRT (`blocks.rs`).
//
// As a plane, a domain is filled by windows of blocks that share nothing: each makes the surroundings that it depends
// on itself. Where pieces guarantee nothing but freedom from conflict, the cells with gaps are not known beforehand: all
// are tested. Those of maximal pieces are at the seams (`seams.rs`).

struct Gaps<'a> {
    sites: &'a Sites<'a>,
    survives: &'a [bool],
    /// The lattice with the radius that new samples keep.
    lattice: &'a Lattice,
    /// The places of possible gaps; everywhere if none.
    seams: Option<&'a Seams>,
}

impl Gaps<'_> {
    /// Returns the samples that make the survivors maximal. A torus without blocks is filled as a whole.
    fn insert(&self, job: &Job, blocks: Option<&Blocks>, seed: u64) -> Result<Vec<[f32; 2]>> {
        let Some(blocks) = blocks else { return self.fill_torus(job, Rng::at(seed, Draw::Darts, &[])) };
        let windows = cut(&Rect { min: [0; 2], max: blocks.counts() }, WINDOW_BLOCKS);
        job.flat_map(windows.len(), |i| self.fill_window(blocks, &windows[i]))
    }

    /// Fills a rectangle of blocks, and as much around it as is necessary to agree with all other windows.
    fn fill_window(&self, blocks: &Blocks, window: &Rect) -> Vec<[f32; 2]> {
        let separation = self.lattice.separation;
        let known = blocks.rect(&blocks.grown(window, PHASES[0].1)).grown(separation.reach);
        let known = match self.lattice.boundary {
            Boundary::Periodic => known,
            Boundary::Bounded => known.intersection(&self.lattice.rect()),
        };
        let mut grid = CellGrid::new(&self.sites.axes, &known, separation);
        self.survivors_in(&known, |point| grid.insert(grid.cell(point), point));

        let (inside, mut samples) = (blocks.rect(window), Vec::new());
        for (parity, margin) in PHASES {
            let phase = blocks.grown(window, margin);
            let columns: Vec<_> = blocks.of_parity(&phase, 0, parity[0]).collect();
            let rows = blocks.of_parity(&phase, 1, parity[1]);
            for ((row, y), &(column, x)) in rows.flat_map(|row| columns.iter().map(move |column| (row, column))) {
                if self.seams.is_some_and(|seams| !seams.may_have_gaps([column, row])) {
                    continue;
                }
                let rect = Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
                let (mut quadtree, mut rng) = (Quadtree::of_empty_cells(&grid, rect), blocks.rng([column, row]));
                quadtree.fill(&mut grid, &mut rng, |_, sample| {
                    if inside.contains(sample) {
                        samples.push(self.lattice.position(sample));
                    }
                });
            }
        }
        samples
    }

    /// Fills a torus that is too narrow for blocks, as a whole.
    fn fill_torus(&self, job: &Job, mut rng: Rng) -> Result<Vec<[f32; 2]>> {
        let all = self.lattice.rect();
        let mut grid = CellGrid::torus(&self.sites.axes, self.lattice.separation);
        self.survivors_in(&all, |point| grid.insert(grid.cell(point), point));
        let mut samples = Vec::new();
        let accepted = |sample| samples.push(self.lattice.position(sample));
        let expected = self.lattice.expected_samples();
        Quadtree::of_empty_cells(&grid, all).fill_domain(job, &mut grid, &mut rng, expected, accepted)?;
        Ok(samples)
    }

    /// Visits the lattice points of the survivors in `rect`; on a torus all their images there.
    fn survivors_in(&self, rect: &Rect, mut visit: impl FnMut([i32; 2])) {
        for (turn, part) in self.lattice.parts(rect) {
            for place in self.sites.places_in(&part).filter(|&place| self.survives[place]) {
                let point = self.sites.lattice_point(self.sites.all()[place].position);
                if part.contains(point) {
                    visit([point[0] + turn[0], point[1] + turn[1]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gaps of all sizes: the survivors are thinned more and more from left to right.
    #[test]
    fn every_partition_into_windows_inserts_the_same_samples() {
        for (seed, boundary) in [Boundary::Periodic, Boundary::Bounded, Boundary::Periodic].into_iter().enumerate() {
            let domain = Domain { min: [0.3, -0.4], max: [1.3, 0.8], boundary };
            let lattice = Lattice::new(&domain, 0.0137).unwrap();
            let context = crate::job::Context::new(1).unwrap();
            let mut samples = context.run(None, |job| crate::maximal::sample_lattice(job, &lattice, 1)).unwrap();
            let mut rng = Rng::at(seed as u64, Draw::Probe, &[]);
            samples.retain(|sample| rng.unit() > 1.1 * (f64::from(sample[0]) - 0.3));
            let sets = [&samples[..]];
            let sites = context.run(None, |job| Sites::new(job, domain, &lattice, 0.0137, &sets, None)).unwrap();

            let lattice = lattice.widened(WIDENING);
            let gaps = Gaps { sites: &sites, survives: &vec![true; samples.len()], lattice: &lattice, seams: None };
            let blocks = Blocks::new(&lattice, seed as u64);
            let inserted = |side| {
                let windows = cut(&Rect { min: [0; 2], max: blocks.counts() }, side);
                let mut inserted: Vec<_> =
                    windows.iter().flat_map(|window| gaps.fill_window(&blocks, window)).collect();
                inserted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
                inserted
            };
            let whole = inserted(WINDOW_BLOCKS);
            assert!(whole.len() > 1000);
            for side in [1, 2, 5] {
                assert!(inserted(side) == whole, "{side} blocks, seed {seed}");
            }
        }
    }
}
