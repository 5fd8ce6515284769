//! The surface along the tank at several times, from gauges: Figs. 1, 2 and 8 of Liang et al. 2017 and
//! Fig. 14 of Huang et al. 2019.

use super::laws::{heading, looks, words};
use super::{Drawn, Material, drawn};
use crate::papers::PAPER_CLOCK_CENTRE_S;
use crate::quantities::history::{DISPLACEMENT, RUNUP};
use crate::quantities::summary::{FORCE_COUPLING, STROKE_CENTRE, WAVE_HEIGHT_RATIO};
use crate::report::config::{Config, Gauge, gauges};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::{Axis, Chart, Curve, Entry, Layout, Look, Point, places, points};
use crate::report::row::Row;
use crate::report::series::{History, at};
use crate::theory::solitary_wave::SolitaryWave;

/// One case: its tank, and the records of its gauges.
struct Case<'a> {
    row: &'a Row,
    /// Depth of the still water and length, m, and gravity, m/s².
    tank: [f64; 3],
    gauges: Vec<Gauge>,
    levels: History,
    history: History,
}

pub fn drawing(
    material: &Material,
    times: &[f64],
    first_order: bool,
) -> Result<Option<Drawn>, ReportError> {
    let mut cases = Vec::new();
    for (data, row, config) in material.known() {
        cases.extend(Case::read(data, row, config)?);
    }
    let words = tell_apart(&cases);
    let (looks, mut panels) = (looks(&words), Vec::new());
    for &time in times {
        let mut curves = Vec::new();
        for ((case, word), look) in cases.iter().zip(&words).zip(&looks) {
            curves.extend(case.surface(time, word, *look));
        }
        if let Some(case) = cases.first().filter(|_| first_order) {
            curves.extend(case.first_order(time));
        }
        panels.push((time, curves));
    }
    let x = Axis::around(panels.iter().flat_map(|(_, curves)| places(curves)), 6.0);
    let heights = panels.iter().flat_map(|(_, curves)| points(curves)).map(|point| point.y);
    let Some((x, y)) = x.zip(Axis::around(heights, 4.0)) else { return Ok(None) };
    let chart = |(time, curves): (f64, Vec<Curve>)| {
        let (axes, titles) = ((x.clone(), y.clone()), ["x, m", "surface / h"]);
        Chart::new(axes, titles, ["x_m", "surface"], curves).under(format!("t = {time:.2} s"), "")
    };
    let charts: Vec<_> = panels.into_iter().map(chart).collect();
    let layout = Layout { columns: 2, size: (370.0, 190.0) };
    let beside = if first_order { " Beside it the first-order solitary wave." } else { "" };
    let caption = format!(
        "The surface over still water, at times on the papers' clock. It is read at the gauges \
         and at the wall (markers), with straight lines between. The upright line is the wall.{beside}"
    );
    Ok(drawn(charts, layout, caption))
}

/// Words for the legend, with the factor s of movable walls.
fn tell_apart(cases: &[Case]) -> Vec<String> {
    let rows: Vec<_> = cases.iter().map(|case| case.row).collect();
    let told = |(word, row): (String, &&Row)| {
        let law = row.number(&FORCE_COUPLING).filter(|_| !row.is_fixed());
        match [heading(law), word].join(", ").trim_matches([',', ' ']) {
            "" => "computed".to_owned(),
            told => told.to_owned(),
        }
    };
    words(&rows).into_iter().zip(&rows).map(told).collect()
}

impl<'a> Case<'a> {
    /// Reads a case; `None` where it has no level gauges.
    fn read(data: &Loaded, row: &'a Row, config: &Config) -> Result<Option<Case<'a>>, ReportError> {
        let keys = ["still_water_depth_m", "tank_length_m", "gravity_m_per_s2"];
        let [Some(depth), Some(length), Some(gravity)] = keys.map(|key| config.value(key)) else {
            return Ok(None);
        };
        let (id, mut gauges) = (row.id(), gauges(data));
        gauges.retain(|gauge| gauge.kind == "level");
        if gauges.is_empty() {
            return Ok(None);
        }
        let (levels, history) = (data.gauges(id)?, data.history(id)?);
        Ok(Some(Case { row, tank: [depth, length, gravity], gauges, levels, history }))
    }

    /// The surface between paddle and wall, and the wall itself down to the lowest water.
    fn surface(&self, time: f64, words: &str, look: Look) -> Vec<Curve> {
        let Some(centre) = self.row.number(&STROKE_CENTRE) else { return Vec::new() };
        let own = time - PAPER_CLOCK_CENTRE_S + centre;
        let [depth, length, _] = self.tank;
        let of = |name: &str| at(self.history.points(name), own);
        let wall = length + depth * of(DISPLACEMENT.name).unwrap_or(0.0);
        let level = |gauge: &Gauge| {
            let (x, level) = (gauge.x_m?, at(self.levels.points(&gauge.name), own)?);
            (x < wall && level > 0.0).then_some(Point::from((x, level / depth - 1.0)))
        };
        let mut points: Vec<Point> = self.gauges.iter().filter_map(level).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let Some(top) = of(RUNUP.name).filter(|_| !points.is_empty()) else { return Vec::new() };
        points.push((wall, top).into());
        let low = points.iter().map(|point| point.y).fold(0.0, f64::min) - 0.1;
        let key = format!("case={}", self.row.id());
        let water = Curve { entry: Entry::marked(words, look).keyed(key), points };
        vec![water, Curve::through(Entry::line("", look), [(wall, top), (wall, low)])]
    }

    fn first_order(&self, time: f64) -> Option<Curve> {
        let [depth, length, gravity] = self.tank;
        let ratio = self.row.number(&WAVE_HEIGHT_RATIO)?;
        let wave = SolitaryWave { ratio, depth, gravity };
        let point = |index: i32| {
            let x = 0.4 + (length - 0.4) * f64::from(index) / 100.0;
            (x, wave.surface(x, time - PAPER_CLOCK_CENTRE_S))
        };
        let entry = Entry::line("first-order solitary wave", Look::ink());
        Some(Curve::through(entry, (0..=100).map(point)))
    }
}
