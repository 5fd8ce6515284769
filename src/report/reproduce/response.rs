//! Figs. 13 to 15 of Liang et al. 2017: a response against the spring's stiffness, one row of panels for
//! each mass, one column for each factor s, one curve per wave.

use super::laws::{heading, laws, stands};
use super::{Drawing, Material};
use crate::quantities::summary::{LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, Unit, named};
use crate::report::curves::distinct;
use crate::report::error::ReportError;
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Look, Point, printed_entry, printed_point, sheet,
};
use crate::report::row::{Row, label};

pub fn drawing(material: &Material, column: &str) -> Result<Option<Drawing>, ReportError> {
    let Some(column) = named(column) else { return Ok(None) };
    let rows: Vec<&Row> = material.cases().into_iter().map(|(_, row)| row).collect();
    let rows: Vec<&Row> = rows.into_iter().filter(|row| point(row, column).is_some()).collect();
    let marks = material.found.iter().filter(|one| one.printed.quantity == column.name);
    let marks: Vec<(&Row, Point)> = marks
        .filter_map(|one| {
            Some((one.row, printed_point((one.row.number(&LOG10_K_STAR)?, one.printed.value))))
        })
        .collect();
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
            charts.push(Chart {
                heading: [label(&M_STAR, mass), heading(law)]
                    .join(", ")
                    .trim_end_matches(", ")
                    .into(),
                titles: [LOG10_K_STAR.heading(), column.unit.axis().to_owned()],
                x: x.clone(),
                y: y.clone(),
                curves,
            });
        }
    }
    let svg = sheet(&material.name, &charts, Layout { columns: laws.len(), size: (300.0, 160.0) })?;
    let bounds = if rows.iter().any(|row| row.is_bound(column)) {
        " Open markers: the wall was still moving at the end, a lower bound."
    } else {
        ""
    };
    let caption = format!(
        "One row of panels per wall mass m* = m/(ρh²), one curve per wave; k* = k/(ρgh²), s the factor on \
         the force above the threshold.{bounds}"
    );
    Ok(Some(Drawing { svg, caption }))
}

/// A printed number in the colour of its wave.
fn marked(row: &Row, mark: &Point, waves: &[f64]) -> Curve {
    let wave = waves.iter().position(|wave| row.number(&WAVE_HEIGHT_RATIO) == Some(*wave));
    let entry = Entry::dots("", Look::of(wave.unwrap_or(0)).printed(), true);
    Curve { entry, points: vec![mark.clone()] }
}

fn point(row: &Row, column: &Column) -> Option<Point> {
    let (x, y) = (row.number(&LOG10_K_STAR)?, row.number(column)?);
    let error = row.error(column).unwrap_or(0.0);
    Some(Point { x, y, error, open: row.is_bound(column), ..Point::default() })
}

fn by_wave(rows: &[&Row], waves: &[f64], column: &Column) -> Vec<Curve> {
    let curve = |(index, &wave): (usize, &f64)| {
        let own = rows.iter().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(wave));
        let mut points: Vec<_> = own.filter_map(|row| point(row, column)).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        Curve { entry: Entry::marked(label(&WAVE_HEIGHT_RATIO, wave), Look::of(index)), points }
    };
    waves.iter().enumerate().map(curve).collect()
}
