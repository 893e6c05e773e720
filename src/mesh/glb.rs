//! Binary glTF 2.0 files: the triangles of all nodes of the scene, in its frame.
//!
//! Vertices are transformed by their nodes in doubles. Points and lines, materials, skins, morph targets and animations are
//! ignored; arrays that are sparse, quantized or compressed are refused, and extensions that a reader has to know.
//!
//! By serde_json and not by the crate gltf: that one panics on damaged files (1.4 in its validation, for an index out of range),
//! and has the places of nodes in floats.

use std::collections::HashSet;

use glam::{DMat4, DQuat, DVec3, DVec4};
use serde_json::Value;

use crate::mesh::load::Soup;
use crate::mesh::source::Source;

/// Nodes below each other; a file with more is broken, or made to be.
const DEEPEST: usize = 256;
/// Nodes may repeat a mesh: vertices per byte of the file beyond which it is taken for one that was made to fill the memory.
const MOST_REPEATED: usize = 16;

const FLOAT: u64 = 5126;
/// The types of indices, with their sizes in bytes.
const INDICES: [(u64, usize); 3] = [(5121, 1), (5123, 2), (5125, 4)];

const TRIANGLES: u64 = 4;
const TRIANGLE_STRIP: u64 = 5;
const TRIANGLE_FAN: u64 = 6;

/// True if a file without a name looks like binary glTF.
pub(super) fn is_likely(source: &mut Source) -> bool {
    source.at_least(4).starts_with(b"glTF")
}

/// Vertices, triangles and normals, or the defect of the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let Scene { positions, triangles, normals, has_normals, .. } = scene(source)?;
    let positions = positions.into_iter().map(|position| position.map(|x| x as f32)).collect();
    Ok(Soup { positions, triangles, normals: if has_normals { normals } else { Vec::new() }, ..Default::default() })
}

/// The vertices in doubles, or the defect of the file.
pub(super) fn doubles(source: &mut Source) -> Result<Vec<[f64; 3]>, String> {
    Ok(scene(source)?.positions)
}

/// The document and the buffer of a file.
struct File<'a> {
    document: Value,
    buffer: &'a [u8],
    length: usize,
}

/// An array of a file, each value of which is within the bytes.
struct Array<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Array<'a> {
    fn values(&self) -> impl Iterator<Item = &'a [u8]> {
        let &Self { bytes, stride, size, count } = self;
        (0..count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

/// A number of the document as an index or a size.
fn whole(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|number| usize::try_from(number).ok())
}

/// Numbers of the document; those that are given if it has none.
fn numbers<const N: usize>(value: &Value, otherwise: [f64; N]) -> Result<[f64; N], String> {
    if value.is_null() {
        return Ok(otherwise);
    }
    let all: Option<Vec<f64>> = value.as_array().and_then(|all| all.iter().map(Value::as_f64).collect());
    all.and_then(|all| all.try_into().ok()).ok_or_else(|| format!("{N} numbers of a node are missing"))
}

impl<'a> File<'a> {
    /// The first chunk of the container is the document, the second one, if there is one, the buffer.
    fn of(bytes: &'a [u8]) -> Result<Self, String> {
        let word = |at: usize| {
            let word = bytes.get(at..at + 4)?;
            Some(u32::from_le_bytes([word[0], word[1], word[2], word[3]]) as usize)
        };
        if !bytes.starts_with(b"glTF") {
            return Err("is not binary glTF: save it as .glb, with its buffers inside".to_owned());
        }
        let chunk = |at: usize, name: &[u8]| {
            let length = word(at)?;
            let is_named = bytes.get(at + 4..at + 8)? == name;
            bytes.get(at + 8..at.checked_add(8)?.checked_add(length)?).filter(|_| is_named)
        };
        let version = word(4).ok_or("ends within its header")?;
        if version != 2 {
            return Err(format!("is glTF of version {version}; 2 is read"));
        }
        if word(8).is_none_or(|length| length > bytes.len()) {
            return Err("ends too early".to_owned());
        }
        let json = chunk(12, b"JSON").ok_or("has no document")?;
        let buffer = chunk(20 + json.len(), b"BIN\0").unwrap_or_default();
        let document = serde_json::from_slice(json).map_err(|error| format!("its document: {error}"))?;
        Ok(Self { document, buffer, length: bytes.len() })
    }

    fn item(&self, list: &str, index: Option<usize>) -> Result<&Value, String> {
        let index = index.ok_or_else(|| format!("one of {list} is not named by its index"))?;
        self.document[list].get(index).ok_or_else(|| format!("{list} have no number {index}"))
    }

