//! Small pieces of drawings. They stand in groups of [`drawn`] strokes in `currentColor`. The
//! nearest group sets it: its own colour in a file, the page's in a page.

use svg::node::element::{Group, Path, Polyline, SVG, Text, Title};

/// The colour of words and axes; a page replaces it with its own.
pub const INK: &str = "#1c2329";
/// The background of a figure that stands alone.
pub const GROUND: &str = "#ffffff";

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

/// A group with a class.
pub fn group(class: &str) -> Group {
    Group::new().set("class", class)
}

/// A group of strokes in its colour.
pub fn drawn(group: Group) -> Group {
    let group = group.set("fill", "none").set("stroke", "currentColor");
    group.set("stroke-width", 1.2).set("stroke-linejoin", "round")
}

/// One line of text, `size` pixels high, centred vertically on its point.
pub fn text((x, y): (f64, f64), words: &str, size: f64, align: Align) -> Text {
    let anchor = match align {
        Align::Left => "start",
        Align::Centre | Align::Upwards => "middle",
        Align::Right => "end",
    };
    // Capitals are about 0.72 of a font's size high.
    let (x, y, drop) = (tidy(x), tidy(y), tidy(0.36 * size));
    let text = Text::new(words)
        .set("font-size", size)
        .set("text-anchor", anchor)
        .set("fill", "currentColor")
        .set("stroke", "none");
    if align == Align::Upwards {
        return text.set("transform", format!("translate({x} {y}) rotate(-90)")).set("y", drop);
    }
    text.set("x", x).set("y", tidy(y + drop))
}

/// A line through points.
pub fn line(class: &str, points: &[(f64, f64)], width: f64) -> Polyline {
    let words: Vec<_> = points.iter().map(|(x, y)| format!("{},{}", tidy(*x), tidy(*y))).collect();
    Polyline::new().set("class", class).set("points", words.join(" ")).set("stroke-width", width)
}

/// Straight strokes, each from one point to another, in one path.
pub fn strokes(class: &str, ends: &[[(f64, f64); 2]], width: f64) -> Path {
    let stroke = |[a, b]: &[(f64, f64); 2]| {
        format!("M{} {}L{} {}", tidy(a.0), tidy(a.1), tidy(b.0), tidy(b.1))
    };
    let path = Path::new().set("class", class);
    path.set("d", ends.iter().map(stroke).collect::<String>()).set("stroke-width", width)
}

/// The words for a pointer that rests on a drawing.
pub fn tooltip(words: &str) -> Title {
    Title::new(words)
}

/// An arrow that points upwards from a marker.
pub fn arrow((x, y): (f64, f64)) -> Path {
    let path = format!("M{} {}v-9m-2.6 3.6l2.6-3.6l2.6 3.6", tidy(x), tidy(y - 3.0));
    Path::new().set("class", "arrow").set("d", path)
}

/// A colour as written in files.
pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// An SVG as it stands in a page: without a namespace, and without breaks between its elements.
pub fn bare(svg: &SVG) -> String {
    let text = svg.to_string().replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    text.replace(">\n", ">").replace("\n<", "<")
}

/// A length to a tenth of a pixel, about 0.03 mm on paper.
pub fn tidy(length: f64) -> f64 {
    let rounded = (length * 10.0).round() / 10.0;
    if rounded == 0.0 { 0.0 } else { rounded }
}
