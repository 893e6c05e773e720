//! `azulejo mesh` and `surface`, from outside.

mod common;

use std::fs;

use common::Workshop;

/// The nine properties of each sample in a file of `surface`, as floats; triangles are none.
fn samples(workshop: &Workshop, name: &str) -> Vec<[f32; 9]> {
    let file = fs::read(workshop.path(name)).unwrap();
    let end = file.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let float = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
    let sample = |bytes: &[u8]| std::array::from_fn(|i| float(&bytes[4 * i..][..4]));
    file[end..].chunks_exact(36).map(sample).collect()
}

#[test]
fn every_shape_can_be_made_and_sampled() {
    let workshop = Workshop::new();
    for (shape, faces, count, extent) in [
        ("sphere", 1024, 200, [2.0, 2.0, 2.0]),
        ("torus", 1024, 200, [2.8, 2.8, 0.8]),
        ("knot", 512, 200, [1.8, 1.75, 0.75]),
        // It stands on y, as pictures have it.
        ("hall", 172 * 1024, 1000, [4.0, 1.0, 2.0]),
    ] {
        assert!(workshop.succeed(&["mesh", shape, "--detail", "32", "-o", "mesh.ply"]).is_empty());
        let file = fs::read(workshop.path("mesh.ply")).unwrap();
        assert!(String::from_utf8_lossy(&file[..300]).contains(&format!("\nelement face {faces}\n")), "{shape}");
        let count_text = count.to_string();
        workshop.succeed(&["surface", "mesh.ply", "--count", &count_text, "-o", "samples.ply"]);
        let made = samples(&workshop, "samples.ply");
        assert!((count / 2..count * 6 / 5).contains(&made.len()), "{} samples of a {shape}", made.len());
        for axis in 0..3 {
            let ends =
                made.iter().map(|sample| sample[axis]).fold([f32::MAX, f32::MIN], |[a, b], x| [a.min(x), b.max(x)]);
            let difference = ends[1] - ends[0] - extent[axis];
            assert!(difference.abs() < 0.1 * extent[axis], "{shape} is {difference} too long on axis {axis}");
        }
    }
    let said = workshop.refuse(&["mesh", "hall", "--detail", "1001", "-o", "a.ply"], 1);
    assert_eq!(said, "error: --detail: 1001 is too fine for this shape; the limit is 1000\n");
}

#[test]
fn surface_says_how_near_the_count_is() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "sphere", "--detail", "64", "-o", "mesh.ply"]);
    let said = workshop.succeed(&["surface", "mesh.ply", "--count", "4000", "-o", "a.ply"]);
    let made = samples(&workshop, "a.ply").len();
    let count = format!("a.ply: {},{:03} samples, ", made / 1000, made % 1000);
    let rest = said.strip_prefix(&count).unwrap_or_else(|| panic!("{said}"));
    let (percent, rest) = rest.split_once(' ').unwrap();
    let told: f64 = percent.parse().unwrap();
    assert!((told - 100.0 * (made as f64 / 4000.0 - 1.0).abs()).abs() < 0.1 && told < 5.0, "{said}");
    let how = if made < 4000 { "fewer" } else { "more" };
    assert!(rest.starts_with(&format!("% {how} than asked for, radius 0.0467")), "{said}");
    // Two triangles apart, far below the radius: half of what the area lets expect.
    let square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 .001\nv 1 0 .001\nv 0 1 .001\nf 1 2 3\nf 4 5 6\n";
    workshop.write("pair.obj", square);
    let said = workshop.succeed(&["surface", "pair.obj", "--count", "1000", "-o", "a.ply"]);
    assert!(said.contains(" % fewer than asked for, radius "), "{said}");
    let said = workshop.succeed(&["surface", "mesh.ply", "--radius", "0.5", "-o", "a.ply"]);
    assert!(said.contains(" samples, radius 0.5, "), "{said}");
}

