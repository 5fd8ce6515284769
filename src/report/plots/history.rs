//! Time histories at the wall: force, runup and displacement, one figure per wave height with a
//! few curves spread over the stiffnesses (or over the masses, where there is one stiffness).

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Look, draw};
use super::{Figure, file_name, of_variant};
use crate::report::curves::{distinct, variants};
use crate::report::error::ReportError;
use crate::report::load::{Loaded, Sample};
use crate::report::number;
use crate::report::row::Row;

const CURVES: usize = 6;
const BUCKETS: usize = 250;
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 140.0;
const LEFT: f64 = 66.0;
const GAP: f64 = 22.0;

/// One case's history with its words in the legend.
struct Line {
    label: String,
    samples: Vec<Sample>,
}

/// The figures of every wave height and variant that has histories.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        for wave in distinct(data.finished(), |row| row.wave_height_ratio) {
            let rows: Vec<_> = data
                .finished()
                .filter(|row| row.variant == variant && row.wave_height_ratio == Some(wave))
                .collect();
            let (chosen, common) = choose(&rows);
            let mut lines = Vec::new();
            for (label, row) in chosen {
                if let Some(samples) = data.history(&row.case_id)?.filter(|s| s.len() > 1) {
                    lines.push(Line { label, samples });
                }
            }
            if lines.is_empty() {
                continue;
            }
            let name = file_name(&format!("history-wave-{wave}"), &variant);
            figures.push(Figure {
                svg: sheet(&name, &lines)?,
                caption: format!(
                    "Force (unfiltered), runup{} at the wall{common}, over the time since the \
                     paddle's start. Spikes of one or two samples may leave the panel.",
                    if moves(&lines) { " and displacement" } else { "" }
                ),
                title: format!("Histories, H/h = {wave}{}", of_variant(&variant)),
                name,
            });
        }
    }
    Ok(figures)
}

/// At most [`CURVES`] cases and their labels, and what they have in common.
fn choose<'a>(rows: &[&'a Row]) -> (Vec<(String, &'a Row)>, String) {
    let movable = || rows.iter().copied().filter(|row| !row.is_fixed());
    let stiffnesses = distinct(movable(), |row| row.spring_stiffness_n_per_m);
    let masses = distinct(movable(), |row| row.seawall_mass_kg_per_m);
    let mut chosen: Vec<(String, &Row)> = Vec::new();
    let mut common = String::new();
    if stiffnesses.len() > 1 {
        let mass = masses[(masses.len() - 1) / 2];
        common = format!(", m = {} kg/m", number::plain(mass));
        for stiffness in spread(&stiffnesses) {
            let label = format!("k = {} N/m", number::plain(stiffness));
            let found = movable().find(|row| {
                row.spring_stiffness_n_per_m == Some(stiffness)
                    && row.seawall_mass_kg_per_m == Some(mass)
            });
            chosen.extend(found.map(|row| (label, row)));
        }
    } else if let Some(&stiffness) = stiffnesses.first() {
        common = format!(", k = {} N/m", number::plain(stiffness));
        for mass in spread(&masses) {
            let label = format!("m = {} kg/m", number::plain(mass));
            let found = movable().find(|row| row.seawall_mass_kg_per_m == Some(mass));
            chosen.extend(found.map(|row| (label, row)));
        }
    }
    let fixed = rows.iter().copied().find(|row| row.is_fixed());
    chosen.extend(fixed.map(|row| ("fixed wall".to_owned(), row)));
    (chosen, common)
}

/// At most [`CURVES`] of the values, evenly spread and with both ends.
fn spread(values: &[f64]) -> Vec<f64> {
    let count = values.len().min(CURVES);
    let last = values.len().saturating_sub(1);
    let at = |index: usize| values[(index * last + (count - 1) / 2) / (count - 1).max(1)];
    (0..count).map(at).collect()
}

fn moves(lines: &[Line]) -> bool {
    lines.iter().flat_map(|line| &line.samples).any(|s| s.displacement.is_some_and(|x| x != 0.0))
}

type Quantity = (&'static str, fn(&Sample) -> Option<f64>);

const QUANTITIES: [Quantity; 3] = [
    ("F / (½ρgh²)", |sample| Some(sample.force)),
    ("R / h", |sample| Some(sample.runup)),
    ("X / h", |sample| sample.displacement),
];

fn sheet(name: &str, lines: &[Line]) -> Result<String, ReportError> {
    let quantities = if moves(lines) { &QUANTITIES[..] } else { &QUANTITIES[..2] };
    let samples = || lines.iter().flat_map(|line| &line.samples);
    let x = Axis::within(samples().map(|sample| sample.time_s), 8.0);
    let entry = |(index, line): (usize, &Line)| Entry {
        label: line.label.clone(),
        look: Look::of(index),
        line: true,
        marker: None,
    };
    let legend = Legend::new(lines.iter().enumerate().map(entry).collect(), LEFT, LEFT + WIDTH);
    let top = 16.0 + legend.height();
    let height = top + quantities.len() as f64 * (HEIGHT + GAP) + 30.0;
    draw(name, (LEFT + WIDTH + 16.0, height), |pen| {
        legend.draw(pen, 6.0)?;
        for (index, (title, read)) in quantities.iter().enumerate() {
            let lasting = lines.iter().flat_map(|line| lasting(&line.samples, *read));
            let Some((x, y)) = x.clone().zip(Axis::around(lasting, 4.0)) else { continue };
            let top = top + index as f64 * (HEIGHT + GAP);
            let panel = Panel { left: LEFT, top, width: WIDTH, height: HEIGHT, x, y };
            let last = index + 1 == quantities.len();
            panel.draw(pen, last)?;
            panel.title_y(pen, title)?;
            if last {
                panel.title_x(pen, "t, s")?;
            }
            for (index, line) in lines.iter().enumerate() {
                let points: Vec<_> =
                    line.samples.iter().filter_map(|s| Some((s.time_s, read(s)?))).collect();
                let points: Vec<_> =
                    thin(&points).into_iter().map(|(t, value)| panel.at(t, value)).collect();
                if points.len() > 1 {
                    pen.line(&points, Look::of(index).colour, 1.5)?;
                }
            }
        }
        Ok(())
    })
}

/// Medians of five samples each: the values that last. An axis made for these is not squashed by
/// the pulse of a wall that comes back onto its stop.
fn lasting(samples: &[Sample], read: fn(&Sample) -> Option<f64>) -> Vec<f64> {
    let values: Vec<f64> = samples.iter().filter_map(read).collect();
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
    fn spreading_keeps_both_ends() {
        let ten: Vec<f64> = (0..10).map(f64::from).collect();
        assert_eq!(spread(&ten), [0.0, 2.0, 4.0, 5.0, 7.0, 9.0]);
        assert_eq!(spread(&[3.0]), [3.0]);
        assert_eq!(spread(&[]), [0.0; 0]);
    }

    #[test]
    fn a_spike_does_not_last() {
        let sample = |index: u32| Sample {
            time_s: f64::from(index),
            force: if index == 50 { -20.0 } else { 1.0 },
            runup: 0.0,
            displacement: None,
        };
        let samples: Vec<_> = (0..100).map(sample).collect();
        assert!(lasting(&samples, |s| Some(s.force)).iter().all(|force| *force == 1.0));
        assert!(lasting(&samples, |s| s.displacement).is_empty());
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
