//! The largest force over stiffness and mass: a map for every wave height, and a bar that explains
//! the colours.

use super::axes::Axis;
use super::bar::Bar;
use super::chart::{Cell, Chart};
use super::marks::{coupling, key, picked, said, value_in_words};
use super::sheet::{Drawing, Layout};
use super::text::{SMALL, width};
use super::ticks::FEWEST;
use super::{Figure, SERIES, file_name, of_variant};
use crate::quantities::Column;
use crate::quantities::summary::{FIRST_FORCE_MAX, LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO};
use crate::report::curves::{distinct, responses, spread, variants};
use crate::report::load::Loaded;
use crate::report::number::significant;
use crate::report::row::Row;

/// The column that is mapped.
const SHOWN: &Column = &FIRST_FORCE_MAX;
/// At this size a map of ten columns has room for numbers.
const SIZE: (f64, f64) = (340.0, 226.0);
const ROOM: f64 = 280.0;
/// Labels along an axis, at most.
const WORDS: usize = 10;

/// The maps of every variant with four stiffnesses and four masses. For fewer, curves are enough.
pub fn figures(data: &Loaded) -> Vec<Figure> {
    variants(&data.rows).iter().filter_map(|variant| figure(data, variant)).collect()
}

fn figure(data: &Loaded, variant: &str) -> Option<Figure> {
    let rows = responses(&data.rows, variant, SHOWN);
    let values = |column: &Column| distinct(rows.iter().copied(), column);
    let (columns, lines) = (values(&LOG10_K_STAR), values(&M_STAR));
    if columns.len() < FEWEST || lines.len() < FEWEST {
        return None;
    }
    let forces: Vec<_> = rows.iter().filter_map(|row| row.number(SHOWN)).collect();
    let bar = Bar::of(&forces, SHOWN.unit.axis())?;
    let waves = values(&WAVE_HEIGHT_RATIO);
    let shown = spread(&waves, SERIES);
    let chart = |wave: &f64| {
        let own = rows.iter().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(*wave));
        let cells = own.filter_map(|row| cell(row, &columns, &lines, &bar)).collect();
        let (x, y) = (steps(&columns, &LOG10_K_STAR), steps(&lines, &M_STAR));
        let (title, names) = (LOG10_K_STAR.heading(), [LOG10_K_STAR.name, M_STAR.name]);
        let chart = Chart::new((x, y), [&title, M_STAR.symbol], names, Vec::new()).under(
            said(rows.iter().copied(), &WAVE_HEIGHT_RATIO, *wave),
            key(&WAVE_HEIGHT_RATIO, *wave),
        );
        Chart { cells, ..chart }
    };
    let charts = shown.iter().map(chart).collect();
    let law = coupling(rows.iter().copied());
    Some(Figure {
        name: file_name("map-force", variant),
        title: format!("Largest force over stiffness and mass{}", of_variant(variant)),
        caption: format!(
            "Largest force F* of the first impact over the spring stiffness k* = k/(ρgh²) and the \
             wall mass m* = m/(ρh²), a map for every nominal wave height. Fields are of equal \
             size, whatever lies between their values.{law}{}",
            picked(shown.len(), waves.len(), "wave heights")
        ),
        drawing: Drawing {
            bar: Some(bar),
            ..Drawing::new(charts, Layout { columns: 2, size: SIZE })
        },
    })
}

/// A place for every value, with at most ten labels.
fn steps(values: &[f64], column: &Column) -> Axis {
    let skip = values.len().div_ceil(WORDS);
    let word = |(index, value): (usize, &f64)| {
        let shown = if column == &LOG10_K_STAR {
            format!("{value:.1}")
        } else {
            significant(*value, 4).to_string()
        };
        if index % skip == 0 { shown.replace('-', "\u{2212}") } else { String::new() }
    };
    Axis::steps(values.iter().enumerate().map(word).collect())
}

fn cell(row: &Row, columns: &[f64], lines: &[f64], bar: &Bar) -> Option<Cell> {
    let place = |values: &[f64], column: &Column| {
        let own = row.number(column)?;
        values.iter().position(|value| *value == own)
    };
    let force = row.number(SHOWN)?;
    let words = format!("{force:.2}");
    let fits = (width(&words, SMALL) + 2.0) * columns.len() as f64 <= ROOM && lines.len() <= WORDS;
    Some(Cell {
        at: (place(columns, &LOG10_K_STAR)?, place(lines, &M_STAR)?),
        colour: bar.colour(force),
        label: if fits { words } else { String::new() },
        case: row.id().to_owned(),
        told: value_in_words(row, SHOWN),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    const STIFF: [f64; 4] = [10.0, 100.0, 500.0, 1e5];
    const HEAVY: [f64; 4] = [50.0, 100.0, 250.0, 500.0];

    #[test]
    fn every_case_has_a_field_with_its_number() {
        let (_directory, data) = fixture::read(fixture::movable(&[0.3, 0.5], &STIFF, &HEAVY));
        let figure = figures(&data).remove(0);
        let fields: Vec<_> = figure.drawing.charts.iter().map(|chart| chart.cells.len()).collect();
        assert_eq!(fields, [16, 15], "one case failed");
        let svg = figure.svg();
        assert!(svg.contains("m = 50 kg/m: first F* = 2."), "{svg}");
        assert_eq!(svg.matches("data-case=\"case-").count(), 31);
    }

    #[test]
    fn few_values_make_no_map() {
        let directory = fixture::movable(&[0.3], &STIFF, &HEAVY[..3]);
        assert!(figures(&Loaded::read(directory.path()).unwrap()).is_empty());
    }
}
