//! `azulejo completions` and `man`, and what shells do with pipes and devices, from outside.

mod common;

use std::process::Command;

use common::Workshop;

#[test]
fn completions_know_the_commands() {
    let workshop = Workshop::new();
    for (shell, start) in [("bash", "_azulejo()"), ("zsh", "#compdef azulejo"), ("fish", "")] {
        let script = workshop.succeed(&["completions", shell]);
        assert!(script.starts_with(start), "{script}");
        for word in ["plane", "analyze", "merge", "leaf-size", "rasteriser"] {
            assert!(script.contains(word), "{shell} {word}");
        }
    }
    workshop.write("azulejo.bash", workshop.succeed(&["completions", "bash"]));
    assert!(Command::new("bash").arg("-n").arg(workshop.path("azulejo.bash")).status().unwrap().success());
    workshop.refuse(&["completions", "cmd"], 2);
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let workshop = Workshop::new();
    let page = workshop.succeed(&["man"]);
    assert!(page.contains(".TH azulejo 1") && page.contains("azulejo\\-relax(1)"), "{page}");
    assert!(page.contains("Exit codes"), "{page}");
    let page = workshop.succeed(&["man", "draw", "points"]);
    assert!(page.contains(".TH azulejo-draw-points 1") && page.contains("\\-\\-size"), "{page}");
    let said = workshop.refuse(&["man", "draw", "walls"], 1);
    assert_eq!(said, "error: COMMAND: draw has no command \"walls\"\n");
}

#[cfg(target_os = "linux")]
mod streams {
    use std::fs::{self, File};
    use std::process::Stdio;

    use super::common::Workshop;

    fn full() -> File {
        File::options().write(true).open("/dev/full").unwrap()
    }

    #[test]
    fn a_dash_is_the_standard_output_or_input() {
        let workshop = Workshop::new();
        workshop.succeed(&["plane", "--count", "50", "-o", "a.csv"]);
        let said = workshop.succeed(&["plane", "--count", "50", "--format", "csv", "-o", "-"]);
        // Nothing else is said there.
        assert_eq!(said, fs::read_to_string(workshop.path("a.csv")).unwrap());
        let mut relax = workshop.command(&["relax", "--input-format", "csv", "-", "--iterations", "0", "-o", "b.csv"]);
        assert!(
            relax.stdin(File::open(workshop.path("a.csv")).unwrap()).stdout(Stdio::null()).status().unwrap().success()
        );
        assert_eq!(fs::read(workshop.path("a.csv")).unwrap(), fs::read(workshop.path("b.csv")).unwrap());
        assert_eq!(workshop.files(), ["a.csv", "b.csv"]);
    }

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn a_dash_is_a_mesh_or_an_image_too() {
        let workshop = Workshop::new();
        let from = |file: &str, arguments: &[&str]| {
            let mut command = workshop.command(arguments);
            let output = command.stdin(File::open(workshop.path(file)).unwrap()).output().unwrap();
            assert!(output.status.success(), "{arguments:?}: {output:?}");
            output.stdout
        };
        workshop.succeed(&["mesh", "sphere", "--detail", "16", "-o", "mesh.ply"]);
        workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
        for mesh in ["mesh.ply", "roof.obj"] {
            workshop.succeed(&["surface", mesh, "--radius", "0.2", "-o", "a.ply"]);
            let samples = from(mesh, &["surface", "-", "--radius", "0.2", "-o", "-"]);
            assert!(samples == fs::read(workshop.path("a.ply")).unwrap(), "{mesh}");
            let said = workshop.succeed(&["analyze", "a.ply", "--mesh", mesh]);
            let piped = from(mesh, &["analyze", "a.ply", "--mesh", "-"]);
            assert_eq!(String::from_utf8(piped).unwrap(), said.replace(mesh, "-"));
            from(mesh, &["draw", "surface", "-", "a.ply", "-o", "a.png", "--size", "200", "--force"]);
            from(mesh, &["relax", "a.ply", "--mesh", "-", "--iterations", "2", "-o", "b.ply", "--force"]);
        }
        assert_eq!(
            from("a.png", &["mesh", "sphere", "--detail", "16", "-o", "-"]),
            fs::read(workshop.path("mesh.ply")).unwrap()
        );
        let svg = from("a.png", &["stipple", "-", "--count", "1e2", "--iterations", "2", "--format", "svg", "-o", "-"]);
        workshop.succeed(&["stipple", "a.png", "--count", "100", "--iterations", "2", "-o", "a.svg"]);
        assert!(svg == fs::read(workshop.path("a.svg")).unwrap());
        let mut twice = workshop.command(&["draw", "surface", "-", "-", "-o", "c.png"]);
        let output = twice.stdin(File::open(workshop.path("mesh.ply")).unwrap()).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(said, "error: -: the standard input can be read only once\n");
        // A file that is appended to keeps its contents.
        let log = File::options().append(true).create(true).open(workshop.path("log.csv")).unwrap();
        let plane = ["plane", "--count", "50", "--format", "csv", "-o", "-"];
        for _ in 0..2 {
            assert!(workshop.command(&plane).stdout(log.try_clone().unwrap()).status().unwrap().success());
        }
        assert_eq!(fs::read_to_string(workshop.path("log.csv")).unwrap().lines().count(), 102);
    }

    #[test]
    fn results_that_find_no_room_are_a_failure() {
        let workshop = Workshop::new();
        workshop.succeed(&["plane", "--count", "50", "-o", "a.ply"]);
        for arguments in
            [&["analyze", "a.ply"][..], &["man"], &["completions", "fish"], &["plane", "--count", "9", "-o", "-"]]
        {
            let output = workshop.command(arguments).stdout(full()).output().unwrap();
            let said = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
            assert!(said.starts_with("error: ") && said.contains("No space left"), "{said}");
        }
    }

    #[test]
    fn a_reason_that_nobody_can_be_told_is_no_panic() {
        let workshop = Workshop::new();
        let status = workshop.command(&["analyze", "missing.ply"]).stderr(full()).status().unwrap();
        assert_eq!(status.code(), Some(1));
    }

    #[test]
    fn a_reader_that_has_heard_enough_is_no_failure() {
        let workshop = Workshop::new();
        let mut man = workshop.command(&["completions", "bash"]).stdout(Stdio::piped()).spawn().unwrap();
        drop(man.stdout.take());
        assert!(man.wait().unwrap().success());
    }
}
