//! Air enclosed by water: found on a raster by flooding the air from above.

use std::ops::Range;

/// A raster over the tank that knows which cells are wet.
pub(super) struct Raster {
    cell: f64,
    columns: usize,
    rows: usize,
    /// Cells that are wet, or that a flood has reached.
    taken: Vec<bool>,
    /// Cells that a flood has still to visit.
    open: Vec<usize>,
}

impl Raster {
    /// Cells of one particle spacing over a tank of this length and height, metres.
    pub(super) fn new(length: f64, height: f64, spacing: f64) -> Raster {
        Raster {
            cell: spacing,
            columns: (length / spacing).ceil() as usize,
            rows: (height / spacing).ceil() as usize,
            taken: Vec::new(),
            open: Vec::new(),
        }
    }

    /// Area of the largest body of air without a path to above, m². A particle wets all cells whose
    /// centre is within 1.2 spacings. The raster ends at walls and bed.
    pub(super) fn largest_cavity(&mut self, x: &[f64], y: &[f64]) -> f64 {
        let Raster { cell, columns, rows, .. } = *self;
        let taken = &mut self.taken;
        taken.clear();
        taken.resize(columns * rows, false);
        let reach = 1.2 * cell;
        for (&x, &y) in x.iter().zip(y) {
            let span = |at: f64, count: usize| {
                let low = ((at - reach) / cell).floor().max(0.0) as usize;
                let high = ((at + reach) / cell).floor().max(0.0) as usize;
                low.min(count)..(high + 1).min(count)
            };
            for row in span(y, rows) {
                for column in span(x, columns) {
                    let dx = (column as f64 + 0.5) * cell - x;
                    let dy = (row as f64 + 0.5) * cell - y;
                    if dx * dx + dy * dy <= reach * reach {
                        taken[row * columns + column] = true;
                    }
                }
            }
        }
        self.flood((rows - 1) * columns..rows * columns);
        let mut largest = 0;
        for start in 0..columns * rows {
            largest = largest.max(self.flood(start..start + 1));
        }
        largest as f64 * cell * cell
    }

    /// Marks all free cells that are connected to these; returns their number.
    fn flood(&mut self, from: Range<usize>) -> usize {
        let Raster { taken, open, .. } = self;
        open.extend(from);
        let mut count = 0;
        while let Some(at) = open.pop() {
            if taken[at] {
                continue;
            }
            taken[at] = true;
            count += 1;
            let (row, column) = (at / self.columns, at % self.columns);
            if column > 0 {
                open.push(at - 1);
            }
            if column + 1 < self.columns {
                open.push(at + 1);
            }
            if row > 0 {
                open.push(at - self.columns);
            }
            if row + 1 < self.rows {
                open.push(at + self.columns);
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_air_that_is_closed_in_counts() {
        let mut raster = Raster::new(1.0, 0.8, 0.02);
        let ring = |gap: f64| -> (Vec<f64>, Vec<f64>) {
            (0..400)
                .map(|k| f64::from(k) / 400.0 * std::f64::consts::TAU)
                .filter(|angle| *angle > gap)
                .map(|angle| (0.5 + 0.2 * angle.cos(), 0.4 + 0.2 * angle.sin()))
                .unzip()
        };
        let (x, y) = ring(0.0);
        let inside = std::f64::consts::PI * (0.2_f64 - 0.024).powi(2);
        assert!((raster.largest_cavity(&x, &y) - inside).abs() < 0.1 * inside);
        let (x, y) = ring(0.7);
        assert_eq!(raster.largest_cavity(&x, &y), 0.0);
        assert_eq!(raster.largest_cavity(&[], &[]), 0.0);
    }
}
