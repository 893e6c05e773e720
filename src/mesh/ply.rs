//! PLY files, ASCII and binary: meshes, points, and the attributes that they carry.
//!
//! The crate ply-rs-bw reads the header. The body is read here, because the crate cannot keep attributes by name
//! without an allocation for each element, and its text reader refuses numbers such as `.5`, `1.` and `nan`, and empty
//! lines.
//!
//! ```
//! # use azulejo::mesh::ply::Ply;
//! let file = b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float heat\nend_header\n0 .5\n1 2\n";
//! let ply = Ply::read(file, |element, property| element == "vertex" && property == "heat").unwrap();
//! assert_eq!(ply.element("vertex").unwrap().numbers("heat"), Some(&[0.5, 2.0][..]));
//! ```

use std::io::{self, Cursor, Write};
use std::ops::Range;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, ElementDef, Encoding, Header, PropertyDef, PropertyType, ScalarType};
use ply_rs_bw::writer::Writer;

use crate::mesh::load::Soup;
use crate::mesh::source::Source;
use crate::mesh::text::{next_number, shown, skip_blanks, split_line};

/// The parts of a PLY file that were asked for.
#[derive(Debug)]
pub struct Ply {
    comments: Vec<String>,
    elements: Vec<Element>,
}

/// All elements of one kind, such as the vertices.
#[derive(Debug)]
pub struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

#[derive(Debug)]
struct Property {
    name: String,
    /// `None` if they were not asked for.
    values: Option<Values>,
}

#[derive(Debug)]
enum Values {
    Numbers(Vec<f64>),
    Lists(Lists),
}

/// A list of numbers for each element, such as the vertices of each face.
#[derive(Debug, Default)]
pub struct Lists {
    items: Vec<f64>,
    /// The end of each list in `items`.
    ends: Vec<usize>,
}

impl Ply {
    /// Reads the properties for which `wanted(element, property)` is true. The whole file is checked.
    ///
    /// Memory stays proportional to the size of the file, whatever its header claims.
    ///
    /// # Errors
    /// The defect of the file, in one line.
    pub fn read(bytes: &[u8], wanted: impl Fn(&str, &str) -> bool) -> Result<Self, String> {
        let mut input = Cursor::new(bytes);
        let mut source = Source::new(&mut input, bytes.len() as u64);
        let (header, mut body) = open(&mut source)?;
        let mut elements = Vec::new();
        for definition in header.elements.values() {
            let mut element = Element::new(definition, &wanted);
            body.read(definition, |row| {
                element.take(row);
                Ok(())
            })?;
            elements.push(element);
        }
        Ok(Self { comments: header.comments, elements })
    }

    /// The comments of the header.
    pub fn comments(&self) -> &[String] {
        &self.comments
    }

    /// The elements of this name, if the file has this kind.
    pub fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

impl Element {
    fn new(definition: &ElementDef, wanted: impl Fn(&str, &str) -> bool) -> Self {
        let ElementDef { name, count, .. } = definition;
        let property = |(property, found): (&String, &PropertyDef)| Property {
            name: property.clone(),
            values: wanted(name, property).then(|| match &found.data_type {
                PropertyType::Scalar(_) => Values::Numbers(Vec::new()),
                PropertyType::List(..) => Values::Lists(Lists::default()),
            }),
        };
        Self { name: name.clone(), count: *count, properties: definition.properties.iter().map(property).collect() }
    }

    /// Takes the requested properties of one more element.
    fn take(&mut self, row: &Row) {
        for (index, property) in self.properties.iter_mut().enumerate() {
            match &mut property.values {
                None => {}
                Some(Values::Numbers(numbers)) => numbers.push(row.numbers[index]),
                Some(Values::Lists(lists)) => {
                    lists.items.extend(&row.lists[index]);
                    lists.ends.push(lists.items.len());
                }
            }
        }
    }

    /// The number of elements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// A number for each element; `None` if there is no such property, it holds lists, or it was not asked for.
    pub fn numbers(&self, property: &str) -> Option<&[f64]> {
        match self.values(property)? {
            Values::Numbers(numbers) => Some(numbers),
            Values::Lists(_) => None,
        }
    }

    /// A list for each element; `None` if there is no such property, it holds numbers, or it was not asked for.
    pub fn lists(&self, property: &str) -> Option<&Lists> {
        match self.values(property)? {
            Values::Lists(lists) => Some(lists),
            Values::Numbers(_) => None,
        }
    }

    /// The names of all properties, in the order of the file, also of the properties that were not asked for.
    pub fn properties(&self) -> impl Iterator<Item = &str> {
        self.properties.iter().map(|property| property.name.as_str())
    }

    fn values(&self, name: &str) -> Option<&Values> {
        self.properties.iter().find(|property| property.name == name)?.values.as_ref()
    }
}

impl Lists {
    /// The lists, in the order of the elements.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.items[start..end])
    }
}

