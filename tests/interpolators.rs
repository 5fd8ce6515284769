//! What each interpolator promises of fields: degree, order, and what it does with few neighbours.

use seawall::boundary::{
    AMPLIFICATION_LIMIT, ImprovedShepard, InterpolatorChoice, MlsLinear, MlsQuadratic, Normalized,
    Sfdi, SfdiMatrix, Stencil,
};
use seawall::kernel::{KernelChoice, WendlandC2};
use seawall::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use seawall::pairs::{Record, Scaling};

type Point = [f64; 2];

struct Weights<'a> {
    interpolator: InterpolatorChoice,
    at: Point,
    records: &'a [Record],
}

impl Task for Weights<'_> {
    type Output = (Vec<f64>, bool);

    fn run<L: Lanes>(self) -> (Vec<f64>, bool) {
        let neighbours: Vec<u32> = (0..self.records.len() as u32).collect();
        let stencil = Stencil {
            x: L::splat(self.at[0]),
            y: L::splat(self.at[1]),
            neighbours: &neighbours,
            records: self.records,
            kernel: KernelChoice::WendlandC2,
        };
        let mut weights = vec![[0.0; LANES]; neighbours.len()];
        if self.interpolator.from_kernel() {
            stencil.kernel_weights::<WendlandC2>(&mut weights);
        }
        let weighing = self.interpolator.weigh(&stencil, &mut weights);
        let (scale, fallback) = (weighing.scale.to_array(), weighing.fallback.to_array());
        assert!(scale.iter().all(|&lane| lane == scale[0]), "lanes are alike");
        (weights.iter().map(|weight| weight[3] * scale[3]).collect(), fallback[3] > 0.5)
    }
}

/// Weights of particles at a point, in units of the support radius, and whether it fell back.
fn weights(choice: InterpolatorChoice, at: Point, particles: &[Point]) -> (Vec<f64>, bool) {
    let volume = Scaling::new(KernelChoice::WendlandC2, 1.0).weight_per_volume * 0.06;
    let record = |&[x, y]: &Point| Record([x, y, 0.0, 0.0, volume, 0.0, 0.0, 0.0]);
    let records: Vec<Record> = particles.iter().map(record).collect();
    dispatch(SimdPath::widest(), Weights { interpolator: choice, at, records: &records })
}

fn value(weights: &[f64], particles: &[Point], field: impl Fn(Point) -> f64) -> f64 {
    weights.iter().zip(particles).map(|(w, &place)| w * field(place)).sum()
}

/// A disordered half plane of water, y > 0, with a spacing of a quarter of the support.
fn half_plane(jitter: f64, seed: f64) -> Vec<Point> {
    let scatter = |k: f64, factor: f64| jitter * (2.0 * ((k + seed) * factor).fract() - 1.0);
    (0..140)
        .map(|k| (f64::from(k), f64::from(k % 14) - 6.5, f64::from(k / 14) + 0.5))
        .map(|(k, x, y)| {
            [0.25 * (x + scatter(k + 1.0, 0.618_034)), 0.25 * (y + scatter(k + 1.0, 0.754_878))]
        })
        .collect()
}

fn sfdi(matrix: SfdiMatrix, amplification_limit: f64) -> InterpolatorChoice {
    InterpolatorChoice::Sfdi(Sfdi { matrix, amplification_limit })
}

