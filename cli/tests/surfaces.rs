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
        workshop.succeed(&["mesh", shape, "--detail", "32", "-o", "mesh.ply"]);
        let file = fs::read(workshop.path("mesh.ply")).unwrap();
        assert!(String::from_utf8_lossy(&file[..300]).contains(&format!("\nelement face {faces}\n")), "{shape}");
        let count_text = count.to_string();
        workshop.succeed(&["surface", "mesh.ply", "--count", &count_text, "-o", "samples.ply"]);
        let made = samples(&workshop, "samples.ply");
        assert_eq!(made.len(), count, "samples of a {shape}");
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
fn surface_has_exactly_the_count_and_says_the_radius() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "sphere", "--detail", "64", "-o", "mesh.ply"]);
    let said = workshop.succeed(&["surface", "mesh.ply", "--count", "4000", "-o", "a.ply"]);
    assert_eq!(samples(&workshop, "a.ply").len(), 4000);
    assert!(said.starts_with("a.ply: 4,000 samples, radius 0.04") && said.contains(", covered within 0.04"), "{said}");
    // Two triangles apart, far below the radius.
    let square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 .001\nv 1 0 .001\nv 0 1 .001\nf 1 2 3\nf 4 5 6\n";
    workshop.write("pair.obj", square);
    workshop.succeed(&["surface", "pair.obj", "--count", "1e3", "-o", "a.ply"]);
    assert_eq!(samples(&workshop, "a.ply").len(), 1000);
    let said = workshop.succeed(&["surface", "mesh.ply", "--radius", "0.5", "-o", "a.ply"]);
    assert!(said.contains(" samples, radius 0.5, "), "{said}");
    workshop.refuse(&["surface", "mesh.ply", "--count", "50", "--iterations", "1", "-o", "b.ply"], 2);
    workshop.refuse(&["surface", "mesh.ply", "--count", "50", "--no-fill", "-o", "b.ply"], 2);
}

#[test]
fn progressive_sets_have_their_ranks_in_all_formats() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "torus", "--detail", "32", "-o", "mesh.ply"]);
    let order = |output: &str, more: &[&str]| {
        workshop.succeed(&[&["surface", "mesh.ply", "--order", "progressive", "-o", output], more].concat())
    };
    for output in ["a.ply", "a.npy", "a.csv", "a.xyz"] {
        order(output, &["--count", "500"]);
    }
    order("b.csv", &["--count", "100"]);
    let [text, fewer] = ["a.csv", "b.csv"].map(|name| fs::read_to_string(workshop.path(name)).unwrap());
    assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v,rank\n") && text.lines().count() == 501);
    assert!(fewer.lines().count() == 101 && text.starts_with(&fewer), "not a prefix");
    let ranks: Vec<f32> = text.lines().skip(1).map(|line| line.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert!(ranks[0] == f32::INFINITY && ranks.is_sorted_by(|a, b| a >= b));
    let ply = fs::read(workshop.path("a.ply")).unwrap();
    assert!(String::from_utf8_lossy(&ply[..300]).contains("property float v\nproperty float rank\nend_header\n"));
    assert!(ply.ends_with(&ranks[499].to_le_bytes()));
    let npy = fs::read(workshop.path("a.npy")).unwrap();
    assert!(String::from_utf8_lossy(&npy[..256]).contains("('barycentrics', '<f4', (2,)), ('rank', '<f4')]"));
    let said = order("c.ply", &["--radius", "0.1", "--quotient", "1.3"]);
    assert!(said.contains(" samples, radius 0.1, "), "{said}");
    let refuse = |arguments: &[&str], code| {
        workshop.refuse(&[&["surface", "mesh.ply", "--radius", "0.1", "-o", "d.ply"], arguments].concat(), code)
    };
    let said = refuse(&["--order", "progressive", "--quotient", "2"], 1);
    assert_eq!(said, "error: quotient: 2.0 is not in 1.02 to 1.5\n");
    refuse(&["--quotient", "1.2"], 2);
    refuse(&["--order", "progressive", "--iterations", "1"], 2);
}

