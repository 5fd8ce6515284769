//! A table and its text.

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
    /// How many rows the file has besides.
    pub left: usize,
    /// Whether these are not the file's first rows but those of a selection of cases.
    pub is_part: bool,
}

impl Table {
    /// A table.
    pub fn new(name: &str, title: &str, header: &[impl ToString], rows: Vec<Vec<String>>) -> Table {
        let (name, title) = (name.to_owned(), title.to_owned());
        let header = header.iter().map(ToString::to_string).collect();
        Table { name, title, header, rows, ..Table::default() }
    }

    /// The same as the part of a larger one that it is.
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
        let mut writer = csv::Writer::from_writer(Vec::new());
        let records = std::iter::once(&self.header).chain(&self.rows);
        for record in records {
            writer.write_record(record).expect("rows are as wide as their header");
        }
        let bytes = writer.into_inner().expect("memory does not run dry");
        String::from_utf8(bytes).expect("cells are text")
    }
}
