//! The study that an output directory holds, made again from its files.

use std::path::Path;

use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::{max_error, refine};
use crate::disk::names::{JOURNAL, MANIFEST, SUMMARY};
use crate::keys::named;
use crate::math::simd::SimdPath;
use crate::math::words::counted;
use crate::results::{Lock, Manifest, header_of, verify};
use crate::study::{Override, PHYSICS_VERSION, Study, SweepFile};

/// The study, and the instruction set that it was computed with.
pub(super) fn study(directory: &Path) -> anyhow::Result<(Study, SimdPath)> {
    let bad = |reason: String| BadInput::of(directory, reason);
    let (_, study) = file_and_study(directory)?;
    demand_output_of_study(directory, JOURNAL)?;
    let unfinished = || bad("the sweep was stopped before it began".to_owned());
    let simd = header_of(directory)?.ok_or_else(unfinished)?.simd;
    if !simd.is_supported() {
        let simd = crate::math::name::name_of(simd);
        return Err(bad(format!("was computed with {simd}, which this machine lacks")).into());
    }
    Ok((study, simd))
}

/// Refuses a directory without `summary.csv`, and says what makes it. `report` does from the journal where that has
/// every case; where cases are left, the sweep has to go on.
pub(super) fn demand_summary(directory: &Path) -> Result<(), BadInput> {
    demand_output_of_study(directory, SUMMARY).map_err(|error| {
        if !directory.join(JOURNAL).is_file() {
            return error;
        }
        let told = named(directory);
        let makes = match cases_left(directory) {
            _ if Lock::is_held(directory) => {
                format!("; what works here makes it (`seawall status {told}` tells how far it is)")
            }
            None => return error,
            Some([0, _]) => format!("; `seawall report {told}` makes it from the journal"),
            Some([left, all]) => format!(
                ", with {left} of {} left; `seawall sweep` or `run` of the same file goes on and makes it",
                counted(all, "case")
            ),
        };
        BadInput::of(directory, format!("has no {SUMMARY}{makes}"))
    })
}

/// How many cases of a study are left, those with a damaged file among them, and how many there are; `None` if the
/// study cannot be made again.
fn cases_left(directory: &Path) -> Option<[usize; 2]> {
    let (study, _) = study(directory).ok()?;
    let records = verify(directory, Some(&study)).ok()?.records;
    let cases = &records[..study.cases.len()];
    Some([cases.iter().filter(|case| case.is_none()).count(), cases.len()])
}

fn manifest_and_file(directory: &Path) -> anyhow::Result<(Manifest, SweepFile)> {
    let bad = |reason: String| BadInput::of(directory, reason);
    demand_output_of_study(directory, MANIFEST)?;
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
    let file = SweepFile::read(&manifest.sweep_file, &overrides)
        .map_err(|error| BadInput::of_stored(directory, &error))?;
    Ok((manifest, file))
}

/// The file that a directory was made from, with the settings of the command line, and its study.
pub(super) fn file_and_study(directory: &Path) -> anyhow::Result<(SweepFile, Study)> {
    let bad = |reason: String| BadInput::of(directory, reason);
    let (manifest, file) = manifest_and_file(directory)?;
    let plain = refine::study_in(directory, &file)?;
    let aim = manifest.max_error_percent.or(plain.max_error_percent);
    let study = match aim.filter(|_| plain.identity != manifest.sweep) {
        Some(percent) => max_error::stored(percent, &plain, directory)?,
        None => plain,
    };
    if study.identity != manifest.sweep {
        let mut reason =
            "its cases are not those of the sweep file in its manifest.json".to_owned();
        if file.names_stroke() {
            reason.push_str("; scene.recorded_stroke names a file that may have changed since");
        }
        return Err(bad(reason).into());
    }
    Ok((file, study))
}

/// Why a directory's study cannot be made again: the file of its recorded stroke is not where the
/// sweep file says. `None` if there is another reason, or none.
pub(super) fn missing_stroke(directory: &Path) -> Option<String> {
    let (_, file) = manifest_and_file(directory).ok()?;
    let (section, path) = file.missing_stroke()?;
    let from = match path.is_relative() {
        true => ", sought from the folder where the program was started",
        false => "",
    };
    Some(format!("{section}.recorded_stroke: there is no file {}{from}", named(path)))
}

/// The study as its sweep goes on with it, if its rounds add points or choose finer numerics;
/// `None` for other studies.
pub(super) fn in_rounds(directory: &Path) -> anyhow::Result<Option<Study>> {
    let (manifest, file) = manifest_and_file(directory)?;
    let aim = manifest.max_error_percent.or(file.max_error_percent);
    if file.refine.is_none() && aim.is_none() {
        return Ok(None);
    }
    let (_, study) = file_and_study(directory)?;
    Ok(Some(match aim {
        Some(percent) => max_error::next(percent, study, directory)?,
        None => study,
    }))
}
