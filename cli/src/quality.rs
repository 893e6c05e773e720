//! The quality of a set of the plane, in a few figures.

use azulejo::analysis::figures::{Figures, figures_2d};
use azulejo::analysis::spacing::spacing_2d;
use azulejo::{Context, Domain, Progress, Result};

use crate::draw::spectra::spectrum_up_to;

/// Power below this frequency, in units of sqrt(density), is low.
pub const LOW: f64 = 0.25;

/// Frequencies per side of a periodogram, at most.
const GRID: usize = 1001;

/// The figures of a set. Lengths are in units of `d_max`, the distance of neighbours in the hexagonal arrangement.
#[derive(Clone, Copy)]
pub struct Quality {
    /// The smallest distance.
    pub rho: f64,
    /// The mean of the distances to the nearest neighbour.
    pub mean_distance: f64,
    /// The largest distance of a point of the domain from the set.
    pub cover: f64,
    /// The bond order ψ6.
    pub order: f64,
    /// The mean power below [`LOW`]; NaN if there is no frequency.
    pub low_power: f64,
    /// The share of obtuse triangles.
    pub obtuse: f64,
    /// The share of triangles with an angle below 30 degrees.
    pub sharp: f64,
    /// The variance of the edge lengths over their squared mean.
    pub edge_variation: f64,
}

impl Quality {
    /// The figures of a set.
    pub fn of(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<Self> {
        Self::with(context, domain, points, &figures_2d(context, domain, points, None)?, None)
    }

    /// The figures of a set, given the ones that need no spectrum.
    pub fn with(
        context: &Context,
        domain: &Domain,
        points: &[[f32; 2]],
        Figures { nearest, covering_radius, bond_order, triangles, .. }: &Figures,
        progress: Option<&Progress>,
    ) -> Result<Self> {
        let spacing = spacing_2d(domain, nearest);
        let spectrum = spectrum_up_to(context, domain, points, points.len(), LOW, GRID, progress)?;
        // The first annulus holds all frequencies below its width but 0; small sets have none.
        let low = spectrum.radial(LOW)?.into_iter().find(|annulus| annulus.frequency < LOW);
        Ok(Self {
            rho: spacing.smallest / spacing.hexagonal,
            mean_distance: spacing.mean / spacing.hexagonal,
            cover: covering_radius / spacing.hexagonal,
            order: *bond_order,
            low_power: low.map_or(f64::NAN, |annulus| annulus.power),
            obtuse: triangles.obtuse,
            sharp: triangles.below_30_degrees,
            edge_variation: triangles.edge_variation,
        })
    }
}
