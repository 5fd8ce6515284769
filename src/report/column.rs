//! One column of a table in little memory: each different cell is kept once.

use std::collections::HashMap;
use std::ops::Index;
use std::sync::Arc;

/// The cells of a column, row by row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cells {
    different: Vec<Arc<str>>,
    at: Vec<u32>,
    places: HashMap<Arc<str>, u32>,
}

impl Cells {
    /// Adds the cell of the next row.
    ///
    /// # Panics
    /// With more than four thousand million different cells.
    pub fn push(&mut self, cell: &str) {
        let place = self.places.get(cell).copied().unwrap_or_else(|| {
            let place = u32::try_from(self.different.len()).expect("rows are far fewer");
            let cell: Arc<str> = cell.into();
            self.different.push(cell.clone());
            self.places.insert(cell, place);
            place
        });
        self.at.push(place);
    }

    /// All cells in the order of the rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> + Clone {
        self.at.iter().map(|&place| &*self.different[place as usize])
    }

    /// The different cells in the order of their first rows.
    pub fn different(&self) -> impl Iterator<Item = &str> {
        self.different.iter().map(|cell| &**cell)
    }

    /// The cell of a row. It shares its text with the column.
    pub fn shared(&self, row: usize) -> Arc<str> {
        self.different[self.at[row] as usize].clone()
    }

    /// The column with each different text replaced.
    pub fn map(&self, text: impl FnMut(&str) -> String) -> Cells {
        let texts: Vec<_> = self.different().map(text).collect();
        self.at.iter().map(|&place| &texts[place as usize]).collect()
    }
}

impl Index<usize> for Cells {
    type Output = str;

    fn index(&self, row: usize) -> &str {
        &self.different[self.at[row] as usize]
    }
}

impl<S: AsRef<str>> FromIterator<S> for Cells {
    fn from_iter<I: IntoIterator<Item = S>>(cells: I) -> Cells {
        let mut all = Cells::default();
        cells.into_iter().for_each(|cell| all.push(cell.as_ref()));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_has_every_cell_in_its_row_and_each_text_once() {
        let cells: Cells = ["b", "a", "", "b"].into_iter().collect();
        assert_eq!(cells.iter().collect::<Vec<_>>(), ["b", "a", "", "b"]);
        assert_eq!(cells.different().collect::<Vec<_>>(), ["b", "a", ""]);
        assert_eq!(&cells[3], "b");
        assert!(Arc::ptr_eq(&cells.shared(0), &cells.shared(3)));
        let long = cells.map(|cell| format!("{cell}{cell}"));
        assert_eq!(long.iter().collect::<Vec<_>>(), ["bb", "aa", "", "bb"]);
        assert_ne!(long, cells);
    }
}
