//! The method of the thesis (§4.3): tensions shared by activeness, in a neighbourhood that is found anew in every step.
//!
//! Where the thesis contradicts itself, this module does what its algorithm (§4.3.3) says:
//!
//! * Every edge is visited from both ends, so each end receives twice its share of the tension. The constant
//!   distributions of Fig. 4.19 then coincide on the Delaunay neighbourhood, which is symmetric; with [`Visits::OneEnd`]
//!   they differ.
//! * High activeness moves a point *less*; the formulas of §4.3.2 state the opposite.
//! * Activeness is computed from the tensions themselves, not from the forces that it has weighted.
//! * The tension is divided by its radius; eq. 4.10 is not.
//! * Radii are centre-to-centre distances in units of `d_max = sqrt(2 A / (sqrt(3) N))`; the formula for `r_max`
//!   printed in §4.4.2 lacks a fraction bar.
//! * A point oscillates if the cosine of its force and the reverse of the one before is above 0.95 (§4.4.2); §4.3.5 says
//!   0.9, of the longer of the two. Its activeness is then infinite: its neighbours move instead.
//! * λ is constant, as in the thesis's experiments, or decays by a factor per step, where the thesis gives no rule.
//!
//! Convergence is judged by motion: [`Report::motion`](crate::dcr::Report::motion) is the distance covered in the last
//! steps whose λ add up to 2 (40 steps of 0.05), per unit of λ: the same for small and large steps at the same state.
//! The thesis's own test (`variance.rs`) depends on the step size; [`Convergence::Variance`] asks for it.
//!
//! The thesis's radii cost Delaunay neighbours some of the spacing that thrown darts have, as an attraction radius of
//! 1.05 cannot be met everywhere; they gain coverage and well-shaped triangles. Nearest neighbours gain spacing at the
//! price of holes, as nothing attracts. `docs/dcr.md` compares both with the thesis's tables.

mod delaunay;
mod forces;
mod links;
mod nearest;
mod relaxation;
mod settings;
mod variance;

pub(super) use relaxation::ThesisRelaxation;
pub use settings::{Convergence, Distribution, Thesis, Visits};
