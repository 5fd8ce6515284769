//! Operators and the pressure equation against exact fields.

mod corner;
mod step;
mod viscosity;

use super::options::{IsphOptions, Laplacian};
use super::state::Isph;
use crate::body::BodyMotion;
use crate::boundary::{Ghosts, TankLayout, box_ghosts, no_ghosts};
use crate::kernel::KernelChoice;
use crate::math::simd::SimdPath;
use crate::math::sparse::{PreconditionerChoice, Product};
use crate::pairs::Fluid;
use crate::scheme::Scheme;

const DENSITY: f64 = 1000.0;
const AT_REST: [BodyMotion; 4] = [BodyMotion { offset: 0.0, velocity: 0.0, acceleration: 0.0 }; 4];

fn options(spacing: f64, laplacian: Laplacian) -> IsphOptions {
    IsphOptions {
        kernel: KernelChoice::WendlandC2,
        support_radius: 4.0 * spacing,
        spacing,
        density: DENSITY,
        gravity: 0.0,
        still_level: 1.0,
        viscosity: 0.0,
        compact_share: 0.05,
        acceleration: 1.0,
        viscous_speed: 1.0,
        artificial_viscosity: 0.0,
        shifting_coefficient: 0.0,
        shifting_fades_in: crate::water::SHIFT_INTERIOR,
        laplacian,
        preconditioner: PreconditionerChoice::Multigrid,
        solver_tolerance: 1e-9,
        courant_number: 0.2,
        volume_rate: 0.0,
    }
}

/// Numbers from -1 to 1.
fn noise() -> impl FnMut() -> f64 {
    let mut seed = 1_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
    }
}

fn layout(spacing: f64) -> TankLayout {
    TankLayout {
        length: 1.0,
        spacing_x: spacing,
        spacing_y: spacing,
        support_radius: 4.0 * spacing,
        wall_height: 1.0,
        bed_beyond_wall: 0.0,
        bed_before_paddle: 0.0,
        wall_angle_deg: 90.0,
        still_level: 1.0,
        dry_bed: false,
        crest: None,
    }
}

/// A unit square of `side` x `side` particles with its lists made. Particles are displaced by up to
/// `jitter` spacings. The square fills a closed box or has a free surface all around.
fn square(side: usize, jitter: f64, closed: bool, laplacian: Laplacian) -> Isph {
    let spacing = 1.0 / side as f64;
    let mut random = noise();
    let mass = DENSITY * spacing * spacing;
    let points = (0..side * side).map(|k| {
        let at = |number: usize, random: f64| (number as f64 + 0.5 + jitter * random) * spacing;
        [at(k % side, random()), at(k / side, random()), DENSITY, mass]
    });
    let layout = layout(spacing);
    let ghosts: Ghosts =
        if closed { box_ghosts(&layout, 1.0, spacing) } else { no_ghosts(spacing) };
    let water = Fluid::at_rest(points.collect::<Vec<_>>());
    let mut water =
        Isph::new(options(spacing, laplacian), ghosts, water, usize::MAX, SimdPath::widest());
    lists(&mut water);
    water
}

fn lists(water: &mut Isph) {
    let bodies = &AT_REST[..water.loads.len()];
    water.list(bodies, 1e-9);
    water.find_operators();
    water.assemble();
    water.soften();
}

/// The product of the exact Laplacian with a pressure.
fn exact_product(water: &mut Isph, pressure: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; pressure.len()];
    water.exact_laplacian().multiply(pressure, &mut product);
    product
}

/// Particles whose supports are full within three support radii. Three are needed because the
/// gradient at a neighbour uses the corrections of its own neighbours.
fn inside(water: &Isph) -> Vec<usize> {
    let reach = 3.01 * water.options.support_radius;
    let deep = |x: f64| x > reach && x < 1.0 - reach;
    let fluid = &water.fluid;
    (0..fluid.len()).filter(|&i| deep(fluid.x[i]) && deep(fluid.y[i])).collect()
}

fn field(water: &Isph, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let fluid = &water.fluid;
    (0..fluid.len()).map(|i| value(fluid.x[i], fluid.y[i])).collect()
}

