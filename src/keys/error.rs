//! Errors of bad input in one line: the key, the value, what is allowed.

/// A value that a scene or sweep file may not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}{}: {allowed}", assigned(value))]
pub struct ConfigError {
    /// Dotted path of the key, such as `numerics.particle_spacing_m`.
    pub key: String,
    /// The value as written; empty if the key is missing or unknown.
    pub value: String,
    /// What is wrong and what is allowed.
    pub allowed: String,
}

/// A longer value is cut in messages.
const LONGEST: usize = 120;
/// Characters kept of the start and of the end of a cut value.
const KEPT: [usize; 2] = [60, 40];
/// A number of more digits is written with a power of ten.
const DIGITS: usize = 24;

/// A text of more than `longest` characters, cut: its start, its end, and its length.
pub fn cut(text: &str, longest: usize) -> Option<String> {
    let length = text.chars().count();
    if length <= longest {
        return None;
    }
    let start: String = text.chars().take(KEPT[0]).collect();
    let end: String = text.chars().skip(length.saturating_sub(KEPT[1])).collect();
    Some(format!("{start} ... {end} ({length} characters)"))
}

/// A value for people. A number of many digits gets a power of ten; a long text is cut.
pub fn shortened(value: &str) -> String {
    let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
    let short = number.filter(|_| value.len() > DIGITS).map(|number| format!("{number:e}"));
    short.or_else(|| cut(value, LONGEST)).unwrap_or_else(|| value.to_owned())
}

/// A value after its key.
fn assigned(value: &str) -> String {
    if value.is_empty() { String::new() } else { format!(" = {}", shortened(value)) }
}

impl ConfigError {
    /// An error about the value of a key.
    pub fn new(key: &str, value: impl ToString, allowed: impl Into<String>) -> Self {
        ConfigError { key: key.to_owned(), value: value.to_string(), allowed: allowed.into() }
    }

    /// An unknown key, with the nearest known one if one is near.
    pub fn unknown(key: &str, known: &[impl AsRef<str>]) -> Self {
        ConfigError::new(key, "", format!("unknown key{}", hint(leaf(key), known)))
    }

    /// The same for a table in a file. If no known key is near, it names all keys, or the place
    /// where they are listed.
    pub fn unknown_in_table(key: &str, known: &[impl AsRef<str>]) -> Self {
        let error = ConfigError::unknown(key, known);
        if !hint(leaf(key), known).is_empty() {
            return error;
        }
        let known: Vec<_> = known.iter().map(AsRef::as_ref).collect();
        let taken = match known.len() {
            0..=FEW => format!("; must be one of {}", known.join(", ")),
            _ => " (`seawall explain` lists all)".to_owned(),
        };
        ConfigError { allowed: error.allowed + &taken, ..error }
    }

    /// A key in the wrong place, and the path at which it is known.
    pub fn misplaced(key: &str, path: &str) -> Self {
        ConfigError::new(key, "", format!("unknown key; did you mean {path}?"))
    }

    /// A value that is none of the names of its key, with the nearest if one is near.
    pub fn one_of(key: &str, value: &toml::Value, names: &[impl AsRef<str>]) -> Self {
        let hint = value.as_str().map(|word| hint(word, names)).unwrap_or_default();
        let names: Vec<_> = names.iter().map(AsRef::as_ref).collect();
        ConfigError::new(key, value, format!("must be one of {}{hint}", names.join(", ")))
    }
}

/// The last part of a dotted path.
fn leaf(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// At most this many keys are named if none is near.
const FEW: usize = 8;

/// From this likeness on (1 is the same word) a word may be a misspelling of another.
const NEAR: f64 = 0.88;

/// `; did you mean X?`, or nothing if no known word is near.
pub fn hint(word: &str, known: &[impl AsRef<str>]) -> String {
    let nearest = ranked(word, known).filter(|&(likeness, _)| likeness >= NEAR);
    nearest.map(|(_, known)| format!("; did you mean {known}?")).unwrap_or_default()
}

/// The known word that is most like a word, with its likeness.
fn ranked<'a>(word: &str, known: &'a [impl AsRef<str>]) -> Option<(f64, &'a str)> {
    let word = word.to_lowercase();
    let likeness = |known: &str| {
        // A part of the right word, such as `stiffness`, is near, however long the rest is; the
        // shorter the rest, the nearer.
        let known = known.to_lowercase();
        let share = 0.1 * word.len() as f64 / known.len() as f64;
        let part = if word.len() >= 4 && known.contains(&word) { NEAR + share } else { 0.0 };
        strsim::jaro_winkler(&word, &known).max(part)
    };
    // Of equally near words the first in the list is taken, because the usual ones come first.
    let all = known.iter().rev().map(AsRef::as_ref);
    all.map(|known| (likeness(known), known)).max_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_values_are_cut() {
        let told =
            |value: &dyn ToString| ConfigError::new("k", value.to_string(), "no").to_string();
        assert_eq!(
            [told(&1e-308), told(&1e300), told(&0.25)],
            ["k = 1e-308: no", "k = 1e300: no", "k = 0.25: no"]
        );
        assert_eq!(told(&""), "k: no");
        let cut = told(&format!("{}end", "x y".repeat(1000)));
        assert!(cut.len() < 150 && cut.starts_with("k = x yx"), "{cut}");
        assert!(cut.ends_with("yend (3003 characters): no"), "{cut}");
    }

    #[test]
    fn only_near_words_are_suggested() {
        let known = [
            "spring_stiffness_n_per_m",
            "tank_length_m",
            "wall",
            "artificial_viscosity",
            "kinematic_viscosity_m2_per_s",
        ];
        for (word, nearest) in [
            ("spring_stifness_n_per_m", "spring_stiffness_n_per_m"),
            ("stiffness", "spring_stiffness_n_per_m"),
            ("viscosity", "artificial_viscosity"),
            ("wal", "wall"),
            ("Wall", "wall"),
        ] {
            assert_eq!(hint(word, &known), format!("; did you mean {nearest}?"));
        }
        assert_eq!(
            hint("wendland", &["wendland-c2", "wendland-c4"]),
            "; did you mean wendland-c2?"
        );
        for far in ["colour", "start", "x", "gravity"] {
            assert_eq!(hint(far, &known), "", "{far}");
        }
    }
}
