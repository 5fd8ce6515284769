//! Fig. 6 of Huang et al. 2019, as far as numbers show it: a dam break's front until the wall.

use super::laws::{looks, words};
use super::{Drawn, Material, drawn};
use crate::report::error::ReportError;
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Look, Point, places, points, printed_entry, printed_point,
};
use crate::report::row::Row;

/// Prefix of readings of the front's place. The time over √(H/g) follows it.
const FRONT: &str = "front_at_";
const RITTER: &str = "ritter_front_at_";

pub fn drawing(material: &Material) -> Result<Option<Drawn>, ReportError> {
    let (mut rows, mut fronts, mut ritter, mut wall) = (Vec::new(), Vec::new(), Vec::new(), None);
    for (data, row, config) in material.known() {
        let end = config.value("tank_length_m").zip(config.value("column_height_m"));
        let end = end.map(|(length, height)| length / height);
        let mut front: Vec<Point> = Vec::new();
        for reading in data.readings(row.id())? {
            let Some(value) = reading.value else { continue };
            let at = |prefix: &str| reading.name.strip_prefix(prefix)?.parse::<f64>().ok();
            front.extend(at(FRONT).map(|time| Point::from((time, value))));
            ritter.extend(at(RITTER).map(|time| Point::from((time, value))));
            if reading.name == "front_at_wall" {
                front.extend(end.map(|end| Point::from((value, end))));
            }
        }
        front.sort_by(|a, b| a.x.total_cmp(&b.x));
        wall = wall.or(end);
        rows.push(row);
        fronts.push(front);
    }
    let words = words(&rows);
    let looks = looks(&words);
    ritter.sort_by(|a, b| a.x.total_cmp(&b.x));
    ritter.dedup();
    let mut curves =
        vec![Curve { entry: Entry::line("Ritter's front", Look::ink()), points: ritter }];
    for ((points, word), look) in fronts.into_iter().zip(words).zip(looks) {
        curves.push(Curve { entry: Entry::marked(word, look), points });
    }
    let theirs = material.found.iter().find(|one| one.printed.quantity == "front_at_wall");
    let mark = theirs.zip(wall).map(|(found, wall)| {
        printed_point((found.printed.value, wall), &Row::default(), found.printed)
    });
    curves.push(Curve { entry: printed_entry(), points: mark.into_iter().collect() });
    let y = Axis::around(points(&curves).map(|point| point.y), 6.0);
    let Some(axes) = Axis::around(places(&curves), 6.0).zip(y) else { return Ok(None) };
    let chart = Chart::new(axes, ["t √(g/H)", "front / H"], ["time", "front"], curves);
    let layout = Layout { columns: 1, size: (520.0, 320.0) };
    let caption = "The front over the column's height H at the times that are told of it. Ritter's front \
                   is that of water without friction from a column without an end.";
    Ok(drawn(vec![chart], layout, caption))
}
