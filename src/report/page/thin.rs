//! Histories as drawings: few points of each curve, as text that a script reads back.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use crate::math::lists::ends;
use crate::quantities::history::{DISPLACEMENT, FORCE, RUNUP};
use crate::report::series::History;

/// Points are dropped if the curve stays within this share of its height. The share grows if more
/// than [`MOST`] points are left.
const FINEST: f64 = 1.0 / 400.0;
/// Points of a curve.
const MOST: usize = 110;
/// A number has twelve bits: two of them three bytes, which are four letters of base64.
const LEVELS: f64 = 4095.0;

/// The curves of one case as text with spaces. The first and the last time come first. Then each
/// curve has its symbol, lowest and highest value, and points. Curves with one single value are
/// left out; the text is empty where none is left.
pub fn history(history: &History) -> String {
    let drawn = [(&FORCE, "F*"), (&RUNUP, "R*"), (&DISPLACEMENT, "X*")];
    let curves = drawn.map(|(column, symbol)| (symbol, history.points(column.name)));
    let curves: Vec<_> = curves.into_iter().filter(|(_, points)| moves(points)).collect();
    let times = curves.iter().flat_map(|(_, points)| points.iter().map(|point| point.0));
    let Some((first, last)) = ends(times) else { return String::new() };
    let mut text = format!("{first:.4} {last:.4}");
    for (symbol, points) in &curves {
        let (low, high) = ends(points.iter().map(|point| point.1)).unwrap_or_default();
        let share = |&(time, value): &(f64, f64)| {
            ((time - first) / (last - first), (value - low) / (high - low))
        };
        let shares: Vec<_> = points.iter().map(share).collect();
        text.push_str(&format!(" {symbol} {low:.4e} {high:.4e} {}", packed(&thinned(&shares))));
    }
    text
}

fn moves(points: &[(f64, f64)]) -> bool {
    points.iter().any(|point| point.1 != points[0].1) && points.iter().any(|p| p.0 > points[0].0)
}

/// The points that keep the curve's shape, by Ramer, Douglas and Peucker.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut off = FINEST;
    loop {
        let mut kept = vec![0];
        keep(points, 0, points.len() - 1, off, &mut kept);
        if kept.len() <= MOST {
            return kept.into_iter().map(|at| points[at]).collect();
        }
        off *= 1.3;
    }
}

/// Adds the end of a stretch, and points within it farther from its chord than `off`.
fn keep(points: &[(f64, f64)], from: usize, to: usize, off: f64, kept: &mut Vec<usize>) {
    let ((t0, v0), (t1, v1)) = (points[from], points[to]);
    let chord = |time: f64| v0 + (v1 - v0) * (time - t0) / (t1 - t0).max(1e-12);
    let away = |at: usize| (points[at].1 - chord(points[at].0)).abs();
    let farthest = (from + 1..to).max_by(|a, b| away(*a).total_cmp(&away(*b)));
    match farthest.filter(|at| away(*at) > off) {
        Some(at) => {
            keep(points, from, at, off, kept);
            keep(points, at, to, off, kept);
        }
        None => kept.push(to),
    }
}

/// Four letters to a point: time and value. No letter has a meaning in HTML or JSON.
fn packed(points: &[(f64, f64)]) -> String {
    let level = |share: f64| (share.clamp(0.0, 1.0) * LEVELS).round() as u32;
    let bytes = |point: &(f64, f64)| {
        let [_, first, second, third] = (level(point.0) << 12 | level(point.1)).to_be_bytes();
        [first, second, third]
    };
    URL_SAFE_NO_PAD.encode(points.iter().flat_map(bytes).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::series::Series;

    fn series(name: &str, value: impl Fn(f64) -> f64) -> Series {
        let points = (0..900).map(|k| 0.005 * f64::from(k)).map(|t| (t, value(t))).collect();
        Series { name: name.to_owned(), points, ..Series::default() }
    }

    #[test]
    fn the_thinned_curve_is_the_curve() {
        let peak = |t: f64| 1.0 + 3.0 * (8.0 * (t - 2.0)).cosh().powi(-2);
        let all: Vec<_> = series("force", peak).points;
        let share: Vec<_> = all.iter().map(|(t, v)| (t / 4.495, (v - 1.0) / 3.0)).collect();
        let few = thinned(&share);
        assert!(few.len() < 60, "{}", few.len());
        for (time, value) in share {
            let next = few.iter().position(|point| point.0 >= time).unwrap().max(1);
            let ((t0, v0), (t1, v1)) = (few[next - 1], few[next]);
            let read = v0 + (v1 - v0) * (time - t0) / (t1 - t0);
            assert!((read - value).abs() <= FINEST + 1e-12, "{time}: {read} for {value}");
        }
    }

    #[test]
    fn noise_does_not_make_it_long() {
        let noise = |t: f64| (1e4 * t * t).sin();
        let text = history(&History(vec![series("force", noise), series("runup", |_| 0.0)]));
        let words: Vec<_> = text.split(' ').collect();
        assert_eq!(words[..3], ["0.0000", "4.4950", "F*"]);
        assert_eq!(words.len(), 6, "a runup of 0 throughout has no curve: {text}");
        assert!(words[5].len() <= 4 * MOST && words[5].starts_with("AA"));
        assert!(words[5][words[5].len() - 4..].starts_with("__"), "{text}");
    }

    /// The page's script reads these letters.
    #[test]
    fn a_point_has_four_letters() {
        let letters =
            packed(&[(0.0, 1.0), (0.5, 64.0 / LEVELS), (1.5, -1.0), (1.0, 62.0 / LEVELS)]);
        assert_eq!(letters, "AA__gABA__AA__A-");
    }

    #[test]
    fn no_history_is_no_text() {
        assert_eq!(history(&History::default()), "");
        let one = Series { points: vec![(0.0, 1.0)], ..series("force", |_| 1.0) };
        assert_eq!(history(&History(vec![one])), "");
    }
}