    /// An accessor whose values are of a type, and of one of the components, with the size of its component.
    fn array(&self, accessor: &Value, kind: &str, components: &[(u64, usize)]) -> Result<(Array<'a>, usize), String> {
        let accessor = self.item("accessors", whole(accessor))?;
        let component = accessor["componentType"].as_u64();
        let found = components.iter().find(|&&(code, _)| Some(code) == component);
        let (Some(&(_, bytes_each)), true) = (found, accessor["type"] == kind) else {
            return Err(format!("an array of type {}, {}", accessor["type"], accessor["componentType"]));
        };
        if !accessor["sparse"].is_null() {
            return Err("a sparse array".to_owned());
        }
        let view = self.item("bufferViews", whole(&accessor["bufferView"]))?;
        if view["buffer"] != 0 || !self.document["buffers"][0]["uri"].is_null() {
            return Err("an array in another file: save it as .glb, with its buffers inside".to_owned());
        }
        let offset = |value: &Value| if value.is_null() { Some(0) } else { whole(value) };
        let size = bytes_each * if kind == "VEC3" { 3 } else { 1 };
        let found = (|| {
            let start = offset(&view["byteOffset"])?;
            let view_bytes = self.buffer.get(start..start.checked_add(whole(&view["byteLength"])?)?)?;
            let bytes = view_bytes.get(offset(&accessor["byteOffset"])?..)?;
            let stride = if view["byteStride"].is_null() { size } else { whole(&view["byteStride"])?.max(1) };
            let count = whole(&accessor["count"])?;
            let needed = count.checked_sub(1).map_or(Some(0), |steps| steps.checked_mul(stride)?.checked_add(size))?;
            (needed <= bytes.len()).then_some(Array { bytes, stride, size, count })
        })();
        Ok((found.ok_or("an array that ends too early")?, bytes_each))
    }

    fn vectors(&self, accessor: &Value) -> Result<Vec<[f32; 3]>, String> {
        let float = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let (array, _) = self.array(accessor, "VEC3", &[(FLOAT, 4)])?;
        Ok(array.values().map(|bytes| [float(bytes), float(&bytes[4..]), float(&bytes[8..])]).collect())
    }

    fn indices(&self, accessor: &Value) -> Result<Vec<u32>, String> {
        let (array, _) = self.array(accessor, "SCALAR", &INDICES)?;
        let index = |bytes: &[u8]| bytes.iter().rev().fold(0, |index, &byte| index << 8 | u32::from(byte));
        Ok(array.values().map(index).collect())
    }
}

/// The parts of a scene that have been read.
#[derive(Default)]
struct Scene {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// A normal for each position; zero where the file has none.
    normals: Vec<[f32; 3]>,
    has_normals: bool,
    /// The nodes that have been read: each has one parent at most, or the scene would grow beyond all bounds.
    read: HashSet<usize>,
}

fn scene(source: &mut Source) -> Result<Scene, String> {
    let bytes = source.whole();
    let file = File::of(&bytes)?;
    let required = file.document["extensionsRequired"].as_array();
    let is_looks = |name: &str| name.starts_with("KHR_materials") || name.starts_with("KHR_texture");
    for name in required.into_iter().flatten() {
        if !name.as_str().is_some_and(is_looks) {
            return Err(format!("requires an extension that is not read: {name}"));
        }
    }
    let number = if file.document["scene"].is_null() { Some(0) } else { whole(&file.document["scene"]) };
    let mut scene = Scene::default();
    for node in file.item("scenes", number)?["nodes"].as_array().into_iter().flatten() {
        scene.add(&file, node, DMat4::IDENTITY, 0)?;
    }
    Ok(scene)
}

/// The transform of a node relative to its parent.
fn transform(node: &Value) -> Result<DMat4, String> {
    if !node["matrix"].is_null() {
        return Ok(DMat4::from_cols_array(&numbers(&node["matrix"], [0.0; 16])?));
    }
    let translation = DVec3::from(numbers(&node["translation"], [0.0; 3])?);
    let rotation = DVec4::from(numbers(&node["rotation"], [0.0, 0.0, 0.0, 1.0])?).normalize_or_zero();
    let scale = DVec3::from(numbers(&node["scale"], [1.0; 3])?);
    Ok(DMat4::from_scale_rotation_translation(scale, DQuat::from_vec4(rotation), translation))
}

