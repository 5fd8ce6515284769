//! `seawall show`: one case of a finished study, from its files.

mod groups;

use std::path::{Path, PathBuf};
use std::rc::Rc;

use clap::Args;
use csv::StringRecord;
use serde_json::{Map, Value, json};

use self::groups::groups;
use super::failure::BadInput;
use super::output::{Output, json_paths, with_bar, wrapped};
use super::picked_case::{Choice, in_every_case, the_case, the_one};
use super::{SUCCESS, stored};
use crate::disk::names::{CASE_FOLDERS, FILMS, SUMMARY, VTK};
use crate::keys;
use crate::math::words::counted;
use crate::quantities::summary::{CASE_ID, STATUS, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, named};
use crate::report::load::{Loaded, stream};
use crate::report::{self, ReportError, as_typed, scene_values, spoken, wall_of};
use crate::results::{Manifest, finished};

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
    let rows = rows(&args.dir.join(SUMMARY))?;
    let (keys, cases) = Manifest::read(&args.dir)
        .map_or_else(Default::default, |manifest| (manifest.keys, manifest.cases));
    let choices: Vec<_> = rows.iter().map(|row| row.choice(&keys)).collect();
    let fixed = |key: &str| in_every_case(&stored::file_and_study(&args.dir).ok()?.1, key);
    let place = the_one(&keys, &fixed, &choices, &args.case);
    let left = rows.len() < cases;
    let place = place.map_err(|error| if left { unfinished(args, error) } else { error })?;
    let row = &rows[place];
    let files = files(&args.dir, row.cell(CASE_ID.name));
    // What the study's file says of its paddle, and of its scene.
    let data = Loaded::read(&args.dir).unwrap_or_default();
    if output.is_json() {
        let mut value = row.json(&files);
        value["wall"] = json!(wall_of(&data, place));
        output.result("", &value)?;
        return Ok(SUCCESS);
    }
    let known = (data.rows.get(place).cloned().unwrap_or_default(), scene_values(&data, place));
    output.result(&text(row, &known, &keys, &files), &Value::Null)?;
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

/// A row of `summary.csv`: the names, which all rows share, and the cells.
struct Row(Rc<StringRecord>, StringRecord);

fn rows(path: &Path) -> anyhow::Result<Vec<Row>> {
    let bad = |error: ReportError| BadInput(error.to_string());
    let (names, rows) = stream(path).map_err(bad)?;
    let names = Rc::new(names);
    rows.map(|cells| Ok(Row(names.clone(), cells.map_err(bad)?))).collect()
}

impl Row {
    fn cells(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().zip(&self.1)
    }

    fn cell(&self, name: &str) -> &str {
        self.cells().find(|(own, _)| *own == name).map_or("", |(_, cell)| cell)
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.cell(name).parse().ok()
    }

    fn choice(&self, keys: &[String]) -> Choice {
        // Cells are read as on the command line: flags and beds are not plain words.
        let value = |key: &String| match self.cell(key) {
            "" => None,
            cell => Some(keys::read_value(cell).into()),
        };
        Choice { id: self.cell(CASE_ID.name).to_owned(), values: keys.iter().map(value).collect() }
    }

    /// A value for people: with its error bar, its time, and a sign if it is a lower bound.
    fn value(&self, column: &Column) -> Option<String> {
        let cell = Some(self.cell(column.name)).filter(|cell| !cell.is_empty())?;
        let Some(value) = self.number(column.name).filter(|_| column.is_number()) else {
            return Some(cell.to_owned());
        };
        let value = column.told_value(value);
        let bar = column.bar.and_then(|bar| self.number(bar)).map(|bar| column.told_value(bar));
        let told = match bar {
            Some(bar) => with_bar(value, bar),
            None if value.fract() == 0.0 && value.abs() < 1e15 => value.to_string(),
            None => as_typed(value),
        };
        let time = |column: &Column| column.time_name().and_then(|name| self.number(&name));
        let bound = column.is_bound_by(|flag| self.cell(flag.name) == "true", time);
        let sign = if bound { "≥ " } else { "" };
        let time = time(column).map(|time| format!(" at {time:.4} s")).unwrap_or_default();
        let told = format!("{sign}{told} {}", column.unit.suffix());
        Some(format!("{}{time}", told.trim_end()))
    }

    fn json(&self, files: &[PathBuf]) -> Value {
        let cell = |cell: &str| match cell {
            "" => Value::Null,
            "true" => true.into(),
            "false" => false.into(),
            cell => serde_json::from_str::<serde_json::Number>(cell)
                .map_or_else(|_| cell.into(), Value::Number),
        };
        let id = |name: &str, text: &str| {
            if name == CASE_ID.name { text.into() } else { cell(text) }
        };
        let cells: Map<_, _> =
            self.cells().map(|(name, text)| (name.to_owned(), id(name, text))).collect();
        json!({ "case": cells, "files": json_paths(files) })
    }
}

/// The files of a case that exist.
fn files(directory: &Path, id: &str) -> Vec<PathBuf> {
    let tables = CASE_FOLDERS.map(|folder| (folder, ".csv")).into_iter();
    let films = [".html", ".svg", "-highest.svg", "-furthest.svg"].map(|ending| (FILMS, ending));
    let path = |(folder, ending)| directory.join(folder).join(format!("{id}{ending}"));
    let paths = tables.chain(films).chain([(VTK, ".pvd")]).map(path);
    paths.filter(|path| path.is_file()).collect()
}

/// The row with what the study's file says of its paddle, and what it says of its scene.
type Known = (report::Row, Vec<(String, String)>);

fn text(row: &Row, (known, scene): &Known, keys: &[String], files: &[PathBuf]) -> String {
    let mut text = format!("case {}: {}\n", row.cell(CASE_ID.name), row.cell(STATUS.name));
    let (results, health, parameters) = groups();
    text.push_str("\nparameters\n");
    let swept = keys.iter().filter(|key| named(key).is_none());
    for key in swept {
        let told = spoken(&format!("{key} = {}", row.cell(key)));
        text.extend(told.split_once(" = ").map(|(name, value)| line(name, value)));
    }
    text.extend(scene.iter().map(|(name, value)| line(name, value)));
    for (title, columns) in [("", parameters), ("\nresults\n", results), ("\nhealth\n", health)] {
        text.push_str(title);
        for column in columns {
            // Regular waves have no first impact or crest that counts. A record has no height unless one was given.
            let idle = (known.regular && column.of_a_single_wave)
                || (known.unasked && column == &WAVE_HEIGHT_RATIO);
            if let Some(value) = row.value(column).filter(|_| !idle) {
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
