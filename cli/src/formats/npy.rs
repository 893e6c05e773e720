//! Arrays of NumPy. Sets of the plane are arrays of two floats to a row, those of a cuboid of three. Samples of a surface are structured arrays,
//! with the fields `position` (3 floats), `normal` (3), `triangle` (an unsigned integer), `barycentrics` (2), `radius`
//! where radii differ, `rank` in progressive order, and `class` where there are several. Sets of the plane or of a cuboid in
//! progressive order, of several classes or with radii that differ are structured arrays of `x`, `y`, in a cuboid `z`, and
//! `radius`, `rank` or `class`. Radii on a grid are arrays of three axes: z, y and x.
//!
//! Input may have floats and integers of any size and byte order: arrays of at least two columns, in C or Fortran
//! order, of which 2, 3 or 6 are x, y, z, nx, ny and nz, and otherwise the first three; and structured arrays with the
//! fields above or with fields named x, y, z, nx, ny, nz, triangle, u and v.
//!
//! A file is `\x93NUMPY`, a version, the length of a header and the header: a dictionary of Python with three entries
//! (numpy.lib.format). The crate npyz would parse it too, but multiplies what the header claims without a check.

use std::io::{self, Write};

use serde_json::Value;

use super::columns::Column as FileColumn;
use super::points::PointTable;
use super::set::{self, Columns, NAMES, PointSet};
use super::shortened;
use super::surface::SurfaceTable;

const MAGIC: &[u8] = b"\x93NUMPY";

/// Headers are padded with spaces to a multiple of this.
const ALIGNMENT: usize = 64;

/// Fields of several numbers, and what these are.
const VECTORS: [(&str, &[&str]); 3] =
    [("position", &["x", "y", "z"]), ("normal", &["nx", "ny", "nz"]), ("barycentrics", &["u", "v"])];

pub fn parse(bytes: &[u8]) -> Result<PointSet, String> {
    let (header, body) = split(bytes).ok_or("is no array of NumPy, or cut off in its header")?;
    let array = Array::of(header)?;
    // The header is trusted only as far as the file goes: it may claim anything.
    if array.count.checked_mul(array.row_size).is_none_or(|size| size > body.len()) {
        let Array { count, row_size, .. } = array;
        let (rows, length) = (format!("{count} rows of {row_size} bytes"), body.len());
        return Err(format!("the header announces {rows}, but only {length} bytes follow"));
    }
    let mut points = array.columns.empty_set();
    for row in 0..array.count {
        let at = |problem| format!("row {row}: {problem}");
        let number = |column: &Column| column.number.read(&body[column.offset + row * column.stride..]);
        let numbers = array.columns.floats.each_ref().map(|column| column.as_ref().map_or(0.0, number));
        let triangle = array.columns.on_mesh().map_or(Ok(0), |column| set::triangle(number(column))).map_err(at)?;
        points.push(numbers, triangle).map_err(at)?;
    }
    Ok(points)
}

/// Values on a grid, as `volume::adaptive` takes them.
pub struct Grid {
    /// x is the fastest, then y.
    pub values: Vec<f32>,
    /// Their number along x, y and z.
    pub size: [usize; 3],
}