#[test]
fn sets_of_several_classes_have_them_in_all_formats() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "torus", "--detail", "32", "-o", "mesh.ply"]);
    let sample = |output: &str, more: &[&str]| {
        workshop.succeed(&[&["surface", "mesh.ply", "--classes", "0.4,0.2,0.2", "-o", output], more].concat())
    };
    for output in ["a.ply", "a.npy", "a.csv", "a.xyz"] {
        let said = sample(output, &[]);
        assert!(said.contains(" of radius 0.4, ") && said.matches(" of radius 0.2, ").count() == 2, "{said}");
    }
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v,class\n"));
    let classes: Vec<u32> =
        text.lines().skip(1).map(|line| line.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert!(classes.is_sorted() && classes[0] == 0 && *classes.last().unwrap() == 2);
    let ply = fs::read(workshop.path("a.ply")).unwrap();
    assert!(String::from_utf8_lossy(&ply[..300]).contains("property float v\nproperty uint class\nend_header\n"));
    assert!(ply.ends_with(&2u32.to_le_bytes()));
    assert!(String::from_utf8_lossy(&ply[..300]).contains(&format!("element vertex {}\n", classes.len())));
    let npy = fs::read(workshop.path("a.npy")).unwrap();
    assert!(String::from_utf8_lossy(&npy[..256]).contains("('barycentrics', '<f4', (2,)), ('class', '<u4')]"));
    sample("b.csv", &["--class-factor", "0.5", "--given", "a.xyz", "--clearance", "0.1"]);
    let refuse = |arguments: &[&str], code| {
        workshop.refuse(&[&["surface", "mesh.ply", "-o", "d.ply"], arguments].concat(), code)
    };
    refuse(&["--classes", "0.4,0.2", "--radius", "0.1"], 2);
    refuse(&["--classes", "0.4,0.2", "--iterations", "1"], 2);
    refuse(&["--radius", "0.4", "--class-factor", "0.5"], 2);
    let said = refuse(&["--classes", "0.4,0"], 1);
    assert_eq!(said, "error: own: [1] is 0.0, not a positive finite number\n");
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
    // The mesh of the relaxed samples, which are the same as without it.
    workshop.succeed(&["surface", "mesh.ply", "--count", "1000", "--seed", "1", "-o", "f.ply"]);
    workshop.succeed(&["relax", "f.ply", "--mesh", "mesh.ply", "-o", "g.ply"]);
    let said = workshop.succeed(&["relax", "f.ply", "--mesh", "mesh.ply", "-o", "e.ply", "--remesh", "made.ply"]);
    assert_eq!(fs::read(workshop.path("e.ply")).unwrap(), fs::read(workshop.path("g.ply")).unwrap());
    let expected = "made.ply: 1,996 triangles, closed manifold, Euler characteristic 2, angles ";
    assert!(said.contains(expected) && said.ends_with(", unused samples: 0\n"), "{said}");
    workshop.succeed(&["surface", "made.ply", "--count", "100", "-o", "again.ply"]);
    workshop.refuse(&["relax", "plane.ply", "--remesh", "made.ply", "-o", "d.ply"], 2);
    workshop.refuse(&["relax", "a.ply", "--mesh", "mesh.ply", "-o", "d.ply", "--remesh", "made.obj"], 1);
    let said = workshop.refuse(&["relax", "a.ply", "-o", "d.ply"], 1);
    assert!(
        said.contains(
            "a.ply: holds points in three dimensions, not in the plane: give the mesh that they lie on by --mesh"
        ),
        "{said}"
    );
    // Through text, too.
    workshop.succeed(&["relax", "a.ply", "--mesh", "mesh.ply", "--iterations", "0", "-o", "c.csv"]);
    workshop.succeed(&["relax", "c.csv", "--mesh", "mesh.ply", "--iterations", "0", "-o", "c.ply"]);
    assert_eq!(fs::read(workshop.path("a.ply")).unwrap(), fs::read(workshop.path("c.ply")).unwrap());
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "plane.ply"]);
    let said = workshop.refuse(&["relax", "plane.ply", "--mesh", "mesh.ply", "-o", "d.ply"], 1);
    assert!(said.contains("plane.ply: holds points in the plane"), "{said}");
    workshop.succeed(&["mesh", "sphere", "--detail", "16", "-o", "coarse.ply"]);
    let said = workshop.refuse(&["relax", "a.ply", "--mesh", "coarse.ply", "-o", "d.ply"], 1);
    assert!(said.contains("a.ply: triangles: ["), "{said}");
    workshop.refuse(&["relax", "a.ply", "--mesh", "mesh.ply", "--neighbourhood", "nearest", "-o", "d.ply"], 2);
}

