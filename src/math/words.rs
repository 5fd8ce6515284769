//! Words of sentences.

/// `1 case`, `12 cases`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// `a`, `a and b`, `a, b and c`.
pub fn listed(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [word] => word.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A text whose first letter is a capital.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.trim().chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_counts_read_as_written_by_hand() {
        let words = ["a", "b", "c"].map(str::to_owned);
        let told = [0, 1, 2, 3].map(|count| listed(&words[..count]));
        assert_eq!(told, ["", "a", "a and b", "a, b and c"]);
        assert_eq!((counted(1, "case"), counted(2, "case")), ("1 case".into(), "2 cases".into()));
        assert_eq!(capitalised(" largest force"), "Largest force");
    }
}
