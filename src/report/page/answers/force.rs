//! The largest force, and the case that has it.

use crate::quantities::Column;
use crate::quantities::summary::{FIRST_FORCE_MAX, FORCE_MAX, FORCE_MAX_ERROR};
use crate::report::load::Loaded;
use crate::report::newtons::differ;
use crate::report::number;
use crate::report::page::words::{at, doubt, result};
use crate::report::row::Row;
use crate::scene::Scene;

/// A later force is mentioned if it is larger than the first impact's by more than this share.
const NOTABLE: f64 = 0.02;

/// The column with the largest force of a case.
pub fn column(row: &Row) -> &'static Column {
    row.impact(&FIRST_FORCE_MAX)
}

/// The row with the largest of these values.
pub fn most<'a>(
    rows: impl Iterator<Item = &'a Row>,
    read: impl Fn(&Row) -> Option<f64>,
) -> Option<(&'a Row, f64)> {
    let values = rows.filter_map(|row| Some((row, read(row)?)));
    values.filter(|(_, value)| value.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The largest force as F* and in kN/m, and the case that has it.
pub fn largest(data: &Loaded) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(column(row)))?;
    if force == 0.0 && data.finished().all(Row::stands_dry) {
        return Some("No water presses on the wall, which stands dry.".to_owned());
    }
    let alone = data.rows.len() == 1;
    let other = other_in_newtons(data, row, force);
    let is = match &other {
        _ if alone => "The largest force is",
        Some(_) => "Over ½ρgh² the largest force is",
        None => "The largest force of all is",
    };
    let told = |(row, force): (&Row, f64)| {
        let (newtons, place) = (newtons(data, row, force), at(row));
        let comma = if newtons.is_empty() || place.is_empty() { "" } else { "," };
        Some(format!("{}{newtons}{comma}{place}.", result("F*", row, column(row))?))
    };
    let mut text = format!("{is} {}", told((row, force))?);
    if let Some(depth) = depth_at_wall(data, row) {
        let depth = number::significant(depth, 4);
        text.push_str(&format!(" Over this bed h of F* is the depth at the wall, {depth} m."));
    }
    if column(row) == &FIRST_FORCE_MAX {
        text.push_str(" It is that of the first impact.");
        text.push_str(&later(data, force).unwrap_or_default());
    }
    text.push_str(&doubt(row, data.rows.len()));
    // This comes last, as everything before it is about the other case.
    if let Some(other) = other.and_then(told) {
        text.push_str(&format!(" In newtons it is {other}"));
    }
    Some(text)
}

/// A later force in the run that is even larger.
fn later(data: &Loaded, first: f64) -> Option<String> {
    let (row, force) = most(data.finished(), |row| row.number(&FORCE_MAX))?;
    if force <= first * (1.0 + NOTABLE) {
        return None;
    }
    let bar = row.number(&FORCE_MAX_ERROR).unwrap_or(0.0);
    Some(format!(" A later one reaches F* = {}{}.", number::with_error(force, bar), at(row)))
}

/// The scene of a row.
pub fn scene(data: &Loaded, row: &Row) -> Option<Scene> {
    let index = data.rows.iter().position(|one| one.id() == row.id())?;
    Some(data.case(index)?.scene)
}

/// The depth that scales the F* of a row, m, if it is not the still water's at the paddle.
fn depth_at_wall(data: &Loaded, row: &Row) -> Option<f64> {
    let scene = scene(data, row)?;
    let depth = scene.force_depth_m();
    (depth != scene.frame().depth).then_some(depth)
}

/// The case with the largest force in newtons, and its F*, if it is not the case of the largest F*.
fn other_in_newtons<'a>(data: &'a Loaded, row: &Row, force: f64) -> Option<(&'a Row, f64)> {
    if !differ(data) {
        return None;
    }
    let of = |(index, row): (usize, &'a Row)| {
        let force = row.number(column(row)).filter(|force| row.is_ok() && force.is_finite())?;
        Some((row, force, force * data.case(index)?.scene.force_unit_n_per_m()))
    };
    let all: Vec<_> = data.rows.iter().enumerate().filter_map(of).collect();
    let own = all.iter().find(|it| it.0.id() == row.id())?.2;
    let most = all.into_iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
    (most.2 > own && most.1 < force).then_some((most.0, most.1))
}

