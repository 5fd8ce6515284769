//! The answer of `seawall find` for programs.

use serde_json::{Map, Value, json};

use super::Answer;
use crate::report::find::{Boundary, Number, Verdict};

impl Answer<'_> {
    /// The answer for programs.
    pub(in crate::cli) fn value(&self) -> Value {
        let rows = |verdict| self.found.rows(verdict).map(|row| self.case(row)).collect::<Vec<_>>();
        let met = rows(Verdict::Met);
        json!({
            "condition": self.found.condition.to_string(),
            "cases": self.data.rows.len(),
            "met": met.len(),
            "not_met": self.found.rows(Verdict::NotMet).count(),
            "meeting": met,
            "unknown": rows(Verdict::Unknown),
            "boundaries": self.found.boundaries.iter().map(|one| self.end(one)).collect::<Vec<_>>(),
        })
    }

    fn swept(&self, row: usize, but: Option<usize>) -> Map<String, Value> {
        let keys = self.data.keys.iter().enumerate().filter(|(key, _)| Some(*key) != but);
        let cell = |cell: &str| match cell {
            "" => Value::Null,
            cell => cell.parse::<f64>().map_or_else(|_| cell.into(), Value::from),
        };
        keys.map(|(_, key)| (key.name.clone(), cell(&key.cells[row]))).collect()
    }

    fn case(&self, row: usize) -> Value {
        let value = |reading: Number| match reading {
            Number::Value { value, bar, bound } => {
                json!({ "value": value, "error": bar, "bound": bound })
            }
            Number::Missing | Number::Failed => Value::Null,
        };
        let subjects = self.found.condition.0.iter().map(|comparison| &comparison.subject);
        let values: Map<_, _> =
            subjects.map(|one| (one.name.clone(), value(one.readings[row]))).collect();
        json!({
            "case_id": self.data.rows[row].id(),
            "swept": self.swept(row, None),
            "values": values,
            "within_error_bar": self.found.condition.is_near(row),
            "doubtful": self.is_doubtful(row),
            "hits_stop": self.stops(row),
            "reason": Some(self.found.why(row)).filter(|why| !why.is_empty()),
        })
    }

    fn end(&self, one: &Boundary) -> Value {
        json!({
            "key": self.data.keys[one.key].name,
            "scale": one.scale,
            "where": self.swept(one.row, Some(one.key)),
            "met": if one.met_above { "above" } else { "below" },
            "at": one.at,
            "from": one.between[0],
            "to": one.between[1],
            "basis": one.basis,
            "doubtful": one.doubtful,
        })
    }
}
