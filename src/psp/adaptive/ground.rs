//! A surface whose radius varies, as the rounds of a fill know it (`psp/fill/ground.rs`).

use std::cell::Cell;

use glam::DVec3;

use crate::math::rounded_down;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::adaptive::bounds::RadiusBounds;
use crate::psp::adaptive::dot::Dot;
use crate::psp::adaptive::field::RadiusField;
use crate::psp::adaptive::grid::{Grid, Shade};
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::page::Group;
use crate::psp::fill::ground::{Ground, Patch, Point, Whole};
use crate::psp::fragment::Fragment;
use crate::psp::obstacles::Obstacles;
use crate::psp::samples::Sample;

/// At how many fragments a cube may look for each of its pieces and samples. Slopes of 1 take about forty, of 4 about a
/// hundred: stating a far steeper one than 30 would mean waiting for hours.
const LOOKS: u64 = 1 << 12;

/// The surface in a cube.
pub(super) struct GradedGround<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    obstacles: &'a Obstacles,
    grid: Grid,
    /// At how many fragments it may still look.
    looks: Cell<u64>,
    /// The largest rank of the samples that the fill adds, if these get ranks (`psp/levels.rs`).
    largest_rank: Option<f64>,
    /// The samples that the fill has added, with their relative radii.
    pub accepted: Vec<(Sample, f64)>,
    /// How many darts it took.
    pub darts: u64,
}

impl<'a> GradedGround<'a> {
    /// The surface, at so many pieces of which it may look a few thousand times each.
    pub fn new(
        mesh: &'a Mesh,
        field: &'a RadiusField<'a>,
        quota: &'a Quota,
        obstacles: &'a Obstacles,
        grid: Grid,
        pieces: u64,
    ) -> Self {
        let looks = Cell::new(LOOKS * (pieces + obstacles.listed() as u64));
        Self { mesh, field, quota, obstacles, grid, looks, largest_rank: None, accepted: Vec::new(), darts: 0 }
    }

    /// The ground, with ranks for the samples that the fill adds: up to the largest.
    pub fn ranked(self, largest: Option<f64>) -> Self {
        Self { largest_rank: largest, ..self }
    }

    /// The rank of a sample that is added now. The distances that it stands for are kept in whatever order a caller
    /// evaluates them.
    fn rank(&self, dot: &Dot) -> f32 {
        let Some(largest) = self.largest_rank else { return f32::INFINITY };
        let scale = self.field.scale();
        rounded_down((scale * self.grid.ratio(dot) * (1.0 - 1e-14)).min(largest).max(scale))
    }

    /// The share of so many points that no given sample covers.
    pub fn open_share(&self, count: usize, mut point: impl FnMut() -> Point<RadiusBounds>) -> f64 {
        if self.obstacles.is_empty() {
            return 1.0;
        }
        let is_open = |_: &usize| {
            let Point { triangle, barycentrics, .. } = point();
            !self.obstacles.reject(self.mesh.point(triangle, round_barycentrics(barycentrics)))
        };
        (0..count).filter(is_open).count() as f64 / count as f64
    }

    /// Whether the rest of the work is in vain.
    fn is_futile(&self) -> bool {
        self.field.has_failed() || self.quota.is_exceeded()
    }

    /// Counts a look at a fragment; the radii have failed where there are too many.
    fn count_look(&self, place: DVec3) {
        match self.looks.get().checked_sub(1) {
            Some(looks) => self.looks.set(looks),
            None => self.field.give_up(place),
        }
    }

    /// The normal of a triangle, where normals matter.
    fn normal(&self, triangle: u32) -> [f32; 3] {
        self.grid.facing.normal(self.mesh, triangle)
    }

    fn shade(&self, fragment: &Fragment, bounds: RadiusBounds, corners: [DVec3; 3], longest: f64) -> Shade {
        let radii = self.field.radii_from(fragment, bounds);
        Shade { corners, radii, longest, normal: self.normal(fragment.triangle) }
    }
}

impl Ground for GradedGround<'_> {
    type Local = RadiusBounds;
    /// A sample, and what its radius is between.
    type Dart = (Sample, RadiusBounds);

    fn finest(&self, bounds: RadiusBounds) -> f32 {
        (self.mesh.float_spacing() / bounds.scale()) as f32
    }

    fn look(&self, fragment: &Fragment, within: RadiusBounds) -> Option<Patch<RadiusBounds>> {
        if self.is_futile() {
            return None;
        }
        let shape = fragment.shape(self.mesh);
        self.count_look(shape.centre);
        let bounds = self.field.narrowed(fragment, &shape, within);
        if self.field.is_nothing(bounds.least) {
            return None;
        }
        let open = self.grid.open_sixteenths(&self.shade(fragment, bounds, shape.corners, shape.longest), u16::MAX);
        let open = self.obstacles.open_sixteenths(shape.corners, open);
        (open != 0).then(|| Patch {
            fragment: *fragment,
            open,
            area: (fragment.area(self.mesh) * bounds.density()) as f32,
            longest: (shape.longest / bounds.scale()) as f32,
            local: bounds,
        })
    }

    fn open_sixteenths(&self, patch: &Patch<RadiusBounds>) -> u16 {
        if self.is_futile() {
            return 0;
        }
        let [a, b, c] = self.mesh.exact_corners(patch.fragment.triangle);
        let corners = patch.fragment.corners.map(|[u, v]| (1.0 - u - v) * a + u * b + v * c);
        let longest = f64::from(patch.longest) * patch.local.scale();
        let shade = self.shade(&patch.fragment, patch.local, corners, longest);
        self.obstacles.open_sixteenths(corners, self.grid.open_sixteenths(&shade, patch.open))
    }

    fn open_wholes(&self, wholes: &[Whole<RadiusBounds>]) -> u64 {
        if self.is_futile() {
            return 0;
        }
        let (mut group, mut normals) = (Group::EMPTY, Vec::with_capacity(wholes.len()));
        for (lane, whole) in wholes.iter().enumerate() {
            let positions = self.mesh.corners(whole.triangle);
            let radii = self.field.radii_from(&Fragment::whole(whole.triangle), whole.local);
            group.triangles[lane] = std::array::from_fn(|corner| self.grid.ball(positions[corner], radii[corner]));
            normals.push(self.normal(whole.triangle));
        }
        let open = self.grid.open_triangles(&mut group, &normals);
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
        if self.is_futile() {
            return;
        }
        self.darts += 1;
        let mut dot = Dot { position: sample.position, radius: bounds.least, normal: self.normal(sample.triangle) };
        // A function is not called where any radius that it may give conflicts.
        if self.grid.rejects(&dot) || self.obstacles.reject(dot.position) {
            return;
        }
        let relative = self.field.at_within(&sample, bounds);
        dot.radius = self.field.scale() * relative;
        if self.field.is_nothing(dot.radius) || dot.radius > bounds.least && self.grid.rejects(&dot) {
            return;
        }
        let rank = self.rank(&dot);
        self.grid.add(dot);
        self.accepted.push((Sample { rank, ..sample }, relative));
        self.quota.take(1);
        self.looks.set(self.looks.get() + LOOKS);
    }
}
