//! The energy budgets, with each case's place in the sweep.

use std::collections::HashMap;

use csv::StringRecord;

use super::{Lines, VARIANT, cells};
use crate::quantities::Column;
use crate::quantities::summary::{CASE_ID, FORCE_COUPLING};
use crate::report::error::ReportError;
use crate::report::load::{self, Loaded};
use crate::report::row::{PLACE, Row};

/// The table; `None` where the directory has no budgets.
pub fn energy(data: &Loaded) -> Option<Lines<'_>> {
    let (header, records) = match load::stream(data.energy.as_ref()?) {
        Ok(table) => table,
        Err(error) => {
            return Some(Lines::new(NAME, TITLE, &[""; 0], std::iter::once(Err(error))));
        }
    };
    let id = header.iter().position(|name| name == CASE_ID.name)?;
    let place = PLACE.into_iter().chain([&FORCE_COUPLING]);
    let place = place.filter(|column| !header.iter().any(|known| known == column.name));
    let place: Vec<&Column> = place.collect();
    let rows: HashMap<_, _> = data.rows.iter().map(|row| (row.id(), row)).collect();
    let told = rows.values().any(|row| !row.variant.is_empty());
    let names = place.iter().map(|column| column.name.to_owned());
    let names = names.chain(told.then(|| VARIANT.to_owned())).collect();
    let header = with(id, CASE_ID.name, names, header.iter());
    let none = Row::default();
    let line = move |line: Result<StringRecord, ReportError>| {
        let line = match line {
            Ok(line) => line,
            Err(error) => return Some(Err(error)),
        };
        let row = rows.get(&line[id]).copied();
        let row = if data.is_part { row? } else { row.unwrap_or(&none) };
        let mut place = cells(row, &place);
        place.extend(told.then(|| row.variant.to_string()));
        Some(Ok(with(id, &line[id], place, line.iter())))
    };
    Some(Lines::new(NAME, TITLE, &header, records.filter_map(line)))
}

const NAME: &str = "energy";
const TITLE: &str = "Energy";

/// A line with the case's place after its id.
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
