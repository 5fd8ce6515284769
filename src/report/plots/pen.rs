//! Drawing in CSS pixels on a `plotters` SVG sheet, with text left as text.
//!
//! The backend knows whole pixels only; the sheet is drawn [`FINE`] times too large and scaled
//! back by its `viewBox`, so that curves stay smooth.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::report::error::ReportError;

/// Backend pixels in a CSS pixel.
const FINE: f64 = 4.0;

/// The colour of text and axes; a page replaces it with its own.
pub const INK: RGBAColor = RGBAColor(0, 0, 0, 1.0);

/// Colours of curves, all of them legible on white and on near-black, and to the colour-blind
/// (after Okabe and Ito).
const COLOURS: [RGBAColor; 7] = [
    RGBAColor(0x00, 0x72, 0xB2, 1.0),
    RGBAColor(0xE6, 0x7F, 0x00, 1.0),
    RGBAColor(0x00, 0x9E, 0x73, 1.0),
    RGBAColor(0xD0, 0x4A, 0x8C, 1.0),
    RGBAColor(0x8E, 0x6B, 0xC9, 1.0),
    RGBAColor(0x3A, 0xA5, 0xD8, 1.0),
    RGBAColor(0x9A, 0x7B, 0x3F, 1.0),
];

/// Ink thinned to the given share.
pub fn faint(share: f64) -> RGBAColor {
    RGBAColor(0, 0, 0, share)
}

/// The look of one curve, the same wherever it appears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Colour of line and markers.
    pub colour: RGBAColor,
    corners: usize,
    turn: f64,
}

impl Look {
    /// The look of the `index`-th curve: colours repeat after seven, their markers after four.
    pub fn of(index: usize) -> Look {
        let (corners, turn) = [(0, 0.0), (4, 0.25), (3, 0.0), (4, 0.0)][index % 4];
        Look { colour: COLOURS[index % COLOURS.len()], corners, turn }
    }

    /// The same colour with the marker of printed numbers: a star, which no curve has.
    pub fn printed(self) -> Look {
        Look { corners: STAR, turn: 0.0, ..self }
    }

    /// A round marker in ink.
    pub fn plain() -> Look {
        Look { colour: INK, corners: 0, turn: 0.0 }
    }
}

/// Where a text stands relative to its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Align {
    /// To the right of the point.
    Left,
    /// Centred on the point.
    Centre,
    /// To the left of the point.
    Right,
    /// Centred on the point, reading upwards.
    Upwards,
}

type Sheet<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Whatever the drawing library complains of.
pub type Fault = Box<dyn std::error::Error>;

/// Draws on one sheet.
pub struct Pen<'a> {
    sheet: Sheet<'a>,
}

/// Makes an SVG of the given size in CSS pixels.
pub fn draw(
    name: &str,
    size: (f64, f64),
    paint: impl FnOnce(&Pen) -> Result<(), Fault>,
) -> Result<String, ReportError> {
    let mut svg = String::new();
    let fine = (fine(size.0) as u32, fine(size.1) as u32);
    let sheet = SVGBackend::with_string(&mut svg, fine).into_drawing_area();
    let pen = Pen { sheet };
    paint(&pen).and_then(|()| pen.sheet.present().map_err(Fault::from)).map_err(|fault| {
        ReportError::Draw { figure: name.to_owned(), reason: fault.to_string() }
    })?;
    drop(pen);
    let scaled = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(svg.replacen(&format!("width=\"{}\" height=\"{}\"", fine.0, fine.1), &scaled, 1))
}

fn fine(pixels: f64) -> i32 {
    (pixels * FINE).round() as i32
}

fn fine_point(point: (f64, f64)) -> (i32, i32) {
    (fine(point.0), fine(point.1))
}

impl Pen<'_> {
    /// A line through points.
    pub fn line(&self, points: &[(f64, f64)], colour: RGBAColor, width: f64) -> Result<(), Fault> {
        let points: Vec<_> = points.iter().map(|&point| fine_point(point)).collect();
        let style = colour.stroke_width(fine(width) as u32);
        Ok(self.sheet.draw(&PathElement::new(points, style))?)
    }

    /// One line of text, `size` pixels high, centred vertically on its point.
    pub fn text(&self, at: (f64, f64), text: &str, size: f64, align: Align) -> Result<(), Fault> {
        if text.is_empty() {
            return Ok(());
        }
        let side = match align {
            Align::Left => HPos::Left,
            Align::Centre | Align::Upwards => HPos::Center,
            Align::Right => HPos::Right,
        };
        // The backend writes font sizes divided by 1.24.
        let mut font = ("sans-serif", size * FINE * 1.24).into_font();
        if align == Align::Upwards {
            font = font.transform(FontTransform::Rotate270);
        }
        let style = TextStyle::from(font).color(&INK).pos(Pos::new(side, VPos::Center));
        Ok(self.sheet.draw(&Text::new(text, fine_point(at), style))?)
    }

    /// A marker; open ones show the ground inside.
    pub fn marker(&self, at: (f64, f64), look: Look, open: bool) -> Result<(), Fault> {
        let centre = fine_point(at);
        let outline = outline(at, look);
        let inside = if open { WHITE.to_rgba() } else { look.colour };
        let edge = look.colour.stroke_width(fine(1.4) as u32);
        if look.corners == 0 {
            self.sheet.draw(&Circle::new(centre, fine(RADIUS), inside.filled()))?;
            return Ok(self.sheet.draw(&Circle::new(centre, fine(RADIUS), edge))?);
        }
        self.sheet.draw(&Polygon::new(outline.clone(), inside.filled()))?;
        let closed = outline.iter().chain(&outline[..2]).copied().collect::<Vec<_>>();
        Ok(self.sheet.draw(&PathElement::new(closed, edge))?)
    }
}

/// Size of markers, CSS pixels.
const RADIUS: f64 = 3.2;

/// Corners of a star, every other one of which lies inside.
const STAR: usize = 10;

/// Corners of a marker; those of few corners reach further out, to look equally large.
fn outline(at: (f64, f64), look: Look) -> Vec<(i32, i32)> {
    let is_star = look.corners == STAR;
    let corner = |index: usize| {
        let stretch = if is_star { [1.75, 0.75][index % 2] } else { 1.3 };
        let reach = RADIUS * stretch;
        let turns = (index as f64 + 2.0 * look.turn) / look.corners as f64;
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * turns);
        fine_point((at.0 + reach * sine, at.1 - reach * cosine))
    };
    (0..look.corners).map(corner).collect()
}
