//! The names of choices in files.

use serde::Serialize;

/// The name of a choice, as serde writes it; empty if it has none.
pub fn name_of(choice: impl Serialize) -> String {
    let value = serde_json::to_value(choice).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}
