//! Error bars that are missing because companions failed, in words and for programs.

use serde_json::{Value, json};

use crate::math::words::counted;
use crate::report::as_typed;
use crate::results::CaseRecord;
use crate::study::{Case, Study};

/// A companion that failed, and why.
fn why((case, record): (&Case, &CaseRecord)) -> String {
    let spacing = as_typed(1e3 * case.config.numerics.particle_spacing_m);
    format!("the companion with particles {spacing} mm apart failed: {}", record.reason)
}

/// The line below a single case; none where no companion failed.
pub(super) fn of_case(
    study: &Study,
    own: &CaseRecord,
    records: &[Option<CaseRecord>],
) -> Option<String> {
    let failed = study.failed_companions(own, records).next()?;
    Some(format!("error bars: {}; --fresh runs both again", why(failed)))
}

/// The lines below the table of a study with these finished cases; empty where no companion failed.
pub(super) fn of_study<'a>(
    study: &'a Study,
    cases: impl Iterator<Item = &'a CaseRecord>,
    records: &'a [Option<CaseRecord>],
) -> String {
    let failed = |record| study.failed_companions(record, records).next();
    let mut failed = cases.filter_map(failed).peekable();
    let Some(first) = failed.peek().copied() else { return String::new() };
    let cases = failed.count();
    let lack = if cases == 1 { "lacks" } else { "lack" };
    format!(
        "{} {lack} a companion for error bars; --retry-failed runs it again\n  {}\n",
        counted(cases, "finished case"),
        why(first)
    )
}

/// The same of a case for programs.
pub(super) fn json(study: &Study, own: &CaseRecord, records: &[Option<CaseRecord>]) -> Value {
    let told = |(case, record): (&Case, &CaseRecord)| {
        json!({
            "case_id": case.id,
            "particle_spacing_m": case.config.numerics.particle_spacing_m,
            "failure": record.failure,
            "reason": record.reason,
        })
    };
    study.failed_companions(own, records).map(told).collect()
}
