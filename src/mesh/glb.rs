//! Binary glTF 2.0 files: the triangles of all nodes of the scene, in its frame, by the crate gltf.
//!
//! Vertices are transformed by their nodes in doubles. Points and lines, materials, skins, morph targets and animations are
//! ignored; a primitive whose arrays are compressed by an extension, or sparse, is refused. Accessors are read here: the
//! iterators of the crate panic where an array ends too early. The crate has the places of nodes in floats: far from the
//! origin a node may move by the rounding, its mesh keeps its shape.

use std::collections::HashSet;

use glam::{DMat4, DVec3};
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::mesh::Mode;
use gltf::{Gltf, Node, Primitive, Semantic};

use crate::mesh::load::Soup;
use crate::mesh::source::Source;

/// Nodes below each other; a file with more is broken, or made to be.
const DEEPEST: usize = 256;

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

/// What has been read of a scene.
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
    if !bytes.starts_with(b"glTF") {
        return Err("is not binary glTF: save it as .glb, with its buffers inside".to_owned());
    }
    let file = Gltf::from_slice(&bytes).map_err(|error| error.to_string())?;
    let blob = file.blob.as_deref().unwrap_or_default();
    let mut scene = Scene::default();
    let root = file.default_scene().or_else(|| file.scenes().next()).ok_or("has no scene")?;
    for node in root.nodes() {
        scene.add(&node, DMat4::IDENTITY, blob, 0)?;
    }
    Ok(scene)
}

impl Scene {
    fn add(&mut self, node: &Node, parent: DMat4, blob: &[u8], depth: usize) -> Result<(), String> {
        if depth > DEEPEST {
            return Err(format!("its nodes are more than {DEEPEST} deep"));
        }
        if !self.read.insert(node.index()) {
            return Err(format!("node {} has two parents", node.index()));
        }
        let [x, y, z, w] = node.transform().matrix().map(|column| column.map(f64::from));
        let transform = parent * DMat4::from_cols_array_2d(&[x, y, z, w]);
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            let name = || format!("mesh {}", node.mesh().map_or(0, |mesh| mesh.index()));
            self.add_primitive(&primitive, transform, blob).map_err(|problem| format!("{}: {problem}", name()))?;
        }
        node.children().try_for_each(|child| self.add(&child, transform, blob, depth + 1))
    }

    fn add_primitive(&mut self, primitive: &Primitive, transform: DMat4, blob: &[u8]) -> Result<(), String> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(());
        }
        let positions = primitive.get(&Semantic::Positions).ok_or("a primitive without positions")?;
        let positions = vectors(&positions, blob).map_err(|problem| format!("positions: {problem}"))?;
        let normals = match primitive.get(&Semantic::Normals) {
            Some(accessor) => vectors(&accessor, blob).map_err(|problem| format!("normals: {problem}"))?,
            None => Vec::new(),
        };
        let corners = match primitive.indices() {
            Some(accessor) => indices(&accessor, blob).map_err(|problem| format!("indices: {problem}"))?,
            None => (0..positions.len() as u32).collect(),
        };
        if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= positions.len()) {
            return Err(format!("indices: vertex {corner}, of {}", positions.len()));
        }
        let vertices = self.positions.len() + positions.len();
        if u32::try_from(vertices).is_err() || self.positions.try_reserve(positions.len()).is_err() {
            return Err(format!("{vertices} vertices cannot be held"));
        }
        self.normals.try_reserve(positions.len()).map_err(|_| "its normals cannot be held")?;
        self.triangles.try_reserve(corners.len()).map_err(|_| "its triangles cannot be held")?;
        let base = self.positions.len() as u32;
        let triangle = |a: u32, b: u32, c: u32| [base + a, base + b, base + c];
        match primitive.mode() {
            Mode::TriangleStrip => self.triangles.extend(corners.windows(3).enumerate().map(|(i, corner)| {
                let [a, b] = if i.is_multiple_of(2) { [0, 1] } else { [1, 0] };
                triangle(corner[a], corner[b], corner[2])
            })),
            Mode::TriangleFan => {
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

/// The values of an accessor, each of `size` bytes.
fn values<'a>(accessor: &Accessor, size: usize, blob: &'a [u8]) -> Result<impl Iterator<Item = &'a [u8]>, String> {
    if accessor.sparse().is_some() {
        return Err("a sparse array".to_owned());
    }
    let view = accessor.view().ok_or("an array without values")?;
    if view.buffer().index() > 0 || !matches!(view.buffer().source(), gltf::buffer::Source::Bin) {
        return Err("an array in another file: save it as .glb, with its buffers inside".to_owned());
    }
    let bytes = view.offset().checked_add(view.length()).and_then(|end| blob.get(view.offset()..end));
    let bytes = bytes.and_then(|bytes| bytes.get(accessor.offset()..)).ok_or("an array that ends too early")?;
    let (stride, count) = (view.stride().unwrap_or(size).max(1), accessor.count());
    let needed = count.checked_sub(1).map_or(Some(0), |steps| steps.checked_mul(stride)?.checked_add(size));
    if needed.is_none_or(|needed| needed > bytes.len()) {
        return Err("an array that ends too early".to_owned());
    }
    Ok((0..count).map(move |i| &bytes[i * stride..i * stride + size]))
}

fn vectors(accessor: &Accessor, blob: &[u8]) -> Result<Vec<[f32; 3]>, String> {
    if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
        return Err("an array of other values than three floats".to_owned());
    }
    let float = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    Ok(values(accessor, 12, blob)?.map(|bytes| [float(bytes), float(&bytes[4..]), float(&bytes[8..])]).collect())
}

fn indices(accessor: &Accessor, blob: &[u8]) -> Result<Vec<u32>, String> {
    if accessor.dimensions() != Dimensions::Scalar {
        return Err("an array of other values than indices".to_owned());
    }
    Ok(match accessor.data_type() {
        DataType::U8 => values(accessor, 1, blob)?.map(|bytes| bytes[0].into()).collect(),
        DataType::U16 => {
            values(accessor, 2, blob)?.map(|bytes| u16::from_le_bytes([bytes[0], bytes[1]]).into()).collect()
        }
        DataType::U32 => values(accessor, 4, blob)?
            .map(|bytes| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
            .collect(),
        _ => return Err("an array of other values than indices".to_owned()),
    })
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
