//! DCR: relaxation of a point set by distance constraints (thesis ch. 4).
//!
//! All points move at once, each by the forces of its neighbours. The result depends neither on the order of the points
//! nor on the number of threads. There are two methods ([`Method`]):
//!
//! * [`Method::Momentum`], the default: neighbours in conflict push each other away, holes pull the points around them
//!   in, points have momentum, and long waves of the density are removed by Fourier transform. It ends after 100 steps,
//!   or sooner if the points have come to rest.
//! * [`Method::Thesis`]: the algorithm of the thesis with all of its settings.
//!
//! [`fn@relax`] works on a constant density, [`relax_with_density`] on any other, [`fn@surface::relax`] and
//! [`surface::relax_with_density`] do so on triangle meshes, [`fn@volume::relax`] works in cuboids, [`volume::relax_inside`] inside of meshes. [`relax_to_correlation`] gives sets
//! another spectrum. `docs/dcr.md` has measurements of the results in the plane and on meshes: distances, coverage, spectra
//! and angles.
//!
//! Convergence is judged by motion ([`Report::motion`]), unless [`Convergence::Variance`] asks for the thesis's own
//! test.

mod clustering;
mod correlation;
mod density;
mod law;
mod relax;
mod relaxation;
pub mod surface;
mod thesis;
mod torus;
mod uniform;
pub mod volume;

pub use correlation::{CorrelationOptions, CorrelationReport, PairCorrelation, relax_to_correlation};
pub use density::{Density, DensityFunction, relax_with_density, scatter};
pub use law::Neighbourhood;
pub use relax::{Method, Options, relax, relax_observed};
pub use relaxation::{DelaunayOptions, Observer, Report, Stopped};
pub use thesis::{Convergence, Distribution, Thesis, Visits};
pub use uniform::{ClassReport, relax_classes};
