//! What a study says, in sentences with numbers. Each is made from the rows alone. Sentences
//! without the rows that they need are left out.

mod aim;
mod errors;
mod force;
mod halving;
mod limits;
mod overtopping;
mod run;
mod runup;
mod scene;
mod stops;

pub use force::most;

use crate::report::doubts;
use crate::report::load::Loaded;

/// The subject of an answer in a word or two, and the answer as plain text.
pub type Answer = (&'static str, String);

/// All answers that the data allows.
pub fn all(data: &Loaded) -> Vec<Answer> {
    let answers = [
        ("What was run", Some(run::what(data))),
        ("The scene", scene::shared(data)),
        ("Warnings", scene::odd(data)),
        ("Failed", run::failed(data)),
        ("Largest force", force::largest(data)),
        ("Highest runup", runup::highest(data)),
        ("Over the crest", overtopping::largest(data)),
        ("Half the force", halving::half(data)),
        ("Stops", stops::hits(data)),
        ("Bounds", doubts::bounds(data)),
        ("Doubts", doubts::doubtful(data)),
        ("Spacing", doubts::coarse(data)),
        ("Known limits", limits::known(data)),
        ("Errors", errors::bars(data)),
        ("The aim", aim::met(data)),
    ];
    answers.into_iter().filter_map(|(about, text)| Some((about, text?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn said(directory: &tempfile::TempDir) -> String {
        let data = Loaded::read(directory.path()).unwrap();
        let answers = all(&data);
        answers.iter().map(|(about, text)| format!("{about}: {text}\n")).collect()
    }

    #[test]
    fn a_movable_study() {
        assert_eq!(
            said(&fixture::sweep()),
            "What was run: 12 cases: H/h = 0.3 and 0.5; k = 10, 500 and 100000 N/m; m = 50 and 250 \
             kg/m. Particles stand 8 mm apart. 11 finished, 1 failed.\n\
             Failed: 1 case failed: runaway-speed (1). It has no results.\n\
             Largest force: The largest force of all is F* = 2.978 at H/h = 0.5, k = 100000 N/m, \
             m = 50 kg/m. It is that of the first impact.\n\
             Half the force: No other wall halves the force on the stiffest wall at H/h = 0.5, \
             k = 100000 N/m, m = 50 kg/m (F* = 2.978). The lowest force is 76 % of it, at H/h = 0.5, \
             k = 500 N/m, m = 50 kg/m. At H/h = 0.3 no wall halves it either.\n\
             Stops: The wall hits its stop in 5 of 11 cases. The load of such a hit is in no maximum; \
             it is in the table Health, as the stop impulse.\n\
             Bounds: 6 of 11 largest displacements are no more than a lower bound (≥): the wall \
             still moved outwards when the run ended (k up to 500 N/m).\n\
             Doubts: These files do not say which results are doubtful.\n\
             Errors: No error bars were asked for: error_bars = \"pair\" in [numerics] estimates \
             how far each number may be off.\n"
        );
    }

    #[test]
    fn fixed_walls_move_nowhere() {
        let text = said(&fixture::fixed());
        assert!(text.contains("6 cases: H/h = 0.1 to 0.6 (6 values)."), "{text}");
        assert!(text.contains("F* = 3.44 at H/h = 0.6"), "{text}");
        assert!(!text.contains("Half") && !text.contains("Bounds"), "{text}");
    }

    #[test]
    fn other_scenes_say_what_they_can() {
        let text = said(&fixture::dam_breaks(3));
        assert!(text.contains("3 cases: column height = 0.6, 0.7 and 0.8 m."), "{text}");
        assert!(text.contains("F* = 1.832 at column height = 0.8 m."), "{text}");
        assert!(!text.contains("impact") && !text.contains("Half"), "{text}");
    }

    #[test]
    fn one_case() {
        let text = said(&fixture::movable(&[0.5], &[500.0], &[250.0]));
        assert!(text.contains("1 case: H/h = 0.5; k = 500 N/m; m = 250 kg/m."), "{text}");
        assert!(text.contains("It is finished.") && !text.contains(" of 1 "), "{text}");
        assert!(!text.contains("Half"), "there is no other wall: {text}");
    }

    #[test]
    fn none_that_is_finished_has_no_numbers() {
        let (_directory, mut data) = fixture::read(fixture::sweep());
        data.rows.retain(|row| !row.is_ok());
        let told = all(&data);
        assert_eq!(told.iter().map(|a| a.0).collect::<Vec<_>>(), ["What was run", "Failed"]);
        assert!(told[0].1.ends_with("None came to its end."), "{}", told[0].1);
        data.rows.clear();
        data.manifest = Some(serde_json::json!({ "cases": 4 }));
        let told = all(&data);
        assert_eq!(told.len(), 1);
        assert_eq!(told[0].1, "4 cases. None is finished yet.");
    }
}
