//! Spectra of sets in the plane and in space, and what takes their place on meshes.

use azulejo_core::Error;
use azulejo_core::analysis::differential::{self, surface_differences};
use azulejo_core::analysis::spectrum::{Annulus, Periodogram, axis_power, radial_power_3d, sparse_periodogram};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::analysis::{MeasuredSet, PlaneSet};
use crate::argument::{callable, maybe_pair, maybe_triple, natural, real, whole};
use crate::array::{Array, line, table};
use crate::error::{invalid, raised, raised_as};
use crate::frame::Positions;
use crate::mesh::Mesh;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

/// The power spectrum of points of the plane, by fast Fourier transform in double arithmetic.
///
/// positions: the points, float32, shape (n, 2).
/// size: the number of frequencies per side, 2 to 4096; the lowest are -(size // 2) steps of 1 / width and 1 / height.
/// frequency_stride: 1 takes all frequencies; k, up to 4096, every k-th along both axes.
/// domain_min, domain_max, boundary, threads, progress: as in plane_smallest_distance.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Spectrum {
    periodogram: Periodogram,
}

report! {
    /// The figures of a spectrum.
    SpectrumReport {
        /// The distance of neighbouring frequencies along both axes, in units of sqrt(count / area).
        frequency_step: [f64; 2],
        /// Below this frequency there is almost no power (Heck et al. 2013); None if the spectrum is too small to tell.
        effective_nyquist: Option<f64>,
        /// The variation of the power above it; None likewise.
        oscillation: Option<f64>,
        /// The variation of the power within annuli.
        contrast: f64,
        /// The highest power in the range over the mean of its annulus; 0 for none.
        peak: f64,
        /// Its frequency, in units of sqrt(count / area).
        peak_frequency: [f64; 2],
    }
}

#[pymethods]
impl Spectrum {
    #[new]
    #[pyo3(signature = (
        positions, size, frequency_stride=1, *, domain_min=None, domain_max=None, boundary=None, threads=0,
        progress=None
    ))]
    fn new(
        py: Python<'_>,
        positions: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = whole::size)] size: i128,
        #[pyo3(from_py_with = whole::frequency_stride)] frequency_stride: i128,
        #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
        #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
        boundary: Option<&str>,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
        let (size, stride) = (natural("size", size)?, natural("frequency_stride", frequency_stride)?);
        let periodogram = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
            sparse_periodogram(context, domain, points, size, stride, progress)
        })?;
        Ok(Self { periodogram })
    }

    /// The mean of spectra of one size; noise fades with the square root of their number.
    #[staticmethod]
    fn mean(spectra: Vec<PyRef<'_, Self>>) -> PyResult<Self> {
        let periodograms: Vec<_> = spectra.iter().map(|spectrum| spectrum.periodogram.clone()).collect();
        Ok(Self {
            periodogram: Periodogram::mean(&periodograms)
                .map_err(|error| raised_as(error, "periodograms", "spectra"))?,
        })
    }

    /// The number of frequencies per side.
    #[getter]
    fn size(&self) -> usize {
        self.periodogram.size()
    }

    /// A copy of the power, float32, shape (size, size); frequency 0, whose power is set to 0, is at [size // 2, size // 2].
    #[getter]
    fn power(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        let size = self.periodogram.size();
        Ok(line(py, self.periodogram.power().to_vec()).bind(py).reshape([size, size])?.unbind())
    }

    /// The radial curves: frequency in units of sqrt(count / area), mean power, anisotropy, and the number of frequencies
    /// in each annulus.
    ///
    /// width: of an annulus, above 0, in units of sqrt(count / area).
    ///
    /// Returns float64, shape (a, 4).
    #[pyo3(signature = (width=0.05))]
    fn radial(&self, py: Python<'_>, #[pyo3(from_py_with = real::width)] width: f64) -> PyResult<Py<PyArray2<f64>>> {
        curves(py, self.periodogram.radial(width).map_err(raised)?)
    }

    /// Measures the spectrum.
    ///
    /// width: of the annuli of the radial mean, above 0. low, high: the range of frequencies for contrast and peak.
    /// All in units of sqrt(count / area).
    fn measure(&self, low: f64, high: f64, width: f64) -> PyResult<SpectrumReport> {
        for (argument, frequency) in [("low", low), ("high", high)] {
            if !frequency.is_finite() {
                return Err(invalid(argument, format!("{frequency} is not a finite number")));
            }
        }
        let of = &self.periodogram;
        let peak = of.highest_peak(width, low..high).map_err(raised)?;
        Ok(SpectrumReport {
            frequency_step: of.frequency_step(),
            effective_nyquist: unless_too_small(of.effective_nyquist(width))?,
            oscillation: unless_too_small(of.oscillation(width))?,
            contrast: of.contrast(width, low..high).map_err(raised)?,
            peak: peak.map_or(0.0, |peak| peak.over_mean),
            peak_frequency: peak.map_or([0.0; 2], |peak| peak.frequency),
        })
    }
}

fn curves(py: Python<'_>, annuli: Vec<Annulus>) -> PyResult<Py<PyArray2<f64>>> {
    let row = |Annulus { count, frequency, power, anisotropy }| [frequency, power, anisotropy, count as f64];
    table(py, annuli.into_iter().map(row).collect())
}

