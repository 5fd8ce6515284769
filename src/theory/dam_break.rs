//! A column of water just after its gate is removed: Huang et al. 2019, Eqs. 22-25; and Ritter's
//! front.

use std::f64::consts::PI;

/// Water of length L and height H between a wall at x = 0 and air at x = L, just released.
///
/// ∇²p = 0 with p = 0 on top and in front, ∂p/∂x = 0 at the wall, ∂p/∂y = -ρg at the bed with
/// ρ = ρ0 + p/c0²: ρ - ρ0 = Σ α_n cos(λ_n x) sinh(λ_n (H - y)), λ_n = (n + ½)π/L and
///
/// α_n = 2 ρ0 g (-1)ⁿ / [L λ_n (c0² λ_n cosh λ_nH - g sinh λ_nH)]
///
/// (Eqs. 23-25, with sin(λ_n L) = (-1)ⁿ where the source prints sin(λ_n x)). The hyperbolic
/// functions are combined as decaying exponentials, because cosh alone overflows near n = 450.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReleasedColumn {
    /// L, metres.
    pub length: f64,
    /// H, metres.
    pub height: f64,
    /// ρ0, kg/m³.
    pub density: f64,
    /// g, m/s².
    pub gravity: f64,
    /// c0, m/s.
    pub sound_speed: f64,
}

/// Terms below this share of the first are left out.
const NEGLIGIBLE: f64 = 1e-17;

impl ReleasedColumn {
    fn wavenumber(&self, n: usize) -> f64 {
        (n as f64 + 0.5) * PI / self.length
    }

    /// c0² α_n sinh(λ_n (H - y)), Pa.
    fn amplitude(&self, n: usize, y: f64) -> f64 {
        let k = self.wavenumber(n);
        let c2 = self.sound_speed * self.sound_speed;
        let twice = libm::exp(-2.0 * k * self.height);
        let rise = libm::exp(-k * y) - libm::exp(-k * (2.0 * self.height - y));
        let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        let below = c2 * k * (1.0 + twice) - self.gravity * (1.0 - twice);
        sign * 2.0 * c2 * self.density * self.gravity * rise / (self.length * k * below)
    }

    /// The amplitudes that matter at a height above the bed.
    fn amplitudes(&self, y: f64) -> Vec<f64> {
        let first = self.amplitude(0, y).abs();
        let mut all = Vec::new();
        // On the bed the series only converges like 1/n².
        while all.len() < 100_000 {
            let next = self.amplitude(all.len(), y);
            if next.abs() <= NEGLIGIBLE * first {
                break;
            }
            all.push(next);
        }
        all
    }

    /// Pressure at a place, Pa.
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        sum(&self.amplitudes(y), PI * x / self.length)
    }

    /// Pressures at the centres of a lattice of columns and rows, column by column, Pa.
    pub fn pressures(&self, columns: usize, rows: usize) -> Vec<f64> {
        let mut all = vec![0.0; columns * rows];
        for row in 0..rows {
            let amplitudes = self.amplitudes((row as f64 + 0.5) * self.height / rows as f64);
            for column in 0..columns {
                let angle = PI * (column as f64 + 0.5) / columns as f64;
                all[column * rows + row] = sum(&amplitudes, angle);
            }
        }
        all
    }
}

/// Σ a_n cos((n + ½) θ), by Clenshaw's recurrence.
fn sum(amplitudes: &[f64], angle: f64) -> f64 {
    let (half, twice) = (libm::cos(0.5 * angle), 2.0 * libm::cos(angle));
    let (mut b1, mut b2) = (0.0, 0.0);
    for a in amplitudes.iter().rev() {
        (b1, b2) = (a + twice * b1 - b2, b1);
    }
    // cos((n + ½)θ) with cos(½θ) = cos(-½θ) as its first two terms.
    half * (b1 - b2)
}

