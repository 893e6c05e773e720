//! PLY files, ASCII and binary, by the crate ply-rs-bw.
//!
//! The crate reads as many elements as the header claims, so the claim is held against the size of the file first.

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};

use super::Soup;

/// Vertices and triangles, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Soup {
    let mut reader = Reader::new(bytes);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(explain)?;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for element in header.elements.values() {
        check_count(element, &header, reader.get_ref().len())?;
        match element.name.as_str() {
            "vertex" => {
                require(element, &["x", "y", "z"])?;
                positions = read::<Vertex>(&mut reader, element, &header)?.into_iter().map(|vertex| vertex.0).collect();
            }
            "face" => {
                require(element, &FACE_LISTS)?;
                for (number, face) in read::<Face>(&mut reader, element, &header)?.into_iter().enumerate() {
                    let corners = face.0.ok_or_else(|| format!("face {number} has no list of vertex numbers"))?;
                    let [first, rest @ ..] = corners.as_slice() else { continue };
                    triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
                }
            }
            _ => drop(read::<Skipped>(&mut reader, element, &header)?),
        }
    }
    Ok((positions, triangles))
}

/// The two names in use for the list of a face's vertices.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

#[derive(Default)]
struct Vertex([f32; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(axis) = ["x", "y", "z"].iter().position(|&axis| axis == name) else {
            return PropertyAccessResult::Ignored;
        };
        let Some(value) = property.to_f32_lossy() else { return PropertyAccessResult::UnsupportedType };
        self.0[axis] = value;
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

fn read<E: PropertyAccess>(
    reader: &mut Reader<&[u8]>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, String> {
    Parser::new().read_payload_for_element(reader, element, header).map_err(explain)
}

/// The first line of the reader's message: the others repeat the line of the file, of any length.
fn explain(error: ParseError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

/// Refuses coordinates that are missing (any of three) and faces without either list.
fn require(element: &ElementDef, names: &[&str]) -> Result<(), String> {
    let has = |name: &&str| element.properties.contains_key(*name);
    let found = if element.name == "face" { names.iter().any(has) } else { names.iter().all(has) };
    found.then_some(()).ok_or_else(|| format!("element {} lacks {}", element.name, names.join(", ")))
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
