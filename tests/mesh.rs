//! Meshes: what is refused, what the readers make of good, odd and broken files.

#[path = "common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::path::PathBuf;

use azulejo::Error;
use azulejo::mesh::Mesh;
use tempfile::TempDir;

/// The argument that `Mesh::new` complains of, and how.
fn refusal(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> (&'static str, String) {
    match Mesh::new(positions, triangles) {
        Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
        other => panic!("not refused as an invalid argument: {other:?}"),
    }
}

const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

#[test]
fn soups_that_are_none_are_refused_with_the_place() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let mut positions = CORNERS.to_vec();
            positions.push([0.0; 3]);
            positions[3][axis] = bad;
            let (argument, reason) = refusal(positions, vec![[0, 1, 2]]);
            assert_eq!(argument, "positions");
            assert!(reason.starts_with("vertex 3 is ("), "{reason}");
        }
    }
    let (argument, reason) = refusal(CORNERS.to_vec(), vec![[0, 1, 2], [0, 1, 3]]);
    assert_eq!((argument, &*reason), ("indices", "triangle 1 names vertex 3, but there are 3 vertices"));
    assert_eq!(refusal(CORNERS.to_vec(), vec![]).0, "indices");
    assert_eq!(refusal(vec![], vec![[0, 0, 0]]).0, "indices");
    let flat = [[0, 0, 1], [1, 1, 1]];
    assert_eq!(refusal(CORNERS.to_vec(), flat.to_vec()), ("indices", "the triangles have no area".to_owned()));
}

