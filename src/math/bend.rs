//! The curvature of a curve through points: the error of linear interpolation between two of them.

use super::lists::ends;

/// Share by which a curve may bend more than the parabolas on both sides of an interval, or than
/// one on one side.
const MORE: [f64; 2] = [0.5, 2.0];

/// Effect of a change of the curvature on the place where a value is crossed, as a share of the
/// interval. The change may be anywhere in the interval, and values may scatter, so the curve is
/// also wrong near the ends.
const SCATTER: f64 = 1.0 / 3.0;

/// Three points in a straight line may be those of a step. So their curvature may change by this
/// much, relative to that of a parabola that turns at an end of the interval.
const UNSEEN: f64 = 0.75;

/// A point of a curve: its place and its value.
pub type Point = (f64, f64);

/// Second divided difference of three points, half the second derivative of a curve through them.
pub fn half_curvature([(x0, y0), (x1, y1), (x2, y2)]: [Point; 3]) -> f64 {
    ((y2 - y1) / (x2 - x1) - (y1 - y0) / (x1 - x0)) / (x2 - x0)
}

/// The unit of curvature: that of a parabola that turns at an end of the interval.
fn unit([(x0, y0), (x1, y1)]: [Point; 2]) -> f64 {
    (y1 - y0) / ((x1 - x0) * (x1 - x0))
}

/// The points beside an interval, the nearest first, if there are any.
type Beside = [Option<Point>; 2];

/// The curvature within an interval, as the points in and beside it show it, as half of the second
/// derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Those of the parabolas through both ends and the next point on either side: the least and
    /// the largest.
    ends: [f64; 2],
    /// Its change from three points to the next three.
    change: f64,
    /// Whether there is a parabola on one side only.
    one_sided: bool,
}

impl Bend {
    /// The curvature between the point number `at` of a line and the next one. `None` without both
    /// of them and a third.
    pub fn after(at: usize, point: impl Fn(usize) -> Option<Point>) -> Option<Bend> {
        let before = [1, 2].map(|back| point(at.checked_sub(back)?));
        Bend::of([point(at)?, point(at + 1)?], before, [point(at + 2), point(at + 3)])
    }

    /// `None` without a third point.
    fn of(interval: [Point; 2], before: Beside, behind: Beside) -> Option<Bend> {
        let [left, right] = interval.map(Some);
        let line = [before[1], before[0], left, right, behind[0], behind[1]];
        let three = |at: usize| Some(half_curvature([line[at]?, line[at + 1]?, line[at + 2]?]));
        let bends = [0, 1, 2, 3].map(three);
        let changes = bends.windows(2).filter_map(|pair| Some((pair[1]? - pair[0]?).abs()));
        let ends = ends(bends[1..3].iter().copied().flatten())?;
        // Three points do not show a change: it may be as large as the curvature.
        let unseen = || ends.0.abs().max(UNSEEN * unit(interval).abs());
        Some(Bend {
            ends: ends.into(),
            change: changes.max_by(f64::total_cmp).unwrap_or_else(unseen),
            one_sided: bends[1].is_none() || bends[2].is_none(),
        })
    }

    /// Bound of the curvature, from its value and its change nearby.
    pub fn most(self) -> f64 {
        self.largest() + self.change
    }

    /// The larger of both parabolas' values.
    fn largest(self) -> f64 {
        self.ends[0].abs().max(self.ends[1].abs())
    }

    /// Shares of the interval between which nearly all such curves have a value. The value must lie
    /// between those of the ends.
    pub fn crossings(self, interval: [Point; 2], value: f64) -> [f64; 2] {
        let more = MORE[usize::from(self.one_sided)] * self.largest();
        let halves = [self.ends[0] - more, 0.0, self.ends[1] + more];
        let shares = halves.map(|half| crossing(interval, half, value));
        let scatter = SCATTER * (self.change / unit(interval)).abs();
        let (first, last) = ends(shares.into_iter()).unwrap_or((0.0, 1.0));
        [(first - scatter).max(0.0), (last + scatter).min(1.0)]
    }
}

/// The largest deviation from the chord within an interval, which is in its middle: |f''| d²/8.
pub fn sagitta(interval: [Point; 2], half_curvature: f64) -> f64 {
    let width = interval[1].0 - interval[0].0;
    half_curvature.abs() * width * width / 4.0
}

/// Where a parabola through both ends of an interval has a value between theirs, as a share of the
/// interval. A curvature of 0 is the chord.
pub fn crossing(interval: [Point; 2], half_curvature: f64, value: f64) -> f64 {
    let [(x0, y0), (x1, y1)] = interval;
    // y0 + (y1 - y0) t + b t (t - 1) = value; the root in [0, 1] is wanted.
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
        assert_eq!(Bend::of([a, b], [None; 2], [None; 2]), None);
        let half = half_curvature([a, b, c]);
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
        let half = half_curvature([a, b, c]);
        let found = 1.0 + 2.0 * crossing([b, c], half, f(2.0));
        assert!((found - 2.0).abs() < 1e-12, "{found}");
        assert!((crossing([b, c], 0.0, 5.0) - 0.5).abs() < 1e-12, "the chord's middle");
    }

    #[test]
    fn the_range_holds_a_smooth_curve_and_is_narrow_where_points_are_close() {
        let mut widths = Vec::new();
        for step in [0.6, 0.3, 0.15] {
            let place = |at: f64| Some((at * step - 0.1, libm::exp(at * step - 0.1)));
            let interval = [0.0, 1.0].map(|at| place(at).unwrap());
            let [before, behind] = [[-1.0, -2.0], [2.0, 3.0]].map(|places| places.map(place));
            let bend = Bend::of(interval, before, behind).unwrap();
            let value = libm::exp(0.3 * step - 0.1);
            let [low, high] = bend.crossings(interval, value);
            assert!(low < 0.3 && 0.3 < high, "{low} to {high}");
            widths.push(high - low);
            // From one side alone less is known.
            let alone = Bend::of(interval, [None; 2], behind).unwrap();
            let [first, last] = alone.crossings(interval, value);
            assert!(first < low && last > high, "{first} to {last}");
        }
        assert!(widths.windows(2).all(|pair| pair[1] < 0.6 * pair[0]), "{widths:?}");
    }

    #[test]
    fn a_step_may_stand_anywhere_between_its_neighbours() {
        let interval = [(0.0, 0.0), (1.0, -2.0)];
        let bend = Bend::of(interval, [Some((-1.0, 0.0)), None], [Some((2.0, -2.0)), None]);
        let [first, last] = bend.unwrap().crossings(interval, -1.0);
        assert!(first < 0.1 && last > 0.9, "{first} to {last}");
        // Three points in a straight line have no curvature, but it may still change. A fourth
        // point shows that it does not.
        let known = |last: Option<Point>| {
            let behind = [Some((2.0, -4.0)), last];
            Bend::of(interval, [None; 2], behind).unwrap().most()
        };
        assert_eq!([None, Some((3.0, -6.0)), Some((3.0, -4.5))].map(known), [1.5, 0.0, 0.75]);
    }
}
