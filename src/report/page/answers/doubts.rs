//! Which numbers are bounds, and which results are doubtful.

use crate::quantities::named;
use crate::quantities::summary::{DISPLACEMENT_MAX, DOUBTFUL, DOUBTFUL_REASON, SPRING_STIFFNESS};
use crate::report::curves::distinct;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::words::{counted, listed};
use crate::report::row::Row;

/// How the reason of coarse particles begins.
const COARSE: &str = "coarse spacing: ";

/// How many largest displacements are lower bounds; `None` where nothing moves.
pub fn bounds(data: &Loaded) -> Option<String> {
    let moving = || data.finished().filter(|row| row.number(&DISPLACEMENT_MAX).is_some());
    let bounds = || moving().filter(|row| row.is_bound(&DISPLACEMENT_MAX));
    let (all, open) = (moving().count(), bounds().count());
    if all == 0 {
        return None;
    }
    if open == 0 {
        return Some(
            "No maximum is a bound: every wall had turned before its run ended.".to_owned(),
        );
    }
    if all == 1 {
        let why = "the wall still moved outwards when the run ended";
        return Some(format!("The largest displacement is no more than a lower bound (≥): {why}."));
    }
    let softest = distinct(bounds(), &SPRING_STIFFNESS);
    let up_to = softest.last().map(|stiffest| {
        let up_to = if softest.len() > 1 { "k up to" } else { "k =" };
        format!(" ({up_to} {} N/m)", number::plain(*stiffest))
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
    let (coarse, doubtful) = without_coarse(&doubtful);
    let coarse = coarse.map(|(count, why)| {
        let are = if count == 1 { "is" } else { "are" };
        format!("{count} of {} {are} coarse: {why}. ", counted(all, "result"))
    });
    let coarse = coarse.unwrap_or_default();
    if doubtful.is_empty() {
        return Some(format!("{coarse}Nothing else makes a result doubtful."));
    }
    let mut reasons: Vec<(String, usize)> = Vec::new();
    for told in &doubtful {
        for reason in kinds(told) {
            match reasons.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, count)) => *count += 1,
                None => reasons.push((reason, 1)),
            }
        }
    }
    reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let words: Vec<_> =
        reasons.iter().map(|(reason, count)| format!("{reason} ({count})")).collect();
    let are = if doubtful.len() == 1 { "is" } else { "are" };
    Some(format!(
        "{coarse}{} of {} {are} doubtful: {}. Look at their histories first.",
        doubtful.len(),
        counted(all, "result"),
        listed(&words)
    ))
}

/// How many cases have coarse particles, and what that means of the first of them; and the other reasons of
/// all cases that have any.
fn without_coarse(rows: &[&Row]) -> (Option<(usize, String)>, Vec<String>) {
    let (mut coarse, mut others) = (Vec::new(), Vec::new());
    for row in rows {
        let is_coarse = |reason: &&str| reason.starts_with(COARSE);
        let told = row.text(&DOUBTFUL_REASON).split("; ");
        let (own, rest): (Vec<&str>, Vec<&str>) = told.partition(is_coarse);
        coarse.extend(own.first().map(|reason| reason[COARSE.len()..].to_owned()));
        if own.is_empty() || !rest.is_empty() {
            others.push(rest.join("; "));
        }
    }
    let first = coarse.first().cloned();
    (first.map(|why| (coarse.len(), why)), others)
}

/// The kinds of a case's reasons, each once. Reasons that name no kind are told without their numbers and
/// without the quantities that they touch, as earlier versions wrote them.
fn kinds(reasons: &str) -> Vec<String> {
    let mut kinds: Vec<String> = Vec::new();
    for reason in reasons.split("; ") {
        let kind = match reason.split_once(": ") {
            Some((name, rest)) if named(name).is_some() => without_numbers(rest),
            Some((kind, _)) => kind.to_owned(),
            None => without_numbers(reason),
        };
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

fn without_numbers(text: &str) -> String {
    let words = text.split(' ').filter(|word| !word.is_empty());
    let blank = |word: &str| {
        let digits = word.trim_matches(|c: char| !c.is_ascii_digit());
        if digits.parse::<f64>().is_ok() { "…".to_owned() } else { word.to_owned() }
    };
    words.map(blank).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::STATUS;
    use crate::report::fixture;

    #[test]
    fn doubtful_results_are_counted_by_reason() {
        let directory = fixture::movable(&[0.3], &[10.0, 500.0, 1e5], &[50.0]);
        let mut data = Loaded::read(directory.path()).unwrap();
        for row in &mut data.rows {
            *row = row.clone().with(&DOUBTFUL, "false");
        }
        assert_eq!(doubtful(&data).unwrap(), "No result is doubtful.");
        let reasons = ["energy gap +3.1 %; the water is compressed by 6.1 %", "energy gap -5 %"];
        for (row, reason) in data.rows.iter_mut().zip(reasons) {
            *row = row.clone().with(&DOUBTFUL, "true").with(&DOUBTFUL_REASON, reason);
        }
        assert_eq!(
            doubtful(&data).unwrap(),
            "2 of 3 results are doubtful: energy gap … % (2) and the water is compressed by … % \
             (1). Look at their histories first."
        );
    }

    #[test]
    fn reasons_are_told_apart_by_their_words() {
        let reasons = "force_max: the pressure on the face is +2.1 % off; first_force_max: the \
                       pressure on the face is -3.4 % off; energy gap +3.1 %";
        assert_eq!(kinds(reasons), ["the pressure on the face is … % off", "energy gap … %"]);
        let named = "coarse spacing: 8 rows of particles; force gap: 3 % at force_max";
        assert_eq!(kinds(named), ["coarse spacing", "force gap"]);
    }

    #[test]
    fn coarse_particles_have_a_sentence_of_their_own() {
        let row = |reason: &str| {
            let flag = if reason.is_empty() { "false" } else { "true" };
            let row = Row::default().with(&STATUS, "ok").with(&DOUBTFUL, flag);
            row.with(&DOUBTFUL_REASON, reason)
        };
        let told = |reasons: [&str; 3]| {
            let rows = reasons.map(row).to_vec();
            doubtful(&Loaded { rows, ..Loaded::default() }).unwrap()
        };
        let coarse = "coarse spacing: 8.0 rows of particles";
        let both = format!("{coarse}; force gap: 3 % at force_max");
        assert_eq!(
            told([coarse, "", coarse]),
            "2 of 3 results are coarse: 8.0 rows of particles. Nothing else makes a result doubtful."
        );
        assert_eq!(
            told([coarse, &both, "force gap: 2 % at force_max"]),
            "2 of 3 results are coarse: 8.0 rows of particles. 2 of 3 results are doubtful: force gap \
             (2). Look at their histories first."
        );
        assert_eq!(told(["", "", ""]), "No result is doubtful.");
    }
}
