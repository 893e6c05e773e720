//! Power spectra of sets of the plane and of cuboids.

use azulejo_core::Error;
use azulejo_core::analysis::spectrum::{Annulus, Periodogram, axis_power, radial_power_3d, sparse_periodogram};

use crate::boundary::{self, Out, array, check_pointer};
use crate::context::azulejo_context;
use crate::domain::{PlaneSet, SpaceSet, azulejo_plane_set, azulejo_space_set};
use crate::growing::{self, Growing, Output, growing};
use crate::handles::{self, handle};
use crate::status::{Failure, azulejo_status};

/// The power spectrum of a set of the plane, or the mean of several: |sum of exp(-2 pi i f x)|^2 /
/// count on a square grid of frequencies f (Ulichney 1988; Lagae and Dutre 2008). Its mean is 1 for
/// a Poisson process. Frequencies are in units of sqrt(count / area): blue noise has a first ring
/// near 1.
pub struct azulejo_spectrum {
    periodogram: Periodogram,
}

handle!(azulejo_spectrum);

/// The frequencies of about one length: a point of the radial curves.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_annulus {
    /// The mean length of its frequencies.
    pub frequency: f64,
    /// The mean power: the radial mean; 1 for a Poisson process.
    pub power: f64,
    /// The variance of the power over its squared mean: 1 (0 dB) for one isotropic set, 1/n for the
    /// mean of n; preferred directions give more.
    pub anisotropy: f64,
    /// The number of its frequencies, at least 2; one and its opposite count once.
    pub count: u64,
}

/// The result of azulejo_spectrum_measure.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_spectrum_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The distances of neighbouring columns and rows.
    pub frequency_step: [f64; 2],
    /// The effective Nyquist frequency: half of the largest frequency up to which the mean power is
    /// below 0.1 (Heck et al. 2013, who divide it by 0.5). 0.537 for a hexagonal lattice, 0 for a
    /// Poisson process. -1 if the spectrum ends too early, below about 1.5.
    pub effective_nyquist: f64,
    /// The oscillation: ten times the root mean square of the power's deviation from 1, by area,
    /// from the frequency where it first reaches 0.98 to 5 above it (Heck et al. 2013). 0 for a
    /// Poisson process. -1 if the spectrum ends too early; frequencies up to 6.5 mostly suffice.
    pub oscillation: f64,
    /// The scatter of the power about its radial mean, over the frequencies from `low` to `high`: 1
    /// for one set without order over long distances, 1/n for the mean of n, more if parts repeat.
    pub contrast: f64,
    /// The largest power of a frequency from `low` to `high`, over the radial mean there: by chance
    /// about ln n for n frequencies of one set.
    pub peak: f64,
    /// That frequency, x y; its opposite has the same power.
    pub peak_frequency: [f64; 2],
}

growing!(azulejo_spectrum_report requires frequency_step {
    reserved: 0,
    frequency_step: [0.0; 2],
    effective_nyquist: 0.0,
    oscillation: 0.0,
    contrast: 0.0,
    peak: 0.0,
    peak_frequency: [0.0; 2],
});

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_report_init(
    report: *mut azulejo_spectrum_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Makes the spectrum of points of the plane, by nonuniform fast Fourier transform: exact up to the
/// rounding to float. A periodic domain has whole numbers of waves per period. In a bounded one
/// points have the weights of a taper that is 0 from the inscribed ellipse on.
///
/// set: the points may lie outside the domain; of a bounded one, at least one inside the ellipse.
///
/// size: the number of frequencies per side, 2 to 4096. From -(size / 2) steps of 1 / width and
/// height.
///
/// frequency_stride: n takes every n-th frequency along both axes, 1 to 4096, so that the spectra
/// of large sets reach as far as those of small ones. For all figures, size * frequency_stride of
/// about 13 * sqrt(count) is enough on a square.
///
/// O(count + size^2 * log size) time, and about 40 bytes of memory per point and per frequency.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_create(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    size: u32,
    frequency_stride: u32,
    out: *mut *mut azulejo_spectrum,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        let [size, stride] = [size, frequency_stride].map(|number| number as usize);
        let periodogram = set.run(|context, domain, points, progress| {
            sparse_periodogram(context, domain, points, size, stride, progress)
        })?;
        Ok(azulejo_spectrum { periodogram })
    })
}

