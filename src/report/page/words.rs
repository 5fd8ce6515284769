//! Words and numbers of generated sentences.

use crate::math::words::listed;
use crate::quantities::Column;
use crate::quantities::summary::DOUBTFUL;
use crate::report::number;
use crate::report::row::Row;

/// Rising values: all if they are few, or else both ends and their number.
pub fn range(values: &[f64], unit: &str) -> String {
    let space = if unit.is_empty() { "" } else { " " };
    let words: Vec<_> = values.iter().map(|value| number::as_typed(*value)).collect();
    match &words[..] {
        [first, .., last] if words.len() > 3 => {
            format!("{first} to {last}{space}{unit} ({} values)", words.len())
        }
        _ => format!("{}{space}{unit}", listed(&words)),
    }
}

/// Keeps a number on one line with its unit, its bar and its symbol.
pub fn unbroken(text: &str) -> String {
    let mut text = text.replace(" = ", "\u{a0}=\u{a0}").replace(" ± ", "\u{a0}±\u{a0}");
    for unit in ["%", "°", "N/m", "kg/m", "kN", "mm"] {
        text = text.replace(&format!(" {unit}"), &format!("\u{a0}{unit}"));
    }
    // The depth h is a unit if only a word's end follows.
    for end in [" ", ",", ".", ")"] {
        text = text.replace(&format!(" h{end}"), &format!("\u{a0}h{end}"));
        // These letters can be words, too. They are units only after a digit.
        for (unit, digit) in
            ["m", "s"].into_iter().flat_map(|unit| (0..10).map(move |digit| (unit, digit)))
        {
            text =
                text.replace(&format!("{digit} {unit}{end}"), &format!("{digit}\u{a0}{unit}{end}"));
        }
    }
    text
}

/// `F* = 3.92 ± 0.04`, or `X* ≥ 3.1` for a lower bound.
pub fn result(symbol: &str, row: &Row, column: &Column) -> Option<String> {
    let value = row.number(column)?;
    let error = row.error(column).unwrap_or(0.0);
    Some(if row.is_bound(column) {
        format!("{symbol} {}", number::bound_with_error(value, error))
    } else {
        format!("{symbol} = {}", number::with_error(value, error))
    })
}

/// `at H/h = 0.5, k = 10 N/m`; empty for a single case.
pub fn at(row: &Row) -> String {
    let words = row.words();
    if words.is_empty() { words } else { format!(" at {words}") }
}

/// A sentence where the result of a row is doubtful. For a single case its doubts are reported
/// elsewhere.
pub fn doubt(row: &Row, cases: usize) -> String {
    doubt_of("The result", row, cases)
}

/// The same with a name for the result, where the sentence before it is about another.
pub fn doubt_of(what: &str, row: &Row, cases: usize) -> String {
    let doubtful = row.is(&DOUBTFUL) && cases > 1;
    if doubtful {
        format!(" {what} is doubtful: look at its history first.")
    } else {
        String::new()
    }
}

/// A share in percent with two digits: `0.42 %`, `3.1 %`, `12 %`.
pub fn percent(share: f64) -> String {
    format!("{} %", number::significant(100.0 * share, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_shares_read_as_written_by_hand() {
        assert_eq!(range(&[0.01, 10.0, 500.0, 1e7], "N/m"), "0.01 to 1e7 N/m (4 values)");
        assert_eq!(range(&[0.3, 0.5], ""), "0.3 and 0.5");
        assert_eq!([0.0042, 0.031, 0.123].map(percent), ["0.42 %", "3.1 %", "12 %"]);
    }

    #[test]
    fn no_line_ends_between_a_number_and_its_unit() {
        let told = unbroken("R* = 0.3 ± 0.0047 h, 0.099 h (k up to 500 N/m) of h");
        assert_eq!(unbroken("wall angle 90 °, end"), "wall angle 90\u{a0}°, end");
        assert_eq!(
            unbroken("length 2.5 m, end 3 s. Of m and s"),
            "length 2.5\u{a0}m, end 3\u{a0}s. Of m and s"
        );
        let words: Vec<_> = told.split(' ').collect();
        let pairs = ["R*\u{a0}=\u{a0}0.3\u{a0}±\u{a0}0.0047\u{a0}h,", "0.099\u{a0}h"];
        assert_eq!(words[..2], pairs, "{told}");
        assert_eq!(words.last(), Some(&"h"));
    }
}
