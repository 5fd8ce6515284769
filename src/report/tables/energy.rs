//! The energy budgets, each beside its case's place in the sweep.

use std::collections::HashMap;

use csv::StringRecord;

use super::{Lines, cells};
use crate::quantities::Column;
use crate::quantities::summary::{CASE_ID, FORCE_COUPLING};
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row};

/// The table; `None` where the directory has no budgets.
pub fn energy(data: &Loaded) -> Option<Lines<'_>> {
    let raw = data.energy.as_ref()?;
    let id = raw.header.iter().position(|name| name == CASE_ID.name)?;
    let place = PLACE.into_iter().chain([&FORCE_COUPLING]);
    let place = place.filter(|column| !raw.header.iter().any(|known| known == column.name));
    let place: Vec<&Column> = place.collect();
    let rows: HashMap<_, _> = data.rows.iter().map(|row| (row.text(&CASE_ID), row)).collect();
    let names = place.iter().map(|column| column.name.to_owned()).collect();
    let header = with(id, CASE_ID.name, names, raw.header.iter());
    let line = move |line: &StringRecord| {
        let none = Row::default();
        let row = rows.get(&line[id]).copied().unwrap_or(&none);
        Ok(with(id, &line[id], cells(row, &place), line.iter()))
    };
    Some(Lines::new("energy", "Energy", header, raw.rows.iter().map(line)))
}

/// A line with the case's place behind its id.
fn with<'a>(
    id: usize,
    first: &str,
    place: Vec<String>,
    line: impl Iterator<Item = impl AsRef<str> + 'a>,
) -> Vec<String> {
    let others = line.enumerate().filter(|(at, _)| *at != id);
    let others = others.map(|(_, cell)| cell.as_ref().to_owned());
    [first.to_owned()].into_iter().chain(place).chain(others).collect()
}
