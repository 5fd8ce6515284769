//! The legend: a row of samples and words above the panels, or above the curves of one.

use svg::node::element::{Group, SVG};

use super::look::Look;
use super::pen::{Align, INK, arrow, bare, line, text};
use super::text::{NORMAL, width};
use crate::report::markup::escape;

const ROW: f64 = 20.0;
const SAMPLE: f64 = 34.0;

/// One entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its words.
    pub label: String,
    /// What its points have in common, as `key=value`; may be empty.
    pub key: String,
    /// How it looks.
    pub look: Look,
    /// Shown only in a page, when a choice of cases asks for it.
    pub spare: bool,
    /// Whether it has a line.
    pub line: bool,
    /// Its marker, if any: whether it is that of a bound rather than filled.
    pub marker: Option<bool>,
}

impl Entry {
    /// A line with filled markers.
    pub fn marked(label: impl Into<String>, look: Look) -> Entry {
        let (label, key) = (label.into(), String::new());
        Entry { label, key, look, spare: false, line: true, marker: Some(false) }
    }

    /// A line without markers.
    pub fn line(label: impl Into<String>, look: Look) -> Entry {
        Entry { marker: None, ..Entry::marked(label, look) }
    }

    /// Markers without a line, filled or of bounds.
    pub fn dots(label: impl Into<String>, look: Look, bound: bool) -> Entry {
        Entry { line: false, marker: Some(bound), ..Entry::marked(label, look) }
    }

    /// Adds what its points have in common.
    pub fn keyed(self, key: impl Into<String>) -> Entry {
        Entry { key: key.into(), ..self }
    }

    /// A short sample of its look.
    fn sample(&self, left: f64, y: f64) -> Group {
        let mut sample = self.look.group("sample");
        if self.line {
            let drawn = line("line", &[(left, y), (left + SAMPLE, y)], 1.5);
            let dash = self.look.dash();
            sample = sample.add(if dash.is_empty() {
                drawn
            } else {
                drawn.set("stroke-dasharray", dash)
            });
        }
        let Some(bound) = self.marker else { return sample };
        let (x, y) = (left + SAMPLE / 2.0, if bound { y + 4.0 } else { y });
        if bound {
            sample = sample.add(arrow((x, y)));
        }
        sample.add(self.look.marker((x, y), bound || self.look.is_printed()))
    }
}

/// The rows of a legend as one group, and its height. Rows end before the right edge.
pub fn rows(entries: &[Entry], left: f64, right: f64) -> (Group, f64) {
    let mut legend = super::pen::group("legend ink").set("color", INK);
    let (mut x, mut row) = (left, 0);
    for entry in entries {
        let wide = SAMPLE + 6.0 + width(&entry.label, NORMAL);
        if x > left && x + wide > right {
            (x, row) = (left, row + 1);
        }
        let y = ROW * (f64::from(row) + 0.5);
        let words = text((x + SAMPLE + 6.0, y), &entry.label, NORMAL, Align::Left);
        legend = legend.add(entry.sample(x, y)).add(words);
        x += wide + 18.0;
    }
    let height = if entries.is_empty() { 0.0 } else { ROW * f64::from(row + 1) };
    (legend, height)
}

/// The legend as a list in a page, which wraps by itself.
pub fn list(entries: &[Entry]) -> String {
    let item = |entry: &Entry| {
        let sample = SVG::new()
            .set("width", SAMPLE)
            .set("height", ROW)
            .set("viewBox", (0.0, 0.0, SAMPLE, ROW))
            .set("aria-hidden", "true")
            .add(entry.sample(0.0, ROW / 2.0));
        let sample = bare(&sample);
        let words = escape(&entry.label);
        let key = escape(&entry.key);
        let spare = if entry.spare { " class=\"spare\" hidden" } else { "" };
        format!("<li data-series=\"{key}\"{spare}>{sample}{words}</li>")
    };
    format!("<ul class=\"legend\">{}</ul>", entries.iter().map(item).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_wrap_before_the_right_edge() {
        let entry = Entry::line("k = 10 N/m".to_owned(), Look::of(0));
        let heights = [400.0, 2000.0].map(|right| rows(&vec![entry.clone(); 9], 10.0, right).1);
        assert_eq!(heights, [3.0 * ROW, ROW]);
        assert_eq!(rows(&[], 10.0, 400.0).1, 0.0);
    }
}
