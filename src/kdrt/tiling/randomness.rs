//! What each of the two randomnesses of KDRT is good for (thesis §2.5.2 and fig. 2.20).
//!
//! Without random splits the seams lie on a regular grid, whose harmonics peak in the spectrum. Without random clips all
//! leaves show the same points, and the spectrum is speckled as that of a single leaf: its contrast is high.

use crate::analysis::spectrum::{Periodogram, periodogram};
use crate::error::Result;
use crate::job::{Context, Job};
use crate::kdrt::divide::Fixed;
use crate::kdrt::tiling::Tiling;
use crate::maximal;
use crate::plane::lattice::Lattice;
use crate::points::{Boundary, Domain};

/// Leaves along a side where every split is in the middle, and their side in radii.
const LEAVES: i64 = 16;
const LEAF: f64 = 24.0;

/// Sets of each kind.
const SEEDS: std::ops::Range<u64> = 0..6;

/// Contrast and peaks of a kind of set.
#[derive(Debug)]
struct Figures {
    /// The mean contrast of the sets.
    contrast: f64,
    /// The largest peak of their mean spectrum on the harmonics, along the axes, of the grid of leaves that are split in
    /// the middle.
    peak: f64,
}

/// The figures of sets of about 100,000 samples.
fn figures(sample: impl Fn(&Job, &Lattice, u64) -> Result<Vec<[f32; 2]>>) -> Figures {
    let (domain, context) = (Domain::unit(Boundary::Periodic), Context::new(1).unwrap());
    let lattice = Lattice::new(&domain, 1.0 / (LEAF * LEAVES as f64)).unwrap();
    let spectrum = |seed| {
        let samples = context.run(None, |job| sample(job, &lattice, seed)).unwrap();
        periodogram(&context, &domain, &samples, 960, None).unwrap()
    };
    let spectra: Vec<_> = SEEDS.map(spectrum).collect();
    let contrasts = spectra.iter().map(|spectrum| spectrum.contrast(0.01, 0.5..1.5).unwrap());
    let harmonics = (1..480 / LEAVES).flat_map(|k| [[k * LEAVES, 0], [0, k * LEAVES]]);
    Figures {
        contrast: contrasts.sum::<f64>() / spectra.len() as f64,
        peak: Periodogram::mean(&spectra).unwrap().peak(0.01, harmonics).unwrap(),
    }
}

/// The figures of planes with leaves of at least 20 radii, in which something is not random.
fn figures_of_planes(fixed: Fixed) -> Figures {
    figures(|job, lattice, seed| {
        assert!(Tiling::is_worthwhile(lattice, 20.0));
        let mut tiling = Tiling::new(job, lattice.clone(), 20.0, seed, Default::default())?;
        tiling.tree.fixed = fixed;
        Ok(tiling.windows().iter().flat_map(|window| tiling.window(window)).collect())
    })
}

/// Powers are about exponentially distributed. The contrast of a set, of 320,000 of them, has therefore a standard error of 2 /
/// sqrt(320,000), which is 0.0036; the mean of six 0.0015, and the difference of two means 0.0021. The largest of the 58
/// harmonics' means of six exceeds 3.05 once in 67 times.
#[test]
fn with_both_randomnesses_a_plane_is_like_the_unbiased_reference() {
    let (reference, tiling) = (figures(maximal::sample_lattice), figures_of_planes(Fixed::Nothing));
    // Four standard errors; and two of them above the 0.004 by which the pattern's repetition raises the contrast.
    assert!((reference.contrast - 1.0).abs() < 0.006, "{reference:?}");
    assert!((tiling.contrast - reference.contrast).abs() < 0.008, "{tiling:?} {reference:?}");
    assert!(reference.peak < 3.05 && tiling.peak < 3.05, "{tiling:?} {reference:?}");
}

#[test]
fn without_random_splits_the_grid_of_leaves_peaks() {
    let tiling = figures_of_planes(Fixed::Splits);
    assert!(tiling.peak > 12.0, "{tiling:?}");
}

#[test]
fn without_random_clips_the_spectrum_is_speckled() {
    let tiling = figures_of_planes(Fixed::Clips);
    assert!(tiling.contrast > 2.0, "{tiling:?}");
}
