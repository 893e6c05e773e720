//! Pre-existing samples, which are never returned.
//!
//! Samples whose clearance is the radius of the set act like its own samples. They are put into the same grids, cube by
//! cube, which is as fast. All others are *obstacles*: balls that keep darts out and cover the surface in them. Their
//! effect does not depend on the radius of a set. So one structure serves all cubes, octaves and threads of a call,
//! which only read it.
//!
//! For obstacles everything is decided in `f64`: a ball can be as large as the mesh and end just beyond a part of it
//! that is as large. In floats this would not be found covered, however finely it is cut.

use std::collections::{BTreeMap, HashMap};

use glam::DVec3;

use crate::error::{Error, Result};
use crate::given::{Given, WITH_A_COUNT};
use crate::index::Binned;
use crate::math::scalbn;
use crate::memory;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::cells::{Cells, each_cell};
use crate::psp::fill::grid::{Grid, any_cell};
use crate::psp::fill::space::{Place, Space, key};
use crate::psp::fill::table::Table;
use crate::psp::fragment::{CORNERS, Cover, Facing, NO_NORMAL};
use crate::psp::set::{Cube, SampleSet};

/// Given samples around which a set of one radius grows.
pub struct GivenSamples {
    /// The numbers of the cubes that have given samples of the same radius.
    cubes: HashMap<Cube, usize>,
    /// The positions of the given samples of the same radius, by these numbers.
    alike: Binned<[f32; 3]>,
    space: Space,
    /// All other given samples.
    pub obstacles: Obstacles,
}

/// Given samples in and around a cube.
pub struct NearGiven<'a> {
    /// The samples with the radius of the set.
    grid: Option<Grid>,
    obstacles: &'a Obstacles,
}

impl GivenSamples {
    /// The caller's given samples that can matter to a set, in which samples may ignore each other by their facing.
    pub fn new(mesh: &Mesh, given: Given<3>, radius: f64, set: &SampleSet, facing: Facing) -> Result<Self> {
        check(given)?;
        let (low, high) = mesh.bounds();
        // The grids of a set replace large radii by smaller ones, since they hold samples of the mesh only. And they
        // compare samples by their normals, where these matter.
        let are_alike = radius <= exact(low).distance(exact(high)) && !facing.asks_normals();
        let is_alike = |clearance: f64| are_alike && clearance == radius;
        let (mut cubes, mut alike) = (HashMap::new(), Vec::new());
        let like_a_sample = |&(_, clearance): &([f32; 3], f64)| is_alike(clearance);
        for (position, clearance) in balls(given, radius).filter(like_a_sample) {
            if touches(mesh, position, clearance) {
                let next = cubes.len();
                alike.push((*cubes.entry(set.cube(position.map(f64::from))).or_insert(next), position));
            }
        }
        let alike = Binned::new(cubes.len(), alike.iter().copied());
        let obstacles = Obstacles::new(mesh, balls(given, radius).filter(|ball| !like_a_sample(ball)));
        Ok(Self { cubes, alike, space: Space::new(mesh, set.radius()), obstacles })
    }

    /// The caller's given samples that can matter to a set that is made level by level, for any radius of a level;
    /// `radius` is that of the whole set, if it is known.
    pub fn of_levels(mesh: &Mesh, given: Given<3>, radius: Option<f64>) -> Result<Self> {
        check(given)?;
        if radius.is_none() {
            given.require_clearances(WITH_A_COUNT)?;
        }
        let obstacles = Obstacles::new(mesh, balls(given, radius.unwrap_or(0.0)));
        Ok(Self { obstacles, ..Self::none(mesh) })
    }

    /// No given samples.
    pub fn none(mesh: &Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let space = Space::new(mesh, exact(low).distance(exact(high)));
        let (alike, obstacles) = (Binned::new(0, std::iter::empty()), Obstacles::default());
        Self { cubes: HashMap::new(), alike, space, obstacles }
    }

    /// True if no given samples matter.
    pub fn is_empty(&self) -> bool {
        self.alike.items().is_empty() && self.obstacles.is_empty()
    }

    /// The positions of all that have the radius of the set.
    pub fn alike(&self) -> &[[f32; 3]] {
        self.alike.items()
    }