/// A square of 16 by 16 quads as PLY text: a radius for each vertex, and a number for each face, 1 for the left half.
fn square(workshop: &Workshop) {
    let mut text = "ply\nformat ascii 1.0\nelement vertex 289\nproperty float x\nproperty float y\nproperty float z\n\
                    property float size\nelement face 256\nproperty list uchar int vertex_indices\nproperty uchar kept\n\
                    end_header\n"
        .to_owned();
    for i in 0..289 {
        let [x, y] = [i % 17, i / 17].map(|step| f64::from(step) / 16.0);
        text += &format!("{x} {y} 0 {}\n", 0.02 + 0.04 * x);
    }
    for i in 0..256 {
        let (column, a) = (i % 16, i / 16 * 17 + i % 16);
        text += &format!("4 {a} {} {} {} {}\n", a + 1, a + 18, a + 17, u8::from(column < 8));
    }
    workshop.write("square.ply", text);
}

#[test]
fn radii_come_from_an_attribute_of_the_vertices() {
    let workshop = Workshop::new();
    square(&workshop);
    for format in ["ply", "npy", "csv"] {
        let output = format!("a.{format}");
        let said = workshop.succeed(&["surface", "square.ply", "--radius-from", "size", "-o", &output]);
        assert!(said.contains(" samples, radii 0.02") && said.contains(" to 0.0"), "{said}");
    }
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,z,nx,ny,nz,triangle,u,v,radius"));
    let rows = lines.map(|line| line.split(',').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<_>>());
    let samples: Vec<_> = rows.map(|row| ([row[0], row[1]], row[9])).collect();
    assert!(samples.len() > 300, "{}", samples.len());
    for (i, ([x, y], radius)) in samples.iter().enumerate() {
        assert!((radius - (0.02 + 0.04 * x)).abs() < 1e-6);
        for ([other_x, other_y], other) in &samples[..i] {
            assert!((x - other_x).hypot(y - other_y) >= 0.5 * (radius + other) - 1e-6);
        }
    }
    let ply = fs::read(workshop.path("a.ply")).unwrap();
    assert!(String::from_utf8_lossy(&ply[..300]).contains("property float v\nproperty float radius\nend_header\n"));
    let npy = fs::read(workshop.path("a.npy")).unwrap();
    assert!(String::from_utf8_lossy(&npy[..256]).contains("('barycentrics', '<f4', (2,)), ('radius', '<f4')]"));
    let refuse =
        |arguments: &[&str], code| workshop.refuse(&[&["surface"], arguments, &["-o", "b.ply"]].concat(), code);
    let said = refuse(&["square.ply", "--radius-from", "heat"], 1);
    assert_eq!(said, "error: square.ply: attribute heat: element vertex has no such number, but x, y, z, size\n");
    let said = refuse(&["square.ply", "--radius-from", "z"], 1);
    assert!(said.starts_with("error: square.ply: attribute z: "), "{said}");
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    let said = refuse(&["roof.obj", "--radius-from", "size"], 1);
    assert_eq!(said, "error: roof.obj: attribute size: only PLY files have attributes\n");
    // Arguments without effect are refused.
    for vain in [&["--iterations", "3"][..], &["--no-fill"], &["--engine", "embree"], &["--radius", "0.1"]] {
        refuse(&[&["square.ply", "--radius-from", "size"], vain].concat(), 2);
    }
}

