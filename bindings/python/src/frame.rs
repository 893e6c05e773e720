//! Coordinates in the caller's frame, which may lie far from the origin, as floats that do not.

use azulejo_core::{Boundary, Centred, Domain};
use numpy::{Element, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::argument::choice;
use crate::array::{Array, table};
use crate::points::{Place, Points};

/// The times that coordinates may exceed the extent before floats displace doubles by more than a millionth of it.
const FAR_OF_DOUBLES: f64 = 16.0;

/// The times that coordinates of a domain may exceed its extent. Samples are made as floats and not displaced, but where
/// floats are coarse there are only small sets.
const FAR: f64 = 1024.0;

const BOUNDARIES: [(&str, Boundary); 2] = [("periodic", Boundary::Periodic), ("bounded", Boundary::Bounded)];

/// Positions as a caller gives them.
pub(crate) enum Positions<'py> {
    /// Floats, or what the library takes for them.
    Floats(Array<'py, f32>),
    /// Numbers of any other type.
    Doubles(Array<'py, f64>),
    /// Points of the library, by their floats and origin.
    Points(Bound<'py, Points>),
}

/// Rows of floats: read in place, or made.
pub(crate) enum Rows<'py, const N: usize> {
    InPlace(Array<'py, f32>),
    Made(Vec<[f32; N]>),
}

impl<const N: usize> Rows<'_, N> {
    pub(crate) fn get(&self) -> PyResult<&[[f32; N]]> {
        match self {
            Self::InPlace(array) => array.rows(),
            Self::Made(rows) => Ok(rows),
        }
    }
}

impl<'py> Positions<'py> {
    pub(crate) fn read(argument: &'static str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(points) = object.cast::<Points>() {
            return Ok(Self::Points(points.clone()));
        }
        let object = crate::array::as_array(argument, object)?;
        let dtype = object.getattr("dtype")?;
        let kind: String = dtype.getattr("kind")?.extract()?;
        if kind == "f" && dtype.getattr("itemsize")?.extract::<usize>()? <= size_of::<f32>() {
            Ok(Self::Floats(Array::read(argument, &object)?))
        } else {
            Ok(Self::Doubles(Array::read(argument, &object)?))
        }
    }

    /// The shape of the array.
    pub(crate) fn shape(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        match self {
            Self::Floats(array) => Ok(array.shape().to_vec()),
            Self::Doubles(array) => Ok(array.shape().to_vec()),
            Self::Points(points) => points.get().local_positions.bind(py).getattr("shape")?.extract(),
        }
    }

    /// The positions near an origin that is found for them, as [`Centred::of`] does, and how far rounding moved one.
    pub(crate) fn centred<const N: usize>(self) -> PyResult<(Rows<'py, N>, [f64; N], f64)> {
        match self {
            Self::Floats(array) => {
                array.rows::<N>()?;
                Ok((Rows::InPlace(array), [0.0; N], 0.0))
            }
            Self::Doubles(array) => {
                let Centred { positions, origin, rounding, .. } = Centred::of(array.rows::<N>()?);
                Ok((Rows::Made(positions), origin, rounding))
            }
            Self::Points(points) => {
                let origin = points.get().origin(points.py())?;
                Ok((points.get().local(points.py())?, origin, 0.0))
            }
        }
    }

    /// The positions relative to an origin.
    pub(crate) fn around<const N: usize>(self, origin: [f64; N]) -> PyResult<Rows<'py, N>> {
        let doubles = match self {
            Self::Floats(array) if origin == [0.0; N] => {
                array.rows::<N>()?;
                return Ok(Rows::InPlace(array));
            }
            Self::Points(points) if points.get().origin(points.py())? == origin => {
                return points.get().local(points.py());
            }
            Self::Floats(array) => array.rows::<N>()?.iter().map(|row| row.map(f64::from)).collect(),
            Self::Points(points) => {
                in_doubles(points.get().local::<N>(points.py())?.get()?, points.get().origin(points.py())?)
            }
            Self::Doubles(array) => return Ok(Rows::Made(Centred::around(array.rows::<N>()?, origin).positions)),
        };
        Ok(Rows::Made(Centred::around(&doubles, origin).positions))
    }

    /// True if the positions are doubles that floats do not hold.
    fn are_rounded(&self) -> bool {
        match self {
            Self::Floats(_) => false,
            Self::Doubles(array) => array.entries().iter().any(|&x| f64::from(x as f32) != x && x.is_finite()),
            Self::Points(points) => points.get().has_origin,
        }
    }
}

