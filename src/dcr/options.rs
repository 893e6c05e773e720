//! The options of relaxation in the plane.

use crate::dcr::thesis::Thesis;
use crate::error::{Error, Result};
use crate::points::Domain;
use crate::setters::setters;

/// The points that are the neighbours of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its neighbours in the Delaunay triangulation: they keep their distance and close holes (§4.3.3).
    Delaunay,
    /// Its nearest points: they only repel (§4.3.4). The smallest distance ends larger than with Delaunay neighbours,
    /// and so do the holes.
    Nearest,
}

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
        Self { domain, neighbourhood, method: Method::Momentum, max_iterations: 100, seed: 0, tolerance: 0.001 }
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
        if !(0.0..).contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)));
        }
        Ok(())
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