/// An attribute as a density: the attribute x is 0 at one side of the square and 1 at the other.
#[test]
fn densities_come_from_an_attribute_of_the_vertices() {
    let workshop = Workshop::new();
    square(&workshop);
    for scale in [["--count", "2000"], ["--radius", "0.0132"]] {
        workshop.succeed(&[&["surface", "square.ply", "--density-from", "x", "-o", "a.csv"], &scale[..]].concat());
        let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
        let x: Vec<f64> = text.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
        assert!((1850..2200).contains(&x.len()), "{}", x.len());
        let left = x.iter().filter(|&&x| x < 0.5).count() as f64 / x.len() as f64;
        assert!((left - 0.25).abs() < 0.02, "{left}");
    }
    let refuse = |arguments: &[&str], code| {
        workshop.refuse(&[&["surface", "square.ply", "-o", "b.ply"], arguments].concat(), code)
    };
    refuse(&["--density-from", "x"], 2);
    refuse(&["--density-from", "x", "--radius-from", "size"], 2);
    refuse(&["--density-from", "x", "--count", "10", "--iterations", "1"], 2);
    let said = refuse(&["--density-from", "z", "--count", "10"], 1);
    assert!(said.starts_with("error: square.ply: attribute z: 0 everywhere"), "{said}");
}

/// Samples of one radius become as dense as the attribute x says.
#[test]
fn samples_are_relaxed_to_an_attribute_of_the_vertices() {
    let workshop = Workshop::new();
    square(&workshop);
    workshop.succeed(&["surface", "square.ply", "--radius", "0.02", "-o", "a.csv"]);
    let relax = ["relax", "a.csv", "--mesh", "square.ply", "-o", "b.csv", "--density-from"];
    workshop.succeed(&[&relax[..], &["x"]].concat());
    let read = |name: &str| fs::read_to_string(workshop.path(name)).unwrap();
    let text = read("b.csv");
    let x: Vec<f64> = text.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(x.len(), read("a.csv").lines().count() - 1);
    let left = x.iter().filter(|&&x| x < 0.5).count() as f64 / x.len() as f64;
    assert!((left - 0.25).abs() < 0.02, "{left}");
    let said = workshop.refuse(&[&relax[..], &["z", "--force"]].concat(), 1);
    assert!(said.starts_with("error: square.ply: attribute z: 0 everywhere"), "{said}");
    workshop.refuse(&["relax", "a.csv", "-o", "c.csv", "--density-from", "x"], 2);
}

/// Exactly so many samples of a density, and fewer of them, and all of a radius for each vertex.
#[test]
fn sets_of_varying_radii_have_ranks_in_progressive_order() {
    let workshop = Workshop::new();
    square(&workshop);
    let order = |output: &str, more: &[&str]| {
        workshop.succeed(&[&["surface", "square.ply", "--order", "progressive", "-o", output], more].concat())
    };
    let said = order("a.csv", &["--density-from", "x", "--count", "700"]);
    assert!(said.contains("700 samples, radii ") && said.contains(" at density 1, "), "{said}");
    order("b.csv", &["--density-from", "x", "--count", "300"]);
    order("c.csv", &["--radius-from", "size", "--quotient", "1.3"]);
    let [all, fewer, sizes] = ["a.csv", "b.csv", "c.csv"].map(|name| {
        let text = fs::read_to_string(workshop.path(name)).unwrap();
        assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v,radius,rank\n"), "{text:.60}");
        text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
    });
    assert_eq!((all.len(), fewer.len()), (700, 300));
    // But for the radii, which are those of each set.
    assert!(all.iter().zip(&fewer).all(|(a, b)| a[..9] == b[..9] && a[10] == b[10]), "not a prefix");
    let ranks: Vec<f32> = sizes.iter().map(|row| row[10].parse().unwrap()).collect();
    assert!(ranks.len() > 50 && ranks.is_sorted_by(|a, b| a >= b) && ranks.iter().all(|&rank| rank >= 1.0));
    let said = workshop.refuse(
        &["surface", "square.ply", "--radius-from", "size", "--order", "progressive", "--quotient", "2", "-o", "d.csv"],
        1,
    );
    assert_eq!(said, "error: quotient: 2.0 is not in 1.02 to 1.5\n");
}

