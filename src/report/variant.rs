//! Tells several runs of the same wave and wall apart.

use sha2::{Digest, Sha256};

use super::column::Cells;
use super::number;
use super::row::Row;
use super::study::Key;
use crate::math::digest::digits;
use crate::quantities::Column;
use crate::quantities::summary::{BOUNDARY, FORCE_COUPLING, KERNEL, PARTICLE_SPACING, SCHEME};

/// Columns that say where and how a case was computed, and not what was computed.
const PROVENANCE: &[&str] =
    &["host", "rank", "ranks", "threads", "executor", "simd", "version", "git_commit"];

/// Longer values, such as beds of many points, are replaced by their number in the study: they
/// would be part of file names.
const LONGEST: usize = 60;

/// File systems take names of 255 bytes with the ending. Longer ones end with a checksum.
const LONGEST_NAME: usize = 200;

/// A name with these words in it, fit for a file.
pub(super) fn file_name(stem: &str, words: &str) -> String {
    let mut name = stem.to_owned();
    // Two floors may differ only in the sign of their height.
    let words = words.replace(" -", " minus ");
    for word in words.split(|c: char| !c.is_ascii_alphanumeric() && c != '.') {
        if !word.is_empty() {
            name.push('-');
            name.push_str(&word.to_ascii_lowercase());
        }
    }
    if name.len() > LONGEST_NAME {
        // Words are ASCII, and so is every stem.
        let sum = digits(Sha256::new_with_prefix(&name));
        name.truncate(LONGEST_NAME - 17);
        name.push('-');
        name.push_str(&sum);
    }
    name
}

/// Fills in [`Row::variant`] where several rows share wave, stiffness and mass. It names the
/// choices that differ: known ones, and swept keys after the usual columns. If the grid's keys are
/// known, only they count: numerics that follow from a swept bed would stand in every label.
pub(super) fn name_variants(rows: &mut [Row], swept: &[Key], grid: &[String]) {
    let mut places: Vec<_> = rows.iter().map(Row::place).collect();
    places.sort_unstable();
    if places.windows(2).all(|pair| pair[0] != pair[1]) {
        return;
    }
    let cells = |column: &Column| rows.iter().map(|row| row.cell(column)).collect::<Cells>();
    let known = [&SCHEME, &BOUNDARY, &KERNEL, &PARTICLE_SPACING, &FORCE_COUPLING];
    let asked = |column: &&&Column| grid.is_empty() || grid.iter().any(|key| key == column.name);
    let known = known.iter().filter(asked);
    let mut choices: Vec<_> = known.map(|column| (column.name.to_owned(), cells(column))).collect();
    choices.extend(swept.iter().map(|key| (key.name.clone(), key.cells.clone())));
    choices.retain(|(name, values)| {
        !PROVENANCE.contains(&name.as_str()) && values.different().nth(1).is_some()
    });
    for (_, values) in &mut choices {
        *values = shorten(values);
    }
    let names: Cells = (0..rows.len()).map(|index| words(&choices, index)).collect();
    for (index, row) in rows.iter_mut().enumerate() {
        row.variant = names.shared(index);
    }
}

/// A row's values of these choices: `boundary = sfdi, kernel = gaussian`. Empty cells are left out.
pub(super) fn words(choices: &[(String, Cells)], row: usize) -> String {
    let has = choices.iter().filter(|(_, cells)| !cells[row].is_empty());
    has.map(|(name, cells)| format!("{name} = {}", &cells[row])).collect::<Vec<_>>().join(", ")
}

