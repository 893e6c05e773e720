//! The settings of the thesis's algorithm (§4.4.2 and §4.4.3).

use crate::error::{Error, Result};
use crate::setters::setters;

/// The division of a tension between the point that visits an edge and the neighbour at its other end (Fig. 4.19).
///
/// If edges are visited from both ends ([`Visits::BothEnds`]), all but [`Distribution::Activeness`] give the same
/// displacements on the Delaunay neighbourhood. They differ with nearest neighbours, where one end may be among the
/// nearest of the other but not conversely, and with [`Visits::OneEnd`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// By activeness: a point whose tensions cancel out moves its neighbours, one whose tensions agree moves itself.
    Activeness,
    /// Half to each end: the thesis's algorithm without activeness.
    Average,
    /// All to the neighbour.
    Dominant,
    /// All to the visiting point itself.
    Zero,
    /// 80 % to the visiting point, 20 % to the neighbour. (Of the thesis's two descriptions, the one in the list of
    /// strategies that names the numbers in this order.)
    EightyTwenty,
}

/// The ends from which an edge is visited. Each visit applies its tension to both ends once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visits {
    /// From each end that has the other in its neighbourhood, as in the thesis's pseudo-code.
    BothEnds,
    /// From one end. Of two that are in each other's neighbourhood it is the same one in every step, chosen by a coin
    /// keyed by the seed and the two points, so that the distributions of Fig. 4.19 differ. Points move about half as
    /// far in a step.
    OneEnd,
}

/// The test of convergence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// The motion ([`Report::motion`](crate::dcr::Report::motion)) falls to the tolerance. It does not depend on the
    /// step size.
    Motion,
    /// The thesis's test (§4.4.2): ten times in a row the variance of the distances to the nearest point changes by
    /// less than 0.1 % in a step, while more than 99 % of the points are stable, which the thesis does not define: here
    /// those that move by less than 0.01 `d_max` in the step. Both halve with the step size, so the smaller that is,
    /// the earlier the test is met. In sets of a few hundred points the variance may never rest.
    Variance,
}

/// The settings of the thesis's algorithm. Lengths are in units of `d_max`, the distance of neighbours if the same
/// number of points stood in hexagonal arrangement on the domain's area (and never more than its shorter side).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Thesis {
    /// Neighbours closer than this repel each other; above 0, at most 1. The thesis: 0.8 to 0.99.
    pub conflict_radius: f64,
    /// Delaunay neighbours farther apart attract each other; at least the conflict radius. The thesis: 1.01 to 1.2.
    pub attraction_radius: f64,
    /// The step size λ: the displacement by a tension of 1; above 0, at most 1.
    pub step: f64,
    /// The factor of λ after every step; above 0, at most 1. With 1 it is constant, as in the thesis's experiments;
    /// the thesis recommends a decaying one without a rule for it. All steps together are no longer than
    /// `step / (1 - decay)`: about 10 are needed from a random start.
    pub decay: f64,
    /// `K` of the nearest neighbourhood; at least 1.
    pub neighbours: u32,
    /// The division of tensions.
    pub distribution: Distribution,
    /// The ends from which edges are visited.
    pub visits: Visits,
    /// The test of convergence.
    pub convergence: Convergence,
}

impl Default for Thesis {
    /// The settings of the thesis: radii 0.95 and 1.05, constant λ = 0.05, activeness, visits from both ends; 6 nearest
    /// neighbours, the number that a point of the plane has on average, as the thesis names none. Convergence is judged
    /// by motion.
    fn default() -> Self {
        Self {
            conflict_radius: 0.95,
            attraction_radius: 1.05,
            step: 0.05,
            decay: 1.0,
            neighbours: 6,
            distribution: Distribution::Activeness,
            visits: Visits::BothEnds,
            convergence: Convergence::Motion,
        }
    }
}

setters!(Thesis {
    conflict_radius: f64,
    attraction_radius: f64,
    step: f64,
    decay: f64,
    neighbours: u32,
    distribution: Distribution,
    visits: Visits,
    convergence: Convergence,
});

impl Thesis {
    /// Refuses values out of their range.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] with the name of the field.
    pub fn check(&self) -> Result<()> {
        let within = |argument, value: f64| {
            // The comparison fails for NaN too.
            if value > 0.0 && value <= 1.0 {
                Ok(())
            } else {
                Err(Error::invalid(argument, format!("{value} is not above 0 and at most 1")))
            }
        };
        within("conflict_radius", self.conflict_radius)?;
        within("step", self.step)?;
        within("decay", self.decay)?;
        if !(self.conflict_radius..).contains(&self.attraction_radius) {
            let reason = format!("{} is below conflict_radius {}", self.attraction_radius, self.conflict_radius);
            return Err(Error::invalid("attraction_radius", reason));
        }
        if self.neighbours == 0 {
            return Err(Error::invalid("neighbours", "0 is not at least 1"));
        }
        Ok(())
    }
}
