//! Filling where the radius varies: octave by octave and cube by cube, each as a surface of one radius is filled.

use std::cell::Cell;

use glam::DVec3;

use crate::error::Result;
use crate::index::Weights;
use crate::job::Job;
use crate::math::{rounded_down, square};
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::adaptive::field::{Quota, RadiusBounds, RadiusField};
use crate::psp::adaptive::grid::{GradedSample, Grid};
use crate::psp::adaptive::pieces::{MeasuredTriangles, Piece, pieces};
use crate::psp::adaptive::set::AdaptiveSet;
use crate::psp::fill::{
    FIRST_DARTS, FillOptions, GROUP, Ground, Group, Open, PATCH, PROBES_IN_CUBE, Patch, Point, WHOLE, Whole, Zone,
    fill_zone, open_share, random_point, throw,
};
use crate::psp::fragment::{Facing, Fragment};
use crate::psp::given::Obstacles;
use crate::psp::set::{OctaveCube, Sample};
use crate::rng::{Draw, Rng};

/// A surface to be filled where the radius varies, and the samples given on it.
#[derive(Clone, Copy)]
pub struct GradedSurface<'a> {
    pub mesh: &'a Mesh,
    pub field: &'a RadiusField<'a>,
    pub quota: &'a Quota,
    pub facing: Facing,
    pub obstacles: &'a Obstacles,
    pub triangles: &'a MeasuredTriangles<'a>,
    /// The finest scale that is expected.
    pub finest: f64,
}

impl GradedSurface<'_> {
    /// A maximal set around some samples, and the number of darts.
    pub fn fill(&self, job: &Job, options: FillOptions, samples: &[(Sample, f64)]) -> Result<(AdaptiveSet, u64)> {
        let &Self { mesh, field, quota, facing, obstacles, triangles, .. } = self;
        let mut set = AdaptiveSet::new(mesh, options.seed, field.scale(), samples);
        triangles.begin_level(samples.len(), options.throws_first);
        let stretch = options.largest_rank.map_or(1.0, |rank| (rank / field.scale()).max(1.0));
        let pieces = pieces(&job.part(0.05, 0.2), triangles, field, quota, &set.cubes)?;
        field.check()?;
        quota.check(field.argument())?;
        let cubes: Vec<OctaveCube> = (0..pieces.len()).map(|number| pieces.key(number)).collect();
        let darts = set.grow(&job.part(0.2, 1.0), &cubes, |number, set| {
            let (cube, field) = (cubes[number], field.apart());
            let pieces: Vec<&Piece> = pieces.items(number).collect();
            let near = set.samples_around(mesh, facing, cube, stretch);
            let grid = grid(mesh, &field, facing, near, &pieces, stretch);
            let mut ground = GradedGround::new(triangles, &field, quota, obstacles, grid, self.limit(&pieces));
            ground = ground.ranked(options.largest_rank);
            let mut rng = Rng::at(options.seed, Draw::Adaptive, &cube.key());
            // Without first darts no random point is asked for.
            let weighed = if options.throws_first { &pieces[..] } else { &[] };
            let areas = Weights::new(weighed.iter().map(|piece| piece.area()).collect());
            let mut zone = CubeZone { pieces: &pieces, areas, obstacles };
            let share = open_share(&mut zone, &ground, options, &mut rng);
            fill_zone(&mut zone, &mut ground, share, options, &mut rng)?;
            field.check()?;
            quota.check(field.argument()).map(|()| ground.into_accepted())
        })?;
        triangles.end_level(set.len());
        Ok((set, darts))
    }

    /// The number of pieces for the work limit: those of a cube, and at a scale coarser than the finest as many as
    /// there will be samples on them. Radii are steeper there by as much as samples are fewer.
    fn limit(&self, pieces: &[&Piece]) -> u64 {
        let growth = square(self.field.scale() / self.finest);
        let samples: f64 = pieces.iter().map(|piece| piece.area()).sum();
        pieces.len() as u64 + if growth > 1.0 { (growth * samples) as u64 } else { 0 }
    }
}

