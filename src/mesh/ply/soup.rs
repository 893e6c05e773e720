//! The mesh in a PLY file.

use ply_rs_bw::ply::{ElementDef, PropertyType, ScalarType};

use crate::mesh::ply::open;
use crate::mesh::soup::Soup;
use crate::mesh::source::Source;

/// The coordinates of a vertex.
const POSITION: [&str; 3] = ["x", "y", "z"];
/// The coordinates of its normal, if it has one.
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The two names in use for the list of a face's vertices.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Vertices, triangles and normals, or what is wrong with the file.
pub(in crate::mesh) fn parse(source: &mut Source) -> Result<Soup, String> {
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

/// Whether a property lists integers.
fn has_integers(definition: &ElementDef, property: usize) -> bool {
    let items = match &definition.properties[property].data_type {
        PropertyType::Scalar(items) | PropertyType::List(_, items) => items,
    };
    !matches!(items, ScalarType::Float | ScalarType::Double)
}

fn lacks(definition: &ElementDef, names: &[&str]) -> String {
    format!("element {} lacks {}", definition.name, names.join(", "))
}
