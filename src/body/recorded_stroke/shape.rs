//! What the points of a stroke tell, [s, m] each.

use crate::math::lists::median;

/// A gap in a record is this many times the median distance in time of its points ...
const HOLE: f64 = 5.0;
/// ... and the stroke moves across it by more than this share of its reach.
const UNSEEN: f64 = 0.02;

/// The paddle has set off once it has gone this share of its reach.
const SETS_OFF: f64 = 0.1;

/// Speeds are means over so many points, ...
const SEVERAL: usize = 4;
/// ... where there are so many.
const FEWEST: usize = 20;

/// A swing back or forth counts from this share of the way between the stroke's outermost points.
const SWING: f64 = 0.1;

/// The least and the largest of places, the start among them.
pub(super) fn widest(places: impl Iterator<Item = f64>) -> [f64; 2] {
    places.fold([0.0; 2], |[back, forth], at| [back.min(at), forth.max(at)])
}

/// How often a stroke turns back, small swings aside.
pub(super) fn turns(points: &[[f64; 2]]) -> usize {
    let [low, high] = widest(points.iter().map(|point| point[1] - points[0][1]));
    let swing = SWING * (high - low);
    // How far it was back and forth since it turned.
    let [mut back, mut forth] = [points[0][1]; 2];
    let (mut turns, mut forward) = (0, None);
    for &[_, at] in points {
        (back, forth) = (back.min(at), forth.max(at));
        let turned = match forward {
            Some(true) => at < forth - swing,
            Some(false) => at > back + swing,
            None => forth - back > swing,
        };
        if turned {
            turns += usize::from(forward.is_some());
            forward = Some(forward.map_or(at == forth, |before: bool| !before));
            (back, forth) = (at, at);
        }
    }
    turns
}

/// When a point first lies more than a tenth of the reach, metres, from the first one, seconds.
pub(super) fn sets_off(points: &[[f64; 2]], reach: f64) -> Option<f64> {
    let away = |point: &&[f64; 2]| (point[1] - points[0][1]).abs() > SETS_OFF * reach;
    points.iter().find(away).map(|point| point[0])
}

/// Mean speeds over the first so many points, over the last ones, and the largest over as many, m/s. A
/// mean, because records are noisy. Fewer points are no record: all are 0.
pub(super) fn speeds(points: &[[f64; 2]]) -> [f64; 3] {
    if points.len() < FEWEST {
        return [0.0; 3];
    }
    let over = |points: &[[f64; 2]]| {
        let [[from, at], [to, there]] = [points[0], points[points.len() - 1]];
        ((there - at) / (to - from)).abs()
    };
    let all: Vec<f64> = points.windows(SEVERAL).map(over).collect();
    [all[0], all[all.len() - 1], all.iter().copied().fold(0.0, f64::max)]
}

/// The two points beside the widest gap across which the stroke moves, and the median distance in
/// time of the points, s.
pub(super) fn hole(points: &[[f64; 2]], reach: f64) -> Option<([[f64; 2]; 2], f64)> {
    let pairs = points.windows(2).map(|pair| [pair[0], pair[1]]);
    let wide = |[before, after]: &[[f64; 2]; 2]| after[0] - before[0];
    let usual = median(&pairs.clone().map(|pair| wide(&pair)).collect::<Vec<_>>())?;
    let moves = |[before, after]: &[[f64; 2]; 2]| (after[1] - before[1]).abs() > UNSEEN * reach;
    let holes = pairs.filter(|pair| wide(pair) > HOLE * usual && moves(pair));
    Some((holes.max_by(|a, b| wide(a).total_cmp(&wide(b)))?, usual))
}
