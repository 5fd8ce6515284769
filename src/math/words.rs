//! Words and sentences for people.

use std::io;

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

/// An error of the system about a file, for people.
pub fn in_words(error: &io::Error) -> String {
    use io::ErrorKind::{AlreadyExists, IsADirectory, NotADirectory, NotFound};
    /// Too many open files: of this process, and of the machine.
    const FULL: [Option<i32>; 2] = [Some(24), Some(23)];
    let told = match (error.kind(), error.raw_os_error()) {
        (NotFound, _) => "there is no such file or directory",
        (IsADirectory, _) => "a directory stands in the place of this file",
        (AlreadyExists, _) => "something else stands in its place",
        (NotADirectory, _) => "a file stands in the place of a directory",
        (_, number) if cfg!(unix) && number == FULL[0] => {
            "too many files are open; the limit of this process (ulimit -n) is too low"
        }
        (_, number) if cfg!(unix) && number == FULL[1] => "too many files are open on this machine",
        _ => {
            let told = error.to_string();
            let told = told.split(" (os error").next().unwrap_or(&told);
            let mut letters = told.chars();
            let first = letters.next().map(|first| first.to_lowercase().collect::<String>());
            return first.unwrap_or_default() + letters.as_str();
        }
    };
    told.to_owned()
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

    /// Too many open files were once called an "uncategorized error".
    #[test]
    fn the_systems_errors_are_told_plainly() {
        let told = |number| in_words(&io::Error::from_raw_os_error(number));
        assert_eq!(told(13), "permission denied");
        assert!(told(21).starts_with("a directory stands in the place"), "{}", told(21));
        assert!(told(24).contains("(ulimit -n)") && told(23).ends_with("on this machine"));
        assert_eq!(in_words(&io::Error::other("Disk full")), "disk full");
    }
}
