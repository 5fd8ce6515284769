//! Panels of curves over time, one below the other on one axis of time.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Look, draw};
use crate::report::error::ReportError;

const BUCKETS: usize = 250;
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 140.0;
const LEFT: f64 = 66.0;
const GAP: f64 = 22.0;

/// One curve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Curve {
    /// Its words in the legend.
    pub label: String,
    /// Time in seconds and value; may be empty, so that curves keep their colours from panel to
    /// panel.
    pub points: Vec<(f64, f64)>,
}

/// One panel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Strip {
    /// Title of the vertical axis.
    pub title: String,
    /// Its curves.
    pub curves: Vec<Curve>,
    /// The axis reaches to every peak, and not only to what lasts.
    pub peaks: bool,
}

impl Strip {
    /// Whether anything but naught is to be drawn.
    pub fn holds_anything(&self) -> bool {
        self.points().any(|point| point.1 != 0.0)
    }

    fn points(&self) -> impl Iterator<Item = &(f64, f64)> {
        self.curves.iter().flat_map(|curve| &curve.points)
    }

    fn axis(&self) -> Option<Axis> {
        if self.peaks {
            return Axis::around(self.points().map(|point| point.1), 4.0);
        }
        Axis::around(self.curves.iter().flat_map(|curve| lasting(&curve.points)), 4.0)
    }

    /// A legend, unless it would say what the panel above says, or nothing at all.
    fn legend(&self, above: Option<&Strip>) -> Option<Legend> {
        let labels = |strip: &Strip| strip.curves.iter().map(|c| c.label.clone()).collect();
        let words: Vec<String> = labels(self);
        if words.iter().all(String::is_empty) || above.is_some_and(|strip| labels(strip) == words) {
            return None;
        }
        let entry =
            |(index, label)| Entry { label, look: Look::of(index), line: true, marker: None };
        let entries = words.into_iter().enumerate().map(entry).collect();
        Some(Legend::new(entries, LEFT, LEFT + WIDTH))
    }
}

/// The drawing of panels that hold points, from the top down.
pub fn sheet(name: &str, strips: &[Strip]) -> Result<String, ReportError> {
    let times = strips.iter().flat_map(Strip::points).map(|point| point.0);
    let x = Axis::within(times, 8.0);
    let above = |index: usize| index.checked_sub(1).and_then(|above| strips.get(above));
    let mut bottom = 0.0;
    let place = |(index, strip): (usize, &Strip)| {
        let legend = strip.legend(above(index));
        let room = legend.as_ref().map_or(0.0, Legend::height);
        let top = bottom + 16.0 + room;
        bottom = top + HEIGHT + GAP - 16.0;
        (top, legend)
    };
    let places: Vec<_> = strips.iter().enumerate().map(place).collect();
    draw(name, (LEFT + WIDTH + 16.0, bottom + 46.0), |pen| {
        for (index, (strip, (top, legend))) in strips.iter().zip(&places).enumerate() {
            if let Some(legend) = legend {
                legend.draw(pen, top - 10.0 - legend.height())?;
            }
            let Some((x, y)) = x.clone().zip(strip.axis()) else { continue };
            let panel = Panel { left: LEFT, top: *top, width: WIDTH, height: HEIGHT, x, y };
            let last = index + 1 == strips.len();
            panel.draw(pen, last)?;
            panel.title_y(pen, &strip.title)?;
            if last {
                panel.title_x(pen, "t, s")?;
            }
            for (index, curve) in strip.curves.iter().enumerate() {
                let points: Vec<_> =
                    thin(&curve.points).into_iter().map(|(t, value)| panel.at(t, value)).collect();
                if points.len() > 1 {
                    pen.line(&points, Look::of(index).colour, 1.5)?;
                }
            }
        }
        Ok(())
    })
}

/// Medians of five values each: those that last. An axis made for these is not squashed by the
/// pulse of a wall that comes back onto its stop.
fn lasting(points: &[(f64, f64)]) -> Vec<f64> {
    let values: Vec<f64> = points.iter().map(|point| point.1).collect();
    let middle = |window: &[f64]| {
        let mut window = window.to_vec();
        window.sort_by(f64::total_cmp);
        window[window.len() / 2]
    };
    if values.len() < 5 { values } else { values.windows(5).map(middle).collect() }
}

/// Fewer points with the same peaks: the lowest and the highest of every bucket, in their order.
fn thin(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let size = points.len().div_ceil(BUCKETS);
    if size < 3 {
        return points.to_vec();
    }
    let ends = |bucket: &[(f64, f64)]| {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let low = *bucket.iter().min_by(by_value).expect("chunks are not empty");
        let high = *bucket.iter().max_by(by_value).expect("chunks are not empty");
        if low.0 <= high.0 { [low, high] } else { [high, low] }
    };
    points.chunks(size).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_does_not_last() {
        let points: Vec<_> =
            (0..100).map(|i| (f64::from(i), if i == 50 { -20.0 } else { 1.0 })).collect();
        assert!(lasting(&points).iter().all(|force| *force == 1.0));
        assert!(lasting(&[]).is_empty());
    }

    #[test]
    fn a_legend_is_said_once() {
        let curve = |label: &str| Curve { label: label.to_owned(), points: vec![(0.0, 1.0)] };
        let strip = |labels: &[&str]| Strip {
            curves: labels.iter().copied().map(curve).collect(),
            ..Strip::default()
        };
        let (one, other) = (strip(&["a", "b"]), strip(&["c"]));
        assert!(one.legend(None).is_some());
        assert_eq!(one.legend(Some(&one)), None);
        assert!(other.legend(Some(&one)).is_some());
        assert_eq!(strip(&[""]).legend(None), None);
    }

    #[test]
    fn thinning_keeps_the_peak() {
        let points: Vec<_> = (0..5000).map(|i| (f64::from(i), f64::from(i % 977))).collect();
        let thinned = thin(&points);
        assert!(thinned.len() <= 2 * BUCKETS);
        assert!(thinned.iter().any(|point| point.1 == 976.0));
        assert!(thinned.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }
}
