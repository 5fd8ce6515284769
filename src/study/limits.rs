//! `[limits]` of a file.

use crate::keys::{ConfigError, Key, Section, read_alone, section};
use crate::simulation::Limits;

section! {
    /// `[limits]`: what no case may take more of. No part of what a case is.
    pub(super) struct LimitKeys in "limits" {
        /// Time steps, from rest on; a case fails at the same step on every machine.
        steps: Option<u32> = None, plain().within(1.0, 4e9);
        /// Time on the clock, from where a case or its shared stretch is taken up.
        wall_time_s: Option<f64> = None, unit("s").above_zero();
        /// Memory, estimated and taken. Every case then runs in a process of its own, which takes some 12 MiB
        /// before it begins.
        memory_mib: Option<f64> = None, unit("MiB").above_zero();
    }
}

/// The keys of `[limits]`.
pub fn limits_keys() -> Vec<&'static Key> {
    LimitKeys::keys()
}

/// Reads the table.
pub(super) fn read(table: &toml::Table) -> Result<Limits, ConfigError> {
    let LimitKeys { steps, wall_time_s, memory_mib } = read_alone(table)?;
    Ok(Limits { steps: steps.map(u64::from), wall_time_s, memory_mib })
}

/// The table with these limits; empty without limits.
pub(super) fn table(limits: &Limits) -> toml::Table {
    let &Limits { steps, wall_time_s, memory_mib } = limits;
    let steps = steps.and_then(|steps| u32::try_from(steps).ok());
    LimitKeys { steps, wall_time_s, memory_mib }.table()
}
