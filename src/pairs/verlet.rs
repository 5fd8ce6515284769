//! How long a list is valid: until some pair may have come into reach unseen.

use std::ops::Range;

use super::strips::Strips;

/// Displacements since the last rebuild, cell by cell.
///
/// Fluid pairs can only have come closer by the *difference* of their displacements. This is
/// bounded by the spread of displacements over the two cells of the pair. So a wave that carries
/// its particles along does not make a list invalid. Ghosts are at rest or move with their body.
/// For them the displacement itself counts, against a wider margin.
#[derive(Debug, Clone, Default)]
pub struct Drift {
    cells: Vec<Cell>,
    /// Index of each strip's first cell, and the end of the last strip's cells.
    firsts: Vec<u32>,
    /// The spread of all cells of each strip.
    columns: Vec<Spread>,
    /// Width of the strips.
    width: f64,
}

/// Consecutive points of a strip.
#[derive(Debug, Clone)]
struct Cell {
    members: Range<u32>,
    /// Their lowest and highest y at the last rebuild.
    heights: [f64; 2],
    spread: Spread,
}

/// A box of displacements: x from, x to, y from, y to.
type Spread = [f64; 4];

const NOTHING: Spread = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];

/// Distances within which pairs matter.
#[derive(Debug, Clone, Copy)]
pub struct Reach {
    /// Distance at which points interact.
    pub radius: f64,
    /// Lists hold pairs that are up to this much farther apart.
    pub margin: f64,
}

impl Drift {
    /// Takes the points of a rebuild, in cells of at most this height.
    pub fn divide(&mut self, strips: &Strips, width: f64, y: &[f64], height: f64) {
        self.width = width;
        self.cells.clear();
        self.firsts.clear();
        for strip in 0..strips.count() {
            self.firsts.push(self.cells.len() as u32);
            let members = strips.members(strip);
            let mut start = members.start;
            for k in members.clone() {
                let last = k + 1 == members.end;
                if last || (y[k + 1] - y[start]).abs() > height {
                    let heights = [y[start].min(y[k]), y[start].max(y[k])];
                    let members = start as u32..k as u32 + 1;
                    self.cells.push(Cell { members, heights, spread: NOTHING });
                    start = k + 1;
                }
            }
        }
        self.firsts.push(self.cells.len() as u32);
    }

    /// Whether a pair that is not listed may be in reach; and the largest displacement of any
    /// point. `from` are the places at the rebuild.
    pub fn measure(&mut self, [x, y]: [&[f64]; 2], from: [&[f64]; 2], reach: Reach) -> (bool, f64) {
        self.columns.clear();
        let mut farthest: f64 = 0.0;
        for ends in self.firsts.windows(2) {
            let mut column = NOTHING;
            for cell in &mut self.cells[ends[0] as usize..ends[1] as usize] {
                cell.spread = NOTHING;
                for k in cell.members.start as usize..cell.members.end as usize {
                    let (dx, dy) = (x[k] - from[0][k], y[k] - from[1][k]);
                    cell.spread = merge(cell.spread, [dx, dx, dy, dy]);
                }
                column = merge(column, cell.spread);
            }
            if column[0] <= column[1] {
                let far_x = column[0].abs().max(column[1].abs());
                let far_y = column[2].abs().max(column[3].abs());
                farthest = farthest.max((far_x * far_x + far_y * far_y).sqrt());
            }
            self.columns.push(column);
        }
        let worn = (0..self.columns.len()).any(|strip| self.may_meet(strip, farthest, reach));
        (worn, farthest)
    }

    /// Whether a point of a strip and one of the same or of later strips, not listed as a pair, may
    /// be in reach. No point has moved farther than `farthest`.
    fn may_meet(&self, strip: usize, farthest: f64, reach: Reach) -> bool {
        // Points farther apart than this cannot have met.
        let beyond = reach.radius + 2.0 * farthest;
        let last = (strip + 1 + (beyond / self.width) as usize).min(self.columns.len() - 1);
        let together = self.columns[strip..=last].iter().copied().fold(NOTHING, merge);
        let [left, right, bottom, top] = together;
        let spread = (right - left) * (right - left) + (top - bottom) * (top - bottom);
        if spread <= reach.margin * reach.margin {
            return false; // As in most strips: not even all of them together.
        }
        let cells = |strip: usize| {
            &self.cells[self.firsts[strip] as usize..self.firsts[strip + 1] as usize]
        };
        cells(strip).iter().any(|cell| {
            (strip..=last).any(|other| {
                let across = (other - strip).saturating_sub(1) as f64 * self.width;
                cells(other).iter().any(|other| cell.may_meet(other, across, beyond, reach))
            })
        })
    }
}

