//! What a page shows of a study that is too large to show in full.
//!
//! Sentences and files under `tables/` cover all cases. The page's tables, figures and words on the
//! papers cover a selection: cases with a film, those of the largest responses, and those with the
//! smallest ids. Ids are hashes, so these spread evenly over any grid.

use std::collections::HashSet;

use super::curves::RESPONSES;
use super::load::Loaded;
use super::row::Row;

/// Studies up to so many cases are shown in full.
pub const WHOLE: usize = 20_000;

/// How many cases of a larger study are shown.
pub const SHOWN: usize = 10_000;

/// The part of a study that is shown; `None` if all of it is.
pub fn of(data: &Loaded) -> Option<Loaded> {
    some(data, WHOLE, SHOWN)
}

fn some(data: &Loaded, whole: usize, shown: usize) -> Option<Loaded> {
    if data.rows.len() <= whole {
        return None;
    }
    let filmed = data.filmed();
    let mut first: HashSet<&str> = filmed.iter().map(String::as_str).collect();
    for response in RESPONSES {
        let number = |row: &&Row| row.number(response).unwrap_or(f64::NEG_INFINITY);
        let most = data.finished().max_by(|a, b| number(a).total_cmp(&number(b)));
        first.extend(most.map(|row| row.id()));
    }
    let id = |place: &usize| data.rows[*place].id();
    let mut places: Vec<usize> = (0..data.rows.len()).collect();
    places.sort_by_cached_key(|place| (!first.contains(id(place)), id(place), *place));
    places.truncate(shown);
    places.sort_unstable();
    Some(data.part(&places))
}

/// What the page says about the selection.
pub fn words(part: &Loaded, data: &Loaded) -> String {
    format!(
        "The tables and figures of this page show {} of {} cases: those with a film, those of the largest \
         responses, and of the others those with the smallest ids, which are spread evenly over the grid. \
         The sentences here count all cases, and the files under tables/ have all of them.",
        part.rows.len(),
        data.rows.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::FIRST_FORCE_MAX;
    use crate::report::fixture;

    #[test]
    fn a_large_study_is_shown_in_part_and_always_the_same_part() {
        let (_directory, data) = fixture::read(fixture::sweep());
        assert!(of(&data).is_none() && some(&data, 12, 4).is_none());
        let ids = |data: &Loaded| -> Vec<String> {
            data.rows.iter().map(|row| row.id().to_owned()).collect()
        };
        let part = some(&data, 11, 6).unwrap();
        assert_eq!(part.rows.len(), 6);
        assert_eq!(ids(&part), ids(&some(&data, 11, 6).unwrap()));
        let most = |data: &Loaded| {
            let forces = data.finished().filter_map(|row| row.number(&FIRST_FORCE_MAX));
            forces.max_by(f64::total_cmp)
        };
        assert_eq!(most(&part), most(&data), "the case that the answers name is there");
        let all = ids(&data);
        let at: Vec<_> = ids(&part).iter().map(|id| all.iter().position(|o| o == id)).collect();
        assert!(at.is_sorted(), "in the order of the summary");
        for (key, whole) in part.keys.iter().zip(&data.keys) {
            let cells = at.iter().map(|place| &whole.cells[place.unwrap()]);
            assert!(key.cells.iter().eq(cells));
        }
        assert!(words(&part, &data).contains("show 6 of 12 cases"));
    }
}