/// The samples around a cube, in a grid that suits the radii on its pieces.
fn grid(
    mesh: &Mesh,
    field: &RadiusField,
    facing: Facing,
    near: Vec<GradedSample>,
    pieces: &[&Piece],
    stretch: f64,
) -> Grid {
    let largest = field.above(pieces.iter().map(|piece| piece.bounds().largest).fold(0.0, f64::max));
    // The area over the number of samples that will lie on it gives their usual radius.
    let samples: f64 = pieces.iter().map(|piece| piece.area()).sum();
    let area: f64 = pieces.iter().map(|piece| piece.area() / piece.bounds().density()).sum();
    let usual = if samples > 0.0 { (area / samples).sqrt() } else { largest };
    let corners = pieces.iter().flat_map(|piece| match piece {
        Piece::Whole(whole) => mesh.exact_corners(whole.triangle),
        Piece::Part(part) => part.fragment.corners.map(|corner| mesh.point_exact(part.fragment.triangle, corner)),
    });
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let bounds = corners.fold(none, |[low, high], corner| [low.min(corner), high.max(corner)]);
    let mut grid = Grid::new(mesh, facing, bounds, [usual, largest], stretch);
    near.into_iter().for_each(|sample| grid.add(sample));
    grid
}

/// The pieces of a cube.
struct CubeZone<'a, 'g> {
    pieces: &'a [&'a Piece],
    areas: Weights,
    obstacles: &'g Obstacles,
}

impl<'g> Zone for CubeZone<'_, 'g> {
    type Ground = GradedGround<'g>;

    fn is_bare(&self) -> bool {
        self.obstacles.is_empty()
    }

    fn probes(&self) -> usize {
        PROBES_IN_CUBE
    }

    /// The area, in squared radii.
    fn area(&self) -> f64 {
        self.areas.total()
    }

    fn point(&mut self, rng: &mut Rng) -> Point<RadiusBounds> {
        let piece = &self.pieces[self.areas.pick(rng) as usize];
        let fragment = piece.fragment();
        Point { triangle: fragment.triangle, barycentrics: fragment.at(random_point(rng)), local: piece.bounds() }
    }

    fn throw_first(&mut self, ground: &mut GradedGround<'g>, rng: &mut Rng) -> Result<()> {
        let darts = (FIRST_DARTS * self.areas.total() + rng.unit()) as usize;
        throw(ground, (0..darts).map(|_| self.point(rng)));
        Ok(())
    }

    fn open(&self, ground: &GradedGround<'g>) -> Result<Open<RadiusBounds>> {
        Ok(open_pieces(ground, self.pieces))
    }
}

/// The open parts of some pieces.
fn open_pieces(ground: &GradedGround, pieces: &[&Piece]) -> Open<RadiusBounds> {
    let (mut open, mut wholes) = (Open::default(), Vec::with_capacity(GROUP));
    for piece in pieces {
        match piece {
            Piece::Whole(whole) => wholes.push(*whole),
            Piece::Part(part) => open_parts(ground, &part.fragment, part.longest, part.local, &mut open),
        }
        if wholes.len() == GROUP {
            open_wholes(ground, &wholes, &mut open);
            wholes.clear();
        }
    }
    if !wholes.is_empty() {
        open_wholes(ground, &wholes, &mut open);
    }
    open
}

/// Adds the triangles of a group that are not covered: whole, if they are small, or in parts.
fn open_wholes(ground: &GradedGround, wholes: &[Whole<RadiusBounds>], open: &mut Open<RadiusBounds>) {
    let mut uncovered = ground.open_wholes(wholes);
    while uncovered != 0 {
        let whole = wholes[uncovered.trailing_zeros() as usize];
        uncovered &= uncovered - 1;
        if whole.longest <= WHOLE {
            open.wholes.push(whole);
        } else {
            open_parts(ground, &Fragment::whole(whole.triangle), whole.longest, whole.local, open);
        }
    }
}

