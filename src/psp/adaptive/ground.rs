//! The surface in a cube where the radius varies, and the samples whose balls cover it.

use std::cell::Cell;

use glam::DVec3;

use crate::error::Result;
use crate::math::rounded_down;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::adaptive::grid::{GradedSample, Grid};
use crate::psp::adaptive::pieces::Piece;
use crate::psp::adaptive::{CubeOfPieces, GradedSurface, MeasuredTriangles, Quota, RadiusBounds, RadiusField};
use crate::psp::fill::{BATCH, Batch, Ground, Layer, Open, PATCH, Patch, Point, WHOLE, WholeTriangle};
use crate::psp::fragment::Fragment;
use crate::psp::given::Obstacles;
use crate::psp::set::Sample;

/// The limit of fragments tested in a cube, per piece and sample. Slopes of 1 take about forty, of 4 about a hundred:
/// one far steeper than 30 would take hours.
const TESTS: u64 = 1 << 12;

/// The surface in a cube.
pub struct GradedGround<'a> {
    mesh: &'a Mesh,
    triangles: &'a MeasuredTriangles<'a>,
    /// The radii, with a first error of their own.
    field: RadiusField<'a>,
    /// Their scale over that of the surface, which bounds of radii have.
    share: f64,
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
    /// The surface in a cube, without samples except given ones, where all radii are those of a field at this scale. The
    /// samples that the fill adds get ranks if there is a largest one.
    pub fn new(
        surface: &GradedSurface<'a>,
        cube: &CubeOfPieces,
        scale: f64,
        obstacles: &'a Obstacles,
        largest_rank: Option<f64>,
    ) -> Self {
        let &GradedSurface { mesh, field, quota, facing, triangles, .. } = surface;
        let (share, stretch) = (scale / field.scale(), largest_rank.map_or(1.0, |rank| (rank / scale).max(1.0)));
        Self {
            mesh,
            triangles,
            field: field.at_scale(scale),
            share,
            quota,
            obstacles,
            grid: Grid::new(mesh, facing, cube.bounds, cube.radii.map(|radius| share * radius), stretch),
            tests: Cell::new(TESTS * (surface.limit(cube) + obstacles.listed() as u64)),
            largest_rank,
            accepted: Vec::new(),
            darts: 0,
        }
    }

    /// Fails if the radii have failed.
    pub fn check(&self) -> Result<()> {
        self.field.check()
    }

    /// A sample with its radius at the scale of the field.
    #[inline(always)]
    fn graded(&self, &(sample, relative): &(Sample, f64)) -> GradedSample {
        let Sample { position, triangle, .. } = sample;
        GradedSample { position, radius: self.field.scale() * relative, normal: self.normal(triangle) }
    }

    /// The open parts of some pieces.
    pub fn open_pieces<'p>(&self, pieces: impl Iterator<Item = &'p Piece>) -> Open<RadiusBounds> {
        let (mut open, mut wholes) = (Open::default(), Vec::with_capacity(BATCH));
        for piece in pieces {
            match piece {
                Piece::Whole(whole) => wholes.push(*whole),
                Piece::Part(part) => self.open_parts(&part.fragment, part.longest, part.local, &mut open),
            }
            if wholes.len() == BATCH {
                self.add_open_wholes(&wholes, &mut open);
                wholes.clear();
            }
        }
        if !wholes.is_empty() {
            self.add_open_wholes(&wholes, &mut open);
        }
        open
    }

    /// Adds the triangles of a group that are not covered: whole, if they are small, or in parts.
    fn add_open_wholes(&self, wholes: &[WholeTriangle<RadiusBounds>], open: &mut Open<RadiusBounds>) {
        let mut uncovered = self.open_wholes(wholes);
        while uncovered != 0 {
            let whole = wholes[uncovered.trailing_zeros() as usize];
            uncovered &= uncovered - 1;
            if whole.longest <= WHOLE {
                open.wholes.push(whole);
            } else {
                self.open_parts(&Fragment::whole(whole.triangle), whole.longest, whole.local, open);
            }
        }
    }

    /// Adds the open parts of a fragment, in patches that are small enough.
    fn open_parts(&self, fragment: &Fragment, longest: f32, bounds: RadiusBounds, open: &mut Open<RadiusBounds>) {
        let count = (f64::from(longest) / PATCH).ceil().max(1.0) as u32;
        open.patches.extend(fragment.parts(count).filter_map(|part| self.patch(&part, bounds)));
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
    #[inline(always)]
    fn uncovered(
        &self,
        fragment: &Fragment,
        bounds: RadiusBounds,
        corners: [DVec3; 3],
        longest: f64,
        open: u16,
    ) -> u16 {
        let radii = self.field.radii_from(fragment, bounds.times(self.share));
        let normal = self.normal(fragment.triangle);
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
        let longest = f64::from(patch.longest) * (self.share * patch.local.scale());
        self.uncovered(&patch.fragment, patch.local, corners, longest, patch.open)
    }

    fn open_wholes(&self, wholes: &[WholeTriangle<RadiusBounds>]) -> u64 {
        if self.has_failed() {
            return 0;
        }
        let mut group = Batch::EMPTY;
        for (lane, whole) in wholes.iter().enumerate() {
            let positions = self.mesh.corners(whole.triangle);
            let radii = self.field.radii_from(&Fragment::whole(whole.triangle), whole.local.times(self.share));
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

    fn throw(&mut self, dart: (Sample, RadiusBounds)) {
        self.darts += 1;
        if let Some((sample, relative)) = self.settled(&dart, |sample| self.rejects(sample)) {
            let rank = rounded_down(self.rank(&(sample, relative)));
            self.add(&(sample, relative));
            self.accepted.push((Sample { rank, ..sample }, relative));
        }
    }

    /// True if no given sample covers the point.
    fn is_open(&self, point: Point<RadiusBounds>) -> bool {
        !self.obstacles.reject(self.mesh.point(point.triangle, round_barycentrics(point.barycentrics)))
    }

    fn into_accepted(self) -> (Vec<(Sample, f64)>, u64) {
        (self.accepted, self.darts)
    }
}

impl Layer for GradedGround<'_> {
    fn radius(&self) -> f64 {
        self.field.scale()
    }

    fn add(&mut self, sample: &(Sample, f64)) {
        self.grid.add(self.graded(sample));
    }

    #[inline(always)]
    fn rejects(&self, sample: &(Sample, f64)) -> bool {
        self.grid.rejects(&self.graded(sample)) || self.obstacles.reject(sample.0.position)
    }

    /// The least ratio to the samples that matter, times the scale, but no more than the largest rank. The distances
    /// that it guarantees are kept in whatever order a caller evaluates them.
    fn rank(&self, sample: &(Sample, f64)) -> f64 {
        let Some(largest) = self.largest_rank else { return f64::INFINITY };
        let scale = self.field.scale();
        (scale * self.grid.ratio(&self.graded(sample)) * (1.0 - 1e-14)).min(largest).max(scale)
    }

    #[inline(always)]
    fn least(&self, &(sample, bounds): &(Sample, RadiusBounds)) -> (Sample, f64) {
        (sample, bounds.least / self.field.scale())
    }

    /// A function is not called if every radius that it may give is rejected.
    #[inline(always)]
    fn settled(
        &self,
        dart: &(Sample, RadiusBounds),
        rejects: impl Fn(&(Sample, f64)) -> bool,
    ) -> Option<(Sample, f64)> {
        let (least, &(sample, bounds)) = (self.least(dart), dart);
        if self.has_failed() || rejects(&least) {
            return None;
        }
        let settled = (sample, self.field.at_within(&sample, bounds));
        if self.field.is_empty_radius(self.field.scale() * settled.1) || settled.1 > least.1 && rejects(&settled) {
            return None;
        }
        self.quota.take(1);
        self.tests.set(self.tests.get() + TESTS);
        Some(settled)
    }

    /// A ball may be of a sample whose radius is many times the local one.
    fn may_cover(&self, _: f32) -> bool {
        true
    }
}
