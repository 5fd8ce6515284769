//! Bad input, told in one line: which key, which value, what is allowed.

/// A value that a scene or sweep file may not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}{}: {allowed}", if value.is_empty() { String::new() } else { format!(" = {value}") })]
pub struct ConfigError {
    /// Dotted path of the key, such as `numerics.particle_spacing_m`.
    pub key: String,
    /// The offending value as written, empty where the key is missing or unknown.
    pub value: String,
    /// What is wrong and what is allowed.
    pub allowed: String,
}

impl ConfigError {
    /// An error about the value of a key.
    pub fn new(key: &str, value: impl ToString, allowed: impl Into<String>) -> Self {
        ConfigError { key: key.to_owned(), value: value.to_string(), allowed: allowed.into() }
    }

    /// An unknown key, with the nearest known one.
    pub fn unknown(key: &str, known: &[String]) -> Self {
        let leaf = key.rsplit('.').next().unwrap_or(key);
        let nearest = known
            .iter()
            .max_by(|a, b| strsim::jaro_winkler(leaf, a).total_cmp(&strsim::jaro_winkler(leaf, b)));
        let hint = nearest.map(|n| format!("; did you mean {n}?")).unwrap_or_default();
        ConfigError::new(key, "", format!("unknown key{hint}"))
    }
}
