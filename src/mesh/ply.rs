//! PLY files, ASCII and binary: meshes, points, and the attributes that they carry.
//!
//! The crate ply-rs-bw reads the header. The body is read here, because the crate cannot keep attributes by name without
//! an allocation for each element, and its text reader refuses numbers such as `.5`, `1.` and `nan`, and empty lines.
//!
//! ```
//! # use azulejo::mesh::ply::Ply;
//! let file = b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float heat\nend_header\n0 .5\n1 2\n";
//! let ply = Ply::read(file, |element, property| element == "vertex" && property == "heat").unwrap();
//! assert_eq!(ply.element("vertex").unwrap().numbers("heat"), Some(&[0.5, 2.0][..]));
//! ```

use std::str::FromStr;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, ElementDef, Encoding, PropertyType, ScalarType};

use crate::mesh::soup::Soup;
use crate::mesh::text::{number, shown, words};

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
    data_type: PropertyType,
    /// `None` if they were not asked for.
    values: Option<Values>,
}

#[derive(Debug)]
enum Values {
    Numbers(Vec<f64>),
    Lists(Lists),
}

/// A list of numbers for each element, such as the vertices of each face.
#[derive(Debug)]
pub struct Lists {
    items: Vec<f64>,
    /// Where each list ends in `items`.
    ends: Vec<usize>,
    are_integers: bool,
}

impl Ply {
    /// Reads the properties for which `wanted(element, property)` is true. The whole file is checked.
    ///
    /// Memory stays proportional to the size of the file, whatever its header claims.
    ///
    /// # Errors
    /// What is wrong with the file, in one line.
    pub fn read(bytes: &[u8], wanted: impl Fn(&str, &str) -> bool) -> Result<Self, String> {
        if !bytes.starts_with(b"ply") {
            return Err("is no PLY file: it does not begin with \"ply\"".to_owned());
        }
        let mut reader = Reader::new(bytes);
        let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(explain)?;
        let rest = *reader.get_ref();
        let lines = bytes[..bytes.len() - rest.len()].iter().filter(|&&byte| byte == b'\n').count();
        let mut body = Body { rest, encoding: header.encoding, lines };
        let mut elements = Vec::new();
        for definition in header.elements.values() {
            check_count(definition, header.encoding, body.rest.len())?;
            elements.push(body.read(definition, &wanted)?);
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

    /// The names of all properties, in the order of the file, also of those that were not asked for.
    pub fn properties(&self) -> impl Iterator<Item = &str> {
        self.properties.iter().map(|property| property.name.as_str())
    }

    fn values(&self, name: &str) -> Option<&Values> {
        self.properties.iter().find(|property| property.name == name)?.values.as_ref()
    }

    /// Vectors whose coordinates are properties; `None` if one is missing.
    fn vectors(&self, names: [&str; 3]) -> Option<Vec<[f32; 3]>> {
        let [x, y, z] = names.map(|name| self.numbers(name));
        let (x, y, z) = (x?, y?, z?);
        Some((0..self.count).map(|i| [x[i] as f32, y[i] as f32, z[i] as f32]).collect())
    }
}

impl Lists {
    /// The lists, in the order of the elements.
    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.items[start..end])
    }
}

/// The coordinates of a vertex.
const POSITION: [&str; 3] = ["x", "y", "z"];
/// The coordinates of its normal, if it has one.
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The two names in use for the list of a face's vertices.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The number of triangles that [`Mesh::load`](super::Mesh::load) makes of each face of a PLY file: polygons are cut into
/// fans. So an attribute of faces becomes one of triangles.
///
/// # Errors
/// What is wrong with the file, in one line.
pub fn triangles_of_faces(bytes: &[u8]) -> Result<Vec<usize>, String> {
    let ply = Ply::read(bytes, |element, property| element == "face" && FACE_LISTS.contains(&property))?;
    let faces = ply.element("face").map(corners).transpose()?;
    Ok(faces.map_or_else(Vec::new, |faces| faces.iter().map(|corners| corners.len().saturating_sub(2)).collect()))
}

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
    let ply = Ply::read(bytes, |element, property| match element {
        "vertex" => POSITION.contains(&property) || NORMAL.contains(&property),
        "face" => FACE_LISTS.contains(&property),
        _ => false,
    })?;
    if ply.element("tristrips").is_some() {
        return Err("has triangle strips (element tristrips), which are not read".to_owned());
    }
    let mut soup = Soup::default();
    if let Some(vertices) = ply.element("vertex") {
        soup.positions = vertices.vectors(POSITION).ok_or_else(|| lacks(vertices, &POSITION))?;
        soup.normals = vertices.vectors(NORMAL).unwrap_or_default();
    }
    let Some(faces) = ply.element("face") else { return Ok(soup) };
    let faces = corners(faces)?;
    for (number, corners) in faces.iter().enumerate() {
        let is_index = |&index: &f64| f64::from(index as u32) == index;
        if !faces.are_integers || !corners.iter().all(is_index) {
            return Err(format!("face {number} has no list of vertex numbers"));
        }
        let [first, rest @ ..] = corners else { continue };
        soup.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]].map(|index| index as u32)));
    }
    Ok(soup)
}

/// The vertices of each face.
fn corners(faces: &Element) -> Result<&Lists, String> {
    FACE_LISTS.iter().find_map(|name| faces.lists(name)).ok_or_else(|| lacks(faces, &FACE_LISTS))
}

