//! Words, colours and the bar of length of a still.

use std::fmt::Write;

use super::scale::{self, Colour};
use crate::math::decimal::significant;

/// Width of the drawing in units. A unit is a quarter of a pixel.
pub(super) const ACROSS: f64 = 3840.0;
/// Most characters in a line: more would leave the picture.
const WIDEST: usize = 100;
/// Distance of lines, and of the first from the top, in units.
const LINE: f64 = 105.0;
const FIRST: f64 = 95.0;

/// For an attribute or a text.
pub(super) fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;")
}

/// A title in lines that fit.
pub(super) fn lines(title: &str) -> Vec<&str> {
    let mut lines = Vec::new();
    let mut rest = title;
    while let Some((most, _)) = rest.char_indices().nth(WIDEST) {
        let Some((line, more)) = rest[..most].rfind(' ').map(|at| rest.split_at(at)) else { break };
        lines.push(line);
        rest = &more[1..];
    }
    lines.push(rest);
    lines
}

/// Space above the water, in units, for a title of so many lines and the line under it.
pub(super) fn above(lines: usize) -> f64 {
    FIRST + LINE * lines as f64 + 60.0
}

/// Lines at the top.
pub(super) fn words<'a>(text: &mut String, lines: impl Iterator<Item = &'a str>) {
    for (line, place) in lines.zip(0_u8..) {
        let y = FIRST + LINE * f64::from(place);
        let _ = writeln!(text, "<text x=\"60\" y=\"{y}\">{}</text>", escaped(line));
    }
}

/// The colours and their meaning, up to a value.
pub(super) fn scale(text: &mut String, colour: Colour, end: f64, top: f64) {
    let (name, unit, units) = colour.legend();
    let (from, wide) = (620.0, 16.0);
    let baseline = top + 58.0;
    let _ = writeln!(
        text,
        "<text x=\"{}\" y=\"{baseline}\" text-anchor=\"end\">{name}: 0</text>",
        from - 30.0
    );
    for (level, colour) in scale::colours().iter().enumerate() {
        let x = from + wide * level as f64;
        let _ = writeln!(
            text,
            "<rect x=\"{x}\" y=\"{top}\" width=\"{}\" height=\"70\" fill=\"{colour}\"/>",
            wide + 8.0
        );
    }
    let (x, end) = (from + wide * scale::LEVELS as f64 + 30.0, significant(end / units, 3));
    let _ = writeln!(text, "<text x=\"{x}\" y=\"{baseline}\">≥ {end} {unit}</text>");
}

/// A bar of a round length, at most a fifth of a picture of this width, m.
pub(super) fn rule(text: &mut String, width: f64, top: f64) {
    let most = 0.2 * width;
    let power = 10_f64.powf(libm::log10(most).floor());
    let length = [5.0, 2.0].map(|times| times * power).into_iter().find(|length| *length <= most);
    let length = significant(length.unwrap_or(power), 1);
    let (end, foot) = (ACROSS - 60.0, top + 58.0);
    let start = (end - length * ACROSS / width).round();
    let _ = writeln!(
        text,
        "<path class=\"stroke\" d=\"M{start} {head}V{foot}H{end}V{head}\"/>\n\
         <text x=\"{}\" y=\"{foot}\" text-anchor=\"end\">{length} m</text>",
        start - 30.0,
        head = foot - 20.0
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: the title of a wave over a bed with a crest ended in "over a bed from x = 9 m o".
    #[test]
    fn a_long_title_has_lines_that_fit() {
        let title = "Waves of H/h = 0.15 and T = 1.2 s at a fixed wall with its crest 0.05 m over still water \
                     and 0.3 m wide over a bed from x = 1.6 m on, up to 0.05 m high";
        let told = lines(title);
        assert!(
            told.len() == 2 && told.iter().all(|line| line.chars().count() <= WIDEST),
            "{told:?}"
        );
        assert_eq!(told.join(" "), title);
        assert_eq!(lines("short"), ["short"]);
    }

    #[test]
    fn a_bar_has_a_round_length_of_a_tenth_to_a_fifth_of_the_picture() {
        for (width, length) in [(1.0, "0.2 m"), (0.6, "0.1 m"), (23.0, "2 m"), (30.0, "5 m")] {
            let mut text = String::new();
            rule(&mut text, width, 0.0);
            assert!(text.contains(&format!(">{length}<")), "{width}: {text}");
        }
    }
}
