//! Printed and computed numbers in tables: a line for each, and with the factors s side by side.

use super::Found;
use crate::math::lists::rising;
use crate::math::name::name_of;
use crate::papers::{Printed, Read, paper};
use crate::quantities::summary::{
    BOUNDARY, CASE_ID, FORCE_COUPLING, LOG10_K_STAR, SCHEME, SEAWALL_MASS, SPRING_STIFFNESS,
    WAVE_HEIGHT_RATIO,
};
use crate::quantities::{Column, Unit, history, named};
use crate::report::config::Config;
use crate::report::number;
use crate::report::row::{PLACE, Row};
use crate::report::spoken::spoken;
use crate::report::tables::{Table, or_empty};

/// The table `papers`.
pub fn tidy(found: &[Found]) -> Table {
    let header = [
        "paper",
        "figure",
        "quantity",
        WAVE_HEIGHT_RATIO.name,
        SPRING_STIFFNESS.name,
        SEAWALL_MASS.name,
        LOG10_K_STAR.name,
        "time_s",
        "unit",
        "printed",
        "read",
        "computed",
        "error",
        "bound",
        "difference",
        "difference_percent",
        "met",
        FORCE_COUPLING.name,
        SCHEME.name,
        "variant",
        CASE_ID.name,
        "note",
    ];
    let row = |found: &Found| {
        let (printed, row) = (found.printed, found.row);
        let of_many = printed.log10_k_star.is_some();
        let place = PLACE.map(|column| row.cell(column));
        let stiffness = printed.log10_k_star.or(row.number(&LOG10_K_STAR).filter(|_| !of_many));
        [
            vec![printed.paper.clone(), printed.figure.clone(), printed.quantity.clone()],
            place.to_vec(),
            vec![or_empty(stiffness), or_empty(printed.time_s), printed.unit.clone()],
            vec![printed.value.to_string(), name_of(printed.read), digits(found.computed)],
            vec![or_empty(found.error), found.bound.to_string(), digits(found.difference())],
            vec![found.percent().map(digits).unwrap_or_default(), found.is_met().to_string()],
            vec![or_empty(found.coupling()), row.text(&SCHEME).to_owned(), row.variant.to_string()],
            vec![row.id().to_owned(), printed.note.clone()],
        ]
        .concat()
    };
    Table::new("papers", "The papers", &header, found.iter().map(row).collect())
}

/// Six digits: computed values are no more precise.
fn digits(value: f64) -> String {
    number::significant(value, 6).to_string()
}

/// The page's table: one line per number and case, with the study's factors s side by side.
pub fn beside(found: &[Found]) -> Table {
    let factors = couplings(found);
    let heads: Vec<String> = match factors.len() {
        0 => vec![String::new()],
        _ => factors.iter().map(|s| format!(", s = {}", number::as_typed(*s))).collect(),
    };
    let mut header = ["source", "quantity", "case", "printed"].map(str::to_owned).to_vec();
    header.extend(heads.iter().flat_map(|s| [format!("computed{s}"), format!("difference{s}")]));
    let mut lines: Vec<(String, Vec<String>)> = Vec::new();
    for one in found {
        let key = format!("{:p} {}", one.printed, besides_coupling(one));
        let at = lines.iter().position(|(other, _)| *other == key).unwrap_or_else(|| {
            let first = [source(one.printed), words(one.printed), place(one), printed(one.printed)];
            let empty = vec![String::new(); 2 * heads.len()];
            lines.push((key, [first.to_vec(), empty].concat()));
            lines.len() - 1
        });
        let factor = one.coupling().and_then(|s| factors.iter().position(|factor| *factor == s));
        let column = 4 + 2 * factor.unwrap_or(0);
        lines[at].1[column] = computed(one);
        lines[at].1[column + 1] = difference(one);
    }
    let rows = lines.into_iter().map(|(_, cells)| cells).collect();
    Table::new("papers", "The papers", &header, rows)
}

/// The factors s among the movable walls, the law as printed first.
pub(super) fn couplings(found: &[Found]) -> Vec<f64> {
    let mut factors = rising(found.iter().filter_map(Found::coupling));
    factors.reverse();
    factors
}

/// All values of a case but its factor s: runs that differ only in s belong together.
fn besides_coupling(found: &Found) -> String {
    let Config { scene, numerics } = found.config;
    let mut scene = scene.clone();
    scene.remove(FORCE_COUPLING.name);
    if found.printed.log10_k_star.is_some() {
        // A number for many cases: the worst case may be another one.
        PLACE.iter().for_each(|column| drop(scene.remove(column.name)));
    }
    format!("{scene} {numerics}")
}

