//! JSON Schema of sections.

use serde_json::{Map, Value, json};

use super::key::Key;
use super::rule::Range;
use super::shape::Shape;

/// The schema of a table with only these keys. It does not cover conditions on two values at once,
/// nor keys that are required only for some value of another key.
pub fn schema(keys: &[&Key]) -> Value {
    let properties: Map<_, _> =
        keys.iter().map(|key| (key.name.to_owned(), key.schema())).collect();
    let required: Vec<_> = keys
        .iter()
        .filter(|key| key.required && key.rule.only.is_none())
        .map(|key| key.name)
        .collect();
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

impl Key {
    /// The schema of its value.
    pub fn schema(&self) -> Value {
        let mut schema = match (self.shape)() {
            Shape::Number => json!({ "type": "number" }),
            Shape::Whole => json!({ "type": "integer", "minimum": 0 }),
            Shape::Flag => json!({ "type": "boolean" }),
            Shape::Text => json!({ "type": "string" }),
            Shape::Points => json!({
                "type": "array",
                "items": { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 },
                "minItems": 2
            }),
            Shape::Names(names) => json!({ "enum": names }),
        };
        match self.rule.range {
            Range::Any => {}
            Range::AboveZero => schema["exclusiveMinimum"] = json!(0),
            Range::NotNegative => schema["minimum"] = json!(0),
            Range::Within(low, high) => {
                schema["minimum"] = json!(low);
                schema["maximum"] = json!(high);
            }
        }
        let unit = Some(self.rule.unit).filter(|unit| !unit.is_empty());
        let unit = unit.map(|unit| format!(" Unit: {unit}.")).unwrap_or_default();
        schema["description"] = json!(format!("{}{unit}", self.meaning_and_place()));
        if let Some(default) = (self.default)() {
            schema["default"] = json!(default);
        }
        schema
    }
}
