//! `azulejo relax`, `mesh` and `surface`, and what is refused, from outside.

mod common;
#[path = "common/ply.rs"]
#[allow(dead_code)]
mod ply;

use std::fs;

use common::Workshop;
use ply::{flat, floats};

#[test]
fn relax_moves_points_apart_and_keeps_their_number_and_domain() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "400", "-o", "a.ply"]);
    for neighbourhood in ["delaunay", "nearest"] {
        let arguments = ["relax", "a.ply", "--neighbourhood", neighbourhood, "--iterations", "30", "-o", "b.ply"];
        let said = workshop.succeed(&arguments);
        assert!(said.contains(" steps, smallest distance 0.0"), "{said}");
        let [(before, old), (after, new)] =
            ["a.ply", "b.ply"].map(|name| flat(&fs::read(workshop.path(name)).unwrap(), 2));
        assert_eq!(before, after);
        assert_ne!(old, new);
    }
    workshop.succeed(&["relax", "a.ply", "--iterations", "0", "-o", "b.ply"]);
    assert!(fs::read(workshop.path("a.ply")).unwrap() == fs::read(workshop.path("b.ply")).unwrap());
}

#[test]
fn mesh_writes_a_closed_mesh() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["mesh", "knot", "--detail", "64", "-o", "knot.ply"]);
    assert_eq!(said, "knot.ply: 1,024 vertices, 2,048 triangles\n");
    let file = fs::read(workshop.path("knot.ply")).unwrap();
    let header = b"element face 2048\nproperty list uchar uint vertex_indices\nend_header\n";
    let end = file.windows(header.len()).position(|window| window == header).unwrap() + header.len();
    // 64 rings of 16 vertices, and two triangles to a vertex.
    assert_eq!(file.len() - end, 1024 * 12 + 2048 * 13);
}

