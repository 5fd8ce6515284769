//! The boundaries of a condition along every swept key.

use super::boundary::Boundary;
use super::condition::Condition;
use super::line::{Line, lines};
use crate::math::scale::Scale;
use crate::report::load::Loaded;
use crate::report::study::Key;

/// The boundaries along every swept key of numbers.
pub fn boundaries(condition: &Condition, data: &Loaded) -> Vec<Boundary> {
    if condition.picks_points(data) {
        return Vec::new();
    }
    let of_key = |key: usize| {
        let axis = &data.keys[key];
        if condition.equal().any(|one| one.name == axis.name) {
            return Vec::new();
        }
        let Some(scale) = scale(axis, data) else { return Vec::new() };
        let lines = lines(key, scale, data);
        lines.iter().flat_map(|stops| Line { condition, data, key, scale, stops }.all()).collect()
    };
    (0..data.keys.len()).flat_map(of_key).collect()
}

/// How an axis is spread: as the sweep file says, or else by its values; `None` where it is none of
/// numbers, or none at all.
fn scale(key: &Key, data: &Loaded) -> Option<Scale> {
    let numbers = || key.cells.iter().filter(|cell| !cell.is_empty());
    let values: Vec<f64> = numbers().map(|cell| cell.parse()).collect::<Result<_, _>>().ok()?;
    if values.iter().all(|value| *value == values[0]) {
        return None;
    }
    let written = || {
        let grid = data.file()?.grid;
        let axis = grid.get(&key.name)?.as_table()?;
        let spacing = axis.get("spacing").and_then(toml::Value::as_str);
        Some(if spacing == Some("log") { Scale::Log } else { Scale::Linear })
    };
    Some(written().unwrap_or_else(|| Scale::of(values.into_iter())))
}
