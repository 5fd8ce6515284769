//! The shapes of markers.

/// Each shape as a path that starts at its point.
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

/// A star, which no series has.
const STAR: &str =
    "m0.0 -5.4l1.4 3.5l3.7 0.2l-2.9 2.4l1 3.7l-3.2 -2.1l-3.2 2.1l1 -3.7l-2.9 -2.4l3.7 -0.2z";

/// How many shapes there are.
pub const COUNT: usize = SHAPES.len();

/// The outline of a shape around a point, as the `d` of a path.
pub fn outline(shape: usize, (x, y): (f64, f64)) -> String {
    format!("M{} {}{}", tidy(x), tidy(y), SHAPES[shape % COUNT])
}

/// The outline of a star around a point.
pub fn star((x, y): (f64, f64)) -> String {
    format!("M{} {}{STAR}", tidy(x), tidy(y))
}

/// A length to the tenth of a pixel: on paper some 0.03 mm.
pub fn tidy(length: f64) -> f64 {
    let rounded = (length * 10.0).round() / 10.0;
    if rounded == 0.0 { 0.0 } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_shapes_are_alike() {
        let outlines: Vec<_> = (0..COUNT).map(|shape| outline(shape, (0.0, 0.0))).collect();
        for (index, path) in outlines.iter().enumerate() {
            assert!(!outlines[..index].contains(path));
            assert!(path.starts_with('M') && path.ends_with('z'));
        }
    }
}
