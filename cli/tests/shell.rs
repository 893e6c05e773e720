//! `azulejo completions` and `man`, from outside.

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
