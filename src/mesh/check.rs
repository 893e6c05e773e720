//! What is refused in a mesh.

use crate::error::{Error, Result};

/// Refuses vectors that are not finite. `item` is what one of them belongs to.
pub(super) fn check_finite(argument: &'static str, item: &str, vectors: &[[f32; 3]]) -> Result<()> {
    match vectors.iter().position(|vector| vector.iter().any(|x| !x.is_finite())) {
        None => Ok(()),
        Some(index) => {
            let [x, y, z] = vectors[index];
            Err(Error::invalid(argument, format!("{item} {index} is ({x}, {y}, {z}), not finite")))
        }
    }
}

/// Refuses triangles that name what is not there.
pub(super) fn check_indices(
    argument: &'static str,
    item: &str,
    items: &str,
    triangles: &[[u32; 3]],
    count: usize,
) -> Result<()> {
    // The largest of all, first: that is a vector loop.
    let largest = triangles.as_flattened().iter().copied().max();
    if largest.is_none_or(|index| (index as usize) < count) {
        return Ok(());
    }
    for (number, triangle) in triangles.iter().enumerate() {
        if let Some(index) = triangle.iter().find(|&&index| index as usize >= count) {
            let reason = format!("triangle {number} names {item} {index}, but there are {count} {items}");
            return Err(Error::invalid(argument, reason));
        }
    }
    Ok(())
}