/// `, that is 0.77 kN per metre of wall`.
fn newtons(data: &Loaded, row: &Row, force: f64) -> String {
    let told = |scene: Scene| {
        let force = number::significant(force * scene.force_unit_n_per_m() / 1000.0, 3);
        format!(", that is {force} kN per metre of wall")
    };
    scene(data, row).map(told).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::DOUBTFUL;
    use crate::report::fixture;
    use crate::report::study::Key;

    #[test]
    fn a_force_is_told_in_newtons_and_a_later_one_too() {
        let (_directory, mut data) = fixture::read(fixture::movable(&[0.5], &[500.0], &[250.0]));
        let text = "[scene]\nwall = \"movable\"\nstill_water_depth_m = 0.4\n[grid]";
        data = data.made_from(text, &[]);
        let keys = [("spring_stiffness_n_per_m", "500"), ("seawall_mass_kg_per_m", "250")];
        data.keys = keys.map(|(name, cell)| Key::new(name, [cell])).into();
        data.rows[0].set(&FIRST_FORCE_MAX, 2.0).set(&FORCE_MAX, 2.5);
        assert_eq!(
            largest(&data).unwrap(),
            "The largest force is F* = 2, that is 1.57 kN per metre of wall, at H/h = 0.5, k = 500 \
             N/m, m = 250 kg/m. It is that of the first impact. A later one reaches F* = 2.5 at \
             H/h = 0.5, k = 500 N/m, m = 250 kg/m."
        );
        // Regular waves have no first impact. The smaller of two forces was called the largest.
        let mut train = Loaded { rows: data.rows.clone(), ..Loaded::default() };
        train.rows[0].regular = true;
        let told = largest(&train).unwrap();
        assert_eq!(told, "The largest force is F* = 2.5 at H/h = 0.5, k = 500 N/m, m = 250 kg/m.");
        // Over a bed the depth at the wall scales F*. Here it is half of the paddle's.
        let bed = "[scene]\nbed = [[0, 0], [1, 0], [2, 0.2], [2.5, 0.2]]\n";
        data = data.made_from(&text.replace("[scene]\n", bed), &[]);
        let told = largest(&data).unwrap();
        assert!(told.contains("that is 0.392 kN per metre of wall"), "{told}");
        assert!(told.contains(" h of F* is the depth at the wall, 0.2 m. It is that of"), "{told}");
    }

    #[test]
    fn where_depths_differ_the_largest_force_in_newtons_is_told_too() {
        let (_directory, mut data) =
            fixture::read(fixture::movable(&[0.5, 0.6], &[500.0], &[250.0]));
        let text = "[scene]\nwall = \"movable\"\n[grid]";
        data = data.made_from(text, &[]);
        let keys = [("spring_stiffness_n_per_m", "500"), ("seawall_mass_kg_per_m", "250")];
        data.keys = keys.map(|(name, cell)| Key::new(name, [cell, cell])).into();
        data.rows[0].set(&FIRST_FORCE_MAX, 2.0).set(&FORCE_MAX, 2.0);
        data.rows[1].set(&FIRST_FORCE_MAX, 3.0).set(&FORCE_MAX, 3.0);
        let told = largest(&data).unwrap();
        assert!(told.starts_with("The largest force of all is F* = 3, that is 0.589 kN"), "{told}");
        data.rows[1].set(&DOUBTFUL, "true");
        let told = largest(&data).unwrap();
        assert!(told.ends_with(" The result is doubtful: look at its history first."), "{told}");
        data.keys.push(Key::new("still_water_depth_m", ["0.4", "0.2"]));
        let told = largest(&data).unwrap();
        assert!(
            told.starts_with("Over ½ρgh² the largest force is F* = 3, that is 0.589"),
            "{told}"
        );
        assert!(
            told.contains(" In newtons it is F* = 2, that is 1.57 kN per metre of wall,"),
            "{told}"
        );
        // The level bed has the most newtons. It was said to have its own depth at the wall.
        data.keys.pop();
        let slope = "[[0, 0], [1, 0], [2, 0.1], [2.5, 0.1]]";
        data.keys.push(Key::new("bed", ["[[0, 0], [2.5, 0]]", slope]));
        let told = largest(&data).unwrap();
        let [first, newtons] = told.split(" In newtons it is ").collect::<Vec<_>>()[..] else {
            panic!("{told}")
        };
        assert!(first.contains("Over this bed h of F* is the depth at the wall, 0.1 m."), "{told}");
        assert!(newtons.starts_with("F* = 2,") && !newtons.contains("Over this bed"), "{told}");
    }
}
