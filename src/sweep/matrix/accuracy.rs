//! Errors against known answers and what they cost.

use super::super::record::CaseRecord;
use super::{Matrix, Pair, quantity};
use crate::simulation::Outcome;

/// The errors of one pair.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Scored {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub method: String,
    /// Percent of the truth; of the still water depth for levels. `None` where it has failed.
    pub force_error_percent: Option<f64>,
    /// Likewise.
    pub runup_error_percent: Option<f64>,
    /// Likewise.
    pub displacement_error_percent: Option<f64>,
    /// Processor time, seconds.
    pub cpu_time_s: Option<f64>,
    /// Why there are no errors.
    pub reason: String,
}

impl Scored {
    /// The errors there are.
    pub fn errors(&self) -> impl Iterator<Item = f64> {
        let all =
            [self.force_error_percent, self.runup_error_percent, self.displacement_error_percent];
        all.into_iter().flatten()
    }
}

/// One method over all cases.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MethodScore {
    /// Name of the method.
    pub method: String,
    /// Root mean square of all errors, percent; `None` where a case has failed.
    pub error_percent: Option<f64>,
    /// The largest error, percent.
    pub worst_percent: Option<f64>,
    /// Processor time of all cases, seconds.
    pub cpu_time_s: f64,
    /// Cases that failed.
    pub failed: usize,
    /// No other method is both cheaper and more accurate.
    pub pareto: bool,
}

/// Scores all pairs that this build can run.
pub fn score(matrix: &Matrix, pairs: &[Pair], records: &[Option<CaseRecord>]) -> Vec<Scored> {
    let scored = |pair: &Pair| {
        let record = records.get(*pair.run.as_ref().ok()?)?.as_ref()?;
        let case = &matrix.cases[pair.case];
        let outcome = record.outcome.as_ref();
        let worst = |stem: &str| outcome.and_then(|outcome| worst(outcome, &case.truth, stem));
        Some(Scored {
            case: case.name.clone(),
            method: matrix.methods[pair.method].name.clone(),
            force_error_percent: worst("force"),
            runup_error_percent: worst("runup"),
            displacement_error_percent: worst("displacement"),
            cpu_time_s: record.cpu_time_s.or(Some(record.wall_time_s)),
            reason: record.reason.clone(),
        })
    };
    pairs.iter().filter_map(scored).collect()
}

/// The largest error among the quantities of one kind, signed, percent.
fn worst(
    outcome: &Outcome,
    truth: &std::collections::BTreeMap<String, f64>,
    stem: &str,
) -> Option<f64> {
    let of_kind = truth.iter().filter(|(name, _)| name.contains(stem));
    let error = |(name, &exact): (&String, &f64)| {
        let scale = if stem == "runup" { 1.0 } else { exact.abs() };
        Some(100.0 * (quantity(outcome, name)? - exact) / scale)
    };
    of_kind.filter_map(error).max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Sums up each method, in the order of the matrix, and marks the Pareto front.
pub fn methods(matrix: &Matrix, scored: &[Scored]) -> Vec<MethodScore> {
    let mut scores: Vec<MethodScore> = Vec::new();
    for method in &matrix.methods {
        let rows: Vec<_> = scored.iter().filter(|row| row.method == method.name).collect();
        if rows.is_empty() {
            continue;
        }
        let errors: Vec<f64> = rows.iter().flat_map(|row| row.errors()).collect();
        let failed = rows.iter().filter(|row| row.errors().next().is_none()).count();
        let whole = failed == 0 && !errors.is_empty();
        let mean = errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64;
        scores.push(MethodScore {
            method: method.name.clone(),
            error_percent: whole.then(|| mean.sqrt()),
            worst_percent: whole.then(|| errors.iter().fold(0.0, |worst, e| e.abs().max(worst))),
            cpu_time_s: rows.iter().filter_map(|row| row.cpu_time_s).sum(),
            failed,
            pareto: false,
        });
    }
    let all = scores.clone();
    for score in &mut scores {
        let better = |other: &MethodScore| match (other.error_percent, score.error_percent) {
            (Some(a), Some(b)) => {
                a <= b
                    && other.cpu_time_s <= score.cpu_time_s
                    && (a < b || other.cpu_time_s < score.cpu_time_s)
            }
            _ => false,
        };
        score.pareto = score.error_percent.is_some() && !all.iter().any(better);
    }
    scores
}

/// The cheapest method whose error is within `percent`.
pub fn cheapest_within(scores: &[MethodScore], percent: f64) -> Option<&MethodScore> {
    let good = scores.iter().filter(|s| s.error_percent.is_some_and(|error| error <= percent));
    good.min_by(|a, b| a.cpu_time_s.total_cmp(&b.cpu_time_s))
}

#[cfg(test)]
mod tests {
    use super::super::tests::TEXT;
    use super::*;

    fn row(method: &str, error: Option<f64>, cpu: f64) -> Scored {
        Scored {
            case: "still".to_owned(),
            method: method.to_owned(),
            force_error_percent: error,
            runup_error_percent: None,
            displacement_error_percent: None,
            cpu_time_s: Some(cpu),
            reason: String::new(),
        }
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let matrix = Matrix::read(TEXT).unwrap();
        let rows = [
            row("plain", Some(-2.0), 1.0),
            row("odd", Some(3.0), 2.0),
            row("plain-again", Some(0.5), 9.0),
        ];
        let scores = methods(&matrix, &rows);
        let pareto: Vec<_> = scores.iter().map(|score| score.pareto).collect();
        assert_eq!(pareto, [true, false, true]);
        let best = |percent| cheapest_within(&scores, percent).map(|score| score.method.as_str());
        assert_eq!([best(10.0), best(1.0), best(0.1)], [Some("plain"), Some("plain-again"), None]);
        let failed = methods(&matrix, &[row("plain", None, 1.0)]);
        assert_eq!((failed[0].failed, failed[0].pareto), (1, false));
    }
}
