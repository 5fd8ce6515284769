//! `seawall reproduce`: a figure of a paper, from the runs that it needs.

mod runs;

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};

use self::runs::{needed, study};
use super::execute::on_threads;
use super::failure::BadInput;
use super::input::Setting;
use super::job::Job;
use super::made_figure;
use super::notices::hold_making;
use super::options::EVERY_S;
use super::options::{FigureFormat, for_print};
use super::output::{Output, duration, json_paths};
use super::{INTERRUPTED, SUCCESS, cost, options};
use crate::disk;
use crate::keys::named;
use crate::math::words::counted;
use crate::papers::{Recipe, Run, paper, recipes};
use crate::report::Reproduced;
use crate::results::{Derived, MADE_BY_SWEEPS};
use crate::scene::ConfigError;
use crate::study::Study;

/// Make a figure of a paper: run the cases that it needs, draw it, and set the printed numbers beside it.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall reproduce --list
  seawall reproduce liang2017 --figure 12 --dry-run
  seawall reproduce liang2017 --figure 12
  seawall reproduce huang2019 --figure 9 --figures pdf
  seawall reproduce liang2017 --figure 13 --set numerics.particle_spacing_m=0.016 --out results/runs/coarse13

The files of the runs are inside the program. A run that was broken off goes on; figures that need the same
run share it.")]
pub(super) struct ReproduceArgs {
    /// The paper: liang2017 or huang2019.
    #[arg(required_unless_present = "list")]
    paper: Option<String>,
    /// Which figure: its number, or a word such as table-1. `--list` names all.
    #[arg(long, value_name = "N", required_unless_present = "list")]
    figure: Option<String>,
    /// List the figures and tables: what each shows, and what it costs. Nothing runs.
    #[arg(long, conflicts_with_all = ["figure", "out", "threads", "fresh", "dry_run"])]
    list: bool,
    /// Where figures and runs go [default: results/runs/reproduce_<paper>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Formats of the figure, such as svg,pdf. PDF and PNG come in a journal's widths of 84 and 174 mm.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMAT", default_value = "svg")]
    figures: Vec<FigureFormat>,
    /// Threads [default: all, and 1 for a figure of computing times].
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
    /// Move earlier runs aside and start over.
    #[arg(long)]
    fresh: bool,
    /// Show what would run, where it would go, and how long it takes. Nothing runs or is written.
    #[arg(long)]
    dry_run: bool,
    /// Set a key of every run, such as numerics.particle_spacing_m=0.02. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

pub(super) fn main(args: &ReproduceArgs, output: &Output) -> anyhow::Result<u8> {
    if let Some(name) = args.paper.as_deref().filter(|name| paper(name).is_none()) {
        let mut known: Vec<_> = recipes().iter().map(|recipe| recipe.paper.as_str()).collect();
        known.dedup();
        return Err(BadInput(
            ConfigError::one_of("PAPER", &toml::Value::from(name), &known).to_string(),
        )
        .into());
    }
    if args.list {
        return list(args, output);
    }
    let recipe = recipe(args)?;
    if !recipe.why_not.is_empty() {
        let reason =
            format!("{} of {} is not made: {}", recipe.title(), recipe.paper, recipe.why_not);
        return Err(BadInput(reason).into());
    }
    let formats = for_print(&args.figures)?;
    let studies: Vec<_> =
        recipe.run.iter().map(|run| study(run, &args.settings)).collect::<Result<_, _>>()?;
    let default = || Path::new("results").join("runs").join(format!("reproduce_{}", recipe.paper));
    let out = args.out.clone().unwrap_or_else(default);
    let times = recipe.draw.as_ref().is_some_and(|draw| draw.tells_times());
    let threads = args.threads.or(times.then_some(1));
    if args.dry_run {
        let needed = needed(&recipe.run, &studies, &out, (threads, args.fresh))?;
        let text = format!("{} of {}: {}\n", recipe.title(), recipe.paper, recipe.shows);
        output.result(&(text + &runs::text(&needed)), &json!({ "runs": needed }))?;
        return Ok(SUCCESS);
    }
    let (mut directories, mut code) = (Vec::new(), SUCCESS);
    for (run, study) in recipe.run.iter().zip(studies) {
        let seconds = cost::expected_seconds(&study, threads.map(usize::from));
        let cases = counted(study.cases.len(), "case");
        output.note(format_args!("{}: {cases}, about {} in all", run.name, duration(seconds)));
        let job = job(args, run, study, out.join(&run.name), !times);
        let done = on_threads(&job, threads, None, EVERY_S, output)?;
        if done.exit_code() == INTERRUPTED {
            output.note("interrupted: the same command goes on");
            return Ok(INTERRUPTED);
        }
        code = code.max(done.exit_code());
        let _making = hold_making(&job.out, output);
        Derived::begin(&job.out, MADE_BY_SWEEPS)?;
        let written = crate::report::write(&job.out)?;
        Derived::end(&job.out, &written.made, true)?;
        directories.push(job.out);
    }
    let made = crate::report::reproduce::reproduce(recipe, &directories)?;
    let mut files = write(&out, &made)?;
    for format in formats {
        files.extend(crate::report::print(&made.figure, format, &out)?);
    }
    let mut text = made_figure::text(&made);
    for file in &files {
        text.push_str(&format!("{}\n", named(file)));
    }
    output.result(&text, &value(recipe, &made, &files, &directories))?;
    Ok(code)
}

fn recipe(args: &ReproduceArgs) -> Result<&'static Recipe, BadInput> {
    let (paper, figure) = (args.paper.as_deref(), args.figure.as_deref().unwrap_or_default());
    let own = || recipes().iter().filter(|recipe| Some(recipe.paper.as_str()) == paper);
    own().find(|recipe| recipe.number == figure).ok_or_else(|| {
        let known: Vec<_> = own().map(|recipe| recipe.number.as_str()).collect();
        BadInput(format!(
            "--figure {figure}: {} has {} (seawall reproduce --list tells what they show)",
            paper.unwrap_or_default(),
            known.join(", ")
        ))
    })
}

