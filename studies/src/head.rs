//! What all pages of measurements begin with, and say of a goal.

use std::time::{SystemTime, UNIX_EPOCH};

use azulejo_cli::text::date;

/// The title, and when, by which command and on which machine the page was written.
pub fn head(title: &str, command: &str, threads: usize) -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let processor = processor();
    format!(
        "# {title}\n\nWritten by `cargo run --release -p azulejo-studies -- {command}` on {}, on {threads} threads of {processor}.",
        date(seconds)
    )
}

/// The name of the processor, where the system tells it.
fn processor() -> String {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or("an unknown processor", |(_, name)| name).to_owned()
}

pub fn verdict(is_met: bool) -> &'static str {
    if is_met { "met" } else { "**not met**" }
}