#[test]
fn masked_triangles_get_no_samples() {
    let workshop = Workshop::new();
    square(&workshop);
    let mask: String = (0..256).map(|face| if face % 16 < 8 { "1 1\n" } else { "0 0\n" }).collect();
    workshop.write("mask.txt", &mask);
    workshop.succeed(&["surface", "square.ply", "--radius", "0.03", "--mask", "kept", "-o", "a.ply"]);
    workshop.succeed(&["surface", "square.ply", "--radius", "0.03", "--mask-file", "mask.txt", "-o", "b.ply"]);
    let made = samples(&workshop, "a.ply");
    assert!(made.len() > 300 && made.iter().all(|sample| sample[0] <= 0.5), "{}", made.len());
    assert_eq!(fs::read(workshop.path("a.ply")).unwrap(), fs::read(workshop.path("b.ply")).unwrap());
    let refuse = |arguments: &[&str], code| {
        workshop.refuse(&[&["surface", "square.ply", "--radius", "0.03", "-o", "c.ply"], arguments].concat(), code)
    };
    let said = refuse(&["--mask", "size"], 1);
    assert_eq!(said, "error: square.ply: attribute size: element face has no such number, but vertex_indices, kept\n");
    workshop.write("short.txt", &mask[4..]);
    assert_eq!(
        refuse(&["--mask-file", "short.txt"], 1),
        "error: short.txt: 510 entries, but there are 512 triangles\n"
    );
    workshop.write("word.txt", mask.replacen("0 0", "0 no", 1));
    assert_eq!(refuse(&["--mask-file", "word.txt"], 1), "error: word.txt: line 9: \"no\" is neither 0 nor 1\n");
    refuse(&["--mask", "kept", "--mask-file", "mask.txt"], 2);
}

#[test]
fn each_class_has_a_mask_of_its_own() {
    let workshop = Workshop::new();
    square(&workshop);
    // The left half, and the lower one.
    let text = fs::read_to_string(workshop.path("square.ply")).unwrap();
    let text = text.replace("uchar kept\n", "uchar kept\nproperty uchar low\n");
    let mut face = 0;
    let lines = text.lines().map(|line| {
        let is_face = line.starts_with("4 ");
        face += u32::from(is_face);
        if is_face { format!("{line} {}\n", u8::from(face <= 128)) } else { format!("{line}\n") }
    });
    workshop.write("square.ply", lines.collect::<String>());
    let classes = ["surface", "square.ply", "--classes", "0.05,0.03,0.04"];
    workshop.succeed(&[&classes[..], &["--class-masks", "kept,low,low", "-o", "a.csv"]].concat());
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    let rows = text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect::<Vec<f64>>());
    let rows: Vec<_> = rows.map(|row| ([row[0], row[1]], row[9])).collect();
    let all = |class: f64| rows.iter().filter(move |(_, of)| *of == class).map(|(at, _)| *at);
    assert!(all(0.0).all(|[x, _]| x <= 0.5) && all(0.0).filter(|[_, y]| *y > 0.5).count() > 40);
    for class in [1.0, 2.0] {
        assert!(all(class).all(|[_, y]| y <= 0.5) && all(class).filter(|[x, _]| *x > 0.5).count() > 40);
    }
    let refuse =
        |arguments: &[&str], code| workshop.refuse(&[&classes[..], arguments, &["-o", "b.ply"]].concat(), code);
    let said = refuse(&["--class-masks", "kept,low"], 1);
    assert_eq!(said, "error: --class-masks: 2 attributes for 3 classes\n");
    assert!(refuse(&["--class-masks", "kept,low,high"], 1).contains("attribute high: element face has no such number"));
    workshop.refuse(&["surface", "square.ply", "--radius", "0.1", "--class-masks", "kept", "-o", "b.ply"], 2);
}

