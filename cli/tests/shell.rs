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
