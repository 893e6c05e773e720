//! Points as little-endian 32-bit floats and nothing else.

use std::io::{self, Write};

use super::{Coordinates, PointSet};

/// Two floats a point in the plane, three in space.
pub fn parse(bytes: &[u8], coordinates: Coordinates) -> Result<PointSet, String> {
    let size = 4 * coordinates.count();
    if !bytes.len().is_multiple_of(size) {
        return Err(format!("{} bytes are not whole points of {} floats", bytes.len(), coordinates.count()));
    }
    let mut set = PointSet::default();
    for (number, point) in bytes.chunks_exact(size).enumerate() {
        let mut position = [0.0; 3];
        for (x, bytes) in position.iter_mut().zip(point.chunks_exact(4)) {
            *x = f32::from_le_bytes(bytes.try_into().expect("chunks of four bytes"));
        }
        if !position.iter().all(|x| x.is_finite()) {
            return Err(format!("byte {}: point {number} is {position:?}, not finite", number * size));
        }
        set.positions.push(position);
    }
    Ok(set)
}

pub fn write<const N: usize>(writer: &mut impl Write, points: &[[f32; N]]) -> io::Result<()> {
    points.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_two_or_three_floats_a_point() {
        let mut bytes = Vec::new();
        write(&mut bytes, &[[0.5f32, -1.0, 2.0], [3.0, 4.0, 5.0]]).unwrap();
        assert_eq!(bytes[..8], [0, 0, 0, 0x3f, 0, 0, 0x80, 0xbf]);
        assert_eq!(parse(&bytes, Coordinates::Space).unwrap().positions, [[0.5, -1.0, 2.0], [3.0, 4.0, 5.0]]);
        assert_eq!(
            parse(&bytes, Coordinates::Plane).unwrap().positions,
            [[0.5, -1.0, 0.0], [2.0, 3.0, 0.0], [4.0, 5.0, 0.0]]
        );
        assert_eq!(parse(&bytes[..20], Coordinates::Plane).unwrap_err(), "20 bytes are not whole points of 2 floats");
        bytes[16..20].copy_from_slice(&f32::NAN.to_le_bytes());
        let said = parse(&bytes, Coordinates::Plane).unwrap_err();
        assert_eq!(said, "byte 16: point 2 is [NaN, 5.0, 0.0], not finite");
    }
}