#[test]
fn samples_keep_clear_of_points_that_are_given() {
    let workshop = Workshop::new();
    workshop.write("square.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\nf 1 4 3\n");
    let nearest = |name: &str, from: [f32; 3]| {
        let distance = |sample: &[f32; 9]| (0..3).map(|axis| (sample[axis] - from[axis]).powi(2)).sum::<f32>().sqrt();
        samples(&workshop, name).iter().map(distance).fold(f32::MAX, f32::min)
    };
    let sample = |arguments: &[&str]| {
        let all = [&["surface", "square.obj", "--radius", "0.05", "-o", "a.ply"], arguments].concat();
        workshop.succeed(&all)
    };
    // By the column of clearances, by that of radii, and by the radius of the set.
    workshop.write("clear.csv", "x,y,z,radius,clearance\n0.5,0.5,0,0.01,0.3\n0.9,0.9,0.1,0.02,0.2\n");
    workshop.write("radii.csv", "x,y,z,radius\n0.5,0.5,0,0.25\n0.9,0.9,0,0.02\n");
    workshop.write("plain.csv", "x,y,z\n0.5,0.5,0\n0.9,0.9,0\n");
    for (name, expected) in [("clear.csv", 0.3), ("radii.csv", 0.25), ("plain.csv", 0.05)] {
        sample(&["--given", name]);
        let found = nearest("a.ply", [0.5, 0.5, 0.0]);
        assert!((expected..expected + 0.05).contains(&found), "{name}: {found}");
    }
    sample(&["--given", "clear.csv", "--clearance", "0.4"]);
    assert!((0.4..0.45).contains(&nearest("a.ply", [0.5, 0.5, 0.0])));
    // A set completes itself: nothing fits into it.
    sample(&[]);
    let said = workshop.succeed(&["surface", "square.obj", "--radius", "0.05", "--given", "a.ply", "-o", "b.ply"]);
    assert!(said.starts_with("b.ply: 0 samples"), "{said}");
    // A value out of range is named by its index, with the file.
    let refuse = |arguments: &[&str], status| {
        workshop.refuse(&[&["surface", "square.obj", "--radius", "0.05", "-o", "c.ply"], arguments].concat(), status)
    };
    workshop.write("bad.csv", "x,y,z,clearance\n0,0,0,1\n0,0,1,-2\n");
    assert_eq!(
        refuse(&["--given", "bad.csv"], 1),
        "error: bad.csv: given_clearances: [1] is -2.0; it must be 0 or more and finite\n"
    );
    workshop.write("flat.csv", "x,y\n0,0\n");
    assert!(refuse(&["--given", "flat.csv"], 1).contains("flat.csv: holds points in the plane"));
    refuse(&["--clearance", "1"], 2);
    assert!(refuse(&["--cosine", "2"], 1).contains("cosine: 2.0 is not in -1..=1"));
}

#[test]
fn both_sides_of_a_thin_wall_are_sampled_with_a_cosine() {
    let workshop = Workshop::new();
    let corners = |z: &str| format!("v 0 0 {z}\nv 1 0 {z}\nv 0 1 {z}\n");
    workshop.write("wall.obj", format!("{}{}f 1 3 2\nf 4 5 6\n", corners("0"), corners("0.001")));
    let count = |cosine: &[&str]| {
        workshop.succeed(&[&["surface", "wall.obj", "--radius", "0.05", "-o", "a.ply"], cosine].concat());
        samples(&workshop, "a.ply").len()
    };
    assert!(10 * count(&["--cosine", "0.5"]) > 18 * count(&[]));
}

/// A pyramid far from the origin, as OBJ, and its height there.
const FAR: &str = "v 500000.25 4649776 7\nv 500001.75 4649776 7\nv 500001 4649777.25 7\nv 500001 4649776.5 8.125\n\
                   f 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn samples_of_a_mesh_far_from_the_origin_are_written_in_its_frame() {
    let workshop = Workshop::new();
    workshop.write("far.obj", FAR);
    for (name, count) in [("a.ply", 9), ("a.csv", 9), ("a.npy", 9), ("a.xyz", 6)] {
        workshop.succeed(&["surface", "far.obj", "--radius", "0.05", "-o", name]);
        let text = workshop.succeed(&["analyze", name, "--mesh", "far.obj", "--json"]);
        let figure = |figure: &str| -> f64 {
            let value = text.split(&format!("\"{figure}\":")).nth(1).unwrap().split("\"mean\":").nth(1).unwrap();
            value.split([',', '}']).next().unwrap().trim().parse().unwrap()
        };
        assert!((0.05 - 1e-6..0.06).contains(&figure("smallest_distance")), "{name}");
        assert!(figure("covering_radius") <= 0.05 + 1e-5, "{name}");
        if count == 9 {
            workshop.succeed(&["relax", name, "--mesh", "far.obj", "-o", "b.csv"]);
        }
    }
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    for line in text.lines().skip(1) {
        let place: Vec<f64> = line.split(',').take(3).map(|word| word.parse().unwrap()).collect();
        assert!((500000.0..500002.0).contains(&place[0]) && (4649775.9..4649777.3).contains(&place[1]), "{line}");
    }
    let header = fs::read(workshop.path("a.ply")).unwrap();
    assert!(
        String::from_utf8_lossy(&header[..300]).contains("property double x\nproperty double y\nproperty double z\n")
    );
    // Around a given sample, in the same frame.
    workshop.write("given.csv", "x,y,z\n500001,4649776.5,8.125\n");
    workshop.succeed(&[
        "surface",
        "far.obj",
        "--radius",
        "0.05",
        "--given",
        "given.csv",
        "--clearance",
        "0.5",
        "-o",
        "c.csv",
    ]);
    for line in fs::read_to_string(workshop.path("c.csv")).unwrap().lines().skip(1) {
        let place: Vec<f64> = line.split(',').take(3).map(|word| word.parse().unwrap()).collect();
        let squared: f64 = std::iter::zip(&place, [500001.0, 4649776.5, 8.125]).map(|(a, b)| (a - b) * (a - b)).sum();
        assert!(squared.sqrt() >= 0.5 - 1e-6, "{line}");
    }
}

