//! `seawall film`: one case of a finished study again, filmed.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::failure::{BadInput, not_writable};
use super::notices::hold_making;
use super::output::{Output, json_path};
use super::picked_case::the_case;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS, options, stored};
use crate::disk::names::FILMS;
use crate::execute::{Interrupt, available_cores};
use crate::film::{Colour, Filming, PageFilm};
use crate::keys::named;
use crate::results::{CaseRecord, Derived, damaged_files, finished, first_difference};
use crate::simulation::{Resources, Stopped, run_case};
use crate::study::{Case, Study};

/// Film one case of a finished study. The case runs again, and its results must be the same to the bit.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall film results/runs/two_waves wave_height_ratio=0.5 spring_stiffness_n_per_m=10
  seawall film results/runs/two_waves 0123456789abcdef --colour speed
  seawall film results/runs/fixed_wall")]
pub(super) struct FilmArgs {
    /// The output directory of a sweep or a run.
    dir: PathBuf,
    /// Which case: its id, or as many values of swept keys as single it out.
    #[arg(value_name = "KEY=VALUE")]
    case: Vec<String>,
    /// What particles are coloured by.
    #[arg(long, value_enum, default_value_t = Colour::Pressure)]
    colour: Colour,
    /// Threads that share the work. The results are the same for any number [default: all].
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
}

pub(super) fn main(args: &FilmArgs, output: &Output) -> anyhow::Result<u8> {
    let (study, simd) = stored::study(&args.dir)?;
    stored::demand_summary(&args.dir)?;
    let case = the_case(&study, &args.case)?;
    let _making = hold_making(&args.dir, output);
    let set = Set {
        study: &study,
        records: &finished(&args.dir, &study)?,
        directory: &args.dir,
        colour: args.colour,
        resources: Resources { simd, threads: threads(args.threads) },
        interrupt: &Interrupt::listen()?,
    };
    // This checks before anything runs that the seal can be written.
    Derived::renew(&args.dir, &[]).map_err(not_writable)?;
    let shot = set.shoot(case).map_err(not_writable)?;
    shot.tell(case, output);
    if let Shot::Filmed(path) = &shot {
        let value = json!({ "case_id": case.id, "same": true, "film": json_path(path) });
        output.result(&format!("{}\n", named(path)), &value)?;
        output.note(format_args!("`seawall report {}` puts it into the page", named(&args.dir)));
    } else if matches!(shot, Shot::Interrupted) {
        let out = json_path(&args.dir);
        output.result("", &json!({ "interrupted": true, "case_id": case.id, "out": out }))?;
    }
    Ok(shot.code())
}

/// The threads asked for, or all of this machine.
pub(super) fn threads(asked: Option<u16>) -> usize {
    asked.map_or_else(available_cores, usize::from)
}

/// The folder of films in an output directory, and the colours of films.
pub(super) fn page(directory: &Path, colour: Colour) -> PageFilm {
    PageFilm { colour, folder: directory.join(FILMS) }
}

/// Where and how cases are filmed again.
pub(super) struct Set<'a> {
    pub(super) study: &'a Study,
    /// Records of finished cases and companions, in the order of [`Study::runs`].
    pub(super) records: &'a [Option<CaseRecord>],
    pub(super) directory: &'a Path,
    pub(super) colour: Colour,
    pub(super) resources: Resources,
    pub(super) interrupt: &'a Interrupt,
}

/// The result of filming a case.
pub(super) enum Shot {
    /// The film's page. The run came out the same.
    Filmed(PathBuf),
    Interrupted,
    /// Why there is no film.
    NotFilmed(String),
    /// The place where the run came out differently; there is no film.
    Differs(String),
}

impl Shot {
    /// Reports the result.
    pub(super) fn tell(&self, case: &Case, output: &Output) {
        let id = case.id;
        match self {
            Shot::Filmed(path) => output.note(format_args!(
                "case {id}: the same to the bit as in the study; filmed into {}",
                named(path)
            )),
            Shot::Interrupted => {}
            Shot::NotFilmed(why) => {
                output.note(format_args!("warning: case {id}: not filmed: {why}"))
            }
            Shot::Differs(where_) => {
                output.note(format_args!("case {id}: did not come out the same: {where_}"));
            }
        }
    }

    /// The exit code of a command that was to film this case.
    pub(super) fn code(&self) -> u8 {
        match self {
            Shot::Filmed(_) => SUCCESS,
            Shot::Interrupted => INTERRUPTED,
            Shot::NotFilmed(_) | Shot::Differs(_) => CASES_FAILED,
        }
    }
}

impl Set<'_> {
    /// The page of a case.
    pub(super) fn page(&self, case: &Case) -> PathBuf {
        page(self.directory, self.colour).path(case.id)
    }

    /// The files of a case's film.
    pub(super) fn files(&self, case: &Case) -> [PathBuf; 4] {
        page(self.directory, self.colour).files(case.id)
    }

    /// Runs a case again and films it. The film is kept only if the results are those of the study.
    pub(super) fn shoot(&self, case: &Case) -> anyhow::Result<Shot> {
        let shot = self.film(case);
        Derived::renew(self.directory, &self.files(case))?;
        shot
    }

    fn film(&self, case: &Case) -> anyhow::Result<Shot> {
        self.demand_finished(case)?;
        demand_small(case)?;
        let film = page(self.directory, self.colour);
        let shot = Filming::Page(film).shoot(&case.config, self.interrupt, |monitor| {
            run_case(&case.config, None, self.resources, monitor)
        });
        let (result, written) = match shot {
            Ok(shot) => shot,
            Err(Stopped::Interrupted) => return Ok(Shot::Interrupted),
            Err(Stopped::Failed(failure)) => return Ok(Shot::NotFilmed(failure.to_string())),
        };
        let (path, study) = (self.page(case), (self.study, self.records));
        if let Some(reason) = first_difference(self.directory, study, case, &result)? {
            for path in self.files(case) {
                let _ = std::fs::remove_file(path); // it may not have been written
            }
            // What the disk has changed is no fault of the run.
            let damage = damaged_files(self.directory, case.id)?;
            return Ok(Shot::Differs(match damage.is_empty() {
                true => reason,
                false => format!("{reason}: {}, and no fault of the run", damage.join(", ")),
            }));
        }
        Ok(match written {
            Ok(()) => Shot::Filmed(path),
            Err(error) => Shot::NotFilmed(error.to_string()),
        })
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