#[test]
fn normals_of_samples_are_those_that_are_asked_for() {
    let workshop = Workshop::new();
    let up = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nf 1//1 2//1 3//1\n";
    workshop.write("slanted.obj", up);
    workshop.write("plain.obj", up.replace("//1", ""));
    let normals = |mesh: &str, kind: &str| {
        workshop.succeed(&["surface", mesh, "--radius", "0.1", "--normals", kind, "-o", "a.ply"]);
        let made = samples(&workshop, "a.ply");
        assert!(made.len() > 30);
        made.iter().map(|sample| [sample[3], sample[4], sample[5]]).collect::<Vec<_>>()
    };
    for (mesh, kind, expected) in [
        ("slanted.obj", "interpolated", [0.6, 0.0, 0.8]),
        ("slanted.obj", "geometric", [0.0, 0.0, 1.0]),
        ("plain.obj", "geometric", [0.0, 0.0, 1.0]),
    ] {
        assert!(normals(mesh, kind).iter().all(|normal| *normal == expected), "{mesh} {kind}");
    }
    let arguments = ["surface", "plain.obj", "--radius", "0.1", "--normals", "interpolated", "-o", "b.ply"];
    let said = workshop.refuse(&arguments, 1);
    assert_eq!(said, "error: --normals: plain.obj has none to be interpolated\n");
    workshop.refuse(&["surface", "plain.obj", "--radius", "0.1", "--normals", "smooth", "-o", "b.ply"], 2);
}

#[test]
fn samples_are_relaxed_on_their_mesh() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "sphere", "--detail", "64", "-o", "mesh.ply"]);
    workshop.succeed(&["surface", "mesh.ply", "--count", "1000", "-o", "a.ply"]);
    let said = workshop.succeed(&["relax", "a.ply", "--mesh", "mesh.ply", "-o", "b.ply"]);
    let (before, after) = (samples(&workshop, "a.ply"), samples(&workshop, "b.ply"));
    assert_eq!(before.len(), after.len());
    let smallest = |set: &[[f32; 9]]| {
        let distance = |a: &[f32; 9], b: &[f32; 9]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f32>().sqrt();
        let pairs = (0..set.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| distance(&set[i], &set[j])).fold(f32::MAX, f32::min)
    };
    assert!(smallest(&after) > 1.08 * smallest(&before), "{} {}", smallest(&before), smallest(&after));
    assert!(said.starts_with("b.ply: ") && said.contains(" steps, smallest distance 0.1"), "{said}");
    workshop.succeed(&["relax", "a.ply", "--mesh", "mesh.ply", "--iterations", "0", "-o", "c.ply"]);
    assert_eq!(fs::read(workshop.path("a.ply")).unwrap(), fs::read(workshop.path("c.ply")).unwrap());
    let said = workshop.refuse(&["relax", "a.ply", "-o", "d.ply"], 1);
    assert!(said.contains("a.ply: holds samples of a mesh: give --mesh"), "{said}");
    // Through text, too.
    workshop.succeed(&["relax", "a.ply", "--mesh", "mesh.ply", "--iterations", "0", "-o", "c.csv"]);
    workshop.succeed(&["relax", "c.csv", "--mesh", "mesh.ply", "--iterations", "0", "-o", "c.ply"]);
    assert_eq!(fs::read(workshop.path("a.ply")).unwrap(), fs::read(workshop.path("c.ply")).unwrap());
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "plane.ply"]);
    let said = workshop.refuse(&["relax", "plane.ply", "--mesh", "mesh.ply", "-o", "d.ply"], 1);
    assert!(said.contains("plane.ply: does not say on which triangle"), "{said}");
    workshop.succeed(&["mesh", "sphere", "--detail", "16", "-o", "coarse.ply"]);
    let said = workshop.refuse(&["relax", "a.ply", "--mesh", "coarse.ply", "-o", "d.ply"], 1);
    assert!(said.contains("a.ply: triangles: ["), "{said}");
    workshop.refuse(&["relax", "a.ply", "--mesh", "mesh.ply", "--neighbourhood", "nearest", "-o", "d.ply"], 2);
}
