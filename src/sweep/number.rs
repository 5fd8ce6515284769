//! Numbers in tables: the shortest text that reads back as the same number. Numbers in sentences.

/// Plain digits, or an exponent where those would be many.
pub(super) fn text(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&magnitude) {
        return value.to_string();
    }
    format!("{value:e}")
}

/// `1 case`, `2 cases`.
pub fn counted(number: usize, noun: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{number} {noun}{ending}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_bit_for_bit() {
        let values = [0.1, 0.1 + 0.2, 1e-300, -5e-324, 1e7, 1.7976931348623157e308, -0.0, 1e-5];
        for value in values {
            let read: f64 = text(value).parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{}", text(value));
        }
        assert_eq!([0, 1, 2].map(|n| counted(n, "run")), ["0 runs", "1 run", "2 runs"]);
        assert_eq!([1e7, 0.2, 1e-7].map(text), ["10000000", "0.2", "1e-7"]);
    }
}