#[test]
fn promised_degrees_are_exact_at_walls_and_inside() {
    let quadratic = |[x, y]: Point| 3.0 - 2.0 * x + 5.0 * y + 4.0 * x * x - 3.0 * x * y + y * y;
    let linear = |[x, y]: Point| 3.0 - 2.0 * x + 5.0 * y;
    let mut diagonal = 0.0_f64;
    for seed in [0.0, 17.0, 40.0] {
        let water = half_plane(0.35, seed);
        for at in [[0.05, 0.125], [0.0, 0.375], [0.11, 1.1]] {
            for choice in [
                sfdi(SfdiMatrix::Full, AMPLIFICATION_LIMIT),
                InterpolatorChoice::MlsLinear(MlsLinear { amplification_limit: 4.0 }),
                InterpolatorChoice::MlsQuadratic(MlsQuadratic { amplification_limit: 4.0 }),
            ] {
                let (weights, fell_back) = weights(choice, at, &water);
                assert!(!fell_back, "{choice:?}");
                let error = value(&weights, &water, linear) - linear(at);
                assert!(error.abs() < 1e-9, "{choice:?} at {at:?}: {error:e}");
                let error = value(&weights, &water, quadratic) - quadratic(at);
                let exact = matches!(choice, InterpolatorChoice::MlsQuadratic(_));
                assert_eq!(error.abs() < 1e-9, exact, "{choice:?} at {at:?}: {error:e}");
            }
            let (weights, _) = weights(sfdi(SfdiMatrix::Diagonal, 4.0), at, &water);
            let error = value(&weights, &water, linear) - linear(at);
            diagonal = diagonal.max(error.abs());
        }
    }
    assert!(diagonal > 1e-3, "N's diagonal alone is not exact: {diagonal:e}");
}

#[test]
fn weights_sum_to_one_with_any_number_of_neighbours() {
    let triangle = [[0.1, 0.1], [0.4, 0.15], [0.2, 0.5]];
    let line = [[0.1, 0.1], [0.2, 0.2], [0.4, 0.4]];
    let coincident = [[0.2, 0.1]; 3];
    let mut crowd = half_plane(0.3, 3.0);
    crowd.extend(crowd.clone());
    for choice in InterpolatorChoice::every() {
        assert!(weights(choice, [0.0, 0.0], &[]).0.is_empty());
        let (none, _) = weights(choice, [5.0, 5.0], &triangle);
        assert_eq!(none, [0.0; 3], "{choice:?}: out of reach");
        let sets: [&[Point]; 6] =
            [&triangle[..1], &triangle[..2], &triangle, &line, &coincident, &crowd];
        for set in sets {
            for at in [[0.0, 0.0], [0.25, 0.2], [0.1, 0.1]] {
                let (weights, _) = weights(choice, at, set);
                let sum: f64 = weights.iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{choice:?}: {sum} of {set:?}");
                let strength: f64 = weights.iter().map(|w| w.abs()).sum();
                assert!(strength < AMPLIFICATION_LIMIT + 1e-9, "{choice:?}: {strength}");
            }
        }
    }
}

#[test]
fn too_few_or_collinear_neighbours_are_counted_as_fallbacks() {
    let water = half_plane(0.3, 0.0);
    let conic: Vec<Point> =
        (0..9).map(|k| f64::from(k) * 0.698).map(|t| [0.5 * t.cos(), 0.5 * t.sin()]).collect();
    let line: Vec<Point> = (0..6).map(|k| [0.1 * f64::from(k), 0.05 * f64::from(k)]).collect();
    let triangle = [[0.1, 0.1], [0.4, 0.15], [0.2, 0.5]];
    let falls = |choice, at, set: &[Point]| weights(choice, at, set).1;
    for choice in InterpolatorChoice::every() {
        let (linear, quadratic) = (
            matches!(choice, InterpolatorChoice::MlsLinear(_) | InterpolatorChoice::Sfdi(_)),
            matches!(choice, InterpolatorChoice::MlsQuadratic(_)),
        );
        assert!(!falls(choice, [0.0, 0.4], &water), "{choice:?}");
        assert_eq!(falls(choice, [0.2, 0.2], &triangle), quadratic, "{choice:?}");
        assert_eq!(falls(choice, [0.1, 0.0], &conic), quadratic, "{choice:?}");
        if choice != sfdi(SfdiMatrix::Diagonal, AMPLIFICATION_LIMIT) {
            assert_eq!(falls(choice, [0.2, 0.2], &line), linear || quadratic, "{choice:?}");
        }
        assert_eq!(falls(choice, [0.0; 2], &triangle[..1]), linear || quadratic, "{choice:?}");
    }
}

