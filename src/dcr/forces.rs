//! Tensions, activeness and displacements of one step (thesis §4.2.4, §4.3.2, §4.3.5 and its algorithm "Enforcing
//! Distance Constraints").
//!
//! The thesis scatters: whoever visits an edge adds to the force on both of its ends. Here every point gathers what
//! all visits give to it, so that points share nothing; the sums are the same.
//!
//! Activeness `α = Σ|F| / |ΣF|` (eq. 4.11) is 1 without tension and infinite in balance. It is held as its inverse,
//! the *yield* `β = |ΣF| / Σ|F|` in `0..=1`: how readily a point gives way. The algorithm's own share
//! `1 - α_i / (α_i + α_j)` is then `β_i / (β_i + β_j)`.

use glam::DVec2;

use super::links::{Link, Links};
use super::{Distribution, Neighbourhood, Thesis};

/// A force within this cosine of the reverse of the one before: the point oscillates (δ of §4.4.2; §4.3.5 says 0.9).
const OSCILLATION_COSINE: f64 = 0.95;

/// A point in motion, in units of the reference spacing.
#[derive(Clone, Copy)]
pub(super) struct Particle {
    pub(super) position: DVec2,
    /// The inverse of the activeness.
    pub(super) yielding: f64,
    /// The sum of the tensions in the step before.
    pub(super) tension: DVec2,
}

impl Particle {
    /// A point at rest, of activeness 1.
    pub(super) fn new(position: DVec2) -> Self {
        Self { position, yielding: 1.0, tension: DVec2::ZERO }
    }
}

/// The constants of the forces.
pub(super) struct Forces {
    conflict_radius: f64,
    /// Infinite where neighbours do not attract.
    attraction_radius: f64,
    step: f64,
    distribution: Distribution,
}

impl Forces {
    pub(super) fn new(neighbourhood: Neighbourhood, thesis: &Thesis) -> Self {
        Self {
            conflict_radius: thesis.conflict_radius,
            attraction_radius: match neighbourhood {
                Neighbourhood::Delaunay => thesis.attraction_radius,
                Neighbourhood::Nearest => f64::INFINITY,
            },
            step: thesis.step,
            distribution: thesis.distribution,
        }
    }

    /// The force on a point by a neighbour at `offset`: eq. 4.10 with the division by the radius that the algorithm
    /// has and the equation lacks.
    fn tension(&self, offset: DVec2) -> DVec2 {
        let distance = offset.length();
        let strength = if distance < self.conflict_radius {
            (distance - self.conflict_radius) / self.conflict_radius
        } else if distance > self.attraction_radius {
            (distance - self.attraction_radius) / self.attraction_radius
        } else {
            return DVec2::ZERO;
        };
        strength * offset.normalize_or_zero()
    }

    /// The share of one tension that the visits to its edge bring upon the point itself: up to 1 when both ends visit.
    fn share(&self, link: &Link, particle: &Particle, other: &Particle) -> f64 {
        // What a point takes of a tension when it visits, and when it is visited.
        let (own, given) = match self.distribution {
            Distribution::Activeness => {
                let sum = particle.yielding + other.yielding;
                let share = if sum > 0.0 { particle.yielding / sum } else { 0.5 };
                (share, share)
            }
            Distribution::Average => (0.5, 0.5),
            Distribution::Dominant => (0.0, 1.0),
            Distribution::Zero => (1.0, 0.0),
            Distribution::EightyTwenty => (0.8, 0.2),
        };
        f64::from(link.outgoing) * own + f64::from(link.incoming) * given
    }

    /// The point after one step; its position has not been folded back into the domain.
    pub(super) fn advance(&self, links: &impl Links, particles: &[Particle], point: usize) -> Particle {
        let particle = particles[point];
        let (mut displacement, mut tension, mut tensions) = (DVec2::ZERO, DVec2::ZERO, 0.0);
        links.for_each(point, |link| {
            let force = self.tension(link.offset);
            displacement += self.share(&link, &particle, &particles[link.other as usize]) * force;
            // Each end that visits feels the tension once.
            let visits = f64::from(u8::from(link.outgoing) + u8::from(link.incoming));
            tension += visits * force;
            tensions += visits * force.length();
        });
        let reversed = -tension.dot(particle.tension);
        let oscillates = reversed > OSCILLATION_COSINE * tension.length() * particle.tension.length();
        let yielding = match tensions {
            _ if oscillates => 0.0,
            0.0 => 1.0,
            sum => (tension.length() / sum).min(1.0),
        };
        Particle { position: particle.position + self.step * displacement, yielding, tension }
    }
}