impl Scene {
    fn add(&mut self, file: &File, index: &Value, parent: DMat4, depth: usize) -> Result<(), String> {
        let node = file.item("nodes", whole(index))?;
        if depth > DEEPEST {
            return Err(format!("its nodes are more than {DEEPEST} deep"));
        }
        if !self.read.insert(whole(index).unwrap_or_default()) {
            return Err(format!("node {index} has two parents"));
        }
        let transform = parent * transform(node)?;
        if !node["mesh"].is_null() {
            for primitive in file.item("meshes", whole(&node["mesh"]))?["primitives"].as_array().into_iter().flatten() {
                self.add_primitive(file, primitive, transform)
                    .map_err(|problem| format!("mesh {}: {problem}", node["mesh"]))?;
            }
        }
        let children = node["children"].as_array().into_iter().flatten();
        children.into_iter().try_for_each(|child| self.add(file, child, transform, depth + 1))
    }

    /// Room for the vertices and triangles of a primitive, or an error where they would be more than can be held.
    fn reserve(&mut self, vertices: usize, triangles: usize, length: usize) -> Result<(), String> {
        let most = length.saturating_mul(MOST_REPEATED).min(u32::MAX as usize);
        let all = [self.positions.len() + vertices, self.triangles.len() + triangles];
        let is_held = all.iter().all(|&number| number <= most)
            && self.positions.try_reserve(vertices).is_ok()
            && self.normals.try_reserve(vertices).is_ok()
            && self.triangles.try_reserve(triangles).is_ok();
        if is_held {
            Ok(())
        } else {
            Err(format!("with it {} vertices and {} triangles would have to be held", all[0], all[1]))
        }
    }

    fn add_primitive(&mut self, file: &File, primitive: &Value, transform: DMat4) -> Result<(), String> {
        let mode = if primitive["mode"].is_null() { Some(TRIANGLES) } else { primitive["mode"].as_u64() };
        let Some(mode @ (TRIANGLES | TRIANGLE_STRIP | TRIANGLE_FAN)) = mode else { return Ok(()) };
        let attributes = &primitive["attributes"];
        let positions = file.vectors(&attributes["POSITION"]).map_err(|problem| format!("positions: {problem}"))?;
        let normals = match &attributes["NORMAL"] {
            Value::Null => Vec::new(),
            accessor => file.vectors(accessor).map_err(|problem| format!("normals: {problem}"))?,
        };
        let corners = match &primitive["indices"] {
            Value::Null => (0..positions.len() as u32).collect(),
            accessor => file.indices(accessor).map_err(|problem| format!("indices: {problem}"))?,
        };
        if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= positions.len()) {
            return Err(format!("indices: vertex {corner}, of {}", positions.len()));
        }
        self.reserve(positions.len(), corners.len(), file.length)?;
        let base = self.positions.len() as u32;
        let is_mirrored = transform.determinant() < 0.0;
        // A mirror would turn the triangles inside out (glTF 2.0, section 3.7.4).
        let triangle =
            |a: u32, b: u32, c: u32| if is_mirrored { [a, c, b] } else { [a, b, c] }.map(|corner| base + corner);
        match mode {
            TRIANGLE_STRIP => self.triangles.extend(corners.windows(3).enumerate().map(|(i, corner)| {
                let [a, b] = if i.is_multiple_of(2) { [0, 1] } else { [1, 0] };
                triangle(corner[a], corner[b], corner[2])
            })),
            TRIANGLE_FAN => {
                let edges = corners.get(1..).unwrap_or_default().windows(2);
                self.triangles.extend(edges.map(|edge| triangle(corners[0], edge[0], edge[1])));
            }
            _ => self.triangles.extend(corners.chunks_exact(3).map(|corner| triangle(corner[0], corner[1], corner[2]))),
        }
        let place = |position: [f32; 3]| transform.transform_point3(DVec3::from(position.map(f64::from))).to_array();
        self.positions.extend(positions.iter().copied().map(place));
        let of_normals = transform.inverse().transpose();
        let turned = |normal: [f32; 3]| {
            let normal = of_normals.transform_vector3(DVec3::from(normal.map(f64::from)));
            normal.normalize_or_zero().as_vec3().to_array()
        };
        self.has_normals |= !normals.is_empty();
        self.normals.extend(normals.into_iter().map(turned));
        self.normals.resize(self.positions.len(), [0.0; 3]);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    /// A file of one document and its buffer.
    fn file(document: &str, buffer: &[u8]) -> Vec<u8> {
        let mut json = document.as_bytes().to_vec();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut buffer = buffer.to_vec();
        buffer.resize(buffer.len().next_multiple_of(4), 0);
        let word = |number: usize| (number as u32).to_le_bytes();
        let length = 12 + 8 + json.len() + 8 + buffer.len();
        [
            b"glTF",
            &word(2)[..],
            &word(length),
            &word(json.len()),
            b"JSON",
            &json,
            &word(buffer.len()),
            b"BIN\0",
            &buffer,
        ]
        .concat()
    }