    /// The given samples that keep candidates out of a cube.
    pub fn near(&self, cube: Cube) -> NearGiven<'_> {
        let mut alike = self.alike_around(cube).peekable();
        let grid = alike.peek().is_some().then(|| {
            let mut grid = Grid::new(self.space, Cells::anywhere(), Facing::ANY);
            alike.for_each(|position| grid.add(self.space.place(position), NO_NORMAL));
            grid
        });
        NearGiven { grid, obstacles: &self.obstacles }
    }

    /// The given samples of the same radius in a cube and in the cubes that touch it.
    pub fn alike_around(&self, cube: Cube) -> impl Iterator<Item = [f32; 3]> {
        let numbers = cube.around().into_iter().filter_map(|cube| self.cubes.get(&cube));
        numbers.flat_map(|&number| self.alike.bin(number)).copied()
    }
}

impl NearGiven<'_> {
    /// True if a position in the cube is too close to a given sample.
    pub fn reject(&self, position: [f32; 3]) -> bool {
        let rejects = |grid: &Grid| grid.rejects(grid.space.place(position), NO_NORMAL);
        self.grid.as_ref().is_some_and(rejects) || self.obstacles.reject(position)
    }
}

/// The position and the clearance of each.
pub(super) fn balls<'a>(given: Given<'a, 3>, radius: f64) -> impl Iterator<Item = ([f32; 3], f64)> + 'a {
    (0..).zip(given.positions).map(move |(index, &position)| (position, given.clearance(index, radius)))
}

/// The largest number that can be indexed, as each is listed up to eight times.
const MOST: usize = (u32::MAX / 8) as usize;

/// Peak memory for given samples, approximately: of those that may be obstacles more.
pub fn bytes(given: Given<3>) -> f64 {
    given.positions.len() as f64 * if given.clearances.is_none() { 60.0 } else { 300.0 }
}

fn check(given: Given<3>) -> Result<()> {
    if given.positions.len() > MOST {
        return Err(Error::too_large("given_count", format!("{}; the limit is {MOST}", given.positions.len())));
    }
    let count = given.positions.len();
    memory::require(bytes(given), "given_count", &format!("{count} given samples"))?;
    given.check()
}

/// The exponent of the power of two by which the cells of successive tiers differ; clearances of one tier differ by
/// less.
const OCTAVES: i32 = 2;
/// The largest average number of obstacles in a cell. If there are fewer, two tiers are joined, and cells are larger.
/// The lookup of a cell takes the time of some tests.
const CROWD: usize = 8;

/// The clearance in float spacings below which balls are listed with those of this size: they cover nothing that
/// counts.
const FINEST: f64 = 64.0;

/// A ball that keeps darts out and covers the surface in it.
#[derive(Clone, Copy, Debug, Default)]
struct Obstacle {
    centre: DVec3,
    /// The clearance. It is larger by 1e-14, dozens of units in the last place, so that it is kept in whatever order a
    /// caller evaluates distances; and far below the distance of any two floats, but above 0, where it is tiny.
    reach: f64,
}

/// Obstacles that can touch a mesh.
#[derive(Default)]
pub struct Obstacles {
    /// By clearance, the largest first.
    tiers: Vec<Tier>,
    /// The obstacles with larger clearances than the mesh's box: any cell would hold them all.
    wide: Vec<Obstacle>,
}

/// True if the ball around a position touches the box of a mesh.
fn touches(mesh: &Mesh, position: [f32; 3], clearance: f64) -> bool {
    let (low, high) = mesh.bounds();
    Obstacle::new(position, clearance).touches([exact(low), exact(high)])
}

/// The bounds of a fragment, which exclude most obstacles that cover no part of it.
struct FragmentBounds {
    centre: DVec3,
    /// The largest distance of its points from the centre.
    extent: f64,
    /// The square of the length of the longest edge.
    longest2: f64,
}

/// The corners of the sixteenths of a fragment, one axis after the other.
type Points = [[f64; 16]; 3];

impl Obstacle {
    fn new(position: [f32; 3], clearance: f64) -> Self {
        Self { centre: exact(position), reach: clearance.max(1e-60) * (1.0 + 1e-14) }
    }

    /// True if the ball touches a box.
    fn touches(&self, [low, high]: [DVec3; 2]) -> bool {
        self.holds(self.centre.clamp(low, high))
    }