/// Floats in the caller's frame.
pub(crate) fn in_doubles<const N: usize>(rows: &[[f32; N]], origin: [f64; N]) -> Vec<[f64; N]> {
    rows.iter().map(|row| std::array::from_fn(|axis| origin[axis] + f64::from(row[axis]))).collect()
}

/// Floats as an array in the caller's frame: as they are for an origin of 0, and in doubles for any other.
pub(crate) fn in_frame<const N: usize>(local: &Bound<'_, PyArray2<f32>>, origin: [f64; N]) -> PyResult<Py<PyAny>> {
    if origin == [0.0; N] {
        return Ok(local.clone().into_any().unbind());
    }
    let rows = local.try_readonly()?;
    let rows = rows.as_slice()?.as_chunks().0;
    Ok(table(local.py(), in_doubles(rows, origin))?.into_any())
}

/// New floats as an array in the caller's frame.
pub(crate) fn framed<const N: usize>(py: Python<'_>, rows: Vec<[f32; N]>, origin: [f64; N]) -> PyResult<Py<PyAny>>
where
    f32: Element,
{
    in_frame(table(py, rows)?.bind(py), origin)
}

/// The arguments `domain_min`, `domain_max` and `boundary`: a domain in the caller's frame, and the origin that the
/// library's positions in it are relative to.
#[derive(Clone, Copy)]
pub(crate) struct Frame<const N: usize = 2> {
    /// In the caller's frame.
    pub(crate) whole: Domain<N>,
    /// Relative to the origin.
    pub(crate) domain: Domain<N>,
    pub(crate) origin: [f64; N],
}

impl<const N: usize> Frame<N> {
    /// The domain of samples that are to be made.
    pub(crate) fn new(min: Option<[f64; N]>, max: Option<[f64; N]>, boundary: &str) -> PyResult<Self> {
        let unit = Domain::unit(choice("boundary", boundary, &BOUNDARIES)?);
        Ok(Self::of(Domain { min: min.unwrap_or(unit.min), max: max.unwrap_or(unit.max), ..unit }, FAR))
    }

    fn of(whole: Domain<N>, ratio: f64) -> Self {
        let (domain, origin) = whole.centred(ratio);
        Self { whole, domain, origin }
    }

    /// The domain of samples that are relative to an origin.
    pub(crate) fn with_origin(min: [f64; N], max: [f64; N], boundary: &str, origin: [f64; N]) -> PyResult<Self> {
        let whole = Domain { min, max, boundary: choice("boundary", boundary, &BOUNDARIES)? };
        Ok(Self { whole, domain: whole.relative_to(origin), origin })
    }

    /// A place of the caller's.
    pub(crate) fn local(&self, place: [f64; N]) -> [f64; N] {
        relative(place, self.origin)
    }

    /// The domain as text.
    pub(crate) fn shown(&self) -> String {
        let Domain { min, max, .. } = self.whole;
        format!("{min:?} to {max:?}, {}", self.boundary())
    }

    /// The name of the boundary.
    pub(crate) fn boundary(&self) -> &'static str {
        BOUNDARIES.iter().find(|(_, boundary)| *boundary == self.whole.boundary).expect("both have names").0
    }
}

impl<const N: usize> Frame<N> {
    /// The domain of positions that there are, `own` by its place: by default that of Points, if they have one.
    pub(crate) fn around(
        positions: &Positions,
        own: fn(Place) -> Option<Self>,
        min: Option<[f64; N]>,
        max: Option<[f64; N]>,
        boundary: Option<&str>,
    ) -> PyResult<Self> {
        let own = match positions {
            Positions::Points(points) => own(points.get().place),
            _ => None,
        };
        let usual = own.map_or(Domain::unit(Boundary::Periodic), |frame| frame.whole);
        let boundary = boundary.map(|name| choice("boundary", name, &BOUNDARIES)).transpose()?;
        let domain = Domain {
            min: min.unwrap_or(usual.min),
            max: max.unwrap_or(usual.max),
            boundary: boundary.unwrap_or(usual.boundary),
        };
        match own {
            Some(frame) if (domain.min, domain.max) == (frame.whole.min, frame.whole.max) => {
                Ok(Self { domain: Domain { boundary: domain.boundary, ..frame.domain }, whole: domain, ..frame })
            }
            _ => Ok(Self::of(domain, if positions.are_rounded() { FAR_OF_DOUBLES } else { FAR })),
        }
    }
}

/// A place relative to an origin.
pub(crate) fn relative<const N: usize>(place: [f64; N], origin: [f64; N]) -> [f64; N] {
    std::array::from_fn(|axis| place[axis] - origin[axis])
}
