//! A table as the page shows it: without empty columns, with error bars beside their values, with
//! marks for lower bounds, and with few digits.

use super::{Table, VARIANT};
use crate::quantities::summary::{DOUBTFUL, FORCE_COUPLING, STATUS};
use crate::quantities::{Column, named};
use crate::report::number;
use crate::report::row::PLACE;
use crate::report::spoken::all_spoken;

/// Columns that say nothing if all cases have the same value in them.
const ALIKE: [&Column; 2] = [&STATUS, &FORCE_COUPLING];

impl Table {
    /// The table without empty columns, with bars beside values (`2.41 ± 0.03`), with marks for
    /// bounds (`≥ 2.41 − 0.03`), and with numbers cut to a few digits.
    pub fn for_page(&self) -> Table {
        let columns = self.header.iter().filter_map(|name| named(name));
        self.joined(columns.map(|column| (column.name, column.bar, column.bound)))
    }

    /// The same for a table whose columns have names of their own: each value's name, and those of its
    /// bar and of its bound's flag.
    pub fn joined<'n>(
        &self,
        values: impl Iterator<Item = (&'n str, Option<&'n str>, Option<&'n str>)>,
    ) -> Table {
        let mut table = self.clone();
        table.judge();
        for (name, bar, bound) in values {
            table.join(name, bar, bound);
        }
        let told = |at: usize| has_cells(&table, at) && !table.is_alike(at);
        let kept: Vec<_> = (0..table.header.len()).filter(|at| told(*at)).collect();
        let cell = |row: &[String], at: usize| shown_cell(&table.header[at], &row[at]);
        let rows = table.rows.iter().map(|row| kept.iter().map(|at| cell(row, *at)).collect());
        let header = kept.iter().map(|column| table.header[*column].clone()).collect();
        Table { rows: rows.collect(), header, ..table }
    }

    fn is_alike(&self, at: usize) -> bool {
        let name = &self.header[at];
        ALIKE.iter().any(|column| column.name == *name)
            && self.rows.iter().all(|row| row[at] == self.rows[0][at] && row[at] != DOUBTFUL.name)
    }

    /// Writes `doubtful` in place of the status of doubtful cases, as the terminal does.
    fn judge(&mut self) {
        let place = |column: &Column| self.header.iter().position(|known| *known == column.name);
        let (Some(status), Some(flag)) = (place(&STATUS), place(&DOUBTFUL)) else { return };
        for row in &mut self.rows {
            if std::mem::take(&mut row[flag]) == "true" {
                DOUBTFUL.name.clone_into(&mut row[status]);
            }
        }
    }

    /// Moves the error bar and the bound's flag into the value's cell, and empties theirs.
    fn join(&mut self, name: &str, bar: Option<&str>, bound: Option<&str>) {
        let place =
            |name: Option<&str>| self.header.iter().position(|known| Some(&**known) == name);
        let Some(value) = place(Some(name)) else { return };
        let (error, flag) = (place(bar), place(bound));
        for row in &mut self.rows {
            let mut take = |at: Option<usize>| at.map(|at| std::mem::take(&mut row[at]));
            let bar = take(error).and_then(|cell| cell.parse().ok());
            let is_bound = take(flag).is_some_and(|cell| cell == "true");
            let Ok(read) = row[value].parse() else { continue };
            row[value] = match (is_bound, bar) {
                (true, Some(bar)) => number::bound_with_error(read, bar),
                (true, None) => format!("≥ {}", shown_cell(name, &row[value])),
                (false, Some(bar)) => number::with_error(read, bar),
                (false, None) => continue,
            };
        }
    }
}

/// A cell with the digits of its column. What [`Table::join`] has written is no number and stays.
fn shown_cell(name: &str, cell: &str) -> String {
    let column = named(name);
    if name == VARIANT {
        return all_spoken(cell);
    }
    if column.is_some_and(Column::is_text) {
        return cell.to_owned();
    }
    if let (true, Ok(value)) = (PLACE.iter().any(|column| column.name == name), cell.parse()) {
        return number::as_typed(value);
    }
    let told = column.zip(cell.parse().ok());
    let told = told
        .and_then(|(column, value)| number::with_digits(column.told_value(value), column.digits));
    told.unwrap_or_else(|| number::shortened(cell))
}

