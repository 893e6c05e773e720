//! Mesh files with damage: each is loaded or refused, and nothing panics, hangs or takes memory that it has no use for.

use azulejo::Error;
use azulejo::mesh::Mesh;

const OBJ: &str = "# box\nv 0 0 0\nv 1 0 0 1.0\nv 1. 1 0 .1 .2 .3\nv 0 1e0 -0\nvn 0 0 1\nvn 0 1 0\ng a\nf 1//1 2/7/2 3 4/1\n\
    f -4 -3 \\\n -2\r\nl 1 2\n";

/// A file with vertices, normals, something else, and faces.
fn ply(format: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n\
        property float nx\nproperty float ny\nproperty float nz\nelement tag 1\nproperty list uchar int numbers\n\
        element face 2\nproperty uchar kind\nproperty list uchar uint vertex_indices\nend_header\n"
    );
    let mut file = header.into_bytes();
    if format == "ascii" {
        file.extend(b"0 0 0 0 0 1\n1 .5 -2 nan 0 1\n0 1 7 1e0 0 0\n2 5 -6\n1 3 0 1 2\n0 3 2 1 0\n");
        return file;
    }
    let big = format == "binary_big_endian";
    let mut put = |bytes: &[u8]| if big { file.extend(bytes.iter().rev()) } else { file.extend(bytes) };
    for i in 0..3u8 {
        put(&f32::from(i).to_le_bytes());
        put(&f64::from(i * i).to_le_bytes());
        put(&i16::from(i).to_le_bytes());
        [0.0f32, 0.0, 1.0].iter().for_each(|x| put(&x.to_le_bytes()));
    }
    put(&[2]);
    [5i32, -6].iter().for_each(|x| put(&x.to_le_bytes()));
    for face in [[0u32, 1, 2], [2, 1, 0]] {
        put(&[9]);
        put(&[3]);
        face.iter().for_each(|x| put(&x.to_le_bytes()));
    }
    file
}

const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
    endsolid a\nsolid b\nfacet\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1 1\nendloop\nendfacet\nendsolid\n";

fn binary_stl() -> Vec<u8> {
    let mut file = vec![b' '; 80];
    file.extend(1u32.to_le_bytes());
    let facet = [[0.0f32, 0.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    file.extend(facet.iter().flatten().flat_map(|x| x.to_le_bytes()));
    file.extend([0, 0]);
    file
}

const OFF: &str = "NOFF\n# a square\n4 2 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n1. 1 0 0 0 1 .5\n0 1e0 -0 1 0 0\n4 0 1 2 3\n\n3 0 1 2 255 0 0\n";

/// A triangle in two nodes.
fn glb() -> Vec<u8> {
    let document = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[1],
        "translation":[1,2,3]},{"mesh":0,"scale":[2,2,2]}],"meshes":[{"primitives":[{"indices":1,"attributes":
        {"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],
        "max":[1,1,0]},{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,
        "byteLength":36,"byteStride":12},{"buffer":0,"byteOffset":36,"byteLength":3}],"buffers":[{"byteLength":40}]}"#;
    let mut json = document.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut arrays: Vec<u8> =
        [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    arrays.extend([0, 1, 2, 0]);
    let word = |number: usize| (number as u32).to_le_bytes();
    let length = 12 + 8 + json.len() + 8 + arrays.len();
    [b"glTF", &word(2)[..], &word(length), &word(json.len()), b"JSON", &json, &word(arrays.len()), b"BIN\0", &arrays]
        .concat()
}

#[test]
fn a_file_with_any_byte_changed_lost_or_doubled_is_loaded_or_refused() {
    let files = [
        ("a.obj", OBJ.as_bytes().to_vec()),
        ("a.ply", ply("ascii")),
        ("a.ply", ply("binary_little_endian")),
        ("a.ply", ply("binary_big_endian")),
        ("a.stl", STL.as_bytes().to_vec()),
        ("a.stl", binary_stl()),
        ("a.off", OFF.as_bytes().to_vec()),
        ("a.glb", glb()),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (name, file) in files {
        let path = folder.path().join(name);
        let load = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            let loaded = Mesh::load(&path);
            // A new file each time: some file systems wait for the disk when one is overwritten.
            std::fs::remove_file(&path).unwrap();
            loaded
        };
        let whole = load(&file).unwrap();
        let (mut loaded, mut refused) = (0, 0);
        for at in 0..file.len() {
            let changed = [0, b'\n', b'-', b'0', b'9', 0xff].map(|byte| {
                let mut changed = file.clone();
                changed[at] = byte;
                changed
            });
            let mut damaged = changed.to_vec();
            damaged.push([&file[..at], &file[at + 1..]].concat());
            damaged.push([&file[..=at], &file[at..]].concat());
            damaged.push(file[..at].to_vec());
            for bytes in damaged {
                match load(&bytes) {
                    Ok(mesh) => {
                        assert!(mesh.triangles().len() <= bytes.len() && mesh.positions().len() <= bytes.len());
                        (0..mesh.triangles().len() as u32).for_each(|triangle| {
                            mesh.interpolated_normal(triangle, [0.5, 0.25]);
                        });
                        loaded += 1;
                    }
                    Err(Error::Format { reason, .. }) => {
                        assert!(!reason.is_empty() && reason.len() < 200 && !reason.contains('\n'), "{reason}");
                        refused += 1;
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
        assert!(loaded > 100 && refused > 100, "{name}: {loaded} loaded, {refused} refused");
        assert!(whole.area() > 0.0);
    }
}