    /// True if a point is in the ball: in `f64`, without tolerance.
    #[inline(always)]
    fn holds(&self, point: DVec3) -> bool {
        self.centre.distance_squared(point) < self.reach * self.reach
    }

    /// True if the ball can hold a sixteenth of a fragment.
    #[inline(always)]
    fn may_cover(&self, outline: &FragmentBounds) -> bool {
        let (reach2, most) = (self.reach * self.reach, self.reach + outline.extent);
        // No ball contains a part longer than its diameter, and the longest edge of a sixteenth is a quarter.
        outline.longest2 <= 64.0 * reach2 && self.centre.distance_squared(outline.centre) < most * most
    }

    /// Adds the sixteenths of a fragment that are in the ball.
    fn cover(&self, [xs, ys, zs]: &Points, cover: &mut Cover) {
        let (squared, mut inside) = (self.reach * self.reach, 0);
        for lane in 0..16 {
            let [x, y, z] = [xs[lane] - self.centre.x, ys[lane] - self.centre.y, zs[lane] - self.centre.z];
            inside |= u16::from(x * x + y * y + z * z < squared) << lane;
        }
        cover.add(inside);
    }
}

impl Obstacles {
    /// The caller's given samples, which have clearances.
    pub fn of(mesh: &Mesh, given: Given<3>) -> Result<Self> {
        check(given)?;
        Ok(Self::new(mesh, balls(given, 0.0)))
    }

    /// Given samples by position and clearance. Those whose balls do not touch the mesh's box are left out.
    fn new(mesh: &Mesh, given: impl Iterator<Item = ([f32; 3], f64)>) -> Self {
        let (low, high) = mesh.bounds();
        let bounds = [exact(low), exact(high)];
        let (diagonal, finest) = (bounds[0].distance(bounds[1]), FINEST * mesh.float_spacing());
        let (mut tiers, mut wide) = (BTreeMap::<i32, Vec<Obstacle>>::new(), Vec::new());
        for (position, clearance) in given.filter(|given| given.1 > 0.0) {
            let obstacle = Obstacle::new(position, clearance);
            if !obstacle.touches(bounds) {
            } else if clearance > diagonal {
                wide.push(obstacle);
            } else {
                let octave = (clearance.max(finest).to_bits() >> 52) as i32 - 1023;
                tiers.entry(octave.div_euclid(OCTAVES)).or_default().push(obstacle);
            }
        }
        Self { tiers: tiers_of(mesh, tiers), wide }
    }

    /// True if there are no obstacles.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.tiers.is_empty() && self.wide.is_empty()
    }

    /// The number of obstacles, each counted as often as it is listed.
    pub fn listed(&self) -> usize {
        self.wide.len() + self.tiers.iter().map(Tier::listed).sum::<usize>()
    }

    /// True if a position is nearer to an obstacle than its clearance: in `f64`, without tolerance.
    #[inline]
    pub fn reject(&self, position: [f32; 3]) -> bool {
        if self.is_empty() {
            return false;
        }
        let point = exact(position);
        let holds = |obstacle: &Obstacle| obstacle.holds(point);
        self.wide.iter().any(holds) || self.tiers.iter().any(|tier| tier.at(position).iter().any(holds))
    }

    /// The open triangles of a group that no obstacle covers by itself: a bit for each.
    #[inline]
    pub fn open_triangles(&self, mut open: u64, corners: impl Fn(usize) -> [[f32; 3]; 3]) -> u64 {
        if self.is_empty() {
            return open;
        }
        let mut rest = open;
        while rest != 0 {
            let lane = rest.trailing_zeros();
            if self.cover(corners(lane as usize)) {
                open &= !(1 << lane);
            }
            rest &= rest - 1;
        }
        open
    }

    /// True if one obstacle covers a triangle.
    fn cover(&self, corners: [[f32; 3]; 3]) -> bool {
        let [a, b, c] = corners.map(exact);
        let longest2 = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        let holds = |obstacle: &Obstacle| obstacle.holds(a) && obstacle.holds(b) && obstacle.holds(c);
        self.wide.iter().any(holds)
            || self.tiers.iter().any(|tier| {
                // No ball contains a triangle longer than its diameter.
                longest2 <= 4.0 * tier.end * tier.end && tier.at(corners[0]).iter().any(holds)
            })
    }

    /// The open sixteenths of a fragment, given by its corners, that no obstacle covers by itself.
    #[inline]
    pub fn open_sixteenths(&self, corners: [DVec3; 3], open: u16) -> u16 {
        if open == 0 || self.is_empty() { open } else { self.uncovered(corners, open) }
    }

    fn uncovered(&self, corners: [DVec3; 3], open: u16) -> u16 {
        let (outline, mut points, mut cover) = (FragmentBounds::of(corners), None, Cover::default());
        let mut is_covered_with = |obstacles: &[Obstacle]| {
            for obstacle in obstacles.iter().filter(|obstacle| obstacle.may_cover(&outline)) {
                obstacle.cover(points.get_or_insert_with(|| points_of(corners)), &mut cover);
            }
            open & !cover.sixteenths() == 0
        };
        let _ = is_covered_with(&self.wide)
            || self.tiers.iter().any(|tier| {
                outline.longest2 <= 64.0 * tier.end * tier.end && tier.any_cell(corners, &mut is_covered_with)
            });
        open & !cover.sixteenths()
    }
}

