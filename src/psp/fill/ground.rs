//! What a fill rains on: a surface of which samples cover a part.
//!
//! The rounds (`rounds.rs`) know it by this trait only, so that they serve whatever a sample covers. A ground looks at
//! fragments and takes darts. Lengths are in radii, areas in squared radii: those of the place, where the radius
//! varies.

use glam::DVec3;

use crate::mesh::{Mesh, round_barycentrics, rounded_down};
use crate::psp::facing::{Facing, NO_NORMAL};
use crate::psp::fill::cells::Cells;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::grid::Grid;
use crate::psp::fill::page::{GROUP, Group};
use crate::psp::fill::space::Space;
use crate::psp::fragment::Fragment;
use crate::psp::obstacles::Obstacles;
use crate::psp::samples::Sample;
use crate::psp::sixteenths::SIXTEENTHS;

/// A whole triangle, small beside the radius, that may be uncovered.
#[derive(Clone, Copy, Debug)]
pub(in crate::psp) struct Whole<L = ()> {
    pub triangle: u32,
    pub area: f32,
    pub longest: f32,
    /// What is known of the radius on it.
    pub local: L,
}

/// A fragment that may be uncovered.
#[derive(Clone, Copy, Debug)]
pub(in crate::psp) struct Patch<L = ()> {
    pub fragment: Fragment,
    /// A bit for each sixteenth that may be; at least one.
    pub open: u16,
    pub area: f32,
    /// The longest edge.
    pub longest: f32,
    /// What is known of the radius on it.
    pub local: L,
}

/// A point that a dart is thrown at.
#[derive(Clone, Copy)]
pub(in crate::psp) struct Point<L = ()> {
    pub triangle: u32,
    pub barycentrics: [f64; 2],
    /// What is known of the radius there.
    pub local: L,
}

/// A surface with samples.
pub(in crate::psp) trait Ground {
    /// What is known of the radius on a part of the surface.
    type Local: Copy;
    /// A dart, until it is known whether it is accepted.
    type Dart;

    /// Fragments no longer than this are cut up no more.
    fn finest(&self, local: Self::Local) -> f32;

    /// A fragment as a patch, unless all of its sixteenths are covered, each by one sample. What is known of the radius
    /// is that of a part which the fragment belongs to.
    fn look(&self, fragment: &Fragment, within: Self::Local) -> Option<Patch<Self::Local>>;

    /// Adds the open sixteenths of a patch that are not covered, as patches.
    fn look_closer(&self, patch: &Patch<Self::Local>, grown: &mut Vec<Patch<Self::Local>>) {
        let parts = (0..16).filter(|part| patch.open >> part & 1 == 1);
        grown.extend(parts.filter_map(|part| self.look(&patch.fragment.sixteenth(part), patch.local)));
    }

    /// Which of the open sixteenths of a patch no single sample certainly covers now.
    fn open_sixteenths(&self, patch: &Patch<Self::Local>) -> u16;

    /// Which of at most 64 triangles no single sample certainly covers: a bit for each.
    fn open_wholes(&self, wholes: &[Whole<Self::Local>]) -> u64;

    /// The mesh that it lies on.
    fn mesh(&self) -> &Mesh;

    /// The dart at a point of a triangle with these corners, which lies in a part of this radius.
    fn dart(&self, point: Point<Self::Local>, corners: &[[f32; 3]; 3]) -> Self::Dart;

    /// The same, where the corners are not at hand.
    fn dart_at(&self, point: Point<Self::Local>) -> Self::Dart {
        self.dart(point, &self.mesh().corners(point.triangle))
    }

    /// Makes a dart a sample, unless it conflicts with another one.
    fn throw(&mut self, dart: Self::Dart);
}

/// A surface whose samples all have one radius.
pub(in crate::psp) struct UniformGround<'a> {
    pub mesh: &'a Mesh,
    pub grid: Grid,
    /// The samples that the fill has added.
    pub accepted: Vec<Sample>,
    /// How many darts it took.
    pub darts: u64,
    facing: Facing,
    obstacles: &'a Obstacles,
    /// The largest rank, in the unit of places, where samples get ranks.
    largest_rank: Option<f64>,
    per_radius: f64,
}

