//! How colours look to different eyes, for the tests of the figures' hues.

/// Red, green and blue of sRGB, 0 to 1.
type Colour = [f64; 3];
type Matrix = [[f64; 3]; 3];

/// How eyes see linear red, green and blue: most eyes, and eyes without one kind of cone (Machado,
/// Oliveira and Fernandes 2009, severity 1).
pub const EYES: [(&str, Matrix); 4] = [
    ("common", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protanopia",
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
    ),
    (
        "deuteranopia",
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
    ),
    (
        "tritanopia",
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ),
];

/// Converts linear red, green and blue to X, Y and Z over those of white (sRGB, D65).
const XYZ: Matrix = [
    [0.433_95, 0.376_21, 0.189_84],
    [0.212_67, 0.715_15, 0.072_18],
    [0.017_76, 0.109_47, 0.872_77],
];

/// A colour as style sheets write it, `#rrggbb`.
pub fn parse(text: &str) -> Colour {
    [1, 3, 5].map(|at| f64::from(u8::from_str_radix(&text[at..at + 2], 16).unwrap()) / 255.0)
}

/// The distance of two colours to an eye, in CIELAB; 2 can just be seen side by side.
pub fn apart(a: Colour, b: Colour, eye: Matrix) -> f64 {
    let (a, b) = (lab(times(eye, linear(a))), lab(times(eye, linear(b))));
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// Lightness L* of a colour that is printed in grey.
pub fn grey(colour: Colour) -> f64 {
    116.0 * root(times(XYZ, linear(colour))[1]) - 16.0
}

/// Contrast of two colours, 1 to 21 (WCAG 2).
pub fn contrast(a: Colour, b: Colour) -> f64 {
    let [a, b] = [a, b].map(|colour| times(XYZ, linear(colour))[1] + 0.05);
    a.max(b) / a.min(b)
}

fn linear(colour: Colour) -> Colour {
    let light = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    colour.map(light)
}

fn times(matrix: Matrix, [r, g, b]: Colour) -> Colour {
    matrix.map(|row| (row[0] * r + row[1] * g + row[2] * b).clamp(0.0, 1.0))
}

fn lab(seen: Colour) -> [f64; 3] {
    let [x, y, z] = times(XYZ, seen).map(root);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn root(share: f64) -> f64 {
    if share > 0.008_856 { share.cbrt() } else { 7.787 * share + 16.0 / 116.0 }
}

#[test]
fn red_and_green_are_alike_to_some_and_blue_is_not() {
    let (red, green, blue) = (parse("#b04a00"), parse("#7c6a00"), parse("#0050c0"));
    let [common, _, weak, _] = EYES.map(|(_, eye)| eye);
    assert!(apart(red, green, weak) < 0.5 * apart(red, green, common));
    assert!(apart(red, blue, weak) > 50.0);
    assert!((contrast(parse("#000000"), parse("#ffffff")) - 21.0).abs() < 0.01);
    assert!((grey(parse("#ffffff")) - 100.0).abs() < 0.01);
}
