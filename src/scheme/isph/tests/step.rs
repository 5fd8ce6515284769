//! Sums, the projection and the surface, as a step uses them.

use super::super::gradient::reaction;
use super::super::project::Source;
use super::*;

#[test]
fn sums_are_those_over_all_points_and_walls_feel_what_the_water_feels() {
    let mut water = square(13, 0.2, true, Laplacian::Exact);
    let (n, padded) = (water.fluid.len(), water.fluid.padded_len());
    assert!(n < padded && padded < water.near.volume.len());
    let (kernel, radius) = (water.options.kernel, water.options.support_radius);
    let factor = kernel.normalisation() / (radius * radius);
    let around = |[x, y]: [f64; 2]| {
        let (mut coverage, mut sway) = (0.0, [0.0; 2]);
        for e in (0..n).chain(padded..water.near.volume.len()) {
            let (dx, dy) = (water.near.places[0][e] - x, water.near.places[1][e] - y);
            let q = dx.hypot(dy) / radius;
            let volume = factor * water.near.volume[e];
            coverage += volume * kernel.shape_at(q);
            if q > 0.0 {
                let weight = -volume * kernel.slope_at(q) / (q * radius * radius);
                sway = [sway[0] + weight * dx, sway[1] + weight * dy];
            }
        }
        (coverage, sway)
    };
    for i in 0..n {
        let (coverage, sway) = around([water.near.places[0][i], water.near.places[1][i]]);
        let found = water.operators.sway[i];
        assert!((water.operators.coverage[i] - coverage).abs() < 1e-9);
        assert!((found[0] - sway[0]).abs() + (found[1] - sway[1]).abs() < 1e-7 / radius);
    }
    for place in [[0.5, 0.5], [0.02, 0.03], [0.99, 0.4]] {
        let level = water.level_along(|y| [place[0], y], place[1]);
        let surface = around([place[0], level]).0;
        assert!(level > 1.0 && (surface - 0.5).abs() < 0.05, "{place:?}: {level} {surface}");
    }
    water.pressure = field(&water, |x, y| 3.0 + x - 2.0 * y + x * y);
    water.accelerate(Source::Pressure);
    reaction(&water.near, &water.points, &mut water.forces);
    let masses = water.accelerations.iter().zip(&water.fluid.mass);
    let thrust: f64 = masses.map(|(a, mass)| a[0] * mass).sum();
    let force: f64 = water.forces.iter().sum();
    assert!(force.abs() > 0.1 && (force + thrust).abs() < 1e-10 * force.abs(), "{force} {thrust}");
}

/// u = ∇φ in a closed box: the projection removes all of it by p = φ ρ/Δt.
#[test]
fn the_poisson_equation_is_solved_to_second_order() {
    let error = |side: usize| {
        use std::f64::consts::PI;
        let mut water = square(side, 0.0, true, Laplacian::Exact);
        for i in 0..water.fluid.len() {
            let (x, y) = (PI * water.fluid.x[i], PI * water.fluid.y[i]);
            water.fluid.vx[i] = -PI * x.sin() * y.cos();
            water.fluid.vy[i] = -PI * x.cos() * y.sin();
        }
        let dt = 1e-9;
        let bodies = &AT_REST[..water.loads.len()];
        // The pressure of the step before has a small effect: repeat until it no longer changes.
        for _ in 0..3 {
            water.prepare(bodies, dt).unwrap();
            water.carried.older_pressure.clone_from(&water.pressure);
            water.carried.pressure.clone_from(&water.pressure);
        }
        let exact = field(&water, |x, y| (PI * x).cos() * (PI * y).cos());
        let p: Vec<f64> = water.pressure.iter().map(|p| p * dt / DENSITY).collect();
        let mean = p.iter().sum::<f64>() / p.len() as f64;
        let square: f64 = p.iter().zip(&exact).map(|(p, e)| (p - mean - e).powi(2)).sum();
        (square / p.len() as f64).sqrt()
    };
    let (coarse, fine) = (error(12), error(24));
    let order = (coarse / fine).log2();
    assert!(order > 1.8, "{coarse} to {fine}: order {order}");
}

#[test]
fn the_surface_of_a_block_is_its_outermost_layer() {
    for jitter in [0.0, 0.1] {
        let water = square(20, jitter, false, Laplacian::Exact);
        let spacing = water.options.spacing;
        for i in 0..water.fluid.len() {
            let (x, y) = (water.fluid.x[i], water.fluid.y[i]);
            let depth = x.min(y).min(1.0 - x).min(1.0 - y) / spacing;
            let found = water.operators.at_surface[i];
            if depth < 0.7 {
                assert!(found, "at {x} {y}, jitter {jitter}");
            } else if depth > 2.2 {
                assert!(!found, "at {x} {y}, jitter {jitter}");
            }
        }
    }
}
