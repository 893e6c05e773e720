//! Files of all commands: none is replaced unless it is to be, and each has a report.

mod common;

use common::Workshop;
use serde_json::Value;

/// A command that writes a file, and the facts of its report as JSON but `file` and `seconds`.
struct Case {
    arguments: &'static [&'static str],
    output: &'static str,
    facts: &'static [&'static str],
}

const CASES: [Case; 15] = [
    Case { arguments: &["plane", "--radius", "0.2"], output: "a.ply", facts: &["samples", "radius"] },
    Case { arguments: &["plane", "--count", "50"], output: "a.npy", facts: &["samples", "radius", "maximal"] },
    Case { arguments: &["plane", "--classes", "0.2,0.1"], output: "a.csv", facts: &["samples", "classes"] },
    Case {
        arguments: &["surface", "sphere.ply", "--count", "50"],
        output: "a.ply",
        facts: &["samples", "radius", "covering_radius"],
    },
    Case {
        arguments: &["volume", "--radius", "0.4"],
        output: "a.xyz",
        facts: &["samples", "radius", "covering_radius"],
    },
    Case {
        arguments: &["volume", "--inside", "solid.obj", "--radius", "0.5", "--surface-first"],
        output: "a.ply",
        facts: &["samples", "radius", "covering_radius", "surface_samples", "depth"],
    },
    Case { arguments: &["relax", "set.ply"], output: "a.ply", facts: &["samples", "steps", "smallest_distance"] },
    Case {
        arguments: &["relax", "set.ply", "--spectrum", "step", "--iterations", "2"],
        output: "a.ply",
        facts: &["samples", "steps", "smallest_distance", "reached", "residual"],
    },
    Case {
        arguments: &["relax", "box.csv", "--cuboid", "0", "0", "0", "1", "1", "1", "--iterations", "2"],
        output: "a.ply",
        facts: &["samples", "steps", "smallest_distance"],
    },
    Case {
        arguments: &["relax", "within.csv", "--inside", "solid.obj", "--iterations", "2"],
        output: "a.ply",
        facts: &["samples", "steps", "smallest_distance"],
    },
    Case {
        arguments: &["merge", "piece.ply", "--radius", "0.2"],
        output: "a.ply",
        facts: &["samples", "radius", "kept", "eliminated", "inserted"],
    },
    Case { arguments: &["thin", "set.ply", "--count", "5"], output: "a.ply", facts: &["selected", "points"] },
    Case { arguments: &["mask", "--width", "8", "--height", "4"], output: "a.png", facts: &["size", "channels"] },
    Case { arguments: &["mesh", "torus", "--detail", "16"], output: "a.ply", facts: &["vertices", "triangles"] },
    Case { arguments: &["draw", "points", "set.ply", "--size", "200"], output: "a.png", facts: &["width"] },
];

fn workshop() -> Workshop {
    let workshop = Workshop::new();
    for arguments in [
        &["plane", "--count", "100", "-o", "set.ply"][..],
        &["plane", "--radius", "0.2", "--bounded", "-o", "piece.ply"],
        &["mesh", "sphere", "--detail", "16", "-o", "sphere.ply"],
        &["volume", "--count", "100", "-o", "box.csv"],
    ] {
        workshop.succeed(arguments);
    }
    workshop.write("solid.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    workshop.write("within.csv", "x,y,z\n0.5,0.5,0.5\n0.25,0.25,0.5\n");
    workshop
}

#[test]
fn files_are_replaced_only_with_force() {
    let workshop = workshop();
    for Case { arguments, output, .. } in &CASES {
        workshop.write(output, "precious");
        let with = |more: &[&'static str]| [*arguments, &["-o", output][..], more].concat();
        let said = workshop.refuse(&with(&[]), 1);
        assert_eq!(said, format!("error: {output}: exists already; --force replaces it\n"), "{arguments:?}");
        assert_eq!(std::fs::read(workshop.path(output)).unwrap(), b"precious");
        assert!(workshop.run(&with(&["--force"])).status.success(), "{arguments:?}");
        assert_ne!(std::fs::read(workshop.path(output)).unwrap(), b"precious");
    }
}

#[test]
fn the_mesh_of_samples_and_plots_are_not_replaced_either() {
    let workshop = workshop();
    workshop.succeed(&["surface", "sphere.ply", "--count", "50", "-o", "samples.ply"]);
    workshop.write("mesh.ply", "precious");
    let relax = ["relax", "samples.ply", "--mesh", "sphere.ply", "-o", "relaxed.ply", "--remesh", "mesh.ply"];
    let said = workshop.refuse(&relax, 1);
    assert_eq!(said, "error: mesh.ply: exists already; --force replaces it\n");

    let analyze = ["analyze", "set.ply", "--plots", "plots"];
    assert!(workshop.run(&analyze).status.success());
    // The last of its pictures stands there, the first does not.
    std::fs::remove_file(workshop.path("plots/points.png")).unwrap();
    let said = workshop.refuse(&analyze, 1);
    assert!(said.ends_with(".png: exists already; --force replaces it\n"), "{said}");
    assert!(!workshop.path("plots/points.png").exists());
    assert!(workshop.run(&[&analyze[..], &["--force"]].concat()).status.success());
    assert!(workshop.path("plots/points.png").exists());
}

#[test]
fn reports_are_objects_of_json() {
    let workshop = workshop();
    for Case { arguments, output, facts } in &CASES {
        let said = workshop.succeed(&[*arguments, &["-o", output, "--json"][..]].concat());
        let object: Value =
            serde_json::from_str(&said).unwrap_or_else(|error| panic!("{arguments:?}: {said}: {error}"));
        let mut expected = vec!["file"];
        expected.extend(*facts);
        let is_timed = !matches!(arguments[0], "mesh" | "draw");
        expected.extend(is_timed.then_some("seconds"));
        expected.sort_unstable();
        let mut found: Vec<_> = object.as_object().unwrap().keys().map(String::as_str).collect();
        found.sort_unstable();
        assert_eq!(found, expected, "{arguments:?}");
        assert_eq!(object["file"], *output);
    }
    let said = workshop.succeed(&["plane", "--count", "50", "-o", "fifty.ply", "--json"]);
    let object: Value = serde_json::from_str(&said).unwrap();
    assert_eq!((&object["samples"], &object["maximal"]), (&Value::from(50), &Value::from(true)));
    assert!(object["radius"].as_f64().unwrap() > 0.0);
}

#[test]
fn a_report_does_not_get_into_the_output() {
    let workshop = workshop();
    let output = workshop.run(&["plane", "--count", "50", "--format", "csv", "-o", "-", "--json"]);
    assert!(output.status.success());
    assert!(String::from_utf8(output.stdout).unwrap().lines().count() >= 50);
    let object: Value = serde_json::from_slice(&output.stderr).unwrap();
    assert_eq!((&object["file"], &object["samples"]), (&Value::from("-"), &Value::from(50)));
    let output = workshop.run(&["plane", "--count", "50", "--format", "csv", "-o", "-"]);
    assert!(output.status.success() && output.stderr.is_empty());
}
