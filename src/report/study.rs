//! What the manifest tells of the study as a whole: what was swept, and how its scene was set.

use serde_json::Value;

/// A swept key and its cell in every row of the summary.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Key {
    /// As it stands in the sweep's grid.
    pub name: String,
    /// One cell per row.
    pub cells: Vec<String>,
}

/// The keys of the grid, in its order.
pub(super) fn keys(manifest: &Value) -> Vec<String> {
    let keys = manifest.get("keys").and_then(Value::as_array);
    keys.into_iter().flatten().filter_map(|key| key.as_str().map(str::to_owned)).collect()
}

/// A number of the scene that all cases share: what the command line set, or else the file.
pub(super) fn scene_number(manifest: &Value, key: &str) -> Option<f64> {
    let overrides = manifest.get("overrides").and_then(Value::as_array);
    let set = |text: &Value| {
        let (path, value) = text.as_str()?.split_once('=')?;
        if path.trim() == format!("scene.{key}") { value.trim().parse().ok() } else { None }
    };
    let last = overrides.into_iter().flatten().filter_map(set).next_back();
    last.or_else(|| {
        let file: toml::Table = manifest.get("sweep_file")?.as_str()?.parse().ok()?;
        let value = file.get("scene")?.get(key)?;
        value.as_float().or_else(|| value.as_integer().map(|value| value as f64))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_command_line_wins_over_the_file() {
        let file = "[scene]\nwall_angle_deg = 120\n[numerics]\nwall_angle_deg = 1";
        let mut manifest = json!({ "sweep_file": file, "overrides": [] });
        assert_eq!(scene_number(&manifest, "wall_angle_deg"), Some(120.0));
        assert_eq!(scene_number(&manifest, "tank_length_m"), None);
        manifest["overrides"] = json!(["scene.wall_angle_deg=60", "scene.wall_angle_deg=75.5"]);
        assert_eq!(scene_number(&manifest, "wall_angle_deg"), Some(75.5));
        assert_eq!(scene_number(&json!({}), "wall_angle_deg"), None);
    }
}