#[test]
fn what_stands_in_is_the_simpler_method() {
    let triangle = [[0.1, 0.1], [0.4, 0.15], [0.2, 0.5]];
    let at = [0.2, 0.2];
    let limit = AMPLIFICATION_LIMIT;
    let of = |choice, set: &[Point]| weights(choice, at, set).0;
    let quadratic = InterpolatorChoice::MlsQuadratic(MlsQuadratic { amplification_limit: limit });
    let linear = InterpolatorChoice::MlsLinear(MlsLinear { amplification_limit: limit });
    let normalized = InterpolatorChoice::Normalized(Normalized);
    let near = |a: Vec<f64>, b: Vec<f64>| {
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
    };
    near(of(quadratic, &triangle), of(linear, &triangle));
    near(of(quadratic, &triangle[..2]), of(normalized, &triangle[..2]));
    near(of(linear, &triangle[..2]), of(normalized, &triangle[..2]));
    near(of(sfdi(SfdiMatrix::Full, limit), &triangle[..1]), vec![1.0]);
}

/// Root mean square errors for a smooth field at mirror points half a spacing to a whole support
/// away from a wall; `scale` is R, the spacing a quarter of it.
fn wall_error(choice: InterpolatorChoice, scale: f64) -> f64 {
    let field = |[x, y]: Point| (1.3 * x + 0.4).sin() * (0.9 * y - 0.2).cos() + 0.5 * x * y;
    let water = half_plane(0.3, 5.0);
    let (mut sum, mut count) = (0.0, 0);
    for row in 0..4 {
        for column in 0..8 {
            let at = [0.25 * (f64::from(column) - 3.5) * 0.5, 0.25 * (f64::from(row) + 0.5)];
            let (weights, fell_back) = weights(choice, at, &water);
            assert!(!fell_back);
            let scaled = |[x, y]: Point| field([scale * x, scale * y]);
            sum += (value(&weights, &water, scaled) - scaled(at)).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count)).sqrt()
}

/// With which power of the support errors at walls fall. Dummy counts as an interpolator at the same
/// points: the normalized one.
fn promised_order(choice: InterpolatorChoice) -> f64 {
    match choice {
        InterpolatorChoice::ImprovedShepard(_) => 1.0,
        InterpolatorChoice::Normalized(_) | InterpolatorChoice::Dummy(_) => 1.0,
        InterpolatorChoice::Sfdi(Sfdi { matrix: SfdiMatrix::Diagonal, .. }) => 1.0,
        InterpolatorChoice::Sfdi(_) | InterpolatorChoice::MlsLinear(_) => 2.0,
        InterpolatorChoice::MlsQuadratic(_) => 3.0,
    }
}

#[test]
fn errors_at_walls_fall_with_the_promised_order() {
    for choice in InterpolatorChoice::every() {
        let (coarse, fine) = (wall_error(choice, 0.4), wall_error(choice, 0.1));
        let order = (coarse / fine).log2() / 2.0;
        println!("{choice:?}: {coarse:.2e} at R = 0.4, {fine:.2e} at 0.1, order {order:.2}");
        let promised = promised_order(choice);
        assert!((order - promised).abs() < 0.25, "{choice:?}: {order} instead of {promised}");
    }
}

/// Prints the sensitivity table of results/boundary_comparison/README.md.
#[test]
fn the_weights_of_improved_shepard_change_the_error_and_not_the_order() {
    for lambda in [1.0, 2.0, 4.0] {
        for sigma in [0.0, 0.5, 1.0, 2.0, 4.0] {
            let choice = InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda, sigma });
            let (coarse, fine) = (wall_error(choice, 0.4), wall_error(choice, 0.1));
            let order = (coarse / fine).log2() / 2.0;
            println!("| {lambda} | {sigma} | {coarse:.2e} | {fine:.2e} | {order:.2} |");
            assert!((order - 1.0).abs() < 0.2, "lambda {lambda}, sigma {sigma}: {order}");
        }
    }
}
