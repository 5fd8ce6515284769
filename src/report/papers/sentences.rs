//! What agrees with the papers, what does not, and why: sentences from the numbers.

use std::collections::BTreeSet;

use super::Found;
use super::table::{couplings, words};
use crate::math::lists::{different, median, tallied};
use crate::math::words::counted;
use crate::papers::{Read, cause, paper};
use crate::quantities::coarse_spacings;
use crate::quantities::summary::{COARSE_SPACING, PARTICLE_SPACING, SCHEME};
use crate::report::curves::distinct;
use crate::report::number;
use crate::report::row::Row;

/// A paragraph on what was compared, one for each kind of number, and one for each reason.
pub fn sentences(found: &[Found]) -> Vec<String> {
    let mut said = vec![opening(found)];
    let sizes = |scene: &str, s: Option<f64>| {
        let wanted = scene.to_owned();
        move |found: &&Found| {
            found.printed.is_size() && found.printed.scene == wanted && found.coupling() == s
        }
    };
    let fixed: Vec<_> = found.iter().filter(sizes("fixed", None)).collect();
    said.extend(tally("Fixed walls", &fixed));
    for s in couplings(found) {
        let law = if s == 1.0 { ", the law as printed" } else { "" };
        let own: Vec<_> = found.iter().filter(sizes("movable", Some(s))).collect();
        said.extend(tally(&format!("Movable walls with s = {}{law}", number::as_typed(s)), &own));
    }
    let is_time = |found: &&Found| found.printed.unit == "s";
    let flat = |found: &&Found| found.printed.unit == "%" || found.printed.read == Read::Words;
    let step = |found: &&Found| found.printed.timed_boundary().is_some();
    let front = |found: &&Found| found.printed.scene == "dam-break" && !step(found);
    said.extend(tally(
        "Times on the papers' clock",
        &found.iter().filter(is_time).collect::<Vec<_>>(),
    ));
    let many: Vec<_> = found.iter().filter(|f| !is_time(f)).filter(flat).collect();
    let (shares, words): (Vec<_>, Vec<_>) = many.into_iter().partition(|f| f.printed.unit == "%");
    said.extend(tally("Changes over many stiffnesses", &shares));
    said.extend(tally("What is said in words", &words));
    said.extend(tally("The dam break", &found.iter().filter(front).collect::<Vec<_>>()));
    said.extend(tally("Times per step", &found.iter().filter(step).collect::<Vec<_>>()));
    said.extend(reasons(found));
    said
}

/// How far off the printed numbers are, in a sentence.
pub fn answer(found: &[Found]) -> String {
    let met = found.iter().filter(|one| one.is_met()).count();
    let sizes = found.iter().filter(|one| one.printed.is_size());
    let sizes: Vec<f64> = sizes.filter_map(|one| Some(one.percent()?.abs())).collect();
    let worst = sizes.iter().copied().max_by(f64::total_cmp);
    let off = median(&sizes).zip(worst).map(|(median, worst)| {
        let [median, worst] = [median, worst].map(|size| number::significant(size, 2));
        format!(" Sizes differ by {median} % in the median and {worst} % at most.")
    });
    let are = is_or_are(met, found.len());
    format!(
        "{met} of {} with printed numbers {are} met, within 5 % or the error bar.{} The section below \
         says which, and why the others are not.",
        counted(found.len(), "comparison"),
        off.unwrap_or_default()
    )
}

