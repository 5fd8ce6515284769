//! A legend above the panels: entries side by side, wrapped to the sheet's width.

use super::pen::{Align, Fault, Look, Pen};

const SIZE: f64 = 12.0;
const ROW: f64 = 20.0;
const SAMPLE: f64 = 28.0;

/// One entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What it says.
    pub label: String,
    /// How it looks.
    pub look: Look,
    /// With a line through it.
    pub line: bool,
    /// With a marker: filled, or open.
    pub marker: Option<bool>,
}

/// Entries placed in rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    placed: Vec<(f64, f64, Entry)>,
    rows: usize,
}

impl Legend {
    /// Places entries between the given left and right edges.
    pub fn new(entries: Vec<Entry>, left: f64, right: f64) -> Legend {
        let (mut x, mut row) = (left, 0);
        let mut placed = Vec::new();
        for entry in entries {
            let width = SAMPLE + 8.0 + 0.58 * SIZE * entry.label.chars().count() as f64 + 18.0;
            if x > left && x + width > right {
                (x, row) = (left, row + 1);
            }
            placed.push((x, ROW * (row as f64 + 0.5), entry));
            x += width;
        }
        Legend { placed, rows: row + 1 }
    }

    /// Its height.
    pub fn height(&self) -> f64 {
        ROW * self.rows as f64
    }

    /// Draws it with its upper edge at `top`.
    pub fn draw(&self, pen: &Pen, top: f64) -> Result<(), Fault> {
        for (x, y, entry) in &self.placed {
            let y = top + y;
            if entry.line {
                pen.line(&[(*x, y), (x + SAMPLE, y)], entry.look.colour, 1.8)?;
            }
            if let Some(open) = entry.marker {
                pen.marker((x + SAMPLE / 2.0, y), entry.look, open)?;
            }
            pen.text((x + SAMPLE + 8.0, y), &entry.label, SIZE, Align::Left)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_wrap_before_the_right_edge() {
        let entry =
            Entry { label: "k = 10 N/m".to_owned(), look: Look::of(0), line: true, marker: None };
        let legend = Legend::new(vec![entry; 9], 10.0, 400.0);
        assert!(legend.rows > 1);
        assert!(legend.placed.iter().all(|(x, ..)| *x < 400.0 - 100.0));
    }
}
