//! One frame as a drawing without a script.

use std::fmt::Write;

use super::legend::{self, ACROSS, escaped};
use super::scale::{self, Colour};
use super::stage::{Stage, View, WallKind};
use super::take::Take;
use super::tops::Tops;

/// Space under the water, for the scale, in units.
const UNDER: f64 = 200.0;
/// Width of lines, in units.
const STROKE: f64 = 7.0;
/// Grey of solid parts, on black and on white.
const SOLID: &str = "#7c8790";

/// What a still shows.
pub(super) struct Still<'a> {
    pub stage: &'a Stage,
    pub take: &'a Take,
    pub colour: Colour,
    /// End of the scale of colours.
    pub end: f64,
}

/// From metres to units.
struct Sheet {
    view: View,
    scale: f64,
    bottom: f64,
}

impl Sheet {
    fn x(&self, x: f64) -> f64 {
        ((x - self.view.x0) * self.scale).round()
    }

    fn y(&self, y: f64) -> f64 {
        (self.bottom - (y - self.view.y0) * self.scale).round()
    }

    fn shape(&self, text: &mut String, corners: &[[f64; 2]]) {
        let points = self.points(corners);
        let _ = writeln!(text, "<polygon fill=\"{SOLID}\" points=\"{points}\"/>");
    }

    fn line(&self, text: &mut String, corners: &[[f64; 2]]) {
        let points = self.points(corners);
        let _ = writeln!(text, "<polyline class=\"stroke\" points=\"{points}\"/>");
    }

    fn points(&self, corners: &[[f64; 2]]) -> String {
        let words: Vec<_> =
            corners.iter().map(|&[x, y]| format!("{},{}", self.x(x), self.y(y))).collect();
        words.join(" ")
    }
}

