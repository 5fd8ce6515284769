//! Points sorted into square cells as wide as the kernel's support.

use super::images::{Point, Points, WallTerms};
use crate::math::simd::LANES;

/// Where each cell's points lie. A margin of empty cells goes all around.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    origin: [f64; 2],
    inverse_width: f64,
    columns: usize,
    starts: Vec<u32>,
    next: Vec<u32>,
}

impl Grid {
    /// Sorts points into `points`, cell by cell, row by row; within a cell they keep their order.
    /// The arrays end with a vector's worth of padding.
    pub fn sort(&mut self, loose: &[Point], width: f64, points: &mut Points) {
        let extent = |axis: usize| {
            loose.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
                [low.min(point.place[axis]), high.max(point.place[axis])]
            })
        };
        let ([left, right], [bottom, top]) = (extent(0), extent(1));
        self.origin = [left - width, bottom - width];
        self.inverse_width = 1.0 / width;
        let cells = |from: f64, to: f64| ((to - from) / width).min(1e5) as usize + 3;
        self.columns = cells(left, right);
        let rows = cells(bottom, top);
        self.starts.clear();
        self.starts.resize(self.columns * rows + 1, 0);
        for point in loose {
            let cell = self.cell(point.place);
            self.starts[cell + 1] += 1;
        }
        for cell in 0..self.columns * rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        points.resize(loose.len() + LANES);
        let mut next = std::mem::take(&mut self.next);
        next.clone_from(&self.starts);
        for point in loose {
            let cell = self.cell(point.place);
            points.set(next[cell] as usize, point);
            next[cell] += 1;
        }
        self.next = next;
    }

    fn cell(&self, [x, y]: [f64; 2]) -> usize {
        let at = |v: f64, origin: f64| ((v - origin) * self.inverse_width) as usize;
        let column = at(x, self.origin[0]).clamp(1, self.columns - 2);
        let rows = (self.starts.len() - 1) / self.columns;
        let row = at(y, self.origin[1]).clamp(1, rows - 2);
        row * self.columns + column
    }

    /// The three ranges of points that hold all those within one cell's width of a place.
    pub fn near(&self, place: [f64; 2]) -> [std::ops::Range<usize>; 3] {
        let cell = self.cell(place);
        [cell - self.columns, cell, cell + self.columns]
            .map(|middle| self.starts[middle - 1] as usize..self.starts[middle + 2] as usize)
    }
}

impl Points {
    fn resize(&mut self, len: usize) {
        for field in [&mut self.x, &mut self.y, &mut self.volume] {
            field.clear();
            field.resize(len, 0.0);
        }
        self.original.resize(len, 0);
        self.body.resize(len, 0);
        self.walls.resize(len, WallTerms::default());
        self.turn.resize(len, [0.0; 4]);
    }

    fn set(&mut self, at: usize, point: &Point) {
        [self.x[at], self.y[at]] = point.place;
        self.volume[at] = point.volume;
        self.original[at] = point.original;
        self.body[at] = point.body;
        self.turn[at] = point.turn;
        self.walls[at] = point.walls;
    }
}
