//! The look of a series: its hue, the shape of its markers and the dashes of its line.
//!
//! The hues also differ in lightness. They can be told apart in grey and by the colour-blind; tests
//! check this.

use svg::node::element::{Group, Path};

use super::pen::{GROUND, INK, drawn, group, tidy};

/// Hues on white. A page has a second set for a dark background, in `plots.css`.
const HUES: [&str; 6] = ["#5360ff", "#943909", "#00492a", "#c60d58", "#079bb3", "#5e0156"];

/// Dashes of lines; the first is solid.
const DASHES: [&str; 6] = ["", "8 3", "4 2", "9 2.5 2 2.5", "15 3", "6 2 1.5 2 1.5 2"];

/// Shapes of markers, each as a path that starts at its point.
const SHAPES: [&str; 8] = [
    "m-3.3 0a3.3 3.3 0 1 0 6.6 0a3.3 3.3 0 1 0-6.6 0z",
    "m-3-3h6v6h-6z",
    "m0-4.3l4 7.1h-8z",
    "m0-4.5l4.5 4.5l-4.5 4.5l-4.5-4.5z",
    "m0 4.3l4-7.1h-8z",
    "m-1.5-4.5h3v3h3v3h-3v3h-3v-3h-3v-3h3z",
    "m-4.3-2h8.6v4h-8.6z",
    "m-2-4.3h4v8.6h-4z",
];

/// A star, for printed numbers only.
const STAR: &str =
    "m0.0 -5.4l1.4 3.5l3.7 0.2l-2.9 2.4l1 3.7l-3.2 -2.1l-3.2 2.1l1 -3.7l-2.9 -2.4l3.7 -0.2z";

/// Dots for a line through a lower bound. No series has them.
pub const DOTS: &str = "0.8 3.4";

/// The look of one series, the same wherever it appears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    series: Option<usize>,
    printed: bool,
}

impl Look {
    /// The look of the `index`-th series. The first 24 differ in hue, shape or dash. The first six
    /// differ in all three.
    pub fn of(index: usize) -> Look {
        Look { series: Some(index), printed: false }
    }

    /// A round marker and a solid line in ink, for references.
    pub fn ink() -> Look {
        Look { series: None, printed: false }
    }

    /// The same colour with a star, the marker of numbers that a paper prints.
    pub fn printed(self) -> Look {
        Look { printed: true, ..self }
    }

    /// Whether it is the look of printed numbers, whose markers are always open.
    pub fn is_printed(self) -> bool {
        self.printed
    }

    /// A group in this colour; its content is drawn in `currentColor`.
    pub fn group(self, class: &str) -> Group {
        let (hue, name) = match self.series {
            Some(index) => (HUES[index % HUES.len()], format!("hue-{}", index % HUES.len())),
            None => (INK, "ink".to_owned()),
        };
        drawn(group(&format!("{class} {name}")).set("color", hue))
    }

    /// The dashes of its line; empty for a solid one.
    pub fn dash(self) -> &'static str {
        self.series.map_or("", |index| DASHES[index % DASHES.len()])
    }

    /// A marker; open ones show the background inside.
    pub fn marker(self, (x, y): (f64, f64), open: bool) -> Path {
        let shape = SHAPES[self.series.unwrap_or(0) % SHAPES.len()];
        let shape = if self.printed { STAR } else { shape };
        let path = Path::new().set("d", format!("M{} {}{shape}", tidy(x), tidy(y)));
        if open {
            return path.set("class", "mark open").set("fill", GROUND);
        }
        path.set("class", "mark").set("fill", "currentColor")
    }
}

#[cfg(test)]
mod tests {
    use super::super::eyes::{EYES, apart, contrast, grey, parse};
    use super::*;

    /// The second set of hues, as the page's style has them.
    fn dark() -> Vec<String> {
        let style = super::super::STYLE.split("prefers-color-scheme: dark").nth(1).unwrap();
        let hue = |index: usize| {
            let after = style.split(&format!("--hue-{index}: ")).nth(1).unwrap();
            after.split(';').next().unwrap().to_owned()
        };
        (0..HUES.len()).map(hue).collect()
    }

    fn sets() -> [(Vec<String>, &'static str); 2] {
        [(HUES.map(str::to_owned).to_vec(), GROUND), (dark(), "#14181c")]
    }

    #[test]
    fn hues_differ_to_every_eye_and_in_grey() {
        for (hues, _) in sets() {
            let hues: Vec<_> = hues.iter().map(|hue| parse(hue)).collect();
            for (index, a) in hues.iter().enumerate() {
                for b in &hues[..index] {
                    for (eye, matrix) in EYES {
                        let apart = apart(*a, *b, matrix);
                        assert!(apart > 20.0, "{eye}: {a:?} and {b:?} are {apart:.1} apart");
                    }
                    assert!((grey(*a) - grey(*b)).abs() > 5.0, "grey: {a:?} and {b:?}");
                }
            }
        }
    }

    #[test]
    fn hues_stand_out_from_the_ground() {
        for (hues, ground) in sets() {
            for hue in hues {
                let ratio = contrast(parse(&hue), parse(ground));
                assert!(ratio >= 3.0, "{hue} on {ground}: {ratio:.2}");
            }
        }
    }

    #[test]
    fn a_page_in_light_has_the_hues_of_a_file() {
        for (index, hue) in HUES.iter().enumerate() {
            assert!(super::super::STYLE.contains(&format!("--hue-{index}: {hue};")), "{hue}");
        }
    }

    #[test]
    fn no_two_shapes_are_alike() {
        let shapes = [&SHAPES[..], &[STAR]].concat();
        for (index, path) in shapes.iter().enumerate() {
            assert!(!shapes[..index].contains(path));
            assert!(path.starts_with('m') && path.ends_with('z'));
        }
    }

    #[test]
    fn no_two_of_24_series_look_alike_and_no_two_of_six_share_a_trait() {
        let traits = |index: usize| {
            let look = Look::of(index);
            let shape = look.marker((0.0, 0.0), false).to_string();
            (look.group("a").to_string(), look.dash(), shape)
        };
        for a in 0..24 {
            for b in 0..a {
                let (a_has, b_has) = (traits(a), traits(b));
                assert_ne!(a_has, b_has, "{a} {b}");
                let shared = a_has.0 == b_has.0 || a_has.1 == b_has.1 || a_has.2 == b_has.2;
                assert!(a >= 6 || !shared, "{a} {b}");
            }
        }
        assert!(!DASHES.contains(&DOTS));
    }
}
