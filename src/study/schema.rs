//! The JSON Schema of sweep and scene files, from the declarations of their keys.

use serde_json::{Map, Value, json};

use super::axis::{MOST_CASES, RANGE_KEYS};
use super::file::Accuracy;
use super::limits::limits_keys;
use super::refine::refine_keys;
use crate::keys::{self, Key, Section};
use crate::scene::{
    CREST_COLUMNS, HISTORY_COLUMNS, Kind, numerics_keys, other_defaults, probe_keys, scene_keys,
};

/// The schema. Every file that `seawall check` accepts fits it. It does not cover conditions on two
/// values at once, except of a probe, nor keys that a grid may leave out of its sections.
pub fn schema() -> Value {
    let word = "^[A-Za-z0-9_-][A-Za-z0-9._-]*$";
    let mut definitions: Map<_, _> =
        Kind::ALL.iter().map(|&kind| (scene_name(kind), keys::schema(&scene_keys(kind)))).collect();
    definitions.insert("numerics".to_owned(), numerics());
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Sweep and scene files of seawall",
        "type": "object",
        "properties": {
            "name": { "type": "string", "pattern": word },
            "scene": scene(),
            "numerics": { "$ref": "#/$defs/numerics" },
            "probe": { "type": "array", "items": probe() },
            "accuracy": keys::schema(&Accuracy::keys()),
            "limits": keys::schema(&limits_keys()),
            "grid": grid(),
        },
        "required": ["name"],
        "additionalProperties": false,
        "$defs": definitions,
    })
}

/// A probe, with what depends on its kind. How far the tank goes is not known here.
fn probe() -> Value {
    let keys = probe_keys();
    let mut schema = keys::schema(&keys);
    let taken = ["time_s"].iter().chain(&CREST_COLUMNS).chain(&HISTORY_COLUMNS);
    schema["properties"]["name"]["pattern"] = json!("^[A-Za-z0-9._-]+$");
    schema["properties"]["name"]["not"] = json!({ "enum": taken.collect::<Vec<_>>() });
    for not_negative in ["x_m", "diameter_m"] {
        schema["properties"][not_negative]["minimum"] = json!(0);
    }
    let belongs = |key: &&Key| {
        let when = key.rule.only?;
        Some(json!({
            "if": { "required": [key.name] },
            "then": { "properties": { when.key: { "enum": when.values } } },
        }))
    };
    let height = json!({
        "if": { "properties": { "kind": { "const": "pressure" } }, "required": ["kind"] },
        "then": { "required": ["y_m"] },
    });
    schema["allOf"] = keys.iter().filter_map(belongs).chain([height]).collect();
    schema
}

fn scene_name(kind: Kind) -> String {
    format!("scene.{}", kind.name())
}

/// The numerics, each key with its other defaults in some scenes.
fn numerics() -> Value {
    let mut schema = keys::schema(&numerics_keys());
    for key in numerics_keys() {
        let described = &mut schema["properties"][key.name]["description"];
        let others = other_defaults(key.name);
        let told: String = others.map(|told| format!(" By default {told}.")).collect();
        *described = json!(described.as_str().unwrap_or_default().to_owned() + &told);
    }
    schema
}

/// A scene by its kind: each kind's schema, with the kind's name in `kind`.
fn scene() -> Value {
    let of_kind = |&kind: &Kind| {
        let required: &[&str] = if kind == Kind::DEFAULT { &[] } else { &["kind"] };
        json!({
            "if": { "properties": { "kind": { "const": kind.name() } }, "required": required },
            "then": { "$ref": format!("#/$defs/{}", scene_name(kind)) },
        })
    };
    let names: Vec<_> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    json!({
        "type": "object",
        "properties": { "kind": { "enum": names } },
        "allOf": Kind::ALL.iter().map(of_kind).collect::<Vec<_>>(),
    })
}

/// The grid: any key of a scene or of the numerics, with a list of its values or a range of them.
fn grid() -> Value {
    let mut values: Map<String, Value> = Map::new();
    let keys = Kind::ALL.iter().flat_map(|&kind| scene_keys(kind)).chain(numerics_keys());
    for key in keys {
        let others = values.entry(key.name).or_insert_with(|| json!([]));
        let schema = value_of(key);
        if let Some(others) = others.as_array_mut().filter(|others| !others.contains(&schema)) {
            others.push(schema);
        }
    }
    let axis = |(key, of): (String, Value)| {
        let list = json!({ "type": "array", "items": { "anyOf": of }, "minItems": 1 });
        let forms: Vec<_> = [list].into_iter().chain(range(&of)).collect();
        (key, json!({ "anyOf": forms }))
    };
    let axes: Map<_, _> = values.into_iter().map(axis).collect();
    let mut properties = axes;
    properties.insert("refine".to_owned(), keys::schema(&refine_keys()));
    json!({
        "type": "object",
        "properties": properties,
        "minProperties": 1,
        "additionalProperties": false,
    })
}

/// The schema of one value of a key, for any kind of scene.
fn value_of(key: &Key) -> Value {
    let mut schema = key.schema();
    for of_kind in ["default", "description"] {
        schema.as_object_mut().map(|schema| schema.remove(of_kind));
    }
    schema
}

/// A range of values, if the key takes numbers.
fn range(of: &Value) -> Option<Value> {
    let is_number = |one: &&Value| one["type"] == "number" || one["type"] == "integer";
    let numbers: Vec<_> = of.as_array()?.iter().filter(is_number).collect();
    if numbers.is_empty() {
        return None;
    }
    let [from, to, points, spacing] = RANGE_KEYS;
    Some(json!({
        "type": "object",
        "properties": {
            from: { "anyOf": numbers },
            to: { "anyOf": numbers },
            points: { "type": "integer", "minimum": 2, "maximum": MOST_CASES },
            spacing: { "enum": ["linear", "log"] },
        },
        "required": [from, to, points],
        "additionalProperties": false,
    }))
}
