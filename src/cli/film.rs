//! `seawall film`: one case of a finished study again, filmed.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::json;

use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::Output;
use super::pick::the_case;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS, refine};
use crate::execute::Interrupt;
use crate::film::{Colour, Filming, PageFilm};
use crate::math::simd::SimdPath;
use crate::results::{CaseRecord, Manifest, finished, first_difference, read_journal};
use crate::simulation::{Outcome, Resources, Stopped, run_case};
use crate::study::{Case, Override, PHYSICS_VERSION, Study, SweepFile};

/// Run one case of a finished study again, check that its results are the same to the bit, and film
/// it.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall film results/runs/two_waves wave_height_ratio=0.5 spring_stiffness_n_per_m=10
  seawall film results/runs/two_waves 0123456789abcdef --colour speed
  seawall film results/runs/fixed_wall")]
pub(super) struct FilmArgs {
    /// The output directory of a sweep or a run.
    dir: PathBuf,
    /// Which case: values of swept keys, or the case's id; as much as tells it from the others.
    #[arg(value_name = "KEY=VALUE")]
    case: Vec<String>,
    /// What particles are coloured by.
    #[arg(long, value_enum, default_value_t = ColourChoice::Pressure)]
    colour: ColourChoice,
    /// Threads that share the work; the results are the same for any number [default: all].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// What particles are coloured by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ColourChoice {
    /// Pressure, kPa.
    Pressure,
    /// Speed, m/s.
    Speed,
}

impl From<ColourChoice> for Colour {
    fn from(choice: ColourChoice) -> Colour {
        match choice {
            ColourChoice::Pressure => Colour::Pressure,
            ColourChoice::Speed => Colour::Speed,
        }
    }
}

pub(super) fn main(args: &FilmArgs, output: &Output) -> anyhow::Result<u8> {
    let (study, simd) = read(&args.dir)?;
    let case = the_case(&study, &args.case)?;
    let set = Set {
        study: &study,
        records: &finished(&args.dir, &study)?,
        directory: &args.dir,
        colour: args.colour.into(),
        resources: Resources { simd, threads: threads(args.threads) },
        interrupt: &Interrupt::listen()?,
    };
    let code = set.shoot(case, output)?;
    let path = page(&args.dir, set.colour).path(case.id);
    if code == SUCCESS {
        let value = json!({ "case_id": case.id, "same": true, "film": path });
        output.result(&format!("{}\n", path.display()), &value)?;
    }
    Ok(code)
}

/// The threads asked for, or all that there are.
pub(super) fn threads(asked: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(all, usize::from)
}

/// The folder of films in an output directory, and what they show.
pub(super) fn page(directory: &Path, colour: Colour) -> PageFilm {
    PageFilm { colour, folder: directory.join("films") }
}

/// The study that a directory holds, and the instruction set that it was computed with.
pub(super) fn read(directory: &Path) -> anyhow::Result<(Study, SimdPath)> {
    let bad = |reason: String| BadInput(format!("{}: {reason}", directory.display()));
    let (_, study) = study_of(directory)?;
    let unfinished = || bad("the sweep was stopped before it began".to_owned());
    let header = read_journal(directory)?.header.ok_or_else(unfinished)?;
    if !header.simd.is_supported() {
        let simd = crate::math::name::name_of(header.simd);
        return Err(bad(format!("was computed with {simd}, which this machine lacks")).into());
    }
    Ok((study, header.simd))
}

/// The file that a directory was made from, with what the command line set, and its study.
pub(super) fn study_of(directory: &Path) -> anyhow::Result<(SweepFile, Study)> {
    let bad = |reason: String| BadInput(format!("{}: {reason}", directory.display()));
    demand_output_of_study(directory, "manifest.json")?;
    let lacking = || bad("manifest.json cannot be read".to_owned());
    let manifest = Manifest::read(directory).ok_or_else(lacking)?;
    if manifest.physics_version != PHYSICS_VERSION {
        let theirs = manifest.physics_version;
        let reason = format!("has physics version {theirs}, this program {PHYSICS_VERSION}");
        return Err(bad(format!("{reason}: its cases would not come out the same")).into());
    }
    let set = |text: &String| text.parse::<Override>();
    let overrides: Vec<_> =
        manifest.overrides.iter().map(set).collect::<Result<_, _>>().map_err(bad)?;
    let told = |error| bad(format!("sweep_file in manifest.json: {error}"));
    let file = SweepFile::read(&manifest.sweep_file, &overrides).map_err(told)?;
    let study = refine::study_in(directory, &file)?;
    if study.identity != manifest.sweep {
        let reason = "its cases cannot be made from its manifest alone, as with --max-error";
        return Err(bad(format!("{reason}; film one with `seawall run --film`")).into());
    }
    Ok((file, study))
}

