//! Filling a surface until the set of samples on it is maximal (departs from the thesis, which has no such step).
//!
//! On an empty surface first darts are thrown, about six for each sample that will lie there. Then one pass over the
//! triangles drops those that a single sample covers, which are nearly all of them, and rounds of darts close the open
//! parts. A mesh thus costs two short passes, and the rest is proportional to the samples.
//!
//! If many samples are expected, each cube of space is filled by itself, in the colours of `psp/set/cubes.rs`: its samples
//! then stay in the cache, and threads share the cubes. Few samples are made in one piece, since sorting the triangles
//! costs more.
//!
//! A [`Zone`] is filled by [`fill_zone`]: a whole surface or one cube of it. Surfaces whose radii are constant are
//! [`Site`]s, filled in either way by [`fill`]: one radius (`uniform.rs`) or several classes (`psp/classes/`). Where
//! the radius varies the zones are the cubes of octaves (`psp/adaptive/`).

pub mod blocks;
pub mod cells;
pub mod darts;
pub mod estimate;
pub mod extent;
pub mod grid;
pub mod measures;
pub mod page;
pub mod pages;
pub mod rounds;
pub mod space;
pub mod table;
pub mod uniform;

pub use blocks::{Block, Blocks};
pub use cells::Cells;
pub use darts::random_point;
pub use estimate::{BYTES_PER_SAMPLE, DENSITY, check_radius_on, expected_samples_of, require_samples};
pub use extent::Extent;
pub use measures::{Measures, longest_edge};
pub use page::{BATCH, BEYOND, Batch, LANES};
pub use pages::Pages;
pub use rounds::{Ground, Layer, Open, PATCH, Patch, Point, TOLERANCE, WHOLE, WholeTriangle, throw};
pub use space::{Place, Space};
pub use uniform::{Surface, Uniform, UniformGround};

use std::ops::AddAssign;