#[test]
fn parting_spreads_crowded_water_and_keeps_its_centre_of_mass() {
    let mut water = square(10, 0.35, false, Laplacian::Exact);
    water.options.shifting_coefficient = 0.5;
    water.fluid.vx[..100].fill(1.0);
    let state = |water: &Isph| {
        let places: Vec<_> = (0..100).map(|k| [water.fluid.x[k], water.fluid.y[k]]).collect();
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let pairs = (0..100).flat_map(|i| (0..i).map(move |j| (i, j)));
        let closest = pairs.map(|(i, j)| apart(places[i], places[j])).fold(1.0, f64::min);
        let mean = |axis: usize| places.iter().map(|place| place[axis]).sum::<f64>() / 100.0;
        (closest, [mean(0), mean(1)])
    };
    let (closest, centre) = state(&water);
    for _ in 0..40 {
        lists(&mut water);
        water.part(0.01);
    }
    let (parted, moved) = state(&water);
    assert!(closest < 0.05 && parted > 0.07, "{closest} to {parted}, spacing 0.1");
    assert!((moved[0] - centre[0]).abs() + (moved[1] - centre[1]).abs() < 1e-12);
}

#[test]
fn divergence_is_exact_on_linear_velocities_however_particles_lie() {
    let mut water = square(16, 0.2, false, Laplacian::Exact);
    let (x, y) = (field(&water, |x, _| x), field(&water, |_, y| y));
    water.velocities =
        x.iter().zip(&y).map(|(x, y)| [1.0 + 2.0 * x - y, 3.0 * x + 0.5 * y]).collect();
    water.diverge(|walls| walls.velocity);
    for i in 0..water.fluid.len() {
        if water.operators.completeness[i] > 0.45 {
            let divergence = water.divergence[i];
            assert!((divergence - 2.5).abs() < 1e-9, "{divergence} at {} {}", x[i], y[i]);
        }
    }
}

#[test]
fn laplacians_are_exact_on_quadratic_pressures_of_a_lattice() {
    let p = |x: f64, y: f64| 2.0 + x - 3.0 * y + 1.5 * x * x - 0.5 * x * y + 0.25 * y * y;
    for laplacian in [Laplacian::Exact, Laplacian::Symmetric, Laplacian::Schwaiger] {
        let mut water = square(32, 0.0, false, laplacian);
        let pressure = field(&water, p);
        let minus = if laplacian == Laplacian::Exact {
            water.options.compact_share = 0.0;
            exact_product(&mut water, &pressure)
        } else {
            let mut image = vec![0.0; pressure.len()];
            water.system.matrix.multiply(water.path, &pressure, &mut image);
            image
        };
        for i in inside(&water) {
            let [xx, xy, yy] = water.operators.moment[i];
            let kappa = match laplacian {
                Laplacian::Exact => 1.0,
                _ => 0.5 * (xx + yy) / (xx * yy - xy * xy),
            };
            let value = -kappa * minus[i] * DENSITY / water.fluid.mass[i];
            assert!((value - 3.5).abs() < 1e-6, "{laplacian:?}: {value}");
        }
    }
}

#[test]
fn schwaigers_laplacian_of_a_linear_pressure_is_zero_however_particles_lie() {
    let largest = |laplacian| {
        let water = square(32, 0.2, false, laplacian);
        let pressure = field(&water, |x, y| 2.0 + x - 3.0 * y);
        let mut image = vec![0.0; pressure.len()];
        water.system.matrix.multiply(water.path, &pressure, &mut image);
        inside(&water).into_iter().map(|i| image[i].abs()).fold(0.0, f64::max)
    };
    let (corrected, plain) = (largest(Laplacian::Schwaiger), largest(Laplacian::Symmetric));
    assert!(corrected < 1e-10 && plain > 1e-3, "{corrected} {plain}");
}

#[test]
fn the_exact_laplacian_is_symmetric_and_takes_energy_between_walls_too() {
    // A number of particles that leaves most of the last vector empty.
    let mut water = square(13, 0.2, true, Laplacian::Exact);
    let a = field(&water, |x, y| (7.0 * x).sin() + (31.0 * x * y).cos());
    let b = field(&water, |x, y| (5.0 * y).cos() - (23.0 * x).sin() * y);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (image_a, image_b) = (exact_product(&mut water, &a), exact_product(&mut water, &b));
    let (one, other) = (dot(&a, &image_b), dot(&b, &image_a));
    assert!((one - other).abs() < 1e-12 * dot(&a, &image_a), "{one} {other}");
    assert!(dot(&a, &image_a) > 0.0 && dot(&b, &image_b) > 0.0);
}
