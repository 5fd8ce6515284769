//! The largest pressures up the wall, of all cases in one table.

use super::{Table, plain};
use crate::quantities::envelope::ALL;
use crate::quantities::summary::CASE_ID;
use crate::report::error::ReportError;
use crate::report::load::Loaded;

/// A line for every height of every finished case, to every digit; `None` where there are none.
pub fn envelope(data: &Loaded) -> Result<Option<Table>, ReportError> {
    let mut rows = Vec::new();
    for row in data.finished() {
        let id = row.text(&CASE_ID);
        rows.extend(data.envelope(id)?.iter().map(|at| {
            let numbers = [Some(at.height_m), Some(at.pressure_max_pa), at.first_pressure_max_pa];
            let cells = numbers.into_iter().map(plain);
            [id.to_owned(), row.words()].into_iter().chain(cells).collect()
        }));
    }
    let header = [CASE_ID.name, "case"].into_iter().chain(ALL.iter().map(|column| column.name));
    let header: Vec<_> = header.collect();
    let table = || Table::new("pressure_envelope", "Pressure envelope", &header, rows.clone());
    Ok((!rows.is_empty()).then(table))
}
