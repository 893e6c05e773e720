//! PLY files, ASCII and binary, by the crate ply-rs-bw.
//!
//! The crate reads as many elements as the header claims, so the claim is held against the size of the file first. Its
//! reader of text refuses numbers such as `.5`, `1.` and `nan`, and empty lines; [`Body::read_text`] stands in for it.

use std::str::FromStr;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};

use crate::mesh::Soup;
use crate::mesh::text::{number, shown, words};

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
    if !bytes.starts_with(b"ply") {
        return Err("is no PLY file: it does not begin with \"ply\"".to_owned());
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(explain)?;
    let remaining = reader.get_ref().len();
    let lines = bytes[..bytes.len() - remaining].iter().filter(|&&byte| byte == b'\n').count();
    let mut body = Body { header: &header, reader, lines };
    let mut soup = Soup::default();
    for element in header.elements.values() {
        check_count(element, &header, body.reader.get_ref().len())?;
        match element.name.as_str() {
            "vertex" => {
                require(element, &POSITION)?;
                let vertices = body.read::<Vertex>(element)?;
                soup.positions = vertices.iter().map(|vertex| vertex.position).collect();
                if has_all(element, &NORMAL) {
                    soup.normals = vertices.iter().map(|vertex| vertex.normal).collect();
                }
            }
            "face" => {
                require(element, &FACE_LISTS)?;
                for (number, face) in body.read::<Face>(element)?.into_iter().enumerate() {
                    let corners = face.0.ok_or_else(|| format!("face {number} has no list of vertex numbers"))?;
                    let [first, rest @ ..] = corners.as_slice() else { continue };
                    soup.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
                }
            }
            "tristrips" => return Err("has triangle strips (element tristrips), which are not read".to_owned()),
            _ => drop(body.read::<Skipped>(element)?),
        }
    }
    Ok(soup)
}

/// The coordinates of a vertex.
const POSITION: [&str; 3] = ["x", "y", "z"];
/// Those of its normal, if it has one.
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The two names in use for the list of a face's vertices.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

#[derive(Default)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = |names: [&str; 3]| names.iter().position(|&axis| axis == name);
        let place = match (axis(POSITION), axis(NORMAL)) {
            (Some(axis), _) => &mut self.position[axis],
            (_, Some(axis)) => &mut self.normal[axis],
            _ => return PropertyAccessResult::Ignored,
        };
        let Some(value) = property.to_f32_lossy() else { return PropertyAccessResult::UnsupportedType };
        *place = value;
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct Face(Option<Vec<u32>>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !FACE_LISTS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.0 = property.to_u32_list();
        PropertyAccessResult::Set
    }
}

/// An element that is read past. It takes no memory.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

/// What follows the header.
struct Body<'a> {
    header: &'a Header,
    reader: Reader<&'a [u8]>,
    /// The lines of the file that have been read.
    lines: usize,
}

impl<'a> Body<'a> {
    fn read<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<Vec<E>, String> {
        match self.header.encoding {
            Encoding::Ascii => self.read_text(element),
            _ => Parser::new().read_payload_for_element(&mut self.reader, element, self.header).map_err(explain),
        }
    }

    /// Elements in text, one to a line. Empty lines are skipped.
    fn read_text<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<Vec<E>, String> {
        let mut elements = Vec::new();
        while elements.len() < element.count {
            if self.reader.get_ref().is_empty() {
                return Err(format!("ends after {} of {} of element {}", elements.len(), element.count, element.name));
            }
            let line = self.next_line();
            if line.trim_ascii().is_empty() {
                continue;
            }
            let (mut read, mut words) = (E::new(), words(line));
            for (name, property) in &element.properties {
                let value = property_of(&mut words, &property.data_type);
                read.set_property(name, value.map_err(|problem| format!("line {}: {problem}", self.lines))?);
            }
            elements.push(read);
        }
        Ok(elements)
    }

    /// The next line of the text.
    fn next_line(&mut self) -> &'a [u8] {
        let rest = *self.reader.get_ref();
        let end = rest.iter().position(|&byte| byte == b'\n').map_or(rest.len(), |at| at + 1);
        *self.reader.get_mut() = &rest[end..];
        self.lines += 1;
        &rest[..end]
    }
}

/// The value of a property, from the words of a line.
fn property_of<'a>(words: &mut impl Iterator<Item = &'a [u8]>, data_type: &PropertyType) -> Result<Property, String> {
    fn next<'a, T: FromStr>(words: &mut impl Iterator<Item = &'a [u8]>) -> Result<T, String> {
        let word = words.next().ok_or("fewer numbers than the header announces")?;
        number(word).ok_or_else(|| format!("{} is not a number that fits the header", shown(word)))
    }
    let PropertyType::List(_, items) = data_type else { return next(words).map(Property::Float) };
    let count: usize = next(words)?;
    let values = (0..count).map(|_| next(words)).collect::<Result<Vec<f64>, _>>()?;
    let is_index = |&value: &f64| f64::from(value as u32) == value;
    Ok(match items {
        ScalarType::Float | ScalarType::Double => Property::ListDouble(values),
        _ if values.iter().all(is_index) => Property::ListUInt(values.iter().map(|&value| value as u32).collect()),
        // No list of indices: only what is skipped can be so.
        _ => Property::ListDouble(values),
    })
}

/// The first line of the reader's message: the others repeat the line of the file, of any length.
fn explain(error: ParseError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

/// Refuses coordinates that are missing (any of three) and faces without either list.
fn require(element: &ElementDef, names: &[&str]) -> Result<(), String> {
    let has_any = names.iter().any(|name| element.properties.contains_key(*name));
    let found = if element.name == "face" { has_any } else { has_all(element, names) };
    found.then_some(()).ok_or_else(|| format!("element {} lacks {}", element.name, names.join(", ")))
}

fn has_all(element: &ElementDef, names: &[&str]) -> bool {
    names.iter().all(|name| element.properties.contains_key(*name))
}

/// Refuses more elements than the rest of the file can hold.
fn check_count(element: &ElementDef, header: &Header, remaining: usize) -> Result<(), String> {
    let smallest: usize = match header.encoding {
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
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}
