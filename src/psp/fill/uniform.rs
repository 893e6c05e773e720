//! A surface whose samples all have one radius.

use glam::DVec3;

use crate::error::Result;
use crate::job::Job;
use crate::math::rounded_down;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::fill::blocks::Block;
use crate::psp::fill::cells::Cells;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::grid::Grid;
use crate::psp::fill::measures::{Ball, Measures, Triangles};
use crate::psp::fill::page::{BATCH, Batch};
use crate::psp::fill::rounds::{Ground, Layer, Open, PATCH, Patch, Point, WHOLE, WholeTriangle};
use crate::psp::fill::space::Space;
use crate::psp::fill::{Alike, FillOptions, Filled, ONE_PIECE, Site, fill};
use crate::psp::fragment::{Facing, Fragment, NO_NORMAL, SIXTEENTHS, slice};
use crate::psp::given::{GivenSamples, Obstacles};
use crate::psp::set::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// A surface to be filled with samples of one radius, and the given samples around which it is filled.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    pub mesh: &'a Mesh,
    pub measures: &'a Measures,
    pub given: &'a GivenSamples,
    pub facing: Facing,
}

impl Surface<'_> {
    /// Adds samples until the set is maximal.
    pub fn fill(&self, job: &Job, samples: &mut SampleSet, options: FillOptions) -> Result<Filled> {
        let in_blocks = self.measures.expected_samples(self.mesh, samples.radius()) > ONE_PIECE;
        self.fill_either_way(job, samples, in_blocks, options)
    }

    /// Fills cube by cube or in one piece.
    pub fn fill_either_way(
        &self,
        job: &Job,
        samples: &mut SampleSet,
        in_blocks: bool,
        options: FillOptions,
    ) -> Result<Filled> {
        let is_empty = samples.len() == 0 && self.given.is_empty();
        let site = Uniform { surface: *self, radius: samples.radius(), largest_rank: options.largest_rank };
        let filled = fill(job, &site, samples, in_blocks, options)?;
        Ok(if is_empty { Filled { open_area: self.mesh.area(), ..filled } } else { filled })
    }
}

/// A surface to be filled at a radius.
pub struct Uniform<'a> {
    pub surface: Surface<'a>,
    pub radius: f64,
    /// The largest rank of the samples that are added, if they get ranks.
    pub largest_rank: Option<f64>,
}

impl Uniform<'_> {
    fn empty_ground(&self, extent: Option<&Extent>) -> UniformGround<'_> {
        let Surface { mesh, given, facing, .. } = self.surface;
        let ground = UniformGround::new(mesh, Space::new(mesh, self.radius), extent, facing, &given.obstacles);
        ground.ranked(self.largest_rank)
    }
}

impl Alike for Uniform<'_> {}

impl Site for Uniform<'_> {
    type Ground<'b>
        = UniformGround<'b>
    where
        Self: 'b;
    const NEIGHBOURS_COUNT: bool = false;

    fn mesh(&self) -> &Mesh {
        self.surface.mesh
    }

    fn measures(&self) -> &Measures {
        self.surface.measures
    }

    fn is_bare(&self) -> bool {
        self.surface.given.is_empty()
    }

    fn chunk_rng(&self, seed: u64, chunk: usize, (): ()) -> Rng {
        Rng::at(seed, Draw::Fill, &[chunk as u64])
    }

    fn reach(&self) -> f64 {
        self.largest_rank.unwrap_or(self.radius)
    }

    fn ground(&self, block: Option<&Block>) -> UniformGround<'_> {
        let (mut ground, given) = (self.empty_ground(block.map(|block| &block.extent)), self.surface.given);
        match block {
            None => given.alike().iter().for_each(|&position| ground.add_given(position)),
            Some(Block { cube, extent, .. }) => {
                let near = given.alike_around(*cube).filter(|&position| extent.is_in_reach(position, self.reach()));
                near.for_each(|position| ground.add_given(position));
            }
        }
        ground
    }

    fn add(ground: &mut UniformGround, sample: &Sample) {
        ground.add(sample);
    }

    fn layer<'g>(ground: &'g UniformGround<'_>, (): ()) -> &'g UniformGround<'g> {
        ground
    }

    fn narrowed(_: &UniformGround, (): (), open: Open) -> Open {
        open
    }
}