use crate::error::Result;
use crate::index::Weights;
use crate::job::{Chunks, Job, chunks_of};
use crate::math::power;
use crate::mesh::Mesh;
use crate::psp::fill::blocks::ItemRow;
use crate::psp::fill::darts::PoissonProcess;
use crate::psp::fill::darts::shuffle;
use crate::psp::fill::measures::Triangles;
use crate::psp::fill::rounds::rounds;
use crate::psp::fragment::Fragment;
use crate::psp::set::{Cube, Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// The number of expected samples up to which a surface is filled in one piece.
pub const ONE_PIECE: f64 = 25_000.0;

/// The number of random points that estimate the open share of a surface; more are used where more is open.
const PROBES: usize = 1 << 10;
/// The number of random points that estimate the open share of a cube.
pub const PROBES_IN_CUBE: usize = 1 << 6;

/// The least open share of a zone for which first darts are thrown if samples are given. If less is open, most of them
/// would be wasted, and rounds on the open parts are faster.
const FIRST_DARTS_FROM: f64 = 0.15;

/// The first darts on an empty surface, per squared radius: about six for each sample that will lie there. They are
/// cheap, since only the triangle that they fall on is determined, and leave little of the surface open.
pub const FIRST_DARTS: f64 = 4.2;

/// Clusters of triangles per task.
const CHUNK: usize = 1 << 10;

/// Counts of a fill, or of a part of it.
#[derive(Default)]
pub struct Filled {
    pub darts: u64,
    /// The area that was open at first.
    pub open_area: f64,
}

impl AddAssign for Filled {
    fn add_assign(&mut self, part: Self) {
        self.darts += part.darts;
        self.open_area += part.open_area;
    }
}

/// Options of a fill.
#[derive(Clone, Copy)]
pub struct FillOptions {
    pub seed: u64,
    /// True if first darts are thrown before the open parts are searched: where samples cover little of the surface.
    pub throws_first: bool,
    /// True if the area that is open at first is measured.
    pub measures: bool,
    /// The longest patches that darts are thrown on, in radii: at most [`PATCH`].
    pub patch: f32,
    /// The largest rank of the samples that are added, if they get ranks (`psp/levels.rs`).
    pub largest_rank: Option<f64>,
}

impl FillOptions {
    /// The options for an empty surface.
    pub fn from_nothing(seed: u64) -> Self {
        Self { seed, throws_first: true, measures: true, patch: PATCH as f32, largest_rank: None }
    }

    /// The options for a set that already has samples.
    pub fn around(samples: &SampleSet, seed: u64) -> Self {
        Self { throws_first: samples.len() == 0, ..Self::from_nothing(seed) }
    }
}

/// The bounds of the radius in a part of a zone, or the class of a dart.
type Local<Z> = <<Z as Zone>::Ground as Ground>::Local;

/// A part of a surface that is filled by itself: a cube, or the whole surface.
pub trait Zone {
    type Ground: Ground;

    /// True if all of it is known to be open, without a test of any point.
    fn is_bare(&self) -> bool;

    /// The number of random points that measure its open share.
    fn probes(&self) -> usize;

    /// Its area, in a unit of its own.
    fn area(&self) -> f64;

    /// A random point.
    fn point(&mut self, rng: &mut Rng) -> Point<Local<Self>>;

    /// Throws the first darts.
    fn throw_first(&mut self, ground: &mut Self::Ground, rng: &mut Rng) -> Result<()>;

    /// The parts that no single sample covers.
    fn open(&self, ground: &Self::Ground) -> Result<Open<Local<Self>>>;

    /// The open area, given the parts that may be open: by random points on them. 0 if it is never needed.
    fn open_area(&self, _ground: &Self::Ground, _open: &Open<Local<Self>>, _rng: &mut Rng) -> f64 {
        0.0
    }

    /// Reports the number of rounds so far.
    fn report(&self, _round: i32) -> Result<()> {
        Ok(())
    }
}

/// The approximate share of a zone that is open before the fill: that of random points. 0 if no first darts are
/// requested.
pub fn open_share<Z: Zone>(zone: &mut Z, ground: &Z::Ground, options: FillOptions, rng: &mut Rng) -> f64 {
    if !options.throws_first {
        return 0.0;
    }
    if zone.is_bare() {
        return 1.0;
    }
    if zone.area() == 0.0 {
        return 0.0;
    }
    share_of(zone.probes(), || ground.is_open(zone.point(rng)))
}

/// The share of this many trials that succeed.
fn share_of(trials: usize, mut succeeds: impl FnMut() -> bool) -> f64 {
    (0..trials).filter(|_| succeeds()).count() as f64 / trials as f64
}

/// Fills a zone of which this share is open: by first darts, if that is much, and by rounds on the parts that are open
/// then. Returns the area that was open before, in the zone's unit, if it is measured.
pub fn fill_zone<Z: Zone>(
    zone: &mut Z,
    ground: &mut Z::Ground,
    share: f64,
    options: FillOptions,
    rng: &mut Rng,
) -> Result<f64> {
    let throws_first = share >= FIRST_DARTS_FROM;
    if throws_first {
        zone.throw_first(ground, rng)?;
    }
    let open = zone.open(ground)?;
    let open_area = match (throws_first, options.measures) {
        (true, _) => share * zone.area(),
        (false, true) => zone.open_area(ground, &open, rng),
        (false, false) => 0.0,
    };
    rounds(ground, open, options.patch, rng, |round| zone.report(round))?;
    Ok(open_area)
}

/// The kinds of samples that grow together on a surface: one, or the classes of a group.
pub trait Kinds: Sync {
    /// A class, or nothing where all samples are alike.
    type Kind: Copy + Send + Sync;

    fn kinds(&self) -> &[Self::Kind];

    fn random_kind(&self, rng: &mut Rng) -> Self::Kind;

    /// True if samples of a kind may stand on a triangle.
    fn allows(&self, kind: Self::Kind, triangle: u32) -> bool;
}

/// A site whose samples are all alike.
pub trait Alike: Sync {}

impl<T: Alike> Kinds for T {
    type Kind = ();

    fn kinds(&self) -> &[()] {
        &[()]
    }

    fn random_kind(&self, _: &mut Rng) {}

    fn allows(&self, (): (), _: u32) -> bool {
        true
    }
}

/// A surface to be filled with samples of constant radii, the same for all kinds.
pub trait Site: Kinds {
    type Ground<'a>: Ground<Local = Self::Kind, Sample = Sample> + Sync
    where
        Self: 'a;
    /// True if samples of other cubes count when the open share of a cube is measured.
    const NEIGHBOURS_COUNT: bool;

    fn mesh(&self) -> &Mesh;

    fn measures(&self) -> &Measures;

    /// True if all of it is certainly open.
    fn is_bare(&self) -> bool;

    /// Random numbers for the first darts of a kind on a chunk of the triangles.
    fn chunk_rng(&self, seed: u64, chunk: usize, kind: Self::Kind) -> Rng;

    /// The largest distance at which a sample matters to another one.
    fn reach(&self) -> f64;

    /// The surface, or the part of it in a block, with the samples that are given.
    fn ground(&self, block: Option<&Block>) -> Self::Ground<'_>;

    /// Adds a sample that is there already.
    fn add(ground: &mut Self::Ground<'_>, sample: &Sample);

    /// The ground for the samples of one kind, with their radius.
    fn layer<'g>(ground: &'g Self::Ground<'_>, kind: Self::Kind) -> &'g UniformGround<'g>;

    /// The open parts of a kind's layer that are open to the kind on the whole ground.
    fn narrowed(ground: &Self::Ground<'_>, kind: Self::Kind, open: Open) -> Open<Self::Kind>;
}

/// Adds samples until the set is maximal, cube by cube or in one piece.
pub fn fill<S: Site>(
    job: &Job,
    site: &S,
    samples: &mut SampleSet,
    in_blocks: bool,
    options: FillOptions,
) -> Result<Filled> {
    if in_blocks {
        let blocks = Blocks::new(&job.part(0.0, 0.1), site.mesh(), site.measures(), samples, None)?;
        let block = |number| blocks.block(site.measures(), number);
        return fill_parts(&job.part(0.1, 1.0), site, samples, &blocks.cubes, block, options);
    }
    let mut ground = site.ground(None);
    samples.all().iter().for_each(|sample| S::add(&mut ground, sample));
    let chunks = chunks_of(site.measures().triangles().clusters(), CHUNK);
    let (mut zone, mut rng) = (
        WholeSurface { site, job: *job, seed: options.seed, chunks, areas: None },
        Rng::at(options.seed, Draw::Fill, &[]),
    );
    let share = open_share(&mut zone, &ground, options, &mut rng);
    let open_area = fill_zone(&mut zone, &mut ground, share, options, &mut rng);
    // Accepted samples are kept, even if the job is cancelled.
    let (mut accepted, darts) = ground.into_accepted();
    samples.append(&mut accepted);
    Ok(Filled { darts, open_area: open_area? })
}

/// Adds samples until the surface in some cubes is covered, or the part of it that is given for each.
pub fn fill_parts<S: Site>(
    job: &Job,
    site: &S,
    samples: &mut SampleSet,
    cubes: &[Cube],
    block: impl Fn(usize) -> Block + Sync,
    options: FillOptions,
) -> Result<Filled> {
    samples.grow(job, cubes, |number, samples| fill_block(site, &block(number), samples, options))
}

/// The samples that cover the open parts of a cube, and the counts of its fill.
fn fill_block<S: Site>(
    site: &S,
    block: &Block,
    samples: &SampleSet,
    options: FillOptions,
) -> Result<(Vec<Sample>, Filled)> {
    if block.items.is_empty() {
        return Ok((Vec::new(), Filled::default()));
    }
    let (mut ground, mut rng) = (site.ground(Some(block)), Rng::at(options.seed, Draw::Fill, &block.cube.key()));
    let add_neighbours = |ground: &mut S::Ground<'_>| {
        let is_near = |sample: &&Sample| block.extent.is_in_reach(sample.position, site.reach());
        samples.around(block.cube).filter(is_near).for_each(|sample| S::add(ground, sample));
    };
    let mut zone = BlockZone { site, block, row: options.throws_first.then(|| block.items.row(site.mesh())) };
    if S::NEIGHBOURS_COUNT {
        add_neighbours(&mut ground);
    }
    let share = open_share(&mut zone, &ground, options, &mut rng);
    if !S::NEIGHBOURS_COUNT {
        add_neighbours(&mut ground);
    }
    let open_area = fill_zone(&mut zone, &mut ground, share, options, &mut rng)?;
    let (accepted, darts) = ground.into_accepted();
    Ok((accepted, Filled { darts, open_area }))
}

/// The radius of a site, as its ground uses it.
fn radius<S: Site>(site: &S, ground: &S::Ground<'_>) -> f64 {
    S::layer(ground, site.kinds()[0]).radius()
}

/// The open parts of some triangles, by their indices, and of fragments of others, for samples of a kind.
fn open_to<S: Site>(
    site: &S,
    ground: &S::Ground<'_>,
    kind: S::Kind,
    (triangles, indices): (Triangles, impl Iterator<Item = usize>),
    pieces: &[Fragment],
) -> Open<S::Kind> {
    let layer = S::layer(ground, kind);
    let mut open = layer.open_triangles(triangles, indices.filter(|&index| site.allows(kind, triangles.at(index))));
    let pieces = pieces.iter().filter(|piece| site.allows(kind, piece.triangle));
    pieces.for_each(|piece| layer.open_parts(piece, &mut open));
    S::narrowed(ground, kind, open)
}

/// The area of parts that are open, estimated with this many random points and more if there are many parts.
fn open_area<S: Site>(site: &S, ground: &S::Ground<'_>, open: &Open<S::Kind>, probes: usize, rng: &mut Rng) -> f64 {
    let row = Weights::new(open.areas().collect());
    if row.total() == 0.0 {
        return 0.0;
    }
    let share = share_of(probes + row.len() / 8, || ground.is_open(open.point(row.pick(rng), rng)));
    row.total() * radius(site, ground) * radius(site, ground) * share
}

/// A whole surface.
struct WholeSurface<'a, S> {
    site: &'a S,
    job: Job<'a>,
    seed: u64,
    chunks: Chunks,
    /// The areas of the clusters, once points have been requested.
    areas: Option<Weights>,
}

impl<'a, S: Site> Zone for WholeSurface<'a, S> {
    type Ground = S::Ground<'a>;

    fn is_bare(&self) -> bool {
        self.site.is_bare()
    }

    fn probes(&self) -> usize {
        PROBES
    }

    fn area(&self) -> f64 {
        self.site.mesh().area()
    }

    fn point(&mut self, rng: &mut Rng) -> Point<S::Kind> {
        let (site, measures) = (self.site, self.site.measures());
        let (areas, triangles) =
            (self.areas.get_or_insert_with(|| Weights::new(measures.areas.clone())), measures.triangles());
        let cluster = areas.pick(rng) as usize;
        let of_cluster = Weights::new(triangles.measure(site.mesh(), cluster).0.to_vec());
        let triangle = triangles.at(triangles.cluster(cluster).start + of_cluster.pick(rng) as usize);
        Point { triangle, barycentrics: random_point(rng), local: site.random_kind(rng) }
    }

    fn throw_first(&mut self, ground: &mut S::Ground<'a>, rng: &mut Rng) -> Result<()> {
        let (site, mut darts) = (self.site, Vec::new());
        let (mesh, triangles, areas) = (site.mesh(), site.measures().triangles(), &site.measures().areas);
        let per_area = FIRST_DARTS / (radius(site, ground) * radius(site, ground));
        let in_chunk = |chunk: usize| {
            let mut darts = Vec::new();
            for &kind in site.kinds() {
                let rng = &mut site.chunk_rng(self.seed, chunk, kind);
                let mut process = PoissonProcess::new(rng, per_area);
                for cluster in self.chunks.range(chunk) {
                    // For clusters without a dart only the area is needed.
                    if process.passes(areas[cluster]) {
                        continue;
                    }
                    for (index, area) in triangles.cluster(cluster).zip(triangles.measure(mesh, cluster).0) {
                        let (count, triangle) = (process.darts_on(area), triangles.at(index));
                        if count > 0 && site.allows(kind, triangle) {
                            darts.extend(std::iter::repeat_n((triangle, kind), count));
                        }
                    }
                }
            }
            darts
        };
        self.job.part(0.0, 0.2).stream(self.chunks.len(), in_chunk, |mut part| {
            darts.append(&mut part);
            Ok(())
        })?;
        shuffle(rng, &mut darts);
        throw(
            ground,
            darts.iter().map(|&(triangle, local)| Point { triangle, barycentrics: random_point(rng), local }),
        );
        Ok(())
    }

    fn open(&self, ground: &S::Ground<'a>) -> Result<Open<S::Kind>> {
        let (site, measures) = (self.site, self.site.measures());
        let (triangles, chunks) = (measures.triangles(), self.chunks);
        let balls = measures.balls(&self.job.part(0.2, 0.25), site.mesh(), radius(site, ground))?;
        // Kind by kind: most triangles that are tested together are then of one kind.
        let mut open: Vec<Open<S::Kind>> = site.kinds().iter().map(|_| Open::default()).collect();
        let in_chunk = |chunk: usize| -> Vec<Open<S::Kind>> {
            let open_to_kind = |&kind: &S::Kind| {
                let layer = S::layer(ground, kind);
                let is_left = |&cluster: &usize| balls.is_none_or(|balls| !layer.covers(&balls[cluster]));
                let left = chunks.range(chunk).filter(is_left).flat_map(|cluster| triangles.cluster(cluster));
                open_to(site, ground, kind, (triangles, left), &[])
            };
            site.kinds().iter().map(open_to_kind).collect()
        };
        self.job.part(0.25, 0.5).stream(chunks.len(), in_chunk, |mut part| {
            open.iter_mut().zip(&mut part).for_each(|(open, part)| open.append(part));
            Ok(())
        })?;
        Ok(joined(open))
    }

    fn open_area(&self, ground: &S::Ground<'a>, open: &Open<S::Kind>, rng: &mut Rng) -> f64 {
        open_area(self.site, ground, open, PROBES, rng)
    }

    fn report(&self, round: i32) -> Result<()> {
        self.job.part(0.5, 1.0).report(1.0 - power(0.8, round as u32))
    }
}

/// A cube of a surface.
struct BlockZone<'a, S> {
    site: &'a S,
    block: &'a Block,
    /// The areas, where first darts may be thrown.
    row: Option<ItemRow<'a>>,
}

