//! Tables: the summary in few columns, the response curves, readings, energies, and the health of every
//! case.

mod energy;
mod loads;
mod page;
mod readings;
mod table;

use super::curves::{RESPONSES, responses, stem, variants};
use super::goda::{OVER_GODA, Settings};
use super::load::Loaded;
use super::plots::{fixed_walls, sides};
use super::row::{PLACE, Row};
use super::variant::file_name;
use crate::quantities::summary::{
    CASE_ID, DISPLACEMENT_ERROR, DISPLACEMENT_MAX, DISPLACEMENT_TRUNCATED, DOUBTFUL,
    DOUBTFUL_REASON, ENERGY_GAP, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, FORCE_COUPLING, FORCE_ERROR,
    FORCE_GAP, FORCE_MAX, FORCE_MAX_ERROR, FORCE_MAX_GAP, LOG10_K_STAR, M_STAR,
    MEASURED_WAVE_HEIGHT_RATIO, PARTICLES, PARTICLES_LOST, REASON, RUNUP_ERROR, RUNUP_MAX,
    RUNUP_MAX_ERROR, SEAWALL_MASS, SPRING_STIFFNESS, STATUS, STEPS, STOP_IMPULSE, STOPS,
    WAVE_HEIGHT_RATIO,
};
use crate::quantities::{Column, Quantity};
pub use readings::across;
pub use table::{Line, Lines, Table};

/// A column of a table: its name, and its text for the row at a place in the summary.
type Field<'a> = (&'static str, Box<dyn Fn(usize, &Row) -> String + 'a>);

/// Columns of the summary, with every digit: numbers are rounded once, for the reader alone.
fn fields<'a>(columns: &[&'static Column]) -> Vec<Field<'a>> {
    let field = |&column: &&'static Column| -> Field<'a> {
        (column.name, Box::new(|_, row| row.cell(column)))
    };
    columns.iter().map(field).collect()
}

/// The column that tells runs of the same wave and wall apart, if these rows need it.
fn variant<'a>(mut rows: impl Iterator<Item = &'a Row>) -> Option<Field<'static>> {
    let is_told = rows.any(|row| !row.variant.is_empty());
    is_told.then(|| -> Field { (VARIANT, Box::new(|_, row| row.variant.to_string())) })
}

/// The force over Goda's at an upright wall; empty at other walls.
fn over_goda(data: &Loaded) -> Field<'_> {
    let settings = Settings::of(data);
    let over = move |place, row: &Row| or_empty(settings.at(place).and_then(|at| at.over(row)));
    (OVER_GODA, Box::new(over))
}

/// A line per row.
fn table<'a>(
    name: &str,
    title: &str,
    fields: Vec<Field<'a>>,
    rows: impl Iterator<Item = (usize, &'a Row)> + 'a,
) -> Lines<'a> {
    let header: Vec<_> = fields.iter().map(|(name, _)| *name).collect();
    let line = move |(place, row)| Ok(fields.iter().map(|(_, cell)| cell(place, row)).collect());
    Lines::new(name, title, &header, rows.map(line))
}

/// Every table that the sweep's files can fill.
pub fn all(data: &Loaded) -> Vec<Lines<'_>> {
    let mut tables = vec![summary(data), health(data)];
    tables.extend(responses_of(data));
    tables.extend(fixed(data));
    tables.extend(loads::loads(data));
    tables.extend(loads::overtopping(data));
    tables.extend(readings::readings(data));
    tables.extend(energy::energy(data));
    tables.extend(readings::envelope(data));
    tables
}

/// The summary in few columns: one row per case, failed ones included.
fn summary(data: &Loaded) -> Lines<'_> {
    let mut columns = fields(&[
        &CASE_ID,
        &STATUS,
        &WAVE_HEIGHT_RATIO,
        &MEASURED_WAVE_HEIGHT_RATIO,
        &SPRING_STIFFNESS,
        &SEAWALL_MASS,
        &LOG10_K_STAR,
        &M_STAR,
        &FIRST_FORCE_MAX,
        &FIRST_RUNUP_MAX,
        &DISPLACEMENT_MAX,
        &DISPLACEMENT_TRUNCATED,
        &STOPS,
        &FORCE_COUPLING,
        &FORCE_ERROR,
        &RUNUP_ERROR,
        &DISPLACEMENT_ERROR,
    ]);
    // Maxima of the whole run, if some case needs them in place of the first impact's.
    if data.finished().any(|row| row.impact(&FIRST_FORCE_MAX) == &FORCE_MAX) {
        columns.extend(fields(&[&FORCE_MAX, &RUNUP_MAX, &FORCE_MAX_ERROR, &RUNUP_MAX_ERROR]));
    }
    columns.extend(fields(&[&DOUBTFUL]));
    columns.extend(variant(data.rows.iter()));
    table("summary", "Cases", columns, data.rows.iter().enumerate())
}

/// What tells a sound case from a doubtful one.
fn health(data: &Loaded) -> Lines<'_> {
    let columns = [
        &[&CASE_ID][..],
        &PLACE,
        &[&FORCE_COUPLING, &FORCE_MAX_GAP, &FORCE_GAP, &ENERGY_GAP, &PARTICLES_LOST],
        &[&PARTICLES, &STEPS, &STOP_IMPULSE, &DOUBTFUL_REASON],
    ];
    let columns = fields(&columns.concat()).into_iter().chain(variant(data.finished()));
    table("health", "Health", columns.collect(), data.placed())
}

