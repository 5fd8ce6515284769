//! Whether journal and tables can carry every number: JSON has none that are not finite.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::simulation::CaseResult;

/// Makes sure that something comes back from JSON as it was.
pub(super) fn demand<T: Serialize + DeserializeOwned + PartialEq>(whole: &T) -> Result<(), String> {
    let text = serde_json::to_string(whole).map_err(|error| error.to_string())?;
    match serde_json::from_str::<T>(&text) {
        Ok(read) if read == *whole => Ok(()),
        _ => Err("not-a-number: a reported quantity is not a finite number".to_owned()),
    }
}

/// Makes sure of it for what a result leaves in the journal.
pub(super) fn demand_of(result: &CaseResult) -> Result<(), String> {
    let CaseResult { outcome, energy, readings, phases, .. } = result;
    demand(&(outcome.clone(), *energy, readings.clone(), phases.clone()))
}
