//! How large the error bars are.

use super::force::most;
use crate::math::lists::median;
use crate::math::words::listed;
use crate::quantities::Column;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FIRST_FORCE_MAX, FIRST_MOMENT_MAX, FIRST_RUNUP_MAX, OVERTOPPING_VOLUME,
    WAVE_HEIGHT_RATIO,
};
use crate::report::load::Loaded;
use crate::report::number::significant;
use crate::report::page::words::{at, percent};
use crate::report::row::Row;

/// A number with a bar: its symbol, its column, and whether the bar is in percent. Bars of runups
/// are in depths, as still water has no runup. V is the volume over a crest.
type Number = (&'static str, &'static Column, bool);

const NUMBERS: [Number; 5] = [
    ("F*", &FIRST_FORCE_MAX, true),
    ("R*", &FIRST_RUNUP_MAX, false),
    ("X*", &DISPLACEMENT_MAX, true),
    ("M*", &FIRST_MOMENT_MAX, true),
    ("V", &OVERTOPPING_VOLUME, true),
];

/// The median bar and the widest bar of each number, or that there are none.
pub fn bars(data: &Loaded) -> Option<String> {
    let finished = data.finished().count();
    if finished == 0 {
        return None;
    }
    let told: Vec<_> = NUMBERS.iter().filter_map(|number| bar(data, number)).collect();
    if told.is_empty() && asked(data) {
        let why = if of_walls(data) {
            "a companion with coarser particles could not run, or failed"
        } else {
            "only scenes of seawalls have them"
        };
        return Some(format!("Error bars were asked for, and no case has one: {why}."));
    }
    if told.is_empty() {
        let how = "error_bars = \"pair\" in [numerics] estimates how far each number may be off";
        return Some(format!("No error bars were asked for: {how}."));
    }
    let with = |row: &&Row| row.error(row.impact(&FIRST_FORCE_MAX)).is_some();
    let with = data.finished().filter(with).count();
    let without = match finished - with {
        0 => String::new(),
        1 => " 1 case has no bar of F*.".to_owned(),
        cases => format!(" {cases} cases have no bar of F*."),
    };
    Some(format!("Error bars, in the median and at worst: {}.{without}", listed(&told)))
}

/// Whether the study's file asks for error bars.
fn asked(data: &Loaded) -> bool {
    let Some(file) = &data.file else { return false };
    let name = "error_bars";
    let own = file.numerics.get(name).and_then(toml::Value::as_str);
    file.aims || file.grid.contains_key(name) || own.is_some_and(|bars| bars != "none")
}

/// Whether the study's scenes are seawalls, as far as its file says.
fn of_walls(data: &Loaded) -> bool {
    let kind = data.file.as_ref().and_then(|file| file.kind());
    kind.is_none_or(|kind| kind == "seawall")
}