#[test]
fn numbers_out_of_range_are_refused_with_their_name() {
    let workshop = Workshop::new();
    for radius in ["0", "-1", "nan", "inf", "1e-30"] {
        let said = workshop.refuse(&["plane", "--radius", radius, "-o", "a.ply"], 1);
        assert!(said.starts_with("error: radius: "), "{said}");
    }
    let said = workshop.refuse(&["plane", "--count", "100", "--leaf-size", "2", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: leaf_size: "), "{said}");
    let said = workshop.refuse(&["plane", "--count", "100", "--domain", "0", "0", "0", "1", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: domain_max: ") || said.starts_with("error: radius: "), "{said}");
    let said = workshop.refuse(&["plane", "--count", "100", "--threads", "99999", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: num_threads: "), "{said}");
}

#[test]
fn wrong_usage_has_a_code_of_its_own() {
    let workshop = Workshop::new();
    for arguments in [
        &["plane", "-o", "a.ply"][..],
        &["plane", "--count", "0", "-o", "a.ply"],
        &["plane", "--count", "x", "-o", "a.ply"],
        &["plane", "--count", "9", "--radius", "1", "-o", "a.ply"],
        &["plane", "--count", "9"],
        &["plane", "--count", "9", "--domain", "0", "1", "-o", "a.ply"],
        &["mesh", "cube", "-o", "a.ply"],
        &["mesh", "knot", "--detail", "1", "-o", "a.ply"],
        &["relax", "-o", "a.ply"],
        &["paint"],
        &[],
    ] {
        assert!(!workshop.refuse(arguments, 2).is_empty());
    }
}

#[test]
fn files_that_cannot_be_read_are_named_with_the_reason() {
    let workshop = Workshop::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nend_header\n";
    fs::create_dir(workshop.path("folder")).unwrap();
    for (name, content) in [
        ("empty.ply", String::new()),
        ("garbage.ply", "no ply at all".to_owned()),
        ("short.ply", format!("{header}0 0\n")),
        ("word.ply", format!("{header}0 0\n1 one\n")),
        ("infinite.ply", format!("{header}0 0\n1 1e99\n")),
        ("none.ply", header.replace("vertex 2", "vertex 0")),
        ("huge.ply", header.replace("ascii", "binary_little_endian").replace("vertex 2", "vertex 99999999999999")),
        ("flat.ply", header.replace("float y", "float z") + "0 0\n1 1\n"),
        ("anywhere.ply", format!("{header}5 5\n7 7\n")),
    ] {
        workshop.write(name, content);
        let said = workshop.refuse(&["relax", name, "-o", "out.ply"], 1);
        assert!(said.starts_with(&format!("error: {name}: ")), "{said}");
    }
    for name in ["missing.ply", "folder"] {
        let said = workshop.refuse(&["relax", name, "-o", "out.ply"], 1);
        assert!(said.starts_with(&format!("error: {name}: ")), "{said}");
    }
}

#[test]
fn places_that_cannot_be_written_are_refused_before_the_work() {
    let workshop = Workshop::new();
    fs::create_dir(workshop.path("folder")).unwrap();
    for place in ["folder", "missing/a.ply"] {
        let said = workshop.refuse(&["plane", "--count", "1000000000", "-o", place], 1);
        assert!(said.starts_with(&format!("error: {place}: ")), "{said}");
    }
    let said = workshop.refuse(&["mesh", "knot", "-o", "knot.obj"], 1);
    assert_eq!(said, "error: knot.obj: the extension is not .ply, the only format of this file\n");
}

#[test]
fn points_in_text_with_other_properties_are_read() {
    let workshop = Workshop::new();
    let mut text = "ply\nformat ascii 1.0\ncomment domain 0 0 4 4 bounded\nelement vertex 16\nproperty uchar red\n\
                    property double y\nproperty int x\nproperty list uchar int near\nend_header\n"
        .to_owned();
    (0..16).for_each(|i| text += &format!("255 {}.25 {} 2 7 8\n", i / 4, i % 4));
    workshop.write("text.ply", text);
    workshop.succeed(&["relax", "text.ply", "--iterations", "0", "-o", "a.ply"]);
    let (header, points) = flat(&fs::read(workshop.path("a.ply")).unwrap(), 2);
    assert!(header.contains("comment domain 0 0 4 4 bounded\n"), "{header}");
    assert_eq!((points.len(), &points[6][..]), (16, &[2.0, 1.25][..]));
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
fn surface_writes_samples_with_normals_triangles_and_barycentrics() {
    let workshop = Workshop::new();
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    let said = workshop.succeed(&["surface", "roof.obj", "--radius", "0.1", "-o", "a.ply"]);
    assert!(said.contains(" samples, radius 0.1, "), "{said}");
    let (header, samples) = floats(&fs::read(workshop.path("a.ply")).unwrap(), 9);
    let names = ["x", "y", "z", "nx", "ny", "nz", "triangle", "u", "v"];
    let lines = names.map(|name| if name == "triangle" { "uint triangle".into() } else { format!("float {name}") });
    assert!(header.ends_with(&format!("property {}\nend_header\n", lines.join("\nproperty "))), "{header}");
    assert!((200..400).contains(&samples.len()), "{}", samples.len());
    for sample in &samples {
        let (triangle, [u, v]) = (sample[6].to_bits(), [sample[7], sample[8]]);
        let [expected, normal] = match triangle {
            0 => [[2.0 * u, 2.0 * v, 0.0], [0.0, 0.0, 1.0]],
            _ => [[2.0 * v, 0.0, 2.0 * u], [0.0, 1.0, 0.0]],
        };
        assert!((0..3).all(|i| (sample[i] - expected[i]).abs() < 1e-6 && sample[3 + i] == normal[i]), "{sample:?}");
    }
    let few = ["surface", "roof.obj", "--radius", "0.0964", "--iterations", "1", "--no-fill", "-o", "b.ply"];
    workshop.succeed(&few);
    let (_, fewer) = floats(&fs::read(workshop.path("b.ply")).unwrap(), 9);
    assert!((150..300).contains(&fewer.len()), "{}", fewer.len());
    workshop.succeed(&["draw", "surface", "roof.obj", "a.ply", "-o", "a.png", "--size", "200"]);
}