impl<'a, S: Site> Zone for BlockZone<'a, S> {
    type Ground = S::Ground<'a>;

    fn is_bare(&self) -> bool {
        self.site.is_bare()
    }

    fn probes(&self) -> usize {
        PROBES_IN_CUBE
    }

    fn area(&self) -> f64 {
        self.row.as_ref().map_or(0.0, ItemRow::total)
    }

    fn point(&mut self, rng: &mut Rng) -> Point<S::Kind> {
        let Point { triangle, barycentrics, .. } = self.row.as_mut().expect("asked for").point(rng);
        Point { triangle, barycentrics, local: self.site.random_kind(rng) }
    }

    fn throw_first(&mut self, ground: &mut S::Ground<'a>, rng: &mut Rng) -> Result<()> {
        let (site, radius) = (self.site, radius(self.site, ground));
        let expected = site.kinds().len() as f64 * FIRST_DARTS * self.area() / (radius * radius);
        let darts = (0..(expected + rng.unit()) as usize).map(|_| self.point(rng));
        throw(ground, darts.filter(|point| site.allows(point.local, point.triangle)));
        Ok(())
    }

    fn open(&self, ground: &S::Ground<'a>) -> Result<Open<S::Kind>> {
        let (site, items) = (self.site, &self.block.items);
        let open_to_kind = |&kind: &S::Kind| {
            let layer = S::layer(ground, kind);
            let left = items.indices_but(|ball| layer.covers(ball));
            open_to(site, ground, kind, (Triangles::Listed(&items.triangles), left), &items.pieces)
        };
        Ok(joined(site.kinds().iter().map(open_to_kind).collect()))
    }

