//! Relaxation in the plane at a constant density: its options, and the call.

use crate::dcr::law::Neighbourhood;
use crate::dcr::relaxation::{DelaunayOptions, Limits, Observer, Report, relax_set, require_points};
use crate::dcr::thesis::{Thesis, ThesisRelaxation};
use crate::dcr::uniform::UniformRelaxation;
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::points::{Boundary, Domain};
use crate::setters::setters;

/// The peak memory for a point and all of its data; and where it has images, in meshes.
const BYTES_PER_POINT: f64 = 315.0;
const BYTES_PER_MIRRORED_POINT: f64 = 950.0;
/// The same of the thesis's method in a mesh, and in lists.
const BYTES_PER_THESIS_POINT: f64 = 400.0;
const BYTES_PER_MIRRORED_THESIS_POINT: f64 = 1010.0;
const BYTES_PER_LISTED_THESIS_POINT: f64 = 380.0;

/// The law by which points move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Push, pull, momentum and waves; see the page of this module.
    Momentum,
    /// The algorithm of the thesis.
    Thesis(Thesis),
}

/// The options of [`relax`](fn@super::relax).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The rectangle in which the points lie and stay.
    pub domain: Domain,
    /// The definition of neighbours.
    pub neighbourhood: Neighbourhood,
    /// The law by which points move.
    pub method: Method,
    /// The largest number of steps. 0 returns the points unchanged.
    pub max_iterations: u32,
    /// The key of the moves of coincident points, and of those of a set that lies on one line; with a density, of the
    /// redistribution of clustered points. Used for nothing else.
    pub seed: u64,
    /// The motion ([`Report::motion`](super::Report::motion)) at which the set has converged, if the constraints are
    /// met ([`Stopped::Converged`](super::Stopped::Converged)); with 0 all steps are made unless nothing moves at all.
    /// Not used with [`Convergence::Variance`](super::Convergence::Variance).
    pub tolerance: f64,
}

impl Options {
    /// The momentum method: at most 100 steps, tolerance 0.001.
    pub fn new(domain: Domain, neighbourhood: Neighbourhood) -> Self {
        Self { neighbourhood, ..DelaunayOptions::new(domain).into() }
    }

    /// The thesis's algorithm with its settings: at most 1000 steps. The tolerance is 0.02 for Delaunay and 0.005 for
    /// nearest neighbours, which spread more slowly and do not jitter. Activeness keeps Delaunay neighbourhoods moving
    /// by 0.01 for ever, so lower values are reached only by constant distributions.
    pub fn thesis(domain: Domain, neighbourhood: Neighbourhood) -> Self {
        let tolerance = match neighbourhood {
            Neighbourhood::Delaunay => 0.02,
            Neighbourhood::Nearest => 0.005,
        };
        let method = Method::Thesis(Thesis::default());
        Self { domain, neighbourhood, method, max_iterations: 1000, seed: 0, tolerance }
    }

    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.domain.check()?;
        if let Method::Thesis(thesis) = &self.method {
            thesis.check()?;
        }
        self.limits().check()
    }

    /// These options for a call without a choice of method and neighbourhood, for interfaces whose calls have one list of
    /// options; `what` it relaxes.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for another `method` or `neighbourhood` than momentum and Delaunay.
    pub fn to_delaunay(&self, what: &str) -> Result<DelaunayOptions> {
        let &Self { domain, neighbourhood, method, max_iterations, seed, tolerance } = self;
        match (method, neighbourhood) {
            (Method::Thesis(_), _) => {
                Err(Error::invalid("method", format!("{what} are relaxed by the momentum method only")))
            }
            (_, Neighbourhood::Nearest) => {
                Err(Error::invalid("neighbourhood", format!("{what} are relaxed with Delaunay neighbours only")))
            }
            (Method::Momentum, Neighbourhood::Delaunay) => {
                Ok(DelaunayOptions { domain, max_iterations, seed, tolerance })
            }
        }
    }

    /// The conditions that end the steps.
    fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(Options {
    domain: Domain,
    neighbourhood: Neighbourhood,
    method: Method,
    max_iterations: u32,
    seed: u64,
    tolerance: f64,
});

