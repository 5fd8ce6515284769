//! A study: all cases of a file, and the identity that guards its output directory.

use sha2::{Digest, Sha256};

use super::case::Case;
use super::file::SweepFile;
use super::grid;
use crate::scene::ConfigError;

/// A validated sweep, ready to be planned.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name.
    pub name: String,
    /// The swept keys, in the order of the file.
    pub keys: Vec<String>,
    /// The cases, in grid order.
    pub cases: Vec<Case>,
    /// Hash over the cases and their order: two files with the same identity are the same sweep.
    pub identity: String,
    /// The file as written.
    pub file_text: String,
}

impl Study {
    /// Expands and validates a file.
    ///
    /// # Errors
    /// The first bad value of the first bad case.
    pub fn new(file: &SweepFile) -> Result<Study, ConfigError> {
        let cases = grid::expand(file)?;
        let keys: Vec<String> = file.grid.iter().map(|axis| axis.key.clone()).collect();
        let mut hash = Sha256::new();
        hash.update(keys.join(","));
        for case in &cases {
            hash.update(case.id.to_string());
        }
        let identity = hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Study { name: file.name.clone(), keys, cases, identity, file_text: file.text.clone() })
    }

    /// A case's swept keys and values, for files: `None` where a key means nothing to the case.
    pub fn values(&self, case: &Case) -> Vec<(String, serde_json::Value)> {
        let value = |value: &toml::Value| serde_json::to_value(value).unwrap_or_default();
        let pairs = self.keys.iter().zip(&case.assignments);
        pairs.filter_map(|(key, set)| Some((key.clone(), value(set.as_ref()?)))).collect()
    }
}
