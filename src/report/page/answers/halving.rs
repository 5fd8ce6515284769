//! Which walls halve the force on the stiffest wall of the same wave.

use super::force::{column, most};
use crate::math::lists::grouped;
use crate::math::words::{counted, listed};
use crate::quantities::summary::{SEAWALL_MASS, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};
use crate::report::curves::distinct;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::words::{at, percent, range};
use crate::report::row::{Row, label};

/// Keys that tell walls of one wave apart.
const OF_THE_WALL: [&str; 3] = [SPRING_STIFFNESS.name, SEAWALL_MASS.name, "wall"];

/// Walls are listed one by one up to so many letters.
const LONG: usize = 240;

/// Finished cases that differ only in their wall, and the one that the others are compared with.
struct Group<'a> {
    rows: Vec<&'a Row>,
    /// The fixed wall, or else the stiffest wall with the largest force.
    stiffest: &'a Row,
}

/// The stiffness and mass that halve the largest force, in full for the wave of the largest force;
/// `None` where no walls can be compared.
pub fn half(data: &Loaded) -> Option<String> {
    let mut groups = groups(data);
    groups.sort_by(|a, b| force(b.stiffest).total_cmp(&force(a.stiffest)));
    let (first, others) = groups.split_first()?;
    let mut text = first.in_full();
    if !others.is_empty() {
        text.push_str(&in_brief(others, first.halved().next().is_some()));
    }
    Some(text)
}

fn force(row: &Row) -> f64 {
    row.number(column(row)).unwrap_or(f64::NAN)
}

/// The cases grouped by all swept keys but the wall's, if a group has walls to compare.
fn groups(data: &Loaded) -> Vec<Group<'_>> {
    let keyed = data.placed().map(|(index, row)| {
        let swept = data.keys.iter().filter(|key| !OF_THE_WALL.contains(&key.name.as_str()));
        let mut key: Vec<_> = swept.map(|key| &key.cells[index]).collect();
        key.extend([row.text(&WAVE_HEIGHT_RATIO), &*row.variant]);
        (key, row)
    });
    grouped(keyed).into_iter().filter_map(Group::of).collect()
}

impl<'a> Group<'a> {
    fn of(rows: Vec<&'a Row>) -> Option<Group<'a>> {
        let known = || rows.iter().copied().filter(|row| force(row).is_finite());
        let softer = |than: f64| {
            known().any(|row| row.number(&SPRING_STIFFNESS).is_some_and(|value| value < than))
        };
        let fixed = most(known().filter(|row| row.is_fixed()), |row| Some(force(row)));
        let stiffness = distinct(known(), &SPRING_STIFFNESS).last().copied();
        let top = known().filter(|row| row.number(&SPRING_STIFFNESS) == stiffness);
        let (stiffest, _) = fixed.or_else(|| most(top, |row| Some(force(row))))?;
        let least = stiffest.number(&SPRING_STIFFNESS).unwrap_or(f64::INFINITY);
        softer(least).then(|| Group { rows: known().collect(), stiffest })
    }

    /// The movable walls with at most half of the stiffest wall's force.
    fn halved(&self) -> impl Iterator<Item = &'a Row> {
        let half = 0.5 * force(self.stiffest);
        self.rows.iter().copied().filter(move |row| !row.is_fixed() && force(row) <= half)
    }

