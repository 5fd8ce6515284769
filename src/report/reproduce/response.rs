//! Figs. 13 to 15 of Liang et al. 2017: a response against the spring's stiffness. One row of
//! panels per mass, one column per factor s, one curve per wave.

use super::laws::{heading, laws, stands};
use super::{Drawn, Material, drawn};
use crate::quantities::summary::{LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, Unit, named};
use crate::report::curves::distinct;
use crate::report::error::ReportError;
use crate::report::papers::Found;
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Look, Point, case_point, key, printed_entry,
    printed_in_colour, printed_point,
};
use crate::report::row::{Row, label};

pub fn drawing(material: &Material, column: &str) -> Result<Option<Drawn>, ReportError> {
    let Some(column) = named(column) else { return Ok(None) };
    let rows: Vec<&Row> = material.cases().into_iter().map(|(_, row)| row).collect();
    let rows: Vec<&Row> = rows.into_iter().filter(|row| point(row, column).is_some()).collect();
    let marks = material.found.iter().filter(|one| one.printed.quantity == column.name);
    let marks: Vec<(&Row, Point)> = marks.filter_map(|one| Some((one.row, star(one)?))).collect();
    let points = || rows.iter().filter_map(|row| point(row, column));
    let floor = if column.unit == Unit::Force { 1.0 } else { 0.0 };
    let heights = points().map(|p| p.y).chain(marks.iter().map(|(_, p)| p.y)).chain([floor]);
    let axes = Axis::around(points().map(|p| p.x), 6.0).zip(Axis::around(heights, 6.0));
    let Some((x, y)) = axes else { return Ok(None) };
    let (waves, laws) =
        (distinct(rows.iter().copied(), &WAVE_HEIGHT_RATIO), laws(rows.iter().copied()));
    let mut charts = Vec::new();
    for mass in distinct(rows.iter().copied(), &M_STAR) {
        for &law in &laws {
            let here = |row: &Row| row.number(&M_STAR) == Some(mass) && stands(row, law);
            let own: Vec<_> = rows.iter().copied().filter(|row| here(row)).collect();
            let mut curves = by_wave(&own, &waves, column);
            let own = marks.iter().filter(|(row, _)| here(row));
            curves.extend(own.map(|(row, mark)| marked(row, mark, &waves)));
            if !marks.is_empty() {
                curves.push(Curve { entry: printed_entry(), points: Vec::new() });
            }
            let heading = [label(&M_STAR, mass), heading(law)].join(", ");
            let heading = heading.trim_end_matches(", ");
            let (title, names) = (LOG10_K_STAR.heading(), [LOG10_K_STAR.name, column.name]);
            let (axes, titles) = ((x.clone(), y.clone()), [&title, column.unit.axis()]);
            charts.push(Chart::new(axes, titles, names, curves).under(heading, ""));
        }
    }
    let layout = Layout { columns: laws.len(), size: (360.0, 220.0) };
    let bounds = if rows.iter().any(|row| row.is_bound(column)) {
        " Open markers: the wall was still moving at the end, a lower bound."
    } else {
        ""
    };
    let caption = format!(
        "One row of panels per wall mass m* = m/(ρh²), one curve per wave; k* = k/(ρgh²), s the factor on \
         the force above the threshold.{bounds}"
    );
    Ok(drawn(charts, layout, caption))
}

/// A printed number at its case's stiffness.
fn star(found: &Found) -> Option<Point> {
    let place = (found.row.number(&LOG10_K_STAR)?, found.printed.value);
    Some(printed_point(place, found.row, found.printed))
}

/// A printed number in the colour of its wave.
fn marked(row: &Row, mark: &Point, waves: &[f64]) -> Curve {
    let wave = waves.iter().position(|wave| row.number(&WAVE_HEIGHT_RATIO) == Some(*wave));
    Curve { entry: printed_in_colour(wave.unwrap_or(0)), points: vec![mark.clone()] }
}

fn point(row: &Row, column: &Column) -> Option<Point> {
    case_point(row, row.number(&LOG10_K_STAR)?, column)
}

fn by_wave(rows: &[&Row], waves: &[f64], column: &Column) -> Vec<Curve> {
    let curve = |(index, &wave): (usize, &f64)| {
        let own = rows.iter().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(wave));
        let mut points: Vec<_> = own.filter_map(|row| point(row, column)).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let entry = Entry::marked(label(&WAVE_HEIGHT_RATIO, wave), Look::of(index));
        Curve { entry: entry.keyed(key(&WAVE_HEIGHT_RATIO, wave)), points }
    };
    waves.iter().enumerate().map(curve).collect()
}