/// A surface whose samples all have one radius.
pub struct UniformGround<'a> {
    mesh: &'a Mesh,
    grid: Grid,
    /// The samples that the fill has added.
    accepted: Vec<Sample>,
    /// The number of darts thrown.
    darts: u64,
    facing: Facing,
    obstacles: &'a Obstacles,
    /// The largest rank, in the unit of places, where samples get ranks.
    largest_rank: Option<f64>,
    per_radius: f64,
    /// The spacing of floats at the mesh's largest coordinate, in radii.
    float_spacing: f32,
    /// The squared distance from a sample up to which a dart, at its place in floats, certainly conflicts with it.
    surely_conflicting: f32,
}

/// The largest error of the place of a dart computed in floats, in float spacings at the largest coordinate: 46 along
/// each axis, by the rounding of barycentrics, of edges, which are up to twice as long, and of their sums.
const PLACE_ERROR: f64 = 80.0;

impl<'a> UniformGround<'a> {
    /// A ground without samples except those given with a clearance of their own, of the mesh or of the part of it in a
    /// box.
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

    /// The ground with ranks for the samples that the fill adds, up to the largest, which is between the radius and
    /// twice that.
    pub fn ranked(self, largest: Option<f64>) -> Self {
        Self { largest_rank: largest.map(|rank| rank * f64::from(self.grid.space.scale())), ..self }
    }

    /// Adds a given sample that has the clearance of a sample of the set.
    pub fn add_given(&mut self, position: [f32; 3]) {
        self.grid.add(self.grid.space.place(position), NO_NORMAL);
    }

    /// True if one sample certainly covers a ball, and so all that lies in it.
    pub fn covers(&self, ball: &Ball) -> bool {
        let within = self.grid.space.radius() - f64::from(ball.radius) * f64::from(self.grid.space.scale());
        let (place, limit) = (self.grid.space.place(ball.centre), Space::within(within * within));
        within > 0.0 && !self.facing.asks_normals() && self.grid.is_within(place, limit)
    }

    /// The triangles of a batch that no single sample certainly covers: a bit for each.
    fn open_of_batch(&self, batch: &mut Batch, count: usize, triangle: impl Fn(usize) -> u32) -> u64 {
        let open = self.grid.open_triangles(batch, count, |lane| self.normal(triangle(lane)));
        self.obstacles.open_triangles(open, |lane| self.mesh.corners(triangle(lane)))
    }

    /// The normal of a triangle, where normals matter.
    #[inline(always)]
    fn normal(&self, triangle: u32) -> [f32; 3] {
        self.facing.normal(self.mesh, triangle)
    }

    /// Those of some sixteenths of a fragment, given by its triangle and its corners in the unit of the space, that no
    /// single sample certainly covers.
    #[inline(always)]
    fn uncovered(&self, triangle: u32, corners: &[DVec3; 3], longest: f64, open: u16) -> u16 {
        let open = self.grid.open_sixteenths(corners, longest, self.normal(triangle), open);
        let scale = f64::from(self.grid.space.scale());
        self.obstacles.open_sixteenths(corners.map(|corner| corner / scale), open)
    }

    /// A whole triangle, and whether it has any area.
    pub fn whole(&self, triangle: u32) -> (WholeTriangle, bool) {
        let corners = self.mesh.exact_corners(triangle).map(|corner| self.grid.space.scaled(corner));
        let (area, longest) = self.size(&corners);
        // Only for slivers this depends on the rounding of lengths in radii.
        let has_area = area > 1e-9 * longest * longest || self.mesh.triangle_area(triangle) > 0.0;
        (WholeTriangle { triangle, area: area as f32, longest: longest as f32, local: () }, has_area)
    }

    /// The corners of a fragment, in the unit of the space.
    fn corners(&self, fragment: &Fragment) -> [DVec3; 3] {
        let [a, b, c] = self.mesh.exact_corners(fragment.triangle).map(|corner| self.grid.space.scaled(corner));
        let at = |[u, v]: [f64; 2]| (1.0 - u - v) * a + u * b + v * c;
        let [p, q, r] = fragment.corners;
        [at(p), at(q), at(r)]
    }

