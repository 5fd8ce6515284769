//! Limits of a case. They are not part of its identity: they decide whether it ends, never how.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::math::words::counted;

/// Limits of a case; by default there are none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Time steps, from the start.
    pub steps: Option<u64>,
    /// Seconds of wall-clock time, from when a rank starts the case or its trunk.
    pub wall_time_s: Option<f64>,
    /// Mebibytes of memory of a process with only this case.
    pub memory_mib: Option<f64>,
}

/// In bytes.
const MEBIBYTE: f64 = (1 << 20) as f64;

impl Limits {
    /// The message if this many steps are over the limit.
    pub fn on_steps(&self, steps: u64) -> Option<String> {
        let limit = self.steps.filter(|&limit| steps > limit)?;
        let steps = counted(usize::try_from(limit).unwrap_or(usize::MAX), "step");
        Some(format!("needs more than {steps} (limits.steps)"))
    }

    /// The message if this much time is over the limit.
    pub fn on_time(&self, spent: Duration) -> Option<String> {
        let limit = self.wall_time_s.filter(|&limit| spent.as_secs_f64() > limit)?;
        Some(format!("takes more than {limit} s (limits.wall_time_s)"))
    }

    /// The message if this many bytes, used or estimated, are over the limit.
    pub fn on_memory(&self, bytes: u64, how: &str) -> Option<String> {
        let (used, limit) = (bytes as f64 / MEBIBYTE, self.memory_mib?);
        let told = || format!("{how} {used:.1} MiB, more than {limit} (limits.memory_mib)");
        (used > limit).then(told)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_over_a_limit_is_told_with_it() {
        let none = Limits::default();
        assert_eq!(none.on_steps(u64::MAX), None);
        assert_eq!(none.on_time(Duration::MAX), None);
        assert_eq!(none.on_memory(u64::MAX, "needs"), None);
        let limits = Limits { steps: Some(10), wall_time_s: Some(0.5), memory_mib: Some(2.0) };
        assert_eq!(limits.on_steps(10), None);
        assert_eq!(limits.on_steps(11).unwrap(), "needs more than 10 steps (limits.steps)");
        let one = Limits { steps: Some(1), ..none };
        assert_eq!(one.on_steps(2).unwrap(), "needs more than 1 step (limits.steps)");
        assert_eq!(limits.on_time(Duration::from_millis(500)), None);
        let told = limits.on_time(Duration::from_millis(501)).unwrap();
        assert_eq!(told, "takes more than 0.5 s (limits.wall_time_s)");
        assert_eq!(limits.on_memory(2 << 20, "needs"), None);
        let told = limits.on_memory(3 << 20, "needs").unwrap();
        assert_eq!(told, "needs 3.0 MiB, more than 2 (limits.memory_mib)");
    }
}
