//! What a study says, in sentences with numbers: each is generated from the rows alone, and one
//! that the rows cannot fill is left out.

mod doubts;
mod errors;
mod force;
mod halving;
mod run;

pub use force::most;

use crate::report::load::Loaded;
use crate::report::scene_file::SceneFile;

/// One answer: what it is about, in a word or two, and its sentences.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// What it is about.
    pub about: &'static str,
    /// What is said, as plain text.
    pub text: String,
}

/// All that can be said.
pub fn all(data: &Loaded, file: Option<&SceneFile>) -> Vec<Answer> {
    let answers = [
        ("What was run", Some(run::what(data))),
        ("Failed", run::failed(data)),
        ("Largest force", force::largest(data, file)),
        ("Half the force", halving::half(data)),
        ("Bounds", doubts::bounds(data)),
        ("Doubts", doubts::doubtful(data)),
        ("Errors", errors::bars(data)),
    ];
    let answer = |(about, text): (_, Option<String>)| Some(Answer { about, text: text? });
    answers.into_iter().filter_map(answer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn said(directory: &tempfile::TempDir) -> String {
        let data = Loaded::read(directory.path()).unwrap();
        let answers = all(&data, SceneFile::of(&data).as_ref());
        answers.iter().map(|answer| format!("{}: {}\n", answer.about, answer.text)).collect()
    }

    #[test]
    fn a_movable_study() {
        assert_eq!(said(&fixture::sweep()), "");
    }

    #[test]
    fn fixed_walls_move_nowhere() {
        assert_eq!(said(&fixture::fixed()), "");
    }

    #[test]
    fn other_scenes_say_what_they_can() {
        assert_eq!(said(&fixture::dam_breaks(3)), "");
    }

    #[test]
    fn one_case() {
        assert_eq!(said(&fixture::movable(&[0.5], &[500.0], &[250.0])), "");
    }
}
