//! Meshes: what is refused, and what a mesh says of itself.

use azulejo::Error;
use azulejo::mesh::Mesh;
use azulejo::mesh::ply::{self, Ply};

use crate::common::meshes;

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
            assert!(reason.starts_with("vertex 3 is ["), "{reason}");
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

#[test]
fn attributes_of_ply_files_are_read_by_name() {
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment made\nelement vertex 2\nproperty float x\nproperty ushort heat\n\
             element face 2\nproperty char kept\nproperty list uchar int vertex_index\nend_header\n"
        )
    };
    let text = [header("ascii").as_bytes(), b"0.1 65535\n\n-1 0\n-1 3 0 1 1\n1 5 0 1 0 1 0\n"].concat();
    let binary = |format: &str, order: fn(&[u8]) -> Vec<u8>| {
        let mut file = header(format).into_bytes();
        let mut put = |bytes: &[u8]| file.extend(order(bytes));
        for (x, heat) in [(0.1f32, u16::MAX), (-1.0, 0)] {
            put(&x.to_le_bytes());
            put(&heat.to_le_bytes());
        }
        for (kept, corners) in [(-1i8, &[0i32, 1, 1][..]), (1, &[0, 1, 0, 1, 0])] {
            put(&kept.to_le_bytes());
            put(&[corners.len() as u8]);
            corners.iter().for_each(|corner| put(&corner.to_le_bytes()));
        }
        file
    };
    let little = binary("binary_little_endian", <[u8]>::to_vec);
    let big = binary("binary_big_endian", |bytes| bytes.iter().rev().copied().collect());
    for file in [text, little, big] {
        let ply = Ply::read(&file, |_, property| property != "x").unwrap();
        assert_eq!(ply.comments(), ["made"]);
        let [vertices, faces] = ["vertex", "face"].map(|name| ply.element(name).unwrap());
        assert_eq!((vertices.count(), faces.count()), (2, 2));
        assert_eq!(vertices.properties().collect::<Vec<_>>(), ["x", "heat"]);
        assert_eq!((vertices.numbers("heat"), vertices.numbers("x")), (Some(&[65535.0, 0.0][..]), None));
        assert_eq!(faces.numbers("kept"), Some(&[-1.0, 1.0][..]));
        let lists = faces.lists("vertex_index").unwrap();
        assert_eq!(lists.iter().collect::<Vec<_>>(), [&[0.0, 1.0, 1.0][..], &[0.0, 1.0, 0.0, 1.0, 0.0]]);
        assert!(faces.lists("kept").is_none() && faces.numbers("vertex_index").is_none());
        assert_eq!(ply::triangles_of_faces(&file), Ok(vec![1, 3]));
        let cut = Ply::read(&file[..file.len() - 2], |_, _| false).unwrap_err();
        assert!(cut.contains("ends after 1 of 2 of element face") || cut.contains("fewer numbers"), "{cut}");
    }
}

#[test]
fn a_mesh_in_memory_is_read_as_its_name_or_its_contents_say() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for name in ["-", "a.obj", "missing/a.OBJ"] {
        assert_eq!(Mesh::parse(name, text).unwrap().triangles(), [[0, 1, 2]]);
    }
    let error = Mesh::parse("a.ply", text).unwrap_err();
    assert_eq!(error.to_string(), "a.ply: is no PLY file: it does not begin with \"ply\"");
}

#[test]
fn samples_go_with_their_triangles_to_a_deformed_mesh() {
    let (positions, triangles) = meshes::sphere();
    let mesh = Mesh::new(positions.clone(), triangles.clone()).unwrap();
    let mask: Vec<bool> = (0..triangles.len()).map(|i| i % 5 != 0).collect();
    let mesh = mesh.with_normals(positions.clone(), None).unwrap().with_mask(mask).unwrap();
    let (set, _) = azulejo::psp::sample(
        &azulejo::Context::new(1).unwrap(),
        &std::sync::Arc::new(mesh.clone()),
        &azulejo::psp::Options::new(0.2),
        None,
    )
    .unwrap();
    assert_eq!(mesh.samples_at(&set.triangles, &set.barycentrics).unwrap(), set, "the same floats");

    let moved: Vec<_> = positions.iter().map(|[x, y, z]| [2.0 * x, y - 1.0, 0.5 * z]).collect();
    let deformed = mesh.deformed(moved.clone()).unwrap();
    assert!(
        !deformed.has_normals() && (0..triangles.len() as u32).all(|i| deformed.is_sampled(i) == mesh.is_sampled(i))
    );
    let fresh = Mesh::new(moved, triangles.clone()).unwrap();
    let there = deformed.samples_at(&set.triangles, &set.barycentrics).unwrap();
    for i in 0..set.len() {
        assert_eq!(there.positions[i], fresh.point(set.triangles[i], set.barycentrics[i]));
        assert_eq!(there.normals[i], fresh.normal(set.triangles[i]));
    }

    let refused = |result: azulejo::Result<Mesh>| result.unwrap_err().to_string();
    assert!(refused(mesh.deformed(vec![[0.0; 3]; 2])).starts_with("positions: 2 for a mesh of"));
    assert_eq!(refused(mesh.deformed(vec![[1.0; 3]; positions.len()])), "positions: the triangles have no area");
    let refused = |triangles: &[u32], uv: &[[f32; 2]]| mesh.samples_at(triangles, uv).unwrap_err().to_string();
    assert_eq!(refused(&[0], &[]), "barycentrics: there are 0, and 1 triangles");
    assert!(refused(&[u32::MAX], &[[0.0; 2]]).starts_with("triangles: [0] is 4294967295"));
    assert_eq!(refused(&[0], &[[0.0, f32::NAN]]), "barycentrics: sample 0 is [0.0, NaN], not finite");
    assert_eq!(refused(&[0, 0], &[[0.0, 1.0], [2.0, 2.0]]), "barycentrics: [1] is (2, 2), outside the triangle");
}
