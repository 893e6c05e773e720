//! Arrays of NumPy: a row a point. Singles, doubles and 32-bit integers of either byte order are read, in C or Fortran
//! order; little-endian singles are written.
//!
//! A file is `\x93NUMPY`, a version, the length of a header and the header: a dictionary of Python with three entries
//! (numpy.lib.format). Of the crates for it npyz and ndarray-npy bring a parser of all literals of Python, and npyz
//! multiplies what the header claims without a check.

use std::io::{self, Write};

use super::{Coordinates, PointSet, shortened};

const MAGIC: &[u8] = b"\x93NUMPY";

/// Headers are padded with spaces to a multiple of this.
const ALIGNMENT: usize = 64;

pub fn parse(bytes: &[u8], coordinates: Coordinates) -> Result<PointSet, String> {
    let (header, body) = split(bytes).ok_or("is no array of NumPy, or cut off in its header")?;
    let array = Array::of(header)?;
    if array.width < coordinates.count() {
        return Err(format!("has {} columns, and {} are needed", array.width, coordinates.count()));
    }
    // The header is believed as far as the file goes: it may claim anything.
    let size = array.count.checked_mul(array.width).and_then(|numbers| numbers.checked_mul(array.size));
    if size.is_none_or(|size| size > body.len()) {
        let Array { count, width, .. } = array;
        return Err(format!("the header announces {count} x {width} numbers, but only {} bytes follow", body.len()));
    }
    let mut set = PointSet::default();
    for row in 0..array.count {
        let mut position = [0.0; 3];
        for (column, x) in position[..array.width.min(coordinates.count())].iter_mut().enumerate() {
            *x = array.number(body, row, column);
        }
        if !position.iter().all(|x| x.is_finite()) {
            return Err(format!("row {row} is {position:?}, not finite"));
        }
        set.positions.push(position);
    }
    Ok(set)
}

/// Header and body. The length of the header has two bytes in version 1 and four later.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let (&[version, _], rest) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<2>()?;
    let (length, rest) = if version == 1 {
        let (length, rest) = rest.split_first_chunk()?;
        (u16::from_le_bytes(*length) as usize, rest)
    } else {
        let (length, rest) = rest.split_first_chunk()?;
        (u32::from_le_bytes(*length) as usize, rest)
    };
    let (header, body) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, body))
}

/// How numbers lie in the body.
struct Array {
    count: usize,
    width: usize,
    /// Whether columns and not rows are whole.
    by_columns: bool,
    /// Bytes of a number, and the number from its bytes.
    size: usize,
    read: fn(&[u8]) -> f32,
}

impl Array {
    fn of(header: &str) -> Result<Self, String> {
        let entry = |key: &str| {
            let (_, rest) = header.split_once(key).ok_or_else(|| format!("the header has no {key}"))?;
            Ok::<_, String>(rest.trim_start_matches(['\'', '"']).trim_start().trim_start_matches(':').trim_start())
        };
        let element = entry("descr")?.trim_start_matches(['\'', '"']);
        let element = element.split(['\'', '"', ',']).next().unwrap_or_default();
        let (size, read): (usize, fn(&[u8]) -> f32) = match element {
            "<f4" => (4, |bytes| f32::from_le_bytes(chunk(bytes))),
            ">f4" => (4, |bytes| f32::from_be_bytes(chunk(bytes))),
            "<f8" => (8, |bytes| f64::from_le_bytes(chunk(bytes)) as f32),
            ">f8" => (8, |bytes| f64::from_be_bytes(chunk(bytes)) as f32),
            "<i4" => (4, |bytes| i32::from_le_bytes(chunk(bytes)) as f32),
            ">i4" => (4, |bytes| i32::from_be_bytes(chunk(bytes)) as f32),
            _ => return Err(format!("has numbers of the type {:?}, not f4, f8 or i4", shortened(element))),
        };
        let shape = entry("shape")?.trim_start_matches('(').split(')').next().unwrap_or_default();
        let lengths = shape.split(',').map(str::trim).filter(|length| !length.is_empty());
        let lengths: Option<Vec<usize>> = lengths.map(|length| length.parse().ok()).collect();
        let Some(&[count, width]) = lengths.as_deref() else {
            return Err(format!("has the shape ({}), not (points, coordinates)", shortened(shape)));
        };
        Ok(Self { count, width, by_columns: entry("fortran_order")?.starts_with("True"), size, read })
    }

    fn number(&self, body: &[u8], row: usize, column: usize) -> f32 {
        let place = if self.by_columns { column * self.count + row } else { row * self.width + column };
        (self.read)(&body[place * self.size..])
    }
}