impl Still<'_> {
    /// The drawing: the water at the wall, or all of it if there is no wall.
    pub fn svg(&self, title: &str, moment: &str) -> String {
        let whole = self.stage.whole;
        let view = self.stage.near.map_or(whole, |near| {
            let x0 = self.stage.length + self.take.walls[1] - near.x;
            View { x0, x1: x0 + near.width, ..whole }
        });
        let scale = ACROSS / (view.x1 - view.x0);
        let lines = legend::lines(title);
        let above = legend::above(lines.len());
        let bottom = above + (view.y1 - view.y0) * scale;
        let sheet = Sheet { view, scale, bottom };
        let height = (bottom + UNDER).round();
        let dashed = self.rest(&sheet).map_or("", |_| " (dashed: the wall at rest)");
        let moment = format!("{moment}{dashed}");
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"still\" width=\"{}\" height=\"{}\" \
             viewBox=\"0 0 {ACROSS} {height}\" role=\"img\" aria-label=\"{}: {}\">\n<style>\n\
             .still {{ color: #1c2329; background: #ffffff; }}\n\
             @media (prefers-color-scheme: dark) {{ .still {{ color: #e4e9ed; background: #14181c; }} }}\n\
             .still text {{ font: 62px system-ui, \"DejaVu Sans\", sans-serif; fill: currentColor; }}\n\
             .still .stroke {{ fill: none; stroke: currentColor; stroke-width: {STROKE}; stroke-linejoin: round; }}\n\
             </style>\n",
            ACROSS / 4.0,
            (height / 4.0).round(),
            escaped(title),
            escaped(&moment),
        );
        legend::words(&mut text, lines.iter().copied().chain([&*moment]));
        let tops = Tops::of(self.stage, self.take, &view);
        self.water(&mut text, &sheet, &tops);
        if self.stage.wall != WallKind::None {
            self.solids(&mut text, &sheet, &tops);
        }
        legend::scale(&mut text, self.colour, self.end, bottom + 70.0);
        legend::rule(&mut text, view.x1 - view.x0, bottom + 70.0);
        text + "</svg>\n"
    }

    /// Particles as vertical strokes, a path for each colour. Where water is pushed up, rows move
    /// apart. So under the surface a particle is drawn taller where particles crowd beside it.
    /// Strokes are cut along the surface.
    fn water(&self, text: &mut String, sheet: &Sheet, tops: &Tops) {
        let spacing = self.stage.spacing;
        let breadth = (1.4 * spacing * sheet.scale).max(4.0).round();
        let aside = 0.5 * breadth / sheet.scale;
        let _ = writeln!(text, "<g fill=\"none\" stroke-width=\"{breadth}\">");
        let mut paths = vec![(String::new(), [0.0; 2], String::new()); scale::LEVELS];
        for &[x, y, value] in &self.take.points {
            let (place, y) = (f64::from(x), f64::from(y));
            if place < sheet.view.x0 - spacing || place > sheet.view.x1 || y > sheet.view.y1 {
                continue;
            }
            let (path, from, cut) = &mut paths[scale::level(value, self.end).round() as usize];
            let top = tops.at(place).filter(|top| y <= *top);
            let half = top.map_or(0.6 * spacing, |_| 0.5 * tops.apart(place, y));
            let (x, foot, head) = (sheet.x(place), sheet.y(y - half), sheet.y(y + half));
            let sides = top.map(|top| {
                [-aside, aside].map(|aside| sheet.y(tops.at(place + aside).unwrap_or(top)))
            });
            match sides {
                Some([left, right]) if head < left.max(right) => {
                    let (x, rise) = (x - 0.5 * breadth, right - left);
                    let feet = [foot.max(left), foot.max(right)];
                    let _ = write!(cut, "M{x} {}V{left}l{breadth} {rise}V{}z", feet[0], feet[1]);
                }
                _ => {
                    let _ = write!(path, "m{} {}v{}", x - from[0], foot - from[1], head - foot);
                    *from = [x, head];
                }
            }
        }
        for (colour, (path, _, cut)) in scale::colours().iter().zip(&paths) {
            if !path.is_empty() {
                let _ = writeln!(text, "<path stroke=\"{colour}\" d=\"{path}\"/>");
            }
            if !cut.is_empty() {
                let _ = writeln!(text, "<path fill=\"{colour}\" stroke=\"none\" d=\"{cut}\"/>");
            }
        }
        text.push_str("</g>\n");
    }

    fn solids(&self, text: &mut String, sheet: &Sheet, tops: &Tops) {
        let (stage, view) = (self.stage, sheet.view);
        tops.lines().iter().for_each(|line| sheet.line(text, line));
        if let Some(rest) = self.rest(sheet) {
            let dashes = "class=\"stroke\" stroke-dasharray=\"40 30\"";
            let points = sheet.points(&[[rest, 0.0], [rest, self.stage.tall]]);
            let _ = writeln!(text, "<polyline {dashes} points=\"{points}\"/>");
        }
        let (bed, top, thick) = (0.0, stage.tall, 0.12 * stage.depth);
        let (left, right) = (self.take.walls[0], stage.length + self.take.walls[1]);
        let (x0, x1, y0) = (view.x0, view.x1, view.y0);
        let ground = stage.bed.as_ref().map_or(&[][..], |bed| bed.points());
        let within = ground.iter().copied().filter(|[x, _]| *x > x0 && *x < x1);
        let ends = [[x0, stage.bed_at(x0)], [x1, stage.bed_at(x1)], [x1, y0], [x0, y0]];
        let outline: Vec<_> =
            ends[..1].iter().copied().chain(within).chain(ends[1..].iter().copied()).collect();
        sheet.shape(text, &outline);
        if left > x0 {
            let back = (left - thick).max(x0);
            sheet.shape(text, &[[back, bed], [left, bed], [left, top], [back, top]]);
        }
        if let Some(lid) = stage.lid {
            sheet.shape(text, &[[x0, lid], [x1, lid], [x1, view.y1], [x0, view.y1]]);
        }
        if stage.wall == WallKind::Crest {
            return;
        }
        let lean = (stage.angle - 90.0).to_radians().tan() * top;
        let broad = if stage.wall == WallKind::Caisson { 0.8 * stage.depth } else { thick };
        let far = right + broad;
        sheet.shape(text, &[[right, bed], [right + lean, top], [far + lean, top], [far, bed]]);
        if stage.wall == WallKind::Spring {
            self.spring(text, sheet, right + thick);
        }
    }

    /// The wall's position at rest, if the wall has left it by more than a line's width.
    fn rest(&self, sheet: &Sheet) -> Option<f64> {
        let (rest, wall) = (self.stage.length, self.stage.length + self.take.walls[1]);
        let is_apart = sheet.x(wall) - sheet.x(rest) > STROKE;
        (self.stage.wall != WallKind::None && rest > sheet.view.x0 && is_apart).then_some(rest)
    }

    fn spring(&self, text: &mut String, sheet: &Sheet, from: f64) {
        let (stage, turns) = (self.stage, 13);
        let post = stage.post.min(sheet.view.x1 - 0.06 * stage.depth);
        let (y, swing) = (0.5 * stage.depth, 0.1 * stage.depth);
        let corner = |turn: i32| {
            let aside = match turn {
                0 | 12 => 0.0,
                turn if turn % 2 == 1 => -swing,
                _ => swing,
            };
            [from + (post - from) * (f64::from(turn) + 0.5) / f64::from(turns), y + aside]
        };
        let corners: Vec<_> = std::iter::once([from, y])
            .chain((0..turns).map(corner))
            .chain(std::iter::once([post, y]))
            .collect();
        sheet.line(text, &corners);
        let far = post + 0.06 * stage.depth;
        sheet.shape(text, &[[post, 0.0], [far, 0.0], [far, stage.depth], [post, stage.depth]]);
    }
}
