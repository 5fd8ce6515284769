//! Choosing by name, where names may contain commas.

use toml::Value;

use crate::scene::ConfigError;

/// The names in the arguments. Each argument is one name, or several with commas between them. The
/// longest possible names are taken.
///
/// # Errors
/// A word that is no name, with all names in quotes.
pub(super) fn names(
    key: &str,
    arguments: &[String],
    known: &[&str],
) -> Result<Vec<String>, ConfigError> {
    let mut chosen = Vec::new();
    for argument in arguments {
        let mut pieces: &[&str] = &argument.split(',').collect::<Vec<_>>();
        while !pieces.is_empty() {
            let joined = |count: &usize| pieces[..*count].join(",").trim().to_owned();
            let named = |count: &usize| known.contains(&joined(count).as_str());
            let Some(count) = (1..=pieces.len()).rev().find(named) else {
                let quoted: Vec<_> = known.iter().map(|name| format!("{name:?}")).collect();
                let wrong = Value::String(joined(&1));
                return Err(ConfigError::one_of(key, &wrong, &quoted));
            };
            chosen.push(joined(&count));
            pieces = &pieces[count..];
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_name_comes_before_a_list() {
        let known = ["R 3", "R 3, dx 0.0125", "dx 0.02"];
        let pick = |argument: &str| names("--method", &[argument.to_owned()], &known);
        assert_eq!(pick("R 3, dx 0.0125").unwrap(), ["R 3, dx 0.0125"]);
        assert_eq!(pick("dx 0.02,R 3").unwrap(), ["dx 0.02", "R 3"]);
        assert_eq!(pick("dx 0.02,R 3, dx 0.0125").unwrap(), ["dx 0.02", "R 3, dx 0.0125"]);
        let told = pick("R 3,dx 0.0125").unwrap_err().to_string();
        let list = "\"R 3\", \"R 3, dx 0.0125\", \"dx 0.02\"";
        assert!(told.starts_with("--method = \"dx 0.0125\": must be one of"), "{told}");
        assert!(told.contains(list), "{told}");
    }
}