/// `Liang, Fig. 12`.
fn source(printed: &Printed) -> String {
    let words = paper(&printed.paper).map_or(printed.paper.as_str(), |paper| paper.words.as_str());
    let name = words.split(' ').next().unwrap_or(words);
    format!("{name}, Fig. {}", printed.figure)
}

/// What a number is, in a few words: `first F*`, `t of first F*`, `X* at 4 s`.
pub(super) fn words(printed: &Printed) -> String {
    let name = printed.quantity.as_str();
    let time = printed.time_s.map(|time| format!(" at {time} s")).unwrap_or_default();
    if let Some(maximum) = name.strip_suffix("_time_s").and_then(named) {
        return format!("t of {}", maximum.symbol);
    }
    if let Some(column) = named(name) {
        return column.symbol.to_owned();
    }
    if let Some(column) = history::ALL.iter().find(|column| column.name == name) {
        return format!("{}{time}", symbol_of(column.unit));
    }
    let limit = printed.log10_k_star.map(number::as_typed).unwrap_or_default();
    let symbol = |column: &Column| column.symbol.to_owned();
    if let Some((stem, side)) = name.split_once("_change_") {
        let stem = named(&format!("{stem}_max")).map_or_else(|| stem.to_owned(), symbol);
        return format!("change of {stem} {side} log₁₀ k* = {limit}");
    }
    if name == "displacement_above" {
        return format!("X* max above log₁₀ k* = {limit}");
    }
    let plain = name.trim_end_matches("_position_m").replace('_', " ");
    format!("{plain}{time}")
}

fn symbol_of(unit: Unit) -> &'static str {
    match unit {
        Unit::Force => "F*",
        Unit::Runup => "R*",
        Unit::Displacement => "X*",
        other => other.symbol(),
    }
}

/// The case, or the worst of many.
fn place(found: &Found) -> String {
    let row = found.row;
    let mut parts = row.place_in_words();
    let told = [&BOUNDARY];
    let tells_boundary = found.printed.timed_boundary().is_some();
    parts.extend(others(row, if tells_boundary { &told } else { &[] }));
    parts.join(", ")
}

/// What else tells a case apart, but for its factor s and the columns in `told`: `still water depth
/// = 0.2 m`.
pub fn others(row: &Row, told: &[&Column]) -> Vec<String> {
    let part = |part: &str| {
        let (name, _) = part.split_once(" = ")?;
        let told = name == FORCE_COUPLING.name || told.iter().any(|column| column.name == name);
        (!told).then(|| spoken(part))
    };
    row.variant.split(", ").filter_map(part).collect()
}

fn printed(printed: &Printed) -> String {
    let mark = match printed.read {
        Read::About => "≈ ",
        Read::AtLeast => "≥ ",
        _ => "",
    };
    format!("{mark}{} {}", printed.value, unit(printed)).trim_end().to_owned()
}

/// The unit, unless the quantity's symbol implies it.
fn unit(printed: &Printed) -> &str {
    if matches!(printed.unit.as_str(), "h" | "½ρgh²") { "" } else { &printed.unit }
}

fn computed(found: &Found) -> String {
    let value = match found.error {
        Some(error) => number::with_error(found.computed, error),
        None => number::significant(found.computed, 4).to_string(),
    };
    let bound = if found.bound { "≥ " } else { "" };
    format!("{bound}{value} {}", unit(found.printed)).trim_end().to_owned()
}

fn difference(found: &Found) -> String {
    let met = if found.is_met() { "" } else { " ✗" };
    let in_units = matches!(found.printed.unit.as_str(), "s" | "%" | "√(H/g)");
    let text = match found.percent().filter(|_| !in_units) {
        Some(percent) => format!("{percent:+.1} %"),
        None => format!("{:+} {}", number::significant(found.difference(), 2), unit(found.printed)),
    };
    format!("{}{met}", text.trim_end().replace('-', "\u{2212}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_is_told_in_words() {
        let variant = "boundary = sfdi, still_water_depth_m = 0.2, force_coupling = 1";
        let mut row = Row::default();
        row.variant = variant.into();
        assert_eq!(others(&row, &[]), ["boundary = sfdi", "still water depth = 0.2 m"]);
        assert_eq!(others(&row, &[&BOUNDARY]), ["still water depth = 0.2 m"]);
    }
}
