//! Points as little-endian 32-bit floats and nothing else.

use super::set::{Columns, NAMES, PointSet};

/// The points, each of `dimensions` floats: 2 or 3.
pub fn parse(bytes: &[u8], dimensions: u8) -> Result<PointSet, String> {
    let (dimensions, size) = (usize::from(dimensions), 4 * usize::from(dimensions));
    if !bytes.len().is_multiple_of(size) {
        return Err(format!("{} bytes are not whole points of {dimensions} floats", bytes.len()));
    }
    let columns = Columns::find(|name| NAMES[..dimensions].iter().position(|known| *known == name));
    let mut set = columns.expect("x and y are there").empty_set();
    for (number, point) in bytes.chunks_exact(size).enumerate() {
        let mut numbers = [0.0; NAMES.len()];
        for (x, bytes) in numbers.iter_mut().zip(point.as_chunks().0) {
            *x = f32::from_le_bytes(*bytes).into();
        }
        set.push(numbers, 0).map_err(|problem| format!("byte {}: point {number}: {problem}", number * size))?;
    }
    Ok(set)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_two_or_three_floats_a_point() {
        let floats = [0.5f32, -1.0, 2.0, 3.0, 4.0, 5.0];
        let mut bytes = floats.map(f32::to_le_bytes).concat();
        let plane = parse(&bytes, 2).unwrap().into_plane("").unwrap();
        assert_eq!(plane.points, [[0.5, -1.0], [2.0, 3.0], [4.0, 5.0]]);
        let samples = parse(&bytes, 3).unwrap().into_samples([0.0; 3]).unwrap();
        assert_eq!(samples.positions, [[0.5, -1.0, 2.0], [3.0, 4.0, 5.0]]);
        assert_eq!(parse(&bytes[..20], 2).unwrap_err(), "20 bytes are not whole points of 2 floats");
        bytes[16..20].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(parse(&bytes, 2).unwrap_err(), "byte 16: point 2: x is NaN, not finite");
    }
}