/// The bytes of all elements of one kind, as they stand in a file, from which another file can be made of some of them.
#[derive(Debug)]
pub struct Records {
    /// The header of a file of these elements alone.
    header: Header,
    ranges: Vec<Range<usize>>,
}

/// The encoding of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Numbers as text, a line for each element.
    Text,
    /// Binary numbers, the lowest byte first.
    LittleEndian,
    /// Binary numbers, the highest byte first.
    BigEndian,
}

impl Records {
    /// The elements of this name. The file is checked up to their end.
    ///
    /// # Errors
    /// The defect of the file, in one line.
    pub fn read(bytes: &[u8], element: &str) -> Result<Self, String> {
        let mut input = Cursor::new(bytes);
        let mut source = Source::new(&mut input, bytes.len() as u64);
        let (mut header, mut body) = open(&mut source)?;
        let kind = header.elements.get_index_of(element).ok_or_else(|| format!("has no element {element}"))?;
        let mut ranges = Vec::new();
        body.reserve(&header.elements[kind], &mut ranges)?;
        for definition in header.elements.values().take(kind) {
            body.read(definition, |_| Ok(()))?;
        }
        let mut start = bytes.len() - body.source.remaining() as usize;
        let is_text = header.encoding == Encoding::Ascii;
        body.read(&header.elements[kind], |row| {
            let end = bytes.len() - row.remaining as usize;
            ranges.push(if is_text { last_line(bytes, start..end) } else { start..end });
            start = end;
            Ok(())
        })?;
        header.elements.retain(|name, _| name == element);
        Ok(Self { header, ranges })
    }

    /// The bytes of each element; in a text without the end of its line.
    pub fn ranges(&self) -> &[Range<usize>] {
        &self.ranges
    }

    /// The encoding of the file.
    pub fn format(&self) -> Format {
        match self.header.encoding {
            Encoding::Ascii => Format::Text,
            Encoding::BinaryLittleEndian => Format::LittleEndian,
            Encoding::BinaryBigEndian => Format::BigEndian,
        }
    }

    /// True if the elements have a property of this name.
    pub fn has(&self, property: &str) -> bool {
        self.header.elements.values().any(|definition| definition.properties.contains_key(property))
    }

    /// Writes the header of a file of `count` of the elements, with further properties, which are floats. Comments are
    /// kept.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_header(&self, writer: &mut impl Write, count: usize, floats: &[&str]) -> io::Result<()> {
        let mut header = self.header.clone();
        for definition in header.elements.values_mut() {
            definition.count = count;
            for &name in floats {
                let property = PropertyDef::new(name.to_owned(), PropertyType::Scalar(ScalarType::Float));
                definition.properties.insert(name.to_owned(), property);
            }
        }
        Writer::<DefaultElement>::new().write_header(writer, &header).map(drop)
    }
}

/// The last line of a part of a text, without its end.
fn last_line(bytes: &[u8], range: Range<usize>) -> Range<usize> {
    let text = &bytes[range.clone()];
    let text = text.strip_suffix(b"\n").unwrap_or(text);
    let start = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    range.start + start..range.start + text.len()
}

/// The number of triangles that [`Mesh::load`](super::Mesh::load) makes of each face of a PLY file: polygons are cut
/// into fans. So an attribute of faces becomes one of triangles.
///
/// # Errors
/// The defect of the file, in one line.
pub fn triangles_of_faces(bytes: &[u8]) -> Result<Vec<usize>, String> {
    let mut input = Cursor::new(bytes);
    let mut source = Source::new(&mut input, bytes.len() as u64);
    let (header, mut body) = open(&mut source)?;
    let mut triangles = Vec::new();
    for definition in header.elements.values() {
        let corners = if definition.name == "face" { Some(corners(definition)?) } else { None };
        body.read(definition, |row| {
            triangles.extend(corners.map(|corners| row.lists[corners].len().saturating_sub(2)));
            Ok(())
        })?;
    }
    Ok(triangles)
}

/// True if contents without a name look like PLY.
pub(super) fn is_likely(source: &mut Source) -> bool {
    source.at_least(3).starts_with(b"ply")
}

/// Reads the header.
fn open<'a, 'b>(source: &'a mut Source<'b>) -> Result<(Header, Body<'a, 'b>), String> {
    if !is_likely(source) {
        return Err("is no PLY file: it does not begin with \"ply\"".to_owned());
    }
    let mut reader = Reader::new(source);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(explain)?;
    // It counts the line behind the header as begun.
    let lines = reader.line() - 1;
    let body = Body::new(reader.into_inner(), header.encoding, lines);
    Ok((header, body))
}

/// The first line of the reader's message: the others repeat the line of the file, of any length.
fn explain(error: ParseError) -> String {
    let message = error.to_string();
    message.lines().next().unwrap_or_default().trim_end_matches('.').replacen("Line", "line", 1)
}

