//! Figs. 4, 9 and 12 of Huang et al. 2019: the time of a step against the number of particles for
//! each interpolator at walls. The ratio to the time with improved Shepard is drawn, too.

use super::{Drawn, Material, drawn};
use crate::math::lists::different;
use crate::quantities::summary::{BOUNDARY, PARTICLES};
use crate::report::error::ReportError;
use crate::report::papers::{REFERENCE, step_time};
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Look, Point, places, points, printed_entry, printed_point,
};
use crate::report::row::Row;

pub fn drawing(material: &Material) -> Result<Option<Drawn>, ReportError> {
    let rows: Vec<&Row> = material.cases().into_iter().map(|(_, row)| row).collect();
    let mut names: Vec<&str> = rows.iter().map(|row| row.text(&BOUNDARY)).collect();
    names.sort_unstable();
    names.dedup();
    let reference = |particles: f64| {
        let same = |row: &&&Row| {
            row.text(&BOUNDARY) == REFERENCE && row.number(&PARTICLES) == Some(particles)
        };
        rows.iter().find(same).and_then(|row| step_time(row))
    };
    let milliseconds = |_: f64, seconds: f64| Some(1000.0 * seconds);
    let over = |particles: f64, seconds: f64| Some(seconds / reference(particles)?);
    let mut ratios = curves(&rows, &names, over);
    let most = rows.iter().filter_map(|row| row.number(&PARTICLES)).fold(0.0, f64::max);
    ratios.push(Curve { entry: printed_entry(), points: marks(material, most) });
    let all = [curves(&rows, &names, milliseconds), ratios];
    let titles = ["time per step, ms", "over improved Shepard"];
    let chart = |(curves, title): (Vec<Curve>, &str)| {
        let x = Axis::around(places(&curves), 5.0)?;
        let y = Axis::around(points(&curves).map(|point| point.y).chain([0.0]), 6.0)?;
        Some(Chart::new((x, y), ["particles", title], [PARTICLES.name, "step_time"], curves))
    };
    let charts: Vec<_> = all.into_iter().zip(titles).filter_map(chart).collect();
    let layout = Layout { columns: 2, size: (370.0, 290.0) };
    let caption = "Wall times of whole runs over their steps, as they came out on this machine; cases that \
                   run at the same time slow each other (--threads 1 runs one at a time).";
    Ok(drawn(charts, layout, caption))
}

fn curves(rows: &[&Row], names: &[&str], y: impl Fn(f64, f64) -> Option<f64>) -> Vec<Curve> {
    let curve = |(index, name): (usize, &&str)| {
        let own = rows.iter().filter(|row| row.text(&BOUNDARY) == *name);
        let point = |row: &&Row| {
            let particles = row.number(&PARTICLES)?;
            let case = row.id().to_owned();
            Some(Point { case, ..(particles, y(particles, step_time(row)?)?).into() })
        };
        let mut points: Vec<_> = own.filter_map(point).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let entry = Entry::marked(*name, Look::of(index));
        Curve { entry: entry.keyed(format!("{}={name}", BOUNDARY.name)), points }
    };
    names.iter().enumerate().map(curve).collect()
}

/// Printed ratios at the right end; each stands once with its interpolator's name.
fn marks(material: &Material, particles: f64) -> Vec<Point> {
    different(material.found.iter().filter_map(|found| {
        let note = found.printed.timed_boundary()?.to_owned();
        let place = (particles, found.printed.value);
        Some(Point { note, ..printed_point(place, &Row::default(), found.printed) })
    }))
}