/// Adds the open parts of a fragment, in patches that are small enough.
fn open_parts(
    ground: &GradedGround,
    fragment: &Fragment,
    longest: f32,
    bounds: RadiusBounds,
    open: &mut Open<RadiusBounds>,
) {
    let count = (f64::from(longest) / PATCH).ceil().max(1.0) as u32;
    open.patches.extend(fragment.parts(count).filter_map(|part| ground.patch(&part, bounds)));
}

/// The limit of fragments tested in a cube, per piece and sample. Slopes of 1 take about forty, of 4 about a hundred:
/// one far steeper than 30 would take hours.
const TESTS: u64 = 1 << 12;

/// The surface in a cube.
pub struct GradedGround<'a> {
    mesh: &'a Mesh,
    triangles: &'a MeasuredTriangles<'a>,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    obstacles: &'a Obstacles,
    grid: Grid,
    /// The number of fragments that may still be tested.
    tests: Cell<u64>,
    /// The largest rank of the samples that the fill adds, if they get ranks (`psp/levels.rs`).
    largest_rank: Option<f64>,
    /// The samples that the fill has added, with their relative radii.
    accepted: Vec<(Sample, f64)>,
    /// The number of darts thrown.
    darts: u64,
}

impl<'a> GradedGround<'a> {
    /// The surface, with a work limit of a few thousand tests for each of so many pieces.
    pub fn new(
        triangles: &'a MeasuredTriangles<'a>,
        field: &'a RadiusField<'a>,
        quota: &'a Quota,
        obstacles: &'a Obstacles,
        grid: Grid,
        pieces: u64,
    ) -> Self {
        let (mesh, tests) = (triangles.mesh, Cell::new(TESTS * (pieces + obstacles.listed() as u64)));
        let (accepted, darts) = (Vec::new(), 0);
        Self { mesh, triangles, field, quota, obstacles, grid, tests, largest_rank: None, accepted, darts }
    }

    /// The ground with ranks, up to the largest, for the samples that the fill adds.
    pub fn ranked(self, largest: Option<f64>) -> Self {
        Self { largest_rank: largest, ..self }
    }

    /// The rank of a sample that is added now. The distances that it guarantees are kept in whatever order a caller
    /// evaluates them.
    fn rank(&self, sample: &GradedSample) -> f32 {
        let Some(largest) = self.largest_rank else { return f32::INFINITY };
        let scale = self.field.scale();
        rounded_down((scale * self.grid.ratio(sample) * (1.0 - 1e-14)).min(largest).max(scale))
    }

    /// True if the call has failed already.
    fn has_failed(&self) -> bool {
        self.field.has_failed() || self.quota.is_exceeded()
    }

    /// Counts the test of a fragment; the call fails if there are too many.
    fn count_test(&self, place: DVec3) {
        match self.tests.get().checked_sub(1) {
            Some(tests) => self.tests.set(tests),
            None => self.field.exceed_work(place),
        }
    }

    /// The normal of a triangle, where normals matter.
    fn normal(&self, triangle: u32) -> [f32; 3] {
        self.grid.pages.facing.normal(self.mesh, triangle)
    }

    /// Those of some sixteenths of a fragment, given with its corners, that nothing certainly covers.
    fn uncovered(
        &self,
        fragment: &Fragment,
        bounds: RadiusBounds,
        corners: [DVec3; 3],
        longest: f64,
        open: u16,
    ) -> u16 {
        let (radii, normal) = (self.field.radii_from(fragment, bounds), self.normal(fragment.triangle));
        self.obstacles.open_sixteenths(corners, self.grid.open_sixteenths(&corners, radii, longest, normal, open))
    }
}

