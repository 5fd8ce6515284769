//! Numbers for the eye.

/// A parameter as a person writes it: `500`, `0.01`, `10⁷`, `2.5×10⁵`.
pub fn plain(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e4).contains(&size) {
        return value.to_string();
    }
    let text = format!("{value:e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let power = format!("10{}", exponent.chars().map(superscript).collect::<String>());
    if mantissa == "1" { power } else { format!("{mantissa}×{power}") }
}

/// A result rounded to a fixed number of decimals; empty where there is none.
pub fn rounded(value: Option<f64>, decimals: usize) -> String {
    value.map(|value| format!("{value:.decimals$}")).unwrap_or_default()
}

/// Whether a text is a number, written out or as [`plain`] writes it.
pub fn is_number(text: &str) -> bool {
    let mantissa =
        text.split_once("10").filter(|(_, power)| power.starts_with(|c: char| !c.is_ascii()));
    match mantissa {
        Some((mantissa, _)) => {
            let mantissa = mantissa.trim_end_matches('×');
            mantissa.is_empty() || mantissa.parse::<f64>().is_ok()
        }
        None => text.parse::<f64>().is_ok(),
    }
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_read_as_written_by_hand() {
        let written = [0.0, 0.01, 500.0, 9999.0, 1e7, 2.5e5, 1e-4].map(plain);
        assert_eq!(written, ["0", "0.01", "500", "9999", "10⁷", "2.5×10⁵", "10⁻⁴"]);
    }

    #[test]
    fn what_is_written_is_recognised() {
        assert!([0.0, 0.01, 10.0, 110.0, 1e7, 2.5e5, 1e-4].map(plain).iter().all(|t| is_number(t)));
        assert!(!is_number("case-10") && !is_number("ok") && !is_number(""));
    }

    #[test]
    fn an_absent_result_is_empty() {
        assert_eq!(rounded(Some(1.23456), 3), "1.235");
        assert_eq!(rounded(None, 3), "");
    }
}