fn opening(found: &[Found]) -> String {
    let name = |one: &Found| paper(&one.printed.paper).map_or("", |paper| paper.words.as_str());
    let names = different(found.iter().map(name));
    let numbers: BTreeSet<_> = found.iter().map(|one| std::ptr::from_ref(one.printed)).collect();
    let are = if numbers.len() == 1 { "number has" } else { "numbers have" };
    let compared = match found.len() {
        all if all > numbers.len() => format!(", some of them several: {all} comparisons"),
        _ => String::new(),
    };
    let rows = found.iter().map(|one| one.row.text(&COARSE_SPACING));
    let coarse = coarse_spacings(rows.filter(|why| !why.is_empty()));
    let coarse = coarse.map(|why| {
        format!(" The particles are coarse, and a part of the differences may be theirs: {why}.")
    });
    format!(
        "{} printed {are} a case here{compared} ({}), computed by {}. A number counts as met where the difference is \
         at most 5 % (or 0.02 of F*, R* and X*, 0.05 s, 5 points of a percentage), or within the error bar. \
         No curve was read off: these are the numbers that the papers print.{}",
        numbers.len(),
        names.join("; "),
        method(found.iter().map(|one| one.row)),
        coarse.unwrap_or_default()
    )
}

/// The schemes and spacings of cases.
pub fn method<'a>(rows: impl Iterator<Item = &'a Row> + Clone) -> String {
    let schemes: BTreeSet<_> = rows.clone().map(|row| row.text(&SCHEME)).collect();
    let schemes: Vec<_> = schemes.into_iter().collect();
    let spacings = distinct(rows, &PARTICLE_SPACING);
    let spacings: Vec<_> = spacings.into_iter().map(number::as_typed).collect();
    format!("{} with particles {} m apart", schemes.join(" and "), spacings.join(", "))
}

/// The verb of `1 of 3 numbers is met` and `2 of 3 numbers are met`.
fn is_or_are(met: usize, all: usize) -> &'static str {
    if met == 1 || all == 1 { "is" } else { "are" }
}

/// How many numbers of a kind are met, and how far off they are in the median and at worst.
fn tally(what: &str, found: &[&Found]) -> Option<String> {
    let first = found.first()?;
    let met = found.iter().filter(|one| one.is_met()).count();
    let numbers = counted(found.len(), "number");
    let are = is_or_are(met, found.len());
    let mut text = format!("{what}: {met} of {numbers} {are} met");
    let by = |one: &Found| one.percent().unwrap_or(0.0).abs();
    let in_percent = first.printed.is_size() || first.printed.timed_boundary().is_some();
    let size = |one: &Found| if in_percent { by(one) } else { one.difference().abs() };
    let all: Vec<f64> = found.iter().map(|one| size(one)).collect();
    let worst = found.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let unit = match first.printed.unit.as_str() {
        _ if in_percent => "%",
        "%" => "points of a percentage",
        unit => unit,
    };
    let place = worst.row.place_in_words();
    let at = if place.is_empty() { String::new() } else { format!(" at {}", place.join(", ")) };
    text.push_str(&format!(
        ". The differences have a median of {} {unit}; the largest is {} {unit}, of {} (Fig. {}){at}.",
        number::significant(median(&all)?, 2),
        number::significant(size(worst), 2),
        words(worst.printed),
        worst.printed.figure,
    ));
    Some(text)
}

/// Why numbers are not met. Each reason stands once; the most frequent one comes first.
fn reasons(found: &[Found]) -> Vec<String> {
    let name = |one: &Found| {
        // With a fitted factor s, the law as printed is no longer a reason.
        let name = one.printed.cause.as_str();
        let fitted = name == "coupling" && one.coupling().is_some_and(|s| s != 1.0);
        if fitted { "fitted" } else { name }
    };
    let names: Vec<_> = found.iter().filter(|one| !one.is_met()).map(name).collect();
    let said = |(name, count): (&str, usize)| {
        let why = cause(name).unwrap_or("no reason is known.");
        let are = if count == 1 { "is" } else { "are" };
        format!("Why {count} {are} not met: {why}")
    };
    tallied(&names).into_iter().map(said).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_several_is_met() {
        let verbs = [(0, 1), (1, 1), (1, 3)].map(|(met, all)| is_or_are(met, all));
        assert_eq!(verbs, ["is"; 3]);
        assert_eq!([is_or_are(0, 3), is_or_are(2, 3)], ["are"; 2]);
    }
}
