//! The body of a PLY file: what follows the header, element by element.

use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType, ScalarType};

use crate::mesh::source::Source;
use crate::mesh::text::{next_number, shown, skip_blanks, split_line};

/// What is left of a body.
pub(super) struct Body<'a, 'b> {
    source: &'a mut Source<'b>,
    encoding: Encoding,
    /// The lines of the file that have been read, if it is a text.
    lines: usize,
}

/// One element: for each property, its number or its list.
pub(super) struct Row {
    pub numbers: Vec<f64>,
    pub lists: Vec<Vec<f64>>,
}

impl<'a, 'b> Body<'a, 'b> {
    /// The body behind a header of so many lines.
    pub fn new(source: &'a mut Source<'b>, encoding: Encoding, lines: usize) -> Self {
        Self { source, encoding, lines }
    }

    /// Takes memory for one item of each element, unless the header announces more than the body can hold.
    pub fn reserve<T>(&self, definition: &ElementDef, items: &mut Vec<T>) -> Result<(), String> {
        self.check_count(definition)?;
        items.reserve_exact(definition.count);
        Ok(())
    }

    /// Reads all elements of one kind, one after the other.
    pub fn read(
        &mut self,
        definition: &ElementDef,
        mut take: impl FnMut(&Row) -> Result<(), String>,
    ) -> Result<(), String> {
        self.check_count(definition)?;
        let ElementDef { name, count, properties } = definition;
        let types: Vec<_> = properties.values().map(|property| property.data_type.clone()).collect();
        let mut row = Row { numbers: vec![0.0; types.len()], lists: vec![Vec::new(); types.len()] };
        for element in 0..*count {
            let ends = || format!("ends after {element} of {count} of element {name}");
            if self.encoding == Encoding::Ascii {
                let line = self.next_line().ok_or_else(ends)?;
                let mut rest = line;
                let read = row.read(&types, |kind| text_number(&mut rest, kind));
                // What follows the numbers is left aside.
                let length = line.len() - split_line(rest).1.len();
                self.source.skip(length);
                self.lines += 1;
                read.map_err(|problem| format!("line {}: {problem}", self.lines))?;
            } else {
                row.read(&types, |kind| self.binary_number(kind).ok_or_else(ends))?;
            }
            take(&row)?;
        }
        Ok(())
    }

    /// Goes to the next line of the text that is not empty. It, and lines behind it.
    #[inline]
    fn next_line(&mut self) -> Option<&[u8]> {
        loop {
            let text = self.source.whole_lines()?;
            let rest = skip_blanks(text);
            let blanks = text.len() - rest.len();
            match rest {
                [] => self.source.skip(blanks),
                [b'\n', ..] => {
                    self.source.skip(blanks + 1);
                    self.lines += 1;
                }
                _ => break,
            }
        }
        self.source.whole_lines()
    }

    /// The next number of a binary body.
    #[inline]
    fn binary_number(&mut self, kind: &ScalarType) -> Option<f64> {
        let size = size(kind);
        let mut bytes = [0; 8];
        bytes[..size].copy_from_slice(self.source.at_least(size).get(..size)?);
        self.source.skip(size);
        if self.encoding == Encoding::BinaryBigEndian {
            bytes[..size].reverse();
        }
        let [a, b, c, d, ..] = bytes;
        Some(match kind {
            ScalarType::Char => f64::from(a as i8),
            ScalarType::UChar => f64::from(a),
            ScalarType::Short => f64::from(i16::from_le_bytes([a, b])),
            ScalarType::UShort => f64::from(u16::from_le_bytes([a, b])),
            ScalarType::Int => f64::from(i32::from_le_bytes([a, b, c, d])),
            ScalarType::UInt => f64::from(u32::from_le_bytes([a, b, c, d])),
            ScalarType::Float => f64::from(f32::from_le_bytes([a, b, c, d])),
            ScalarType::Double => f64::from_le_bytes(bytes),
        })
    }

    /// Refuses more elements than the rest of the file can hold.
    fn check_count(&self, element: &ElementDef) -> Result<(), String> {
        let (ElementDef { name, count, .. }, remaining) = (element, self.source.remaining());
        let smallest: usize = match self.encoding {
            // A digit and a separator each, of which the last may be missing at the end of the file.
            Encoding::Ascii => 2 * element.properties.len(),
            _ => element.properties.values().map(|property| smallest_size(&property.data_type)).sum(),
        };
        if *count > 0 && smallest == 0 {
            return Err(format!("element {name} has no properties"));
        }
        if (*count as u64).saturating_mul(smallest as u64) > remaining + 1 {
            return Err(format!("the header announces {count} of element {name}, but only {remaining} bytes follow"));
        }
        Ok(())
    }
}

impl Row {
    /// Reads an element, number by number.
    #[inline]
    fn read(
        &mut self,
        types: &[PropertyType],
        mut next: impl FnMut(&ScalarType) -> Result<f64, String>,
    ) -> Result<(), String> {
        for ((data_type, number), list) in types.iter().zip(&mut self.numbers).zip(&mut self.lists) {
            match data_type {
                PropertyType::Scalar(kind) => *number = next(kind)?,
                PropertyType::List(length, items) => {
                    let count = next(length)?;
                    if count < 0.0 || count.fract() != 0.0 {
                        return Err(format!("a list has {count} items"));
                    }
                    list.clear();
                    for _ in 0..count as u64 {
                        list.push(next(items)?);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The next number of a line, rounded to what a binary file would have.
#[inline]
fn text_number(rest: &mut &[u8], kind: &ScalarType) -> Result<f64, String> {
    let read = if *kind == ScalarType::Float {
        next_number::<f32>(rest).map(|(number, rest)| (f64::from(number), rest))
    } else {
        next_number(rest)
    };
    match read {
        Ok((number, behind)) => {
            *rest = behind;
            Ok(number)
        }
        Err(b"") => Err("fewer numbers than the header announces".to_owned()),
        Err(word) => Err(format!("{} is not a number that fits the header", shown(word))),
    }
}

/// Bytes of a binary property; of a list, its length alone.
fn smallest_size(property: &PropertyType) -> usize {
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = property;
    size(scalar)
}

fn size(scalar: &ScalarType) -> usize {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}
