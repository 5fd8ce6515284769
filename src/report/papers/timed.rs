//! Whether a study's times per step can be compared with printed ones.

use serde_json::Value;

use super::cases::{Cases, of_scene, printed_for};
use super::computed;
use crate::papers::{Printed, printed};
use crate::report::load::Loaded;

/// Whether all cases ran one at a time, and each from rest. Cases that run at once slow each other.
/// A trunk's steps are counted in each of its cases, but its time in none.
pub fn tells_times(data: &Loaded) -> bool {
    let sessions = data.manifest.as_ref().and_then(|manifest| manifest.get("sessions")?.as_array());
    sessions.is_some_and(|all| !all.is_empty() && all.iter().all(is_timed))
}

fn is_timed(session: &Value) -> bool {
    let count = |of: &Value, name: &str| of.get(name)?.as_u64();
    let ranks = session.get("ranks").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let places = |rank: &Value| {
        Some(count(rank, "threads")? / count(rank, "threads_per_case").unwrap_or(1).max(1))
    };
    let branches = session.get("savings").and_then(|saved| count(saved, "branches"));
    matches!(ranks, [rank] if places(rank) == Some(1)) && branches == Some(0)
}

/// Why printed times per step are left out, if some of them would have a case here.
pub fn times_left_out(cases: &Cases) -> Option<String> {
    let all = of_scene(cases);
    let has_case = |number: &Printed| {
        let boundary = number.timed_boundary()?;
        let own = printed_for(number, &all);
        own.iter().find_map(|(row, _)| computed::step_time_ratio(row, boundary, &own))
    };
    let has_times = printed().iter().any(|number| has_case(number).is_some());
    (has_times && !tells_times(cases.data)).then(|| {
        "The times per step that are printed for these cases are left out. They are compared only where cases run \
         one at a time (--threads 1), and none starts from a stretch that it shares with others."
            .to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn study(threads: usize, branches: u64) -> Loaded {
        let ranks = [json!({ "host": "a", "threads": threads, "threads_per_case": 1 })];
        let savings = json!({ "trunks": branches.min(1), "branches": branches, "steps_computed": 9, "steps_from_rest": 9 });
        let manifest = json!({ "sessions": [{ "ranks": ranks, "savings": savings }] });
        Loaded { manifest: Some(manifest), ..Loaded::default() }
    }

    /// The story: a figure whose cases ran two at once, and shared the first part of their runs, told a step's time
    /// over another's, and called it met or not.
    #[test]
    fn times_are_told_of_cases_that_ran_alone_and_from_rest() {
        assert!(tells_times(&study(1, 0)));
        assert!(!tells_times(&study(2, 0)), "two at once");
        assert!(!tells_times(&study(1, 2)), "a trunk's steps are in both, its time in none");
        assert!(!tells_times(&Loaded::default()), "nobody knows");
    }
}
