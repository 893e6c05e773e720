//! Sets of the plane that are edited (`editable.rs` in the root), of one radius: what they begin with, and how samples are
//! compared. Samples are kept by tiles (`tiles.rs`); `refill.rs` fills the gaps.

use crate::editable::{self, Edit, Ground, Standing, first_conflict};
use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::kdrt::{
    options::{DEFAULT_LEAF_SIZE, Kind, Options},
    plane,
    refill::InPlane,
    stack::require,
    tiles::Tile,
};
use crate::plane::Lattice;
use crate::points::{Domain, Points};
use crate::region::Region;

/// The bytes of a sample that stands, with its id and its tile, while arrays grow.
const BYTES_PER_SAMPLE: f64 = 64.0;

/// A set of samples of the plane that is edited. [`Region`]s are of the plane at height 0: their third coordinates must
/// include it. On a torus a position lies in a region if one of its images lies in the box, and one in the ball.
pub type EditableSet = editable::EditableSet<2, InPlane>;

impl EditableSet {
    /// The set of [`sample`](super::sample), to be edited. Samples have the ids 0, 1, 2 and so on in their order, and so
    /// have the given ones.
    ///
    /// # Errors
    /// Those of [`sample`](super::sample), and [`Error::InvalidArgument`] for a [kind](Options::kind) that is not
    /// [`Kind::Plain`].
    pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Self> {
        let ground = ground(options)?;
        let Points { positions, .. } = plane::sample(context, options, progress)?;
        let given = &options.given;
        let clearance = |index| given.clearance(index, ground.radius);
        let given: Vec<_> = (0..).zip(given.positions).map(|(index, &at)| (at, clearance(index))).collect();
        Ok(Self::begin(ground, options.seed, positions, given, true))
    }

    /// A set of given positions, to be edited: of any floats in the domain, as long as no two are closer than the radius.
    /// They have the ids 0, 1, 2 and so on, and so have the given samples of the options. The first refill looks
    /// everywhere for gaps and fills them. O(positions).
    ///
    /// # Errors
    /// As [`EditableSet::sample`]; [`Error::InvalidArgument`] for `positions` outside the domain, closer to each other
    /// than the radius or closer to a given sample than its clearance; for a [leaf size](Options::leaf_size), which has
    /// no effect here.
    pub fn of(options: &Options, positions: &[[f32; 2]]) -> Result<Self> {
        let ground = ground(options)?;
        options.given.check()?;
        if options.leaf_size != DEFAULT_LEAF_SIZE {
            let reason = format!("{:?} with positions; it must be {DEFAULT_LEAF_SIZE:?}", options.leaf_size);
            return Err(Error::invalid("leaf_size", reason));
        }
        options.domain.check_points(positions)?;
        if let Some([later, earlier]) = first_conflict(&ground, positions) {
            let reason = format!("[{later}] is closer to [{earlier}] than the radius {:?}", ground.radius);
            return Err(Error::invalid("positions", reason));
        }
        let mut set = Self::begin(ground, options.seed, positions.iter().copied(), [], false);
        let (_, covered) = set.add_given(options.given)?;
        match covered.ids.first() {
            None => Ok(set),
            Some(index) => {
                let reason = format!("[{index}] is closer to a given sample than its clearance");
                Err(Error::invalid("positions", reason))
            }
        }
    }

    /// The domain.
    pub fn domain(&self) -> Domain {
        self.ground().tiles.domain
    }
}

/// The ground of the sets of some options.
fn ground(options: &Options) -> Result<InPlane> {
    let radius = match options.kind {
        Kind::Plain(radius) => radius,
        Kind::Progressive(..) => {
            return Err(Error::invalid("order", "progressive; a set that is edited has samples in any order"));
        }
        Kind::Classes(classes) | Kind::ProgressiveClasses(classes, _) => {
            let reason = format!("{}; a set that is edited has one radius and no classes", classes.count());
            return Err(Error::invalid("classes", reason));
        }
    };
    let (domain, lattice) = (options.domain, Lattice::new(&options.domain, radius)?);
    require(lattice.expected_samples(), BYTES_PER_SAMPLE, options.given.positions.len(), "radius")?;
    Ok(InPlane::new(domain, lattice, radius))
}

impl Ground<2> for InPlane {
    type Sample = [f32; 2];
    type Bin = Tile;
    type Refilled = Points<2>;

    fn radius(&self) -> f64 {
        self.radius
    }

    fn position(sample: &[f32; 2]) -> [f32; 2] {
        *sample
    }

    fn bin(&self, position: [f64; 2]) -> Tile {
        self.tiles.at(position)
    }

    fn bins_in(&self, region: &Region, _: &Standing<[f32; 2], Tile>) -> Vec<Tile> {
        self.tiles.touched_by(region)
    }

    fn is_in(&self, region: &Region, position: [f32; 2]) -> bool {
        self.tiles.touches(region, [position; 2])
    }

    fn images(&self, position: [f32; 2]) -> Vec<[f64; 3]> {
        let along = |axis: usize| {
            let (x, min, max) = (f64::from(position[axis]), self.tiles.domain.min[axis], self.tiles.domain.max[axis]);
            let reach = 1.1 * self.radius;
            let turns = match self.tiles.period(axis) {
                Some(period) => vec![x - period, x, x + period],
                None => vec![x],
            };
            turns.into_iter().filter(move |image| (min - reach..=max + reach).contains(image))
        };
        along(1).flat_map(|y| along(0).map(move |x| [x, y, 0.0])).collect()
    }

    /// True if the distance in `f64` is below the radius; on the lattice, where it may be rounded, only if it is so
    /// exactly.
    fn conflict(&self, &a: &[f32; 2], &b: &[f32; 2]) -> bool {
        self.squared(a, b) < self.radius * self.radius
            && self.point(a).zip(self.point(b)).is_none_or(|(a, b)| {
                let along = |axis: usize| {
                    let along = (a[axis] - b[axis]).abs();
                    let is_periodic = self.tiles.is_periodic();
                    i64::from(if is_periodic { along.min(self.tiles.lattice.size[axis] - along) } else { along })
                };
                along(0) * along(0) + along(1) * along(1) < self.tiles.lattice.separation.threshold
            })
    }

    fn squared(&self, a: [f32; 2], b: [f32; 2]) -> f64 {
        let [x, y] = self.tiles.domain.offset(a.map(f64::from), b.map(f64::from));
        x * x + y * y
    }

    fn sample(&self, points: &Points<2>, index: usize) -> Option<[f32; 2]> {
        Some(points.positions[index]).filter(|&position| self.tiles.domain.contains(position))
    }

    fn points(&self, samples: &[[f32; 2]]) -> Points<2> {
        samples.to_vec().into()
    }

    fn prepare(&mut self, _: &Job) -> Result<()> {
        Ok(())
    }

    fn fill(&self, job: &Job, edit: &Edit<2, [f32; 2], Tile>) -> Result<(Vec<[f32; 2]>, u64)> {
        Ok((InPlane::fill(self, job, edit)?, 0))
    }

    fn refilled(&self, added: Points<2>, _: usize, _: u64, _: &Stopwatch) -> Points<2> {
        added
    }
}