/// Obstacles by octave, in tiers; the largest first.
fn tiers_of(mesh: &Mesh, octaves: BTreeMap<i32, Vec<Obstacle>>) -> Vec<Tier> {
    let (mut tiers, mut smaller_end, mut smaller) = (Vec::new(), 0.0, Vec::new());
    for (octave, obstacles) in octaves {
        let end = scalbn(1.0, OCTAVES * (octave + 1));
        let count = smaller.len();
        smaller.extend(obstacles);
        if count > 0 && is_crowded(mesh, end, &smaller) {
            let larger = smaller.split_off(count);
            tiers.push(Tier::new(mesh, smaller_end, &smaller));
            smaller = larger;
        }
        smaller_end = end;
    }
    if !smaller.is_empty() {
        tiers.push(Tier::new(mesh, smaller_end, &smaller));
    }
    tiers.reverse();
    tiers
}

impl FragmentBounds {
    fn of([a, b, c]: [DVec3; 3]) -> Self {
        let longest2 = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        // Two thirds of the longest edge, and some more for rounding.
        Self { centre: (a + b + c) / 3.0, extent: 0.67 * longest2.sqrt(), longest2 }
    }
}

fn points_of([a, b, c]: [DVec3; 3]) -> Points {
    let (to_b, to_c) = (b - a, c - a);
    let mut points = [[0.0; 16]; 3];
    for (axis, points) in points.iter_mut().enumerate() {
        for (lane, x) in points.iter_mut().enumerate() {
            let [s, t] = [f64::from(CORNERS[0][lane]), f64::from(CORNERS[1][lane])];
            *x = a[axis] + (s * to_b[axis] + t * to_c[axis]);
        }
    }
    points
}

/// The share by which the cells of a ball are extended: rounding adds less.
const SLACK: f64 = 1e-6;

/// The factor by which cells grow.
const GROWTH: f64 = (1 << OCTAVES) as f64;

/// Obstacles whose clearances are below an end. Cells are at least twice as large as that.
struct Tier {
    end: f64,
    space: Space,
    /// The number of each cell that has obstacles, from 1 on.
    cells: Table<u32>,
    /// The obstacles of the cell with number 0, which has none, and of all others.
    obstacles: Binned<Obstacle>,
}

/// True if a cell has more obstacles than it should, on average, where cells are twice as large as `size`.
fn is_crowded(mesh: &Mesh, size: f64, obstacles: &[Obstacle]) -> bool {
    let (space, mut cells, mut count) = (Space::new(mesh, size), Table::<bool>::new(), 0);
    let (low, high) = mesh.bounds();
    for obstacle in obstacles {
        let inside = obstacle.centre.clamp(exact(low), exact(high)).as_vec3().to_array();
        let is_known = cells.entry(key(space.cell(space.place(inside))));
        count += usize::from(!std::mem::replace(is_known, true));
    }
    obstacles.len() > CROWD * count
}

