//! A surface whose radius varies, as the rounds of a fill know it (`psp/fill/ground.rs`).

use std::cell::Cell;

use glam::DVec3;

use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::adaptive::dot::Dot;
use crate::psp::adaptive::field::{RadiusBounds, RadiusField};
use crate::psp::adaptive::grid::{Grid, Shade};
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::page::Group;
use crate::psp::fill::ground::{Ground, Patch, Whole};
use crate::psp::fragment::Fragment;
use crate::psp::samples::Sample;

/// At how many fragments a cube may look for each of its pieces and samples. Slopes of 1 take about forty, of 4 about a
/// hundred: stating a far steeper one than 30 would mean waiting for hours.
const LOOKS: u64 = 1 << 12;

/// The surface in a cube.
pub(super) struct GradedGround<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    grid: Grid,
    /// At how many fragments it may still look.
    looks: Cell<u64>,
    /// The samples that the fill has added, with their radii.
    pub accepted: Vec<(Sample, f64)>,
    /// How many darts it took.
    pub darts: u64,
}

impl<'a> GradedGround<'a> {
    /// The surface in so many pieces.
    pub fn new(mesh: &'a Mesh, field: &'a RadiusField<'a>, quota: &'a Quota, grid: Grid, pieces: usize) -> Self {
        let looks = Cell::new(LOOKS * pieces as u64);
        Self { mesh, field, quota, grid, looks, accepted: Vec::new(), darts: 0 }
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
        if self.grid.rule.asks_normals() { self.mesh.normal(triangle) } else { [0.0; 3] }
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
        let open = self.grid.open_sixteenths(&self.shade(fragment, bounds, shape.corners, shape.longest), u16::MAX);
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
        self.grid.open_sixteenths(&self.shade(&patch.fragment, patch.local, corners, longest), patch.open)
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
        self.grid.open_triangles(&mut group, &normals)
    }

    fn dart(&self, triangle: u32, barycentrics: [f64; 2], bounds: RadiusBounds) -> (Sample, RadiusBounds) {
        let sample = Sample::new(self.mesh, triangle, round_barycentrics(barycentrics));
        (sample, self.field.known_at(&sample, bounds))
    }

    fn throw(&mut self, (sample, bounds): (Sample, RadiusBounds)) {
        if self.is_futile() {
            return;
        }
        self.darts += 1;
        let mut dot = Dot { position: sample.position, radius: bounds.least, normal: self.normal(sample.triangle) };
        // A function is not called where any radius that it may give conflicts.
        if self.grid.rejects(&dot) {
            return;
        }
        dot.radius = self.field.at_within(&sample, bounds);
        if dot.radius > bounds.least && self.grid.rejects(&dot) {
            return;
        }
        self.grid.add(dot);
        self.accepted.push((sample, dot.radius));
        self.quota.take(1);
        self.looks.set(self.looks.get() + LOOKS);
    }
}
