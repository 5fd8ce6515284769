//! The names that files have for choices.

use serde::Serialize;

/// The name of a choice, as serde writes it; empty for what has none.
pub fn name_of(choice: impl Serialize) -> String {
    let value = serde_json::to_value(choice).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}
