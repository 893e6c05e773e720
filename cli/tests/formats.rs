//! Files of points in every format, from outside.

mod common;

use std::fs;

use common::Workshop;

const FORMATS: [&str; 5] = ["ply", "npy", "csv", "xyz", "raw"];

#[test]
fn a_set_of_the_plane_survives_every_format() {
    let workshop = Workshop::new();
    for format in FORMATS {
        workshop.succeed(&["plane", "--count", "500", "-o", &format!("a.{format}")]);
        // Through the format and back: no step moves a point.
        let (input, output) = (format!("a.{format}"), format!("back-{format}.ply"));
        workshop.succeed(&["relax", &input, "--dimensions", "2", "--iterations", "0", "-o", &output]);
        assert!(fs::read(workshop.path(&output)).unwrap() == fs::read(workshop.path("a.ply")).unwrap(), "{format}");
    }
    let size = |name: &str| fs::metadata(workshop.path(name)).unwrap().len();
    assert_eq!((size("a.raw"), size("a.npy")), (500 * 8, 128 + 500 * 8));
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    assert!(text.starts_with("x,y\n0.") && text.lines().count() == 501);
}

#[test]
fn a_format_can_be_asked_for_whatever_the_extension() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "100", "--format", "csv", "-o", "points.data"]);
    assert!(fs::read_to_string(workshop.path("points.data")).unwrap().starts_with("x,y\n"));
    workshop.succeed(&["relax", "points.data", "--input-format", "csv", "--iterations", "1", "-o", "b.ply"]);
    let said = workshop.refuse(&["relax", "points.data", "-o", "c.ply"], 1);
    assert!(said.starts_with("error: points.data: the extension .data names no format"), "{said}");
    let said = workshop.refuse(&["plane", "--count", "100", "-o", "c.png"], 1);
    assert!(said.starts_with("error: c.png: the extension .png names no format"), "{said}");
    workshop.refuse(&["plane", "--count", "100", "--format", "png", "-o", "c.png"], 2);
}

#[test]
fn samples_of_a_surface_keep_what_each_format_has_a_place_for() {
    let workshop = Workshop::new();
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    for format in ["ply", "npy", "csv", "xyz"] {
        workshop.succeed(&["surface", "roof.obj", "--radius", "0.1", "-o", &format!("a.{format}")]);
    }
    let json = |format: &str| {
        let arguments = ["analyze", &format!("a.{format}"), "--mesh", "roof.obj", "--json"];
        serde_json::from_str::<serde_json::Value>(&workshop.succeed(&arguments)).unwrap()
    };
    let expected = json("ply");
    for format in ["npy", "csv", "xyz"] {
        let found = json(format);
        assert_eq!((&found["figures"], &found["radial"]), (&expected["figures"], &expected["radial"]), "{format}");
    }
    assert!(expected["radial"]["rows"].is_array());
    // Triangles and barycentrics as well, but not in XYZ, where there is no place for them.
    for format in ["npy", "csv"] {
        let input = format!("a.{format}");
        workshop.succeed(&["relax", &input, "--mesh", "roof.obj", "--iterations", "0", "-o", "back.ply"]);
        assert!(fs::read(workshop.path("back.ply")).unwrap() == fs::read(workshop.path("a.ply")).unwrap(), "{format}");
    }
    let said = workshop.refuse(&["relax", "a.xyz", "--mesh", "roof.obj", "-o", "none.ply"], 1);
    assert!(said.contains("a.xyz: does not say on which triangle"), "{said}");
    let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
    assert!(text.starts_with("x,y,z,nx,ny,nz,triangle,u,v\n"), "{text}");
    let npy = fs::read(workshop.path("a.npy")).unwrap();
    let descr = "'descr': [('position', '<f4', (3,)), ('normal', '<f4', (3,)), ('triangle', '<u4'), \
                 ('barycentrics', '<f4', (2,))]";
    assert!(String::from_utf8_lossy(&npy[..192]).contains(descr));
    // Refused before the work: it would take minutes.
    let said = workshop.refuse(&["surface", "roof.obj", "--radius", "0.0001", "-o", "a.raw"], 1);
    assert!(said.starts_with("error: a.raw: raw floats have no place for the normals, triangles"), "{said}");
}