impl Ground for GradedGround<'_> {
    type Local = RadiusBounds;
    /// A sample, and the bounds of its radius.
    type Dart = (Sample, RadiusBounds);
    type Sample = (Sample, f64);

    fn finest(&self, bounds: RadiusBounds) -> f32 {
        (self.mesh.float_spacing() / bounds.scale()) as f32
    }

    fn patch(&self, fragment: &Fragment, within: RadiusBounds) -> Option<Patch<RadiusBounds>> {
        if self.has_failed() {
            return None;
        }
        let shape = fragment.shape(self.mesh);
        self.count_test(shape.centre);
        let bounds = self.field.narrowed(fragment, &shape, within);
        if self.field.is_empty_radius(bounds.least) {
            return None;
        }
        let open = self.uncovered(fragment, bounds, shape.corners, shape.longest, u16::MAX);
        (open != 0).then(|| Patch {
            fragment: *fragment,
            open,
            area: (fragment.area(self.mesh) * bounds.density()) as f32,
            longest: (shape.longest / bounds.scale()) as f32,
            local: bounds,
        })
    }

    fn open_sixteenths(&self, patch: &Patch<RadiusBounds>) -> u16 {
        if self.has_failed() {
            return 0;
        }
        let [a, b, c] = self.mesh.exact_corners(patch.fragment.triangle);
        let corners = patch.fragment.corners.map(|[u, v]| (1.0 - u - v) * a + u * b + v * c);
        let longest = f64::from(patch.longest) * patch.local.scale();
        self.uncovered(&patch.fragment, patch.local, corners, longest, patch.open)
    }

    fn open_wholes(&self, wholes: &[Whole<RadiusBounds>]) -> u64 {
        if self.has_failed() {
            return 0;
        }
        let mut group = Group::EMPTY;
        for (lane, whole) in wholes.iter().enumerate() {
            let positions = self.mesh.corners(whole.triangle);
            let radii = self.field.radii_from(&Fragment::whole(whole.triangle), whole.local);
            group.triangles[lane] = std::array::from_fn(|corner| self.grid.ball(positions[corner], radii[corner]));
        }
        let open = self.grid.pages.open_triangles(&mut group, wholes.len(), |lane| self.normal(wholes[lane].triangle));
        let covered = (0..wholes.len()).filter(|lane| self.triangles.keeps_covered() && open >> lane & 1 == 0);
        for lane in covered {
            let triangle = wholes[lane].triangle;
            let share = self.grid.covering_share(&group.triangles[lane], self.normal(triangle));
            self.triangles.cover(triangle, share * self.field.scale());
        }
        self.obstacles.open_triangles(open, |lane| self.mesh.corners(wholes[lane].triangle))
    }

    fn mesh(&self) -> &Mesh {
        self.mesh
    }

    fn dart(&self, point: Point<RadiusBounds>, corners: &[[f32; 3]; 3]) -> (Sample, RadiusBounds) {
        let sample = Sample::on(corners, point.triangle, round_barycentrics(point.barycentrics));
        (sample, self.field.known_at(&sample, point.local))
    }

    fn throw(&mut self, (sample, bounds): (Sample, RadiusBounds)) {
        if self.has_failed() {
            return;
        }
        self.darts += 1;
        let (position, normal) = (sample.position, self.normal(sample.triangle));
        let mut graded = GradedSample { position, radius: bounds.least, normal };
        // A function is not called if every radius that it may give conflicts.
        if self.grid.rejects(&graded) || self.obstacles.reject(graded.position) {
            return;
        }
        let relative = self.field.at_within(&sample, bounds);
        graded.radius = self.field.scale() * relative;
        if self.field.is_empty_radius(graded.radius) || graded.radius > bounds.least && self.grid.rejects(&graded) {
            return;
        }
        let rank = self.rank(&graded);
        self.grid.add(graded);
        self.accepted.push((Sample { rank, ..sample }, relative));
        self.quota.take(1);
        self.tests.set(self.tests.get() + TESTS);
    }

    /// True if no given sample covers the point.
    fn is_open(&self, point: Point<RadiusBounds>) -> bool {
        !self.obstacles.reject(self.mesh.point(point.triangle, round_barycentrics(point.barycentrics)))
    }

    fn into_accepted(self) -> (Vec<(Sample, f64)>, u64) {
        (self.accepted, self.darts)
    }
}
