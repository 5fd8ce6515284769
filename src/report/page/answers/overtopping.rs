//! How much water goes over a crest.

use super::force::most;
use crate::quantities::summary::OVERTOPPING_VOLUME;
use crate::report::load::Loaded;
use crate::report::page::words::{at, doubt_of, result};

/// The largest volume over a crest with its bar, and the case that has it; `None` without a crest.
pub fn largest(data: &Loaded) -> Option<String> {
    let column = &OVERTOPPING_VOLUME;
    let volumes = data.finished().filter_map(|row| row.number(column));
    let volumes = volumes.map(|volume| column.told_value(volume));
    let (dry, cases) =
        volumes.fold((0, 0), |(dry, all), volume| (dry + usize::from(volume == 0.0), all + 1));
    let (row, _) = most(data.finished(), |row| row.number(column))?;
    if dry == cases {
        return Some("No water went over the crest.".to_owned());
    }
    let volume = result("V", row, column)?;
    let mut text =
        format!("The largest volume over the crest is {volume} m³ per metre of wall{}.", at(row));
    if dry > 0 {
        text.push_str(&format!(" In {dry} of {cases} cases no water went over."));
    }
    text.push_str(&doubt_of("The largest volume", row, data.rows.len()));
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{DOUBTFUL, OVERTOPPING_VOLUME_ERROR};
    use crate::report::fixture;
    use crate::report::page::answers::all;

    /// The story: the page of a study of overtopping said nothing of volumes.
    #[test]
    fn the_largest_volume_is_told_with_its_bar_and_its_case() {
        let (_directory, mut data) = fixture::read(fixture::fixed());
        assert_eq!(largest(&data), None, "no wall has a crest");
        data.rows.truncate(3);
        // Sums of no water leave some 1e-14 m².
        for (row, volume) in data.rows.iter_mut().zip([1e-14, 0.002, 0.0125]) {
            row.set(&OVERTOPPING_VOLUME, volume);
        }
        data.rows[2].set(&OVERTOPPING_VOLUME_ERROR, 0.0005);
        let told = largest(&data).unwrap();
        assert_eq!(
            told,
            "The largest volume over the crest is V = 0.0125 ± 0.0005 m³ per metre of wall at \
             H/h = 0.3. In 1 of 3 cases no water went over."
        );
        assert!(all(&data).contains(&("Over the crest", told)));
        // The story: "The result is doubtful" stood behind the sentence on cases without water.
        data.rows[2].set(&DOUBTFUL, true);
        let told = largest(&data).unwrap();
        let end = "no water went over. The largest volume is doubtful: look at its history first.";
        assert!(told.ends_with(end), "{told}");
        data.rows.truncate(1);
        assert_eq!(largest(&data).unwrap(), "No water went over the crest.");
    }
}
