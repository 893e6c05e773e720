//! Samples that the caller gives, around which a set is made.

use azulejo_core::Given;

use crate::boundary::rows;
use crate::status::Failure;

/// The given samples of options: positions, clearances or NULL, and their count.
///
/// # Safety
/// Unless the checks fail, `positions` leads to `count` rows and `clearances`, unless it is NULL, to `count` numbers, which
/// are not changed during `'a`.
pub(crate) unsafe fn given<'a, const AXES: usize>(
    positions: *const f32,
    clearances: *const f64,
    count: usize,
) -> Result<Given<'a, AXES>, Failure> {
    // SAFETY: handed on from the caller.
    unsafe {
        let positions = rows::<f32, AXES>("given_positions", positions, "given_count", count)?;
        let clearances = match clearances.is_null() {
            true => None,
            false => Some(rows::<f64, 1>("given_clearances", clearances, "given_count", count)?.as_flattened()),
        };
        Ok(Given { positions, clearances })
    }
}

/// The same for a set of several classes, where each given sample has a row of clearances, one for each class.
///
/// # Safety
/// As [`given`], with `count * classes` clearances.
pub(crate) unsafe fn given_by_class<'a, const AXES: usize>(
    positions: *const f32,
    clearances: *const f64,
    count: usize,
    classes: usize,
) -> Result<Given<'a, AXES>, Failure> {
    // SAFETY: handed on from the caller; a product that is too large is refused.
    unsafe {
        let given = given::<AXES>(positions, std::ptr::null(), count)?;
        if clearances.is_null() {
            return Ok(given);
        }
        let clearances = rows::<f64, 1>("given_clearances", clearances, "given_count", count.saturating_mul(classes))?;
        Ok(Given { clearances: Some(clearances.as_flattened()), ..given })
    }
}