    /// Adds the open ones of the parts of a fragment, `count` along each edge, as patches.
    fn open_parts_of(&self, fragment: &Fragment, count: u32, patches: &mut Vec<Patch>) {
        let (corners, scale) = (self.corners(fragment), 1.0 / f64::from(count));
        let (area, longest) = self.size(&corners);
        let size = ((area * scale * scale) as f32, (longest * scale) as f32);
        let whole = Fragment::whole(fragment.triangle);
        let open = |part: Fragment| self.patch_of_part(fragment, &corners, part.corners, size);
        patches.extend(whole.parts(count).filter_map(open));
    }

    /// A part of a fragment as a patch, unless its sixteenths are covered: the fragment and its corners, those of the
    /// part in it, area and longest edge of the part.
    #[inline]
    fn patch_of_part(
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

    /// The open parts of some triangles, by their indices.
    pub fn open_triangles(&self, triangles: Triangles, indices: impl Iterator<Item = usize>) -> Open {
        let (mut open, mut batch, mut numbers, space) = (Open::default(), Batch::EMPTY, [0; BATCH], self.grid.space);
        let mut count = 0;
        let mut test = |batch: &mut Batch, numbers: &[u32]| {
            let mut uncovered = self.open_of_batch(batch, numbers.len(), |lane| numbers[lane]);
            while uncovered != 0 {
                self.add_open(numbers[uncovered.trailing_zeros() as usize], &mut open);
                uncovered &= uncovered - 1;
            }
        };
        for index in indices {
            numbers[count] = triangles.at(index);
            batch.triangles[count] = space.places(self.mesh.corners(numbers[count]));
            count += 1;
            if count == BATCH {
                test(&mut batch, &numbers);
                count = 0;
            }
        }
        if count > 0 {
            test(&mut batch, &numbers[..count]);
        }
        open
    }

    /// Adds a triangle that is not covered: whole, if it is small and has any area, or in parts.
    fn add_open(&self, triangle: u32, open: &mut Open) {
        let (whole, has_area) = self.whole(triangle);
        if !has_area {
            return;
        }
        if whole.longest <= WHOLE {
            open.wholes.push(whole);
        } else if f64::from(whole.longest) < 0.999 * PATCH {
            // One patch, for which nothing has to be cut.
            open.patches.extend(self.patch(&Fragment::whole(triangle), ()));
        } else {
            let (mut slices, radius) = (Vec::new(), self.radius());
            slice(self.mesh, triangle, PATCH * radius, &mut slices);
            slices.iter().for_each(|slice| self.open_parts(slice, open));
        }
    }

    /// Adds the open parts of a fragment, in patches that are small enough.
    pub fn open_parts(&self, fragment: &Fragment, open: &mut Open) {
        let count = fragment.count_up_to(self.mesh, PATCH * self.radius());
        self.open_parts_of(fragment, count, &mut open.patches);
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
    type Sample = Sample;

    fn finest(&self, (): ()) -> f32 {
        self.float_spacing
    }

    fn patch(&self, fragment: &Fragment, (): ()) -> Option<Patch> {
        let corners = self.corners(fragment);
        let (area, longest) = self.size(&corners);
        let open = self.uncovered(fragment.triangle, &corners, longest / self.per_radius, u16::MAX);
        let patch = Patch { fragment: *fragment, open, area: area as f32, longest: longest as f32, local: () };
        (open != 0).then_some(patch)
    }

    fn subdivide(&self, patch: &Patch, patches: &mut Vec<Patch>) {
        let (corners, size) = (self.corners(&patch.fragment), (patch.area / 16.0, patch.longest / 4.0));
        let parts = (0..16).filter(|part| patch.open >> part & 1 == 1);
        patches.extend(parts.filter_map(|part| {
            let part = SIXTEENTHS[part].map(|corner| corner.map(|quarters| 0.25 * quarters));
            self.patch_of_part(&patch.fragment, &corners, part, size)
        }));
    }

    fn open_sixteenths(&self, patch: &Patch) -> u16 {
        let corners = self.corners(&patch.fragment);
        self.uncovered(patch.fragment.triangle, &corners, f64::from(patch.longest) / self.per_radius, patch.open)
    }

    fn open_wholes(&self, wholes: &[WholeTriangle]) -> u64 {
        debug_assert!(wholes.len() <= BATCH);
        let mut batch = Batch::EMPTY;
        for (lane, whole) in wholes.iter().enumerate() {
            batch.triangles[lane] = self.grid.space.places(self.mesh.corners(whole.triangle));
        }
        self.open_of_batch(&mut batch, wholes.len(), |lane| wholes[lane].triangle)
    }

    fn mesh(&self) -> &Mesh {
        self.mesh
    }

    fn dart(&self, point: Point, corners: &[[f32; 3]; 3]) -> Sample {
        Sample::on(corners, point.triangle, round_barycentrics(point.barycentrics))
    }

    fn is_open(&self, point: Point) -> bool {
        !self.rejects(&self.dart_at(point))
    }

    fn drop_conflicting(&mut self, points: &mut Vec<Point>, corners: &mut Vec<[[f32; 3]; 3]>) {
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
            let rank = rounded_down(self.rank(&sample));
            self.add(&sample);
            self.accepted.push(Sample { rank, ..sample });
        }
    }

    fn into_accepted(self) -> (Vec<Sample>, u64) {
        (self.accepted, self.darts)
    }
}

impl Layer for UniformGround<'_> {
    /// The radius, in the unit of the mesh.
    fn radius(&self) -> f64 {
        self.grid.space.radius() / f64::from(self.grid.space.scale())
    }

