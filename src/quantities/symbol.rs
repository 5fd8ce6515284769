//! The symbols of tables as other names of columns and keys: what is printed may be typed.

use super::Column;
use super::summary::ALL;

/// Whether somebody means this symbol by a word: the symbol itself, such as `k`, or its bare part, such as
/// `F*` of `F* max` and of `first F*`.
pub fn is_meant(word: &str, symbol: &str) -> bool {
    own(word).iter().any(|own| own == symbol) && !symbol.is_empty()
}

/// What a word may stand for, the likeliest first.
fn own(word: &str) -> [String; 3] {
    let word = word.split_whitespace().collect::<Vec<_>>().join(" ");
    [word.clone(), format!("{word} max"), format!("first {word}")]
}

/// The columns of numbers that have this symbol: that of the whole run before that of the first impact.
fn called(word: &str) -> impl Iterator<Item = &'static Column> + use<> {
    let columns = |own: String| {
        ALL.iter().copied().filter(move |column| column.is_number() && column.symbol == own)
    };
    let is_word = !word.trim().is_empty();
    own(word).into_iter().filter(move |_| is_word).flat_map(columns)
}

/// The name of the column or key with this symbol: `F*` is `force_max`, `k` is `spring_stiffness_n_per_m`.
pub fn name_of_symbol(word: &str) -> Option<&'static str> {
    called(word).next().map(|column| column.name)
}

/// The columns that somebody means by what is nearly a symbol, such as `F_max` or `k*`, or by a maximum's bare word,
/// such as `force`, as a question; `None` for other words.
pub fn meant_by(word: &str) -> Option<String> {
    let logarithm = format!("log₁₀ {}", word.trim());
    let maximum = letters(word) + "max";
    let like = |column: &&&Column| {
        let near = letters(word).len() > 2 && letters(word) == letters(column.symbol);
        let bare = letters(column.name) == maximum;
        column.is_number() && (near || bare || column.symbol == logarithm)
    };
    let exact = called(word).map(|column| column.name);
    let near = ALL.iter().filter(like).map(|column| column.name);
    let mut names: Vec<_> = exact.chain(near).collect();
    names.dedup();
    (!names.is_empty()).then(|| format!("; did you mean {}?", names.join(" or ")))
}

/// A symbol's letters and digits, in small letters.
fn letters(symbol: &str) -> String {
    let digit = |c: char| match c {
        '₀'..='₉' => char::from_digit(c as u32 - '₀' as u32, 10).unwrap_or(c),
        c => c,
    };
    symbol.to_lowercase().chars().map(digit).filter(|c| c.is_alphanumeric()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_tables_print_is_a_name() {
        let known = [
            ("k", "spring_stiffness_n_per_m"),
            ("m", "seawall_mass_kg_per_m"),
            ("H/h", "wave_height_ratio"),
            ("F*", "force_max"),
            ("F* max", "force_max"),
            ("first F*", "first_force_max"),
            ("R*", "runup_max"),
            ("X*", "displacement_max"),
            ("m*", "m_star"),
            ("log₁₀ k*", "log10_k_star"),
        ];
        for (symbol, name) in known {
            assert_eq!(name_of_symbol(symbol), Some(name), "{symbol}");
        }
        for other in ["", " ", "F", "K", "M", "case", "still moving", "max", "force_max"] {
            assert_eq!(name_of_symbol(other), None, "{other}");
        }
        assert!(is_meant("F*", "first F*") && !is_meant("F", "F* max") && !is_meant("", ""));
    }

    #[test]
    fn a_symbol_written_otherwise_is_guessed() {
        let told = |word: &str| meant_by(word).unwrap_or_default();
        assert_eq!(told("F_max"), "; did you mean force_max?");
        assert_eq!(told("force"), "; did you mean force_max?");
        assert_eq!(told("Rmax"), "; did you mean runup_max?");
        assert_eq!(told("log10 k*"), "; did you mean log10_k_star?");
        assert_eq!(told("k*"), "; did you mean log10_k_star?");
        assert_eq!(told("F*"), "; did you mean force_max or first_force_max?");
        for other in ["F", "colour", "", "max"] {
            assert_eq!(told(other), "", "{other}");
        }
    }
}