impl<'a> UniformGround<'a> {
    /// No samples yet, but what is given with a clearance of its own: of the mesh, or of the part of it in a box.
    pub fn new(
        mesh: &'a Mesh,
        space: Space,
        extent: Option<&Extent>,
        facing: Facing,
        obstacles: &'a Obstacles,
    ) -> Self {
        let cells = extent.map_or_else(Cells::anywhere, |extent| Cells::around(extent, &space));
        let (grid, per_radius) = (Grid::new(space, cells, facing), 1.0 / space.radius());
        Self { mesh, grid, accepted: Vec::new(), darts: 0, facing, obstacles, largest_rank: None, per_radius }
    }

    /// The ground, with ranks for the samples that the fill adds: up to the largest, which is between the radius and
    /// twice as much.
    pub fn ranked(self, largest: Option<f64>) -> Self {
        Self { largest_rank: largest.map(|rank| rank * f64::from(self.grid.space.scale())), ..self }
    }

    /// The rank of a sample that is added now: its distance to the nearest one, but no more than the largest rank. It is
    /// no longer than the distance in whatever order a caller evaluates that.
    fn rank(&self, sample: &Sample) -> f32 {
        let Some(largest) = self.largest_rank else { return f32::INFINITY };
        let (place, normal) = (self.grid.space.place(sample.position), self.normal(sample.triangle));
        let distance = self.grid.distance(place, normal, largest) * (1.0 - 1e-14);
        rounded_down(distance.max(self.grid.space.radius()) / f64::from(self.grid.space.scale()))
    }

    /// The radius, in the unit of the mesh.
    pub fn radius(&self) -> f64 {
        self.grid.space.radius() / f64::from(self.grid.space.scale())
    }

    /// Tells the ground of a sample that is there already.
    pub fn add(&mut self, sample: &Sample) {
        self.grid.add(self.grid.space.place(sample.position), self.normal(sample.triangle));
    }

    /// Tells the ground of a given sample that has the clearance of a sample of its own.
    pub fn add_given(&mut self, position: [f32; 3]) {
        self.grid.add(self.grid.space.place(position), NO_NORMAL);
    }

    /// Whether a dart conflicts with a sample.
    pub fn rejects(&self, dart: &Sample) -> bool {
        self.grid.rejects(self.grid.space.place(dart.position), self.normal(dart.triangle))
            || self.obstacles.reject(dart.position)
    }

    /// Which of a group of triangles no single sample certainly covers: a bit for each.
    pub fn open_triangles(&self, group: &mut Group, count: usize, triangle: impl Fn(usize) -> u32) -> u64 {
        let open = self.grid.open_triangles(group, count, |lane| self.normal(triangle(lane)));
        self.obstacles.open_triangles(open, |lane| self.mesh.corners(triangle(lane)))
    }

    /// The normal of a triangle, where normals matter.
    #[inline(always)]
    fn normal(&self, triangle: u32) -> [f32; 3] {
        self.facing.normal(self.mesh, triangle)
    }

    /// Which of some sixteenths of a fragment, given by its triangle and its corners in the unit of the space, no single
    /// sample certainly covers.
    #[inline(always)]
    fn uncovered(&self, triangle: u32, corners: &[DVec3; 3], longest: f64, open: u16) -> u16 {
        let open = self.grid.open_sixteenths(corners, longest, self.normal(triangle), open);
        let scale = f64::from(self.grid.space.scale());
        self.obstacles.open_sixteenths(corners.map(|corner| corner / scale), open)
    }

    /// A whole triangle, and whether it has any area.
    pub fn whole(&self, triangle: u32) -> (Whole, bool) {
        let corners = self.mesh.exact_corners(triangle).map(|corner| self.grid.space.scaled(corner));
        let (area, longest) = self.size(&corners);
        (
            Whole { triangle, area: area as f32, longest: longest as f32, local: () },
            self.mesh.triangle_area(triangle) > 0.0,
        )
    }

    /// Where the corners of a fragment are, in the unit of the space.
    fn corners(&self, fragment: &Fragment) -> [DVec3; 3] {
        let [a, b, c] = self.mesh.exact_corners(fragment.triangle).map(|corner| self.grid.space.scaled(corner));
        let at = |[u, v]: [f64; 2]| (1.0 - u - v) * a + u * b + v * c;
        let [p, q, r] = fragment.corners;
        [at(p), at(q), at(r)]
    }

