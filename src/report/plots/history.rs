//! Time histories at the wall: force, runup and displacement. With waves, one figure per wave
//! height with a few curves spread over the stiffnesses (or over the masses, where there is one
//! stiffness); without, one figure of a few cases.

use super::look::Look;
use super::marks::said;
use super::over_time::{self, Strip};
use super::{Figure, file_name, of_variant};
use crate::quantities::history::{DISPLACEMENT, FORCE, RUNUP};
use crate::quantities::summary::{SEAWALL_MASS, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};
use crate::report::curves::{distinct, spread, variants};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::row::Row;
use crate::report::series::History;

const CURVES: usize = 6;
/// Wave heights with a figure, of each variant.
const WAVES: usize = 12;

/// One case's history with its words in the legend.
struct Line {
    label: String,
    case: String,
    history: History,
}

/// The figures of every wave height and variant that has histories, and of cases without a wave.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut figures = Vec::new();
    let waves = distinct(data.finished(), &WAVE_HEIGHT_RATIO);
    let digits = number::digits_apart(waves.iter().copied());
    let left_out = left_out(waves.len());
    for variant in variants(&data.rows) {
        for wave in spread(&waves, WAVES) {
            let own = data.of_variant(&variant);
            let rows: Vec<_> =
                own.filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(wave)).collect();
            let (chosen, common, picked) = choose(&rows);
            let lines = read(data, chosen)?;
            if lines.is_empty() {
                continue;
            }
            let wave = number::plain_to(wave, digits);
            let name = file_name(&format!("history-wave-{wave}"), &variant);
            let drop = dropped(lines.len(), rows.len(), "of this wave height", &picked);
            figures.push(Figure {
                drawing: over_time::strips(&strips(&lines)),
                caption: format!(
                    "Force (unfiltered), runup{} at the wall{common}, over the time since the \
                     paddle's start. Spikes of one or two samples may leave the panel.{drop}{left_out}",
                    if moves(&lines) { " and displacement" } else { "" }
                ),
                title: format!("Histories, H/h = {wave}{}", of_variant(&variant)),
                name,
            });
        }
    }
    figures.extend(without_wave(data)?);
    Ok(figures)
}

/// The figure of scenes that have no paddle: a still tank, a dam break, a flow with an exact answer.
fn without_wave(data: &Loaded) -> Result<Option<Figure>, ReportError> {
    let rows: Vec<_> =
        data.finished().filter(|row| row.number(&WAVE_HEIGHT_RATIO).is_none()).collect();
    let chosen = spread(&rows, CURVES).into_iter().map(|row| (row.words(), row)).collect();
    let lines = read(data, chosen)?;
    let mut strips = strips(&lines);
    strips.retain(Strip::holds_anything);
    if strips.is_empty() {
        return Ok(None);
    }
    let drop = dropped(lines.len(), rows.len(), "without a wave", "spread over their order");
    Ok(Some(Figure {
        drawing: over_time::strips(&strips),
        name: "history".to_owned(),
        title: "Histories".to_owned(),
        caption: format!(
            "Force (unfiltered) along x on the right wall and level at it above still water, over \
             time; h is the depth of the still water or the height of the column. Spikes of one or \
             two samples may leave the panel.{drop}"
        ),
    }))
}

/// The end of a caption: which waves have a figure, where not all of them do.
fn left_out(waves: usize) -> String {
    if waves <= WAVES {
        return String::new();
    }
    format!(" Of {waves} wave heights {WAVES} have such a figure, spread evenly.")
}

/// The end of a caption: what was picked, where it is not all there is.
fn dropped(shown: usize, cases: usize, whose: &str, picked: &str) -> String {
    if shown >= cases {
        return String::new();
    }
    format!(" Shown are {shown} of {cases} finished cases {whose}: {picked}.")
}

/// The histories of cases that have more than one sample.
fn read(data: &Loaded, chosen: Vec<(String, &Row)>) -> Result<Vec<Line>, ReportError> {
    let mut lines = Vec::new();
    for (label, row) in chosen {
        let case = row.id().to_owned();
        let history = data.history(&case)?;
        if history.0.iter().any(|series| series.points.len() > 1) {
            lines.push(Line { label, case, history });
        }
    }
    Ok(lines)
}

