//! Points inside of meshes, against all triangles.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Error, Interior};

use crate::common::meshes::{self, Soup};
use crate::common::random::Random;

fn mesh((positions, triangles): Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

/// The solid angle of all triangles over 4π, as sums of angles of spherical triangles would be, by another formula than the
/// library's: l'Huilier's.
pub fn winding(mesh: &Mesh, point: [f32; 3]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let angle = |a: [f64; 3], b: [f64; 3]| {
        let across = cross(a, b);
        dot(across, across).sqrt().atan2(dot(a, b))
    };
    let mut total = 0.0;
    for &triangle in mesh.triangles() {
        let [a, b, c] =
            triangle.map(|vertex| minus(mesh.positions()[vertex as usize].map(f64::from), point.map(f64::from)));
        let sides = [angle(b, c), angle(c, a), angle(a, b)];
        let half = sides.iter().sum::<f64>() / 2.0;
        let tangents = sides.iter().fold((half / 2.0).tan(), |product, side| product * ((half - side) / 2.0).tan());
        total += 4.0 * tangents.max(0.0).sqrt().atan() * dot(a, cross(b, c)).signum();
    }
    total / (4.0 * std::f64::consts::PI)
}

/// Random points of the box around a mesh and a little beyond.
fn probes(mesh: &Mesh, count: usize, random: &mut Random) -> Vec<[f32; 3]> {
    let (low, high) = mesh.bounds();
    let along = |k: usize, random: &mut Random| low[k] + (high[k] - low[k]) * (1.2 * random.unit() - 0.1);
    (0..count).map(|_| [0, 1, 2].map(|k| along(k, random))).collect()
}

#[test]
fn closed_shapes_are_closed_and_others_are_not() {
    for (soup, is_closed) in [
        (meshes::welded(meshes::sphere()), true),
        (meshes::welded(meshes::torus()), true),
        (meshes::plane(), false),
        (meshes::sheets(0.1), false),
        (meshes::book(3), false),
        (meshes::join([meshes::plane(), meshes::plane()]), true),
        (meshes::random_soup(1, 50), false),
    ] {
        assert_eq!(mesh(soup).is_closed(), is_closed);
    }
}

/// Winding numbers of closed meshes that face one way are those of crossings.
#[test]
fn what_is_in_a_closed_mesh_has_a_winding_number_of_1() {
    let mut random = Random::new(1);
    for soup in [meshes::sphere(), meshes::torus(), meshes::placed(meshes::torus(), 0.1, 5.0)].map(meshes::welded) {
        let mesh = mesh(soup);
        let probes = probes(&mesh, 300, &mut random);
        let inside = probes.iter().filter(|&&point| mesh.contains(point)).count();
        assert!((30..250).contains(&inside), "{inside}");
        for point in probes {
            assert_eq!(mesh.contains(point), winding(&mesh, point).abs() > 0.5, "{point:?}");
        }
    }
}

/// The corners of a box, points on its edges, faces and in it: exactly one of two boxes that share a face has a point of it.
#[test]
fn points_on_shared_faces_are_in_one_mesh() {
    let cell = |x: f32, y: f32, z: f32| {
        let positions = (0..8).map(|k| [x + (k & 1) as f32, y + (k >> 1 & 1) as f32, z + (k >> 2) as f32]).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect();
        mesh((positions, triangles))
    };
    let boxes: Vec<Mesh> = (0..27).map(|k| cell((k % 3) as f32, (k / 3 % 3) as f32, (k / 9) as f32)).collect();
    assert!(boxes.iter().all(Mesh::is_closed));
    for k in 0..7 * 7 * 7 {
        // From -0.5 to 2.5 and beyond, on all faces and between.
        let point = [k % 7, k / 7 % 7, k / 49].map(|x| x as f32 * 0.5);
        let holding = boxes.iter().filter(|mesh| mesh.contains(point)).count();
        let is_in = point.iter().all(|&x| x < 3.0);
        assert_eq!(holding, usize::from(is_in), "{point:?}");
    }
}

#[test]
fn shells_are_hollow_whichever_way_they_face() {
    let scaled = |scale: f32, turned: bool| {
        let (mut positions, mut triangles) = meshes::welded(meshes::sphere());
        positions.iter_mut().for_each(|p| *p = p.map(|x| x * scale));
        if turned {
            triangles.iter_mut().for_each(|t| t.swap(0, 1));
        }
        (positions, triangles)
    };
    for turned in [false, true] {
        let mesh = mesh(meshes::join([scaled(1.0, false), scaled(0.6, turned), scaled(0.3, turned)]));
        for (radius, is_inside) in [(0.1, true), (0.45, false), (0.8, true), (1.1, false)] {
            let point = [0.36, 0.48, 0.8].map(|x: f32| x * radius);
            assert_eq!(mesh.contains(point), is_inside, "{radius}");
        }
    }
}

/// A sphere with a hole: inside is where most of the directions see the surface. The mesh may face inwards.
#[test]
fn open_meshes_have_the_winding_number_of_all_triangles() {
    let mut random = Random::new(2);
    let hole = |turned: bool| {
        let (positions, mut triangles) = meshes::welded(meshes::sphere());
        triangles.retain(|t| t.iter().any(|&vertex| positions[vertex as usize][0] < 0.8));
        if turned {
            triangles.iter_mut().for_each(|t| t.swap(0, 1));
        }
        (positions, triangles)
    };
    for soup in [hole(false), hole(true), meshes::book(5), meshes::random_soup(3, 200)] {
        let mesh = mesh(soup);
        assert!(!mesh.is_closed());
        let (low, high) = mesh.bounds();
        let mut inside = 0;
        for point in probes(&mesh, 300, &mut random) {
            let wound = winding(&mesh, point).abs();
            let is_within = (0..3).all(|k| low[k] <= point[k] && point[k] <= high[k]);
            inside += usize::from(mesh.contains(point));
            if (wound - 0.5).abs() > 0.02 || !is_within {
                assert_eq!(mesh.contains(point), is_within && wound > 0.5, "{point:?} {wound}");
            }
        }
        assert!(inside > 60 || mesh.triangles().len() < 1000, "{inside}");
    }
}

#[test]
fn many_points_are_asked_for_on_all_threads() {
    let mesh = mesh(meshes::welded(meshes::torus()));
    let probes = probes(&mesh, 10_000, &mut Random::new(3));
    let interior = Interior::of(&mesh);
    assert!(Arc::ptr_eq(&interior, &Interior::of(&mesh.clone())) && interior.is_closed());
    let each: Vec<bool> = probes.iter().map(|&point| mesh.contains(point)).collect();
    for threads in [1, 2] {
        let context = Context::new(threads).unwrap();
        assert_eq!(interior.contains_each(&context, &probes, None).unwrap(), each);
        let error = interior.contains_each(&context, &[[0.0; 3], [f32::NAN; 3]], None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument: "positions", .. }));
    }
    for x in [f32::NAN, f32::INFINITY, f32::MAX] {
        assert!(!mesh.contains([x, 0.0, 0.0]) && !mesh.contains([0.0, 0.0, -x]));
    }
}

/// A mask opens a mesh, and a mesh without triangles has no inside.
#[test]
fn triangles_that_are_left_out_are_not_there() {
    let mesh = mesh(meshes::welded(meshes::sphere()));
    let count = mesh.triangles().len();
    let half = mesh.clone().with_mask((0..count).map(|triangle| triangle % 2 == 0).collect()).unwrap();
    assert!(!half.is_closed() && mesh.is_closed() && mesh.contains([0.1; 3]));
    let nothing = mesh.with_mask(vec![false; count]).unwrap();
    assert!(!nothing.contains([0.1; 3]));
}
