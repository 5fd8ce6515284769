//! `seawall run`: one scene.

mod words;

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::SUCCESS;
use super::execute::on_threads;
use super::film;
use super::input::{Setting, SimdChoice, default_out, scene};
use super::job::{Done, Job, Retry};
use super::notices::hold_making;
use super::options::KeepArgs;
use super::output::{Output, duration};
use super::{cost, lost_bars, options, warnings};
use crate::disk::names::{FILMS, VTK};
use crate::execute::{Ending, Interrupt};
use crate::film::{Colour, Filming, PageFilm, VtkFilm};
use crate::keys::named;
use crate::results::{CaseRecord, Derived, has_checkpoints};
use crate::scene::CaseConfig;
use crate::simulation::Resources;
use crate::study::Study;

/// Run one scene. Print its results, its energy budget, and where the time went.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall run sweeps/scenes/fixed_wall.toml
  seawall run sweeps/scenes/fixed_wall.toml --set scene.wave_height_ratio=0.3 --out results/runs/h03
  seawall run sweeps/nightly.toml wave_height_ratio=0.5 spring_stiffness_n_per_m=10
  seawall run sweeps/scenes/dam_break.toml --vtk 0.02
  seawall run sweeps/scenes/movable_wall.toml --film
  seawall run sweeps/scenes/fixed_wall.toml --fresh --format json")]
pub(super) struct RunArgs {
    /// A scene file, with [scene] and [numerics]; or a sweep file, of which KEY=VALUE picks a case where it
    /// has several.
    file: PathBuf,
    /// Which case of a sweep file: values of swept keys, or the start of its id.
    #[arg(value_name = "KEY=VALUE")]
    case: Vec<String>,
    /// Where results go [default: results/runs/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Move an earlier run aside and start over.
    #[arg(long)]
    fresh: bool,
    /// Write files for ParaView into vtk/, one every so many seconds of simulated time.
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = "0.05")]
    #[arg(value_parser = options::above_zero, allow_negative_numbers = true)]
    vtk: Option<f64>,
    /// Film the water into films/, coloured by pressure or speed. A run that is finished already runs
    /// once more, and must come out the same.
    #[arg(long, value_enum, value_name = "COLOUR", num_args = 0..=1, conflicts_with = "vtk")]
    #[arg(default_missing_value = "pressure")]
    film: Option<Colour>,
    /// Threads that share the case; each needs some 2,000 particles to be worth it. The results are the
    /// same for any number [default: the processors that it may use].
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
    #[command(flatten)]
    keep: KeepArgs,
    /// Instruction set of the hot loops.
    #[arg(long, value_enum, default_value_t = SimdChoice::Auto)]
    simd: SimdChoice,
    /// Set a key of the file, such as scene.wave_height_ratio=0.3. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

pub(super) fn main(args: &RunArgs, output: &Output) -> anyhow::Result<u8> {
    let (study, settings) = scene(&args.file, &args.settings, &args.case)?;
    warnings::tell(&args.file, &study, output);
    warnings::tell_threads(args.threads, output);
    let case = &study.cases[0];
    let expected = duration(cost::seconds_of_a_core(&study));
    let inputs = words::inputs(&case.config);
    output.note(format_args!("case {}: {inputs}; about {expected} of one core", case.id));
    let out = args.out.clone().unwrap_or_else(|| default_out(&study));
    let job = Job {
        retry: Retry::Cases,
        branching: false,
        simd: args.simd.path(),
        overrides: settings.iter().map(|setting| setting.text.clone()).collect(),
        ..Job::of(study, out, args.fresh)
    };
    let folder = job.out.join(VTK);
    let vtk = args.vtk.map(|interval_s| Filming::Vtk(VtkFilm { interval_s, folder }));
    let page = args.film.map(|colour| film::page(&job.out, colour));
    if page.is_some() {
        film::demand_small(&job.study.cases[0])?;
    }
    let filming = vtk.or_else(|| page.clone().map(Filming::Page));
    let every_s = args.keep.checkpoint_every_s;
    let done = on_threads(&job, args.threads, filming, every_s, output)?;
    if args.vtk.is_some() && done.wall_time_s.is_none() {
        output.note("--vtk: nothing was written, as nothing was run; --fresh writes the files");
    }
    if done.ending == Ending::Interrupted {
        // A film has to show a case from its start.
        let films = args.vtk.is_some() || args.film.is_some();
        output.note(match has_checkpoints(done.directory.path()) && !films {
            true => "interrupted: the same command goes on from the last checkpoint",
            false => "interrupted: a single scene starts over",
        });
    }
    done.directory.left().demand(done.directory.path())?;
    if done.wall_time_s.is_some() && done.ending == Ending::Finished {
        let filmed = [args.vtk.map(|_| VTK), args.film.map(|_| FILMS)];
        let _making = hold_making(done.directory.path(), output);
        let seal = |folder| Derived::renew_folder(done.directory.path(), folder);
        filmed.into_iter().flatten().try_for_each(seal)?;
    }
    let records = done.whole(&job.study)?;
    if records.is_empty() {
        return done.interrupted(&job, output);
    }
    for record in &records {
        let config = &job.study.cases[record.index].config;
        let bars = job.study.error_bars(record.index, done.directory.records());
        let told = words::results(record, config, bars);
        let text = format!("{told}files: {}\n", named(done.directory.path()));
        let value = in_metres(record, config, done.in_full(&job.study, record));
        output.result(&text, &value)?;
        if record.failure.is_some() {
            output.failure(told.trim_end());
        }
        if let Some(lost) = lost_bars::of_case(&job.study, record, done.directory.records()) {
            output.note(lost);
        }
    }
    match page {
        Some(page) if done.exit_code() == SUCCESS => {
            film_of(args, &page, &job.study, &done, output)
        }
        _ => Ok(done.exit_code()),
    }
}

/// Reports where the film is. If nothing was run, the case runs again for it.
fn film_of(
    args: &RunArgs,
    page: &PageFilm,
    study: &Study,
    done: &Done,
    output: &Output,
) -> anyhow::Result<u8> {
    let case = &study.cases[0];
    if done.wall_time_s.is_some() {
        let path = page.path(case.id);
        if path.exists() {
            output.note(format_args!("filmed into {}", named(&path)));
        }
        return Ok(SUCCESS);
    }
    let resources = Resources { simd: done.directory.simd(), threads: film::threads(args.threads) };
    let (directory, colour) = (done.directory.path(), page.colour);
    let (records, interrupt) = (done.directory.records(), &Interrupt::listen()?);
    let _making = hold_making(directory, output);
    let set = film::Set { study, records, directory, colour, resources, interrupt };
    let shot = set.shoot(case)?;
    shot.tell(case, output);
    Ok(shot.code())
}

/// The record as JSON, with the highest runup over still water in metres added.
fn in_metres(record: &CaseRecord, config: &CaseConfig, mut value: Value) -> Value {
    let highest = record.outcome.as_ref().map(|outcome| outcome.runup_max.value);
    value["runup_max_m"] = json!(highest.map(|runup| runup * config.scene.frame().depth));
    value
}