/// Rounds numbers for the reader, unless that makes two values equal. Long values, and those that a
/// file name cannot tell apart, are replaced by their number in the study.
pub(super) fn shorten(values: &Cells) -> Cells {
    let short = values.map(|cell| {
        let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
        value.map_or(cell.to_owned(), |value| number::significant(value, 4).to_string())
    });
    let count = |values: &Cells| values.different().count();
    let values = if count(&short) == count(values) { &short } else { values };
    let in_file_names = values.map(|cell| file_name("", &format!("= {cell}")));
    let differ = count(&in_file_names) == count(values);
    if differ && values.different().all(|cell| cell.len() <= LONGEST) {
        return values.clone();
    }
    let known: Vec<_> = values.different().map(str::to_owned).collect();
    let number = |cell: &str| known.iter().position(|one| one == cell).map_or(0, |at| at + 1);
    values.map(
        |cell| if cell.is_empty() { String::new() } else { format!("number {}", number(cell)) },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::WAVE_HEIGHT_RATIO;

    fn row(boundary: &str, wave: f64) -> Row {
        Row::default().with(&WAVE_HEIGHT_RATIO, wave).with(&BOUNDARY, boundary)
    }

    #[test]
    fn one_run_per_place_needs_no_variant() {
        let mut rows = vec![row("sfdi", 0.2), row("normalized", 0.3)];
        name_variants(&mut rows, &[], &[]);
        assert!(rows.iter().all(|row| row.variant.is_empty()));
    }

    #[test]
    fn runs_at_one_place_are_told_apart_by_what_differs() {
        let mut rows = vec![row("sfdi", 0.2), row("normalized", 0.2)];
        let swept = [Key::new("slip", ["free", "no"]), Key::new("host", ["a", "b"])];
        name_variants(&mut rows, &swept, &[]);
        assert_eq!(&*rows[0].variant, "boundary = sfdi, slip = free");
        assert_eq!(&*rows[1].variant, "boundary = normalized, slip = no");
    }

    /// The story: a level bed had another default interpolator, which stood in every label.
    #[test]
    fn what_follows_from_a_swept_key_is_left_out() {
        let variants = |grid: &[&str]| {
            let mut rows = vec![row("sfdi", 0.2), row("normalized", 0.2)];
            let grid: Vec<_> = grid.iter().map(|&key| key.to_owned()).collect();
            name_variants(&mut rows, &[Key::new("bed", ["a", "b"])], &grid);
            rows.iter().map(|row| row.variant.to_string()).collect::<Vec<_>>()
        };
        assert_eq!(variants(&["bed"]), ["bed = a", "bed = b"]);
        let both = ["boundary = sfdi, bed = a", "boundary = normalized, bed = b"];
        assert_eq!(variants(&["bed", "boundary"]), both);
        assert_eq!(variants(&[]), both, "no manifest tells the grid");
    }

    #[test]
    fn a_key_that_a_case_does_not_have_is_left_out() {
        let mut rows = vec![row("sfdi", 0.2), row("sfdi", 0.2)];
        let key = |name: &str, cells: [&str; 2]| Key {
            name: name.to_owned(),
            cells: cells.into_iter().collect(),
        };
        let swept = [key("behind", ["outflow", "floor"]), key("floor_length_m", ["", "0.7"])];
        name_variants(&mut rows, &swept, &[]);
        assert_eq!(&*rows[0].variant, "behind = outflow");
        assert_eq!(&*rows[1].variant, "behind = floor, floor_length_m = 0.7");
    }

    #[test]
    fn numbers_of_a_variant_are_short_as_long_as_they_differ() {
        let cells = |texts: [&str; 2]| texts.into_iter().collect::<Cells>();
        let far = shorten(&cells(["0.012345678", "21544.3469003188"]));
        assert_eq!(far, cells(["0.01235", "21540"]));
        let near = cells(["1.00001", "1.00002"]);
        assert_eq!(shorten(&near), near);
        let beds = [9, 8].map(|last| format!("[[0, 0], {}[5, {last}]]", "[1, 0.123], ".repeat(5)));
        let beds = cells([&beds[0], &beds[1]]);
        assert_eq!(shorten(&beds), cells(["number 1", "number 2"]));
    }

    #[test]
    fn names_of_files_are_no_longer_than_a_disk_takes_them() {
        let long = |last: u8| {
            file_name("force", &format!("{}last = {last}", "some_key = 1.5, ".repeat(30)))
        };
        assert_eq!((long(1).len(), long(1) == long(2)), (LONGEST_NAME, false));
        assert_eq!(file_name("force", "a_b = 1"), "force-a-b-1");
    }

    #[test]
    fn words_that_a_file_name_cannot_tell_apart_are_numbered() {
        let short = |texts: [&str; 3]| {
            let cells = shorten(&texts.into_iter().collect());
            cells.iter().map(str::to_owned).collect::<Vec<_>>()
        };
        for words in [["a_b.csv", "a-b.csv", "c.csv"], ["A.csv", "a.csv", "b.csv"]] {
            assert_eq!(short(words), ["number 1", "number 2", "number 3"]);
        }
        assert_eq!(short(["\u{f6}", "\u{e4}", ""]), ["number 1", "number 2", ""]);
        for words in [["sfdi", "mls-linear", ""], ["0.05", "-0.05", "0"]] {
            assert_eq!(short(words), words);
        }
    }
}
