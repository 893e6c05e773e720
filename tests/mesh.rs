//! Meshes: what is refused, and what a mesh says of itself.

#[path = "common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use azulejo::Error;
use azulejo::mesh::Mesh;

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
