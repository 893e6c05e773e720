//! The options of flat interfaces: C, Python, JavaScript and the command line have one list of options for all sets of
//! one radius, not all of which can be combined. Combinations are refused here, and only here; the calls have types
//! that cannot be combined wrongly (`options.rs`).

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::job::{Context, Progress};
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::Points;
use crate::psp::options::{DEFAULT_QUOTIENT, Engine, Options, Priority, ProjectionOptions};
use crate::psp::progressive::{project, sample};
use crate::psp::report::Report;
use crate::setters::setters;

/// All options of sets of one radius or count, for interfaces without types. In Rust, [`Options`] and
/// [`ProjectionOptions`] say the same, and cannot be combined wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FlatOptions<'a> {
    /// The radius; 0 where there is a count.
    pub radius: f64,
    /// The number of samples; 0, the default: as many as the radius gives.
    pub count: usize,
    /// The order; by default any. Progressive order, like a count, requires a set that is only filled.
    pub order: Order,
    /// As [`Options::quotient`].
    pub quotient: f64,
    /// The number of iterations. `None`, the default: 0 for a maximal set, which takes less time to fill than to
    /// project and fill, on every mesh and with every radius, and prefers no direction; 1 for a set that is not
    /// maximal.
    pub iterations: Option<u32>,
    /// True, the default, if the surface that the projectors leave uncovered is filled.
    pub maximal: bool,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// As [`ProjectionOptions::priority`].
    pub priority: Priority,
    /// As [`ProjectionOptions::engine`].
    pub engine: Engine,
    /// As [`Options::given`].
    pub given: Given<'a, 3>,
    /// As [`Options::cosine`].
    pub cosine: f64,
}

impl<'a> FlatOptions<'a> {
    /// A maximal set of this radius.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            count: 0,
            order: Order::Any,
            quotient: DEFAULT_QUOTIENT,
            iterations: None,
            maximal: true,
            seed: 0,
            priority: Priority::default(),
            engine: Engine::default(),
            given: Given::default(),
            cosine: -1.0,
        }
    }

    /// Samples a mesh: by [`sample`], or by [`project`] where there are iterations or the set is not maximal.
    ///
    /// # Errors
    /// Those of the two calls, and [`Error::InvalidArgument`] for `iterations`, sets that are not `maximal` and a
    /// `radius` beside a `count`, and for the first two in progressive order.
    pub fn sample(
        &self,
        context: &Context,
        mesh: &Arc<Mesh>,
        progress: Option<&Progress>,
    ) -> Result<(Points<3>, Report)> {
        let &Self { radius, count, order, quotient, seed, given, cosine, .. } = self;
        let iterations = self.iterations.unwrap_or(if self.maximal { 0 } else { 1 });
        let is_filled = iterations == 0 && self.maximal;
        if count > 0 || order == Order::Progressive {
            self.check_filled(iterations)?;
        } else if !is_filled {
            return project(context, mesh, &self.projection(), iterations, self.maximal, progress);
        }
        let options = if count > 0 { Options::by_count(count) } else { Options::new(radius) };
        let options = options.order(order).quotient(quotient).seed(seed).given(given).cosine(cosine);
        sample(context, mesh, &options, progress)
    }

    fn projection(&self) -> ProjectionOptions<'a> {
        let &Self { radius, seed, priority, engine, given, cosine, .. } = self;
        ProjectionOptions { radius, seed, priority, engine, given, cosine }
    }

    /// Refuses options that cannot be combined with a count or progressive order.
    fn check_filled(&self, iterations: u32) -> Result<()> {
        let asked = if self.count > 0 { "count" } else { "progressive order" };
        if iterations != 0 {
            return Err(Error::invalid("iterations", format!("{iterations}; {asked} requires iterations = 0")));
        }
        if !self.maximal {
            return Err(Error::invalid("maximal", format!("is off; {asked} requires a maximal set")));
        }
        if self.count > 0 && self.radius != 0.0 {
            let (count, radius) = (self.count, self.radius);
            return Err(Error::invalid("count", format!("{count} with radius {radius}; give one of the two")));
        }
        Ok(())
    }
}

setters!(FlatOptions<'a> {
    count: usize,
    order: Order,
    quotient: f64,
    iterations: Option<u32>,
    maximal: bool,
    seed: u64,
    priority: Priority,
    engine: Engine,
    given: Given<'a, 3>,
    cosine: f64,
});
