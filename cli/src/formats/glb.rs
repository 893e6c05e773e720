//! glTF 2.0, binary: samples as instances by the extension `EXT_mesh_gpu_instancing`, one node for each class.
//!
//! Every class has an octahedron of diameter 1 that stands for what a user puts in its place, scaled by the radius and turned
//! from y to the normal. `_ID` counts the samples of the set, and `_RANK` has their ranks.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::scene::Scene;

const EXTENSION: &str = "EXT_mesh_gpu_instancing";
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_SHORT: u32 = 5123;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The corners of the octahedron, and its faces.
const CORNERS: [[f32; 3]; 6] =
    [[0.5, 0.0, 0.0], [-0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, -0.5]];
const FACES: [[u16; 3]; 8] = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

/// The arrays of a file: their bytes one after the other, and what describes them.
#[derive(Default)]
struct Arrays {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Arrays {
    /// Adds an array of as many values as `count`, and returns its number.
    fn add(&mut self, bytes: Vec<u8>, count: usize, component: u32, kind: &str, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = self.views.len() - 1;
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }));
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, vectors: impl Iterator<Item = [f32; N]>, target: Option<u32>) -> usize {
        let bytes: Vec<u8> = vectors.flatten().flat_map(f32::to_le_bytes).collect();
        let count = bytes.len() / (4 * N);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.add(bytes, count, FLOAT, kind, target)
    }
}

/// Writes samples as instances.
pub fn write(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    let mut arrays = Arrays::default();
    let primitive = octahedron(&mut arrays);
    let [x, y, z] = scene.origin;
    let mut nodes = Vec::new();
    for class in 0..scene.class_count() {
        let members: Vec<_> = (0..scene.len()).filter(|&sample| scene.class(sample) == class).collect();
        // An accessor has at least one value.
        if !members.is_empty() {
            let attributes = instances(&mut arrays, scene, &members);
            nodes.push(json!({
                "name": format!("class{class}"),
                "mesh": class,
                "translation": [x, y, z],
                "extensions": { EXTENSION: { "attributes": attributes } },
            }));
        }
    }
    let mesh = |class| json!({ "name": format!("class{class}"), "primitives": [primitive] });
    let length = arrays.bytes.len();
    let document = json!({
        "asset": { "version": "2.0", "generator": "azulejo" },
        "extensionsUsed": [EXTENSION],
        "extensionsRequired": [EXTENSION],
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": (0..scene.class_count()).map(mesh).collect::<Vec<_>>(),
        "accessors": arrays.accessors,
        "bufferViews": arrays.views,
        "buffers": [{ "byteLength": length }],
    });
    container(writer, &document, &arrays.bytes)
}

fn octahedron(arrays: &mut Arrays) -> Value {
    let positions = arrays.floats(CORNERS.into_iter(), Some(ARRAY_BUFFER));
    arrays.accessors[positions]["min"] = json!([-0.5, -0.5, -0.5]);
    arrays.accessors[positions]["max"] = json!([0.5, 0.5, 0.5]);
    let indices: Vec<u8> = FACES.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
    let indices = arrays.add(indices, 3 * FACES.len(), UNSIGNED_SHORT, "SCALAR", Some(ELEMENT_ARRAY_BUFFER));
    json!({ "attributes": { "POSITION": positions }, "indices": indices })
}

fn instances(arrays: &mut Arrays, scene: &Scene, members: &[usize]) -> Map<String, Value> {
    let mut attributes = Map::new();
    let mut set = |name: &str, accessor: usize| attributes.insert(name.to_owned(), json!(accessor));
    let each = || members.iter().copied();
    set("TRANSLATION", arrays.floats(each().map(|sample| scene.positions[sample]), None));
    if !scene.normals.is_empty() {
        set("ROTATION", arrays.floats(each().map(|sample| scene.rotation(sample)), None));
    }
    if let Some(radii) = each().map(|sample| scene.radius(sample)).collect::<Option<Vec<_>>>() {
        set("SCALE", arrays.floats(radii.into_iter().map(|radius| [radius as f32; 3]), None));
    }
    let ids = each().flat_map(|sample| (sample as u32).to_le_bytes()).collect();
    set("_ID", arrays.add(ids, members.len(), UNSIGNED_INT, "SCALAR", None));
    if !scene.ranks.is_empty() {
        // The first rank is infinite, which the format does not have.
        set("_RANK", arrays.floats(each().map(|sample| [scene.ranks[sample].min(f32::MAX)]), None));
    }
    attributes
}

/// The container: a header, the document padded with blanks, and the arrays.
fn container(writer: &mut impl Write, document: &Value, arrays: &[u8]) -> io::Result<()> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length =
        |bytes: usize| u32::try_from(bytes).map_err(|_| io::Error::other("more than 4 GB, which glTF cannot hold"));
    let whole = length(12 + 8 + json.len() + 8 + arrays.len())?;
    writer.write_all(b"glTF")?;
    [2, whole].iter().try_for_each(|word| writer.write_all(&word.to_le_bytes()))?;
    for (name, bytes) in [(b"JSON", &json[..]), (b"BIN\0", arrays)] {
        writer.write_all(&length(bytes.len())?.to_le_bytes())?;
        writer.write_all(name)?;
        writer.write_all(bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::points::PointTable;

    #[test]
    fn instances_of_each_class_are_arrays_of_one_buffer() {
        let points = [[1.0f32, 2.0], [3.0, 4.0], [5.0, 6.0]];
        let ranks = [f32::INFINITY, 2.0, 1.0];
        let table =
            PointTable { ranks: &ranks, classes: &[0, 2, 0], class_radii: &[0.5, 1.0, 2.0], ..PointTable::of(&points) };
        let mut file = Vec::new();
        write(&mut file, &Scene::of_points(&table)).unwrap();
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert!(file.starts_with(b"glTF") && word(4) == 2 && word(8) == file.len());
        let document: Value = serde_json::from_slice(&file[20..20 + word(12)]).unwrap();
        let arrays = &file[28 + word(12)..];
        assert_eq!(document["buffers"][0]["byteLength"], arrays.len());
        let floats = |node: usize, name: &str| -> Vec<f32> {
            let accessor = &document["nodes"][node]["extensions"][EXTENSION]["attributes"][name];
            let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
            let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
            let [start, length] = ["byteOffset", "byteLength"].map(|name| view[name].as_u64().unwrap() as usize);
            arrays[start..start + length].chunks(4).map(|x| f32::from_le_bytes(x.try_into().unwrap())).collect()
        };
        assert_eq!(floats(0, "TRANSLATION"), [1.0, 2.0, 0.0, 5.0, 6.0, 0.0]);
        assert_eq!(floats(0, "_RANK"), [f32::MAX, 1.0]);
        assert_eq!(floats(1, "SCALE"), [2.0; 3]);
        assert_eq!(floats(1, "_ID").iter().map(|id| id.to_bits()).collect::<Vec<_>>(), [1]);
        assert_eq!(document["nodes"].as_array().unwrap().len(), 2);
        assert_eq!(document["nodes"][1]["mesh"], 2);
    }

    #[test]
    fn faces_of_the_octahedron_face_outwards() {
        for face in FACES {
            let [a, b, c] = face.map(|corner| glam::Vec3::from(CORNERS[usize::from(corner)]));
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "{face:?}");
        }
    }
}
