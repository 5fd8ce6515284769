//! The JSON Schema that `seawall check --schema` prints: every shipped file fits it, and what the
//! program refuses key by key does not.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::ended;
use serde_json::{Value, json};

fn schema() -> Value {
    ended(0, &["check", "--schema"]).json()
}

/// The first place that does not fit and why, for the part of JSON Schema that is used.
fn misfit(root: &Value, schema: &Value, value: &Value, path: &str) -> Option<String> {
    let fits = |schema: &Value| misfit(root, schema, value, path).is_none();
    let wrong = |what: &str| Some(format!("{path} = {value}: {what}"));
    let parts = schema.as_object().unwrap_or_else(|| panic!("{path}: {schema}"));
    for (word, rule) in parts {
        let list = || rule.as_array().unwrap();
        let bound = || rule.as_f64().unwrap();
        let is = |wrong: &dyn Fn(f64) -> bool| value.as_f64().is_some_and(wrong);
        let found = match word.as_str() {
            "$ref" => misfit(root, definition(root, rule), value, path),
            "type" if !is_a(value, rule.as_str().unwrap()) => wrong(&format!("no {rule}")),
            "enum" if !list().contains(value) => wrong(&format!("none of {rule}")),
            "const" if rule != value => wrong(&format!("not {rule}")),
            "minimum" if is(&|number| number < bound()) => wrong("too small"),
            "maximum" if is(&|number| number > bound()) => wrong("too large"),
            "exclusiveMinimum" if is(&|number| number <= bound()) => wrong("too small"),
            "minItems" | "minProperties" if (length(value) as f64) < bound() => wrong("too short"),
            "maxItems" if value.as_array().is_some_and(|items| items.len() as f64 > bound()) => {
                wrong("too long")
            }
            "items" => {
                let misfit = |item| misfit(root, rule, item, &format!("{path}[]"));
                value.as_array().into_iter().flatten().find_map(misfit)
            }
            "required" => {
                let missing = list().iter().find(|key| value.get(key.as_str().unwrap()).is_none());
                missing.and_then(|key| wrong(&format!("{key} is missing")))
            }
            "properties" => rule.as_object().unwrap().iter().find_map(|(key, of)| {
                value.get(key).and_then(|value| misfit(root, of, value, &format!("{path}.{key}")))
            }),
            "additionalProperties" => {
                let known = parts["properties"].as_object().unwrap();
                let mut names = value.as_object().into_iter().flat_map(|table| table.keys());
                let unknown = names.find(|name| !known.contains_key(*name));
                unknown.and_then(|name| wrong(&format!("unknown key {name}")))
            }
            "anyOf" if !list().iter().any(fits) => wrong(&format!("none of {rule}")),
            "allOf" => list().iter().find_map(|part| misfit(root, part, value, path)),
            "if" if fits(rule) => misfit(root, &parts["then"], value, path),
            "pattern" if value.as_str().is_some_and(|text| !is_word(text, rule)) => {
                wrong("no such word")
            }
            "not" if fits(rule) => wrong(&format!("is {rule}")),
            "$schema" | "$defs" | "title" | "description" | "default" | "then" | "pattern" => None,
            "not" | "type" | "enum" | "const" | "minimum" | "maximum" | "exclusiveMinimum"
            | "minItems" | "maxItems" | "minProperties" | "anyOf" | "if" => None,
            other => panic!("this test does not know {other:?}"),
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Whether a text fits one of the two patterns: words, of which that of a file does not begin with a point.
fn is_word(text: &str, pattern: &Value) -> bool {
    let pattern = pattern.as_str().unwrap();
    assert!(["^[A-Za-z0-9_-][A-Za-z0-9._-]*$", "^[A-Za-z0-9._-]+$"].contains(&pattern));
    let fits = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
    let begins = pattern.contains('+') || !text.starts_with('.');
    !text.is_empty() && begins && text.chars().all(fits)
}

fn length(value: &Value) -> usize {
    let array = value.as_array().map(Vec::len);
    array.or(value.as_object().map(|table| table.len())).unwrap_or(usize::MAX)
}

fn definition<'a>(root: &'a Value, reference: &Value) -> &'a Value {
    &root["$defs"][reference.as_str().unwrap().strip_prefix("#/$defs/").unwrap()]
}

fn is_a(value: &Value, kind: &str) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        other => panic!("this test does not know the type {other:?}"),
    }
}

