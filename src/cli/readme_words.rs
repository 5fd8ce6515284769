//! Words that are no key and no column: those that README.md explains, and names that contain them.

use super::glossary::{Entry, without_links};

/// The file and the heading that declare them.
const README: &str = include_str!("../../README.md");
const HEADING: &str = "\n## Words\n";
/// How many names that contain a word are listed.
const MOST: usize = 12;

/// What a word means, and the keys and columns that contain it or belong to it; `None` where
/// README.md does not explain it.
pub(super) fn thing(word: &str, all: &[Entry]) -> Option<Entry> {
    let wanted = singular(word);
    let is_it = |name: &str| singular(&name.replace('\\', "")) == wanted;
    let (name, meaning) = lines().find(|(names, _)| names.split(", ").any(is_it))?;
    let words: Vec<&str> = wanted.split(' ').collect();
    // A single letter is a symbol. In names it is a unit.
    let in_name = |name: &str| {
        let parts: Vec<&str> = name.split('_').collect();
        let is_word = |(part, word): (&&str, &&str)| {
            part.strip_suffix('s').unwrap_or(part) == *word || part == word
        };
        wanted.len() > 1
            && parts.windows(words.len()).any(|parts| parts.iter().zip(&words).all(is_word))
    };
    let has = |entry: &&Entry| {
        let told = entry.only.contains(&format!("\"{}\"", wanted.replace(' ', "-")));
        told || in_name(&entry.name) || meaning.contains(&format!("`{}`", entry.name))
    };
    let mut names: Vec<&str> = Vec::new();
    for entry in all.iter().filter(has) {
        if !names.contains(&&*entry.name) {
            names.push(&entry.name);
        }
    }
    let more = names.len().saturating_sub(MOST);
    names.truncate(MOST);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    Some(Entry {
        name: name.to_owned(),
        of: "word".to_owned(),
        meaning: without_links(meaning).replace('\\', ""),
        besides: names.join(", ") + &more,
        ..Entry::default()
    })
}

/// All explained words, except for symbols.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    lines()
        .flat_map(|(names, _)| names.split(", "))
        .filter(|name| name.len() > 1 && !name.contains('\\'))
}

/// Lines of the table: names and their meaning.
fn lines() -> impl Iterator<Item = (&'static str, &'static str)> {
    let table = README.split_once(HEADING).map_or("", |(_, rest)| rest);
    let lines = table.lines().skip_while(|line| !line.starts_with('|')).skip(2);
    let cells = |line: &'static str| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | ");
    lines.map_while(cells)
}

/// Lower case, one space between words, and the singular: `Error_bars` is `error bar`.
fn singular(word: &str) -> String {
    let word = word.trim().to_lowercase().replace(['_', '-'], " ");
    let one = word.strip_suffix('s').filter(|one| one.len() > 3 && !one.ends_with('s'));
    one.unwrap_or(&word).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::glossary::entries;

    #[test]
    fn what_an_engineer_asks_for_is_explained() {
        let all = entries();
        let told = |word: &str| thing(word, &all).unwrap_or_else(|| panic!("{word}"));
        for word in ["caisson", "crest", "error bars", "first impact", "Companion", "trunk", "rows"]
        {
            let thing = told(word);
            assert!(thing.meaning.len() > 20 && !thing.meaning.contains("]("), "{thing:?}");
        }
        assert!(told("caisson").besides.contains("static_friction"));
        assert!(told("crest").besides.starts_with("crest_freeboard_m, crest_width_m"));
        assert_eq!(told("s").besides, "force_coupling");
        assert!(names().count() > 10 && names().all(|name| !name.is_empty()));
        assert_eq!(thing("F", &all), None);
    }
}
