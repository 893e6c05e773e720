//! Mesh files: what the readers make of good, odd and broken ones.

use std::path::PathBuf;

use azulejo::Error;
use azulejo::mesh::Mesh;
use tempfile::TempDir;

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
    let line = |line: &str| files.reason("line.obj", format!("{vertices}{line}\n"));
    assert_eq!(files.reason("word.obj", "# one\nv 0 zero 0\n"), "line 2: position parse error");
    assert_eq!(files.reason("short.obj", "v 0 0 0\n\nv 1 2"), "line 3: position parse error");
    assert_eq!(files.reason("latin.obj", b"v 0 0 0\nv 1 0 \xff\n"), "line 2: read error");
    assert_eq!(line("vn 0 1\nf 1//1 2//1 3//1"), "line 4: position parse error");
    for corner in ["x", "1/1/1/1", "2//x", &"9".repeat(1000)] {
        assert_eq!(line(&format!("g\nf 1 2 {corner}")), "line 5: face parse error");
    }
    assert_eq!(line("f"), "line 4: a face without corners");
    assert_eq!(line("f 1 2 /1/1"), "line 4: a face names vertex 0, but there are 3");
    assert_eq!(line("f 1 2 4\nf 4 4 4"), "line 4: a face names vertex 4, but there are 3");
    assert_eq!(line("f 1//3 2//1 3//2\nvn 0 0 1"), "line 4: a face names normal 3, but there are 1");
    for index in ["0", "-4", "4294967296", "9223372036854775807", "-9223372036854775808"] {
        let so_far = if index.starts_with('-') { " so far" } else { "" };
        let bad = |name, count| format!("line 4: a face names {name} {index}, but there are {count}{so_far}");
        assert_eq!(line(&format!("f 1 2 {index}")), bad("vertex", 3));
        if index != "0" {
            assert_eq!(line(&format!("f 1 2 3//{index}")), bad("normal", 0));
        }
    }
    assert!(files.reason("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").starts_with("positions: vertex 0"));
    assert!(files.reason("big.obj", "v 1e99 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").starts_with("positions: vertex 0"));
    assert_eq!(files.reason("points.obj", vertices), "indices: 0 triangles; at least one is needed");
    assert!(files.reason("empty.obj", "").starts_with("indices: 0 triangles"));
    assert!(files.reason("flat.obj", "v 0 0 0\nf 1 1 1").starts_with("indices: the triangles have no area"));
    let wide: Vec<u8> = "v 0 0 0".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(files.reason("wide.obj", [b"\xff\xfe", &wide[..]].concat()).contains("UTF-16"));
    files.reason("garbage.obj", garbage());
}

#[test]
fn normals_of_obj_corners_are_read_where_they_are() {
    let files = Files::new();
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 9\nvn 2 0 0\nvn 0 2 0\nvn nan 0 0\n\
        f 1//1 2//1 3//-2 4/7/2\nf 1 2 3\nf 1//2 2//0 3/1\nf 1//3 2//3 3//4\nvn 0 3 4\n";
    let mesh = files.load("normals.obj", text);
    assert_eq!(mesh.positions().len(), 5, "vertices keep their numbers, used or not");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 1, 2], [0, 1, 2]]);
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let expected = [[x, x, y], [x, y, y], [z, z, z], [y, z, z], [z, z, [0.0, 0.6, 0.8]]];
    for (triangle, expected) in expected.into_iter().enumerate() {
        let normals = corners.map(|uv| mesh.interpolated_normal(triangle as u32, uv).unwrap());
        assert_eq!(normals, expected, "triangle {triangle}");
    }
    assert!(!files.load("unused.obj", "vn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").has_normals());
}