fn bar(data: &Loaded, number: &Number) -> Option<String> {
    let &(symbol, column, relative) = number;
    let read = |row: &Row| {
        let column = row.impact(column);
        let (bar, value) = (row.error(column)?, row.number(column)?);
        // Still water hardly moves a wall: a share of such a movement says nothing.
        let still = row.number(&WAVE_HEIGHT_RATIO) == Some(0.0);
        let bar = match relative {
            true if still => return None,
            true => bar / value,
            false => bar,
        };
        bar.is_finite().then_some(bar.abs())
    };
    let bars: Vec<_> = data.finished().filter_map(read).collect();
    let words = |bar: f64| {
        if relative { percent(bar) } else { format!("{} h", significant(bar, 2)) }
    };
    let (worst, widest) = most(data.finished(), read)?;
    let middle = words(median(&bars)?);
    if data.rows.len() == 1 {
        return Some(format!("{symbol} ± {middle}"));
    }
    Some(format!(
        "{symbol} ± {middle}, ± {} ({})",
        words(widest),
        at(worst).trim_start_matches(" at ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{
        DISPLACEMENT_ERROR, FORCE_ERROR, FORCE_MAX, FORCE_MAX_ERROR, OVERTOPPING_VOLUME_ERROR,
        RUNUP_ERROR, RUNUP_MAX, RUNUP_MAX_ERROR,
    };
    use crate::report::fixture;

    #[test]
    fn bars_that_nobody_could_make_were_asked_for_all_the_same() {
        let (_directory, data) = fixture::read(fixture::movable(&[0.3, 0.5], &[10.0], &[50.0]));
        let told = |numerics: &str| {
            let file = format!("name = \"a\"\n[numerics]\n{numerics}\n[grid]");
            super::bars(&data.clone().made_from(&file, &[])).unwrap()
        };
        for numerics in ["", "error_bars = \"none\""] {
            assert!(told(numerics).starts_with("No error bars were asked for"), "{numerics}");
        }
        let pair = told("error_bars = \"pair\"");
        assert!(
            pair.starts_with("Error bars were asked for, and no case has one: a comp"),
            "{pair}"
        );
        let column = told("error_bars = \"pair\"\n[scene]\nkind = \"dam-break\"");
        assert!(
            column.ends_with("no case has one: only scenes of seawalls have them."),
            "{column}"
        );
    }

    /// The story: waves without a first impact, and wave trains, had bars in the terminal's table.
    /// The page said that no case had one.
    #[test]
    fn bars_of_the_whole_run_are_told_where_there_is_no_first_impact() {
        let (_directory, mut data) = fixture::read(fixture::fixed());
        data.rows.truncate(2);
        data.set_all(&FIRST_FORCE_MAX, "").set_all(&FIRST_RUNUP_MAX, "");
        data.set_all(&FORCE_MAX, 1.1).set_all(&RUNUP_MAX, 0.05);
        data.set_all(&FORCE_MAX_ERROR, 0.011).set_all(&RUNUP_MAX_ERROR, 0.004);
        let told = super::bars(&data).unwrap();
        assert!(told.contains("F* ± 1 %") && told.contains("R* ± 0.004 h"), "{told}");
        assert!(!told.contains("no bar"), "{told}");
        data.rows[0].regular = true;
        data.rows[0].set(&FIRST_FORCE_MAX, 1.2).set(&FORCE_ERROR, 0.5);
        assert_eq!(super::bars(&data).unwrap(), told, "of regular waves the whole run counts");
    }

    /// The story: volumes over a crest had bars in the table, and none among the errors. Where no
    /// water goes over, a bar has no share.
    #[test]
    fn bars_of_volumes_are_told() {
        let (_directory, mut data) = fixture::read(fixture::fixed());
        data.rows.truncate(3);
        for (row, volume) in data.rows.iter_mut().zip([0.0, 0.002, 0.01]) {
            row.set(&OVERTOPPING_VOLUME, volume).set(&OVERTOPPING_VOLUME_ERROR, 0.0005);
        }
        let told = super::bars(&data).unwrap();
        assert!(told.contains("V ± 15 %, ± 25 % (H/h = 0.2)"), "{told}");
    }

    /// The story: for a soft wall in still water the bar of X* was "± 2700 %".
    #[test]
    fn still_water_has_no_share() {
        let (_directory, mut data) = fixture::read(fixture::movable(&[0.0, 0.5], &[10.0], &[50.0]));
        for (row, moved) in data.rows.iter_mut().zip([2e-4, 2.0]) {
            row.set(&DISPLACEMENT_MAX, moved).set(&DISPLACEMENT_ERROR, 0.005);
        }
        let told = super::bars(&data).unwrap();
        assert!(told.contains("X* ± 0.25 %, ± 0.25 % (H/h = 0.5"), "{told}");
    }

    #[test]
    fn the_middle_and_the_worst_bar_are_told() {
        let (_directory, mut data) = fixture::read(fixture::movable(&[0.3, 0.5], &[10.0], &[50.0]));
        data.rows.push(data.rows[0].clone());
        let bars = [0.01, 0.05];
        for (row, bar) in data.rows.iter_mut().zip(bars) {
            row.set(&FIRST_FORCE_MAX, 2).set(&FORCE_ERROR, bar).set(&RUNUP_ERROR, bar);
        }
        assert_eq!(
            super::bars(&data).unwrap(),
            "Error bars, in the median and at worst: F* ± 1.5 %, ± 2.5 % (H/h = 0.5, k = 10 N/m, \
             m = 50 kg/m) and R* ± 0.03 h, ± 0.05 h (H/h = 0.5, k = 10 N/m, m = 50 kg/m). 1 case \
             has no bar of F*."
        );
    }
}