#[test]
fn a_mesh_knows_its_triangles() {
    let mut positions = CORNERS.to_vec();
    positions.push([9.0, 9.0, 9.0]);
    let mesh = Mesh::new(positions, vec![[0, 0, 1], [0, 1, 2], [0, 2, 1]]).unwrap();
    assert_eq!(mesh.area(), 6.0);
    assert_eq!(mesh.bounds(), ([0.0; 3], [2.0, 3.0, 0.0]), "unused vertices do not count");
    assert_eq!([0, 1, 2].map(|t| mesh.triangle_area(t)), [0.0, 3.0, 3.0]);
    assert_eq!([0, 1, 2].map(|t| mesh.normal(t)), [[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    assert_eq!(mesh.corners(1), CORNERS);
    assert_eq!(mesh.point(1, [0.5, 0.25]), [1.0, 0.75, 0.0]);
}

#[test]
fn extreme_coordinates_have_finite_areas_and_unit_normals() {
    for scale in [f32::MAX, 1e-30, 1e-44] {
        let (positions, triangles) = meshes::plane();
        let positions = positions.into_iter().map(|position| position.map(|x| x * scale)).collect();
        let mesh = Mesh::new(positions, triangles).unwrap();
        assert!((mesh.area() / (scale as f64).powi(2) - 1.0).abs() < 1e-12);
        assert_eq!(mesh.normal(0), [0.0, 0.0, 1.0]);
    }
}

/// A folder for one test's files.
struct Files(TempDir);

impl Files {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    fn load(&self, name: &str, content: impl AsRef<[u8]>) -> Mesh {
        Mesh::load(self.write(name, content)).unwrap()
    }

    /// Why a file is refused as malformed. The message begins with its path.
    fn reason(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.write(name, content);
        match Mesh::load(&path) {
            Err(error @ Error::Format { .. }) => {
                let message = error.to_string();
                let reason = message.strip_prefix(&format!("{}: ", path.display())).expect("begins with the path");
                assert!(!reason.contains('\n') && reason.len() < 200, "{reason}");
                reason.to_owned()
            }
            other => panic!("not refused as malformed: {other:?}"),
        }
    }
}

#[test]
fn obj_files_are_read_face_by_face() {
    let files = Files::new();
    let text = b"# caf\xe9, not UTF-8\nmtllib ../../etc/passwd\no first\nv 0 0 0\nv 2 0 0 1.0\nv 2 2 0 .1 .2 .3\n\
        v 0 2 0 .1 .2 .3 1\nvt 0 0\nvn 0 0 1\nusemtl none\nf 1/1/1 2/1/1 3//1 4\ng second\nv 0 0 5\np 1\nl 1 2 3\n\
        f 1 2\nf -1 -5/-9 -4\r\nf 3 4 5";
    let mesh = files.load("quad.obj", text);
    assert_eq!(mesh.triangles().len(), 4);
    let corners: Vec<_> = (0..4).map(|t| mesh.corners(t)).collect();
    let [a, b, c, d, e] = [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., 0.], [0., 0., 5.]];
    assert_eq!(corners, [[a, b, c], [a, c, d], [e, a, b], [c, d, e]]);
    assert_eq!(files.load("shape.txt", text).triangles(), mesh.triangles(), "OBJ is what does not begin as a PLY");
}

#[test]
fn broken_obj_files_are_refused_with_the_line() {
    let files = Files::new();
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_eq!(files.reason("word.obj", "# one\nv 0 zero 0\n"), "line 2: position parse error");
    assert_eq!(files.reason("short.obj", "v 0 0 0\n\nv 1 2"), "line 3: position parse error");
    assert_eq!(files.reason("face.obj", format!("{vertices}f 1 2 x\n")), "line 4: face parse error");
    assert_eq!(files.reason("slashes.obj", format!("{vertices}f 1/1/1/1 2 3\n")), "line 4: face parse error");
    for index in ["4", "0", "-4", "9223372036854775807", "-9223372036854775808"] {
        let reason = files.reason("index.obj", format!("{vertices}f 1 2 {index}\n"));
        assert_eq!(reason, "face vertex index out of bounds", "index {index}");
    }
    assert!(files.reason("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").starts_with("positions: vertex 0"));
    assert!(files.reason("big.obj", "v 1e99 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").starts_with("positions: vertex 0"));
    assert_eq!(files.reason("points.obj", vertices), "indices: 0 triangles; at least one is needed");
    assert_eq!(files.reason("none.obj", format!("{vertices}f\n")), "invalid polygon");
    assert!(files.reason("empty.obj", "").starts_with("indices: 0 triangles"));
    assert!(files.reason("flat.obj", "v 0 0 0\nf 1 1 1").starts_with("indices: the triangles have no area"));
    assert!(files.reason("latin.obj", b"v 0 0 0\nv 1 0 \xff\n").starts_with("line 2"));
    files.reason("garbage.obj", garbage());
}

/// 64 KiB of bytes of every value, with a line of each kind at the start of some lines.
fn garbage() -> Vec<u8> {
    let bytes = (0..1u32 << 16).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8);
    b"v \xff\xfe\nf 1 2 3\n".iter().copied().chain(bytes).collect()
}

/// The same solid in the three encodings: a quad, a triangle, and things to be skipped.
fn ply(encoding: &str) -> Vec<u8> {
    let mut file = format!(
        "ply\nformat {encoding} 1.0\ncomment made for a test\nelement camera 1\nproperty list uchar short lens\n\
        element vertex 4\nproperty uchar red\nproperty float x\nproperty double y\nproperty float z\n\
        element face 3\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let vertices = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, -1.5e1]];
    let faces: [&[i32]; 3] = [&[0, 1, 2, 3], &[3, 0], &[2, 1, 0]];
    if encoding == "ascii" {
        file.extend(b"2 5 -6\n");
        for [x, y, z] in vertices {
            file.extend(format!("255 {x} {y} {z:e}\n").into_bytes());
        }
        for face in faces {
            let indices: Vec<_> = face.iter().map(i32::to_string).collect();
            file.extend(format!("7 {} {}\n", face.len(), indices.join(" ")).into_bytes());
        }
        return file;
    }
    let mut put = |bytes: &[u8]| {
        let big = encoding == "binary_big_endian";
        if big { file.extend(bytes.iter().rev()) } else { file.extend(bytes) }
    };
    put(&[2]);
    [5i16, -6].iter().for_each(|lens| put(&lens.to_le_bytes()));
    for [x, y, z] in vertices {
        put(&[255]);
        put(&(x as f32).to_le_bytes());
        put(&f64::to_le_bytes(y));
        put(&(z as f32).to_le_bytes());
    }
    for face in faces {
        put(&[7]);
        put(&[face.len() as u8]);
        face.iter().for_each(|index| put(&index.to_le_bytes()));
    }
    file
}

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

#[test]
fn ply_files_of_all_encodings_give_the_same_mesh() {
    let files = Files::new();
    for encoding in ENCODINGS {
        for name in ["solid.PLY", "solid", "solid.data"] {
            let mesh = files.load(name, ply(encoding));
            assert_eq!(mesh.positions(), [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., -15.]], "{encoding}");
            assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [2, 1, 0]], "{encoding}");
        }
    }
}