#[test]
fn samples_of_a_mesh_are_never_taken_for_points_of_the_plane() {
    let workshop = Workshop::new();
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    for format in ["ply", "npy", "csv", "xyz"] {
        workshop.succeed(&["surface", "roof.obj", "--radius", "0.3", "-o", &format!("a.{format}")]);
    }
    let positions: Vec<f32> = (0..66).map(|i| i as f32).collect();
    workshop.write("a.raw", positions.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>());
    workshop.write("plain.npy", {
        let header = format!("{:<117}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (22, 3), }");
        let floats = positions.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
        [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes(), &floats].concat()
    });
    for name in ["a.ply", "a.npy", "a.csv", "a.xyz", "a.raw", "plain.npy"] {
        let dimensions: &[&str] = if name == "a.raw" { &["--dimensions", "3"] } else { &[] };
        for (command, instead) in [
            (&["analyze", name][..], "give the mesh that they lie on by --mesh"),
            (
                &["relax", name, "--domain", "0", "0", "2", "2", "-o", "b.ply"],
                "give the mesh that they lie on by --mesh",
            ),
            (&["draw", "points", name, "-o", "b.png"], "azulejo draw surface draws them on their mesh"),
            (&["merge", name, "--radius", "0.1", "-o", "b.ply"], "only sets of the plane can be merged"),
            (&["merge", "--fixed", name, "--radius", "0.1", "-o", "b.ply"], "only sets of the plane can be merged"),
        ] {
            let said = workshop.refuse(&[command, dimensions].concat(), 1);
            let expected = format!("error: {name}: holds points in three dimensions, not in the plane: {instead}\n");
            assert_eq!(said, expected, "{command:?}");
        }
    }
    workshop.succeed(&["analyze", "a.raw", "--dimensions", "3", "--mesh", "roof.obj"]);
    // Nor the other way round.
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "flat.csv"]);
    for command in [
        &["analyze", "flat.csv", "--mesh", "roof.obj"][..],
        &["draw", "surface", "roof.obj", "flat.csv", "-o", "b.png"],
    ] {
        let said = workshop.refuse(command, 1);
        assert_eq!(said, "error: flat.csv: holds points in the plane, without z, and not samples of a mesh\n");
    }
}

#[test]
fn the_dimension_of_raw_floats_has_to_be_given() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "99", "-o", "a.raw"]);
    let said = workshop.refuse(&["analyze", "a.raw"], 1);
    assert_eq!(
        said,
        "error: a.raw: raw floats do not say how many coordinates a point has: give --dimensions 2 or 3\n"
    );
    workshop.succeed(&["analyze", "a.raw", "--dimensions", "2"]);
    workshop.refuse(&["analyze", "a.raw", "--dimensions", "4"], 2);
    workshop.succeed(&["plane", "--count", "99", "-o", "a.xyz"]);
    workshop.succeed(&["analyze", "a.xyz", "--dimensions", "2"]);
    workshop.succeed(&["plane", "--count", "99", "-o", "a.csv"]);
    let said = workshop.refuse(&["analyze", "a.csv", "--dimensions", "3"], 1);
    assert_eq!(said, "error: a.csv: its points do not have 3 dimensions, as --dimensions says\n");
}

