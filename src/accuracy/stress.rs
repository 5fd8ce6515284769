//! Verdicts on hard cases: criteria that are stated before the run, and how close to them it came.

use super::matrix::{Matrix, Trial};
use crate::results::CaseRecord;

/// The result of a pair.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It met every criterion.
    Passed,
    /// It ran to its end and missed a criterion.
    Missed,
    /// It failed with a typed reason.
    Failed,
    /// This build cannot run it.
    NotThere,
}

/// A row of the matrix of results.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Judged {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub method: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The largest share of a bound that it reached, of criteria and health; 1 is at the bound.
    pub edge: Option<f64>,
    /// The name of that bound, or why it failed or cannot run.
    pub reason: String,
    /// Wall time, seconds.
    pub wall_time_s: Option<f64>,
}

/// Judges all pairs; `records` are the study's.
pub fn judge(matrix: &Matrix, pairs: &[Trial], records: &[Option<CaseRecord>]) -> Vec<Judged> {
    let record = |pair: &Trial| records.get(*pair.run.as_ref().ok()?)?.as_ref();
    let of = |case: &str, method: usize| {
        let other = pairs.iter().find(|p| p.method == method && matrix.cases[p.case].name == case);
        other.and_then(record)
    };
    pairs.iter().map(|pair| one(matrix, pair, record(pair), &of)).collect()
}

fn one<'a>(
    matrix: &Matrix,
    pair: &Trial,
    record: Option<&CaseRecord>,
    of: &dyn Fn(&str, usize) -> Option<&'a CaseRecord>,
) -> Judged {
    let (case, method) = (&matrix.cases[pair.case], &matrix.methods[pair.method]);
    let mut judged = Judged {
        case: case.name.clone(),
        method: method.name.clone(),
        verdict: Verdict::NotThere,
        edge: None,
        reason: pair.run.as_ref().err().cloned().unwrap_or_default(),
        wall_time_s: record.map(|record| record.wall_time_s),
    };
    let Some(record) = record else { return judged };
    let Some(outcome) = &record.outcome else {
        judged.verdict = Verdict::Failed;
        judged.reason.clone_from(&record.reason);
        return judged;
    };
    let (share, bound) = outcome.health.closest();
    let mut shares = vec![(share, bound.to_owned())];
    for (quantity, &[low, high]) in &case.pass {
        let value = quantity.of(record);
        let share = value.map_or(f64::INFINITY, |value| used(value, low, high));
        let value = value.map_or("absent".to_owned(), |value| format!("{value:.4}"));
        shares.push((share, format!("{quantity} = {value} in [{low}, {high}]")));
    }
    if let Some(same) = &case.same {
        for quantity in &same.quantities {
            let other = of(&same.case, pair.method).and_then(|other| quantity.of(other));
            let gap = quantity.of(record).zip(other).map(|(a, b)| (a - b).abs() / b.abs());
            let share = gap.map_or(f64::INFINITY, |gap| gap / same.tolerance);
            let told = gap.map_or("absent".to_owned(), |gap| format!("{:.2} %", 100.0 * gap));
            shares.push((share, format!("{quantity} off {} by {told}", same.case)));
        }
    }
    let worst = shares.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    judged.verdict = if worst.0 <= 1.0 { Verdict::Passed } else { Verdict::Missed };
    judged.edge = Some(worst.0).filter(|edge| edge.is_finite());
    judged.reason = worst.1;
    if let Some(recovered) = &outcome.recovered {
        judged.reason = format!("{}; {recovered}", judged.reason);
    }
    judged
}

/// The position of a value in a range: 0 in its middle, 1 at its ends.
fn used(value: f64, low: f64, high: f64) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    if half > 0.0 {
        (value - middle).abs() / half
    } else if value == low {
        0.0
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::matrix::tests::TEXT;
    use super::*;
    use crate::results::made_up;
    use crate::simulation::{Failure, FailureKind};

    #[test]
    fn criteria_and_failures_become_verdicts() {
        let matrix = Matrix::read(TEXT).unwrap();
        let (study, pairs) = matrix.study(false, TEXT);
        let judged = |force_end: f64| {
            let still = &study.cases[0];
            let mut result = made_up(&still.config);
            result.outcome.force_end = force_end;
            let failure = Failure {
                kind: FailureKind::RunawaySpeed,
                time_s: 0.1,
                detail: "particle 3".to_owned(),
            };
            let records = [
                Some(CaseRecord::new(&study, still, &Ok(result), 1.0, "here")),
                Some(CaseRecord::new(&study, &study.cases[1], &Err(failure), 1.0, "here")),
            ];
            judge(&matrix, &pairs, &records)
        };
        let rows = judged(1.05);
        assert_eq!(
            (&rows[0].verdict, rows[0].edge.map(|e| (e * 100.0).round())),
            (&Verdict::Passed, Some(50.0))
        );
        assert_eq!(rows[1].verdict, Verdict::NotThere);
        assert_eq!(rows[3].verdict, Verdict::Failed);
        assert!(rows[3].reason.starts_with("runaway-speed"));
        assert_eq!(judged(1.2)[0].verdict, Verdict::Missed);
    }
}
