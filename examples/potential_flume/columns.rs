//! Laplace's equation between a bed and a surface, by bilinear finite elements in columns.

/// Gauss's two points on -1 to 1.
const GAUSS: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];
/// The corners of an element: column and layer.
const CORNERS: [[usize; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// Elements between columns at `x`, from `bed` to `top`, in `layers` of equal height.
pub struct Columns<'a> {
    pub x: &'a [f64],
    pub bed: &'a [f64],
    pub top: &'a [f64],
    pub layers: usize,
}

impl Columns<'_> {
    fn height(&self, column: usize, layer: usize) -> f64 {
        let share = layer as f64 / self.layers as f64;
        self.bed[column] + share * (self.top[column] - self.bed[column])
    }

    /// ∫ ∇w_a·∇w_b over an element, for each pair of its corners.
    fn element(&self, column: usize, layer: usize) -> [[f64; 4]; 4] {
        let place = CORNERS.map(|[c, l]| [self.x[column + c], self.height(column + c, layer + l)]);
        let mut stiffness = [[0.0; 4]; 4];
        for a in GAUSS {
            for b in GAUSS {
                let sign = |one: usize| 2.0 * one as f64 - 1.0;
                let slopes = CORNERS.map(|[c, l]| {
                    let (c, l) = (sign(c), sign(l));
                    [0.25 * c * (1.0 + l * b), 0.25 * l * (1.0 + c * a)]
                });
                let mut map = [[0.0; 2]; 2];
                for (slope, place) in slopes.iter().zip(&place) {
                    for (row, slope) in map.iter_mut().zip(slope) {
                        row[0] += slope * place[0];
                        row[1] += slope * place[1];
                    }
                }
                let [[xa, ya], [xb, yb]] = map;
                let area = xa * yb - ya * xb;
                let gradients =
                    slopes.map(|[a, b]| [(yb * a - ya * b) / area, (xa * b - xb * a) / area]);
                for (row, of) in stiffness.iter_mut().zip(&gradients) {
                    for (sum, by) in row.iter_mut().zip(&gradients) {
                        *sum += area * (of[0] * by[0] + of[1] * by[1]);
                    }
                }
            }
        }
        stiffness
    }

    /// ∫ w ∂φ/∂n along the surface, by column, where φ is `values` there, its slope across the first column is
    /// `inflow`, and nothing passes the bed and the last column.
    pub fn outflow(&self, values: &[f64], inflow: f64) -> Vec<f64> {
        let (count, n) = (self.x.len(), self.layers);
        // Of each column: its own block, the block that couples it to the next, the surface's part, the load.
        let mut own = vec![vec![0.0; (n + 1) * (n + 1)]; count];
        let mut next = vec![vec![0.0; (n + 1) * (n + 1)]; count];
        for column in 0..count - 1 {
            for layer in 0..n {
                let stiffness = self.element(column, layer);
                for (a, [ca, la]) in CORNERS.into_iter().enumerate() {
                    for (b, [cb, lb]) in CORNERS.into_iter().enumerate() {
                        let at = (layer + la) * (n + 1) + layer + lb;
                        match (ca, cb) {
                            (0, 1) => next[column][at] += stiffness[a][b],
                            (1, 0) => {}
                            _ => own[column + ca][at] += stiffness[a][b],
                        }
                    }
                }
            }
        }
        let paddle = (self.top[0] - self.bed[0]) / n as f64 * inflow;
        let load = |column: usize, layer: usize| match (column, layer) {
            (0, layer) if layer == 0 || layer == n => -0.5 * paddle,
            (0, _) => -paddle,
            _ => 0.0,
        };
        let inner = self.inside(&own, &next, values, &load);
        // What is left over at the surface is the flow through it.
        let value = |column: usize, layer: usize| {
            if layer == n { values[column] } else { inner[column][layer] }
        };
        (0..count)
            .map(|column| {
                let mut sum = -load(column, n);
                for layer in 0..=n {
                    sum += own[column][n * (n + 1) + layer] * value(column, layer);
                    if column + 1 < count {
                        sum += next[column][n * (n + 1) + layer] * value(column + 1, layer);
                    }
                    if column > 0 {
                        sum += next[column - 1][layer * (n + 1) + n] * value(column - 1, layer);
                    }
                }
                sum
            })
            .collect()
    }

    /// φ below the surface: blocks are eliminated column by column.
    fn inside(
        &self,
        own: &[Vec<f64>],
        next: &[Vec<f64>],
        values: &[f64],
        load: &impl Fn(usize, usize) -> f64,
    ) -> Vec<Vec<f64>> {
        let (count, n) = (self.x.len(), self.layers);
        let at = |block: &[f64], row: usize, column: usize| block[row * (n + 1) + column];
        // Of each column: S⁻¹ times the coupling to the next one, and times the right side.
        let mut solved: Vec<Vec<f64>> = Vec::with_capacity(count);
        for column in 0..count {
            // Rows hold S, the coupling and the right side: 2 n + 1 wide.
            let width = 2 * n + 1;
            let mut rows = vec![0.0; n * width];
            for row in 0..n {
                let mut right = load(column, row) - at(&own[column], row, n) * values[column];
                if column + 1 < count {
                    right -= at(&next[column], row, n) * values[column + 1];
                }
                if column > 0 {
                    right -= at(&next[column - 1], n, row) * values[column - 1];
                }
                for layer in 0..n {
                    rows[row * width + layer] = at(&own[column], row, layer);
                    rows[row * width + n + layer] = at(&next[column], row, layer);
                }
                rows[row * width + 2 * n] = right;
            }
            if let Some(before) = solved.last() {
                for row in 0..n {
                    for inner in 0..n {
                        let coupling = at(&next[column - 1], inner, row);
                        if coupling == 0.0 {
                            continue;
                        }
                        for layer in 0..n {
                            rows[row * width + layer] -= coupling * before[inner * (n + 1) + layer];
                        }
                        rows[row * width + 2 * n] -= coupling * before[inner * (n + 1) + n];
                    }
                }
            }
            eliminate(&mut rows, n, width);
            let kept = (0..n).flat_map(|row| rows[row * width + n..(row + 1) * width].to_vec());
            solved.push(kept.collect());
        }
        let mut inner = vec![vec![0.0; n]; count];
        for column in (0..count).rev() {
            for row in 0..n {
                let line = &solved[column][row * (n + 1)..(row + 1) * (n + 1)];
                let mut value = line[n];
                if column + 1 < count {
                    value -=
                        (0..n).map(|layer| line[layer] * inner[column + 1][layer]).sum::<f64>();
                }
                inner[column][row] = value;
            }
        }
        inner
    }
}

