//! The journal's data of a case.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::ended::{Ended, Line};
use super::filing::Filed;
use super::seal::{Seal, Seals};
use super::wanted::Wanted;
use crate::simulation::{
    CaseResult, EnergyBudget, Failure, FailureKind, NamedReading, Outcome, PhaseShare,
};
use crate::study::{Case, CaseId, Study};

/// One finished case: a journal line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Index in grid order.
    pub index: usize,
    /// Identity.
    pub id: CaseId,
    /// Swept keys and their values.
    pub values: BTreeMap<String, serde_json::Value>,
    /// `None` if the case is ok.
    pub failure: Option<FailureKind>,
    /// Why it failed, in one line. If it is ok, the failure from which it recovered; usually empty.
    pub reason: String,
    /// The scalars, if the case is ok.
    pub outcome: Option<Outcome>,
    /// The energy budget, if the case is ok.
    pub energy: Option<EnergyBudget>,
    /// Other readings of the scene, if the case is ok.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub readings: Vec<NamedReading>,
    /// The time of each phase; a trunk's time is not included.
    pub phases: Vec<PhaseShare>,
    /// Wall time, seconds; a trunk's is not included.
    pub wall_time_s: f64,
    /// Processor time, seconds, if the system provides it; a trunk's is not included.
    #[serde(default)]
    pub cpu_time_s: Option<f64>,
    /// Where it ran.
    pub host: String,
    /// Seals of its files from when they were written, by folder.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, Seal>,
}

/// A journal line as far as a process keeps it, with its data on files. Reading the rest takes as
/// long again.
#[derive(Debug, Deserialize)]
pub(super) struct HeldLine {
    id: CaseId,
    failure: Option<FailureKind>,
    reason: String,
    outcome: Option<Outcome>,
    energy: Option<EnergyBudget>,
    #[serde(default)]
    readings: Vec<NamedReading>,
    wall_time_s: f64,
    #[serde(default)]
    cpu_time_s: Option<f64>,
    #[serde(default)]
    files: Seals,
}

impl Wanted for CaseRecord {}

impl Wanted for HeldLine {}

impl Wanted for Fared {
    const UNWANTED: Option<[&'static str; 2]> = Some([",\"outcome\":", ",\"wall_time_s\":"]);
}

impl Line for HeldLine {
    type Held = CaseRecord;

    fn ended(&self) -> Ended {
        Ended { id: self.id, is_ok: self.failure.is_none() }
    }

    fn split(self, index: usize) -> (CaseRecord, Seals) {
        let record = CaseRecord {
            failure: self.failure,
            reason: self.reason,
            outcome: self.outcome,
            energy: self.energy,
            readings: self.readings,
            cpu_time_s: self.cpu_time_s,
            ..CaseRecord::blank(index, self.id, self.wall_time_s, "")
        };
        (record, self.files)
    }
}

/// A journal line as far as it shows the state of a sweep.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Fared {
    /// Index in grid order, if no points were added.
    pub index: usize,
    /// Identity.
    pub id: CaseId,
    /// Swept keys and their values.
    pub values: BTreeMap<String, serde_json::Value>,
    /// `None` if the case is ok.
    pub failure: Option<FailureKind>,
    /// Why it failed.
    pub reason: String,
    /// Wall time, seconds.
    pub wall_time_s: f64,
}

impl Fared {
    /// For a case that is ok, index and time are enough.
    pub fn trimmed(self) -> Fared {
        if self.failure.is_some() {
            return self;
        }
        Fared { values: BTreeMap::new(), reason: String::new(), ..self }
    }
}

impl CaseRecord {
    /// The record of a case that has just ended. A result with a NaN or an infinite number is a
    /// failure, because neither the journal nor the tables can hold it.
    pub fn new(
        study: &Study,
        case: &Case,
        result: &Result<CaseResult, Failure>,
        wall_time_s: f64,
        host: &str,
    ) -> CaseRecord {
        let (kind, reason) = match result {
            Ok(result) => match Filed::of(result) {
                Ok(filed) => {
                    return CaseRecord::of_filed(study, case, &filed, wall_time_s, host);
                }
                Err(reason) => (FailureKind::NotANumber, reason),
            },
            Err(failure) => (failure.kind, failure.to_string()),
        };
        CaseRecord {
            values: study.values(case).into_iter().collect(),
            failure: Some(kind),
            reason: one_line(&reason),
            ..CaseRecord::blank(case.index, case.id, wall_time_s, host)
        }
    }

    /// The record of a case whose files were written where it ran.
    pub fn of_filed(
        study: &Study,
        case: &Case,
        filed: &Filed,
        wall_time_s: f64,
        host: &str,
    ) -> CaseRecord {
        CaseRecord {
            values: study.values(case).into_iter().collect(),
            reason: one_line(filed.outcome.recovered.as_deref().unwrap_or_default()),
            outcome: Some(filed.outcome.clone()),
            energy: Some(filed.energy),
            readings: filed.readings.clone(),
            phases: filed.phases.clone(),
            files: filed.seals.clone(),
            ..CaseRecord::blank(case.index, case.id, wall_time_s, host)
        }
    }

    fn blank(index: usize, id: CaseId, wall_time_s: f64, host: &str) -> CaseRecord {
        CaseRecord {
            index,
            id,
            values: BTreeMap::new(),
            failure: None,
            reason: String::new(),
            outcome: None,
            energy: None,
            readings: Vec::new(),
            phases: Vec::new(),
            wall_time_s,
            cpu_time_s: None,
            host: host.to_owned(),
            files: BTreeMap::new(),
        }
    }

    /// Whether the case is ok.
    pub fn is_ok(&self) -> bool {
        self.failure.is_none()
    }
}

/// Line breaks and other control characters become spaces.
fn one_line(text: &str) -> String {
    text.split(|c: char| c.is_control() || c == '\u{2028}' || c == '\u{2029}')
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests;
