//! `seawall verify`: whether a directory still holds what was written into it.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::Output;
use super::{CASES_FAILED, SUCCESS, film, options, stored};
use crate::disk::names::JOURNAL;
use crate::math::words::counted;
use crate::results::{CaseRecord, Manifest, Verified, first_difference, verify};
use crate::simulation::{Resources, Unwatched, run_case};
use crate::study::Study;

/// Check every file of a study against its checksum. With --rerun, run some cases again and compare them.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall verify results/runs/nightly
  seawall verify results/runs/nightly --rerun 3")]
pub(super) struct VerifyArgs {
    /// The output directory of a sweep or a run.
    dir: PathBuf,
    /// Run so many of the finished cases again, picked evenly from the grid, and compare every bit.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = options::whole(0, u32::MAX as usize), allow_negative_numbers = true)]
    pub(super) rerun: usize,
    /// Threads that share the work. The results are the same for any number [default: all].
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
}

pub(super) fn main(args: &VerifyArgs, output: &Output) -> anyhow::Result<u8> {
    demand_output_of_study(&args.dir, JOURNAL)?;
    let (stored, why) = match (stored::study(&args.dir), Manifest::damage(&args.dir)) {
        (Err(_), Some(what)) => return lost(what, output),
        (Err(error), None) => match stored::missing_stroke(&args.dir) {
            // The journal has a checksum of every file of a case. Only its tables need the study.
            Some(why) if args.rerun == 0 => (None, Some(why)),
            why => return Err(why.map_or(error, |why| BadInput::of(&args.dir, why).into())),
        },
        (stored, _) => (Some(stored?), None),
    };
    let study = stored.as_ref().map(|(study, _)| study);
    let Verified { mut told, older, cases, records, .. } = verify(&args.dir, study)?;
    older.iter().for_each(|older| output.note(older));
    if let Some(why) = why {
        let tables = "summary.csv and energy.csv are not compared with the journal";
        output.note(format_args!("{tables}: {why}"));
    }
    let mut again = Vec::new();
    if let Some((study, simd)) = &stored {
        let resources = Resources { simd: *simd, threads: film::threads(args.threads) };
        again = sample(study, &records, args.rerun);
        for case in again.iter().map(|&place| &study.cases[place]) {
            output.note(format_args!("running {} again", case.id));
            let difference = match run_case(&case.config, None, resources, &Unwatched) {
                Ok(result) => first_difference(&args.dir, (study, &records), case, &result)?,
                Err(stopped) => Some(format!("it ended with {stopped}")),
            };
            told.extend(difference.map(|told| format!("{} run again: {told}", case.id)));
        }
    }
    let mut text = in_lines(&told, cases);
    match (args.rerun, again.len()) {
        (0, _) => {}
        (_, 0) => text.push_str("none ran again: no case of this study has ended well\n"),
        (_, count) => text.push_str(&format!("{} ran again, from rest\n", counted(count, "case"))),
    }
    let value = json!({ "cases": cases, "rerun": again.len(), "damage": told });
    output.result(&text, &value)?;
    Ok(if told.is_empty() { SUCCESS } else { CASES_FAILED })
}

fn in_lines(told: &[String], cases: usize) -> String {
    match told {
        [] => format!("{}: every file is as it was written\n", counted(cases, "case")),
        _ => told.iter().map(|line| format!("{line}\n")).collect(),
    }
}

/// Without the manifest nothing says what the other files should hold.
fn lost(what: &str, output: &Output) -> anyhow::Result<u8> {
    let told = format!("manifest.json {what}: `seawall sweep` of the same file makes it again");
    output.result(&format!("{told}\n"), &json!({ "cases": null, "rerun": 0, "damage": [told] }))?;
    Ok(CASES_FAILED)
}

/// Places of so many successful cases, evenly spread.
fn sample(study: &Study, records: &[Option<CaseRecord>], number: usize) -> Vec<usize> {
    let well = |record: &Option<CaseRecord>| record.as_ref().is_some_and(CaseRecord::is_ok);
    let places: Vec<_> = (0..study.cases.len()).filter(|&at| well(&records[at])).collect();
    let number = number.min(places.len());
    (0..number).map(|k| places[(2 * k + 1) * places.len() / (2 * number)]).collect()
}
