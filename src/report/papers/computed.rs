//! The value of a case that is compared with a printed number.

use crate::papers::{PAPER_CLOCK_CENTRE_S, Printed};
use crate::quantities::summary::{BOUNDARY, STEPS, STROKE_CENTRE, WALL_TIME};
use crate::quantities::{Column, Unit, named};
use crate::report::config::Config;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::row::Row;
use crate::report::series::at;

/// Step times are compared with those of this interpolator at walls.
pub const REFERENCE: &str = "improved-shepard";

/// The summary's column of a printed quantity, if there is one.
pub fn column(printed: &Printed) -> Option<&'static Column> {
    named(&printed.quantity)
}

/// The case's value; `None` if it has none. `all` holds the cases that the number is printed for.
pub fn of(
    data: &Loaded,
    printed: &Printed,
    row: &Row,
    all: &[(&Row, &Config)],
) -> Result<Option<f64>, ReportError> {
    let name = printed.quantity.as_str();
    if let Some(column) = column(printed) {
        let value = row.number(column);
        return Ok(if column.unit == Unit::Seconds { on_their_clock(row, value) } else { value });
    }
    if let Some(maximum) = name.strip_suffix("_time_s").and_then(named) {
        return Ok(on_their_clock(row, row.time(maximum)));
    }
    if let Some(boundary) = printed.timed_boundary() {
        return Ok(step_time_ratio(row, boundary, all));
    }
    let id = row.id();
    if let Some(time) = printed.time_s {
        let Some(time) = off_their_clock(row, time) else { return Ok(None) };
        let (series, wall) = match name {
            "wall_position_m" => ("displacement", true),
            name => (name, false),
        };
        let value = at(data.history(id)?.points(series), time);
        let config =
            all.iter().find(|(other, _)| std::ptr::eq(*other, row)).map(|(_, config)| *config);
        return Ok(if wall { value.zip(config).and_then(|(x, c)| place(x, c)) } else { value });
    }
    let readings = data.readings(id)?;
    Ok(readings.into_iter().find(|reading| reading.name == name).and_then(|reading| reading.value))
}

/// A time of this program on the papers' clock.
pub fn on_their_clock(row: &Row, time: Option<f64>) -> Option<f64> {
    Some(time? - row.number(&STROKE_CENTRE)? + PAPER_CLOCK_CENTRE_S)
}

fn off_their_clock(row: &Row, time: f64) -> Option<f64> {
    Some(time + row.number(&STROKE_CENTRE)? - PAPER_CLOCK_CENTRE_S)
}

/// Where the wall stands, m from the paddle at rest.
fn place(displacement: f64, config: &Config) -> Option<f64> {
    Some(config.value("tank_length_m")? + displacement * config.value("still_water_depth_m")?)
}

/// The time of a step over that of the same case with the reference interpolator.
pub fn step_time_ratio(row: &Row, boundary: &str, all: &[(&Row, &Config)]) -> Option<f64> {
    if row.text(&BOUNDARY) != boundary {
        return None;
    }
    let own = all.iter().find(|(other, _)| std::ptr::eq(*other, row))?.1;
    let without = |config: &Config| {
        let mut config = config.clone();
        config.numerics.remove(BOUNDARY.name);
        config
    };
    let wanted = without(own);
    let reference = all
        .iter()
        .find(|(other, config)| other.text(&BOUNDARY) == REFERENCE && without(config) == wanted)?;
    Some(step_time(row)? / step_time(reference.0)?)
}

/// Wall time of a step, seconds, of a case that ran from rest.
pub fn step_time(row: &Row) -> Option<f64> {
    let steps = row.number(&STEPS).filter(|&steps| steps > 0.0)?;
    row.number(&WALL_TIME).map(|time| time / steps).filter(|&time| time > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn their_clock_starts_a_second_before_the_middle_of_the_stroke() {
        let row = Row::default().with(&STROKE_CENTRE, 0.8);
        let there = on_their_clock(&row, Some(1.8)).unwrap();
        assert!((there - 2.0).abs() < 1e-12);
        assert!((off_their_clock(&row, there).unwrap() - 1.8).abs() < 1e-12);
        assert_eq!(on_their_clock(&Row::default(), Some(1.8)), None);
    }
}
