//! The cost of progressive order, on one thread.

use std::sync::Arc;

use azulejo::kdrt::{self, Kind, Options, Plane, Progressive};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Order, Result, psp};

use super::prefixes::radius;
use super::{Effort, QUOTIENTS, Quotient};
use crate::psp::scenes;
use crate::timing::{Timed, least_seconds};

/// The samples of a window, and those of the plane that it is of.
pub const WINDOW: f64 = 1e4;
pub const PLANE: f64 = 1e8;

/// The times of a plain set, and of one for each quotient.
pub struct Times {
    /// The wanted number of samples, approximately.
    pub count: f64,
    pub plain: Timed,
    pub ordered: Vec<Timed>,
}

impl Times {
    /// The time of a sample in progressive order over that in any order.
    pub fn ratio(&self, quotient: usize) -> f64 {
        self.ordered[quotient].per_sample() / self.plain.per_sample()
    }

    fn measure(rounds: usize, count: f64, call: impl Fn(Option<Quotient>) -> Result<usize>) -> Result<Self> {
        let plain = || call(None);
        let ordered = QUOTIENTS.map(|quotient| {
            let call = &call;
            move || call(Some(quotient))
        });
        let mut calls: Vec<&dyn Fn() -> Result<usize>> = vec![&plain];
        calls.extend(ordered.iter().map(|call| call as &dyn Fn() -> Result<usize>));
        let least = least_seconds(rounds, &calls)?;
        Ok(Self { count, plain: least[0], ordered: least[1..].to_vec() })
    }

    /// Sets of the plane.
    pub fn plane(effort: &Effort) -> Result<Vec<Self>> {
        let one = Context::new(1)?;
        let time = |&count: &f64| {
            let set = |quotient| Ok(kdrt::sample(&one, &plane_options(count, quotient), None)?.len());
            Self::measure(effort.rounds, count, set)
        };
        effort.counts.iter().map(time).collect()
    }

    /// Sets on a mesh.
    pub fn mesh(mesh: &Arc<Mesh>, effort: &Effort) -> Result<Vec<Self>> {
        let one = Context::new(1)?;
        let time = |&count: &f64| {
            let set = |quotient: Option<Quotient>| {
                let plain = psp::Options::new(scenes::radius(mesh, count)).seed(1);
                let options =
                    quotient.map_or(plain, |quotient| plain.order(Order::Progressive).quotient(quotient.value));
                Ok(psp::sample(&one, mesh, &options, None)?.0.positions.len())
            };
            Self::measure(effort.rounds, count, set)
        };
        effort.counts.iter().map(time).collect()
    }

    /// A window in the middle of kept planes.
    pub fn window(effort: &Effort) -> Result<Self> {
        let one = Context::new(1)?;
        let side = (effort.plane / effort.window).sqrt();
        let domain = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic };
        let kept = |quotient| Plane::new(&one, &plane_options(effort.window, quotient).domain(domain), None);
        let plain = kept(None)?;
        let ordered: Vec<Plane> = QUOTIENTS.into_iter().map(|quotient| kept(Some(quotient))).collect::<Result<_>>()?;
        let corners = [0.4, 0.4 + 1.0 / side].map(|x| [x * side; 2]);
        Self::measure(effort.rounds, effort.window, |quotient| {
            let place = quotient.and_then(|quotient| QUOTIENTS.iter().position(|&other| other == quotient));
            let plane = place.map_or(&plain, |place| &ordered[place]);
            Ok(plane.window(corners[0], corners[1])?.len())
        })
    }
}

/// The options of a set of about so many samples per unit of area.
fn plane_options(count: f64, quotient: Option<Quotient>) -> Options<'static> {
    let levels = |quotient: Quotient| Progressive::new().quotient(quotient.value);
    let radius = radius(count);
    Options::of(quotient.map_or(Kind::Plain(radius), |quotient| Kind::Progressive(radius, levels(quotient)))).seed(1)
}
