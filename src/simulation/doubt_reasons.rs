//! The text of a doubtful case. Reasons are separated by semicolons. Each starts with its kind and
//! a colon.

use serde::{Deserialize, Deserializer};

/// The kind of a maximum at the end of the run.
pub(super) const END_OF_RUN: &str = "end of run";

/// The kinds of the reasons for which a case is doubtful.
pub fn kinds_of_doubt(told: &str) -> impl Iterator<Item = &str> {
    told.split("; ").filter_map(|reason| Some(reason.split_once(": ")?.0))
}

/// Whether the same case with finer particles may be free of these reasons. It may, unless the run
/// ends too early.
pub fn finer_particles_may_clear(told: &str) -> bool {
    kinds_of_doubt(told).all(|kind| kind != END_OF_RUN)
}

/// Reads the reasons from a journal. Earlier versions had coarse particles among them. These affect
/// all numbers alike, and now have a column of their own.
pub(super) fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    let told = Option::<String>::deserialize(from)?.unwrap_or_default();
    let others = told.split("; ").filter(|reason| !reason.starts_with("coarse spacing: "));
    let others = others.collect::<Vec<_>>().join("; ");
    Ok((!others.is_empty()).then_some(others))
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_journal_that_counted_coarse_particles_among_the_reasons_is_read_without() {
        let read = |told: &str| super::read(serde_json::json!(told)).unwrap();
        let coarse = "coarse spacing: 8.0 rows of particles over the depth";
        assert_eq!(read(coarse), None);
        assert_eq!(
            read(&format!("{coarse}; energy: a; force gap: b")).unwrap(),
            "energy: a; force gap: b"
        );
        assert_eq!(read("energy: a").unwrap(), "energy: a");
        assert_eq!(super::read(serde_json::Value::Null).unwrap(), None);
    }
}
