//! The largest pressures up the wall, of all cases in one table.

use super::{Line, Lines, names, plain};
use crate::quantities::envelope::ALL;
use crate::quantities::summary::CASE_ID;
use crate::report::load::Loaded;
use crate::report::row::Row;
use crate::report::series::Pressed;

/// A line for every height of every finished case, to every digit; `None` where there are none.
pub fn envelope(data: &Loaded) -> Option<Lines<'_>> {
    let of = |row: &Row| -> Vec<Line> {
        let id = row.id();
        let line = |at: &Pressed| {
            let numbers = [Some(at.height_m), Some(at.pressure_max_pa), at.first_pressure_max_pa];
            let cells = numbers.into_iter().map(plain);
            [id.to_owned(), row.words()].into_iter().chain(cells).collect()
        };
        match data.envelope(id) {
            Ok(heights) => heights.iter().map(|at| Ok(line(at))).collect(),
            Err(error) => vec![Err(error)],
        }
    };
    let header = [&[CASE_ID.name, "case"], &names(ALL)[..]].concat();
    let rows = data.finished().flat_map(of);
    Lines::new("pressure_envelope", "Pressure envelope", &header, rows).filled()
}