#[test]
fn a_ply_file_cut_anywhere_is_refused() {
    let files = Files::new();
    for encoding in ENCODINGS {
        let whole = ply(encoding);
        // The last number of the text can lose its line end.
        let needed = whole.len() - usize::from(encoding == "ascii");
        for length in 0..needed {
            files.reason("cut.ply", &whole[..length]);
        }
        files.load("whole.ply", &whole[..needed]);
    }
}

#[test]
fn headers_that_promise_too_much_are_refused_before_memory_is_taken() {
    let files = Files::new();
    for encoding in ENCODINGS {
        for count in ["1000000000000", "18446744073709551615", "99999999999999999999999", "-1", "1e3"] {
            for element in ["vertex 4", "face 3", "camera 1"] {
                let (kind, _) = element.split_once(' ').unwrap();
                let file = replaced(&ply(encoding), element, &format!("{kind} {count}"));
                let reason = files.reason("absurd.ply", file);
                if count == "1000000000000" {
                    assert!(reason.starts_with("the header announces 1000000000000 of element"), "{reason}");
                }
            }
        }
        let empty = replaced(&ply(encoding), "property list uchar short lens\n", "");
        assert_eq!(files.reason("nothing.ply", empty), "element camera has no properties");
    }
}

#[test]
fn bad_lists_and_indices_of_ply_files_are_refused() {
    let files = Files::new();
    let ascii = |from: &str, to: &str| replaced(&ply("ascii"), from, to);
    assert!(files.reason("long.ply", ascii("7 4 0", "7 400000000 0")).starts_with("Line 20: "));
    assert!(files.reason("negative.ply", ascii("7 4 0", "7 -4 0")).starts_with("Line 20: "));
    assert!(files.reason("word.ply", ascii("255 2 0", "255 two 0")).starts_with("Line 17: "));
    assert_eq!(files.reason("minus.ply", ascii("7 2 3 0", "7 2 -3 0")), "face 1 has no list of vertex numbers");
    assert!(
        files.reason("index.ply", ascii("7 3 2 1 0", "7 3 2 1 4")).starts_with("indices: triangle 2 names vertex 4")
    );
    assert!(files.reason("infinite.ply", ascii("255 2 0 ", "255 1e40 0 ")).starts_with("positions: vertex 1"));
    assert_eq!(files.reason("flat.ply", ascii("property float z\n", "")), "element vertex lacks x, y, z");
    assert!(files.reason("strips.ply", ascii("vertex_indices", "strips")).starts_with("element face lacks"));
    assert!(
        files.reason("real.ply", ascii("uchar int vertex", "uchar float vertex")).starts_with("face 0 has no list")
    );
    assert!(files.reason("cloud.ply", "ply\nformat ascii 1.0\nend_header\n").starts_with("indices: 0 triangles"));
    // A binary list whose length is negative, or the largest there is.
    for length in [-1i32, i32::MAX] {
        let mut file = b"ply\nformat binary_little_endian 1.0\nelement face 1\n\
            property list int int vertex_indices\nend_header\n"
            .to_vec();
        file.extend(length.to_le_bytes());
        files.reason("list.ply", file);
    }
    files.reason("empty.ply", "");
    files.reason("garbage.ply", garbage());
    files.reason("behind.ply", [b"ply\n", garbage().as_slice()].concat());
    let binary = replaced(&ply("ascii"), "format ascii", "format binary_little_endian");
    files.reason("claims.ply", binary);
}

fn replaced(file: &[u8], from: &str, to: &str) -> Vec<u8> {
    let at = file.windows(from.len()).position(|window| window == from.as_bytes()).expect("the text is there");
    [&file[..at], to.as_bytes(), &file[at + from.len()..]].concat()
}

#[test]
fn what_is_no_file_is_an_io_error() {
    let files = Files::new();
    for path in [files.0.path().to_owned(), files.0.path().join("missing.obj"), PathBuf::new()] {
        let error = Mesh::load(&path).unwrap_err();
        assert!(matches!(&error, Error::Io { path: named, .. } if *named == path), "{error}");
    }
    let directory = files.0.path().join("mesh.ply");
    std::fs::create_dir(&directory).unwrap();
    assert!(Mesh::load(&directory).unwrap_err().to_string().ends_with("mesh.ply: is a directory"));
    if cfg!(unix) {
        assert!(Mesh::load("/dev/zero").unwrap_err().to_string().ends_with("is not a regular file"), "never read");
    }
}
