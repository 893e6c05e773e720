//! Tensions, activeness and displacements of one step (thesis §4.2.4, §4.3.2, §4.3.5 and its algorithm "Enforcing
//! Distance Constraints").
//!
//! The thesis scatters: a visit to an edge adds to the force on both of its ends. Here every point gathers the forces
//! that all visits would add to it, so that points share nothing; the sums are the same.
//!
//! Activeness `α = Σ|F| / |ΣF|` (eq. 4.11) is 1 without tension and infinite in balance. It is held as its inverse,
//! the *yield* `β = |ΣF| / Σ|F|` in `0..=1`: the readiness of a point to move. The algorithm's own share
//! `1 - α_i / (α_i + α_j)` is then `β_i / (β_i + β_j)`.

use glam::DVec2;

use crate::dcr::law::Neighbourhood;
use crate::dcr::thesis::links::{Link, Links};
use crate::dcr::thesis::{Distribution, Thesis, Visits};
use crate::rng::{Draw, hash};

/// A force within this cosine of the reverse of the one before: the point oscillates (δ of §4.4.2; §4.3.5 says 0.9).
const OSCILLATION_COSINE: f64 = 0.95;

/// A point in motion, in units of the reference spacing.
#[derive(Clone, Copy)]
pub struct Particle {
    pub position: DVec2,
    /// The inverse of the activeness.
    pub yielding: f64,
    /// The sum of the tensions in the step before.
    pub tension: DVec2,
}

impl Particle {
    /// A point at rest, of activeness 1.
    pub fn new(position: DVec2) -> Self {
        Self { position, yielding: 1.0, tension: DVec2::ZERO }
    }
}

/// The constants of the forces.
pub struct Forces {
    conflict_radius: f64,
    attraction_radius: f64,
    /// The inverses of the radii; the second is 0 where neighbours do not attract.
    per_conflict_radius: f64,
    per_attraction_radius: f64,
    /// λ.
    pub step: f64,
    distribution: Distribution,
    visits: Visits,
    seed: u64,
}

impl Forces {
    pub fn new(neighbourhood: Neighbourhood, thesis: &Thesis, seed: u64) -> Self {
        Self {
            conflict_radius: thesis.conflict_radius,
            attraction_radius: thesis.attraction_radius,
            per_conflict_radius: thesis.conflict_radius.recip(),
            per_attraction_radius: match neighbourhood {
                Neighbourhood::Delaunay => thesis.attraction_radius.recip(),
                Neighbourhood::Nearest => 0.0,
            },
            step: thesis.step,
            distribution: thesis.distribution,
            visits: thesis.visits,
            seed,
        }
    }

    /// The tension of a link of this length, negative where it pushes: eq. 4.10 with the division by the radius that the
    /// algorithm has and the equation lacks.
    #[inline(always)]
    fn tension(&self, distance: f64) -> f64 {
        // Without branches, which links of random lengths would mislead.
        let conflict = (distance - self.conflict_radius) * self.per_conflict_radius;
        let attraction = (distance - self.attraction_radius) * self.per_attraction_radius;
        conflict.min(0.0) + attraction.max(0.0)
    }

    /// The number of visits to a link by the point, and by the neighbour.
    #[inline(always)]
    fn visits(&self, point: u32, link: &Link) -> [f64; 2] {
        let is_mutual = link.outgoing && link.incoming;
        match self.visits {
            // A point and its own image visit the edge between them equally.
            Visits::OneEnd if is_mutual && link.other == point => [0.5; 2],
            Visits::OneEnd if is_mutual => {
                let (low, high) = (point.min(link.other), point.max(link.other));
                let is_low_visiting = hash(self.seed, Draw::Visit, &[low.into(), high.into()]) & 1 == 0;
                if is_low_visiting == (point == low) { [1.0, 0.0] } else { [0.0, 1.0] }
            }
            _ => [link.outgoing, link.incoming].map(|visits| f64::from(u8::from(visits))),
        }
    }

    /// The fraction of a tension that a point takes when it visits, and when it is visited.
    #[inline(always)]
    fn shares(&self, particle: &Particle, other: &Particle) -> [f64; 2] {
        match self.distribution {
            Distribution::Activeness => {
                let sum = particle.yielding + other.yielding;
                [if sum > 0.0 { particle.yielding / sum } else { 0.5 }; 2]
            }
            Distribution::Average => [0.5; 2],
            Distribution::Dominant => [0.0, 1.0],
            Distribution::Zero => [1.0, 0.0],
            Distribution::EightyTwenty => [0.8, 0.2],
        }
    }

    /// The point after one step; its position has not been folded back into the domain.
    #[inline(always)]
    pub fn advance(&self, links: &impl Links, particles: &[Particle], point: usize) -> Particle {
        let particle = particles[point];
        let (mut displacement, mut tension, mut tensions) = (DVec2::ZERO, DVec2::ZERO, 0.0);
        links.for_each(point, |link| {
            let distance = link.offset.length();
            let strength = self.tension(distance);
            // Coincident points have no direction.
            let force = if distance > 0.0 { strength / distance } else { 0.0 } * link.offset;
            let [own, given] = self.shares(&particle, &particles[link.other as usize]);
            let [visiting, visited] = self.visits(point as u32, &link);
            displacement += (visiting * own + visited * given) * force;
            // Every visit is felt at both ends.
            let visits = visiting + visited;
            tension += visits * force;
            tensions += visits * strength.abs();
        });
        let reversed = -tension.dot(particle.tension);
        let length = tension.length();
        let oscillates = reversed > OSCILLATION_COSINE * length * particle.tension.length();
        let yielding = match tensions {
            _ if oscillates => 0.0,
            0.0 => 1.0,
            sum => (length / sum).min(1.0),
        };
        Particle { position: particle.position + self.step * displacement, yielding, tension }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::Rng;

    const COUNT: usize = 24;

    /// A neighbourhood in which some links are not mutual.
    struct Partial<'a> {
        positions: &'a [DVec2],
    }