#[test]
fn a_file_of_another_format_is_said_to_be_one() {
    let workshop = Workshop::new();
    for (name, content) in [("ball.fbx", "Kaydara FBX Binary"), ("ball.dae", "<COLLADA></COLLADA>\n")] {
        workshop.write(name, content);
        let said = workshop.refuse(&["surface", name, "--radius", "0.1", "-o", "a.ply"], 1);
        assert_eq!(said, format!("error: {name}: holds no mesh in a format that is read: OBJ, PLY, STL, OFF, GLB\n"));
    }
}

#[test]
fn classes_follow_a_density_and_their_files_have_the_radii() {
    let workshop = Workshop::new();
    square(&workshop);
    let classes = ["surface", "square.ply", "--classes", "0.02,0.03", "--seed", "5"];
    let set = [&classes[..], &["--density-from", "x"]].concat();
    let said = workshop.succeed(&[&set[..], &["-o", "a.csv"]].concat());
    assert!(
        said.contains(" of radius 0.02 at density 1, ") && said.contains(" of radius 0.03 at density 1, "),
        "{said}"
    );
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v,radius,class\n"));
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    let own = [0.02, 0.03];
    let mut pairs = 0;
    for (i, a) in rows.iter().enumerate() {
        // The density of the square is x: the radius is that at density 1 over its root.
        let expected = own[a[10] as usize] / a[0].sqrt();
        assert!((a[9] / expected - 1.0).abs() < 1e-5, "{a:?} of {expected}");
        for b in rows[..i].iter().filter(|b| b[10] == a[10]) {
            let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(distance >= (a[9] + b[9]) / 2.0 * (1.0 - 1e-6), "{a:?} {b:?}");
            pairs += 1;
        }
    }
    let right = |class: f64| rows.iter().filter(|row| row[10] == class && row[0] > 0.5).count();
    let left = |class: f64| rows.iter().filter(|row| row[10] == class && row[0] <= 0.5).count();
    assert!(pairs > 10_000 && [0.0, 1.0].iter().all(|&class| right(class) > 2 * left(class)));
    // A file with ranks, and refusals.
    workshop.succeed(&[&set[..], &["--order", "progressive", "-o", "b.csv"]].concat());
    let text = fs::read_to_string(workshop.path("b.csv")).unwrap();
    assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v,radius,rank,class\n"));
    let refuse =
        |arguments: &[&str], code| workshop.refuse(&[&classes[..], arguments, &["-o", "c.ply"]].concat(), code);
    assert!(refuse(&["--density-from", "none"], 1).contains("attribute none: element vertex has no such number"));
    assert!(refuse(&["--density-from", "z"], 1).starts_with("error: square.ply: attribute z: "));
    refuse(&["--density-from", "x", "--radius", "0.1"], 2);
    let said = refuse(&["--density-from", "x", "--given", "a.csv", "--clearance", "-1"], 1);
    assert!(said.starts_with("error: a.csv: given_clearances: "), "{said}");
}