    /// Adds what is open of the parts of a fragment, `count` along each edge, in patches.
    pub fn look_at_parts(&self, fragment: &Fragment, count: u32, grown: &mut Vec<Patch>) {
        let (corners, scale) = (self.corners(fragment), 1.0 / f64::from(count));
        let (area, longest) = self.size(&corners);
        let size = ((area * scale * scale) as f32, (longest * scale) as f32);
        let whole = Fragment::whole(fragment.triangle);
        let open = |part: Fragment| self.look_at_part(fragment, &corners, part.corners, size);
        grown.extend(whole.parts(count).filter_map(open));
    }

    /// A part of a fragment as a patch, unless its sixteenths are covered: the fragment and its corners, those of the
    /// part in it, area and longest edge of the part.
    #[inline]
    fn look_at_part(
        &self,
        fragment: &Fragment,
        [a, b, c]: &[DVec3; 3],
        part: [[f64; 2]; 3],
        (area, longest): (f32, f32),
    ) -> Option<Patch> {
        let (e, f) = (b - a, c - a);
        let [p, q, r] = part;
        let at = |[s, t]: [f64; 2]| a + (s * e + t * f);
        let longest_edge = f64::from(longest) / self.per_radius;
        let open = self.uncovered(fragment.triangle, &[at(p), at(q), at(r)], longest_edge, u16::MAX);
        let part = || Fragment { corners: [fragment.at(p), fragment.at(q), fragment.at(r)], ..*fragment };
        (open != 0).then(|| Patch { fragment: part(), open, area, longest, local: () })
    }

    /// Area and longest edge.
    fn size(&self, &[a, b, c]: &[DVec3; 3]) -> (f64, f64) {
        let (e, f) = ((b - a) * self.per_radius, (c - a) * self.per_radius);
        let longest = e.length_squared().max(f.length_squared()).max((f - e).length_squared());
        (0.5 * e.cross(f).length(), longest.sqrt())
    }
}

impl Ground for UniformGround<'_> {
    type Local = ();
    type Dart = Sample;

    fn finest(&self, (): ()) -> f32 {
        (f64::from(self.grid.space.scale()) * self.mesh.float_spacing() * self.per_radius) as f32
    }

    fn look(&self, fragment: &Fragment, (): ()) -> Option<Patch> {
        let corners = self.corners(fragment);
        let (area, longest) = self.size(&corners);
        let open = self.uncovered(fragment.triangle, &corners, longest / self.per_radius, u16::MAX);
        let patch = Patch { fragment: *fragment, open, area: area as f32, longest: longest as f32, local: () };
        (open != 0).then_some(patch)
    }

    fn look_closer(&self, patch: &Patch, grown: &mut Vec<Patch>) {
        let (corners, size) = (self.corners(&patch.fragment), (patch.area / 16.0, patch.longest / 4.0));
        let parts = (0..16).filter(|part| patch.open >> part & 1 == 1);
        grown.extend(parts.filter_map(|part| {
            let part = SIXTEENTHS[part].map(|corner| corner.map(|quarters| 0.25 * quarters));
            self.look_at_part(&patch.fragment, &corners, part, size)
        }));
    }

    fn open_sixteenths(&self, patch: &Patch) -> u16 {
        let corners = self.corners(&patch.fragment);
        self.uncovered(patch.fragment.triangle, &corners, f64::from(patch.longest) / self.per_radius, patch.open)
    }

    fn open_wholes(&self, wholes: &[Whole]) -> u64 {
        debug_assert!(wholes.len() <= GROUP);
        let mut group = Group::EMPTY;
        for (lane, whole) in wholes.iter().enumerate() {
            group.triangles[lane] = self.grid.space.places(self.mesh.corners(whole.triangle));
        }
        self.open_triangles(&mut group, wholes.len(), |lane| wholes[lane].triangle)
    }

    fn mesh(&self) -> &Mesh {
        self.mesh
    }

    fn dart(&self, point: Point, corners: &[[f32; 3]; 3]) -> Sample {
        Sample::on(corners, point.triangle, round_barycentrics(point.barycentrics))
    }

    fn throw(&mut self, sample: Sample) {
        self.darts += 1;
        if !self.rejects(&sample) {
            let rank = self.rank(&sample);
            self.add(&sample);
            self.accepted.push(Sample { rank, ..sample });
        }
    }
}
