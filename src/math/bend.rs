//! How much a curve through points bends: what linear interpolation between two of them misses.

/// A point of a curve: its place and its value.
pub type Point = (f64, f64);

/// Second divided difference of three points, half the second derivative of a curve through them.
pub fn half_curvature([(x0, y0), (x1, y1), (x2, y2)]: [Point; 3]) -> f64 {
    ((y2 - y1) / (x2 - x1) - (y1 - y0) / (x1 - x0)) / (x2 - x0)
}

/// The parabolas through the ends of an interval and the point before or behind it, by half their
/// curvature. There are none without a third point.
pub fn beside(interval: [Point; 2], before: Option<Point>, behind: Option<Point>) -> Vec<f64> {
    let [left, right] = interval;
    let before = before.map(|point| half_curvature([point, left, right]));
    let behind = behind.map(|point| half_curvature([left, right, point]));
    before.into_iter().chain(behind).collect()
}

/// The largest deviation from the chord within an interval, that in its middle: |f''| d²/8.
pub fn sagitta(interval: [Point; 2], half_curvature: f64) -> f64 {
    let width = interval[1].0 - interval[0].0;
    half_curvature.abs() * width * width / 4.0
}

/// Where a parabola through both ends of an interval has a value that lies between theirs, as a share of
/// the interval. A curvature of 0 is the chord.
pub fn crossing(interval: [Point; 2], half_curvature: f64, value: f64) -> f64 {
    let [(x0, y0), (x1, y1)] = interval;
    // y0 + (y1 - y0) t + b t (t - 1) = value, of which the root in [0, 1] is wanted.
    let b = half_curvature * (x1 - x0) * (x1 - x0);
    let (slope, rest) = (y1 - y0 - b, y0 - value);
    let root = (slope * slope - 4.0 * b * rest).max(0.0).sqrt();
    let share = -2.0 * rest / (slope + root.copysign(y1 - y0));
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(f: impl Fn(f64) -> f64, places: [f64; 3]) -> [Point; 3] {
        places.map(|x| (x, f(x)))
    }

    #[test]
    fn a_parabola_is_known_whole() {
        let f = |x: f64| 3.0 * x * x - x + 2.0;
        let [a, b, c] = on(f, [0.5, 1.0, 4.0]);
        assert!((half_curvature([a, b, c]) - 3.0).abs() < 1e-12);
        assert_eq!(beside([a, b], None, None), [0.0; 0]);
        let half = beside([b, c], Some(a), None)[0];
        let middle = 0.5 * (b.1 + c.1) - f(2.5);
        assert!((sagitta([b, c], half) - middle).abs() < 1e-12, "{middle}");
        for x in [1.0, 1.7, 3.9, 4.0] {
            let found = 1.0 + 3.0 * crossing([b, c], half, f(x));
            assert!((found - x).abs() < 1e-12, "{found} for {x}");
        }
    }

    #[test]
    fn a_falling_curve_is_crossed_too() {
        let f = |x: f64| 10.0 - x * x;
        let [a, b, c] = on(f, [0.0, 1.0, 3.0]);
        let half = beside([b, c], Some(a), None)[0];
        let found = 1.0 + 2.0 * crossing([b, c], half, f(2.0));
        assert!((found - 2.0).abs() < 1e-12, "{found}");
        assert!((crossing([b, c], 0.0, 5.0) - 0.5).abs() < 1e-12, "the chord's middle");
    }

    #[test]
    fn the_parabolas_on_both_sides_bracket_a_smooth_curve() {
        // The third derivative of exp keeps its sign, so that the curve lies between both.
        let places = [-1.0, -0.4, 0.2, 0.8].map(|x: f64| (x, libm::exp(x)));
        let interval = [places[1], places[2]];
        let shares = beside(interval, Some(places[0]), Some(places[3]));
        let exact = (0.0 - interval[0].0) / 0.6;
        let mut found: Vec<_> = shares.iter().map(|half| crossing(interval, *half, 1.0)).collect();
        found.sort_by(f64::total_cmp);
        assert!(found[0] < exact && exact < found[1], "{found:?} around {exact}");
    }
}
