//! The fluid's own viscosity against exact flows.

use super::*;

const VISCOSITY: f64 = 0.01;

/// Drag and velocity of the water of a square, for this velocity.
fn dragged(mut water: Isph, velocity: impl Fn(f64, f64) -> [f64; 2]) -> (Isph, Vec<[f64; 2]>) {
    water.options.viscosity = VISCOSITY;
    let velocities = (0..water.fluid.len()).map(|i| velocity(water.fluid.x[i], water.fluid.y[i]));
    let velocities: Vec<_> = velocities.collect();
    for (i, &[u, v]) in velocities.iter().enumerate() {
        (water.fluid.vx[i], water.fluid.vy[i]) = (u, v);
    }
    lists(&mut water);
    water.find_drag();
    (water, velocities)
}

/// A vortex between free-slip walls: ν∇²u = -2π²ν u.
#[test]
fn vortices_in_a_box_are_dragged_by_the_laplacian() {
    use std::f64::consts::PI;
    let flow = |x: f64, y: f64| {
        let (x, y) = (PI * x, PI * y);
        [x.sin() * y.cos(), -x.cos() * y.sin()]
    };
    let (water, velocities) = dragged(square(24, 0.0, true, Laplacian::Exact), flow);
    let rate = -2.0 * PI * PI * VISCOSITY;
    for (found, [u, v]) in water.drag.iter().zip(velocities) {
        let off = (found[0] - rate * u).hypot(found[1] - rate * v);
        assert!(off < 0.05 * rate.abs(), "{found:?}, {} {}", rate * u, rate * v);
    }
}

/// Pairs once pulled along u_j - u_i, so that a surface bore a stress ν∇u. That braked water in
/// rigid rotation, and took only half of what a wave loses by viscosity.
#[test]
fn a_free_surface_bears_no_viscous_stress() {
    let turning = |x: f64, y: f64| [0.5 - y, x - 0.5];
    let (water, _) = dragged(square(16, 0.2, false, Laplacian::Exact), turning);
    let largest = water.drag.iter().flatten().fold(0.0_f64, |most, part| most.max(part.abs()));
    assert!(largest < 1e-7, "{largest}");

    // Water in pure strain loses 2ν E:E = 4ν. A layer at the surface lacks pairs. On a lattice the
    // sums are some 3 % too large.
    let lost = |side: usize| {
        let drawn = |x: f64, y: f64| [x - 0.5, 0.5 - y];
        let (water, velocities) = dragged(square(side, 0.0, false, Laplacian::Exact), drawn);
        let powers = water.drag.iter().zip(velocities).zip(&water.fluid.mass);
        -powers.map(|((drag, [u, v]), mass)| mass * (drag[0] * u + drag[1] * v)).sum::<f64>()
            / (4.0 * VISCOSITY * DENSITY)
    };
    let (coarse, fine) = (lost(16), lost(32));
    assert!(fine > coarse && fine < 1.0 && coarse > 0.8, "{coarse}, {fine}");
    assert!((2.0 * fine - coarse - 1.0).abs() < 0.05, "{coarse}, {fine}");
}