    fn parsed(bytes: &[u8]) -> Result<Soup, String> {
        parse(&mut Source::new(&mut Cursor::new(bytes), bytes.len() as u64))
    }

    /// Four vertices of the unit square, two triangles, in nodes that are given as JSON.
    fn square(nodes: &str, mode: u32, count: usize) -> Vec<u8> {
        let positions = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let indices = [0u16, 1, 2, 2, 1, 3];
        let mut buffer: Vec<u8> = positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        buffer.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
        let indexed = if mode == 4 { r#""indices": 1, "# } else { "" };
        let document = format!(
            r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": {nodes},
            "meshes": [{{"primitives": [{{{indexed}"mode": {mode}, "attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [
                {{"bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
                {{"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 12}}],
            "buffers": [{{"byteLength": 60}}]}}"#
        );
        file(&document, &buffer)
    }

    #[test]
    fn triangles_of_all_modes_are_read() {
        let node = r#"[{"mesh": 0}]"#;
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let triangles = |mode| {
            let soup = parsed(&square(node, mode, 4)).unwrap();
            assert_eq!(soup.positions, positions);
            soup.triangles
        };
        assert_eq!(triangles(4), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(5), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(6), [[0, 1, 2], [0, 2, 3]]);
        assert!(parsed(&square(node, 1, 4)).unwrap().triangles.is_empty(), "lines");
    }

    #[test]
    fn nodes_move_their_meshes_in_doubles() {
        let nodes = r#"[{"translation": [4000000, 0, 0], "children": [1, 2]}, {"mesh": 0, "scale": [0.25, 0.25, 1]},
            {"mesh": 0, "rotation": [0, 0, 1, 0]}]"#;
        let bytes = square(nodes, 4, 4);
        let exact = doubles(&mut Source::new(&mut Cursor::new(&bytes), bytes.len() as u64)).unwrap();
        assert_eq!(exact[3], [4_000_000.25, 0.25, 0.0]);
        assert_eq!(exact[7], [3_999_999.0, -1.0, 0.0]);
        assert_eq!(parsed(&bytes).unwrap().triangles[2..], [[4, 5, 6], [6, 5, 7]]);
    }

    #[test]
    fn mirrored_meshes_are_not_turned_inside_out() {
        let soup = parsed(&square(r#"[{"mesh": 0, "scale": [-2, 1, 1]}]"#, 4, 4)).unwrap();
        assert_eq!(soup.positions[1], [-2.0, 0.0, 0.0]);
        assert_eq!(soup.triangles, [[0, 2, 1], [2, 3, 1]]);
    }

    #[test]
    fn files_that_repeat_a_mesh_to_fill_the_memory_are_refused() {
        let children: Vec<String> = (1..10_000).map(|node| node.to_string()).collect();
        let nodes = vec![r#"{"mesh":0}"#; 9_999].join(",");
        let bytes = square(&format!(r#"[{{"children": [{}]}}, {nodes}]"#, children.join(",")), 4, 4);
        assert_eq!(parsed(&bytes).unwrap().positions.len(), 4 * 9_999);

        let triangles = vec![r#"{"attributes": {"POSITION": 0}}"#; 500].join(",");
        let document = format!(
            r#"{{"scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{triangles}]}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 9000, "type": "VEC3"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 9012, "byteStride": 1}}], "buffers": [{{"byteLength": 9012}}]}}"#
        );
        let reason = parsed(&file(&document, &[0; 9012])).err().expect("refused");
        assert!(reason.starts_with("mesh 0: with it "), "{reason}");
    }

    #[test]
    fn broken_files_are_refused() {
        let reason = |bytes: &[u8]| parsed(bytes).err().expect("refused");
        assert!(reason(b"{}").starts_with("is not binary glTF"));
        assert_eq!(reason(&square(r#"[{"mesh": 0}]"#, 4, 5)), "mesh 0: positions: an array that ends too early");
        assert_eq!(reason(&square(r#"[{"mesh": 0}]"#, 4, 3)), "mesh 0: indices: vertex 3, of 3");
        let whole = square(r#"[{"mesh": 0}]"#, 4, 4);
        for length in 0..whole.len() {
            assert!(parsed(&whole[..length]).is_err(), "cut to {length}");
        }
        let reason = reason(&square(r#"[{"mesh": 0, "children": [0]}]"#, 4, 4));
        assert_eq!(reason, "node 0 has two parents");
    }
}
