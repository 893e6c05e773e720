//! What all pages of measurements begin with, and say of a goal.

use jiff::Timestamp;
use jiff::tz::TimeZone;

/// The title, and when, by which command and on which machine the page was written.
pub fn head(title: &str, command: &str, threads: usize) -> String {
    let date = Timestamp::now().to_zoned(TimeZone::UTC).date();
    let processor = processor();
    format!(
        "# {title}\n\nWritten by `cargo run --release -p azulejo-studies -- {command}` on {date}, on {threads} threads of {processor}."
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
