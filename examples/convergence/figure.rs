//! The errors over the spacing, one panel for each reading.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::Case;
use crate::common::{COMPARED, CREST, Compared, DISPLACEMENT, FORCE, RUNUP};

/// Colours of the waves (after Okabe and Ito).
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(230, 127, 0), RGBColor(0, 158, 115), RGBColor(208, 74, 140)];

/// Fixed walls: full discs on thick lines. Movable ones: open rings on thin lines.
pub fn draw(curves: &[&[Case]], path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let curves: Vec<_> = curves.iter().copied().filter(|curve| curve[0].sound.is_none()).collect();
    let mut waves: Vec<_> = curves.iter().map(|curve| curve[0].wave()).collect();
    waves.sort_by(f64::total_cmp);
    waves.dedup();
    let look = |curve: &[Case]| {
        let wave = waves.iter().position(|&wave| wave == curve[0].wave()).unwrap_or(0);
        let (movable, colour) = (curve[0].keys[1].is_some(), COLOURS[wave % COLOURS.len()]);
        let inside = if movable { WHITE.filled() } else { colour.filled() };
        (colour.stroke_width(if movable { 1 } else { 3 }), inside, colour.stroke_width(2))
    };
    let sheet = SVGBackend::new(path, (1100, 900)).into_drawing_area();
    sheet.fill(&WHITE)?;
    let (panels, legend) = sheet.split_vertically(810);
    for (place, area) in
        [FORCE, RUNUP, DISPLACEMENT, CREST].into_iter().zip(panels.split_evenly((2, 2)))
    {
        let Compared { name, unit, .. } = COMPARED[place];
        let (low, high) = if place == RUNUP { (0.0005, 0.5) } else { (0.01, 10.0) };
        let mut chart = ChartBuilder::on(&area)
            .caption(format!("|error| of {name}, {unit}"), ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(45)
            .y_label_area_size(60)
            .build_cartesian_2d(1.9..4.1, (low..high).log_scale())?;
        chart
            .configure_mesh()
            .x_labels(5)
            .x_label_formatter(&|log: &f64| format!("{:.1}", log.exp2()).replace(".0", ""))
            .y_label_formatter(&|error: &f64| error.to_string())
            .x_desc("particle spacing, mm")
            .label_style(("sans-serif", 16))
            .light_line_style(BLACK.mix(0.06))
            .draw()?;
        for curve in &curves {
            let (line, inside, edge) = look(curve);
            let point = |case: &Case| {
                Some(((1e3 * case.spacing).log2(), case.errors[place]?.abs().clamp(low, high)))
            };
            let points: Vec<_> = curve.iter().filter_map(point).collect();
            chart.draw_series(LineSeries::new(points.clone(), line))?;
            chart.draw_series(points.iter().map(|&at| Circle::new(at, 4, inside)))?;
            chart.draw_series(points.iter().map(|&at| Circle::new(at, 4, edge)))?;
        }
    }
    for (index, curve) in curves.iter().enumerate() {
        let (x, y) = (40 + 265 * (index as i32 % 4), 18 + 34 * (index as i32 / 4));
        let (line, inside, edge) = look(curve);
        legend.draw(&PathElement::new(vec![(x, y), (x + 36, y)], line))?;
        legend.draw(&Circle::new((x + 18, y), 4, inside))?;
        legend.draw(&Circle::new((x + 18, y), 4, edge))?;
        let style = TextStyle::from(("sans-serif", 17)).pos(Pos::new(HPos::Left, VPos::Center));
        legend.draw(&Text::new(curve[0].wall(), (x + 44, y), style))?;
    }
    Ok(sheet.present()?)
}