fn parsed(text: &str) -> Value {
    serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            found.push(path);
        }
    }
}

#[test]
fn every_shipped_file_fits() {
    let schema = schema();
    let mut found = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("sweeps"), &mut found);
    assert!(found.len() >= 40, "{found:?}");
    for path in found {
        let file = parsed(&fs::read_to_string(&path).unwrap());
        let path = path.display().to_string();
        let Some(cases) = file.get("case") else {
            assert_eq!(misfit(&schema, &schema, &file, &path), None);
            continue;
        };
        // A matrix: its cases and methods hold sections.
        for part in cases.as_array().into_iter().chain(file["method"].as_array()).flatten() {
            let sections = ["scene", "numerics"].map(|name| (name, part.get(name)));
            let mut alone = json!({ "name": "part" });
            for (name, section) in sections.into_iter().filter(|(_, section)| section.is_some()) {
                alone[name] = section.unwrap().clone();
            }
            assert_eq!(misfit(&schema, &schema, &alone, &path), None);
        }
    }
}

#[test]
fn what_no_key_may_hold_does_not_fit() {
    let schema = schema();
    let bad = [
        "[scene]",
        "name = \"a\"\ncolour = 1",
        "name = \"a\"\n[scene]\nkind = \"lake\"",
        "name = \"a\"\n[scene]\ncolumn_height_m = 1",
        "name = \"a\"\n[scene]\nwave_height_ratio = 0.9",
        "name = \"a\"\n[scene]\nkind = \"dam-break\"\nwave_height_ratio = 0.5",
        "name = \"a\"\n[numerics]\nkernel = \"gauss\"",
        "name = \"a\"\n[numerics]\nparticle_spacing_m = 0",
        "name = \"a\"\n[numerics]\nretries = 1.5",
        "name = \"a\"\n[numerics]\ncorrected_gradients = 1",
        "name = \"a\"\n[accuracy]\nmax_error_percent = 0",
        "name = \"a\"\n[grid]",
        "name = \"a\"\n[grid]\nkernel = []",
        "name = \"a\"\n[grid]\nkernel = [\"gauss\"]",
        "name = \"a\"\n[grid]\nwave_height_ratio = { from = 0.1, to = 0.2 }",
        "name = \"a\"\n[[probe]]\nname = \"P\"",
        // Ranges of words, and beyond what the key may hold, were taken, and a point of three numbers.
        "name = \"a\"\n[grid]\nkernel = { from = 1, to = 2, points = 2 }",
        "name = \"a\"\n[grid]\nbed = { from = 1, to = 2, points = 2 }",
        "name = \"a\"\n[grid]\nwave_height_ratio = { from = 0.1, to = 2, points = 2 }",
        "name = \"a\"\n[scene]\nbed = [[0, 0], [1, 0, 2], [2.5, 0]]",
        "name = \"a b\"",
        // A probe was held to its keys alone.
        "name = \"a\"\n[[probe]]\nname = \"P 1\"\nkind = \"level\"\nx_m = 1",
        "name = \"a\"\n[[probe]]\nname = \"force\"\nkind = \"level\"\nx_m = 1",
        "name = \"a\"\n[[probe]]\nname = \"P\"\nkind = \"level\"\nx_m = -1",
        "name = \"a\"\n[[probe]]\nname = \"P\"\nkind = \"level\"\nx_m = 1\ny_m = 0.1",
        "name = \"a\"\n[[probe]]\nname = \"P\"\nkind = \"pressure\"\nx_m = 1",
        "name = \"a\"\n[[probe]]\nname = \"P\"\nkind = \"pressure\"\nx_m = 1\ny_m = 0.1\ndiameter_m = -1",
    ];
    for text in bad {
        assert!(misfit(&schema, &schema, &parsed(text), "").is_some(), "{text}");
    }
    let good = "name = \"a\"\n[scene]\nkind = \"dam-break\"\ncolumn_height_m = 1\n[numerics]\n\
                retries = 2\n[grid]\nslip = [\"no\"]\nend_time_s = { from = 1, to = 2, points = 3 }\n\
                [[probe]]\nname = \"P.1\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = 0.1\ndiameter_m = 0";
    assert_eq!(misfit(&schema, &schema, &parsed(good), ""), None);
}
