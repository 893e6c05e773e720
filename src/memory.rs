//! Refusal of requests that exceed the memory, before it is allocated.

use std::path::Path;

use crate::error::{Error, Result};

/// The bytes that tables, patterns and the allocator take besides those that grow with a large request; as much as this
/// for small ones. Found by `tests/c/memory_limits.c`, as are the bytes that callers ask for (docs/design/memory.md).
const SLACK: f64 = (8 << 20) as f64;

/// The least number of bytes, with their slack, for which the limits are looked up. That takes about 0.1 ms, as long as a
/// small call.
const FEWEST_BYTES: f64 = 3.0 * (1 << 20) as f64;

/// Refuses with [`Error::TooLarge`] when `bytes` are more than the machine, the process's limit of address space and
/// its control groups (those of a container, say) can give now. `argument` is the option that asks for them and `what`
/// names their use: "3000000 samples".
///
/// Less than 1 MiB is not refused, nor is anything where the operating system does not tell the limit (only Linux is asked),
/// except on WebAssembly, where a failed allocation would abort the program: there, memory that cannot be reserved at once is
/// refused.
pub fn require(bytes: f64, argument: &'static str, what: &str) -> Result<()> {
    let bytes = bytes + (2.0 * bytes).min(SLACK);
    if !can_be_reserved(bytes) {
        return Err(Error::too_large(
            argument,
            format!("{what} need {bytes:.2e} bytes, which WebAssembly cannot give"),
        ));
    }
    if bytes < FEWEST_BYTES {
        return Ok(());
    }
    match available() {
        Some(limit) if bytes > limit => {
            Err(Error::too_large(argument, format!("{what} need {}, {} are available", size(bytes), size(limit))))
        }
        _ => Ok(()),
    }
}

/// Refuses more points than fit in memory, of so many bytes each at the peak.
pub fn require_points(argument: &'static str, count: usize, bytes: f64) -> Result<()> {
    require(bytes * count as f64, argument, &format!("{count} points"))
}

/// A number of bytes for people, in the unit in which two sizes that differ by a hundredth look different.
fn size(bytes: f64) -> String {
    let mebibytes = bytes / (1u64 << 20) as f64;
    match mebibytes {
        ..10.0 => format!("{mebibytes:.2} MiB"),
        ..1024.0 => format!("{mebibytes:.1} MiB"),
        _ => format!("{:.2} GiB", mebibytes / 1024.0),
    }
}

/// True if WebAssembly has, or can get, this much memory in one piece; always true elsewhere.
fn can_be_reserved(bytes: f64) -> bool {
    // The optimiser would remove a Vec that is not used.
    !cfg!(target_family = "wasm")
        || (bytes < isize::MAX as f64
            && std::hint::black_box(&mut Vec::<u8>::new()).try_reserve_exact(bytes as usize).is_ok())
}

/// The bytes of memory that are available without swapping, where the operating system tells.
pub fn available() -> Option<f64> {
    let machine = read("/proc/meminfo").and_then(|table| entry(&table, "MemAvailable:"));
    [machine, address_space(), control_groups(Path::new("/sys/fs/cgroup"))].into_iter().flatten().reduce(f64::min)
}

fn read(path: impl AsRef<Path>) -> Option<String> {
    // Miri opens no file of the machine, and prints a long warning for each one in /proc.
    if cfg!(miri) { None } else { std::fs::read_to_string(path).ok() }
}

/// An entry of one of Linux's tables, which count in KiB.
fn entry(table: &str, name: &str) -> Option<f64> {
    let entry = table.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: f64 = entry.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0)
}

/// True if the process has a limit of address space.
pub fn has_address_limit() -> bool {
    address_limit().is_some()
}

fn address_limit() -> Option<f64> {
    soft_limit(&read("/proc/self/limits")?)
}

/// The memory that the process's limit (`ulimit -v`) leaves, if it has one.
fn address_space() -> Option<f64> {
    Some(address_limit()? - entry(&read("/proc/self/status")?, "VmSize:")?)
}

/// The soft limit of the address space in the table of limits, unless it is "unlimited".
fn soft_limit(table: &str) -> Option<f64> {
    table.lines().find_map(|line| line.strip_prefix("Max address space"))?.split_whitespace().next()?.parse().ok()
}

/// The memory that the process's control group (version 2) and its parents leave, if they have limits.
fn control_groups(root: &Path) -> Option<f64> {
    let groups = read("/proc/self/cgroup")?;
    let group = groups.lines().find_map(|line| line.strip_prefix("0::/"))?;
    let groups = Path::new(group).ancestors().map(|group| root.join(group));
    groups.filter_map(|group| left_in(&group)).reduce(f64::min)
}

/// The memory that a control group leaves. Cached files are part of it: they count as used, but are dropped on demand.
fn left_in(group: &Path) -> Option<f64> {
    let number = |name: &str| read(group.join(name))?.trim().parse::<f64>().ok();
    let statistics = read(group.join("memory.stat")).unwrap_or_default();
    let cached = statistics.lines().find_map(|line| line.strip_prefix("inactive_file ")?.parse().ok()).unwrap_or(0.0);
    Some(number("memory.max")? - number("memory.current")? + cached)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_any_machine_has_is_refused_and_a_little_is_not() {
        assert!(require(1e6, "radius", "a few samples").is_ok() && require(2e6, "radius", "some samples").is_ok());
        if cfg!(target_os = "linux") {
            let Err(Error::TooLarge { argument, reason }) = require(1e18, "radius", "very many samples") else {
                panic!("an exabyte was granted")
            };
            assert_eq!(argument, "radius");
            assert!(reason.starts_with("very many samples need 931322574.62 GiB, "), "{reason}");
        }
    }

    #[test]
    fn sizes_have_digits_that_tell_them_apart() {
        let mebibyte = (1u64 << 20) as f64;
        let texts = [0.25, 9.5, 101.3, 102.4, 1023.5, 1024.0, 1536.0, 102_400.0].map(|count| size(count * mebibyte));
        let told =
            ["0.25 MiB", "9.50 MiB", "101.3 MiB", "102.4 MiB", "1023.5 MiB", "1.00 GiB", "1.50 GiB", "100.00 GiB"];
        assert_eq!(texts, told);
    }

    #[test]
    fn the_tables_are_read() {
        let available = |table| entry(table, "MemAvailable:");
        assert_eq!(available("MemTotal: 9 kB\nMemAvailable:    1234 kB\n"), Some(1234.0 * 1024.0));
        assert_eq!(available("MemTotal: 9 kB\n"), None);
        assert_eq!(available("MemAvailable: many kB\n"), None);
        let limits =
            |limit| format!("Limit  Soft Limit  Hard Limit  Units\nMax address space     {limit}   unlimited  bytes\n");
        assert_eq!(soft_limit(&limits("4096")), Some(4096.0));
        assert_eq!(soft_limit(&limits("unlimited")), None);
    }

    #[test]
    fn a_control_group_leaves_what_is_not_used_or_only_cached() {
        let group = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(group.path().join(name), text).unwrap();
        write("memory.max", "max\n");
        write("memory.current", "600\n");
        assert_eq!(left_in(group.path()), None);
        write("memory.max", "1000\n");
        assert_eq!(left_in(group.path()), Some(400.0));
        write("memory.stat", "file 200\ninactive_file 100\n");
        assert_eq!(left_in(group.path()), Some(500.0));
    }
}