/// Where and how cases are filmed again.
pub(super) struct Set<'a> {
    pub(super) study: &'a Study,
    /// Of its finished cases and companions, in the order of [`Study::runs`].
    pub(super) records: &'a [Option<CaseRecord>],
    pub(super) directory: &'a Path,
    pub(super) colour: Colour,
    pub(super) resources: Resources,
    pub(super) interrupt: &'a Interrupt,
}

impl Set<'_> {
    /// Runs a case again and films it; a film is kept only where the results are those of the study.
    pub(super) fn shoot(&self, case: &Case, output: &Output) -> anyhow::Result<u8> {
        self.demand_finished(case)?;
        demand_small(case)?;
        let film = page(self.directory, self.colour);
        let path = film.path(case.id);
        let shot = Filming::Page(film).shoot(&case.config, self.interrupt, |monitor| {
            run_case(&case.config, None, self.resources, monitor)
        });
        let result = match shot {
            Ok(result) => result,
            Err(Stopped::Interrupted) => return Ok(INTERRUPTED),
            Err(Stopped::Failed(failure)) => {
                output.note(format_args!("case {}: not filmed: {failure}", case.id));
                return Ok(CASES_FAILED);
            }
        };
        let (directory, study) = (self.directory, (self.study, self.records));
        if let Some(reason) = first_difference(directory, study, case, &result)? {
            for path in [path.with_extension("svg"), path] {
                std::fs::remove_file(path)?;
            }
            output.note(format_args!("case {}: did not come out the same: {reason}", case.id));
            return Ok(CASES_FAILED);
        }
        let same = "the same to the bit as in the study";
        output.note(format_args!("case {}: {same}; filmed into {}", case.id, path.display()));
        Ok(SUCCESS)
    }

    fn demand_finished(&self, case: &Case) -> Result<(), BadInput> {
        let reason = match &self.records[case.index] {
            Some(record) if record.is_ok() => return Ok(()),
            Some(record) => format!("failed in the study: {}", record.reason),
            None => "has not run yet: the study is not finished".to_owned(),
        };
        Err(BadInput(format!("case {}: {reason}", case.id)))
    }
}

/// Refuses a case that is too large for a page.
pub(super) fn demand_small(case: &Case) -> Result<(), BadInput> {
    PageFilm::takes(&case.config).map_err(|reason| BadInput(format!("case {}: {reason}", case.id)))
}

/// The cases of a study that are worth a look first: that of the largest force, of the highest runup,
/// of the softest wall that turns within the run, and the most doubtful one.
pub(super) fn worth_a_look(study: &Study, records: &[&CaseRecord]) -> Vec<usize> {
    let well =
        || records.iter().filter_map(|record| Some((record.index, record.outcome.as_ref()?)));
    let best = |score: &dyn Fn(usize, &Outcome) -> Option<f64>| {
        let scores = well().filter_map(|(index, outcome)| Some((score(index, outcome)?, index)));
        scores.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index)
    };
    let stiffness =
        |index: usize| study.cases[index].config.scene.seawall()?.spring_stiffness_n_per_m;
    let reasons = |told: &String| told.split("; ").count() as f64;
    let mut chosen: Vec<usize> = [
        best(&|_, outcome| Some(outcome.force_max.value)),
        best(&|_, outcome| Some(outcome.runup_max.value)),
        best(&|index, outcome| {
            let turned = outcome.displacement_truncated == Some(false)
                && outcome.displacement_max.is_some_and(|maximum| maximum.value > 0.0);
            stiffness(index).filter(|_| turned).map(|stiffness| -stiffness)
        }),
        best(&|_, outcome| outcome.doubtful_reason.as_ref().map(reasons)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let mut seen = std::collections::BTreeSet::new();
    chosen.retain(|&index| seen.insert(index));
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::made_up;

    fn study() -> Study {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\n\
            wave_height_ratio = [0.3, 0.5]\nspring_stiffness_n_per_m = [10, 21544.3469003188]";
        Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap()
    }

    #[test]
    fn a_case_that_is_worth_a_look_in_two_ways_is_filmed_once() {
        let study = study();
        let records: Vec<_> = study
            .cases
            .iter()
            .map(|case| {
                let mut result = made_up(&case.config);
                let outcome = &mut result.outcome;
                outcome.force_max.value = [1.0, 3.0, 2.0, 1.0][case.index];
                outcome.runup_max.value = [1.0, 3.0, 2.0, 1.0][case.index];
                outcome.displacement_truncated = Some(case.index == 0);
                outcome.doubtful_reason = (case.index == 3).then(|| "made up".to_owned());
                CaseRecord::new(&study, case, &Ok(result), 1.0, "here")
            })
            .collect();
        let records: Vec<_> = records.iter().collect();
        assert_eq!(worth_a_look(&study, &records)[..2], [1, 2]);
        assert_eq!(worth_a_look(&study, &records), [1, 2, 3]);
    }
}
