//! Whether what is to run fits into this machine.

use std::fs;

/// Bytes that are left here, by the kernel and by the control group of this process, where either tells.
pub fn available_bytes() -> Option<u64> {
    let machine = fs::read_to_string("/proc/meminfo").ok().and_then(|text| meminfo(&text));
    [machine, group()].into_iter().flatten().min()
}

fn meminfo(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}

/// Version 2 of control groups, as containers and Slurm set them.
fn group() -> Option<u64> {
    let place = fs::read_to_string("/proc/self/cgroup").ok()?;
    let place =
        place.lines().find_map(|line| line.strip_prefix("0::"))?.trim_matches('/').to_owned();
    let number = |name: &str| {
        let text = fs::read_to_string(format!("/sys/fs/cgroup/{place}/{name}")).ok()?;
        text.trim().parse::<u64>().ok()
    };
    Some(number("memory.max")?.saturating_sub(number("memory.current")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_is_understood() {
        let text = "MemTotal:       24 kB\nMemFree: 7 kB\nMemAvailable:   16 kB\n";
        assert_eq!(meminfo(text), Some(16 * 1024));
        assert_eq!(meminfo("MemTotal: 24 kB"), None);
    }
}