    fn add(&mut self, sample: &Sample) {
        self.grid.add(self.grid.space.place(sample.position), self.normal(sample.triangle));
    }

    fn rejects(&self, sample: &Sample) -> bool {
        self.grid.rejects(self.grid.space.place(sample.position), self.normal(sample.triangle))
            || self.obstacles.reject(sample.position)
    }

    /// The distance to the nearest sample, but no more than the largest rank. It does not exceed the distance in
    /// whatever order a caller evaluates that.
    fn rank(&self, sample: &Sample) -> f64 {
        let Some(largest) = self.largest_rank else { return f64::INFINITY };
        let (place, normal) = (self.grid.space.place(sample.position), self.normal(sample.triangle));
        let distance = self.grid.distance(place, normal, largest) * (1.0 - 1e-14);
        distance.max(self.grid.space.radius()) / f64::from(self.grid.space.scale())
    }

    fn least(&self, dart: &Sample) -> Sample {
        *dart
    }

    fn settled(&self, dart: &Sample, rejects: impl Fn(&Sample) -> bool) -> Option<Sample> {
        (!rejects(dart)).then_some(*dart)
    }

    /// No ball contains a part longer than its diameter, and the longest edge of a sixteenth is a quarter.
    fn may_cover(&self, longest: f32) -> bool {
        longest <= 8.01
    }
}

const _: () = assert!(BATCH == 64, "a bit for each triangle");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::Given;
    use crate::mesh::exact;
    use crate::psp::fill::darts::random_point;
    use crate::psp::given::GivenSamples;
    use crate::psp::set::SampleSet;
    use crate::rng::{Draw, Rng};

    /// Small and large triangles, at the origin and far from it, down to radii of 64 float spacings.
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
                // Darts around one place, so that there are conflicts for any radius, however small.
                let (triangle, [u, v]) = (rng.below(20) as u32, random_point(&mut rng));
                let near = |x: f64, rng: &mut Rng| (x + 2.0 * radius / size * (rng.unit() - 0.5)).clamp(0.0, 0.5);
                let point = |rng: &mut Rng| Point { triangle, barycentrics: [near(u, rng), near(v, rng)], local: () };
                let points: Vec<_> = (0..32).map(|_| point(&mut rng)).collect();
                let mut left = points.clone();
                let mut corners = points.iter().map(|point| mesh.corners(point.triangle)).collect();
                let before = ground.darts;
                ground.drop_conflicting(&mut left, &mut corners);
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
