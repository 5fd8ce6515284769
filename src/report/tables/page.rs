//! A table as the page shows it: only columns that hold anything, error bars beside their values,
//! no more digits than one reads.

use super::{Table, VARIANT};
use crate::quantities::{Column, named};
use crate::report::number;

impl Table {
    /// The table without empty columns, with bars beside values (`2.41 ± 0.03`) and numbers cut
    /// to a few digits.
    pub fn for_page(&self) -> Table {
        let mut table = self.clone();
        for column in &self.header {
            if let Some(bar) = named(column).and_then(|column| column.bar) {
                table.join(column, bar);
            }
        }
        let filled = |column: usize| has_cells(&table, column);
        let kept: Vec<_> = (0..table.header.len()).filter(|column| filled(*column)).collect();
        let words = |name: &str| name == VARIANT || named(name).is_some_and(Column::is_text);
        let cell = |row: &[String], column: usize| {
            let text = &row[column];
            if words(&table.header[column]) { text.clone() } else { number::brief(text) }
        };
        let rows = table.rows.iter().map(|row| kept.iter().map(|at| cell(row, *at)).collect());
        let header = kept.iter().map(|column| table.header[*column].clone()).collect();
        Table { rows: rows.collect(), header, ..table.clone() }
    }

    /// Puts the cells of an error's column behind those of its value, and empties them.
    fn join(&mut self, value: &str, error: &str) {
        let place = |name: &str| self.header.iter().position(|column| column == name);
        let Some((value, error)) = place(value).zip(place(error)) else { return };
        for row in &mut self.rows {
            let bar = std::mem::take(&mut row[error]);
            if let (Ok(value_read), Ok(bar)) = (row[value].parse(), bar.parse()) {
                row[value] = number::with_error(value_read, bar);
            }
        }
    }
}

fn has_cells(table: &Table, column: usize) -> bool {
    table.rows.is_empty() || table.rows.iter().any(|row| !row[column].is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(page.rows[1], ["b", "2.4137", "5"]);
    }

    #[test]
    fn long_numbers_are_cut() {
        let cells = vec![vec!["a".to_owned(), "-8.939208979763524e-6".to_owned()]];
        let page =
            Table::new("energy", "Energy", &["case_id", "elastic_j_per_m"], cells).for_page();
        assert_eq!(page.rows[0][1], "-8.939×10⁻⁶");
    }
}
