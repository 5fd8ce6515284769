//! The potential of still water before an upright wall that starts to move.
//!
//! Water of depth d is on the left of a wall over a flat bed. The wall starts to move to the right
//! with unit velocity. The potential φ of the flow solves ∇²φ = 0 with ∂φ/∂x = 1 on the wall, ∂φ/∂y
//! = 0 on the bed and φ = 0 at the surface. With λ_n = (n + ½) π/d and the distance ξ from the
//! wall:
//! ```text
//! φ = Σ 2 (-1)ⁿ/(d λ_n²) cos(λ_n y) exp(-λ_n ξ)
//! ```
//! φ/d depends only on ξ/d and y/d, so it is tabulated once.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Mass of the water that the wall carries with it, over ρ d²: the mean of φ over the wall.
pub const CARRIED: f64 = 0.543;
/// Number of modes in the sum. The rest of φ/d is below 2e-4 at the wall.
const MODES: u32 = 48;
/// Cells of the table over the depth.
const CELLS: usize = 64;
/// End of the table, over d. There φ is less than 1 % of its value at the wall.
const REACH: usize = 3;

static TABLE: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let place = |number: usize| number as f64 * (1.0 / CELLS as f64);
    // A product for each entry; the functions once for each row and column.
    let modes = |of: fn(u32, f64) -> f64, number: usize| -> Vec<f64> {
        (0..MODES).map(|n| of(n, place(number))).collect()
    };
    let heights: Vec<_> = (0..=CELLS).map(|row| modes(upwards, row)).collect();
    let mut table = Vec::with_capacity((REACH * CELLS + 1) * (CELLS + 1));
    for column in 0..=REACH * CELLS {
        let away = modes(outwards, column);
        let entry = |height: &Vec<f64>| height.iter().zip(&away).map(|(h, a)| h * a).sum::<f64>();
        table.extend(heights.iter().map(entry));
    }
    table
});

/// λ_n d.
fn wave_number(n: u32) -> f64 {
    (f64::from(n) + 0.5) * PI
}

/// φ/d of a mode as a function of the height.
fn upwards(n: u32, eta: f64) -> f64 {
    let wave_number = wave_number(n);
    let sign = if n.is_multiple_of(2) { 2.0 } else { -2.0 };
    sign / (wave_number * wave_number) * libm::cos(wave_number * eta)
}

/// The same as a function of the distance from the wall.
fn outwards(n: u32, xi: f64) -> f64 {
    libm::exp(-wave_number(n) * xi)
}

/// Makes the table, once, so that no step of a run has to.
pub fn tabulate() {
    LazyLock::force(&TABLE);
}

/// φ/d and its derivatives along ξ/d and y/d, at the distance `xi` d from the wall and the height `eta`
/// d; zero above the surface and far from the wall. Between its tabulated values φ is bilinear.
pub fn wall_potential(xi: f64, eta: f64) -> [f64; 3] {
    let cells = CELLS as f64;
    let [u, v] = [xi, eta].map(|place| (place * cells).max(0.0));
    if u >= (REACH * CELLS) as f64 || v >= cells {
        return [0.0; 3];
    }
    let (column, row) = (u as usize, v as usize);
    let (across, up) = (u - column as f64, v - row as f64);
    let at = |column: usize, row: usize| TABLE[column * (CELLS + 1) + row];
    let near = [at(column, row), at(column, row + 1)];
    let far = [at(column + 1, row), at(column + 1, row + 1)];
    let low = near[0] + across * (far[0] - near[0]);
    let high = near[1] + across * (far[1] - near[1]);
    let slope = (far[0] - near[0]) * (1.0 - up) + (far[1] - near[1]) * up;
    [low + up * (high - low), slope * cells, (high - low) * cells]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// φ/d at the distance `xi` d from the wall and the height `eta` d.
    fn sum(xi: f64, eta: f64) -> f64 {
        (0..MODES).map(|n| upwards(n, eta) * outwards(n, xi)).sum()
    }

    /// A whole number of hundredths.
    fn hundredths(from: u32, to: u32) -> impl Iterator<Item = f64> {
        (from..to).map(|k| f64::from(k) / 100.0)
    }

    #[test]
    fn it_is_harmonic_and_holds_at_bed_and_surface() {
        let e = 1e-3;
        for xi in hundredths(20, 200).step_by(13) {
            for eta in hundredths(5, 95).step_by(9) {
                let around =
                    sum(xi + e, eta) + sum(xi - e, eta) + sum(xi, eta + e) + sum(xi, eta - e);
                assert!((around - 4.0 * sum(xi, eta)).abs() < 1e-3 * e * e * 10.0);
            }
            assert!(sum(xi, 1.0).abs() < 1e-15);
            assert!((sum(xi, e) - sum(xi, -e)).abs() < 1e-15);
        }
    }

    #[test]
    fn at_the_wall_it_rises_with_unit_slope() {
        // In the mean over stretches of the depth: the sum of slopes converges like that of a step.
        for stretch in 0..4 {
            let from = 25 * stretch;
            let slopes = hundredths(from, from + 25)
                .map(|eta| (sum(0.0, eta + 0.005) - sum(0.02, eta + 0.005)) / 0.02);
            let mean = slopes.sum::<f64>() / 25.0;
            let expected = if stretch == 3 { 0.88..0.99 } else { 0.96..1.01 };
            assert!(expected.contains(&mean), "{stretch}: {mean}");
        }
    }

    #[test]
    fn the_water_that_the_wall_carries_is_known() {
        let carried = hundredths(0, 100).map(|eta| sum(0.0, eta + 0.005)).sum::<f64>() / 100.0;
        assert!((carried - CARRIED).abs() < 5e-4, "{carried}");
    }

    #[test]
    fn the_table_is_the_sum() {
        for xi in hundredths(0, 320).step_by(7) {
            for eta in hundredths(0, 110).step_by(3) {
                let [value, slope, rise] = wall_potential(xi, eta);
                let exact = if eta < 1.0 && xi < 3.0 { sum(xi, eta) } else { 0.0 };
                assert!((value - exact).abs() < 3e-3, "{xi}, {eta}");
                if xi > 0.1 && xi < 2.9 && eta < 0.95 {
                    let e = 1e-5;
                    assert!(
                        (slope - (sum(xi + e, eta) - sum(xi - e, eta)) / (2.0 * e)).abs() < 0.02
                    );
                    assert!(
                        (rise - (sum(xi, eta + e) - sum(xi, eta - e)) / (2.0 * e)).abs() < 0.02
                    );
                }
            }
        }
    }
}
