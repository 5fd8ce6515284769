//! What gauges recorded, one panel for each, one curve per case: Figs. 3, 7 and 11 of Huang et al. 2019.

use super::laws::{looks, words};
use super::{Drawn, Material, clock, drawn, is_on_clock};
use crate::papers::PAPER_CLOCK_CENTRE_S;
use crate::quantities::summary::STROKE_CENTRE;
use crate::report::config::{Config, gauges};
use crate::report::error::ReportError;
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Look, Point, lasting, places, thinned,
};
use crate::report::row::Row;
use crate::report::series::History;

/// Measured pressures at the wall behind a dam break: t√(g/H) and p/(ρgH).
const MEASURED: &str = include_str!("../../../data/buchner_2002_dam_break.csv");

/// Points of each curve in a panel, at most.
const MOST: usize = 600;

/// One case and what it recorded.
struct Case<'a> {
    row: &'a Row,
    config: &'a Config,
    gauges: History,
}

pub fn drawing(
    material: &Material,
    names: &[String],
    column: bool,
    measured: bool,
) -> Result<Option<Drawn>, ReportError> {
    let mut cases = Vec::new();
    for (data, row, config) in material.known() {
        cases.push(Case { row, config, gauges: data.gauges(row.id())? });
    }
    let heights: Vec<_> = material.studies.iter().flat_map(|study| gauges(study.data)).collect();
    let rows: Vec<_> = cases.iter().map(|case| case.row).collect();
    let words = words(&rows);
    let looks = looks(&words);
    let still = |name: &str| {
        let height = heights.iter().find(|gauge| gauge.name == name)?.y_m?;
        let case = cases.first().filter(|case| case.row.number(&STROKE_CENTRE).is_none())?;
        Some(1.0 - height / case.height(column)?)
    };
    let mut charts = Vec::new();
    for name in names {
        let (mut curves, mut reach) = (Vec::new(), Vec::new());
        for ((case, word), look) in cases.iter().zip(&words).zip(&looks) {
            let points = case.points(name, column);
            reach.extend(if measured { bulk(&points) } else { lasting(&points) });
            let key = format!("case={}", case.row.id());
            curves.push(curve(Entry::line(word, *look).keyed(key), &points));
        }
        let Some(x) = Axis::within(places(&curves), 7.0) else { continue };
        if measured {
            let measured = measurements();
            reach.extend(measured.points.iter().map(|point| point.y));
            curves.push(measured);
        } else if let Some(level) = still(name) {
            curves.push(Curve::level("ρg times the depth", level, &curves));
            reach.push(level);
        }
        let Some(y) = Axis::around(reach.into_iter(), 4.0) else { continue };
        let titles = match column {
            true => ["t √(g/H)", "p / (ρgH)"],
            false => [clock(is_on_clock(&rows)), "p / (ρgh)"],
        };
        charts.push(Chart::new((x, y), titles, ["time", name], curves).under(name, ""));
    }
    let columns = if charts.len() > 2 { 2 } else { 1 };
    let size = if columns == 2 { (390.0, 210.0) } else { (640.0, 250.0) };
    let layout = Layout { columns, size };
    let beside = if measured {
        " Measured: Buchner 2002, digitised, at 0.2 H by some sources and 0.267 H by others. \
         The highest and the lowest hundredth of a curve may leave the panel."
    } else {
        ""
    };
    let height = |name: &String| {
        let height = heights.iter().find(|gauge| gauge.name == *name).and_then(|gauge| gauge.y_m);
        height.map_or(name.clone(), |metres| format!("{name} ({metres} m over the bed)"))
    };
    let told: Vec<_> = names.iter().map(height).collect();
    let caption = format!("Pressure at the gauges {}.{beside}", told.join(", "));
    Ok(drawn(charts, layout, caption))
}

impl Case<'_> {
    /// Height of the column, or depth of the still water, m.
    fn height(&self, column: bool) -> Option<f64> {
        self.config.value(if column { "column_height_m" } else { "still_water_depth_m" })
    }

    /// A gauge over time: scaled by the column, or on the papers' clock with pressures over ρgh.
    fn points(&self, name: &str, column: bool) -> Vec<(f64, f64)> {
        let scales =
            ["water_density_kg_per_m3", "gravity_m_per_s2"].map(|key| self.config.value(key));
        let ([Some(density), Some(gravity)], Some(height)) = (scales, self.height(column)) else {
            return Vec::new();
        };
        let centre = self.row.number(&STROKE_CENTRE).map_or(0.0, |c| c - PAPER_CLOCK_CENTRE_S);
        let unit = if column { (height / gravity).sqrt() } else { 1.0 };
        let scaled = |&(t, p): &(f64, f64)| ((t - centre) / unit, p / (density * gravity * height));
        self.gauges.points(name).iter().map(scaled).collect()
    }
}

fn curve(entry: Entry, points: &[(f64, f64)]) -> Curve {
    Curve::through(entry, thinned(points, MOST))
}

/// The values without the highest and lowest hundredth: an impact would squash the rest.
fn bulk(points: &[(f64, f64)]) -> Vec<f64> {
    let mut values: Vec<f64> = points.iter().map(|point| point.1).collect();
    values.sort_by(f64::total_cmp);
    let aside = values.len() / 100;
    values[aside..values.len() - aside].to_vec()
}

fn measurements() -> Curve {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(MEASURED.as_bytes());
    let points = reader.deserialize().map(|row| {
        let (x, y) = row.expect("a shipped file has numbers");
        Point { x, y, open: true, ..Point::default() }
    });
    Curve { entry: Entry::dots("measured", Look::ink(), false), points: points.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_impact_leaves_the_panel() {
        let mut points: Vec<_> = (0..200).map(|k| (f64::from(k), 1.0)).collect();
        (points[50].1, points[60].1) = (9.0, -9.0);
        assert_eq!(bulk(&points), [1.0; 196]);
        assert_eq!(bulk(&points[..1]), [1.0]);
    }

    /// The story: of a long record each second point was drawn, and a peak between two was not.
    #[test]
    fn a_short_peak_is_drawn() {
        let mut points: Vec<_> = (0..1200).map(|k| (f64::from(k), 0.0)).collect();
        points[501].1 = 9.0;
        let drawn = curve(Entry::line("a", Look::ink()), &points);
        assert!(drawn.points.len() <= MOST && drawn.points.iter().any(|point| point.y == 9.0));
    }

    #[test]
    fn the_measurements_are_read() {
        let curve = measurements();
        assert!(curve.points.len() > 20);
        assert!(curve.points.iter().all(|point| point.x > 0.0 && point.y < 2.0));
    }
}
