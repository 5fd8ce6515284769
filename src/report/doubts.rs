//! Which numbers are bounds, and which results are doubtful.

use crate::math::lists::{different, tallied};
use crate::math::words::{counted, listed};
use crate::quantities::coarse_spacings;
use crate::quantities::summary::{
    COARSE_SPACING, DISPLACEMENT_MAX, DOUBTFUL, DOUBTFUL_REASON, SPRING_STIFFNESS,
};
use crate::report::curves::distinct;
use crate::report::load::Loaded;
use crate::report::number;

/// How many largest displacements are lower bounds; `None` where nothing moves.
pub fn bounds(data: &Loaded) -> Option<String> {
    let moving = || data.finished().filter(|row| row.number(&DISPLACEMENT_MAX).is_some());
    let bounds = || moving().filter(|row| row.is_bound(&DISPLACEMENT_MAX));
    let (all, open) = (moving().count(), bounds().count());
    if all == 0 {
        return None;
    }
    if open == 0 {
        // A caisson stays where it comes to rest.
        let springs = moving().all(|row| row.number(&SPRING_STIFFNESS).is_some());
        let ended = if springs { "had turned" } else { "stood still or had turned" };
        return Some(format!("No maximum is a bound: every wall {ended} before its run ended."));
    }
    if all == 1 {
        let why = "the wall still moved outwards when the run ended";
        return Some(format!("The largest displacement is no more than a lower bound (≥): {why}."));
    }
    let softest = distinct(bounds(), &SPRING_STIFFNESS);
    let up_to = softest.last().map(|stiffest| {
        let up_to = if softest.len() > 1 { "k up to" } else { "k =" };
        format!(" ({up_to} {} N/m)", number::as_typed(*stiffest))
    });
    Some(format!(
        "{open} of {} {} no more than a lower bound (≥): the wall still moved outwards when the run \
         ended{}.",
        counted(all, "largest displacement"),
        if open == 1 { "is" } else { "are" },
        up_to.unwrap_or_default()
    ))
}

/// How many results are doubtful, and why.
pub fn doubtful(data: &Loaded) -> Option<String> {
    let all = data.finished().count();
    let judged = data.finished().any(|row| !row.text(&DOUBTFUL).is_empty());
    if all == 0 {
        return None;
    }
    if !judged {
        return Some("These files do not say which results are doubtful.".to_owned());
    }
    let doubtful: Vec<_> = data.finished().filter(|row| row.is(&DOUBTFUL)).collect();
    if doubtful.is_empty() {
        return Some("No result is doubtful.".to_owned());
    }
    if all == 1 {
        let why = doubtful[0].text(&DOUBTFUL_REASON);
        return Some(format!("The result is doubtful: {why}. Look at its history first."));
    }
    let reasons: Vec<_> =
        doubtful.iter().flat_map(|row| kinds(row.text(&DOUBTFUL_REASON))).collect();
    let words = tallied(&reasons).into_iter().map(|(reason, count)| format!("{reason} ({count})"));
    let words: Vec<_> = words.collect();
    let (are, their) =
        if doubtful.len() == 1 { ("is", "its history") } else { ("are", "their histories") };
    Some(format!(
        "{} of {} {are} doubtful: {}. Look at {their} first.",
        doubtful.len(),
        counted(all, "result"),
        listed(&words)
    ))
}

/// How many results have coarse particles, and what follows from that; `None` where none has.
pub fn coarse(data: &Loaded) -> Option<String> {
    let all = data.finished().count();
    let coarse: Vec<_> = data
        .finished()
        .map(|row| row.text(&COARSE_SPACING))
        .filter(|why| !why.is_empty())
        .collect();
    let why = coarse_spacings(coarse.iter().copied())?;
    if all == 1 {
        return Some(format!("Its particles are coarse: {why}."));
    }
    let have = if coarse.len() == 1 { "has" } else { "have" };
    Some(format!("{} of {} {have} coarse particles: {why}.", coarse.len(), counted(all, "result")))
}

/// The kinds of a case's reasons, each once: what stands before the colon of each.
fn kinds(reasons: &str) -> Vec<String> {
    let kind = |reason: &str| reason.split(": ").next().unwrap_or_default().to_owned();
    different(reasons.split("; ").map(kind))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::STATUS;
    use crate::report::fixture;
    use crate::report::row::Row;

    #[test]
    fn doubtful_results_are_counted_by_reason() {
        let (_directory, mut data) =
            fixture::read(fixture::movable(&[0.3], &[10.0, 500.0, 1e5], &[50.0]));
        data.set_all(&DOUBTFUL, false);
        assert_eq!(doubtful(&data).unwrap(), "No result is doubtful.");
        let (energy, compression) =
            ("energy: the budget is open by +3.1 %", "compression: its weight");
        let reasons = [format!("{energy}; {compression}"), "energy: 1.2 % of the work".to_owned()];
        for (row, reason) in data.rows.iter_mut().zip(reasons) {
            row.set(&DOUBTFUL, "true").set(&DOUBTFUL_REASON, &*reason);
        }
        assert_eq!(
            doubtful(&data).unwrap(),
            "2 of 3 results are doubtful: energy (2) and compression (1). Look at their histories first."
        );
    }

    #[test]
    fn coarse_particles_have_a_sentence_of_their_own() {
        let row = |why: &str| {
            let row = Row::default().with(&STATUS, "ok").with(&DOUBTFUL, "false");
            row.with(&COARSE_SPACING, why)
        };
        let of = |rows: &[&str]| {
            let rows = rows.iter().map(|why| row(why)).collect();
            Loaded { rows, ..Loaded::default() }
        };
        let why = "8.0 rows over the depth";
        let both = of(&[why, "", why]);
        assert_eq!(coarse(&both).unwrap(), format!("2 of 3 results have coarse particles: {why}."));
        assert_eq!(doubtful(&both).unwrap(), "No result is doubtful.");
        assert_eq!(coarse(&of(&[why])).unwrap(), format!("Its particles are coarse: {why}."));
        let mixed = coarse(&of(&[why, "6.7 rows over the depth"])).unwrap();
        assert_eq!(mixed, "2 of 2 results have coarse particles: 6.7 to 8.0 rows over the depth.");
        assert_eq!(coarse(&of(&["", ""])), None);
    }

    #[test]
    fn a_caisson_that_stopped_has_not_turned() {
        let told = |row: Row| bounds(&Loaded { rows: vec![row], ..Loaded::default() }).unwrap();
        let caisson = Row::default().with(&STATUS, "ok").with(&DISPLACEMENT_MAX, 0.5);
        assert!(told(caisson.clone()).contains("every wall stood still or had turned before"));
        assert!(told(caisson.with(&SPRING_STIFFNESS, 5)).contains("every wall had turned before"));
    }
}
