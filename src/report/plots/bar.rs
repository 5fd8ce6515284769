//! The colour bar: which values the colours of a map stand for.

use colorous::VIRIDIS;
use svg::node::element::{Group, Rectangle};

use super::axes::Axis;
use super::pen::{Align, INK, drawn, group, hex, strokes, text, tidy};
use super::text::{NORMAL, SMALL, width};

/// Height of the coloured strip, CSS pixels.
const STRIP: f64 = 12.0;
/// Height of the whole bar, CSS pixels.
pub const HEIGHT: f64 = 38.0;
/// Width of the coloured strip, CSS pixels.
const WIDE: f64 = 190.0;
/// How many pieces of one colour the strip has.
const PIECES: usize = 38;

/// A colour scale: even to the eye, with rising lightness, and safe for the colour-blind.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    axis: Axis,
    title: String,
}

impl Bar {
    /// A bar for the given values; `None` without any.
    pub fn of(values: &[f64], title: &str) -> Option<Bar> {
        let axis = Axis::around(values.iter().copied(), 5.0)?;
        Some(Bar { axis, title: title.to_owned() })
    }

    /// The colour of a value.
    pub fn colour(&self, value: f64) -> [u8; 3] {
        let colour = VIRIDIS.eval_continuous(self.axis.share(value));
        [colour.r, colour.g, colour.b]
    }

    /// Its width with its title, CSS pixels.
    pub fn width(&self) -> f64 {
        width(&self.title, NORMAL) + WIDE + 24.0
    }

    /// Title, strip and numbers.
    pub fn draw(&self, left: f64) -> Group {
        let from = left + width(&self.title, NORMAL) + 10.0;
        let middle = 2.0 + STRIP / 2.0;
        let mut bar = drawn(group("axis bar ink").set("color", INK));
        bar = bar.add(text((left, middle), &self.title, NORMAL, Align::Left).set("class", "title"));
        let piece = WIDE / PIECES as f64;
        for index in 0..PIECES {
            let share = (index as f64 + 0.5) / PIECES as f64;
            let colour = VIRIDIS.eval_continuous(share);
            let field = Rectangle::new()
                .set("x", tidy(from + piece * index as f64))
                .set("y", 2.0)
                // Each piece overlaps the next a little, so that no background shows through.
                .set("width", tidy(piece + if index + 1 < PIECES { 0.5 } else { 0.0 }))
                .set("height", STRIP)
                .set("stroke", "none")
                .set("fill", hex([colour.r, colour.g, colour.b]));
            bar = bar.add(field);
        }
        let x = |value: f64| from + WIDE * self.axis.share(value);
        let foot = 2.0 + STRIP;
        let ends: Vec<_> =
            self.axis.ticks.iter().map(|t| [(x(t.at), foot), (x(t.at), foot + 4.0)]).collect();
        bar = bar.add(strokes("strokes", &ends, 1.0));
        for tick in &self.axis.ticks {
            let at = (x(tick.at), foot + 7.0 + SMALL / 2.0);
            bar = bar.add(text(at, &tick.label, SMALL, Align::Centre).set("class", "tick"));
        }
        bar
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_rises_along_the_scale() {
        let bar = Bar::of(&[1.0, 4.0], "F").unwrap();
        let shine = |value: f64| {
            let [r, g, b] = bar.colour(value).map(f64::from);
            0.2126 * libm::pow(r, 2.2) + 0.7152 * libm::pow(g, 2.2) + 0.0722 * libm::pow(b, 2.2)
        };
        let values: Vec<f64> = (0..=30).map(|step| 1.0 + 0.1 * f64::from(step)).collect();
        assert!(values.windows(2).all(|pair| shine(pair[0]) < shine(pair[1])));
    }
}