#[test]
fn broken_files_are_refused_with_name_place_and_reason() {
    let workshop = Workshop::new();
    let npy = |header: &str| [b"\x93NUMPY\x01\x00\x76\x00", format!("{header:<117}\n").as_bytes()].concat();
    let broken: [(&str, Vec<u8>, &str); 9] = [
        ("word.csv", b"x,y\n0.1,0.2\n0.3,three\n".to_vec(), "line 3: \"three\" is not a number"),
        ("columns.xyz", b"# two\n0 0\n1 1\n2\n".to_vec(), "line 4: has 1 columns, and line 2 has 2"),
        ("header.csv", b"a,b\n1,2\n".to_vec(), "line 1: the header names no column x"),
        ("infinite.txt", b"0 0\n0 1e60\n".to_vec(), "line 2: y is inf, not finite"),
        ("empty.csv", b"x,y\n".to_vec(), "no points"),
        ("cut.raw", vec![0; 12], "12 bytes are not whole points of 2 floats"),
        ("nan.f32", [0.5, 0.5, f32::NAN, 0.5].map(f32::to_le_bytes).concat(), "byte 8: point 1: x is NaN, not finite"),
        (
            "short.npy",
            npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }"),
            "the header announces 3 rows of 8 bytes, but only 0 bytes follow",
        ),
        (
            "pickle.npy",
            npy("{'descr': '|O', 'fortran_order': False, 'shape': (3, 2), }"),
            "has numbers of the type \"|O\", not floats or integers",
        ),
    ];
    for (name, content, reason) in broken {
        workshop.write(name, content);
        for arguments in [
            &["relax", name, "-o", "out.ply"][..],
            &["analyze", name],
            &["merge", name, "--radius", "0.1", "-o", "out.ply"],
        ] {
            let arguments = [arguments, &["--dimensions", "2"]].concat();
            assert_eq!(workshop.refuse(&arguments, 1), format!("error: {name}: {reason}\n"));
        }
    }
    workshop.write("flat.csv", "x,y\n1,2\n");
    let said = workshop.refuse(&["draw", "surface", "flat.csv", "flat.csv", "-o", "a.png"], 1);
    assert!(said.starts_with("error: flat.csv: "), "{said}");
}

/// A command that is ended while it writes leaves neither its output nor a temporary file.
#[cfg(unix)]
#[test]
fn a_signal_leaves_no_file_behind() {
    use std::os::unix::process::ExitStatusExt;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    for (name, number) in [("INT", 2), ("TERM", 15)] {
        let workshop = Workshop::new();
        // Some 100 MB of text take longer to be written than a poll.
        let mut command = workshop.command(&["plane", "--count", "5000000", "-o", "a.xyz"]);
        let mut child = command.stdout(Stdio::null()).spawn().unwrap();
        let start = Instant::now();
        while !workshop.files().iter().any(|file| file.starts_with(".azulejo-")) {
            assert!(child.try_wait().unwrap().is_none() && start.elapsed() < Duration::from_secs(60), "{name}");
            std::thread::sleep(Duration::from_millis(2));
        }
        let sent = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        assert_eq!(child.wait().unwrap().signal(), Some(number));
        assert!(workshop.files().is_empty(), "{name}: {:?}", workshop.files());
    }
}

#[test]
fn scenes_hold_points_or_instances() {
    let workshop = Workshop::new();
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    workshop.succeed(&["surface", "roof.obj", "--radius", "0.25", "-o", "a.csv"]);
    workshop.succeed(&["surface", "roof.obj", "--radius", "0.25", "-o", "a.usda"]);
    let rows: Vec<_> = fs::read_to_string(workshop.path("a.csv")).unwrap().lines().skip(1).map(str::to_owned).collect();
    let points: Vec<_> = rows.iter().map(|row| row.split(',').take(3).collect::<Vec<_>>().join(", ")).collect();
    let usda = fs::read_to_string(workshop.path("a.usda")).unwrap();
    let list = |name: &str| {
        let start = usda.find(&format!(" {name} = [")).unwrap() + name.len() + 5;
        usda[start..start + usda[start..].find(']').unwrap()].replace(['(', ')'], "").replace("\n       ", "")
    };
    assert_eq!(list("points"), points.join(", "));
    assert_eq!(list("widths"), "0.25");
    let arguments = ["plane", "--classes", "0.05,0.1", "--format", "usda-instances", "-o", "b.usda"];
    workshop.succeed(&arguments);
    let usda = fs::read_to_string(workshop.path("b.usda")).unwrap();
    assert!(usda.contains("def PointInstancer") && usda.contains("def Sphere \"class1\""), "{usda}");
    workshop.succeed(&["volume", "--radius", "0.2", "--order", "progressive", "-o", "c.glb"]);
    let glb = fs::read(workshop.path("c.glb")).unwrap();
    assert!(glb.starts_with(b"glTF") && String::from_utf8_lossy(&glb).contains("EXT_mesh_gpu_instancing"));
    let said = workshop.refuse(&["relax", "a.usda", "-o", "d.ply"], 1);
    assert!(said.starts_with("error: a.usda: scenes are written, not read"), "{said}");
    workshop.refuse(&["relax", "a.csv", "--input-format", "usda", "-o", "d.ply"], 2);
}
