//! Pre-existing samples: obstacles that are never returned.
//!
//! Samples whose clearance is the radius of the set act like its own samples. They are put into the same grids, cube by
//! cube, which is as fast. All others are obstacles.

use std::collections::HashMap;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::index::Binned;
use crate::memory;
use crate::mesh::{Mesh, exact};
use crate::psp::cubes::Cube;
use crate::psp::fill::cells::Cells;
use crate::psp::fill::grid::Grid;
use crate::psp::fill::space::Space;
use crate::psp::fragment::{Facing, NO_NORMAL};
use crate::psp::obstacles::{Obstacles, touches};
use crate::psp::samples::SampleSet;

/// Given samples around which a set of one radius grows.
pub(super) struct GivenSamples {
    /// The numbers of the cubes that have given samples of the same radius.
    cubes: HashMap<Cube, usize>,
    /// The positions of the given samples of the same radius, by these numbers.
    alike: Binned<[f32; 3]>,
    space: Space,
    /// All other given samples.
    pub obstacles: Obstacles,
}

/// Given samples in and around a cube.
pub(super) struct NearGiven<'a> {
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
        if radius.is_none() && given.clearances.is_none() && !given.positions.is_empty() {
            return Err(Error::invalid("given_clearances", "are required with a count, as no radius stands for them"));
        }
        let obstacles = Obstacles::new(mesh, balls(given, radius.unwrap_or(0.0)));
        Ok(Self { obstacles, ..Self::none(mesh) })
    }

    /// No given samples.
    pub fn none(mesh: &Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let space = Space::new(mesh, exact(low).distance(exact(high)));
        Self {
            cubes: HashMap::new(),
            alike: Binned::new(0, std::iter::empty()),
            space,
            obstacles: Obstacles::new(mesh, std::iter::empty()),
        }
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
        cube.around().filter_map(|cube| self.cubes.get(&cube)).flat_map(|&number| self.alike.bin(number)).copied()
    }
}

impl NearGiven<'_> {
    /// True if a position in the cube is too close to a given sample.
    pub fn reject(&self, position: [f32; 3]) -> bool {
        let rejects = |grid: &Grid| grid.rejects(grid.space.place(position), NO_NORMAL);
        self.grid.as_ref().is_some_and(rejects) || self.obstacles.reject(position)
    }
}

/// The given samples of a set that has no radius of its own.
pub(super) fn obstacles(mesh: &Mesh, given: Given<3>) -> Result<Obstacles> {
    if given.clearances.is_none() && !given.positions.is_empty() {
        return Err(Error::invalid("given_clearances", "are required where the radius varies"));
    }
    obstacles_of(mesh, given)
}

/// Given samples that have clearances, if there are any.
pub(super) fn obstacles_of(mesh: &Mesh, given: Given<3>) -> Result<Obstacles> {
    check(given)?;
    Ok(Obstacles::new(mesh, balls(given, 0.0)))
}

/// The position and the clearance of each.
fn balls<'a>(given: Given<'a, 3>, radius: f64) -> impl Iterator<Item = ([f32; 3], f64)> + 'a {
    (0..).zip(given.positions).map(move |(index, &position)| (position, given.clearance(index, radius)))
}

/// The largest number that can be indexed, as each is listed up to eight times.
const MOST: usize = (u32::MAX / 8) as usize;
/// Peak memory for each, approximately.
const BYTES_PER_GIVEN: f64 = 300.0;

fn check(given: Given<3>) -> Result<()> {
    if given.positions.len() > MOST {
        return Err(Error::too_large("given_count", format!("{}; the limit is {MOST}", given.positions.len())));
    }
    let count = given.positions.len();
    memory::require(BYTES_PER_GIVEN * count as f64, "given_count", &format!("{count} given samples"))?;
    given.check()
}
