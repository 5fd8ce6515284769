//! The width of words, so that nothing is drawn over them.

use std::sync::LazyLock;

use ttf_parser::Face;

/// A subset of DejaVu Sans, the widest of the common fonts: words that fit in it fit in all.
pub const FONT: &[u8] = include_bytes!("../../../data/font/DejaVuSans.ttf");

/// The fonts that figures ask for. The first three have the same widths.
pub const FAMILY: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// Height of tick labels and notes, CSS pixels; nothing is smaller.
pub const SMALL: f64 = 10.0;
/// Height of titles and of words in a legend, CSS pixels.
pub const NORMAL: f64 = 11.5;

static FACE: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(FONT, 0).expect("the font is part of the program"));

/// Width of one line of text, CSS pixels. A sign that the font lacks counts as wide.
pub fn width(text: &str, size: f64) -> f64 {
    let wide = FACE.units_per_em();
    let advance = |sign: char| {
        let glyph = FACE.glyph_index(sign);
        f64::from(glyph.and_then(|glyph| FACE.glyph_hor_advance(glyph)).unwrap_or(wide))
    };
    text.chars().map(advance).sum::<f64>() * size / f64::from(wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_grow_with_their_letters_and_their_size() {
        assert_eq!(width("", 10.0), 0.0);
        assert!((width("00", 10.0) - 2.0 * width("0", 10.0)).abs() < 1e-9);
        assert!((width("R / h", 20.0) - 2.0 * width("R / h", 10.0)).abs() < 1e-9);
        assert!(width("i", 10.0) < width("m", 10.0));
    }

    #[test]
    fn the_font_has_every_sign_of_a_figure() {
        for sign in "F* / (½ρgh²), log₁₀ k* −4 10⁻²³⁴⁵⁶⁷⁸⁹¹⁰ 2.5×10⁵ ≥ ± ° √ · – ’ α".chars()
        {
            assert!(FACE.glyph_index(sign).is_some(), "{sign}");
        }
    }
}