fn has_cells(table: &Table, column: usize) -> bool {
    table.rows.is_empty() || table.rows.iter().any(|row| !row[column].is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{
        CASE_ID, DISPLACEMENT_ERROR, DISPLACEMENT_MAX, FORCE_MAX, FORCE_MAX_ERROR, RUNUP_MAX,
        RUNUP_MAX_ERROR,
    };
    use crate::report::load::Loaded;
    use crate::report::row::Row;

    #[test]
    fn bars_join_their_values_and_empty_columns_go() {
        let row = |cells: [&str; 5]| cells.map(str::to_owned).to_vec();
        let table = Table::new(
            "summary",
            "Cases",
            &["case_id", "first_force_max", "stops", "force_error", "steps"],
            vec![
                row(["1234567e1", "2.4137", "", "0.0312", "1234567"]),
                row(["b", "2.4137", "", "", "5"]),
            ],
        );
        let page = table.for_page();
        assert_eq!(page.header, ["case_id", "first_force_max", "steps"]);
        assert_eq!(page.rows[0], ["1234567e1", "2.41 ± 0.03", "1234567"]);
        assert_eq!(page.rows[1], ["b", "2.414", "5"]);
    }

    #[test]
    fn bounds_are_told_and_columns_that_are_alike_go() {
        let header = [
            "case_id",
            "status",
            "displacement_max",
            "displacement_truncated",
            "displacement_error",
        ];
        let row = |cells: [&str; 5]| cells.map(str::to_owned).to_vec();
        let rows = vec![
            row(["a", "ok", "2.4137", "true", "0.0312"]),
            row(["b", "ok", "2.4137", "true", ""]),
            row(["c", "ok", "2.4137", "false", ""]),
        ];
        let page = Table::new("summary", "Cases", &header, rows).for_page();
        assert_eq!(page.header, ["case_id", "displacement_max"]);
        let cells: Vec<_> = page.rows.iter().map(|row| row[1].as_str()).collect();
        assert_eq!(cells, ["≥ 2.41 − 0.03", "≥ 2.414", "2.414"]);
    }

    /// These came out as 0.01510 and 2.263: they were rounded to four decimals, then to their bars.
    #[test]
    fn a_value_is_rounded_once() {
        let row = |value: f64, bar: f64| {
            let row = Row::default().with(&CASE_ID, "a").with(&STATUS, "ok");
            row.with(&DISPLACEMENT_MAX, value).with(&DISPLACEMENT_ERROR, bar)
        };
        let rows = vec![row(0.015147, 0.00019), row(2.262462, 0.0012)];
        let data = Loaded { rows, ..Loaded::default() };
        let table = super::super::summary(&data).whole().unwrap();
        let at = |table: &Table| {
            let is = |name: &String| name == DISPLACEMENT_MAX.name;
            let at = table.header.iter().position(is).unwrap();
            table.rows.iter().map(|row| row[at].clone()).collect::<Vec<_>>()
        };
        assert_eq!(at(&table), ["0.015147", "2.262462"], "the file has every digit");
        assert_eq!(at(&table.for_page()), ["0.01515 ± 0.00019", "2.2625 ± 0.0012"]);
        let told = number::with_error(0.015147, 0.00019);
        assert_eq!(told, at(&table.for_page())[0], "as the terminal writes it");
    }

    /// The story: a wave without a first impact had bars in the terminal, but not on the page.
    #[test]
    fn maxima_of_the_whole_run_have_their_bars() {
        let row = Row::default().with(&CASE_ID, "a").with(&STATUS, "ok");
        let row = row.with(&FORCE_MAX, 1.1164).with(&FORCE_MAX_ERROR, 0.0031);
        let row = row.with(&RUNUP_MAX, 0.088).with(&RUNUP_MAX_ERROR, 0.011);
        let data = Loaded { rows: vec![row], ..Loaded::default() };
        let page = super::super::summary(&data).whole().unwrap().for_page();
        assert_eq!(page.header[1..], [FORCE_MAX.name, RUNUP_MAX.name]);
        assert_eq!(page.rows[0][1..], ["1.116 ± 0.003", "0.088 ± 0.011"]);
    }

    /// If there were failed cases, the page had doubtful ones as "ok".
    #[test]
    fn a_doubtful_case_is_not_ok() {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        let header = ["case_id", "status", "doubtful"];
        let all = [["a", "ok", "true"], ["b", "ok", "false"], ["c", "failed", ""]].map(row);
        let page = |rows: &[Vec<String>]| {
            let page = Table::new("summary", "Cases", &header, rows.to_vec()).for_page();
            page.rows.iter().map(|row| row[1..].join(" ")).collect::<Vec<_>>()
        };
        assert_eq!(page(&all), ["doubtful", "ok", "failed"]);
        assert_eq!(page(&all[..1]), ["doubtful"]);
        assert_eq!(page(&all[1..2]), [""]);
    }

    #[test]
    fn long_numbers_are_cut() {
        let cells = vec![vec!["a".to_owned(), "-8.939208979763524e-6".to_owned()]];
        let page =
            Table::new("energy", "Energy", &["case_id", "elastic_j_per_m"], cells).for_page();
        assert_eq!(page.rows[0][1], "-8.939×10⁻⁶");
    }
}
