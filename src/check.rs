//! Checks of arguments that several calls have in common. Each names the argument, its value and what it should be.

use std::fmt::Display;
use std::ops::RangeInclusive;

use crate::error::{Error, Result};

/// Refuses a number that is not positive and finite.
pub fn positive(argument: &'static str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(Error::invalid(argument, format!("{value} is not a positive finite number")))
    }
}

/// Refuses a number that is negative or not finite.
pub fn from_zero(argument: &'static str, value: f64) -> Result<()> {
    if (0.0..f64::INFINITY).contains(&value) {
        Ok(())
    } else {
        Err(Error::invalid(argument, format!("{value} is not a finite number from 0 on")))
    }
}

/// Refuses a radius that is not a positive finite number.
pub fn radius(radius: f64) -> Result<()> {
    positive("radius", radius)
}

/// Refuses a number out of range.
pub fn range<T: PartialOrd + Display>(argument: &'static str, value: T, range: RangeInclusive<T>) -> Result<()> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(Error::invalid(argument, format!("{value} is not in {}..={}", range.start(), range.end())))
    }
}

/// Refuses vectors that are not finite; `item` is the name of one of them, or "" where the argument says it.
pub fn finite<const D: usize>(argument: &'static str, item: &str, vectors: &[[f32; D]]) -> Result<()> {
    match vectors.iter().position(|vector| !vector.iter().all(|x| x.is_finite())) {
        None => Ok(()),
        Some(index) => {
            let place = if item.is_empty() { format!("[{index}]") } else { format!("{item} {index}") };
            Err(Error::invalid(argument, format!("{place} is {:?}, not finite", vectors[index])))
        }
    }
}

/// Refuses triangles whose corners name none of `count` items, such as vertices; `item` and `items` are the names of
/// one and of several of them.
pub fn corners(argument: &'static str, item: &str, items: &str, triangles: &[[u32; 3]], count: usize) -> Result<()> {
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

/// Refuses numbers of triangles (`triangles`) that a mesh of `count` does not have.
pub fn triangles(triangles: &[u32], count: usize) -> Result<()> {
    match triangles.iter().position(|&triangle| triangle as usize >= count) {
        None => Ok(()),
        Some(i) => Err(Error::invalid("triangles", format!("[{i}] is {}, and the mesh has {count}", triangles[i]))),
    }
}

/// The distance outside of a triangle at which barycentrics may be, by rounding.
const ROUNDING: f64 = 1e-6;

/// Refuses places (`barycentrics`) outside of a triangle.
pub fn barycentrics(barycentrics: &[[f32; 2]]) -> Result<()> {
    // The comparison fails for NaN too.
    let is_outside = |&[u, v]: &[f32; 2]| {
        ![u.into(), v.into(), 1.0 - f64::from(u) - f64::from(v)].iter().all(|&x: &f64| x >= -ROUNDING)
    };
    match barycentrics.iter().position(is_outside) {
        None => Ok(()),
        Some(i) => {
            let [u, v] = barycentrics[i];
            Err(Error::invalid("barycentrics", format!("[{i}] is ({u}, {v}), outside the triangle")))
        }
    }
}

/// Refuses more than 2^32 - 1 items, which could not be indexed.
pub fn indexable(argument: &'static str, items: &str, count: usize) -> Result<()> {
    if count <= u32::MAX as usize {
        Ok(())
    } else {
        Err(Error::too_large(argument, format!("{count} {items}; the limit is {}", u32::MAX)))
    }
}

/// The least number of float spacings of a radius: a tolerance of a few spacings is then a small part of it.
const FINEST_RADIUS: f64 = 64.0;

/// The smallest radius that floats of this spacing carry.
pub fn finest_radius(spacing: f64) -> f64 {
    FINEST_RADIUS * spacing
}

/// Refuses a radius below 64 times the spacing of floats at a place, such as "the largest coordinate of the mesh".
pub fn resolution(argument: &'static str, radius: f64, spacing: f64, place: &str) -> Result<()> {
    let finest = finest_radius(spacing);
    if radius >= finest {
        return Ok(());
    }
    let reason = format!(
        "{radius:?} is below {finest:?}, {FINEST_RADIUS} times the float spacing {spacing:?} at {place}; move it nearer to \
         the origin, or take a larger radius"
    );
    Err(Error::invalid(argument, reason))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_the_argument_its_value_and_the_range() {
        let said = |result: Result<()>| result.unwrap_err().to_string();
        assert_eq!(said(positive("reach", 0.0)), "reach: 0 is not a positive finite number");
        assert_eq!(said(radius(f64::INFINITY)), "radius: inf is not a positive finite number");
        assert_eq!(said(from_zero("factor", f64::NAN)), "factor: NaN is not a finite number from 0 on");
        assert_eq!(said(range("bins", 9, 1..=8)), "bins: 9 is not in 1..=8");
        assert_eq!(
            said(finite("positions", "point", &[[0.0, 1.0], [f32::NAN, 2.0]])),
            "positions: point 1 is [NaN, 2.0], not finite"
        );
        let named = corners("indices", "vertex", "vertices", &[[0, 1, 2], [2, 3, 1]], 3);
        assert_eq!(said(named), "indices: triangle 1 names vertex 3, but there are 3 vertices");
        assert_eq!(said(triangles(&[0, 7], 7)), "triangles: [1] is 7, and the mesh has 7");
        assert_eq!(
            said(indexable("positions", "points", 1 << 32)),
            "positions: 4294967296 points; the limit is 4294967295"
        );
        let coarse = resolution("radius", 1.0, 0.5, "the largest coordinate");
        let expected = "radius: 1.0 is below 32.0, 64 times the float spacing 0.5 at the largest coordinate; move it nearer \
                        to the origin, or take a larger radius";
        assert_eq!(said(coarse), expected);
        assert_eq!(
            said(barycentrics(&[[0.0, 1.0], [0.5, 0.6]])),
            "barycentrics: [1] is (0.5, 0.6), outside the triangle"
        );
        assert!(barycentrics(&[[f32::NAN, 0.0]]).is_err() && barycentrics(&[[-1e-5, 0.5]]).is_err());
    }

    #[test]
    fn what_is_in_range_passes() {
        let all = [
            positive("a", f64::MIN_POSITIVE),
            from_zero("a", 0.0),
            range("a", 1, 1..=1),
            finite::<2>("a", "point", &[[f32::MAX, -0.0]]),
            corners("a", "vertex", "vertices", &[[0, 1, 2]], 3),
            triangles(&[6], 7),
            indexable("a", "points", u32::MAX as usize),
            resolution("radius", 32.0, 0.5, "a place"),
            barycentrics(&[[0.0, 0.0], [1.0, 0.0], [0.3, 0.7], [-1e-7, 1.0]]),
        ];
        assert!(all.iter().all(Result::is_ok));
    }
}
