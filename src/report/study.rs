//! What the manifest tells of the study as a whole: what was swept, and how its scene was set.

use serde_json::Value;
use toml::Table;

use super::column::Cells;

/// A swept key and its cell in every row of the summary.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Key {
    /// As it stands in the sweep's grid.
    pub name: String,
    /// One cell per row.
    pub cells: Cells,
}

/// The keys of the grid, in its order.
pub(super) fn keys(manifest: &Value) -> Vec<String> {
    let keys = manifest.get("keys").and_then(Value::as_array);
    keys.into_iter().flatten().filter_map(|key| key.as_str().map(str::to_owned)).collect()
}

/// The sweep file with what the command line set; `None` where the manifest has none that can be
/// read.
pub(super) fn file(manifest: &Value) -> Option<Table> {
    let mut file: Table = manifest.get("sweep_file")?.as_str()?.parse().ok()?;
    let overrides = manifest.get("overrides").and_then(Value::as_array);
    for text in overrides.into_iter().flatten().filter_map(Value::as_str) {
        let (path, value) = text.split_once('=')?;
        let value = literal(value.trim());
        match path.trim().split_once('.') {
            Some((section, key)) => {
                let section = file.entry(section).or_insert_with(|| Table::new().into());
                section.as_table_mut()?.insert(key.to_owned(), value);
            }
            None => {
                file.insert(path.trim().to_owned(), value);
            }
        }
    }
    Some(file)
}

/// A cell or the command line's text as a value: a number or a flag where it reads as one, or else
/// a string.
pub(super) fn literal(text: &str) -> toml::Value {
    let parsed = format!("value = {text}").parse::<Table>().ok().filter(|table| table.len() == 1);
    let value = parsed.and_then(|mut table| table.remove("value"));
    value.unwrap_or_else(|| toml::Value::String(text.to_owned()))
}

/// A number of the scene that all cases share: what the command line set, or else the file.
pub(super) fn scene_number(manifest: &Value, key: &str) -> Option<f64> {
    let file = file(manifest)?;
    let value = file.get("scene")?.get(key)?;
    value.as_float().or_else(|| value.as_integer().map(|value| value as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_command_line_wins_over_the_file() {
        let text = "[scene]\nwall_angle_deg = 120\n[numerics]\nwall_angle_deg = 1";
        let mut manifest = json!({ "sweep_file": text, "overrides": [] });
        assert_eq!(scene_number(&manifest, "wall_angle_deg"), Some(120.0));
        assert_eq!(scene_number(&manifest, "tank_length_m"), None);
        manifest["overrides"] = json!(["scene.wall_angle_deg=60", "scene.wall_angle_deg=75.5"]);
        assert_eq!(scene_number(&manifest, "wall_angle_deg"), Some(75.5));
        manifest["overrides"] = json!(["numerics.boundary=sfdi", "accuracy.max_error_percent=2"]);
        let file = file(&manifest).unwrap();
        assert_eq!(file["numerics"]["boundary"].as_str(), Some("sfdi"));
        assert_eq!(file["accuracy"]["max_error_percent"].as_integer(), Some(2));
        assert_eq!(scene_number(&json!({}), "wall_angle_deg"), None);
    }
}