    impl Partial<'_> {
        fn has(&self, from: usize, to: usize) -> bool {
            let near = self.positions[from].distance(self.positions[to]) < 1.6;
            from != to && near && (from * to) % 5 != from % 3
        }
    }

    impl Links for Partial<'_> {
        fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
            for other in 0..COUNT {
                let offset = self.positions[other] - self.positions[point];
                let (outgoing, incoming) = (self.has(point, other), self.has(other, point));
                if outgoing || incoming {
                    visit(Link { other: other as u32, offset, outgoing, incoming });
                }
            }
        }
    }

    /// The thesis's state of a point: its activeness, and the force that it felt in the step before.
    type State = (DVec2, f64, DVec2);

    /// Activeness without bound, in the formulas that divide by its sum with another.
    const UNBOUND: f64 = 1e15;

    /// The pseudo-code of the thesis: a visit to an edge adds to both of its ends.
    fn scatter(forces: &Forces, before: &[State]) -> Vec<State> {
        let positions: Vec<_> = before.iter().map(|state| state.0).collect();
        let links = Partial { positions: &positions };
        let mut moved = vec![DVec2::ZERO; COUNT];
        let mut felt = vec![(DVec2::ZERO, 0.0); COUNT];
        for (i, j) in (0..COUNT).flat_map(|i| (0..COUNT).map(move |j| (i, j))).filter(|&(i, j)| links.has(i, j)) {
            let low_visits = hash(forces.seed, Draw::Visit, &[i.min(j) as u64, i.max(j) as u64]) & 1 == 0;
            if forces.visits == Visits::OneEnd && links.has(j, i) && low_visits != (i < j) {
                continue;
            }
            let edge = positions[j] - positions[i];
            let force = if edge.length() < forces.conflict_radius {
                -(forces.conflict_radius - edge.length()) / forces.conflict_radius * edge.normalize()
            } else if edge.length() > forces.attraction_radius {
                (edge.length() - forces.attraction_radius) / forces.attraction_radius * edge.normalize()
            } else {
                DVec2::ZERO
            };
            let alpha = match forces.distribution {
                Distribution::Activeness => before[i].1 / (before[i].1 + before[j].1),
                Distribution::Average => 0.5,
                Distribution::Dominant => 1.0,
                Distribution::Zero => 0.0,
                Distribution::EightyTwenty => 0.2,
            };
            moved[i] += forces.step * (1.0 - alpha) * force;
            moved[j] -= forces.step * alpha * force;
            for (end, force) in [(i, force), (j, -force)] {
                felt[end] = (felt[end].0 + force, felt[end].1 + force.length());
            }
        }
        let after = |i: usize| {
            let (force, tensions) = felt[i];
            let cosine = -force.normalize_or_zero().dot(before[i].2.normalize_or_zero());
            let alpha = match tensions / force.length() {
                _ if cosine > OSCILLATION_COSINE => UNBOUND,
                alpha if tensions > 0.0 => alpha.min(UNBOUND),
                _ => 1.0,
            };
            (positions[i] + moved[i], alpha, force)
        };
        (0..COUNT).map(after).collect()
    }

    #[test]
    fn what_points_gather_is_what_the_thesis_scatters() {
        let distributions = [
            Distribution::Activeness,
            Distribution::Average,
            Distribution::Dominant,
            Distribution::Zero,
            Distribution::EightyTwenty,
        ];
        let cases = distributions.into_iter().flat_map(|d| [Visits::BothEnds, Visits::OneEnd].map(|v| (d, v)));
        for (distribution, visits) in cases {
            // Large steps, for points that oscillate.
            let thesis = Thesis::default().step(0.4).distribution(distribution).visits(visits);
            let forces = Forces::new(Neighbourhood::Delaunay, &thesis, 3);
            let mut rng = Rng::at(7, Draw::Probe, &[]);
            let start = (0..COUNT).map(|_| 4.0 * DVec2::new(rng.unit(), rng.unit()));
            let mut particles: Vec<_> = start.map(Particle::new).collect();
            let mut states: Vec<State> = particles.iter().map(|p| (p.position, 1.0, DVec2::ZERO)).collect();
            let mut oscillating = 0;
            for _ in 0..12 {
                let positions: Vec<_> = particles.iter().map(|p| p.position).collect();
                let links = Partial { positions: &positions };
                particles = (0..COUNT).map(|point| forces.advance(&links, &particles, point)).collect();
                states = scatter(&forces, &states);
                for (particle, state) in particles.iter().zip(&states) {
                    assert!(particle.position.distance(state.0) < 1e-9, "{distribution:?} {visits:?}");
                }
                oscillating += particles.iter().filter(|p| p.yielding == 0.0).count();
            }
            assert!(oscillating > 0 || distribution == Distribution::Activeness, "{distribution:?} {visits:?}");
        }
    }
}
