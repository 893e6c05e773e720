//! Arguments that are no arrays: whole numbers, and names for the constants of C.

use azulejo_core::Order;
use azulejo_core::volume::Amount;
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::error::invalid;

/// A type of arguments that are converted here, with their names in the errors. PyO3's errors have them in notes, which
/// Python has from 3.11 on and which few programs show.
pub(crate) trait Named: Sized {
    /// In messages, after "is not".
    const WHAT: &str;

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self>;
}

impl Named for f64 {
    const WHAT: &str = "a real number";

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        object.extract()
    }
}

impl Named for i128 {
    const WHAT: &str = "a whole number (an int)";

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        object.extract()
    }
}

impl Named for bool {
    const WHAT: &str = "True or False";

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        object.extract()
    }
}

impl<const N: usize> Named for [f64; N] {
    const WHAT: &str = if N == 2 { "two numbers" } else { "three numbers" };

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        object.extract()
    }
}

/// A callable.
impl Named for Py<PyAny> {
    const WHAT: &str = "callable";

    fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if object.is_callable() { Ok(object.clone().unbind()) } else { Err(PyTypeError::new_err("")) }
    }
}

/// The longest part of a value that a message shows.
const SHOWN: usize = 40;

fn named<T: Named>(argument: &str, object: &Bound<'_, PyAny>) -> PyResult<T> {
    T::of(object).map_err(|error| {
        let py = object.py();
        let shown = object.repr().map_or_else(|_| "it".into(), |text| text.to_string());
        let shown = match shown.char_indices().nth(SHOWN) {
            Some((end, _)) => format!("{}...", &shown[..end]),
            None => shown,
        };
        if error.is_instance_of::<PyOverflowError>(py) {
            return invalid(argument, format!("{shown} is out of range"));
        }
        // A list of another length is of the right type.
        let message = format!("{argument}: {shown} is not {}", T::WHAT);
        if error.is_instance_of::<PyValueError>(py) {
            PyValueError::new_err(message)
        } else {
            PyTypeError::new_err(message)
        }
    })
}

fn named_or_none<T: Named>(argument: &str, object: &Bound<'_, PyAny>) -> PyResult<Option<T>> {
    if object.is_none() { Ok(None) } else { named(argument, object).map(Some) }
}

/// An amount, of which None is none.
fn or_zero<T: Named + Default>(argument: &str, object: &Bound<'_, PyAny>) -> PyResult<T> {
    Ok(named_or_none(argument, object)?.unwrap_or_default())
}

macro_rules! arguments {
    ($($module:ident: $type:ty = $convert:expr => $($name:ident)*;)*) => {
        $(pub(crate) mod $module {
            use super::*;
            $(pub(crate) fn $name(object: &Bound<'_, PyAny>) -> PyResult<$type> {
                $convert(stringify!($name), object)
            })*
        })*
    };
}

// For `from_py_with`: a function for each argument, which knows its name.
arguments! {
    real: f64 = named => factor frequency_reach highest leaf_size radius reach sigma thickness tolerance width;
    amount: f64 = or_zero => count radius;
    whole: i128 = named => axis bins channels count depth frequency_stride height iterations levels max_iterations probes seed size threads width;
    number: i128 = or_zero => count;
    truth: bool = named => maximal;
    maybe_real: Option<f64> = named_or_none => attraction_radius coarsest conflict_radius cosine decay quotient radius step tolerance;
    maybe_whole: Option<i128> = named_or_none => iterations neighbours;
    pair: [f64; 2] = named => window_max window_min;
    maybe_pair: Option<[f64; 2]> = named_or_none => centre domain_max domain_min max min;
    maybe_triple: Option<[f64; 3]> = named_or_none => centre direction domain_max domain_min max min;
    callable: Option<Py<PyAny>> = named_or_none => progress;
    called: Py<PyAny> = named => visit;
}

/// A whole number of the range that the library takes. Python's have no bounds; what exceeds 128 bits is Python's
/// error.
pub(crate) fn natural<T: TryFrom<i128>>(argument: &str, value: i128) -> PyResult<T> {
    value.try_into().map_err(|_| {
        let bits = 8 * size_of::<T>();
        invalid(argument, format!("{value} is not a whole number from 0 to 2**{bits} - 1"))
    })
}

/// Refuses a radius and a count that are both 0; and a radius beyond all there is, of these sides, which was meant for a
/// count most of the time.
pub(crate) fn one_of(radius: f64, count: i128, sides: impl IntoIterator<Item = f64>, what: &str) -> PyResult<()> {
    if radius == 0.0 && count == 0 {
        return Err(invalid("radius", "0, and so is count: give one of them"));
    }
    let diagonal = sides.into_iter().map(|side| side * side).sum::<f64>().sqrt();
    if count == 0 && diagonal > 0.0 && radius > diagonal {
        let number = if radius.is_finite() { format!("{radius:.0}") } else { "n".to_owned() };
        let reason = format!(
            "{radius:?} is more than the diagonal of the {what}, {diagonal:.4}; a number of samples is count={number}"
        );
        return Err(invalid("radius", reason));
    }
    Ok(())
}

/// The amount that a radius and a count ask for, one of which is 0.
pub(crate) fn amount_of(radius: f64, count: i128) -> PyResult<Amount> {
    match natural("count", count)? {
        0 => Ok(Amount::Radius(radius)),
        _ if radius != 0.0 => Err(invalid("count", format!("{count}, and radius {radius}; one of them must be 0"))),
        count => Ok(Amount::Count(count)),
    }
}

/// The value that one of several names stands for.
pub(crate) fn choice<T: Copy>(argument: &str, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    match choices.iter().find(|&&(choice, _)| choice == name) {
        Some(&(_, value)) => Ok(value),
        None => {
            let names: Vec<_> = choices.iter().map(|(choice, _)| format!("{choice:?}")).collect();
            Err(invalid(argument, format!("{name:?} is none of {}", names.join(", "))))
        }
    }
}

/// `order`; what belongs to progressive order is refused in any other.
pub(crate) fn order(name: &str, of_progressive: &[(&str, Option<f64>)]) -> PyResult<Order> {
    let order = choice("order", name, &[("any", Order::Any), ("progressive", Order::Progressive)])?;
    match of_progressive.iter().find(|(_, value)| order == Order::Any && value.is_some()) {
        Some((argument, _)) => Err(invalid(argument, "is of progressive order only")),
        None => Ok(order),
    }
}