    /// The walls among these that have springs.
    fn springs(&self) -> impl Iterator<Item = &'a Row> {
        self.halved().filter(|row| !row.is_springless())
    }

    fn in_full(&self) -> String {
        let whole = force(self.stiffest);
        let is_fixed = self.stiffest.is_fixed();
        let kind = if is_fixed { "the fixed wall" } else { "the stiffest wall" };
        let place = at(self.stiffest);
        // The wall's kind is not said twice.
        let place = if is_fixed { place.trim_end_matches(", wall = fixed") } else { &place };
        let held = format!("{kind}{place} (F* = {})", number::as_typed(whole));
        let walls = self.walls();
        if walls.iter().map(String::len).sum::<usize>() > LONG {
            let stiffest = most(self.halved(), |row| row.number(&SPRING_STIFFNESS));
            return format!(
                "Compared with {held}, the force is halved by {} of {} walls; the stiffest of them is \
                 that{}.",
                self.halved().count(),
                self.rows.iter().filter(|row| !row.is_fixed()).count(),
                stiffest.map(|(row, _)| at(row)).unwrap_or_default()
            );
        }
        if !walls.is_empty() {
            return format!("Compared with {held}, the force is halved by {}.", walls.join("; "));
        }
        let least = |row: &Row| Some(-force(row));
        // A force that would be printed as 100 % of it does not count.
        let lower = |row: &&Row| !row.is_fixed() && force(row) < 0.995 * whole;
        let lowest = most(self.rows.iter().copied().filter(lower), least);
        let told = lowest.map(|(row, _)| {
            let share = percent(force(row) / whole);
            format!(" The lowest force is {share} of it,{}.", at(row))
        });
        format!("No other wall halves the force on {held}.{}", told.unwrap_or_default())
    }

    /// Masses, each with the stiffnesses that halve the force. Equal lists are joined.
    fn walls(&self) -> Vec<String> {
        let mut walls: Vec<(String, Vec<f64>)> = Vec::new();
        for mass in distinct(self.springs(), &SEAWALL_MASS) {
            let of_mass = |row: &&Row| row.number(&SEAWALL_MASS) == Some(mass);
            let all = distinct(self.rows.iter().copied().filter(of_mass), &SPRING_STIFFNESS);
            let these = distinct(self.springs().filter(of_mass), &SPRING_STIFFNESS);
            let words = stiffnesses(&these, &all);
            match walls.last_mut().filter(|(known, _)| *known == words) {
                Some((_, masses)) => masses.push(mass),
                None => walls.push((words, vec![mass])),
            }
        }
        let masses = |masses: &[f64]| {
            let (last, first) = masses.split_last().expect("a wall has a mass");
            let last_one = number::as_typed(*last);
            match *first {
                [] => label(&SEAWALL_MASS, *last),
                [one] => format!("m = {} and {last_one} kg/m", number::as_typed(one)),
                [from, ..] => format!("m = {} to {last_one} kg/m", number::as_typed(from)),
            }
        };
        let springs = walls.iter().map(|(words, of)| format!("{words} with {}", masses(of)));
        let springless = || self.halved().filter(|row| row.is_springless());
        let others = springless().next().map(|row| {
            format!("a {} of {}", row.kind(), masses(&distinct(springless(), &SEAWALL_MASS)))
        });
        springs.chain(others).collect()
    }
}

/// These stiffnesses among all: as a range up to the stiffest, or one by one.
fn stiffnesses(these: &[f64], all: &[f64]) -> String {
    let words: Vec<_> = these.iter().map(|value| number::as_typed(*value)).collect();
    match words.last() {
        Some(last) if these.len() > 1 && all.starts_with(these) => format!("k up to {last} N/m"),
        _ => format!("k = {} N/m", listed(&words)),
    }
}

/// The other waves in one sentence, after one on walls that halve the force, or on none.
fn in_brief(groups: &[Group<'_>], after_some: bool) -> String {
    let waves = |halved: bool| {
        let is = |group: &&Group<'_>| group.halved().next().is_some() == halved;
        distinct(groups.iter().filter(is).map(|group| group.stiffest), &WAVE_HEIGHT_RATIO)
    };
    let (some, none) = (waves(true), waves(false));
    let [no_wall, too] =
        if after_some { ["no wall halves it", ", too"] } else { ["no wall halves it either", ""] };
    // Waves without a given height have only a number to tell them apart.
    if some.len() + none.len() < groups.len() || groups.iter().any(|one| one.stiffest.unasked) {
        let halved = groups.iter().filter(|group| group.halved().next().is_some()).count();
        let all = counted(groups.len(), "other combination") + " of wave and settings";
        return match halved {
            0 => format!(" In {all} {no_wall}."),
            _ => format!(" In {halved} of {all} some wall halves it."),
        };
    }
    match (range(&some, ""), range(&none, "")) {
        (_, without) if some.is_empty() => format!(" At H/h = {without} {no_wall}."),
        (with, _) if none.is_empty() => format!(" At H/h = {with} some wall halves it{too}."),
        (with, without) => {
            format!(" At H/h = {with} some wall halves it, at H/h = {without} none.")
        }
    }
}

#[cfg(test)]
mod tests;
