//! The energy budgets, each beside its case's place in the sweep.

use super::{Table, cells};
use crate::quantities::Column;
use crate::quantities::summary::{CASE_ID, FORCE_COUPLING};
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row};

/// The table; `None` where the directory has no budgets.
pub fn energy(data: &Loaded) -> Option<Table> {
    let raw = data.energy.as_ref()?;
    let id = raw.header.iter().position(|name| name == CASE_ID.name)?;
    let place = PLACE.into_iter().chain([&FORCE_COUPLING]);
    let place = place.filter(|column| !raw.header.iter().any(|known| known == column.name));
    let place: Vec<&Column> = place.collect();
    let with = |first: &str, place: Vec<String>, line: &[String]| {
        let others = line.iter().enumerate().filter(|(at, _)| *at != id);
        let others = others.map(|(_, cell)| cell.clone());
        [first.to_owned()].into_iter().chain(place).chain(others).collect::<Vec<_>>()
    };
    let none = Row::default();
    let line = |line: &Vec<String>| {
        let row = data.rows.iter().find(|row| row.text(&CASE_ID) == line[id]);
        with(&line[id], cells(row.unwrap_or(&none), &place), line)
    };
    let names = place.iter().map(|column| column.name.to_owned()).collect();
    Some(Table {
        name: "energy".to_owned(),
        title: "Energy".to_owned(),
        header: with(CASE_ID.name, names, &raw.header),
        rows: raw.rows.iter().map(line).collect(),
    })
}
