//! What pages say of a goal.

/// Whether a goal is met.
pub fn verdict(is_met: bool) -> &'static str {
    if is_met { "met" } else { "**not met**" }
}
