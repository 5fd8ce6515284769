//! The part of a journal line that is read.

use std::borrow::Cow;

use serde::de::DeserializeOwned;

/// The needed part of a record.
pub trait Wanted: DeserializeOwned + Send {
    /// The text from the first key up to the last occurrence of the second is not needed; keys are
    /// as in the lines. Reading it takes seconds for a million lines. No text in a line can contain
    /// such a key, because its quotes are escaped there.
    const UNWANTED: Option<[&'static str; 2]> = None;
}

/// The text of an entry without its unneeded part.
pub(super) fn wanted<R: Wanted>(entry: &[u8]) -> Cow<'_, [u8]> {
    let cut = || {
        let ([from, to], text) = (R::UNWANTED?, str::from_utf8(entry).ok()?);
        let (from, to) = (text.find(from)?, text.rfind(to)?);
        (from < to).then(|| [&entry[..from], &entry[to..]].concat())
    };
    cut().map_or(entry.into(), Cow::from)
}

#[cfg(test)]
mod tests {
    use super::super::ended::EndedLine;
    use super::super::entries::Entry;
    use super::super::record::{CaseRecord, Fared};
    use super::super::seal::Seal;
    use super::super::trial;
    use super::*;

    fn read<R: Wanted>(text: &str) -> [(R, usize); 2] {
        [text.as_bytes().into(), wanted::<R>(text.as_bytes())].map(|text: Cow<'_, [u8]>| {
            let Entry::Case(record) = serde_json::from_slice(&text).unwrap() else { panic!() };
            (*record, text.len())
        })
    }

    /// Words of a user's file that look like keys have no effect.
    #[test]
    fn nothing_that_is_wanted_is_left_out() {
        let study = trial::study("0.2");
        let mut record = trial::record(&study, &study.cases[0]);
        let keys = r#"","reason":"","outcome":1,"wall_time_s":2,"files":{}"#;
        record.values.insert("a".to_owned(), keys.into());
        record.reason = keys.to_owned();
        record.host = keys.to_owned();
        for files in [0, 1] {
            record.files =
                [("histories".to_owned(), Seal::of(b"1"))].into_iter().take(files).collect();
            let text = serde_json::to_string(&Entry::Case(Box::new(&record))).unwrap();
            let [(whole, all), (fared, less)] = read::<Fared>(&text);
            assert!(fared == whole && less < all);
            let [(whole, all), (ended, less)] = read::<EndedLine>(&text);
            assert_eq!(format!("{ended:?}"), format!("{whole:?}"));
            assert_eq!(less < all, files > 0);
            let [(whole, _), (same, _)] = read::<CaseRecord>(&text);
            assert!(same == whole && whole == record);
        }
    }
}