impl Tier {
    fn new(mesh: &Mesh, end: f64, obstacles: &[Obstacle]) -> Self {
        let (low, high) = mesh.bounds();
        let (mut size, largest) = (end, exact(low).distance(exact(high)));
        while size < largest && !is_crowded(mesh, GROWTH * size, obstacles) {
            size *= GROWTH;
        }
        let space = Space::new(mesh, size);
        let bounds = [space.place(low), space.place(high)];
        let (mut cells, mut count, mut listed) = (Table::<u32>::new(), 0, Vec::new());
        for &obstacle in obstacles {
            each_cell(cells_of(&space, bounds, obstacle), |cell| {
                let number = cells.entry(key(cell));
                if *number == 0 {
                    count += 1;
                    *number = count;
                }
                listed.push((*number as usize, obstacle));
            });
        }
        let obstacles = Binned::new(count as usize + 1, listed.iter().copied());
        Self { end, space, cells, obstacles }
    }

    /// The number of obstacles that all cells list.
    fn listed(&self) -> usize {
        self.obstacles.items().len()
    }

    /// The obstacles whose balls can contain a position of the mesh.
    #[inline]
    fn at(&self, position: [f32; 3]) -> &[Obstacle] {
        self.of_cell(self.space.cell(self.space.place(position)))
    }

    #[inline]
    fn of_cell(&self, cell: [u32; 3]) -> &[Obstacle] {
        self.obstacles.bin(self.cells.get(key(cell)) as usize)
    }

    /// True if a test holds for the obstacles of a cell that may list some that cover a sixteenth of a fragment.
    fn any_cell(&self, corners: [DVec3; 3], mut test: impl FnMut(&[Obstacle]) -> bool) -> bool {
        let [a, b, c] = corners;
        // Most fragments lie in one cell.
        let [low, high] = [a.min(b).min(c), a.max(b).max(c)].map(|end| end.as_vec3().to_array());
        let [low, high] = [low, high].map(|end| self.space.cell(self.space.place(end)));
        if low == high {
            return test(self.of_cell(low));
        }
        any_cell(&self.space, corners.map(|corner| self.space.scaled(corner)), |cell| test(self.of_cell(cell)))
    }
}

