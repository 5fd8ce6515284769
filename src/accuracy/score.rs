//! Errors against known answers and what they cost.

use std::collections::BTreeMap;

use super::matrix::{Matrix, Trial};
use super::quantity::{Kind, Quantity};
use crate::quantities::accuracy::Errors;
use crate::results::CaseRecord;

/// The errors of one pair.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Scored {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub method: String,
    /// Percent of the truth; for levels percent of the still water depth. `None` if it failed.
    pub force_error_percent: Option<f64>,
    /// Likewise.
    pub runup_error_percent: Option<f64>,
    /// Likewise.
    pub displacement_error_percent: Option<f64>,
    /// Of all other quantities, which are readings of the scene: periods, decay, axes, fronts.
    pub flow_error_percent: Option<f64>,
    /// Processor time, seconds.
    pub cpu_time_s: Option<f64>,
    /// Why there are no errors.
    pub reason: String,
}

impl Scored {
    /// All errors.
    pub fn errors(&self) -> impl Iterator<Item = f64> {
        self.loads().chain(self.runup_error_percent).chain(self.flow_error_percent)
    }

    /// Those of force and displacement.
    pub fn loads(&self) -> impl Iterator<Item = f64> {
        [self.force_error_percent, self.displacement_error_percent].into_iter().flatten()
    }
}

/// One method over all cases.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MethodScore {
    /// Name of the method.
    pub method: String,
    /// Root mean square of all errors, percent; `None` if a case failed.
    pub error_percent: Option<f64>,
    /// The largest error, percent.
    pub worst_percent: Option<f64>,
    /// Processor time of all cases, seconds.
    pub cpu_time_s: f64,
    /// Cases that failed.
    pub failed: usize,
    /// Whether no other method is both cheaper and more accurate.
    pub pareto: bool,
}

/// Scores all pairs that this build can run, except those taken for the truth.
pub fn score(matrix: &Matrix, pairs: &[Trial], records: &[Option<CaseRecord>]) -> Vec<Scored> {
    let record = |pair: &Trial| records.get(*pair.run.as_ref().ok()?)?.as_ref();
    let scored = |pair: &Trial| {
        let (case, method) = (&matrix.cases[pair.case], &matrix.methods[pair.method]);
        let mut truth = case.truth.clone();
        if let Some(reference) = &case.reference {
            if reference.method == method.name {
                return None;
            }
            let is_it = |other: &&Trial| {
                other.case == pair.case && matrix.methods[other.method].name == reference.method
            };
            let finest = pairs.iter().find(is_it).and_then(record);
            let value = |quantity: &Quantity| Some((quantity.clone(), quantity.of(finest?)?));
            truth.extend(reference.quantities.iter().filter_map(value));
        }
        let record = record(pair)?;
        let worst = |kinds: &[Kind]| worst(record, &truth, kinds);
        Some(Scored {
            case: case.name.clone(),
            method: method.name.clone(),
            force_error_percent: worst(&[Kind::Force]),
            runup_error_percent: worst(&[Kind::Runup]),
            displacement_error_percent: worst(&[Kind::Displacement]),
            flow_error_percent: worst(&[Kind::Flow, Kind::Gap]),
            cpu_time_s: record.cpu_time_s.or(Some(record.wall_time_s)),
            reason: record.reason.clone(),
        })
    };
    pairs.iter().filter_map(scored).collect()
}

/// The largest error among the quantities of some kinds, signed, percent.
fn worst(record: &CaseRecord, truth: &BTreeMap<Quantity, f64>, kinds: &[Kind]) -> Option<f64> {
    let of_kind = truth.iter().filter(|(quantity, _)| kinds.contains(&quantity.kind()));
    let errors = of_kind.filter_map(|(quantity, &exact)| quantity.error_percent(record, exact));
    errors.max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Sums up each method that runs on every case, in the order of the matrix, and marks the Pareto
/// front.
pub fn methods(matrix: &Matrix, scored: &[Scored], group: Errors) -> Vec<MethodScore> {
    let mut scores: Vec<MethodScore> = Vec::new();
    let has_loads =
        |case: &str| scored.iter().any(|row| row.case == case && row.loads().next().is_some());
    for method in matrix.methods.iter().filter(|method| method.cases.is_none()) {
        let counts = |row: &&Scored| group == Errors::All || has_loads(&row.case);
        let rows = scored.iter().filter(|row| row.method == method.name);
        let rows: Vec<_> = rows.filter(counts).collect();
        if rows.is_empty() {
            continue;
        }
        let errors = |row: &Scored| match group {
            Errors::All => row.errors().collect::<Vec<f64>>(),
            Errors::Loads => row.loads().collect(),
        };
        let failed = rows.iter().filter(|row| errors(row).is_empty()).count();
        let errors: Vec<f64> = rows.iter().flat_map(|row| errors(row)).collect();
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

#[cfg(test)]
mod tests {
    use super::super::matrix::tests::TEXT;
    use super::*;
    use crate::results::made_up;
    use crate::simulation::NamedReading;

    fn row(method: &str, error: Option<f64>, cpu: f64) -> Scored {
        Scored {
            case: "still".to_owned(),
            method: method.to_owned(),
            force_error_percent: error,
            runup_error_percent: None,
            displacement_error_percent: None,
            flow_error_percent: None,
            cpu_time_s: Some(cpu),
            reason: String::new(),
        }
    }

    #[test]
    fn a_gap_is_an_error_as_it_stands_and_others_are_relative() {
        let kind = |name: &str| Quantity::from(name.to_owned()).kind();
        let names = ["period_gap", "first_runup_max", "force_end", "runup_time", "arm"];
        let kinds = [Kind::Gap, Kind::Runup, Kind::Force, Kind::Flow, Kind::Flow];
        assert_eq!(names.map(kind), kinds);
        let matrix = Matrix::read(TEXT).unwrap();
        let (study, pairs) = matrix.study(false, TEXT);
        let still = &study.cases[0];
        let mut result = made_up(&still.config);
        result.outcome.force_end = 1.02;
        result.readings = vec![
            NamedReading::new("period_gap", -0.4, "%"),
            NamedReading::new("front_at_1.5", 2.2, "H"),
        ];
        let record = CaseRecord::new(&study, still, &Ok(result), 1.0, "here");
        let truth = [("force_end", 1.0), ("period_gap", 0.0), ("front_at_1.5", 2.0)];
        let truth = truth.map(|(name, value)| (name.to_owned().into(), value)).into();
        let off = |kinds| worst(&record, &truth, kinds).unwrap();
        assert!((off(&[Kind::Force]) - 2.0).abs() < 1e-9);
        assert!((off(&[Kind::Flow, Kind::Gap]) - 10.0).abs() < 1e-9);
        assert_eq!(worst(&record, &truth, &[Kind::Runup]), None);
        let rows = score(&matrix, &pairs, &[Some(record), None]);
        assert_eq!(rows.len(), 2, "two methods of the same numerics share a run");
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let matrix = Matrix::read(TEXT).unwrap();
        let rows = [
            row("plain", Some(-2.0), 1.0),
            row("odd", Some(3.0), 2.0),
            row("plain-again", Some(0.5), 9.0),
        ];
        let scores = methods(&matrix, &rows, Errors::All);
        let pareto: Vec<_> = scores.iter().map(|score| score.pareto).collect();
        assert_eq!(pareto, [true, false, true]);
        let failed = methods(&matrix, &[row("plain", None, 1.0)], Errors::All);
        assert_eq!((failed[0].failed, failed[0].pareto), (1, false));
    }
}