fn lacks(element: &Element, names: &[&str]) -> String {
    format!("element {} lacks {}", element.name, names.join(", "))
}

/// What follows the header.
struct Body<'a> {
    rest: &'a [u8],
    encoding: Encoding,
    /// The lines of the file that have been read.
    lines: usize,
}

impl<'a> Body<'a> {
    /// All elements of one kind.
    fn read(&mut self, definition: &ElementDef, wanted: impl Fn(&str, &str) -> bool) -> Result<Element, String> {
        let ElementDef { name, count, .. } = definition;
        let properties = definition.properties.iter();
        let mut properties: Vec<_> = properties
            .map(|(property, found)| Property::new(property, &found.data_type, wanted(name, property)))
            .collect();
        for element in 0..*count {
            let ends = || format!("ends after {element} of {count} of element {name}");
            if self.encoding == Encoding::Ascii {
                let mut words = words(self.next_line().ok_or_else(ends)?);
                let mut next = |kind: &ScalarType| text_number(words.next(), kind);
                let read = properties.iter_mut().try_for_each(|property| property.read(&mut next));
                read.map_err(|problem| format!("line {}: {problem}", self.lines))?;
            } else {
                let mut next = |kind: &ScalarType| self.binary_number(kind).ok_or_else(ends);
                properties.iter_mut().try_for_each(|property| property.read(&mut next))?;
            }
        }
        Ok(Element { name: name.clone(), count: *count, properties })
    }

    /// The next line of the text that is not empty.
    fn next_line(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&byte| byte == b'\n').map_or(self.rest.len(), |at| at + 1);
            let (line, rest) = self.rest.split_at(end);
            self.rest = rest;
            self.lines += 1;
            if !line.trim_ascii().is_empty() {
                return Some(line);
            }
        }
        None
    }

    /// The next number of a binary body.
    #[inline]
    fn binary_number(&mut self, kind: &ScalarType) -> Option<f64> {
        let (number, rest) = self.rest.split_at_checked(size(kind))?;
        self.rest = rest;
        let mut bytes = [0; 8];
        bytes[..number.len()].copy_from_slice(number);
        if self.encoding == Encoding::BinaryBigEndian {
            bytes[..number.len()].reverse();
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
}

impl Property {
    fn new(name: &str, data_type: &PropertyType, is_wanted: bool) -> Self {
        let values = || match data_type {
            PropertyType::Scalar(_) => Values::Numbers(Vec::new()),
            PropertyType::List(_, items) => Values::Lists(Lists {
                items: Vec::new(),
                ends: Vec::new(),
                are_integers: !matches!(items, ScalarType::Float | ScalarType::Double),
            }),
        };
        Self { name: name.to_owned(), data_type: data_type.clone(), values: is_wanted.then(values) }
    }

    /// Reads the value of one more element.
    #[inline]
    fn read(&mut self, next: &mut impl FnMut(&ScalarType) -> Result<f64, String>) -> Result<(), String> {
        match (&self.data_type, &mut self.values) {
            (PropertyType::Scalar(kind), values) => {
                let number = next(kind)?;
                if let Some(Values::Numbers(numbers)) = values {
                    numbers.push(number);
                }
            }
            (PropertyType::List(length, items), values) => {
                let count = next(length)?;
                if count < 0.0 || count.fract() != 0.0 {
                    return Err(format!("a list has {count} items"));
                }
                for _ in 0..count as u64 {
                    let item = next(items)?;
                    if let Some(Values::Lists(lists)) = values {
                        lists.items.push(item);
                    }
                }
                if let Some(Values::Lists(lists)) = values {
                    lists.ends.push(lists.items.len());
                }
            }
        }
        Ok(())
    }
}

/// A number of a text, rounded to what a binary file would have.
fn text_number(word: Option<&[u8]>, kind: &ScalarType) -> Result<f64, String> {
    fn parsed<T: FromStr>(word: &[u8]) -> Result<T, String> {
        number(word).ok_or_else(|| format!("{} is not a number that fits the header", shown(word)))
    }
    let word = word.ok_or("fewer numbers than the header announces")?;
    if *kind == ScalarType::Float { parsed::<f32>(word).map(f64::from) } else { parsed(word) }
}

/// The first line of the reader's message: the others repeat the line of the file, of any length.
fn explain(error: ParseError) -> String {
    let message = error.to_string();
    message.lines().next().unwrap_or_default().trim_end_matches('.').replacen("Line", "line", 1)
}

/// Refuses more elements than the rest of the file can hold.
fn check_count(element: &ElementDef, encoding: Encoding, remaining: usize) -> Result<(), String> {
    let smallest: usize = match encoding {
        // A digit and a separator each, of which the last may be missing at the end of the file.
        Encoding::Ascii => 2 * element.properties.len(),
        _ => element.properties.values().map(|property| smallest_size(&property.data_type)).sum(),
    };
    if element.count > 0 && smallest == 0 {
        return Err(format!("element {} has no properties", element.name));
    }
    if element.count.saturating_mul(smallest) > remaining + 1 {
        let (count, name) = (element.count, &element.name);
        return Err(format!("the header announces {count} of element {name}, but only {remaining} bytes follow"));
    }
    Ok(())
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