#[test]
fn what_obj_files_look_like() {
    let files = Files::new();
    let expected = files.load("plain.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\nf 1 2 3 4 5\n");
    assert_eq!(expected.triangles(), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    for text in [
        "\u{feff}v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nv -1 0.5 0\r\nf 1 2 3 4 5",
        "  v  +0. 0\t0 1\n v 1. .0 0e0\nv 1E0 10e-1 -0 .5 .5 .5\nv 0 1 0 1 1 1 1\nv -1 .5 0\ng a b\ns off\n f 1 2  3 4 5 ",
        "f 1 2 3 4 5\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\nf -5 -4/1 -3/2/ -2//\\\n -1 # f 1",
        "v 0 0 0\nv 1 0 0\nv \\\r\n1 1\\\n  0\nv 0 1 0\nv -1 0.5 0\nf 1 2 3 4 \\\n\\\n5\\",
        "# C:\\\nv 0 0 0#\nv 1 0 0 # one\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\n#f\nf 1 2 3 4 5 #6\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\no one\nf 1 2 3\no two\nv 0 1 0\ng\nf 1 3 4\nv -1 0.5 0\nusemtl x\nf 1 4 5\nf 1 2\nf 1",
    ] {
        let mesh = files.load("shape.obj", text);
        assert_eq!(mesh.positions(), expected.positions(), "{text}");
        assert_eq!(mesh.triangles(), expected.triangles(), "{text}");
    }
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
fn what_ply_files_look_like() {
    let files = Files::new();
    let file = |indices: &str, body: &str| {
        format!(
            "ply\nformat ascii 1.0\nobj_info made\ncomment\nelement vertex 3\nproperty float64 x\nproperty float32 y\n\
            property int8 z\nelement edge 1\nproperty int a\nelement face 2\nproperty list {indices}\n\
            property float quality\nend_header\n{body}"
        )
    };
    let body = "0 0 0\n1 0 0\n0 .5 1\n7\n3 0 1 2 1\n3 2 1 0 nan\n";
    let (positions, triangles) = ([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.5, 1.0]], [[0, 1, 2], [2, 1, 0]]);
    for indices in
        ["uchar int vertex_index", "uint8 uint32 vertex_indices", "int ushort vertex_index", "uint short vertex_index"]
    {
        for body in [body, "\n0 0. -0\n\n1.\t0 0 \n  0 +5e-1 1\n 7 \n3 0 1 2 -inf\n\n3 2 1 0 inf"] {
            for text in [file(indices, body), file(indices, body).replace('\n', "\r\n")] {
                let mesh = files.load("shape.ply", &text);
                assert_eq!((mesh.positions(), mesh.triangles()), (&positions[..], &triangles[..]), "{text}");
                assert!(!mesh.has_normals());
            }
        }
    }
    let strips = file("uchar int vertex_index", body).replace("element face", "element tristrips");
    assert!(files.reason("strips.ply", strips).starts_with("has triangle strips"));
    let text = file("uchar int vertex_index", body);
    assert_eq!(
        files.reason("short.ply", text.replace("3 2 1 0 nan", "3 2 1 0")),
        "line 20: fewer numbers than the header announces"
    );
    assert_eq!(
        files.reason("word.ply", text.replace("0 .5 1", "0 half 1")),
        "line 17: \"half\" is not a number that fits the header"
    );
    assert_eq!(files.reason("ends.ply", text.replace("3 2 1 0 nan", "")), "ends after 1 of 2 of element face");
}

#[test]
fn normals_of_ply_vertices_are_read() {
    let files = Files::new();
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float nx\nproperty float ny\nproperty float nz\n\
        property float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\n\
        end_header\n0 3 4 0 0 0\n2 0 0 1 0 0\nnan 0 0 0 1 0\n1 0 0 9 9 9\n3 0 1 2\n";
    let mesh = files.load("normals.ply", text);
    let normals = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|uv| mesh.interpolated_normal(0, uv).unwrap());
    assert_eq!(normals, [[0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(!files.load("two.ply", text.replace("nz", "n")).has_normals());
}

/// Two facets, of which the second has a normal against its winding.
const FACETS: [[[f32; 3]; 4]; 2] = [
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 2.5, 0.0], [1.0, 0.0, 0.0]],
];

fn binary_stl(header: &str, count: u32) -> Vec<u8> {
    let mut file = header.as_bytes().to_vec();
    file.resize(80, b' ');
    file.extend(count.to_le_bytes());
    for facet in FACETS {
        file.extend(facet.iter().flatten().flat_map(|x| x.to_le_bytes()));
        file.extend([0xff, 0xff]);
    }
    file
}

#[test]
fn stl_files_give_a_triangle_for_each_facet() {
    let files = Files::new();
    let facet = |[normal, corners @ ..]: [[f32; 3]; 4]| {
        let vector = |[x, y, z]: [f32; 3]| format!("{x} {y:e} {z}\n");
        let corners = corners.map(|corner| format!("vertex {}", vector(corner))).concat();
        format!("facet normal {}outer loop\n{corners}endloop\nendfacet\n", vector(normal))
    };
    let [first, second] = FACETS.map(facet);
    let text = format!("solid a b\n{first}{second}endsolid a b\n");
    let expected: Vec<_> = FACETS.iter().flat_map(|facet| facet[1..].to_vec()).collect();
    for content in [
        text.clone().into_bytes(),
        text.to_uppercase().replace('\n', "\r\n").into_bytes(),
        format!("solid\n{first}endsolid\n\n  solid two\n{second}endsolid").into_bytes(),
        text.replace("normal 0 0e0 1", "normal nan nan -nan(ind)").into_bytes(),
        text.replace("solid a b", "solid caf\u{e9} \u{1f600}").into_bytes(),
        binary_stl("made", 2),
        binary_stl("solid, but binary", 2),
    ] {
        for name in ["shape.stl", "shape.STL", "shape"] {
            let mesh = files.load(name, &content);
            assert_eq!(mesh.positions(), expected, "{}", String::from_utf8_lossy(&content));
            assert_eq!(mesh.triangles(), [[0, 1, 2], [3, 4, 5]]);
            assert!(!mesh.has_normals());
        }
    }
    let longer = [binary_stl("made", 2), vec![0; 7]].concat();
    assert_eq!(files.load("longer.stl", longer).positions(), expected);

    let corner = "vertex 1 0e0 0\n";
    let without = text.replacen(corner, "", 1);
    assert_eq!(files.reason("two.stl", without), "line 6: the facet ends, but does not have three vertices");
    assert_eq!(files.reason("word.stl", text.replacen(corner, "vertex 1 o 0\n", 1)), "line 5: \"o\" is not a number");
    assert_eq!(files.reason("cut.stl", &text[..text.find(corner).unwrap()]), "ends within a facet");
    assert!(
        files.reason("infinite.stl", text.replacen(corner, "vertex 1 inf 0\n", 1)).starts_with("positions: vertex 1")
    );
    for count in [3, 1 << 30, u32::MAX] {
        let reason = files.reason("claims.stl", binary_stl("made", count));
        assert_eq!(reason, format!("the header announces {count} facets, but only 100 bytes follow"));
    }
    for none in [&b"solid\nendsolid"[..], b"", b"short", &binary_stl("made", 0)] {
        assert!(files.reason("none.stl", none).starts_with("indices: 0 triangles"));
    }
    files.reason("garbage.stl", garbage());
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
    assert!(files.reason("long.ply", ascii("7 4 0", "7 400000000 0")).starts_with("line 20: "));
    assert!(files.reason("negative.ply", ascii("7 4 0", "7 -4 0")).starts_with("line 20: "));
    assert!(files.reason("word.ply", ascii("255 2 0", "255 two 0")).starts_with("line 17: "));
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

/// Two triangles of a metre near a place, as text: in the order x, y, z of the corners of each.
fn far_away([x, y, z]: [i64; 3]) -> Vec<[String; 3]> {
    let corner = |[a, b, c]: [f64; 3]| {
        [(x, a), (y, b), (z, c)].map(|(whole, part)| format!("{whole}{}", &format!("{part:.3}")[1..]))
    };
    [
        [0.125, 0.25, 0.5],
        [0.875, 0.25, 0.5],
        [0.125, 0.75, 0.5],
        [0.875, 0.25, 0.501],
        [0.875, 0.75, 0.5],
        [0.125, 0.75, 0.503],
    ]
    .map(corner)
    .to_vec()
}

#[test]
fn vertices_far_from_the_origin_keep_their_places_in_all_formats() {
    let files = Files::new();
    let corners = far_away([500_000, 4_649_776, 12_345_678]);
    let lines = |keyword: &str| corners.iter().map(|c| format!("{keyword} {}\n", c.join(" "))).collect::<Vec<_>>();
    let vertices = lines("v").concat();
    let faces = "f 1 2 3\nf 4 5 6\n";
    let stl: String = lines("vertex")
        .chunks(3)
        .map(|facet| format!("facet\nouter loop\n{}endloop\nendfacet\n", facet.concat()))
        .collect();
    let header = |format: &str, of: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 6\nproperty {of} x\nproperty {of} y\nproperty {of} z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let text = format!("{}{}3 0 1 2\n3 3 4 5\n", header("ascii", "double"), lines("").concat());
    let mut binary = header("binary_big_endian", "double").into_bytes();
    binary.extend(corners.iter().flatten().flat_map(|word| word.parse::<f64>().unwrap().to_be_bytes()));
    for face in [[0, 1, 2], [3, 4, 5]] {
        binary.push(3);
        binary.extend(face.iter().flat_map(|vertex: &i32| vertex.to_be_bytes()));
    }
    let meshes = [
        files.load("a.obj", format!("{vertices}{faces}")),
        // Continued lines are left to another reader.
        files.load("b.obj", format!("{}{faces}", vertices.replacen("v ", "v \\\n", 1))),
        files.load("c.ply", text),
        files.load("d.ply", binary),
        files.load("e.stl", format!("solid a\n{stl}endsolid a\n")),
        files.load("f.off", format!("OFF\n6 2 0\n{}3 0 1 2\n3 3 4 5\n", lines("").concat())),
        files.load("off", format!("OFF 6 2 0\n{}3 0 1 2\n3 3 4 5\n", lines("").concat())),
        Mesh::parse("-", format!("solid a\n{stl}endsolid a\n").as_bytes()).unwrap(),
    ];
    for mesh in &meshes {
        assert_eq!((mesh.positions(), mesh.origin()), (meshes[0].positions(), meshes[0].origin()));
        for (position, words) in std::iter::zip(mesh.positions(), &corners) {
            for axis in 0..3 {
                let back = mesh.origin()[axis] + f64::from(position[axis]);
                assert!((back - words[axis].parse::<f64>().unwrap()).abs() < 1e-6, "{back} {}", words[axis]);
            }
        }
        assert!((mesh.area() - 0.375).abs() < 1e-5, "{}", mesh.area());
    }
    // Where floats hold them, vertices stay: near the origin, and in files of floats.
    assert_eq!(files.load("near.obj", "v 10.1 0 0\nv 11 0 0\nv 10 1 0\nf 1 2 3").origin(), [0.0; 3]);
    let floats = files.load(
        "f.ply",
        format!(
            "{}100000 0 0\n100001 0 0\n100000 1 0.1\n100000 0 0\n100001 0 0\n100000 1 0\n3 0 1 2\n3 3 4 5\n",
            header("ascii", "float")
        ),
    );
    assert_eq!((floats.origin(), floats.positions()[1]), ([0.0; 3], [100_001.0, 0.0, 0.0]));
}

#[test]
fn a_mesh_of_doubles_is_centred_and_hands_its_origin_on() {
    let place = [500_000.3, 4_649_776.7, 0.0];
    let positions =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|p: [f64; 3]| [0, 1, 2].map(|axis| place[axis] + p[axis]));
    let mesh = Mesh::from_doubles(&positions, vec![[0, 1, 2]]).unwrap();
    assert!((mesh.area() - 0.5).abs() < 1e-6);
    assert!(mesh.origin()[0] != 0.0 && mesh.origin()[1] != 0.0 && mesh.origin()[2] == 0.0);
    let others = [
        mesh.deformed(mesh.positions().to_vec()).unwrap(),
        mesh.clone().with_mask(vec![true]).unwrap(),
        mesh.clone().with_normals(vec![[0.0, 0.0, 1.0]; 3], None).unwrap(),
    ];
    assert!(others.iter().all(|other| other.origin() == mesh.origin()));
    let near = Mesh::from_doubles(&[[0.1, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    assert_eq!((near.origin(), near.positions()[0]), ([0.0; 3], [0.1, 0.0, 0.0]));
}