fn job(args: &ReproduceArgs, run: &Run, study: Study, out: PathBuf, shares_threads: bool) -> Job {
    let own = [format!("name={}", run.name)].into_iter().chain(run.set.iter().cloned());
    let theirs = args.settings.iter().map(|setting| setting.text.clone());
    let overrides = own.chain(theirs).collect();
    Job { shares_threads, overrides, ..Job::of(study, out, args.fresh) }
}

/// `<stem>.svg`, `<stem>.csv` and `<stem>.md`.
fn write(out: &Path, made: &Reproduced) -> Result<Vec<PathBuf>, BadInput> {
    let figure = &made.figure;
    let prose =
        [&[format!("# {}", figure.title), figure.caption.clone()], &made.sentences[..]].concat();
    let table = if made.beside.rows.is_empty() { String::new() } else { made.beside.markdown() };
    let text = format!("{}\n\n{table}", prose.join("\n\n"));
    let mut files = Vec::new();
    let texts = [("svg", figure.svg()), ("csv", made.tidy.csv()), ("md", text)];
    for (ending, text) in texts {
        if ending == "csv" && made.tidy.rows.is_empty() {
            continue;
        }
        let path = out.join(format!("{}.{ending}", figure.name));
        disk::put(&path, text).map_err(|error| BadInput::of(&path, error))?;
        files.push(path);
    }
    Ok(files)
}

fn value(recipe: &Recipe, made: &Reproduced, files: &[PathBuf], directories: &[PathBuf]) -> Value {
    let line = |row: &Vec<String>| -> serde_json::Map<String, Value> {
        let cells = made.tidy.header.iter().cloned().zip(row.iter().cloned().map(Value::from));
        cells.collect()
    };
    json!({
        "paper": recipe.paper,
        "figure": recipe.number,
        "caption": made.figure.caption,
        "sentences": made.sentences,
        "numbers": made.tidy.rows.iter().map(line).collect::<Vec<_>>(),
        "files": json_paths(files),
        "studies": json_paths(directories),
    })
}

/// Every figure and table: what it shows, and how long it takes or why it is not made.
fn list(args: &ReproduceArgs, output: &Output) -> anyhow::Result<u8> {
    let wanted = args.paper.as_deref();
    let (mut text, mut values, mut last) = (String::new(), Vec::new(), "");
    for recipe in recipes().iter().filter(|r| wanted.is_none_or(|paper| paper == r.paper)) {
        if recipe.paper != last {
            let about = paper(&recipe.paper);
            let words = about.map_or_else(String::new, |p| format!("{}, {}", p.words, p.title));
            text.push_str(&format!(
                "{}{}: {words}\n",
                if last.is_empty() { "" } else { "\n" },
                recipe.paper
            ));
            last = &recipe.paper;
        }
        let (mut seconds, mut cases) = (0.0, 0);
        for run in &recipe.run {
            let study = study(run, &args.settings)?;
            let times = recipe.draw.as_ref().is_some_and(|draw| draw.tells_times());
            seconds += cost::expected_seconds(&study, times.then_some(1));
            cases += study.cases.len();
        }
        text.push_str(&format!("\n  {}: {}", recipe.title(), recipe.shows));
        let made = recipe.why_not.is_empty();
        if !recipe.here.is_empty() {
            text.push_str(&format!("\n      here: {}", recipe.here));
        }
        if made {
            text.push_str(&format!(
                "\n      {}, about {}\n",
                counted(cases, "case"),
                duration(seconds)
            ));
        } else {
            text.push_str(&format!("\n      not made: {}\n", recipe.why_not));
        }
        values.push(json!({
            "paper": recipe.paper,
            "figure": recipe.number,
            "shows": recipe.shows,
            "here": recipe.here,
            "made": made,
            "why_not": recipe.why_not,
            "cases": cases,
            "expected_time_s": made.then_some(seconds),
        }));
    }
    output.result(&text, &json!({ "figures": values }))?;
    Ok(SUCCESS)
}
