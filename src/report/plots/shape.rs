//! The shapes of markers.

use std::fmt::Write;

/// Size of a marker: half of its width, CSS pixels.
const REACH: f64 = 3.3;

/// Corners of each shape around the point, in units of [`REACH`]; none for a circle.
const SHAPES: [&[[f64; 2]]; 8] = [
    &[],
    &[[-0.92, -0.92], [0.92, -0.92], [0.92, 0.92], [-0.92, 0.92]],
    &[[0.0, -1.3], [1.2, 0.85], [-1.2, 0.85]],
    &[[0.0, -1.35], [1.35, 0.0], [0.0, 1.35], [-1.35, 0.0]],
    &[[0.0, 1.3], [1.2, -0.85], [-1.2, -0.85]],
    PLUS,
    &[[-1.3, -0.62], [1.3, -0.62], [1.3, 0.62], [-1.3, 0.62]],
    &[[-0.62, -1.3], [0.62, -1.3], [0.62, 1.3], [-0.62, 1.3]],
];

const PLUS: &[[f64; 2]] = &[
    [-0.45, -1.35],
    [0.45, -1.35],
    [0.45, -0.45],
    [1.35, -0.45],
    [1.35, 0.45],
    [0.45, 0.45],
    [0.45, 1.35],
    [-0.45, 1.35],
    [-0.45, 0.45],
    [-1.35, 0.45],
    [-1.35, -0.45],
    [-0.45, -0.45],
];

/// How many shapes there are.
pub const COUNT: usize = SHAPES.len();

/// The outline of a shape around a point, as the `d` of a path.
pub fn outline(shape: usize, (x, y): (f64, f64)) -> String {
    let corners = SHAPES[shape % COUNT];
    if corners.is_empty() {
        let (r, across) = (REACH, 2.0 * REACH);
        let half = |side: f64| format!("a{r} {r} 0 1 0 {} 0", side * across);
        return format!("M{} {}{}{}Z", tidy(x - r), tidy(y), half(1.0), half(-1.0));
    }
    let mut path = String::new();
    for (index, corner) in corners.iter().enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        let (x, y) = (tidy(x + REACH * corner[0]), tidy(y + REACH * corner[1]));
        write!(path, "{letter}{x} {y}").expect("a string grows");
    }
    path + "Z"
}

/// A length to the hundredth of a pixel.
pub fn tidy(length: f64) -> f64 {
    let rounded = (length * 100.0).round() / 100.0;
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
            assert!(path.starts_with('M') && path.ends_with('Z'));
        }
    }
}
