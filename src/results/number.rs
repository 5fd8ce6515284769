//! Numbers in tables: the shortest text that reads back as the same number.

use std::fmt::Write;

/// Plain digits, or an exponent if there would be many.
pub(super) fn text(value: f64) -> String {
    let mut text = String::new();
    push(&mut text, value);
    text
}

/// Appends a number: a history has thousands of them.
pub(super) fn push(text: &mut String, value: f64) {
    if (1e-5..1e16).contains(&value.abs()) {
        let mut buffer = zmij::Buffer::new();
        let plain = buffer.format_finite(value);
        text.push_str(plain.strip_suffix(".0").unwrap_or(plain));
    } else if value == 0.0 || !value.is_finite() {
        write!(text, "{value}").expect("text takes it all");
    } else {
        write!(text, "{value:e}").expect("text takes it all");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same as `text`, with the standard library alone.
    fn plain(value: f64) -> String {
        match value.abs() {
            magnitude if magnitude != 0.0 && !(1e-5..1e16).contains(&magnitude) => {
                format!("{value:e}")
            }
            _ => value.to_string(),
        }
    }

    #[test]
    fn numbers_are_as_short_as_those_of_the_standard_library() {
        let mut bits = 1_u64;
        for _ in 0..100_000 {
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let mantissa = (bits >> 11) as f64 / (1_u64 << 53) as f64;
            let value = (mantissa - 0.5) * 10_f64.powi((bits % 40) as i32 - 20);
            for value in [value, value.round(), f64::from(value as f32)] {
                // If two texts are equally close and short, each library may choose either.
                let (text, plain) = (text(value), plain(value));
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
                assert_eq!(text.len(), plain.len(), "{text} {plain}");
            }
        }
        for value in [1e-5, 9.999999999999999e-6, 1e15, 9999999999999998.0, 1e16, 0.0, -0.0, 100.0]
        {
            assert_eq!([text(value), text(-value)], [plain(value), plain(-value)]);
        }
    }

    #[test]
    fn numbers_read_back_bit_for_bit() {
        let values = [0.1, 0.1 + 0.2, 1e-300, -5e-324, 1e7, 1.7976931348623157e308, -0.0, 1e-5];
        for value in values {
            let read: f64 = text(value).parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{}", text(value));
        }
        assert_eq!([1e7, 0.2, 1e-7].map(text), ["10000000", "0.2", "1e-7"]);
    }
}
