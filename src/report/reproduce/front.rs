//! Fig. 6 of Huang et al. 2019, as far as numbers tell it: the front of a dam break on its way to the wall.

use super::laws::{order, words};
use super::{Drawn, Material, drawn, panel};
use crate::keys::number;
use crate::quantities::summary::CASE_ID;
use crate::report::config::configs;
use crate::report::error::ReportError;
use crate::report::papers::Found;
use crate::report::plots::{Axis, Curve, Entry, Layout, Look, Point, printed_entry, printed_point};
use crate::report::row::Row;

/// Readings of the front's place: after this prefix stands the time over √(H/g).
const FRONT: &str = "front_at_";
const RITTER: &str = "ritter_front_at_";

pub fn drawing(material: &Material) -> Result<Option<Drawn>, ReportError> {
    let (mut rows, mut fronts, mut ritter, mut wall) = (Vec::new(), Vec::new(), Vec::new(), None);
    for data in material.studies {
        for (row, config) in data.rows.iter().zip(configs(data)).filter(|(row, _)| row.is_ok()) {
            let value = |key: &str| config.as_ref()?.scene.get(key).and_then(number);
            let end = value("tank_length_m").zip(value("column_height_m")).map(|(l, h)| l / h);
            let (mut front, readings) = (Vec::new(), data.readings(row.text(&CASE_ID))?);
            for reading in readings {
                let at = |prefix: &str| reading.name.strip_prefix(prefix)?.parse::<f64>().ok();
                let point = |time: Option<f64>| Some(Point::from((time?, reading.value?)));
                front.extend(point(at(FRONT)));
                ritter.extend(point(at(RITTER)));
                if reading.name == "front_at_wall" {
                    front.extend(reading.value.zip(end).map(Point::from));
                }
            }
            front.sort_by(|a, b| a.x.total_cmp(&b.x));
            (wall, rows, fronts) =
                (wall.or(end), [rows, vec![row]].concat(), [fronts, vec![front]].concat());
        }
    }
    let words = words(&rows);
    let order = order(&words);
    let curve = |(points, word): (Vec<Point>, &String)| {
        let look = Look::of(order.iter().position(|other| *other == word).unwrap_or(0));
        Curve { entry: Entry::marked(word.clone(), look), points }
    };
    let mut curves: Vec<_> = fronts.into_iter().zip(&words).map(curve).collect();
    ritter.sort_by(|a, b| a.x.total_cmp(&b.x));
    ritter.dedup();
    let entry = Entry::line("Ritter's front".to_owned(), Look::plain());
    curves.insert(0, Curve { entry, points: ritter });
    let theirs = material.found.iter().filter(|one| one.printed.quantity == "front_at_wall");
    let mark = |found: &Found| {
        Some(printed_point((found.printed.value, wall?), &Row::default(), found.printed))
    };
    let marks: Vec<_> = theirs.filter_map(mark).take(1).collect();
    curves.push(Curve { entry: printed_entry(), points: marks });
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let axes =
        Axis::around(points().map(|p| p.x), 6.0).zip(Axis::around(points().map(|p| p.y), 6.0));
    let Some((x, y)) = axes else { return Ok(None) };
    let titles = ["t √(g/H)", "front / H"].map(str::to_owned);
    let charts = vec![panel(String::new(), titles, ["time", "front"], (x, y), curves)];
    let layout = Layout { columns: 1, size: (520.0, 320.0) };
    let caption =
        "The front over the column's height H at the times that are told of it. Ritter's front \
                   is that of water without friction from a column without an end."
            .to_owned();
    Ok(drawn(charts, layout, caption))
}
