//! The order of samples.

use azulejo_core::Order;

use crate::status::Failure;

/// In no particular order.
pub const AZULEJO_ORDER_ANY: u32 = 0;
/// Coarse to fine: the first points, any number, are a sparser set of the same kind.
pub const AZULEJO_ORDER_PROGRESSIVE: u32 = 1;

/// The order that a constant stands for.
pub(crate) fn order(order: u32) -> Result<Order, Failure> {
    match order {
        AZULEJO_ORDER_ANY => Ok(Order::Any),
        AZULEJO_ORDER_PROGRESSIVE => Ok(Order::Progressive),
        other => Err(Failure::invalid("order", format!("{other} is no AZULEJO_ORDER_ constant"))),
    }
}
