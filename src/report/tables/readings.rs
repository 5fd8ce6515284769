//! Tables from the files of single cases: readings that the summary has no column for, such as
//! arrival times, plateaus, gaps and decays, and the largest pressures up the wall.

use std::collections::BTreeMap;

use super::{Line, Lines, Table, names, or_empty};
use crate::math::lists::different;
use crate::quantities::envelope::ALL;
use crate::quantities::summary::CASE_ID;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::series::{Pressed, Reading};

/// So many cases stand side by side on the page; more stand one below the other.
const SIDE_BY_SIDE: usize = 6;

/// All readings of finished cases, one per line, with every digit; `None` where there are none.
pub fn readings(data: &Loaded) -> Option<Lines<'_>> {
    let cells = |one: Reading| vec![one.name, or_empty(one.value), one.unit];
    let header = [CASE_ID.name, "case", "reading", "value", "unit"];
    let rows = of_cases(data, Loaded::readings, cells);
    Lines::new("readings", "Readings", &header, rows).filled()
}

/// The largest pressures at every height of all walls; `None` where there are none.
pub fn envelope(data: &Loaded) -> Option<Lines<'_>> {
    let cells = |at: Pressed| {
        let numbers = [Some(at.height_m), Some(at.pressure_max_pa), at.first_pressure_max_pa];
        numbers.map(or_empty).to_vec()
    };
    let header = [&[CASE_ID.name, "case"], &names(ALL)[..]].concat();
    let rows = of_cases(data, Loaded::envelope, cells);
    Lines::new("pressure_envelope", "Pressure envelope", &header, rows).filled()
}

/// A line for each entry in the file of a finished case, after its id and words.
fn of_cases<'a, T>(
    data: &'a Loaded,
    read: fn(&Loaded, &str) -> Result<Vec<T>, ReportError>,
    cells: fn(T) -> Vec<String>,
) -> impl Iterator<Item = Line> + 'a
where
    T: 'a,
{
    data.finished().flat_map(move |row| -> Vec<Line> {
        let line = |one| [vec![row.id().to_owned(), row.words()], cells(one)].concat();
        match read(data, row.id()) {
            Ok(all) => all.into_iter().map(|one| Ok(line(one))).collect(),
            Err(error) => vec![Err(error)],
        }
    })
}

/// The table of `readings` as the page shows it: a line per reading and a column per case, or,
/// with many cases, the other way round.
pub fn across(long: &Table) -> Table {
    type Name<'a> = (&'a str, &'a str);
    let (mut cases, mut names) = (Vec::new(), Vec::new());
    let mut values = BTreeMap::new();
    for row in &long.rows {
        let [id, words, name, value, unit] = row.as_slice() else { continue };
        let (case, name) = ((id.as_str(), words.as_str()), (name.as_str(), unit.as_str()));
        cases.push(case);
        names.push(name);
        let value = value.parse().map(number::as_typed).unwrap_or_default();
        values.insert((case, name), value);
    }
    cases.dedup();
    let names = different(names);
    let cell = |case: Name, name: Name| values.get(&(case, name)).cloned().unwrap_or_default();
    // A single case needs no name. Several without words go by their ids.
    let case_name = |(id, words): &Name| match (cases.len(), words.is_empty()) {
        (1, _) => "value".to_owned(),
        (_, true) => (*id).to_owned(),
        (_, false) => (*words).to_owned(),
    };
    let with_unit = |(name, unit): &Name| {
        if unit.is_empty() { (*name).to_owned() } else { format!("{name}, {unit}") }
    };
    let (header, rows): (Vec<String>, Vec<Vec<String>>) = if cases.len() <= SIDE_BY_SIDE {
        let line = |name: &Name| {
            let cells = cases.iter().map(|case| cell(*case, *name));
            std::iter::once(name.0.to_owned()).chain(cells).chain([name.1.to_owned()]).collect()
        };
        let titles = cases.iter().map(case_name);
        let header = std::iter::once("reading".to_owned()).chain(titles).chain(["unit".to_owned()]);
        (header.collect(), names.iter().map(line).collect())
    } else {
        let line = |case: &Name| {
            let cells = names.iter().map(|name| cell(*case, *name));
            std::iter::once(case_name(case)).chain(cells).collect()
        };
        let header = std::iter::once("case".to_owned()).chain(names.iter().map(with_unit));
        (header.collect(), cases.iter().map(line).collect())
    };
    Table { header, rows, ..long.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn of(cases: usize) -> Table {
        let directory = fixture::dam_breaks(cases);
        readings(&Loaded::read(directory.path()).unwrap()).unwrap().whole().unwrap()
    }

    #[test]
    fn a_file_holds_every_digit_and_a_page_four() {
        let long = of(1);
        assert!(long.csv().contains("case-0000,,front_at_wall,1.6123456789,sqrt(H/g)"));
        let page = across(&long);
        assert_eq!(page.header, ["reading", "value", "unit"]);
        assert_eq!(page.rows[0], ["front_at_wall", "1.612", "sqrt(H/g)"]);
        assert_eq!(page.rows[1], ["cavity_closure", "", "sqrt(H/g)"]);
    }

    #[test]
    fn many_cases_stand_one_below_the_other() {
        let few = across(&of(3));
        assert_eq!(few.header[1], "column height = 0.6 m");
        assert_eq!((few.header.len(), few.rows.len()), (5, 2));
        let many = across(&of(9));
        assert_eq!(many.header[1], "front_at_wall, sqrt(H/g)");
        assert_eq!((many.header.len(), many.rows.len()), (3, 9));
    }

    #[test]
    fn a_sweep_without_readings_has_no_table() {
        let directory = fixture::sweep();
        assert!(readings(&Loaded::read(directory.path()).unwrap()).is_none());
    }
}
