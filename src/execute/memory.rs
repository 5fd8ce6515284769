//! Whether the work fits into this machine's memory.

use std::fs;
use std::path::Path;

/// Free memory, bytes, by the kernel and by the control group of this process, if either provides
/// it.
pub fn available_bytes() -> Option<u64> {
    let machine = fs::read_to_string("/proc/meminfo").ok();
    let machine = machine.and_then(|text| kilobytes(&text, "MemAvailable:"));
    [machine, group()].into_iter().flatten().min()
}

/// Address space that this process may still take, bytes, if it has a limit (`ulimit -v`).
pub fn address_space_left() -> Option<u64> {
    let read = |name: &str| fs::read_to_string(format!("/proc/self/{name}")).ok();
    let taken = read("status").and_then(|text| kilobytes(&text, "VmSize:")).unwrap_or(0);
    Some(address_space(&read("limits")?)?.saturating_sub(taken))
}

/// The soft limit; `None` without a limit.
fn address_space(limits: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// The value of a line of a kernel's file, in bytes.
pub(super) fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}

/// For each version of control groups: its place, and its files' names for the limit, the memory
/// taken, and the part of that which is cached files and can be freed.
const VERSIONS: [(&str, &str, &str, &str); 2] = [
    ("/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file "),
    (
        "/sys/fs/cgroup/memory",
        "memory.limit_in_bytes",
        "memory.usage_in_bytes",
        "total_inactive_file ",
    ),
];

/// Free memory in the control groups of this process, as containers and Slurm set them. Each group
/// up to the root may have a limit.
fn group() -> Option<u64> {
    let text = fs::read_to_string("/proc/self/cgroup").ok()?;
    let [second, first] = VERSIONS;
    let own = |(root, ..): (&str, &str, &str, &str), prefix: &str| {
        let place = text.lines().find_map(|line| line.split_once(prefix))?.1.trim_matches('/');
        Some(Path::new(root).join(place))
    };
    let places = [(second, own(second, "0::")), (first, own(first, ":memory:"))];
    let left = places.into_iter().filter_map(|(version, place)| {
        let place = place?;
        let groups = place.ancestors().take_while(|group| group.starts_with(version.0));
        groups.filter_map(|group| left_in(group, version)).min()
    });
    left.min()
}

fn left_in(group: &Path, (_, limit, taken, cache): (&str, &str, &str, &str)) -> Option<u64> {
    let read = |name: &str| fs::read_to_string(group.join(name)).ok();
    let number = |name: &str| read(name)?.trim().parse::<u64>().ok();
    let stat = read("memory.stat").unwrap_or_default();
    let cache = stat.lines().find_map(|line| line.strip_prefix(cache)?.trim().parse::<u64>().ok());
    let taken = number(taken)?.saturating_sub(cache.unwrap_or(0));
    Some(number(limit)?.saturating_sub(taken))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_is_understood() {
        let text = "MemTotal:       24 kB\nMemFree: 7 kB\nMemAvailable:   16 kB\n";
        assert_eq!(kilobytes(text, "MemAvailable:"), Some(16 * 1024));
        assert_eq!(kilobytes("MemTotal: 24 kB", "MemAvailable:"), None);
        let limits = |limit: &str| {
            format!(
                "Max processes  9  9  processes\nMax address space  {limit}  unlimited  bytes\n"
            )
        };
        assert_eq!(address_space(&limits("4096")), Some(4096));
        assert_eq!(address_space(&limits("unlimited")), None);
    }

    #[test]
    fn what_a_group_has_read_from_files_is_left() {
        let root = tempfile::tempdir().unwrap();
        let [second, first] = VERSIONS;
        let write = |name: &str, text: &str| fs::write(root.path().join(name), text).unwrap();
        assert_eq!(left_in(root.path(), second), None);
        write("memory.stat", "anon 2\ninactive_file 30\ntotal_inactive_file 50\n");
        write("memory.current", "60\n");
        write("memory.max", "max\n");
        assert_eq!(left_in(root.path(), second), None, "no limit");
        write("memory.max", "100\n");
        assert_eq!(left_in(root.path(), second), Some(70));
        write("memory.limit_in_bytes", "100\n");
        write("memory.usage_in_bytes", "160\n");
        assert_eq!(left_in(root.path(), first), Some(0));
    }
}
