//! A table and its text. A large table is never held whole: its rows are made as they are written.

use std::fs::File;
use std::path::Path;

use crate::disk::write_whole;
use crate::math::comma::csv;
use crate::report::error::ReportError;

/// A table, ready for a file or a page.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// File name without its ending.
    pub name: String,
    /// Heading in the report.
    pub title: String,
    /// Column names.
    pub header: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// How many more rows the file has.
    pub left: usize,
    /// Whether these rows are a selection of cases rather than the file's first rows.
    pub is_part: bool,
}

impl Table {
    /// A table.
    pub fn new(name: &str, title: &str, header: &[impl ToString], rows: Vec<Vec<String>>) -> Table {
        let (name, title) = (name.to_owned(), title.to_owned());
        let header = header.iter().map(ToString::to_string).collect();
        Table { name, title, header, rows, ..Table::default() }
    }

    /// The table, marked as part of a larger one.
    pub fn part_of(self, whole: &Table) -> Table {
        let left = (whole.rows.len() + whole.left).saturating_sub(self.rows.len());
        Table { left, is_part: true, ..self }
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
        let rule = format!("|{}\n", "---|".repeat(self.header.len()));
        line(&self.header) + &rule + &self.rows.iter().map(line).collect::<String>()
    }

    /// The table as comma-separated text.
    pub fn csv(&self) -> String {
        csv(std::iter::once(&self.header).chain(&self.rows))
    }
}

/// A row, or why a source file cannot be read.
pub type Line = Result<Vec<String>, ReportError>;

/// A table whose rows are made one by one.
pub struct Lines<'a> {
    /// The table without its rows.
    pub head: Table,
    rows: Box<dyn Iterator<Item = Line> + 'a>,
}

impl<'a> Lines<'a> {
    /// A table of these rows.
    pub fn new(
        name: &str,
        title: &str,
        header: &[impl ToString],
        rows: impl Iterator<Item = Line> + 'a,
    ) -> Lines<'a> {
        Lines { head: Table::new(name, title, header, Vec::new()), rows: Box::new(rows) }
    }

    /// The same table; `None` where there are no rows.
    pub fn filled(self) -> Option<Lines<'a>> {
        let mut rows = self.rows.peekable();
        rows.peek()?;
        Some(Lines { rows: Box::new(rows), ..self })
    }

    /// Writes the table as comma-separated text, and keeps its first rows.
    pub fn write(self, path: &Path, most: usize) -> Result<Table, ReportError> {
        let wrong = |error| ReportError::Write { path: path.to_owned(), error };
        write_whole(path, wrong, |file| self.fill(file, most, &wrong))
    }

    fn fill(
        self,
        file: &File,
        most: usize,
        wrong: &dyn Fn(std::io::Error) -> ReportError,
    ) -> Result<Table, ReportError> {
        let mut writer = csv::WriterBuilder::new().buffer_capacity(1 << 16).from_writer(file);
        let mut table = self.head;
        let broken = |error: csv::Error| wrong(error.into());
        writer.write_record(&table.header).map_err(broken)?;
        for row in self.rows {
            let row = row?;
            writer.write_record(&row).map_err(broken)?;
            if table.rows.len() < most { table.rows.push(row) } else { table.left += 1 }
        }
        writer.flush().map_err(wrong)?;
        Ok(table)
    }

    /// The table with all its rows.
    pub fn whole(self) -> Result<Table, ReportError> {
        Ok(Table { rows: self.rows.collect::<Result<_, _>>()?, ..self.head })
    }
}

impl From<Table> for Lines<'_> {
    fn from(mut head: Table) -> Self {
        let rows = std::mem::take(&mut head.rows);
        Lines { head, rows: Box::new(rows.into_iter().map(Ok)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_every_row_and_the_page_the_first() {
        let root = tempfile::tempdir().unwrap();
        let rows = (0..10).map(|row| Ok(vec![row.to_string(), "a, b".to_owned()]));
        let header = ["row", "words"];
        let lines = Lines::new("a", "A", &header, rows);
        let path = root.path().join("a.csv");
        let table = lines.write(&path, 3).unwrap();
        assert_eq!((table.rows.len(), table.left), (3, 7));
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 11);
        assert!(text.starts_with("row,words\n0,\"a, b\"\n"), "{text}");
        assert!(Lines::new("a", "A", &header, std::iter::empty()).filled().is_none());
    }
}