/// The first failed cases, and why they failed.
pub fn failed(data: &Loaded, most: usize) -> Lines<'_> {
    let mut columns = fields(&[&[&CASE_ID][..], &PLACE].concat());
    columns.extend(variant(data.failed()));
    columns.extend(fields(&[&REASON]));
    let rows = data.rows.iter().enumerate().filter(|(_, row)| !row.is_ok()).take(most);
    let mut lines = table("", "Failed cases", columns, rows);
    lines.head.left = data.failed().count().saturating_sub(most);
    lines
}

fn responses_of(data: &Loaded) -> Vec<Lines<'_>> {
    let mut tables = Vec::new();
    for variant in variants(&data.rows) {
        for response in RESPONSES {
            let error = |row: &Row| or_empty(row.error(response).filter(|error| error.is_finite()));
            let mut columns = fields(&[&M_STAR, &WAVE_HEIGHT_RATIO, &LOG10_K_STAR, response]);
            columns.push(("error", Box::new(move |_, row| error(row))));
            columns.push(("truncated", Box::new(|_, row| row.is_bound(response).to_string())));
            columns.extend(fields(&[&FORCE_COUPLING, &CASE_ID]));
            let name = file_name(&format!("response-{}", stem(response)), &variant);
            let rows = responses(&data.rows, &variant, response).into_iter().map(|row| (0, row));
            tables.extend(table(&name, "Response curve", columns, rows).filled());
        }
    }
    tables
}

fn fixed(data: &Loaded) -> Vec<Lines<'_>> {
    let of_variant = |variant: String| {
        let wave = [&WAVE_HEIGHT_RATIO, &MEASURED_WAVE_HEIGHT_RATIO];
        let rows: Vec<_> = fixed_walls(data, &variant).collect();
        let [runup, force] = sides(data, &variant);
        let columns = [&wave[..], &[runup, force, &CASE_ID]].concat();
        let columns = fields(&columns).into_iter().chain([over_goda(data)]).collect();
        let name = file_name("fixed-wall", &variant);
        table(&name, "Fixed wall", columns, rows.into_iter()).filled()
    };
    variants(&data.rows).into_iter().filter_map(of_variant).collect()
}

/// The column that tells runs of the same wave and wall apart.
const VARIANT: &str = "variant";

fn names<R>(columns: &[&Quantity<R>]) -> Vec<&'static str> {
    columns.iter().map(|column| column.name).collect()
}

fn cells(row: &Row, columns: &[&Column]) -> Vec<String> {
    columns.iter().map(|column| row.cell(column)).collect()
}

/// A cell whose value may be missing.
pub(super) fn or_empty<T: ToString>(value: Option<T>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{ReportError, fixture};

    fn read(directory: &std::path::Path) -> Result<Vec<Table>, ReportError> {
        all(&Loaded::read(directory)?).into_iter().map(Lines::whole).collect()
    }

    fn named(tables: &[Table], name: &str) -> Table {
        tables.iter().find(|table| table.name == name).unwrap().clone()
    }

    #[test]
    fn tables_of_a_movable_sweep() {
        let tables = read(fixture::sweep().path()).unwrap();
        let names: String = tables.iter().map(|table| format!("{} ", table.name)).collect();
        let responses = "response-force response-runup response-displacement";
        assert_eq!(names, format!("summary health {responses} energy "));
        assert_eq!(named(&tables, "summary").rows.len(), 12);
        assert_eq!(named(&tables, "health").rows.len(), 11, "failed cases have no health");
        let force = named(&tables, "response-force");
        assert_eq!(force.rows.len(), 11);
        assert_eq!(force.rows[0][..2], ["1.25", "0.3"]);
        let energy = named(&tables, "energy");
        assert_eq!(energy.header[..2], ["case_id", "wave_height_ratio"]);
        assert_eq!(energy.header[4..6], ["force_coupling", "paddle_work_j_per_m"]);
        assert!(energy.csv().contains("\ncase-0001,0.3,10,250,1,48.000,"), "{}", energy.csv());
    }

    #[test]
    fn failed_cases_of_other_swept_keys_are_told_apart() {
        let row = |variant: &str| {
            let mut row = Row::default().with(&STATUS, "failed").with(&REASON, "blow-up");
            row.variant = variant.into();
            row
        };
        let rows = vec![row("sound_speed_ratio = 4"), row("sound_speed_ratio = 8")];
        let table = failed(&Loaded { rows, ..Loaded::default() }, 9).whole().unwrap().for_page();
        assert_eq!(table.header, [VARIANT, "reason"]);
        assert_eq!(
            table.rows[1],
            ["sound speed ratio = 8", "blow-up"],
            "in words, as figures tell it"
        );
        let plain = Loaded { rows: vec![row("")], ..Loaded::default() };
        assert_eq!(failed(&plain, 9).whole().unwrap().for_page().header, ["reason"]);
    }

    #[test]
    fn fixed_walls_have_a_table_of_their_own() {
        let tables = read(fixture::fixed().path()).unwrap();
        let table = named(&tables, "fixed-wall");
        assert_eq!(table.rows.len(), 6);
        // F* = 1 + 3.9 H/h + 0.1, for a measured height of 0.985 · 0.3, over Goda's 1.7935.
        let over: f64 = table.rows[2].last().unwrap().parse().unwrap();
        let goda = 1.0 + 1.1 * 0.2955 * (2.0 + 1.5 * 0.2955);
        assert!((over - 2.27 / goda).abs() < 1e-9, "{over}");
        assert!(!tables.iter().any(|table| table.name.starts_with("response")));
    }

    #[test]
    fn every_row_is_as_wide_as_its_header() {
        for table in read(fixture::sweep().path()).unwrap() {
            assert!(table.rows.iter().all(|row| row.len() == table.header.len()), "{}", table.name);
        }
    }
}