/// Makes the mean of spectra of sets of one kind; noise decreases with the square root of `count`.
/// O(count * size^2) time and memory, on the calling thread.
///
/// spectra: `count` spectra, at least 1, all of one size. They still belong to the caller.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_mean(
    spectra: *const *const azulejo_spectrum,
    count: usize,
    out: *mut *mut azulejo_spectrum,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let spectra = unsafe { handles::all("spectra", "count", spectra, count) }?;
        let periodograms: Vec<_> = spectra.iter().map(|spectrum| spectrum.periodogram.clone()).collect();
        Ok(azulejo_spectrum { periodogram: Periodogram::mean(&periodograms)? })
    })
}

/// The number of frequencies per side.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_size(spectrum: *const azulejo_spectrum) -> u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("spectrum", spectrum) }.map_or(0, |spectrum| spectrum.periodogram.size() as u32)
}

/// The power, size * size numbers, row by row from the lowest frequency. Frequency 0, whose power
/// is set to 0, is in row and column size / 2.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_power(spectrum: *const azulejo_spectrum) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("spectrum", spectrum) }
        .map_or(std::ptr::null(), |spectrum| array(spectrum.periodogram.power()))
}

/// The radial curves of a spectrum, mean and anisotropy, out to its largest circle. O(size^2).
///
/// width: the width of an annulus, above 0. Annuli of fewer than two frequencies are left out.
///
/// annuli: receives at most `capacity` of them, from the lowest frequency; may be NULL for 0.
///
/// annulus_size: sizeof(azulejo_annulus).
///
/// out_count: their number, which may exceed the capacity.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_radial(
    spectrum: *const azulejo_spectrum,
    width: f64,
    annuli: *mut azulejo_annulus,
    capacity: usize,
    annulus_size: usize,
    out_count: *mut usize,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let annuli = unsafe { Annuli::new(annuli, capacity, annulus_size, out_count) }?;
        // SAFETY: handed on from the caller.
        let spectrum = unsafe { handles::get("spectrum", spectrum) }?;
        annuli.write(spectrum.periodogram.radial(width)?);
        Ok(())
    })
}

/// The caller's array of annuli.
struct Annuli {
    start: *mut azulejo_annulus,
    capacity: usize,
    size: usize,
    count: Out<usize>,
}

impl Annuli {
    /// # Safety
    /// Unless the checks fail, `start` leads to `capacity` elements of `size` bytes, and `count` to a number.
    unsafe fn new(
        start: *mut azulejo_annulus,
        capacity: usize,
        size: usize,
        count: *mut usize,
    ) -> Result<Self, Failure> {
        // SAFETY: handed on from the caller.
        let count = unsafe { Out::new(count) };
        count.check("out_count")?;
        growing::check_element_size::<azulejo_annulus>("annulus_size", size)?;
        if capacity > 0 {
            check_pointer("annuli", start.cast_const())?;
        }
        Ok(Self { start, capacity, size, count })
    }

    fn write(self, curve: Vec<Annulus>) {
        self.count.write(curve.len());
        for (i, annulus) in curve.into_iter().take(self.capacity).enumerate() {
            // SAFETY: below the caller's capacity, and no longer than the caller's elements.
            unsafe { self.start.byte_add(i * self.size).write(annulus.into()) };
        }
    }
}

impl From<Annulus> for azulejo_annulus {
    fn from(Annulus { count, frequency, power, anisotropy }: Annulus) -> Self {
        Self { frequency, power, anisotropy, count: count as u64 }
    }
}

