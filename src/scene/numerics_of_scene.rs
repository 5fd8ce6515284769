//! The numerics of a scene by its file.

use std::cell::RefCell;

use toml::{Table, Value};

use super::kind::Scene;
use super::numerics::Numerics;
use super::preset::Preset;
use super::suited::Asked;
use crate::keys::{ConfigError, Section, Shared, check_conditions, number, section};

section! {
    /// What `[numerics]` has besides numerics.
    pub(super) struct Base in "numerics" {
        /// The values that hold where no key gives another. With `scheme = "isph"` the preset
        /// `default` is `isph`.
        preset: Preset = Preset::Default, plain();
    }
}

/// Numerics that were already read.
struct Known {
    table: Table,
    base: Numerics,
    numerics: Shared<Numerics>,
}

thread_local! {
    /// The last ones on this thread. Cases of a study mostly share them, and they are most of a
    /// case.
    static LAST: RefCell<Option<Known>> = const { RefCell::new(None) };
}

/// Whether a table has -0, which equals 0 and is written differently.
fn has_minus_zero(table: &Table) -> bool {
    table.values().filter_map(Value::as_float).any(|value| value == 0.0 && value.is_sign_negative())
}

impl Numerics {
    /// Reads the `[numerics]` table of a scene. It must already be known that all its keys exist.
    ///
    /// # Errors
    /// The first value that does not fit.
    pub(super) fn of_scene(scene: &Scene, table: &Table) -> Result<Shared<Numerics>, ConfigError> {
        let mut preset = Base::read(table, None)?.preset;
        let own = preset == Preset::Default;
        let scheme = table.get("scheme").and_then(Value::as_str);
        if own && scheme == Some("isph") {
            preset = Preset::Isph;
        }
        if preset == Preset::Isph && scheme == Some("wcsph") {
            let allowed = "preset = \"isph\" is of scheme = \"isph\"";
            return Err(ConfigError::new("numerics.scheme", "\"wcsph\"", allowed));
        }
        let mut base = Numerics::preset(preset);
        let timed = table.get("stop_when_settled").and_then(Value::as_bool) != Some(true);
        let particle_spacing = table.get("particle_spacing_m").and_then(number);
        let particle_spacing = particle_spacing.unwrap_or(base.particle_spacing_m);
        base.suit(preset, &Asked { scene, particle_spacing, timed });
        LAST.with_borrow_mut(|last| match last {
            Some(known)
                if known.base == base && known.table == *table && !has_minus_zero(table) =>
            {
                Ok(known.numerics.clone())
            }
            _ => {
                let numerics = Numerics::read(table, Some(&base))?;
                check_conditions(table, &numerics)?;
                let numerics = Shared::from(numerics);
                // -0 equals 0, but has another text.
                *last = (!has_minus_zero(table)).then(|| Known {
                    table: table.clone(),
                    base,
                    numerics: numerics.clone(),
                });
                Ok(numerics)
            }
        })
    }
}
