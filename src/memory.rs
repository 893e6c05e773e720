//! Refusing what cannot be held, before it is allocated.

use crate::error::{Error, Result};

/// Refuses with [`Error::TooLarge`] when `bytes` are more than the machine can give now. `argument` is the option
/// that asks for them and `what` names what they are for: "3000000 samples".
///
/// Where the operating system does not tell (it is asked on Linux only) nothing is refused.
pub(crate) fn require(bytes: f64, argument: &'static str, what: &str) -> Result<()> {
    match available() {
        Some(limit) if bytes > limit => {
            let gigabytes = |bytes: f64| bytes / (1u64 << 30) as f64;
            Err(Error::too_large(
                argument,
                format!("{what} need {:.1} GiB, {:.1} GiB are available", gigabytes(bytes), gigabytes(limit)),
            ))
        }
        _ => Ok(()),
    }
}

/// Bytes of memory that can be had without swapping.
fn available() -> Option<f64> {
    let table = std::fs::read_to_string("/proc/meminfo").ok()?;
    parse(&table)
}

/// The entry `MemAvailable` of Linux's table, which counts in KiB.
fn parse(table: &str) -> Option<f64> {
    let entry = table.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = entry.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_any_machine_has_is_refused_and_a_little_is_not() {
        assert!(require(1e6, "radius", "a few samples").is_ok());
        if cfg!(target_os = "linux") {
            let Err(Error::TooLarge { argument, reason }) = require(1e18, "radius", "very many samples") else {
                panic!("an exabyte was granted")
            };
            assert_eq!(argument, "radius");
            assert!(reason.starts_with("very many samples need 931322574.6 GiB, "), "{reason}");
        }
    }

    #[test]
    fn the_table_is_read() {
        assert_eq!(parse("MemTotal: 9 kB\nMemAvailable:    1234 kB\n"), Some(1234.0 * 1024.0));
        assert_eq!(parse("MemTotal: 9 kB\n"), None);
        assert_eq!(parse("MemAvailable: many kB\n"), None);
    }
}
