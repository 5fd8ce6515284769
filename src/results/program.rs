//! Which build of the program computed something.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A build.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Program {
    /// Version.
    pub version: String,
    /// Git commit that it was built from, or "unknown".
    pub git_commit: String,
    /// Sum over its sources, 16 hex digits.
    pub sources: String,
}

impl Program {
    /// This one.
    pub fn this() -> Program {
        let known = |text: Option<&str>| text.unwrap_or("unknown").to_owned();
        Program {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            git_commit: known(option_env!("SEAWALL_GIT_COMMIT")),
            sources: known(option_env!("SEAWALL_SOURCES")),
        }
    }
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Program { version, git_commit, sources } = self;
        write!(f, "{version} (commit {git_commit}, sources {sources})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_build_knows_its_sources() {
        let sources = Program::this().sources;
        assert!(sources.len() == 16 && u64::from_str_radix(&sources, 16).is_ok(), "{sources}");
    }
}
