//! Known limits that cases reach. Someone who gets only the page has not read them.

use rayon::prelude::*;

use crate::math::lists::counts;
use crate::math::words::{capitalised, counted};
use crate::report::case::STROKE;
use crate::report::curves::spread_places;
use crate::report::load::Loaded;
use crate::scene::limits;

/// How many cases are looked at, spread over the study.
const LOOKED_AT: usize = 2000;
/// The same where each reads the file of a stroke.
const READ: usize = 20;

/// Each limit once, in the words of `seawall check`, with the number of cases; `None` where none is
/// reached, or the files do not tell.
pub fn known(data: &Loaded) -> Option<String> {
    let reads_strokes = data.file.as_ref()?.scene.contains_key(STROKE);
    let most = if reads_strokes { READ } else { LOOKED_AT };
    let places: Vec<usize> = spread_places(data.rows.len(), most).collect();
    let of = |&place: &usize| Some(limits(&data.case_as_run(place)?));
    let cases: Vec<_> = places.par_iter().filter_map(of).collect();
    let all = cases.len();
    let line = |(limit, reach): (&str, usize)| match reach {
        _ if data.rows.len() == 1 => format!("{}.", capitalised(limit)),
        reach if reach == all => {
            format!("{}: {limit}.", if all == 2 { "Both cases" } else { "All cases" })
        }
        reach => format!("{reach} of {}: {limit}.", counted(all, "case")),
    };
    let mut lines: Vec<_> = counts(cases.into_iter().flatten()).into_iter().map(line).collect();
    if lines.is_empty() {
        return None;
    }
    if all < data.rows.len() {
        lines.push(format!("These are {all} of {} cases.", data.rows.len()));
    }
    Some(lines.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(numerics: &str, spacings: &[&str]) -> Option<String> {
        let text = format!(
            "name = \"a\"\n[scene]\nwave_height_ratio = 0.3\n[numerics]\n{numerics}\n[grid]"
        );
        known(&Loaded::swept(&[("particle_spacing_m", spacings)]).made_from(&text, &[]))
    }

    /// The story: `check`, `run` and `sweep` told of known limits, and the page of none.
    #[test]
    fn limits_are_told_once_with_their_cases() {
        assert_eq!(told("", &["0.02", "0.0125"]), None);
        let few = "ewer than 10 particles over the depth: forces are up to 3 %";
        let one = told("", &["0.025"]).unwrap();
        assert!(one.starts_with(&format!("F{few}")) && one.ends_with(" may miss."), "{one}");
        let some = told("", &["0.025", "0.03", "0.0125"]).unwrap();
        assert!(some.starts_with(&format!("2 of 3 cases: f{few}")), "{some}");
        let all = told("slip = \"no\"", &["0.025", "0.02", "0.0125"]).unwrap();
        assert!(all.contains("1 of 3 cases: f") && all.contains("All cases: slip = "), "{all}");
        let both = told("", &["0.025", "0.03"]).unwrap();
        assert_eq!((both.matches(few).count(), both.starts_with("Both cases: f")), (1, true));
        let many = told("", &vec!["0.025"; LOOKED_AT + 1]).unwrap();
        assert!(many.ends_with(" These are 2000 of 2001 cases."), "{many}");
        assert_eq!(known(&Loaded::default()), None);
    }
}
