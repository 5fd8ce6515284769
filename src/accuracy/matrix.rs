//! A matrix of cases and methods, for `seawall accuracy` and `seawall stress`. Every case is a
//! scene with what is known of its answer. Every method is a set of numerics that is applied to it.
//!
//! A matrix becomes a [`Study`], so that it runs in parallel and resumes like any sweep. A pair
//! that this build does not know (a scheme, a kernel, a kind of scene) is reported, but is no
//! error.

use std::collections::{BTreeMap, HashMap};

use serde::Deserialize;
use toml::{Table, Value};

use super::choice;
use super::quantity::Quantity;
use crate::scene::{CaseConfig, ConfigError};
use crate::study::{Case, CaseId, Study};

/// A file of cases and methods.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Matrix {
    /// Its name; also the default output directory's.
    pub name: String,
    /// The cases.
    #[serde(rename = "case")]
    pub cases: Vec<MatrixCase>,
    /// The methods.
    #[serde(rename = "method")]
    pub methods: Vec<Method>,
}

/// A scene and what is known of its answer. Quantities have the names of the outcome's fields
/// or of the scene's readings.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatrixCase {
    /// A word.
    pub name: String,
    /// What it is and why it is here.
    pub about: String,
    /// `[scene]`.
    #[serde(default)]
    pub scene: Table,
    /// `[numerics]`; those of the method come on top.
    #[serde(default)]
    pub numerics: Table,
    /// Part of the quick form.
    #[serde(default)]
    pub quick: bool,
    /// The methods it runs with; all where absent.
    pub methods: Option<Vec<String>>,
    /// The exact values of quantities: fields of the outcome, or readings of the scene.
    #[serde(default)]
    pub truth: BTreeMap<Quantity, f64>,
    /// If no exact value is known: a method whose result is used instead.
    pub reference: Option<Reference>,
    /// The range that a quantity must end in.
    #[serde(default)]
    pub pass: BTreeMap<Quantity, [f64; 2]>,
    /// Another case whose values, with the same method, these must equal.
    pub same: Option<Same>,
}

/// The same case with a method whose result is taken for the truth.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Name of the method. Its own errors are not reported.
    pub method: String,
    /// Which quantities.
    pub quantities: Vec<Quantity>,
}

/// Equality with another case.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Same {
    /// The other case.
    pub case: String,
    /// Allowed difference, relative to the other's value.
    pub tolerance: f64,
    /// Which quantities.
    pub quantities: Vec<Quantity>,
}

/// Numerics that are applied to every case.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Method {
    /// A word.
    pub name: String,
    /// What it is.
    #[serde(default)]
    pub about: String,
    /// `[numerics]`.
    #[serde(default)]
    pub numerics: Table,
    /// Part of the quick form.
    #[serde(default)]
    pub quick: bool,
    /// The cases it runs on; all where absent.
    pub cases: Option<Vec<String>>,
}

/// One pair of the matrix: a method tried on a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Place in [`Matrix::cases`].
    pub case: usize,
    /// Place in [`Matrix::methods`].
    pub method: usize,
    /// Index among the study's cases, or the reason why this build cannot run it. Two methods with
    /// the same resulting numerics share an index.
    pub run: Result<usize, String>,
}

impl Matrix {
    /// Reads a file.
    ///
    /// # Errors
    /// What is no matrix, or names a case or method that is not there.
    pub fn read(text: &str) -> Result<Matrix, ConfigError> {
        let matrix: Matrix = toml::from_str(text).map_err(|error| {
            ConfigError::new("matrix", "", error.message().trim().replace('\n', " "))
        })?;
        let cases: Vec<_> = matrix.cases.iter().map(|case| case.name.as_str()).collect();
        let methods: Vec<_> = matrix.methods.iter().map(|method| method.name.as_str()).collect();
        let known = |names: &[&str], key: String, wanted: &str| match names.contains(&wanted) {
            true => Ok(()),
            false => {
                Err(ConfigError::new(&key, wanted, format!("must be one of {}", names.join(", "))))
            }
        };
        for case in &matrix.cases {
            if let Some(same) = &case.same {
                known(&cases, format!("case.{}.same.case", case.name), &same.case)?;
            }
            for method in case.methods.iter().flatten() {
                known(&methods, format!("case.{}.methods", case.name), method)?;
            }
            if let Some(reference) = &case.reference {
                known(&methods, format!("case.{}.reference", case.name), &reference.method)?;
            }
        }
        for method in &matrix.methods {
            for case in method.cases.iter().flatten() {
                known(&cases, format!("method.{}.cases", method.name), case)?;
            }
        }
        Ok(matrix)
    }

    /// The part with these cases and these methods; all if none is named. Every argument is a name,
    /// or several with commas between them. A part has its own name, and so its own directory.
    pub fn only(&self, cases: &[String], methods: &[String]) -> Result<Matrix, ConfigError> {
        let mut part = self.clone();
        let names: Vec<_> = self.cases.iter().map(|case| case.name.as_str()).collect();
        let cases = choice::names("--case", cases, &names)?;
        let names: Vec<_> = self.methods.iter().map(|method| method.name.as_str()).collect();
        let methods = choice::names("--method", methods, &names)?;
        part.cases.retain(|case| cases.is_empty() || cases.contains(&case.name));
        part.methods.retain(|method| methods.is_empty() || methods.contains(&method.name));
        if !(cases.is_empty() && methods.is_empty()) {
            part.name.push_str("-part");
        }
        Ok(part)
    }

    /// The study of all its pairs, or of those of its quick form.
    pub fn study(&self, quick: bool, text: &str) -> (Study, Vec<Trial>) {
        let mut pairs = Vec::new();
        let mut cases: Vec<Case> = Vec::new();
        let mut seen: HashMap<CaseId, usize> = HashMap::new();
        for (place, case) in self.cases.iter().enumerate() {
            for (column, method) in self.methods.iter().enumerate() {
                let named = case.methods.as_ref().is_none_or(|names| names.contains(&method.name))
                    && method.cases.as_ref().is_none_or(|names| names.contains(&case.name));
                if !named || (quick && !(case.quick && method.quick)) {
                    continue;
                }
                let mut numerics = case.numerics.clone();
                numerics.extend(method.numerics.clone());
                let run = match CaseConfig::from_tables(&case.scene, &numerics) {
                    Err(error) => Err(error.to_string()),
                    Ok(config) => {
                        let config = config.without_error_bars();
                        let id = CaseId::of(&config);
                        Ok(*seen.entry(id).or_insert_with(|| {
                            let index = cases.len();
                            let words = [&case.name, &method.name];
                            let assignments =
                                words.map(|word| Some(Value::String(word.clone()).into()));
                            cases.push(Case { index, id, config, assignments: assignments.into() });
                            index
                        }))
                    }
                };
                pairs.push(Trial { case: place, method: column, run });
            }
        }
        let keys = vec!["case".to_owned(), "method".to_owned()];
        let name = if quick { format!("{}-quick", self.name) } else { self.name.clone() };
        (Study::of(name, keys, cases, &[], text), pairs)
    }
}

#[cfg(test)]
pub(super) mod tests;