/// The coordinates of a vertex.
const POSITION: [&str; 3] = ["x", "y", "z"];
/// The coordinates of its normal, if it has one.
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The two names in use for the list of a face's vertices.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Vertices, triangles and normals, or the defect of the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let (header, mut body) = open(source)?;
    if header.elements.contains_key("tristrips") {
        return Err("has triangle strips (element tristrips), which are not read".to_owned());
    }
    let mut soup = Soup::default();
    for definition in header.elements.values() {
        match &*definition.name {
            "vertex" => {
                let position = vector(definition, POSITION).ok_or_else(|| lacks(definition, &POSITION))?;
                let normal = vector(definition, NORMAL);
                body.reserve(definition, &mut soup.positions)?;
                if normal.is_some() {
                    body.reserve(definition, &mut soup.normals)?;
                }
                body.read(definition, |row| {
                    let vector = |properties: [usize; 3]| properties.map(|property| row.numbers[property] as f32);
                    soup.positions.push(vector(position));
                    soup.normals.extend(normal.map(vector));
                    Ok(())
                })?;
            }
            "face" => {
                let list = corners(definition)?;
                let are_integers = has_integers(definition, list);
                body.reserve(definition, &mut soup.triangles)?;
                let mut number = 0;
                body.read(definition, |row| {
                    let corners = &row.lists[list];
                    let is_index = |&index: &f64| f64::from(index as u32) == index;
                    if !are_integers || !corners.iter().all(is_index) {
                        return Err(format!("face {number} has no list of vertex numbers"));
                    }
                    number += 1;
                    let [first, rest @ ..] = &corners[..] else { return Ok(()) };
                    let fan = rest.windows(2).map(|pair| [*first, pair[0], pair[1]].map(|index| index as u32));
                    soup.triangles.extend(fan);
                    Ok(())
                })?;
            }
            _ => body.read(definition, |_| Ok(()))?,
        }
    }
    Ok(soup)
}

/// The positions of the vertices, in doubles, or the defect of the file.
pub(super) fn doubles(source: &mut Source) -> Result<Vec<[f64; 3]>, String> {
    let (header, mut body) = open(source)?;
    let mut positions = Vec::new();
    for definition in header.elements.values() {
        if definition.name == "vertex" {
            let position = vector(definition, POSITION).ok_or_else(|| lacks(definition, &POSITION))?;
            body.reserve(definition, &mut positions)?;
            body.read(definition, |row| {
                positions.push(position.map(|property| row.numbers[property]));
                Ok(())
            })?;
        } else {
            body.read(definition, |_| Ok(()))?;
        }
    }
    Ok(positions)
}

/// The numbers of the properties that are the coordinates of a vector; `None` if one is missing.
fn vector(definition: &ElementDef, names: [&str; 3]) -> Option<[usize; 3]> {
    let number = |name| {
        let (number, _, property) = definition.properties.get_full(name)?;
        matches!(property.data_type, PropertyType::Scalar(_)).then_some(number)
    };
    let [x, y, z] = names.map(number);
    Some([x?, y?, z?])
}

/// The number of the property that lists the vertices of a face.
pub(super) fn corners(definition: &ElementDef) -> Result<usize, String> {
    let list = |name: &&str| {
        let (number, _, property) = definition.properties.get_full(*name)?;
        matches!(property.data_type, PropertyType::List(..)).then_some(number)
    };
    FACE_LISTS.iter().find_map(list).ok_or_else(|| lacks(definition, &FACE_LISTS))
}

/// True if a property lists integers.
fn has_integers(definition: &ElementDef, property: usize) -> bool {
    let items = match &definition.properties[property].data_type {
        PropertyType::Scalar(items) | PropertyType::List(_, items) => items,
    };
    !matches!(items, ScalarType::Float | ScalarType::Double)
}

fn lacks(definition: &ElementDef, names: &[&str]) -> String {
    format!("element {} lacks {}", definition.name, names.join(", "))
}

/// The rest of a body.
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
    /// The number of bytes of the file after the element.
    pub remaining: u64,
}

impl<'a, 'b> Body<'a, 'b> {
    /// The body behind a header of `lines` lines.
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
        let mut row = Row { numbers: vec![0.0; types.len()], lists: vec![Vec::new(); types.len()], remaining: 0 };
        for element in 0..*count {
            let ends = || format!("ends after {element} of {count} of element {name}");
            if self.encoding == Encoding::Ascii {
                let line = self.next_line().ok_or_else(ends)?;
                let mut rest = line;
                let read = row.read(&types, |kind| text_number(&mut rest, kind));
                // The text after the numbers is ignored.
                let length = line.len() - split_line(rest).1.len();
                self.source.skip(length);
                self.lines += 1;
                read.map_err(|problem| format!("line {}: {problem}", self.lines))?;
            } else {
                row.read(&types, |kind| self.binary_number(kind).ok_or_else(ends))?;
            }
            row.remaining = self.source.remaining();
            take(&row)?;
        }
        Ok(())
    }

    /// Goes to the next line of the text that is not empty. Returns it with the lines behind it.
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
