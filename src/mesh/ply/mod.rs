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

mod body;
mod soup;

use std::io::Cursor;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, ElementDef, Header, PropertyDef, PropertyType};

use crate::mesh::ply::body::{Body, Row};
use crate::mesh::source::Source;

pub(super) use soup::parse;

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
    /// Where each list ends in `items`.
    ends: Vec<usize>,
}

impl Ply {
    /// Reads the properties for which `wanted(element, property)` is true. The whole file is checked.
    ///
    /// Memory stays proportional to the size of the file, whatever its header claims.
    ///
    /// # Errors
    /// What is wrong with the file, in one line.
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

    /// Takes what was asked for of one more element.
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

    /// The names of all properties, in the order of the file, also of those that were not asked for.
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

/// The number of triangles that [`Mesh::load`](super::Mesh::load) makes of each face of a PLY file: polygons are cut into
/// fans. So an attribute of faces becomes one of triangles.
///
/// # Errors
/// What is wrong with the file, in one line.
pub fn triangles_of_faces(bytes: &[u8]) -> Result<Vec<usize>, String> {
    let mut input = Cursor::new(bytes);
    let mut source = Source::new(&mut input, bytes.len() as u64);
    let (header, mut body) = open(&mut source)?;
    let mut triangles = Vec::new();
    for definition in header.elements.values() {
        let corners = if definition.name == "face" { Some(soup::corners(definition)?) } else { None };
        body.read(definition, |row| {
            triangles.extend(corners.map(|corners| row.lists[corners].len().saturating_sub(2)));
            Ok(())
        })?;
    }
    Ok(triangles)
}

/// Whether contents without a name look like PLY.
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
