//! `sweep` of a file with `[grid] refine`: adds points in rounds, and reports each round.

use std::path::Path;

use serde_json::{Value, json};

use super::failure::{BadFile, BadInput};
use super::job::Done;
use super::output::{Output, short};
use crate::accuracy::Refinement;
use crate::math::words::counted;
use crate::results::finished;
use crate::scene::ConfigError;
use crate::study::{Refine, Study, SweepFile};

/// The study that a directory holds, with the points of all rounds in its journal. If the file asks
/// for no rounds, its own study.
pub(super) fn study_in(directory: &Path, file: &SweepFile) -> anyhow::Result<Study> {
    let Some(refinement) = Refinement::of(file) else {
        return Ok(Study::new(file).map_err(|error| BadInput::of_stored(directory, &error))?);
    };
    let records = |study: &Study| finished(directory, study).map_err(anyhow::Error::from);
    refinement.so_far(records).map_err(|error| match error.downcast::<ConfigError>() {
        Ok(error) => BadInput::of_stored(directory, &error).into(),
        Err(error) => error,
    })
}

/// The study of the next round, which is reported; `None` where nothing is to be added.
pub(super) fn next(
    refinement: &Refinement,
    path: &Path,
    study: &Study,
    done: &Done,
    output: &Output,
) -> anyhow::Result<Option<Study>> {
    let next = refinement.next(study, done.directory.records()).map_err(BadFile::of(path))?;
    if let Some(next) = &next {
        let (points, asked) = (next.cases.len() - study.cases.len(), &refinement.asked);
        output.note(format_args!(
            "{} bends by more than {} between neighbours: {} to be added",
            asked.quantity,
            asked.to,
            counted(points, "point")
        ));
    }
    Ok(next)
}

/// What a finished study reached, for people and for programs.
pub(super) fn report(refinement: &Refinement, study: &Study, done: &Done) -> (String, Value) {
    let records = done.directory.records();
    let round = refinement.round(study, records);
    let next = refinement.next(study, records).ok().flatten();
    let pending = next.map_or(0, |next| next.cases.len() - study.cases.len());
    // Points that no scene allows stay open.
    let open = round.open + round.points.len() - pending;
    let (added, asked) = (refinement.count(study), &refinement.asked);
    let limit_hit = u64::try_from(added).is_ok_and(|added| added >= asked.most);
    let mut text = format!(
        "{} added where {} bends; linear interpolation is expected to be within {}",
        counted(added, "point"),
        asked.quantity,
        asked.to
    );
    if pending > 0 {
        let points = counted(pending, "more point");
        let are = if pending == 1 { "is" } else { "are" };
        text.push_str(&format!(" once {points} {are} in: the same command goes on"));
    }
    match (open, round.worst) {
        _ if pending > 0 => {}
        (0, _) => text.push_str(" along every line of the grid as written"),
        (open, worst) => {
            let open = counted(open, "interval");
            let worst = worst.filter(|&worst| worst > asked.to);
            let told = worst.map_or_else(
                || ", of which no third point tells".to_owned(),
                |worst| format!(", the worst {} off", short(worst)),
            );
            text.push_str(&format!(" in all but {open}{told}"));
        }
    }
    if round.unknown > 0 {
        let unknown = counted(round.unknown, "interval");
        text.push_str(&format!("; of {unknown} nothing can be told"));
    }
    text.push('\n');
    if limit_hit && open > 0 {
        let most = asked.most;
        text.push_str(&format!("grid.refine.most = {most} is reached: no more are allowed\n"));
    }
    let value = json!({
        "quantity": asked.quantity,
        "to": asked.to,
        "added": added,
        "pending": pending,
        "most": asked.most,
        "limit_hit": limit_hit && open > 0,
        "open_intervals": open,
        "unknown_intervals": round.unknown,
        "worst": round.worst,
    });
    (text, value)
}

/// The words of `check` for a study to which points will be added.
pub(super) fn ahead(asked: &Refine) -> String {
    format!(
        "adds up to {}, round by round, until {} is known to {} between neighbours",
        counted(usize::try_from(asked.most).unwrap_or(usize::MAX), "point"),
        asked.quantity,
        asked.to
    )
}
