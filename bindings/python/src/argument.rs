//! Arguments that are no arrays: whole numbers, and names for the constants of C.

use azulejo_core::Order;
use pyo3::prelude::*;

use crate::error::invalid;

/// A whole number of the range that the library takes. Python's have no bounds; what exceeds 128 bits is Python's
/// error.
pub(crate) fn natural<T: TryFrom<i128>>(argument: &str, value: i128) -> PyResult<T> {
    value.try_into().map_err(|_| {
        let bits = 8 * size_of::<T>();
        invalid(argument, format!("{value} is not a whole number from 0 to 2**{bits} - 1"))
    })
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