impl From<DelaunayOptions> for Options {
    fn from(options: DelaunayOptions) -> Self {
        let DelaunayOptions { domain, max_iterations, seed, tolerance } = options;
        let (neighbourhood, method) = (Neighbourhood::Delaunay, Method::Momentum);
        Self { domain, neighbourhood, method, max_iterations, seed, tolerance }
    }
}

/// Relaxes a set of points of the domain: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads and every order of calls; the points stay in `min <= x < max`,
/// wrapped around the torus or held back by the boundary. An empty set and a single point are returned unchanged.
/// Coincident points, and all points of a set on one line, are first moved by 0.001 to 0.002 `d_max` in directions
/// keyed by `seed` and index: the forces alone would not separate them.
///
/// The momentum method levels a clustered set before the first step: one in which points are crowded in some places and
/// missing in others, as in a corner, on a line, at a single place. It is spread by the long waves of its density, as
/// smoothly as possible, in up to 24 passes that take about the time of a step each. So any set ends with the figures
/// of a random one, and in about the same time. Uniform random sets are not clustered, except on domains that are very
/// long for their width. A call that makes all of its steps succeeds whatever the quality reached, which is in the
/// report.
///
/// The momentum method with Delaunay neighbours returns, of the set before the first step and the states after whole
/// steps, the one in which the fewest points have a neighbour closer than 0.85 `d_max` or a triangle whose circumradius
/// is above 0.67 `d_max`; of several, the last. In all other cases the set after the last whole step is returned. A
/// call that is cancelled returns the same, with [`Stopped::Cancelled`](super::Stopped::Cancelled).
///
/// Each step is O(n) for sets without dense clusters, but O(n log n) where a Delaunay triangulation is built anew: while
/// more than 64 points have holes as wide as the domain, or points have dozens of neighbours, and by the thesis's method
/// also after steps that turn a triangle over, as the first from random points do. A bounded domain costs up to four
/// times the time and memory of a periodic one, as the triangulation is one of it and its mirror images. Memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of their range and for points outside the
/// domain or not finite (`positions`, with index and value), [`Error::TooLarge`] for more than
/// 2^32 - 1 points.
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    relax_observed(context, options, points, progress, None)
}

/// As [`relax`], and calls `observe` after every step, on the calling thread.
///
/// # Errors
/// As [`relax`].
pub fn relax_observed(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
    observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    options.domain.check_points(points)?;
    let Options { domain, neighbourhood, seed, .. } = *options;
    let bytes = match (&options.method, neighbourhood, domain.boundary) {
        (Method::Momentum, _, Boundary::Periodic) => BYTES_PER_POINT,
        (Method::Momentum, _, Boundary::Bounded) => BYTES_PER_MIRRORED_POINT,
        (Method::Thesis(_), Neighbourhood::Nearest, _) => BYTES_PER_LISTED_THESIS_POINT,
        (Method::Thesis(_), Neighbourhood::Delaunay, Boundary::Periodic) => BYTES_PER_THESIS_POINT,
        (Method::Thesis(_), Neighbourhood::Delaunay, Boundary::Bounded) => BYTES_PER_MIRRORED_THESIS_POINT,
    };
    require_points("positions", points.len(), bytes)?;
    match &options.method {
        Method::Momentum => {
            let mut set = UniformRelaxation::new(domain, neighbourhood, seed, points);
            relax_set(context, &domain, options.limits(), points, &mut set, progress, observe)
        }
        Method::Thesis(thesis) => {
            let mut set = ThesisRelaxation::new(domain, neighbourhood, thesis, seed, points);
            relax_set(context, &domain, options.limits(), points, &mut set, progress, observe)
        }
    }
}