/// At most [`CURVES`] cases and their labels, what they have in common, and how they were picked.
fn choose<'a>(rows: &[&'a Row]) -> (Vec<(String, &'a Row)>, String, String) {
    let movable = || rows.iter().copied().filter(|row| !row.is_fixed());
    let stiffnesses = distinct(movable(), &SPRING_STIFFNESS);
    let masses = distinct(movable(), &SEAWALL_MASS);
    let middle = masses.get(masses.len().saturating_sub(1) / 2);
    let (varied, held, kept, plural) = if stiffnesses.len() > 1 {
        ((&SPRING_STIFFNESS, &stiffnesses), &SEAWALL_MASS, middle, "stiffnesses")
    } else {
        ((&SEAWALL_MASS, &masses), &SPRING_STIFFNESS, stiffnesses.first(), "masses")
    };
    let mut chosen: Vec<(String, &Row)> = Vec::new();
    let (mut common, mut picked) = (String::new(), String::new());
    if let Some(&kept) = kept {
        let (column, values) = varied;
        common = format!(", {}", said(movable(), held, kept));
        for value in spread(values, CURVES) {
            let is_it =
                |row: &&Row| row.number(column) == Some(value) && row.number(held) == Some(kept);
            chosen.extend(movable().find(is_it).map(|row| (said(movable(), column, value), row)));
        }
        picked = format!("{} of {} {plural}", chosen.len(), values.len());
        if held == &SEAWALL_MASS && masses.len() > 1 {
            picked.push_str(&format!(" at one of {} masses", masses.len()));
        }
    }
    let fixed = rows.iter().copied().find(|row| row.is_fixed());
    if fixed.is_some() && !picked.is_empty() {
        picked.push_str(", and the fixed wall");
    }
    chosen.extend(fixed.map(|row| ("fixed wall".to_owned(), row)));
    (chosen, common, picked)
}

fn moves(lines: &[Line]) -> bool {
    lines.iter().flat_map(|line| line.history.points(DISPLACEMENT.name)).any(|(_, x)| *x != 0.0)
}

fn strips(lines: &[Line]) -> Vec<Strip> {
    let all = [&FORCE, &RUNUP, &DISPLACEMENT];
    let drawn = if moves(lines) { &all[..] } else { &all[..2] };
    let curve = |(index, line): (usize, &Line), name: &str| {
        let mut curve = over_time::Line::new(
            index,
            &line.label,
            &line.case,
            line.history.points(name).to_vec(),
        );
        // More curves than that have no look of their own: the fixed wall is drawn in ink.
        if index >= CURVES {
            curve.entry.look = Look::plain();
        }
        curve
    };
    let strip = |name: &str, title: &str| Strip {
        heading: String::new(),
        title: title.to_owned(),
        name: name.to_owned(),
        curves: lines.iter().enumerate().map(|line| curve(line, name)).collect(),
        peaks: false,
    };
    drawn.iter().map(|column| strip(column.name, column.unit.axis())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn drawn(directory: &tempfile::TempDir) -> Vec<Figure> {
        figures(&Loaded::read(directory.path()).unwrap()).unwrap()
    }

    #[test]
    fn the_caption_says_what_was_picked_out_of_what() {
        let stiffnesses: Vec<f64> = (0..9).map(|power| 10_f64.powi(power)).collect();
        let figures = drawn(&fixture::movable(&[0.3, 0.5], &stiffnesses, &[50.0, 100.0, 250.0]));
        let told = "Shown are 6 of 27 finished cases of this wave height: 6 of 9 stiffnesses at \
                    one of 3 masses.";
        assert!(figures[0].caption.ends_with(told), "{}", figures[0].caption);
        let few = drawn(&fixture::movable(&[0.5], &[10.0, 500.0], &[250.0]));
        assert!(!few[0].caption.contains("Shown"), "{}", few[0].caption);
    }

    #[test]
    fn scenes_without_a_wave_have_one_figure() {
        let figures = drawn(&fixture::dam_breaks(1));
        assert_eq!(figures.len(), 1);
        assert_eq!(figures[0].name, "history");
        assert!(figures[0].svg().contains("F / (½ρgh²)") && figures[0].svg().contains("R / h"));
        assert!(!figures[0].caption.contains("Shown"), "{}", figures[0].caption);
        let many = drawn(&fixture::dam_breaks(9));
        let told = "Shown are 6 of 9 finished cases without a wave: spread over their order.";
        assert!(many[0].caption.ends_with(told), "{}", many[0].caption);
        assert!(many[0].svg().contains("column_height_m = 0.6"), "a legend tells them apart");
    }

    #[test]
    fn a_quantity_that_is_naught_throughout_has_no_panel() {
        let directory = fixture::dam_breaks(1);
        let history = "time_s,force,runup,displacement\n0,1,0,0\n1,1.1,0,0\n";
        std::fs::write(directory.path().join("histories/case-0000.csv"), history).unwrap();
        let figures = drawn(&directory);
        assert!(figures[0].svg().contains("F / (½ρgh²)") && !figures[0].svg().contains("R / h"));
    }
}
