//! How high the water runs up a beach, where the wall behind it stands dry.

use super::force::{most, scene};
use crate::quantities::summary::RUNUP_MAX;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::page::words::{at, doubt, result};
use crate::report::row::Row;

/// The highest runup of such cases over h and in metres, and how the water's edge was found; `None`
/// where water stands at every wall.
pub fn highest(data: &Loaded) -> Option<String> {
    let dry = data.finished().filter(|row| row.stands_dry());
    let (row, runup) = most(dry, |row| row.number(&RUNUP_MAX))?;
    let scene = scene(data, row);
    let seawall = scene.as_ref().and_then(|scene| scene.seawall());
    let metres = scene.as_ref().map(|scene| runup * scene.frame().depth);
    let metres = metres.map(|height| number::significant(height, 3));
    let over = metres.map(|height| format!(", that is {height} m over still water"));
    let (over, place) = (over.unwrap_or_default(), at(row));
    let comma = if over.is_empty() || place.is_empty() { "" } else { "," };
    let is = match () {
        () if data.rows.len() == 1 => "runup is",
        () if data.finished().all(Row::stands_dry) => "runup of all is",
        () => "runup before a wall that stands dry is",
    };
    let mut text =
        format!("The highest {is} {}{over}{comma}{place}.", result("R*", row, &RUNUP_MAX)?);
    text.push_str(&match seawall.map(|scene| scene.runup_thickness_m) {
        Some(Some(thickness)) => format!(" It is told where the water is {thickness} m thick."),
        Some(None) => " It is told where the water is one particle spacing thick, so it rises as the spacing falls; \
                        runup_thickness_m tells it at one thickness for all spacings."
            .to_owned(),
        None => String::new(),
    });
    text.push_str(&doubt(row, data.rows.len()));
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{FIRST_FORCE_MAX, FIRST_RUNUP_MAX, FORCE_AT_REST, FORCE_MAX};
    use crate::report::fixture;
    use crate::report::page::answers::force;

    /// The story: for a beach the page said that the largest force was 0, and gave no runup.
    #[test]
    fn a_beach_is_told_by_its_runup() {
        let (_directory, mut data) = fixture::read(fixture::fixed());
        assert_eq!(highest(&data), None, "water stands at the wall");
        data.set_all(&FIRST_FORCE_MAX, "").set_all(&FIRST_RUNUP_MAX, "");
        data.set_all(&FORCE_MAX, 0.0).set_all(&FORCE_AT_REST, 0.0).set_all(&RUNUP_MAX, 0.5);
        let id = data.rows[2].id().to_owned();
        data.rows[2].set(&RUNUP_MAX, 0.75);
        let wave = at(&data.rows[2]);
        assert_eq!(
            highest(&data).unwrap(),
            format!("The highest runup of all is R* = 0.75{wave}.")
        );
        let told = |more: &str| {
            let mut data = data.clone();
            data.rows.retain(|row| row.id() == id);
            let scene = format!("bed = [[0, 0], [1, 0], [3, 0.4]]\ntank_length_m = 3\n{more}");
            let text =
                format!("name = \"a\"\n[scene]\nwave_height_ratio = 0.3\nend_time_s = 3\n{scene}");
            data = data.made_from(&text, &[]);
            data.keys.clear();
            highest(&data).unwrap()
        };
        let coarse = told("");
        assert!(coarse.contains(", that is 0.15 m over still water"), "{coarse}");
        assert!(coarse.contains("one particle spacing thick, so it rises"), "{coarse}");
        let fixed = told("runup_thickness_m = 0.02");
        assert!(fixed.ends_with("It is told where the water is 0.02 m thick."), "{fixed}");
        let pressed = force::largest(&data).unwrap();
        assert_eq!(pressed, "No water presses on the wall, which stands dry.");
    }
}
