//! How the surface's nodes move.

use super::grid::{Parity, slope, smooth as smooth_values};
use super::law::{DEPTH, GRAVITY};
use super::water::{Faces, Flow, Surface, particular};

/// The nodes' spacing is drawn back to its grading within this time, seconds.
const DRAW_BACK: f64 = 0.1;

/// Nodes follow the water across the surface, and slide along it so as to keep their relative
/// `spacings`: dΦ/dt = |∇Φ|²/2 - g (y - h) + τ ∂Φ/∂s with the sliding speed τ.
///
/// Also the fastest relative stretching of the surface, 1/s.
pub fn rates(flow: &Flow<'_>, surface: &Surface, faces: Faces, spacings: &[f64]) -> (Surface, f64) {
    let count = surface.x.len();
    let [u, v] = &flow.velocity;
    let (u_slope, v_slope) = (slope(u, Parity::Odd), slope(v, Parity::Even));
    let spans: Vec<f64> =
        flow.slope[0].iter().zip(&flow.slope[1]).map(|(x, y)| x.hypot(*y)).collect();
    let tangent = |j: usize| [flow.slope[0][j] / spans[j], flow.slope[1][j] / spans[j]];
    let stretching: Vec<f64> = (0..count)
        .map(|j| {
            let [tx, ty] = tangent(j);
            tx * u_slope[j] + ty * v_slope[j]
        })
        .collect();
    let shares = stretching.iter().zip(&spans).map(|(rate, span)| (rate / span).abs());
    let fastest = shares.fold(0.0, f64::max);
    let share = sum(&spans) / sum(spacings);
    let wanted: Vec<f64> =
        (0..count).map(|j| stretching[j] + (spans[j] - share * spacings[j]) / DRAW_BACK).collect();
    let growth = sum(&wanted) / sum(spacings);
    let excess = |j: usize| growth * spacings[j] - wanted[j];
    let mut rates =
        Surface { x: vec![0.0; count], y: vec![0.0; count], potential: vec![0.0; count] };
    let mut slide = 0.0;
    for j in 0..count {
        if j > 0 {
            slide += 0.5 * (excess(j - 1) + excess(j));
        }
        let [tx, ty] = tangent(j);
        rates.x[j] = u[j] + slide * tx;
        rates.y[j] = v[j] + slide * ty;
        rates.potential[j] = 0.5 * (u[j] * u[j] + v[j] * v[j]) - GRAVITY * (surface.y[j] - DEPTH)
            + slide * (u[j] * tx + v[j] * ty);
    }
    (rates.x[0], rates.x[count - 1]) = (faces.paddle[0], faces.wall);
    (rates, fastest)
}

/// The trapezoidal rule along the nodes.
fn sum(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() - 0.5 * (values[0] + values[values.len() - 1])
}

/// Smooths x, y and the part of Φ that is even across both faces, which move at `speeds` (m/s).
pub fn smooth(surface: &mut Surface, speeds: [f64; 2], strength: f64) {
    let Surface { x, y, potential } = surface;
    let (start, length) = (x[0], x[x.len() - 1] - x[0]);
    let stretch = (speeds[1] - speeds[0]) / length;
    let carried = |x: f64, y: f64| particular(speeds[0], stretch, x - start, y);
    for (j, value) in potential.iter_mut().enumerate() {
        *value -= carried(x[j], y[j]);
    }
    smooth_values(x, Parity::Odd, strength);
    smooth_values(y, Parity::Even, strength);
    smooth_values(potential, Parity::Even, strength);
    for (j, value) in potential.iter_mut().enumerate() {
        *value += carried(x[j], y[j]);
    }
}