    fn open_area(&self, ground: &S::Ground<'a>, open: &Open<S::Kind>, rng: &mut Rng) -> f64 {
        open_area(self.site, ground, open, PROBES_IN_CUBE, rng)
    }
}

/// The open parts of several kinds, one after the other.
fn joined<L: Copy>(parts: Vec<Open<L>>) -> Open<L> {
    let mut open = Open::default();
    parts.into_iter().for_each(|mut part| open.append(&mut part));
    open
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::Given;
    use crate::job::Context;
    use crate::mesh::exact;
    use crate::psp::fill::blocks::tests::rows;
    use crate::psp::fill::uniform::{Surface, Uniform};
    use crate::psp::fragment::Facing;
    use crate::psp::given::GivenSamples;

    /// Triangles of all sizes, and needles, crossing each other: a large one across many cubes, small ones close
    /// together.
    fn soup(seed: u64) -> Mesh {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        let mut positions: Vec<[f32; 3]> = Vec::new();
        for triangle in 0..300 {
            let size = [1.0, 0.2, 0.05, 0.01, 1e-3][triangle % 5];
            let flat = if triangle % 7 == 0 { 1e-5 } else { 1.0 };
            let at = [(); 3].map(|()| rng.unit() * (1.0 - size));
            let corner = |rng: &mut Rng| [size, size * flat, size * flat].map(|size| rng.unit() * size);
            positions.extend([(); 3].map(|()| {
                let corner = corner(&mut rng);
                [0, 1, 2].map(|axis| (at[axis] + corner[axis]) as f32)
            }));
        }
        Mesh::new(positions, (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap()
    }

    /// Given samples near and on the mesh, every second one with the radius of the set, the others with clearances from
    /// a hundredth to ten times it.
    fn obstacles(mesh: &Mesh, radius: f64, count: usize) -> (Vec<[f32; 3]>, Vec<f64>) {
        let mut rng = Rng::at(9, Draw::Probe, &[]);
        let mut given = |i: usize| {
            let triangle = rng.below(mesh.triangles().len() as u64) as u32;
            let place = mesh.point_exact(triangle, random_point(&mut rng)).to_array();
            let position = place.map(|x| (x + 0.5 * radius * (rng.unit() - 0.5)) as f32);
            let own = radius * libm::exp10(4.0 * rng.unit() * rng.unit() - 2.0);
            (position, if i.is_multiple_of(2) { radius } else { own.min(10.0 * radius) })
        };
        (0..count).map(&mut given).unzip()
    }

    /// Calls `does` with the surface of a mesh without given samples.
    fn with_surface<T>(mesh: &Mesh, measures: &Measures, radius: f64, does: impl FnOnce(&Surface) -> T) -> T {
        let given =
            &GivenSamples::new(mesh, Given::default(), radius, &SampleSet::new(mesh, radius), Facing::ANY).unwrap();
        does(&Surface { mesh, measures, given, facing: Facing::ANY })
    }

    /// The positions of a set made from nothing.
    fn filled(mesh: &Mesh, measures: &Measures, radius: f64, in_blocks: bool) -> Vec<[f32; 3]> {
        let (mut samples, options) = (SampleSet::new(mesh, radius), FillOptions::from_nothing(5));
        with_surface(mesh, measures, radius, |surface| {
            let fill = |job: &Job| surface.fill_either_way(job, &mut samples, in_blocks, options);
            Context::new(2).unwrap().run(None, fill).unwrap();
        });
        samples.all().iter().map(|sample| sample.position).collect()
    }

    /// With a few dozen samples the balls save most tests of triangles, and nothing changes.
    #[test]
    fn the_passes_with_balls_find_what_the_first_one_finds() {
        let (positions, triangles) = rows();
        let (mesh, radius) = (Mesh::new(positions, triangles).unwrap(), 17.0);
        let measures = Measures::of(&mesh);
        let places = [(); 3].map(|()| filled(&mesh, &measures, radius, false));
        assert!(places[0].len() > 20 && places[1] == places[0] && places[2] == places[0]);
        let balls = Context::new(1).unwrap().run(None, |job| measures.balls(job, &mesh, radius)).unwrap().unwrap();
        with_surface(&mesh, &measures, radius, |surface| {
            let (site, triangles) = (Uniform { surface: *surface, radius, largest_rank: None }, measures.triangles());
            let mut ground = site.ground(None);
            places[0].iter().for_each(|&place| ground.add_given(place));
            let covered: Vec<usize> = (0..balls.len()).filter(|&cluster| ground.covers(&balls[cluster])).collect();
            assert!(2 * covered.len() > balls.len());
            let indices = covered.into_iter().flat_map(|cluster| triangles.cluster(cluster));
            assert!(ground.open_triangles(triangles, indices).areas().next().is_none());
        });
    }

    /// Sets of many radii, one after the other, with the balls kept from earlier ones, which are too large for the last
    /// radii. Each equals the set on a mesh that keeps nothing.
    #[test]
    fn cubes_are_filled_alike_whatever_balls_are_kept() {
        let (positions, triangles) = rows();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let kept = Measures::of(&mesh);
        for radius in [17.0, 17.0, 4.0, 2.0, 1.0, 0.5] {
            let in_blocks = radius < 17.0;
            let fresh = filled(&mesh, &Measures::of(&mesh), radius, in_blocks);
            assert!(filled(&mesh, &kept, radius, in_blocks) == fresh, "{radius}");
        }
    }

    /// Each way, on one thread and on three, with given samples and without; the other way then finds nothing open, and
    /// nothing conflicts.
    #[test]
    fn what_is_filled_in_one_piece_and_by_cubes_is_maximal_to_the_other_way() {
        for case in 0..8 {
            let (seed, in_blocks, count) = (case / 4, case % 2 == 1, [0, 100][case as usize / 2 % 2]);
            let (mesh, radius) = (soup(seed), 0.03);
            let measures = Measures::of(&mesh);
            let (positions, clearances) = obstacles(&mesh, radius, count);
            let given = Given::with_clearances(&positions, &clearances);
            let given = &GivenSamples::new(&mesh, given, radius, &SampleSet::new(&mesh, radius), Facing::ANY).unwrap();
            assert!(count == 0 || 10 * given.alike().len() > 4 * count && !given.obstacles.is_empty());
            let surface = Surface { mesh: &mesh, measures: &measures, given, facing: Facing::ANY };
            let fill_with = |threads, samples: &mut SampleSet, in_blocks| {
                let options = FillOptions::around(samples, seed);
                let fill = |job: &Job| surface.fill_either_way(job, samples, in_blocks, options);
                Context::new(threads).unwrap().run(None, fill).unwrap()
            };
            let [mut one, mut three] = [(); 2].map(|()| SampleSet::new(&mesh, radius));
            let filled = fill_with(1, &mut one, in_blocks);
            fill_with(3, &mut three, in_blocks);
            let places = |set: &SampleSet| set.all().iter().map(|sample| sample.position).collect::<Vec<_>>();
            let samples = places(&one);
            assert_eq!(samples, places(&three), "depends on the threads");
            assert!(samples.len() > 500 && filled.darts > samples.len() as u64);
            assert_eq!(filled.open_area == mesh.area(), count == 0);
            for (i, &a) in samples.iter().enumerate() {
                assert!(samples[..i].iter().all(|&b| exact(a).distance(exact(b)) >= radius));
                let mut given = positions.iter().zip(&clearances);
                assert!(given.all(|(&b, &clearance)| exact(a).distance(exact(b)) >= clearance));
            }
            let again = fill_with(1, &mut one, !in_blocks);
            assert_eq!(one.len(), samples.len(), "a gap was left");
            assert!(again.open_area < 0.01 * mesh.area());
        }
    }
}
