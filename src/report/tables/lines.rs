//! A table whose rows are made as they are written: that of a large study is never held whole.

use std::fs::File;
use std::path::Path;

use super::Table;
use crate::report::error::ReportError;

/// A row, or why a file that it is made from cannot be read.
pub type Line = Result<Vec<String>, ReportError>;

/// A table that is still to be made.
pub struct Lines<'a> {
    /// File name without its ending.
    pub name: String,
    title: String,
    header: Vec<String>,
    rows: Box<dyn Iterator<Item = Line> + 'a>,
}

impl<'a> Lines<'a> {
    /// A table of these rows.
    pub fn new(
        name: &str,
        title: &str,
        header: Vec<String>,
        rows: impl Iterator<Item = Line> + 'a,
    ) -> Lines<'a> {
        let (name, title) = (name.to_owned(), title.to_owned());
        Lines { name, title, header, rows: Box::new(rows) }
    }

    /// The same; `None` where there are no rows.
    pub fn some(
        name: &str,
        title: &str,
        header: Vec<String>,
        rows: impl Iterator<Item = Line> + 'a,
    ) -> Option<Lines<'a>> {
        let mut rows = rows.peekable();
        rows.peek()?;
        Some(Lines::new(name, title, header, rows))
    }

    /// Writes the table as comma-separated text, and keeps its first rows.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn write(self, path: &Path, most: usize) -> Result<Table, ReportError> {
        let wrong = |source| ReportError::Write { path: path.to_owned(), source };
        let file = File::create(path).map_err(wrong)?;
        let mut writer = csv::WriterBuilder::new().buffer_capacity(1 << 16).from_writer(file);
        let mut table = Table { rows: Vec::new(), left: 0, ..self.head() };
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
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn whole(self) -> Result<Table, ReportError> {
        let head = self.head();
        Ok(Table { rows: self.rows.collect::<Result<_, _>>()?, ..head })
    }

    fn head(&self) -> Table {
        let (name, title) = (self.name.clone(), self.title.clone());
        let header = self.header.clone();
        Table { name, title, header, rows: Vec::new(), left: 0, is_part: false }
    }
}

impl From<Table> for Lines<'_> {
    fn from(table: Table) -> Self {
        Lines::new(&table.name, &table.title, table.header, table.rows.into_iter().map(Ok))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_every_row_and_the_page_the_first() {
        let root = tempfile::tempdir().unwrap();
        let rows = (0..10).map(|row| Ok(vec![row.to_string(), "a, b".to_owned()]));
        let header = ["row", "words"].map(str::to_owned).to_vec();
        let lines = Lines::new("a", "A", header.clone(), rows);
        let path = root.path().join("a.csv");
        let table = lines.write(&path, 3).unwrap();
        assert_eq!((table.rows.len(), table.left), (3, 7));
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 11);
        assert!(text.starts_with("row,words\n0,\"a, b\"\n"), "{text}");
        assert!(Lines::some("a", "A", header, std::iter::empty()).is_none());
    }
}
