//! Maps by the ids of cases.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use super::case::CaseId;

/// A map by ids. Ids are hashes already, so they are not hashed again. For a million cases this
/// saves time.
pub type CaseMap<T> = HashMap<CaseId, T, BuildHasherDefault<Own>>;

/// Uses an id as its own hash.
#[derive(Debug, Default)]
pub struct Own(u64);

impl Hasher for Own {
    fn write(&mut self, _: &[u8]) {
        unreachable!("an id is one number");
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = number;
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_found_again() {
        let ids: Vec<CaseId> = ["0000000000000000", "0000000000000001", "ffffffffffffffff"]
            .map(|id| id.parse().unwrap())
            .into();
        let map: CaseMap<usize> = ids.iter().copied().zip(0..).collect();
        assert!(ids.iter().enumerate().all(|(at, id)| map[id] == at));
    }
}