impl Cell {
    /// Whether a point of each cell may have met, for points that were at least `across` apart
    /// along x and not listed.
    fn may_meet(&self, other: &Cell, across: f64, beyond: f64, reach: Reach) -> bool {
        let up = (other.heights[0] - self.heights[1]).max(self.heights[0] - other.heights[1]);
        let apart = across * across + up.max(0.0) * up.max(0.0);
        if apart > beyond * beyond {
            return false;
        }
        let listed = reach.radius + reach.margin;
        let allowed =
            if apart > listed * listed { apart.sqrt() - reach.radius } else { reach.margin };
        let [left, right, bottom, top] = self.spread;
        let dx = (right - other.spread[0]).max(other.spread[1] - left);
        let dy = (top - other.spread[2]).max(other.spread[3] - bottom);
        let still = dx * dx + dy * dy < allowed * allowed;
        // So NaN may have met.
        !still
    }
}

#[inline(always)]
fn merge(a: Spread, b: Spread) -> Spread {
    // Plain comparisons: min and max that handle NaN would not vectorise as well.
    let low = |p: f64, q: f64| if p < q { p } else { q };
    let high = |p: f64, q: f64| if p > q { p } else { q };
    [low(a[0], b[0]), high(a[1], b[1]), low(a[2], b[2]), high(a[3], b[3])]
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: Reach = Reach { radius: 0.3, margin: 0.03 };

    /// Points with the drift of their cells.
    fn points(count: u32) -> (Vec<f64>, Vec<f64>, Drift) {
        let at = |k: u32, factor: f64| (f64::from(k) * factor).fract();
        let ties: Vec<u32> = (0..count).collect();
        let (x, y): (Vec<f64>, Vec<f64>) =
            ties.iter().map(|&k| (4.0 * at(k, 0.618_034), 2.0 * at(k, 0.754_878))).unzip();
        let (strips, order) = Strips::sort(&x, &y, &ties, 0.2);
        let sorted = |field: &[f64]| order.iter().map(|&k| field[k as usize]).collect::<Vec<_>>();
        let (x, y) = (sorted(&x), sorted(&y));
        let mut drift = Drift::default();
        drift.divide(&strips, 0.2, &y, 0.25);
        (x, y, drift)
    }

    #[test]
    fn a_common_shift_wears_nothing_out() {
        let (x, y, mut drift) = points(500);
        let moved: Vec<f64> = x.iter().map(|x| x + 3.0).collect();
        let (worn, farthest) = drift.measure([&moved, &y], [&x, &y], REACH);
        assert!(!worn && (farthest - 3.0).abs() < 1e-12, "{worn} {farthest}");
    }

    #[test]
    fn no_pair_that_is_not_listed_comes_into_reach_unseen() {
        let (x, y, mut drift) = points(500);
        let (mut worn_out, mut fine) = (0, 0);
        for case in 0..60 {
            let (size, turn) = (0.005 * f64::from(case / 3), f64::from(case % 3));
            let to_x: Vec<f64> =
                x.iter().zip(&y).map(|(x, y)| x + size * (2.0 * y + turn).sin()).collect();
            let to_y: Vec<f64> =
                y.iter().zip(&x).map(|(y, x)| y + size * (3.0 * x * turn).cos()).collect();
            let (worn, _) = drift.measure([&to_x, &to_y], [&x, &y], REACH);
            let met = (0..x.len()).any(|i| {
                (0..i).any(|j| {
                    let before = (x[i] - x[j]).hypot(y[i] - y[j]);
                    let after = (to_x[i] - to_x[j]).hypot(to_y[i] - to_y[j]);
                    before >= REACH.radius + REACH.margin && after < REACH.radius
                })
            });
            assert!(worn || !met, "case {case}");
            worn_out += u32::from(worn && met);
            fine += u32::from(!worn && size > 0.0);
        }
        assert!(worn_out > 5 && fine > 5, "{worn_out} and {fine}");
    }
}