/// Measures a spectrum: effective Nyquist frequency, oscillation, contrast, peak. O(size^2).
///
/// width: that of the annuli of the radial mean, above 0; 0.05 suits some thousand points.
///
/// low, high: the range of frequencies for contrast and peak.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_measure(
    spectrum: *const azulejo_spectrum,
    width: f64,
    low: f64,
    high: f64,
    out: *mut azulejo_spectrum_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let out = unsafe { Output::required("out", out) }?;
        // SAFETY: handed on from the caller.
        let of = &unsafe { handles::get("spectrum", spectrum) }?.periodogram;
        for (argument, frequency) in [("low", low), ("high", high)] {
            if !frequency.is_finite() {
                return Err(Failure::invalid(argument, format!("{frequency} is not a finite number")));
            }
        }
        let peak = of.highest_peak(width, low..high)?;
        out.write(azulejo_spectrum_report {
            frequency_step: of.frequency_step(),
            effective_nyquist: unless_too_small(of.effective_nyquist(width))?,
            oscillation: unless_too_small(of.oscillation(width))?,
            contrast: of.contrast(width, low..high)?,
            peak: peak.map_or(0.0, |peak| peak.over_mean),
            peak_frequency: peak.map_or([0.0; 2], |peak| peak.frequency),
            ..azulejo_spectrum_report::DEFAULT
        });
        Ok(())
    })
}

/// A figure that a spectrum may be too small for: -1 then.
fn unless_too_small(figure: azulejo_core::Result<f64>) -> azulejo_core::Result<f64> {
    match figure {
        Err(Error::InvalidArgument { argument: "size", .. }) => Ok(-1.0),
        other => other,
    }
}

/// The radial curves of the power spectrum of points of a cuboid, as azulejo_spectrum_create and
/// azulejo_spectrum_radial, with frequencies in units of cbrt(count / volume).
///
/// frequency_reach: the largest frequency, above 0. For each point there are 8 * (frequency_reach /
/// frequency_stride)^3 of them, 25 bytes each: AZULEJO_ERROR_TOO_LARGE if memory is short.
///
/// out_count: at most frequency_reach / width + 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_spectrum(
    context: *const azulejo_context,
    set: *const azulejo_space_set,
    frequency_reach: f64,
    frequency_stride: u32,
    width: f64,
    annuli: *mut azulejo_annulus,
    capacity: usize,
    annulus_size: usize,
    out_count: *mut usize,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let annuli = unsafe { Annuli::new(annuli, capacity, annulus_size, out_count) }?;
        // SAFETY: handed on from the caller.
        let set = unsafe { SpaceSet::read(context, set) }?;
        let stride = frequency_stride as usize;
        annuli.write(set.run(|context, domain, points, progress| {
            radial_power_3d(context, domain, points, frequency_reach, stride, width, progress)
        })?);
        Ok(())
    })
}

/// The power of points of a cuboid on an axis of frequencies, 1 for a Poisson process. Planes
/// across the axis, such as faces of blocks, show here and not in the radial mean.
///
/// axis: 0 to 2. out: the power at 1, 2, ... `count` waves along this side. count: 1 to 65536.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_axis_power(
    context: *const azulejo_context,
    set: *const azulejo_space_set,
    axis: u32,
    count: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        if count > 0 {
            check_pointer("out", out.cast_const())?;
        }
        // SAFETY: handed on from the caller.
        let set = unsafe { SpaceSet::read(context, set) }?;
        let power = set.run(|context, domain, points, progress| {
            axis_power(context, domain, points, axis as usize, count, progress)
        })?;
        // SAFETY: one number for each of the caller's frequencies.
        unsafe { boundary::write(out, &power) };
        Ok(())
    })
}

/// Frees the spectrum.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_spectrum_free(spectrum: *mut azulejo_spectrum) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("spectrum", spectrum) };
}