/// Ritter's front of a wide column on a dry, frictionless bed: x = L + 2 √(gH) t, metres. It is
/// shallow water without vertical inertia: an upper bound of a real front.
pub fn ritter_front(length: f64, height: f64, gravity: f64, time: f64) -> f64 {
    length + 2.0 * (gravity * height).sqrt() * time
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMN: ReleasedColumn = ReleasedColumn {
        length: 1.2,
        height: 0.6,
        density: 1000.0,
        gravity: 9.81,
        sound_speed: 48.0,
    };

    #[test]
    fn pressure_is_harmonic_inside() {
        let p = |x: f64, y: f64| COLUMN.pressure(x, y);
        let step = 2e-3;
        for (x, y) in [(0.1, 0.1), (0.6, 0.3), (1.0, 0.2), (1.15, 0.5), (0.3, 0.02)] {
            let laplacian = (p(x + step, y) + p(x - step, y) + p(x, y + step) + p(x, y - step)
                - 4.0 * p(x, y))
                / (step * step);
            // Against ρ g/H, the size of a second derivative.
            let scale = COLUMN.density * COLUMN.gravity / COLUMN.height;
            assert!(laplacian.abs() < 2e-3 * scale, "{laplacian} at {x}, {y}");
        }
    }

    #[test]
    fn pressure_vanishes_on_top_and_in_front() {
        let bottom = COLUMN.density * COLUMN.gravity * COLUMN.height;
        for k in 0..12 {
            let part = 0.05 + f64::from(k) / 12.0;
            assert!(COLUMN.pressure(part * COLUMN.length, COLUMN.height).abs() < 1e-9 * bottom);
            assert!(COLUMN.pressure(COLUMN.length, part * 0.6).abs() < 1e-9 * bottom);
        }
        let step = 1e-4;
        let slope = (COLUMN.pressure(step, 0.2) - COLUMN.pressure(-step, 0.2)) / (2.0 * step);
        assert!(slope.abs() < 1e-6 * bottom);
    }

    /// The series of the slope oscillates near x = L, and at y = 0 itself.
    #[test]
    fn the_bed_carries_the_water_above_it() {
        let step = 1e-4;
        let c2 = COLUMN.sound_speed * COLUMN.sound_speed;
        for k in 0..18 {
            let x = 0.05 * f64::from(k) * COLUMN.length;
            let p = |y: f64| COLUMN.pressure(x, y);
            // One-sided, of second order, away from the bed by a step.
            let slope = (-3.0 * p(step) + 4.0 * p(2.0 * step) - p(3.0 * step)) / (2.0 * step);
            let expected = -(COLUMN.density + p(step) / c2) * COLUMN.gravity;
            assert!((slope / expected - 1.0).abs() < 5e-3, "{slope} against {expected} at {x}");
        }
    }

    #[test]
    fn a_wide_column_is_hydrostatic_far_from_its_front() {
        let wide = ReleasedColumn { length: 12.0, ..COLUMN };
        let c2 = COLUMN.sound_speed * COLUMN.sound_speed;
        // dp/dy at the bed is -(ρ0 + p/c0²) g, and p is linear in y where nothing changes along x.
        let slope = 1000.0 * 9.81 / (1.0 - 9.81 * 0.6 / c2);
        for y in [0.01, 0.2, 0.5] {
            let expected = slope * (0.6 - y);
            assert!((wide.pressure(0.0, y) - expected).abs() < 1e-4 * expected, "{y}");
        }
    }

    #[test]
    fn a_lattice_holds_the_same_pressures() {
        let all = COLUMN.pressures(12, 6);
        for (column, row) in [(0, 0), (5, 2), (11, 5)] {
            let (x, y) = ((column as f64 + 0.5) * 0.1, (row as f64 + 0.5) * 0.1);
            assert!((all[column * 6 + row] - COLUMN.pressure(x, y)).abs() < 1e-6);
        }
    }
}
