//! `seawall report`: tables and figures from files alone.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::failure::not_writable;
use super::input::demand_output_of_study;
use super::notices::hold_making;
use super::options::{FigureFormat, for_print};
use super::output::{Output, json_path, json_paths};
use super::{CASES_FAILED, SUCCESS, stored};
use crate::disk::names::{FIGURES, JOURNAL, SUMMARY, TABLES};
use crate::keys::named;
use crate::math::words::counted;
use crate::report::{Froude, Omitted, Written};
use crate::results::{
    Closing, Derived, Lock, MADE_BY_SWEEPS, Manifest, SweepError, Verified, renew_tables, verify,
    write_sound_histories,
};

/// Write tables, figures and report.html from the files of a study. Nothing is simulated.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall report results/runs/nightly
  seawall report results/runs/nightly --figures pdf,png
  seawall report results/runs/nightly --froude-scale 20

Exit code: 0, or 1 where a file of a case is damaged or missing and was left out.")]
pub(super) struct ReportArgs {
    /// The output directory of a sweep.
    dir: PathBuf,
    /// Formats of the figures, such as svg,pdf. PDF and PNG come in a journal's widths of 84 and 174 mm.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "FORMAT", default_value = "svg")]
    figures: Vec<FigureFormat>,
    /// Add tables for a prototype that is so many times as large as the tank, in kPa, kN/m, m and s.
    #[arg(long, value_name = "SCALE", allow_negative_numbers = true)]
    froude_scale: Option<Froude>,
}

pub(super) fn main(args: &ReportArgs, output: &Output) -> anyhow::Result<u8> {
    // The report is made from the journal, if there is one.
    let from = if args.dir.join(JOURNAL).is_file() { JOURNAL } else { SUMMARY };
    demand_output_of_study(&args.dir, from)?;
    let formats = for_print(&args.figures)?;
    let _making = hold_making(&args.dir, output);
    let closing = Closing::read(&args.dir);
    let damaged = if closing.is_none() { renew(args, output)? } else { Vec::new() };
    stored::demand_summary(&args.dir)?;
    let omitted = Omitted::from(damaged);
    Derived::begin(&args.dir, MADE_BY_SWEEPS).map_err(not_writable)?;
    let written = crate::report::write_with(&args.dir, args.froude_scale, &formats, &omitted);
    let Written { page: report, printed: figures, made } = written.map_err(not_writable)?;
    let spare = |path: &Path, error: &SweepError| omitted.add(path, error);
    write_sound_histories(&args.dir, &|path| omitted.has(path), &spare).map_err(not_writable)?;
    Derived::end(&args.dir, &made, false).map_err(not_writable)?;
    let (left_out, found) = omitted.count_and_faults();
    for found in found {
        output.note(found);
    }
    if left_out > 0 {
        let files = counted(left_out, "file");
        output.note(format_args!(
            "{files} left out: the same `seawall sweep` or `run` makes them again"
        ));
    }
    // What is wrong in a closed study is mended once it is read again.
    if let Some(closing) = closing.filter(|_| left_out == 0) {
        closing.write(&args.dir)?;
    }
    let mut told = format!("report: {}\n", named(&report));
    let prototype = args.froude_scale.map(|scale| scale.words());
    if let Some(scale) = &prototype {
        let tables = Froude::TABLES.map(|name| args.dir.join(TABLES).join(format!("{name}.csv")));
        let made: Vec<_> = tables.iter().filter(|path| path.is_file()).collect();
        for path in &made {
            told.push_str(&format!("at Froude scale {scale}: {}\n", named(path)));
        }
        if made.is_empty() {
            output.note(
                "--froude-scale: no finished case here has a seawall in a tank of known depth",
            );
        }
    }
    if !figures.is_empty() {
        let files = counted(figures.len(), "file");
        told.push_str(&format!(
            "figures for print: {files} in {}\n",
            named(&args.dir.join(FIGURES))
        ));
    }
    output.result(
        &told,
        &json!({
            "report": json_path(&report),
            "figures": json_paths(&figures),
            "froude_scale": prototype,
            "left_out": left_out
        }),
    )?;
    Ok(if left_out == 0 { SUCCESS } else { CASES_FAILED })
}

/// Makes tables again that differ from the journal. They stay as they are if the directory does not
/// hold its whole study, or if that cannot be made again. Returns files of cases that are damaged or missing.
fn renew(args: &ReportArgs, output: &Output) -> anyhow::Result<Vec<PathBuf>> {
    if Lock::is_held(&args.dir) {
        return Ok(Vec::new());
    }
    if Manifest::read(&args.dir).is_none() {
        output.note("manifest.json is missing or damaged: the page says nothing of where its numbers come from");
    }
    let study = match stored::study(&args.dir) {
        Ok((study, _)) => Some(study),
        Err(_) if !args.dir.join(JOURNAL).is_file() => return Ok(Vec::new()),
        Err(error) => {
            if Manifest::damage(&args.dir).is_none() {
                let why = stored::missing_stroke(&args.dir).unwrap_or_else(|| format!("{error:#}"));
                output.note(format_args!("summary.csv is not compared with the journal: {why}"));
            }
            None
        }
    };
    let Verified { told, damaged, records, .. } = verify(&args.dir, study.as_ref())?;
    for told in told {
        output.note(told);
    }
    if let Some(study) = study {
        for table in renew_tables(&args.dir, &study, &records).map_err(not_writable)? {
            output.note(format_args!("{table}: made again from the journal"));
        }
    }
    Ok(damaged)
}
