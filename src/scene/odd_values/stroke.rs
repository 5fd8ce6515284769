//! Recorded strokes that are cut, have gaps, or go the other way.

use crate::body::Stroke;
use crate::keys::ConfigError;

/// The spline goes beyond its points by more than this share of its reach.
const OVERSHOOT: f64 = 0.05;
/// At its ends the paddle is faster than this share of its largest speed.
const MOVING: f64 = 0.1;
/// It ends farther back than this share of its reach.
const BACK: f64 = 0.5;

/// What looks like a mistake in a record.
pub(super) fn odd(stroke: &Stroke) -> impl Iterator<Item = ConfigError> {
    let shape = overshoot(stroke).or_else(|| hole(stroke));
    let all = [shape, begun(stroke), unended(stroke), backwards(stroke)];
    all.into_iter().flatten().map(|told| ConfigError::new("scene.recorded_stroke", "", told))
}

/// A spline through few points may go far beyond them.
fn overshoot(stroke: &Stroke) -> Option<String> {
    let (beyond, reach) = (stroke.overshoot(), stroke.reach());
    let told = || {
        format!(
            "between its points the paddle goes {beyond:.4} m farther than they do, as a spline: give more of them"
        )
    };
    (beyond > OVERSHOOT * reach).then(told)
}

/// A spline goes smoothly over a gap in a record.
fn hole(stroke: &Stroke) -> Option<String> {
    let ([before, after], usual) = stroke.hole()?;
    Some(format!(
        "has no points from {} s to {} s, where it goes by {:.4} m; elsewhere they are {usual:.4} s apart",
        before[0],
        after[0],
        (after[1] - before[1]).abs()
    ))
}

/// The run starts at rest. So a record that begins in the middle of a stroke makes another wave.
fn begun(stroke: &Stroke) -> Option<String> {
    let [first, _, most] = stroke.speeds();
    (first > MOVING * most).then(|| {
        format!(
            "begins at {first:.3} m/s, its largest speed is {most:.3} m/s: the paddle starts from rest, so what went \
             before is missing"
        )
    })
}

/// After its end the paddle stands.
fn unended(stroke: &Stroke) -> Option<String> {
    let [_, last, most] = stroke.speeds();
    (last > MOVING * most).then(|| {
        format!(
            "ends at {last:.3} m/s, its largest speed is {most:.3} m/s: the paddle stands from there on, so the rest is missing"
        )
    })
}

/// A stroke counts towards the wall.
fn backwards(stroke: &Stroke) -> Option<String> {
    let back = -stroke.ends_at();
    (back > BACK * stroke.reach()).then(|| {
        format!(
            "ends {back:.4} m farther away from the wall than it begins: strokes count towards the wall, and this one \
             draws water away from it"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: a record that was cut off in full motion, or had the wrong sign, made another wave
    /// without a word.
    #[test]
    fn a_cut_or_reversed_record_is_told() {
        let told = |from: i32, to: i32, sign: f64| {
            let place = |t: f64| sign * 0.05 * (1.0 + (2.0 * (t - 3.0)).tanh());
            let points = (from..=to).map(|k| 0.05 * f64::from(k)).map(|t| vec![t, place(t)]);
            let points = toml::Value::try_from(points.collect::<Vec<_>>()).unwrap();
            let stroke: Stroke = points.try_into().unwrap();
            odd(&stroke).map(|told| told.allowed).collect::<Vec<_>>()
        };
        assert_eq!(told(0, 120, 1.0), [""; 0]);
        for (from, to, sign, words) in [
            (60, 120, 1.0, "begins at 0.09"),
            (0, 60, 1.0, "ends at 0.09"),
            (0, 120, -1.0, "ends 0.1"),
        ] {
            let told = told(from, to, sign);
            assert!(told.len() == 1 && told[0].starts_with(words), "{told:?}");
        }
    }
}