/// The radial curves of the power spectrum of points of a cuboid: frequency in units of cbrt(count / volume), mean power,
/// anisotropy, and the number of frequencies in each shell.
///
/// frequency_reach: the largest frequency, above 0. For each point there are 8 * (frequency_reach / frequency_stride)**3
/// frequencies, which take 25 bytes each.
/// frequency_stride: 1 takes all frequencies; k, up to 4096, every k-th along the axes.
/// width: of a shell, above 0, in units of cbrt(count / volume). The others are those of space_coverage.
///
/// Returns float64, shape (a, 4).
#[pyfunction]
#[pyo3(signature = (
    positions, frequency_reach, frequency_stride=1, *, width=0.05, domain_min=None, domain_max=None, boundary=None,
    threads=0, progress=None
))]
pub(crate) fn space_spectrum(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::frequency_reach)] frequency_reach: f64,
    #[pyo3(from_py_with = whole::frequency_stride)] frequency_stride: i128,
    #[pyo3(from_py_with = real::width)] width: f64,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArray2<f64>>> {
    let set = MeasuredSet::in_space(positions, domain_min, domain_max, boundary)?;
    let stride = natural("frequency_stride", frequency_stride)?;
    let annuli = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        radial_power_3d(context, domain, points, frequency_reach, stride, width, progress)
    })?;
    curves(py, annuli)
}

/// The power of points of a cuboid on an axis of frequencies, 1 for a Poisson process: at 1, 2, ... count waves along a side
/// of the cuboid. Planes across the axis, such as faces of blocks, show here and not in the radial mean.
///
/// axis: 0 to 2. count: 1 to 65536. The others are those of space_coverage.
///
/// Returns float64, shape (count,).
#[pyfunction]
#[pyo3(signature = (
    positions, axis, count, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn space_axis_power(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole::axis)] axis: i128,
    #[pyo3(from_py_with = whole::count)] count: i128,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArray1<f64>>> {
    let set = MeasuredSet::in_space(positions, domain_min, domain_max, boundary)?;
    let (axis, count) = (natural("axis", axis)?, natural("count", count)?);
    let power = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        axis_power(context, domain, points, axis, count, progress)
    })?;
    Ok(line(py, power))
}

fn unless_too_small(figure: Result<f64, Error>) -> PyResult<Option<f64>> {
    match figure {
        Err(Error::InvalidArgument { argument: "size", .. }) => Ok(None),
        other => other.map(Some).map_err(raised),
    }
}

/// The distribution p(d) of the differences of all pairs of samples on a mesh (Wei and Wang 2011), which takes the place of
/// the spectrum. Lengths are in mean spacings, sqrt(area / count).
///
/// mesh: a Mesh. positions, normals: of the samples, float32, shape (n, 3), n at least 2, as in Points.
/// direction: three numbers; its projection on the tangent plane is the x axis of the differences. Default: (1, 0, 0).
/// seed: 0 to 2**64 - 1, of the random points that the pairs are compared with.
/// threads, progress: as in plane_smallest_distance.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Differences {
    differences: differential::Differences,
}

#[pymethods]
impl Differences {
    #[new]
    #[pyo3(signature = (mesh, positions, normals, direction=None, *, seed=0, threads=0, progress=None))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
        positions: &Bound<'_, PyAny>,
        normals: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = maybe_triple::direction)] direction: Option<[f64; 3]>,
        #[pyo3(from_py_with = whole::seed)] seed: i128,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let positions = Positions::read("positions", positions)?.around(mesh.shared.origin())?;
        let normals = Array::read("normals", normals)?;
        let (positions, normals) = (positions.get()?, normals.rows()?);
        let (seed, direction) = (natural("seed", seed)?, direction.unwrap_or([1.0, 0.0, 0.0]));
        let differences = Watch::new(py, threads, progress)?.run(|context, progress| {
            surface_differences(context, &mesh.shared, positions, normals, direction, seed, progress)
        })?;
        Ok(Self { differences })
    }

    /// The differences of sets of one kind together; noise fades with the square root of their number.
    #[staticmethod]
    fn mean(differences: Vec<PyRef<'_, Self>>) -> PyResult<Self> {
        let all: Vec<_> = differences.iter().map(|one| one.differences.clone()).collect();
        Ok(Self { differences: differential::Differences::together(&all).map_err(raised)? })
    }

    /// p(d), float64, shape (128, 128), from -4 to 4 mean spacings along both axes.
    #[getter]
    fn density(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let size = [differential::GRID_SIZE; 2];
        Ok(line(py, self.differences.density()).bind(py).reshape(size)?.unbind())
    }

    /// The radial mean of p(d), float64, shape (512,), from 0 to 8 mean spacings.
    #[getter]
    fn radial(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        line(py, self.differences.radial().iter().map(|shell| shell.density).collect())
    }

    /// The radial mean of the power spectrum, 1 for a Poisson process: float64, shape (k,).
    ///
    /// frequencies: float64, shape (k,), from -32 to 32, in units of one over the mean spacing.
    fn power(&self, py: Python<'_>, frequencies: &Bound<'_, PyAny>) -> PyResult<Py<PyArray1<f64>>> {
        let frequencies = Array::read("frequencies", frequencies)?;
        let frequencies = frequencies.line()?;
        if let Some(frequency) = frequencies.iter().find(|frequency| !(-32.0..=32.0).contains(*frequency)) {
            return Err(invalid("frequencies", format!("{frequency} is not in -32 to 32")));
        }
        Ok(line(py, py.detach(|| self.differences.power(frequencies))))
    }
}