/// The lowest and the highest cell that the part of a ball inside the mesh's box touches, which contains all queries.
///
/// Rounding is monotone, as for [`Space::cells_around`].
fn cells_of(space: &Space, [low, high]: [Place; 2], obstacle: Obstacle) -> [[u32; 3]; 2] {
    let (centre, reach) = (space.scaled(obstacle.centre), obstacle.reach * f64::from(space.scale()) * (1.0 + SLACK));
    let corner = |by: f64| {
        let end = (centre + by).as_vec3().to_array();
        space.cell([0, 1, 2].map(|axis| end[axis].clamp(low[axis], high[axis])))
    };
    [corner(-reach), corner(reach)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::fragment::Fragment;
    use crate::rng::{Draw, Rng};

    /// The places of the tests, and the size of the mesh: near the origin, far from it, tiny, and huge.
    const PLACES: [(f64, f64); 4] = [(0.0, 1.0), (1e3, 1.0), (0.0, 1e-36), (3e31, 1e31)];

    fn random_point(rng: &mut Rng, centre: f64, size: f64) -> [f32; 3] {
        [(); 3].map(|()| (centre + size * (2.0 * rng.unit() - 1.0)) as f32)
    }

    /// A few triangles of all sizes.
    fn mesh(rng: &mut Rng, centre: f64, size: f64) -> Mesh {
        let triangle = |rng: &mut Rng, i: usize| {
            let at = random_point(rng, centre, size);
            let small = [1.0, 0.1, 1e-3][i % 3] * size;
            [(); 3].map(|()| at.map(|x| (f64::from(x) + small * rng.unit()) as f32))
        };
        let positions: Vec<_> = (0..60).flat_map(|i| triangle(rng, i)).collect();
        Mesh::new(positions, (0..60).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap()
    }

    /// Clearances over ten orders of magnitude, some larger than the mesh, some smaller than any distance of floats;
    /// the balls of the large ones end near the mesh.
    fn given(rng: &mut Rng, mesh: &Mesh, centre: f64, size: f64, count: usize) -> Vec<([f32; 3], f64)> {
        let one = |i: usize| {
            let clearance = size * libm::exp10(9.0 * rng.unit() - 8.0);
            let corner = mesh.corners(rng.below(60) as u32)[0];
            match i % 4 {
                // At a corner, which is at its end.
                0 => {
                    let position = random_point(rng, centre, clearance.max(size));
                    (position, exact(position).distance(exact(corner)))
                }
                1 => (corner, clearance.min(1e-3 * size)),
                2 => (corner, 1e-300),
                _ => (random_point(rng, centre, 1.2 * size), 0.1 * clearance),
            }
        };
        (0..count).map(one).collect()
    }

    /// Everything is compared with a loop over all: positions, triangles, and sixteenths of fragments.
    #[test]
    fn rejects_and_covers_what_a_loop_over_all_does() {
        let mut counts = [0; 6];
        for round in 0..80 {
            let mut rng = Rng::at(round, Draw::Probe, &[]);
            let (centre, size) = PLACES[round as usize % 4];
            let mesh = mesh(&mut rng, centre, size);
            // Few, and so many that tiers are not joined.
            let count = [1, 20, 300, 2000][round as usize / 4 % 4];
            let mut given = given(&mut rng, &mesh, centre, size, count);
            if round >= 40 {
                // Most of the remaining surface is open.
                given.iter_mut().for_each(|given| given.1 = given.1.min(0.05 * size));
            }
            let obstacles = Obstacles::new(&mesh, given.iter().copied());
            let balls: Vec<_> = given.iter().map(|&(position, clearance)| Obstacle::new(position, clearance)).collect();
            let in_one = |points: &[DVec3]| balls.iter().any(|ball| points.iter().all(|&point| ball.holds(point)));
            for triangle in 0..60 {
                let whole = Fragment::whole(triangle);
                for bits in [[0.0; 2], [1.0, 0.0], [rng.unit(), 0.0], [0.3, 0.4]] {
                    let position = mesh.point(triangle, bits.map(|x| x as f32));
                    let rejected = obstacles.reject(position);
                    assert_eq!(rejected, in_one(&[exact(position)]), "{round} {triangle}");
                    counts[usize::from(rejected)] += 1;
                }
                let corners = mesh.exact_corners(triangle);
                let is_open = obstacles.open_triangles(1, |_| mesh.corners(triangle)) == 1;
                assert_eq!(is_open, !in_one(&corners));
                counts[2 + usize::from(is_open)] += 1;
                let open = obstacles.open_sixteenths(corners, u16::MAX);
                let extent = FragmentBounds::of(corners).extent;
                for sixteenth in 0..16 {
                    let is_open = open >> sixteenth & 1 == 1;
                    let covered = in_one(&whole.sixteenth(sixteenth).shape(&mesh).corners);
                    // The corners of neighbours are rounded in different ways.
                    let almost = |ball: &Obstacle| {
                        let near = Obstacle { reach: ball.reach * (1.0 + 1e-12) + 1e-12 * extent, ..*ball };
                        whole.sixteenth(sixteenth).shape(&mesh).corners.iter().all(|&corner| near.holds(corner))
                    };
                    assert!(is_open != covered || balls.iter().any(almost), "{round} {triangle} {sixteenth}");
                    counts[4 + usize::from(is_open)] += 1;
                }
            }
        }
        assert!(counts.into_iter().all(|count| count > 500), "{counts:?}");
    }

    #[test]
    fn what_cannot_touch_the_mesh_is_left_out_and_the_few_are_together() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let mesh = mesh(&mut rng, 0.0, 1.0);
        let far = [([3e38; 3], 1e38), ([0.0, 9.0, 0.0], 1.0), ([0.1; 3], 0.0)];
        assert!(Obstacles::new(&mesh, far.into_iter()).is_empty());
        let few = [([0.0; 3], 1e-9), ([0.1; 3], 1e-3), ([0.2; 3], 1.0), ([0.5; 3], 100.0)];
        let obstacles = Obstacles::new(&mesh, few.into_iter());
        assert_eq!((obstacles.tiers.len(), obstacles.wide.len()), (1, 1));
        let many = (0..1000).map(|i| ([0.3; 3], if i < 990 { 1e-4 } else { 0.1 }));
        assert_eq!(Obstacles::new(&mesh, many).tiers.len(), 2);
    }
}