/// An array of the axes z, y and x, of numbers of any type.
pub fn parse_grid(bytes: &[u8]) -> Result<Grid, String> {
    let (header, body) = split(bytes).ok_or("is no array of NumPy, or cut off in its header")?;
    let Header { descr, shape, lengths, is_by_columns } = Header::of(header)?;
    let (Value::String(code), Some(&[z, y, x])) = (&descr, lengths.as_deref()) else {
        let (shape, descr) = (shortened(&shape.to_string()), shortened(&descr.to_string()));
        return Err(format!("has the shape {shape} and the type {descr}, not (z, y, x) and numbers"));
    };
    let number = Number::of(code)?;
    let count = [z, y, x].iter().try_fold(1usize, |count, &along| count.checked_mul(along));
    let Some(count) = count.filter(|count| count.checked_mul(number.size).is_some_and(|size| size <= body.len()))
    else {
        let shape = shortened(&shape.to_string());
        return Err(format!("the header announces the shape {shape}, but only {} bytes follow", body.len()));
    };
    let place = |index: usize| match is_by_columns {
        true => (index / x % y + index % x * y) * z + index / x / y,
        false => index,
    };
    let value = |index: usize| number.read(&body[place(index) * number.size..]) as f32;
    Ok(Grid { values: (0..count).map(value).collect(), size: [x, y, z] })
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

/// The header, a literal of Python, as JSON: that has other brackets and quotes, and no comma before a closing bracket.
fn dictionary(header: &str) -> Result<Value, String> {
    let mut json = String::with_capacity(header.len());
    for letter in header.chars() {
        if matches!(letter, ')' | ']' | '}') {
            json.truncate(json.trim_end().trim_end_matches(',').len());
        }
        json.push(match letter {
            '(' => '[',
            ')' => ']',
            '\'' => '"',
            other => other,
        });
    }
    let json = json.replace("False", "false").replace("True", "true");
    serde_json::from_str(&json).map_err(|_| "has a header that is no dictionary of Python".to_owned())
}

/// The entries of a header.
struct Header {
    descr: Value,
    shape: Value,
    /// The shape, if it is a tuple of lengths.
    lengths: Option<Vec<usize>>,
    is_by_columns: bool,
}

impl Header {
    fn of(header: &str) -> Result<Self, String> {
        let header = dictionary(header)?;
        let entry = |key: &str| header.get(key).ok_or_else(|| format!("the header has no {key}"));
        let (descr, shape) = (entry("descr")?.clone(), entry("shape")?.clone());
        let is_by_columns = entry("fortran_order")?.as_bool() == Some(true);
        let lengths = shape.as_array().and_then(|lengths| lengths.iter().map(length).collect());
        Ok(Self { descr, shape, lengths, is_by_columns })
    }
}

/// The layout of the numbers in the body.
struct Array {
    count: usize,
    /// The bytes of all numbers of a row, wherever they lie.
    row_size: usize,
    columns: Columns<Column>,
}

/// The offset of a column, and the distance between its numbers.
struct Column {
    offset: usize,
    stride: usize,
    number: Number,
}

impl Array {
    fn of(header: &str) -> Result<Self, String> {
        let Header { descr, shape, lengths, is_by_columns } = Header::of(header)?;
        match (&descr, lengths.as_deref()) {
            (Value::Array(fields), Some(&[count])) => Self::of_fields(fields, count),
            (Value::String(code), Some(&[count, width])) => {
                Self::of_numbers(Number::of(code)?, count, width, is_by_columns)
            }
            _ => Err(format!("has the shape {}, not (points, coordinates)", shortened(&shape.to_string()))),
        }
    }

    /// An array of rows of `width` numbers.
    fn of_numbers(number: Number, count: usize, width: usize, is_by_columns: bool) -> Result<Self, String> {
        let known = if width == 6 { 6 } else { width.min(3) };
        let row_size = width.saturating_mul(number.size);
        let column = |name: &str| {
            let column = NAMES[..known].iter().position(|known| *known == name)?;
            let (offset, stride) = if is_by_columns { (column.saturating_mul(count), 1) } else { (column, width) };
            let [offset, stride] = [offset, stride].map(|numbers| numbers.saturating_mul(number.size));
            Some(Column { offset, stride, number })
        };
        let columns =
            Columns::find(column).map_err(|missing| format!("has {width} columns, and none for {missing}"))?;
        Ok(Self { count, row_size, columns })
    }

    /// A structured array, each of whose fields has a name, a type and perhaps a shape.
    fn of_fields(fields: &[Value], count: usize) -> Result<Self, String> {
        let (mut found, mut row_size) = (Vec::new(), 0usize);
        for field in fields {
            let unread = || format!("has a field that is not read: {}", shortened(&field.to_string()));
            let (name, code, shape) = match field.as_array().map(Vec::as_slice) {
                Some([Value::String(name), Value::String(code)]) => (name, code, None),
                Some([Value::String(name), Value::String(code), Value::Array(shape)]) => (name, code, Some(shape)),
                _ => return Err(unread()),
            };
            let number = Number::of(code)?;
            let mut numbers = shape.into_iter().flatten().map(length);
            let numbers =
                numbers.try_fold(1usize, |all, length| Some(all.saturating_mul(length?))).ok_or_else(unread)?;
            let vector = VECTORS.iter().find(|(vector, _)| vector == name);
            let names = match vector {
                Some((_, names)) => names.to_vec(),
                None if numbers == 1 => vec![name.as_str()],
                None => Vec::new(),
            };
            let offsets = (0..numbers).map(|i| row_size.saturating_add(i * number.size));
            found.extend(names.into_iter().zip(offsets).map(|(name, offset)| (name.to_owned(), offset, number)));
            row_size = row_size.saturating_add(numbers.saturating_mul(number.size));
        }
        let column = |name: &str| {
            let &(_, offset, number) = found.iter().find(|(found, ..)| found == name)?;
            Some(Column { offset, stride: row_size, number })
        };
        let columns = Columns::find(column).map_err(|missing| format!("has no field for {missing}"))?;
        Ok(Self { count, row_size, columns })
    }
}

fn length(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// A type of numbers.
#[derive(Clone, Copy)]
struct Number {
    /// `f` for floats, `i` for signed integers, `u` for unsigned ones.
    kind: char,
    size: usize,
    is_big_endian: bool,
}

impl Number {
    /// The type of a code such as `<f4`.
    fn of(code: &str) -> Result<Self, String> {
        let kind = code.trim_start_matches(['<', '>', '=', '|']);
        let is_big_endian = code.starts_with('>');
        let (kind, size) = match kind {
            "f4" => ('f', 4),
            "f8" => ('f', 8),
            "i1" | "i2" | "i4" | "i8" | "u1" | "u2" | "u4" | "u8" => {
                (if kind.starts_with('i') { 'i' } else { 'u' }, usize::from(kind.as_bytes()[1] - b'0'))
            }
            _ => return Err(format!("has numbers of the type {:?}, not floats or integers", shortened(code))),
        };
        Ok(Self { kind, size, is_big_endian })
    }

    /// The number that begins these bytes.
    fn read(self, bytes: &[u8]) -> f64 {
        let mut word = [0; 8];
        word[..self.size].copy_from_slice(&bytes[..self.size]);
        if self.is_big_endian {
            word[..self.size].reverse();
        }
        let ([a, b, c, d, ..], integer) = (word, u64::from_le_bytes(word));
        let rest = 64 - 8 * self.size;
        match (self.kind, self.size) {
            ('f', 4) => f32::from_le_bytes([a, b, c, d]).into(),
            ('f', _) => f64::from_le_bytes(word),
            ('i', _) => ((integer << rest).cast_signed() >> rest) as f64,
            _ => integer as f64,
        }
    }
}

/// Writes points as an array of a column for each coordinate or, with ranks or classes, as a structured one.
pub fn write_points<const D: usize>(writer: &mut impl Write, table: &PointTable<D>) -> io::Result<()> {
    let (more, count) = (fields(table.more_columns()), table.points.len());
    if more.is_empty() {
        write_header(writer, "'<f4'", &format!("({count}, {D})"))?;
    } else {
        let coordinates: Vec<_> = NAMES[..D].iter().map(|name| format!("('{name}', '<f4')")).collect();
        write_header(writer, &format!("[{}{more}]", coordinates.join(", ")), &format!("({count},)"))?;
    }
    table.write_binary::<D>(writer)
}

/// Writes samples of a surface as a structured array.
pub fn write_surface(writer: &mut impl Write, table: &SurfaceTable) -> io::Result<()> {
    let more = fields(table.more_columns());
    let float = if table.has_origin() { "<f8" } else { "<f4" };
    let fields = format!(
        "[('position', '{float}', (3,)), ('normal', '<f4', (3,)), ('triangle', '<u4'), ('barycentrics', '<f4', (2,)){more}]"
    );
    write_header(writer, &fields, &format!("({},)", table.samples.len()))?;
    table.write_binary(writer)
}

/// The fields of columns, behind others.
fn fields(columns: impl Iterator<Item = FileColumn>) -> String {
    columns.map(|column| format!(", ('{}', '{}')", column.name, column.npy_type())).collect()
}

/// The header of a file of version 1.0.
fn write_header(writer: &mut impl Write, descr: &str, shape: &str) -> io::Result<()> {
    let header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}");
    let start = MAGIC.len() + 4;
    let length = (start + header.len() + 1).next_multiple_of(ALIGNMENT) - start;
    writer.write_all(MAGIC)?;
    writer.write_all(&[1, 0])?;
    writer.write_all(&(length as u16).to_le_bytes())?;
    writeln!(writer, "{header:<0$}", length - 1)
}

#[cfg(test)]
mod tests;
