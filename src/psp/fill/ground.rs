//! What a fill rains on: a surface of which samples cover a part.
//!
//! The rounds (`rounds.rs`) know it by this trait only, so that they serve whatever a sample covers. A ground looks at
//! fragments and takes darts. Lengths are in radii, areas in squared radii: those of the place, where the radius
//! varies.

use glam::DVec3;

use crate::math::rounded_down;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::facing::{Facing, NO_NORMAL};
use crate::psp::fill::balls::Ball;
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

    /// Leaves out darts, given by points and the corners of their triangles, that certainly conflict with a sample: most
    /// of them, at a fraction of the price of [`Ground::throw`].
    fn leave_out(&mut self, _points: &mut Vec<Point<Self::Local>>, _corners: &mut Vec<[[f32; 3]; 3]>) {}

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
    /// The spacing of floats at the mesh's largest coordinate, in radii.
    float_spacing: f32,
    /// A dart whose place in floats has a squared distance from a sample up to here certainly conflicts with it.
    surely_conflicting: f32,
}

/// By how many float spacings at the largest coordinate the place of a dart computed in floats is off at most: 46 along
/// each axis, by the rounding of barycentrics, of edges, which are up to twice as long, and of their sums.
const PLACE_ERROR: f64 = 80.0;

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
        let float_spacing = f64::from(space.scale()) * mesh.float_spacing();
        let within = (space.radius() - PLACE_ERROR * float_spacing).max(0.0);
        Self {
            mesh,
            grid,
            accepted: Vec::new(),
            darts: 0,
            facing,
            obstacles,
            largest_rank: None,
            per_radius,
            float_spacing: (float_spacing * per_radius) as f32,
            surely_conflicting: Space::within(within * within),
        }
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

    /// Whether one sample certainly covers a ball, whatever lies in it.
    pub fn covers(&self, ball: &Ball) -> bool {
        let within = self.grid.space.radius() - f64::from(ball.radius) * f64::from(self.grid.space.scale());
        let (place, limit) = (self.grid.space.place(ball.centre), Space::within(within * within));
        within > 0.0 && !self.facing.asks_normals() && self.grid.is_within(place, limit)
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
        // Only of slivers it depends on the rounding of lengths in radii.
        let has_area = area > 1e-9 * longest * longest || self.mesh.triangle_area(triangle) > 0.0;
        (Whole { triangle, area: area as f32, longest: longest as f32, local: () }, has_area)
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
        let ([p, q, r], e, f) = (part, b - a, c - a);
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
        self.float_spacing
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

    fn leave_out(&mut self, points: &mut Vec<Point>, corners: &mut Vec<[[f32; 3]; 3]>) {
        if self.facing.asks_normals() {
            return;
        }
        let mut kept = 0;
        for index in 0..points.len() {
            let [a, b, c] = self.grid.space.places(corners[index]);
            let [u, v] = points[index].barycentrics.map(|x| x as f32);
            let place = [0, 1, 2].map(|axis| a[axis] + (u * (b[axis] - a[axis]) + v * (c[axis] - a[axis])));
            // Without a branch, which would be mispredicted.
            points[kept] = points[index];
            corners[kept] = corners[index];
            kept += usize::from(!self.grid.is_seen_within(place, self.surely_conflicting));
        }
        self.darts += (points.len() - kept) as u64;
        points.truncate(kept);
        corners.truncate(kept);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::Given;
    use crate::mesh::exact;
    use crate::psp::fill::darts::random_point;
    use crate::psp::given::GivenSamples;
    use crate::psp::samples::SampleSet;
    use crate::rng::{Draw, Rng};

    /// Small and large triangles, at the origin and far from it, up to radii of 64 float spacings.
    #[test]
    fn only_darts_that_conflict_are_left_out() {
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let mut counts = [0; 2];
        for (offset, size, radius) in [
            (0.0, 1.0, 0.3),
            (0.0, 1.0, 0.02),
            (1.0, 1e-3, 1e-3),
            (1.0, 1.0, 1e-4),
            (1.0, 1.0, 8e-6),
            (-300.0, 5.0, 2e-2),
        ] {
            let mut corner = || [(); 3].map(|()| (offset + size * rng.unit()) as f32);
            let corners: Vec<_> = (0..60).map(|_| corner()).collect();
            let triangles = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            let mesh = Mesh::new(corners, triangles).unwrap();
            let set = SampleSet::new(&mesh, radius);
            let given = GivenSamples::new(&mesh, Given::default(), radius, &set, Facing::ANY).unwrap();
            let space = Space::new(&mesh, radius);
            let mut ground = UniformGround::new(&mesh, space, None, Facing::ANY, &given.obstacles);
            for _ in 0..200 {
                // Darts around one place, so that there are conflicts however small the radius is.
                let (triangle, [u, v]) = (rng.below(20) as u32, random_point(&mut rng));
                let near = |x: f64, rng: &mut Rng| (x + 2.0 * radius / size * (rng.unit() - 0.5)).clamp(0.0, 0.5);
                let point = |rng: &mut Rng| Point { triangle, barycentrics: [near(u, rng), near(v, rng)], local: () };
                let points: Vec<_> = (0..32).map(|_| point(&mut rng)).collect();
                let mut left = points.clone();
                let mut corners = points.iter().map(|point| mesh.corners(point.triangle)).collect();
                let before = ground.darts;
                ground.leave_out(&mut left, &mut corners);
                assert_eq!((left.len(), (ground.darts - before) as usize), (corners.len(), points.len() - left.len()));
                let mut left = left.iter().map(|point| point.barycentrics).peekable();
                for &point in &points {
                    let dart = ground.dart_at(point);
                    let conflicts = |other: &Sample| exact(other.position).distance(exact(dart.position)) < radius;
                    if left.next_if_eq(&point.barycentrics).is_none() {
                        assert!(ground.accepted.iter().any(conflicts), "{offset} {size} {radius}");
                        counts[0] += 1;
                    }
                    counts[1] += 1;
                }
                ground.throw(ground.dart_at(points[0]));
                ground.throw(ground.dart_at(points[31]));
            }
        }
        assert!(4 * counts[0] > counts[1], "most conflicts are seen: {counts:?}");
    }
}
