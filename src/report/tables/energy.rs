//! The energy budgets, each beside its case's place in the sweep.

use super::{Table, plain};
use crate::report::load::Loaded;
use crate::report::row::Row;

/// A column and where its value stands in a row.
type Place = (&'static str, fn(&Row) -> Option<f64>);

/// What tells a case from the others, for tables that do not say so themselves.
const PLACE: [Place; 4] = [
    ("wave_height_ratio", |row| row.wave_height_ratio),
    ("spring_stiffness_n_per_m", |row| row.spring_stiffness_n_per_m),
    ("seawall_mass_kg_per_m", |row| row.seawall_mass_kg_per_m),
    ("force_coupling", |row| row.force_coupling),
];

/// The table; `None` where the directory has no budgets.
pub fn energy(data: &Loaded) -> Option<Table> {
    let raw = data.energy.as_ref()?;
    let id = raw.header.iter().position(|name| name == "case_id")?;
    let place = PLACE.into_iter().filter(|(name, _)| !raw.header.iter().any(|known| known == name));
    let others = |cells: &[String]| {
        let kept = cells.iter().enumerate().filter(|(at, _)| *at != id);
        kept.map(|(_, cell)| cell.clone()).collect::<Vec<_>>()
    };
    let line = |cells: &Vec<String>| {
        let row = data.rows.iter().find(|row| row.case_id == cells[id]);
        let mut line = vec![cells[id].clone()];
        line.extend(place.clone().map(|(_, read)| plain(row.and_then(read))));
        line.extend(others(cells));
        line
    };
    let rows = raw.rows.iter().map(line).collect();
    let mut header = vec!["case_id".to_owned()];
    header.extend(place.clone().map(|(name, _)| name.to_owned()));
    header.extend(others(&raw.header));
    Some(Table { name: "energy".to_owned(), title: "Energy".to_owned(), header, rows })
}
