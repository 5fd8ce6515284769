//! The largest force, and where it is.

use crate::quantities::Column;
use crate::quantities::summary::{FIRST_FORCE_MAX, FORCE_MAX, FORCE_MAX_ERROR};
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::words::{at, result};
use crate::report::row::Row;
use crate::report::scene_file::SceneFile;

/// A later force is told where it is larger than that of the first impact by more than this share.
const NOTABLE: f64 = 0.02;

/// The largest force of a case: that of the first impact, or of the whole run where it has none, and where
/// waves are regular.
pub fn column(row: &Row) -> &'static Column {
    let has_first = !row.regular && row.number(&FIRST_FORCE_MAX).is_some();
    if has_first { &FIRST_FORCE_MAX } else { &FORCE_MAX }
}

/// The row that has the most of something.
pub fn most<'a>(
    rows: impl Iterator<Item = &'a Row>,
    read: impl Fn(&Row) -> Option<f64>,
) -> Option<(&'a Row, f64)> {
    let values = rows.filter_map(|row| Some((row, read(row)?)));
    values.filter(|(_, value)| value.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The largest force as F* and in kN/m, and the case that has it.
pub fn largest(data: &Loaded, file: Option<&SceneFile>) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(column(row)))?;
    let alone = data.rows.len() == 1;
    let is = if alone { "The largest force is" } else { "The largest force of all is" };
    let (newtons, place) = (newtons(data, file, row, force), at(row));
    let comma = if newtons.is_empty() || place.is_empty() { "" } else { "," };
    let mut text = format!("{is} {}{newtons}{comma}{place}.", result("F*", row, column(row))?);
    if column(row) == &FIRST_FORCE_MAX {
        text.push_str(" It is that of the first impact.");
        text.push_str(&later(data, force).unwrap_or_default());
    }
    Some(text)
}

/// A force of later in a run that is larger still.
fn later(data: &Loaded, first: f64) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(&FORCE_MAX))?;
    if force <= first * (1.0 + NOTABLE) {
        return None;
    }
    let bar = row.number(&FORCE_MAX_ERROR).unwrap_or(0.0);
    Some(format!(" A later one reaches F* = {}{}.", number::with_error(force, bar), at(row)))
}

/// `, that is 0.77 kN per metre of wall`: F* times ½ρgd² of the row's own scene, d being the depth at the
/// wall, or where that stands dry the still water's.
fn newtons(data: &Loaded, file: Option<&SceneFile>, row: &Row, force: f64) -> String {
    let scale = || {
        let index = data.rows.iter().position(|r| r.id() == row.id())?;
        let scene = file?.config(data, index)?.scene;
        let (frame, seawall) = (scene.frame(), scene.seawall());
        let at_wall = seawall.map(|scene| scene.depth_at_wall_m()).filter(|depth| *depth > 0.0);
        let depth = at_wall.unwrap_or(frame.depth);
        Some(0.5 * frame.density * frame.acceleration() * depth * depth)
    };
    let told = |scale: f64| {
        let force = number::significant(force * scale / 1000.0, 3);
        format!(", that is {force} kN per metre of wall")
    };
    scale().map(told).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;
    use crate::report::study::Key;
    use serde_json::json;

    #[test]
    fn a_force_is_told_in_newtons_and_a_later_one_too() {
        let (_directory, mut data) = fixture::read(fixture::movable(&[0.5], &[500.0], &[250.0]));
        let text = "[scene]\nwall = \"movable\"\nstill_water_depth_m = 0.4\n[grid]";
        data.manifest = Some(json!({ "name": "a", "sweep_file": text }));
        let keys = [("spring_stiffness_n_per_m", "500"), ("seawall_mass_kg_per_m", "250")];
        data.keys = keys.map(|(name, cell)| Key::new(name, [cell])).into();
        data.rows[0] = data.rows[0].clone().with(&FIRST_FORCE_MAX, 2.0).with(&FORCE_MAX, 2.5);
        let file = SceneFile::of(&data);
        assert_eq!(
            largest(&data, file.as_ref()).unwrap(),
            "The largest force is F* = 2, that is 1.57 kN per metre of wall, at H/h = 0.5, k = 500 \
             N/m, m = 250 kg/m. It is that of the first impact. A later one reaches F* = 2.5 at \
             H/h = 0.5, k = 500 N/m, m = 250 kg/m."
        );
        // Of regular waves none is the first impact, and the largest of all was the smaller of two.
        let mut train = Loaded { rows: data.rows.clone(), ..Loaded::default() };
        train.rows[0].regular = true;
        let told = largest(&train, None).unwrap();
        assert_eq!(told, "The largest force is F* = 2.5 at H/h = 0.5, k = 500 N/m, m = 250 kg/m.");
        // Over a bed F* counts by the depth at the wall, here half of the paddle's.
        let bed = "[scene]\nbed = [[0, 0], [1, 0], [2, 0.2], [2.5, 0.2]]\n";
        data.manifest = Some(json!({ "name": "a", "sweep_file": text.replace("[scene]\n", bed) }));
        let file = SceneFile::of(&data);
        let told = largest(&data, file.as_ref()).unwrap();
        assert!(told.contains("that is 0.392 kN per metre of wall"), "{told}");
    }
}
