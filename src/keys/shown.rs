//! Text of unknown origin on a terminal: it must not move the cursor, and long words are cut.

use std::path::Path;

use super::error::cut;

/// A longer word is cut. Paths may be this long.
const LONGEST: usize = 300;

/// Escapes all but text and line breaks, and cuts long words.
pub fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for piece in text.split_inclusive(char::is_whitespace) {
        let word = piece.trim_end();
        let (short, space) = (cut(word, LONGEST), &piece[word.len()..]);
        let told = short.as_deref().unwrap_or(word).chars().chain(space.chars());
        told.for_each(|char| push(&mut shown, char));
    }
    shown
}

fn push(shown: &mut String, char: char) {
    let turns =
        matches!(char, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    match char {
        '\n' | '\t' => shown.push(char),
        _ if char.is_control() || turns => shown.extend(char.escape_unicode()),
        _ => shown.push(char),
    }
}

/// A path within a sentence: a line break in it is escaped.
pub fn named(path: &Path) -> String {
    let mut told = String::new();
    for char in path.to_string_lossy().chars() {
        match char {
            '\n' | '\t' => told.extend(char.escape_default()),
            _ => push(&mut told, char),
        }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_text_is_escaped() {
        assert_eq!(shown("a\u{1b}[31m b\nc\u{9b}"), "a\\u{1b}[31m b\nc\\u{9b}");
        assert_eq!(shown("\u{202e}abc \u{f6}"), "\\u{202e}abc \u{f6}");
        assert_eq!(named(Path::new("a b\n\u{1b}[31m/\u{f6}")), "a b\\n\\u{1b}[31m/\u{f6}");
    }

    #[test]
    fn long_words_are_cut() {
        let word = "x".repeat(5000);
        let told = shown(&format!("scene.wall = \"{word}\": must be\n"));
        assert!(told.len() < 150, "{told}");
        assert!(told.starts_with("scene.wall = \"xxx") && told.ends_with(" must be\n"), "{told}");
        assert!(told.contains("xxx ... xxx"), "{told}");
        assert!(told.contains(" (5003 characters) must be"), "{told}");
        let path = "/a/long/path".repeat(20);
        assert_eq!(shown(&path), path);
    }
}
