//! Spectra of sets in the plane and in space, and what takes their place on meshes.

use azulejo::analysis::differential::{Differences, surface_differences};
use azulejo::analysis::spectrum::{Annulus, Periodogram, axis_power, radial_power_3d, sparse_periodogram};
use azulejo::{Error, Result};

use crate::analysis::Cuboid;
use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;
use crate::mesh::Handle;

/// The spectrum of a set of the plane; the handle is in `out`.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_create(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    points: *const [f32; 2],
    count: usize,
    size: usize,
    frequency_stride: usize,
    out: &mut Option<Box<Periodogram>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let domain = domain(min_x, min_y, max_x, max_y, bounded);
        let made = sparse_periodogram(context, &domain, points, size, frequency_stride, progress)?;
        *out = Some(Box::new(made));
        Ok(Answer::default())
    })
}

/// The mean of spectra; the handle is in `out`.
///
/// # Safety
/// `spectra` is valid for reads of `count` handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_mean(
    spectra: *const &Periodogram,
    count: usize,
    out: &mut Option<Box<Periodogram>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let spectra = unsafe { rows(spectra, count) };
    call(|_, _| {
        let spectra: Vec<Periodogram> = spectra.iter().copied().cloned().collect();
        *out = Some(Box::new(Periodogram::mean(&spectra).map_err(|error| renamed(error, "periodograms", "spectra"))?));
        Ok(Answer::default())
    })
}

/// An error whose argument JavaScript names otherwise.
fn renamed(error: Error, from: &str, to: &'static str) -> Error {
    match error {
        Error::InvalidArgument { argument, reason } if argument == from => {
            Error::InvalidArgument { argument: to, reason }
        }
        other => other,
    }
}

/// The power of each frequency.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_spectrum_power(spectrum: &Periodogram) -> i32 {
    call(|_, _| Ok(Answer::default().and(spectrum.power().to_vec())))
}

/// The frequency, power, anisotropy and number of frequencies of each annulus.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_spectrum_radial(spectrum: &Periodogram, width: f64) -> i32 {
    call(|_, _| Ok(Answer::default().and(numbers(&spectrum.radial(width)?))))
}

fn numbers(annuli: &[Annulus]) -> Vec<f64> {
    annuli.iter().flat_map(|ring| [ring.frequency, ring.power, ring.anisotropy, ring.count as f64]).collect()
}

/// The frequency, power, anisotropy and number of frequencies of each shell of the spectrum of a set of a cuboid.
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_spectrum(
    cuboid: &Cuboid,
    frequency_reach: f64,
    frequency_stride: usize,
    width: f64,
    points: *const [f32; 3],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let domain = cuboid.domain();
        let annuli = radial_power_3d(context, &domain, points, frequency_reach, frequency_stride, width, progress)?;
        Ok(Answer::default().and(numbers(&annuli)))
    })
}

/// The power of a set of a cuboid on an axis of frequencies.
///
/// # Safety
/// `points` is valid for reads of `point_count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_axis_power(
    cuboid: &Cuboid,
    axis: usize,
    count: usize,
    points: *const [f32; 3],
    point_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, point_count) };
    call(|context, progress| {
        Ok(Answer::default().and(axis_power(context, &cuboid.domain(), points, axis, count, progress)?))
    })
}

/// The steps of the frequency along both axes, the effective Nyquist frequency and the oscillation, -1 where the spectrum is too
/// small to tell, the contrast, and the highest peak and its frequency.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_spectrum_measure(spectrum: &Periodogram, low: f64, high: f64, width: f64) -> i32 {
    call(|_, _| {
        for (argument, frequency) in [("low", low), ("high", high)] {
            if !frequency.is_finite() {
                let reason = format!("{frequency} is not a finite number");
                return Err(Error::InvalidArgument { argument, reason });
            }
        }
        let peak = spectrum.highest_peak(width, low..high)?;
        let [column, row] = spectrum.frequency_step();
        let nyquist = unless_too_small(spectrum.effective_nyquist(width))?;
        let oscillation = unless_too_small(spectrum.oscillation(width))?;
        let contrast = spectrum.contrast(width, low..high)?;
        let (over_mean, [x, y]) = peak.map_or((0.0, [0.0; 2]), |peak| (peak.over_mean, peak.frequency));
        Ok(Answer::default().and(vec![column, row, nyquist, oscillation, contrast, over_mean, x, y]))
    })
}

fn unless_too_small(figure: Result<f64>) -> Result<f64> {
    match figure {
        Err(Error::InvalidArgument { argument: "size", .. }) => Ok(-1.0),
        other => other,
    }
}

/// Frees a spectrum.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_spectrum_free(spectrum: Option<Box<Periodogram>>) {
    drop(spectrum);
}

/// The differences of samples on a mesh; the handle is in `out`.
///
/// # Safety
/// The pointers are valid for reads of so many rows, `direction` for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_create(
    mesh: &Handle,
    positions: *const [f32; 3],
    count: usize,
    normals: *const [f32; 3],
    normal_count: usize,
    direction: &[f64; 3],
    seed: u64,
    out: &mut Option<Box<Differences>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (positions, normals) = unsafe { (rows(positions, count), rows(normals, normal_count)) };
    call(|context, progress| {
        let made = surface_differences(context, &mesh.0, positions, normals, *direction, seed, progress)?;
        *out = Some(Box::new(made));
        Ok(Answer::default())
    })
}

/// The differences of several sets together; the handle is in `out`.
///
/// # Safety
/// `differences` is valid for reads of `count` handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_mean(
    differences: *const &Differences,
    count: usize,
    out: &mut Option<Box<Differences>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let differences = unsafe { rows(differences, count) };
    call(|_, _| {
        let differences: Vec<Differences> = differences.iter().copied().cloned().collect();
        *out = Some(Box::new(Differences::together(&differences)?));
        Ok(Answer::default())
    })
}

/// The density of differences, and its radial mean.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_differences_densities(differences: &Differences) -> i32 {
    call(|_, _| {
        let radial: Vec<f64> = differences.radial().iter().map(|shell| shell.density).collect();
        Ok(Answer::default().and(differences.density()).and(radial))
    })
}

/// The radial mean of the power.
///
/// # Safety
/// `frequencies` is valid for reads of `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_power(
    differences: &Differences,
    frequencies: *const f64,
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let frequencies = unsafe { rows(frequencies, count) };
    call(|_, _| {
        if let Some(frequency) = frequencies.iter().find(|frequency| !(-32.0..=32.0).contains(*frequency)) {
            let reason = format!("{frequency} is not in -32 to 32");
            return Err(Error::InvalidArgument { argument: "frequencies", reason });
        }
        Ok(Answer::default().and(differences.power(frequencies)))
    })
}

/// Frees differences.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_differences_free(differences: Option<Box<Differences>>) {
    drop(differences);
}