fn chunk<const N: usize>(bytes: &[u8]) -> [u8; N] {
    *bytes.first_chunk().expect("the body is as long as the header says")
}

/// A file of version 1.0.
pub fn write<const N: usize>(writer: &mut impl Write, points: &[[f32; N]]) -> io::Result<()> {
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {N}), }}", points.len());
    let start = MAGIC.len() + 4;
    let length = (start + header.len() + 1).next_multiple_of(ALIGNMENT) - start;
    writer.write_all(MAGIC)?;
    writer.write_all(&[1, 0])?;
    writer.write_all(&(length as u16).to_le_bytes())?;
    writeln!(writer, "{header:<0$}", length - 1)?;
    points.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of version 1.0 with this description and body.
    fn file(description: &str, body: &[u8]) -> Vec<u8> {
        let header = format!("{description:<117}\n");
        let size = (header.len() as u16).to_le_bytes();
        [b"\x93NUMPY\x01\x00", &size[..], header.as_bytes(), body].concat()
    }

    fn dictionary(element: &str, fortran: &str, shape: &str) -> String {
        format!("{{'descr': '{element}', 'fortran_order': {fortran}, 'shape': {shape}, }}")
    }

    #[test]
    fn every_type_and_order_gives_the_same_points() {
        let expected = [[1.0, 2.0, 0.0], [3.0, -4.0, 0.0]];
        let rows = [1.0f32, 2.0, 3.0, -4.0];
        let columns = [1.0f32, 3.0, 2.0, -4.0];
        let bytes = |numbers: [f32; 4], of: fn(f32) -> Vec<u8>| numbers.into_iter().flat_map(of).collect::<Vec<_>>();
        for (element, fortran, body) in [
            ("<f4", "False", bytes(rows, |x| x.to_le_bytes().to_vec())),
            (">f4", "False", bytes(rows, |x| x.to_be_bytes().to_vec())),
            ("<f8", "True", bytes(columns, |x| f64::from(x).to_le_bytes().to_vec())),
            ("<i4", "False", bytes(rows, |x| (x as i32).to_le_bytes().to_vec())),
        ] {
            let file = file(&dictionary(element, fortran, "(2, 2)"), &body);
            assert_eq!(parse(&file, Coordinates::Plane).unwrap().positions, expected, "{element}");
        }
        let mut written = Vec::new();
        write(&mut written, &[[1.0, 2.0], [3.0, -4.0f32]]).unwrap();
        assert_eq!(parse(&written, Coordinates::Plane).unwrap().positions, expected);
        // The header of these bytes is what numpy.save writes.
        let start = b"\x93NUMPY\x01\x00v\x00{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }  ";
        assert!(written.starts_with(start) && written[..128].ends_with(b" \n") && written.len() == 128 + 16);
    }

    #[test]
    fn what_is_no_array_of_points_is_refused_with_the_reason() {
        let refused = |file: &[u8], coordinates| parse(file, coordinates).unwrap_err();
        let body = [0u8; 48];
        let of = |element: &str, shape: &str| file(&dictionary(element, "False", shape), &body);
        assert!(refused(&of("<f4", "(12,)"), Coordinates::Plane).starts_with("has the shape (12,), not"));
        assert!(refused(&of("<f4", "(6, 2)"), Coordinates::Space).starts_with("has 2 columns, and 3"));
        assert!(refused(&of("<f4", "(7, 2)"), Coordinates::Plane).contains("7 x 2 numbers, but only 48 bytes"));
        let huge = of("<f4", "(9223372036854775807, 9223372036854775807)");
        assert!(refused(&huge, Coordinates::Plane).contains("announces"));
        assert!(refused(&of("<c8", "(3, 2)"), Coordinates::Plane).contains("\"<c8\", not f4, f8 or i4"));
        assert!(refused(&file("{'shape': (1, 2)}", &body), Coordinates::Plane).contains("has no descr"));
        for cut in [b"no array".to_vec(), file("{}", &[])[..60].to_vec(), b"\x93NUMPY\x03\x00\xff\xff".to_vec()] {
            assert!(refused(&cut, Coordinates::Plane).starts_with("is no array of NumPy"));
        }
        let infinite = file(&dictionary("<f8", "False", "(1, 2)"), &[1.0f64, 1e300].map(f64::to_le_bytes).concat());
        assert_eq!(refused(&infinite, Coordinates::Plane), "row 0 is [1.0, inf, 0.0], not finite");
    }
}
