//! The surface along the tank at several times, from gauges: Figs. 1, 2 and 8 of Liang et al. 2017 and
//! Fig. 14 of Huang et al. 2019.

use super::laws::{heading, order, words};
use super::{Drawn, Material, drawn, panel};
use crate::keys::number;
use crate::papers::PAPER_CLOCK_CENTRE_S;
use crate::quantities::history::{DISPLACEMENT, RUNUP};
use crate::quantities::summary::{CASE_ID, FORCE_COUPLING, STROKE_CENTRE, WAVE_HEIGHT_RATIO};
use crate::report::config::{Gauge, configs, gauges};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::papers::at;
use crate::report::plots::{Axis, Curve, Entry, Layout, Look, Point};
use crate::report::row::Row;
use crate::report::series::Series;
use crate::theory::solitary_wave::SolitaryWave;

/// One case: its words, its tank, and what it recorded.
struct Case<'a> {
    words: String,
    row: &'a Row,
    /// Still depth, m, length, m, and gravity, m/s².
    tank: [f64; 3],
    gauges: Vec<Gauge>,
    levels: Vec<Series>,
    history: Vec<Series>,
}

pub fn drawing(
    material: &Material,
    times: &[f64],
    first_order: bool,
) -> Result<Option<Drawn>, ReportError> {
    let mut cases = Vec::new();
    for data in material.studies {
        cases.extend(read(data)?);
    }
    tell_apart(&mut cases);
    let labels: Vec<_> = cases.iter().map(|case| case.words.clone()).collect();
    let (order, mut panels) = (order(&labels), Vec::new());
    for &time in times {
        let mut curves = Vec::new();
        for case in &cases {
            let look = Look::of(order.iter().position(|word| **word == case.words).unwrap_or(0));
            curves.extend(case.surface(time, look));
        }
        if let Some(case) = cases.first().filter(|_| first_order) {
            curves.extend(case.first_order(time));
        }
        panels.push((time, curves));
    }
    let all = || panels.iter().flat_map(|(_, curves)| curves).flat_map(|curve| &curve.points);
    let axes = Axis::around(all().map(|p| p.x), 6.0).zip(Axis::around(all().map(|p| p.y), 4.0));
    let Some((x, y)) = axes else { return Ok(None) };
    let titles = ["x, m", "surface / h"].map(str::to_owned);
    let chart = |(time, curves): (f64, Vec<Curve>)| {
        let (axes, heading) = ((x.clone(), y.clone()), format!("t = {time:.2} s"));
        panel(heading, titles.clone(), ["x_m", "surface"], axes, curves)
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

/// The finished cases of a study that have gauges of levels.
fn read(data: &Loaded) -> Result<Vec<Case<'_>>, ReportError> {
    let mut cases = Vec::new();
    for (row, config) in data.rows.iter().zip(configs(data)).filter(|(row, _)| row.is_ok()) {
        let Some(config) = config else { continue };
        let value = |key: &str| config.scene.get(key).and_then(number);
        let keys = ["still_water_depth_m", "tank_length_m", "gravity_m_per_s2"].map(value);
        let [Some(depth), Some(length), Some(gravity)] = keys else { continue };
        let id = row.text(&CASE_ID);
        let levels = gauges(data).into_iter().filter(|gauge| gauge.kind == "level");
        cases.push(Case {
            words: String::new(),
            row,
            tank: [depth, length, gravity],
            gauges: levels.collect(),
            levels: data.gauges(id)?,
            history: data.history(id)?,
        });
    }
    cases.retain(|case| !case.gauges.is_empty());
    Ok(cases)
}

/// Words for the legend, with the factor s of walls that move.
fn tell_apart(cases: &mut [Case]) {
    let rows: Vec<_> = cases.iter().map(|case| case.row).collect();
    let words = words(&rows);
    for (case, word) in cases.iter_mut().zip(words) {
        let law = case.row.number(&FORCE_COUPLING).filter(|_| !case.row.is_fixed());
        let parts = [heading(law), word].into_iter().filter(|part| !part.is_empty());
        case.words = parts.collect::<Vec<_>>().join(", ");
        if case.words.is_empty() {
            case.words = "computed".to_owned();
        }
    }
}

impl Case<'_> {
    /// The surface between paddle and wall, and the wall itself down to the lowest water.
    fn surface(&self, time: f64, look: Look) -> Vec<Curve> {
        let Some(centre) = self.row.number(&STROKE_CENTRE) else { return Vec::new() };
        let own = time - PAPER_CLOCK_CENTRE_S + centre;
        let [depth, length, _] = self.tank;
        let of =
            |name: &str| at(&self.history.iter().find(|series| series.name == name)?.points, own);
        let wall = length + depth * of(DISPLACEMENT.name).unwrap_or(0.0);
        let level = |gauge: &Gauge| {
            let series = self.levels.iter().find(|series| series.name == gauge.name)?;
            let (x, level) = (gauge.x_m?, at(&series.points, own)?);
            (x < wall && level > 0.0).then_some(Point::from((x, level / depth - 1.0)))
        };
        let mut points: Vec<Point> = self.gauges.iter().filter_map(level).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let Some(top) = of(RUNUP.name).filter(|_| !points.is_empty()) else { return Vec::new() };
        points.push((wall, top).into());
        let low = points.iter().map(|point| point.y).fold(0.0, f64::min) - 0.1;
        let upright = vec![(wall, top).into(), (wall, low).into()];
        let key = format!("case={}", self.row.text(&CASE_ID));
        let water = Curve { entry: Entry::marked(self.words.clone(), look).keyed(key), points };
        vec![water, Curve { entry: Entry::line(String::new(), look), points: upright }]
    }

    fn first_order(&self, time: f64) -> Option<Curve> {
        let [depth, length, gravity] = self.tank;
        let ratio = self.row.number(&WAVE_HEIGHT_RATIO)?;
        let wave = SolitaryWave { ratio, depth, gravity };
        let point = |index: i32| {
            let x = 0.4 + (length - 0.4) * f64::from(index) / 100.0;
            Point::from((x, wave.surface(x, time - PAPER_CLOCK_CENTRE_S)))
        };
        let entry = Entry::line("first-order solitary wave".to_owned(), Look::plain());
        Some(Curve { entry, points: (0..=100).map(point).collect() })
    }
}
