//! `seawall show`: one case of a finished study, from its files.

mod groups;

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Map, Value, json};

use self::groups::groups;
use super::failure::BadInput;
use super::output::{Output, json_paths, with_bar, wrapped};
use super::picked_case::{Choice, in_every_case, the_case, the_one};
use super::{SUCCESS, stored};
use crate::disk::names::{CASE_FOLDERS, FILM_FILES, FILMS, VTK};
use crate::keys;
use crate::math::words::counted;
use crate::quantities::summary::{CASE_ID, STATUS, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, named};
use crate::report::load::Loaded;
use crate::report::study::Key;
use crate::report::{Row, as_typed, scene_values, spoken, wall_of};
use crate::results::finished;

/// Show one case of a finished study: its parameters, results, error bars, health and files.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall show results/runs/two_waves wave_height_ratio=0.5 spring_stiffness_n_per_m=10
  seawall show results/runs/two_waves 0123
  seawall show results/runs/two_waves 0123 --toml > case.toml && seawall run case.toml")]
pub(super) struct ShowArgs {
    /// The output directory of a sweep or a run.
    dir: PathBuf,
    /// Which case: its id or the start of it, or as many values of swept keys as single it out.
    #[arg(value_name = "CASE")]
    case: Vec<String>,
    /// Print the case as a scene file, for `seawall run`.
    #[arg(long)]
    toml: bool,
}

pub(super) fn main(args: &ShowArgs, output: &Output) -> anyhow::Result<u8> {
    if args.toml {
        let (file, study) = stored::file_and_study(&args.dir)?;
        let text = file.single(the_case(&study, &args.case)?);
        let text = text.map_err(|error| BadInput::of_stored(&args.dir, &error))?;
        output.result(&text, &json!({ "toml": text }))?;
        return Ok(SUCCESS);
    }
    stored::demand_summary(&args.dir)?;
    let data = Loaded::read(&args.dir).map_err(|error| BadInput(error.to_string()))?;
    let keys: Vec<_> = data.keys.iter().map(|key| key.name.clone()).collect();
    let choices: Vec<_> = (0..data.rows.len()).map(|place| choice(&data, place)).collect();
    let fixed = |key: &str| in_every_case(&stored::file_and_study(&args.dir).ok()?.1, key);
    let place = the_one(&keys, &fixed, &choices, &args.case);
    let left = data.left() > 0;
    let place = place.map_err(|error| if left { unfinished(args, error) } else { error })?;
    let row = &data.rows[place];
    let files = files(&args.dir, row.id());
    if output.is_json() {
        let (case, wall) = (cells(row), wall_of(&data, place));
        output.result("", &json!({ "case": case, "files": json_paths(&files), "wall": wall }))?;
        return Ok(SUCCESS);
    }
    output.result(&text(&data, place, &files), &Value::Null)?;
    Ok(SUCCESS)
}

/// Why a summary has no such case: the case may not be finished, or the summary may be damaged.
fn unfinished(args: &ShowArgs, error: BadInput) -> BadInput {
    let Ok((_, study)) = stored::file_and_study(&args.dir) else { return error };
    match the_case(&study, &args.case) {
        Ok(case) => {
            let (id, told) = (case.id, keys::named(&args.dir));
            let records = finished(&args.dir, &study).unwrap_or_default();
            BadInput(if records.get(case.index).is_some_and(Option::is_some) {
                format!(
                    "summary.csv has no case {id}, which is finished; `seawall report {told}` makes it again"
                )
            } else {
                format!(
                    "case {id} is not finished yet; `seawall status {told}` tells how far the study is"
                )
            })
        }
        Err(error) => error,
    }
}

/// The width of a line, and the indent of its value, characters.
const WIDTH: usize = 80;
const INDENT: usize = 27;

/// What singles a case out. Cells are read as on the command line: flags and beds are not plain words.
fn choice(data: &Loaded, place: usize) -> Choice {
    let value = |key: &Key| match &key.cells[place] {
        "" => None,
        cell => Some(keys::read_value(cell).into()),
    };
    let values = data.keys.iter().map(value).collect();
    Choice { id: data.rows[place].id().to_owned(), values }
}

/// A value for people: with its error bar, its time, and a sign if it is a lower bound.
fn value(row: &Row, column: &Column) -> Option<String> {
    let cell = Some(row.text(column)).filter(|cell| !cell.is_empty())?;
    let Some(value) = row.number(column).filter(|_| column.is_number()) else {
        return Some(cell.to_owned());
    };
    let told = match row.error(column) {
        Some(bar) => with_bar(value, bar),
        None if value.fract() == 0.0 && value.abs() < 1e15 => value.to_string(),
        None => as_typed(value),
    };
    let sign = if row.is_bound(column) { "≥ " } else { "" };
    let time = row.time(column).map(|time| format!(" at {time:.4} s")).unwrap_or_default();
    let told = format!("{sign}{told} {}", column.unit.suffix());
    Some(format!("{}{time}", told.trim_end()))
}

/// All cells of a row by their columns.
fn cells(row: &Row) -> Map<String, Value> {
    let cell = |cell: &str| match cell {
        "" => Value::Null,
        "true" => true.into(),
        "false" => false.into(),
        cell => serde_json::from_str::<serde_json::Number>(cell)
            .map_or_else(|_| cell.into(), Value::Number),
    };
    let value =
        |name: &str, text: &str| if name == CASE_ID.name { text.into() } else { cell(text) };
    row.cells().map(|(name, text)| (name.to_owned(), value(name, text))).collect()
}

/// The files of a case that exist.
fn files(directory: &Path, id: &str) -> Vec<PathBuf> {
    let tables = CASE_FOLDERS.map(|folder| (folder, ".csv")).into_iter();
    let films = FILM_FILES.into_iter().rev().map(|ending| (FILMS, ending));
    let path = |(folder, ending)| directory.join(folder).join(format!("{id}{ending}"));
    let paths = tables.chain(films).chain([(VTK, ".pvd")]).map(path);
    paths.filter(|path| path.is_file()).collect()
}

fn text(data: &Loaded, place: usize, files: &[PathBuf]) -> String {
    let row = &data.rows[place];
    let mut text = format!("case {}: {}\n", row.id(), row.text(&STATUS));
    let (results, health, parameters) = groups();
    text.push_str("\nparameters\n");
    for Key { name, cells } in data.keys.iter().filter(|key| named(&key.name).is_none()) {
        let told = spoken(&format!("{name} = {}", &cells[place]));
        text.extend(told.split_once(" = ").map(|(name, value)| line(name, value)));
    }
    text.extend(scene_values(data, place).iter().map(|(name, value)| line(name, value)));
    for (title, columns) in [("", parameters), ("\nresults\n", results), ("\nhealth\n", health)] {
        text.push_str(title);
        for column in columns {
            // A record has no height unless one was given.
            let idle = row.unasked && column == &WAVE_HEIGHT_RATIO;
            if let Some(value) = value(row, column).filter(|_| !idle) {
                text.push_str(&line(&column.heading_without_unit(), &value));
            }
        }
    }
    text.push_str(&format!("\n{}\n", counted(files.len(), "file")));
    for file in files {
        text.push_str(&format!("  {}\n", keys::named(file)));
    }
    text
}

/// A line, where a long text goes on below its beginning.
fn line(name: &str, value: &str) -> String {
    let lines = wrapped(value, WIDTH - INDENT);
    let below = format!("\n{:INDENT$}", "");
    format!("  {name:<24} {}\n", lines.join(&below))
}