/// Turns the first n columns of n rows into the unit matrix (Gauss and Jordan; the matrix is positive definite).
fn eliminate(rows: &mut [f64], n: usize, width: usize) {
    for pivot in 0..n {
        let over = 1.0 / rows[pivot * width + pivot];
        rows[pivot * width + pivot..(pivot + 1) * width].iter_mut().for_each(|v| *v *= over);
        for row in (0..n).filter(|row| *row != pivot) {
            let factor = rows[row * width + pivot];
            if factor != 0.0 {
                for k in pivot..width {
                    rows[row * width + k] -= factor * rows[pivot * width + k];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// φ = cosh(k y) cos(k x): its slope at the surface is k sinh(k h) cos(k x).
    #[test]
    fn a_wave_over_a_level_bed_has_its_slope() {
        let (count, k) = (81, std::f64::consts::PI);
        let x: Vec<f64> = (0..count).map(|c| c as f64 / 40.0).collect();
        let (bed, top) = (vec![0.0; count], vec![0.5; count]);
        let columns = Columns { x: &x, bed: &bed, top: &top, layers: 20 };
        let values: Vec<f64> = x.iter().map(|x| (0.5 * k).cosh() * (k * x).cos()).collect();
        let flow = columns.outflow(&values, 0.0);
        let exact = -k * (0.5 * k).sinh() / 40.0; // in the trough, at x = 1
        assert!((flow[40] / exact - 1.0).abs() < 2e-3, "{}", flow[40] / exact);
        assert!(flow.iter().sum::<f64>().abs() < 1e-10);
    }

    /// A uniform stream through the first column leaves by the surface.
    #[test]
    fn what_comes_in_goes_out() {
        let x: Vec<f64> = (0..31).map(|c| f64::from(c) / 10.0).collect();
        let (bed, top): (Vec<_>, Vec<_>) =
            x.iter().map(|x| (0.1 * x, 1.0 + 0.02 * x.sin())).unzip();
        let columns = Columns { x: &x, bed: &bed, top: &top, layers: 6 };
        let flow = columns.outflow(&vec![0.0; 31], 0.7);
        assert!((flow.iter().sum::<f64>() - 0.7 * top[0]).abs() < 1e-10);
    }
}
