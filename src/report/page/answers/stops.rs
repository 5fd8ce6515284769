//! Walls that come back onto their stops.

use crate::math::words::counted;
use crate::quantities::summary::STOPS;
use crate::report::load::Loaded;
use crate::report::row::Row;

/// In how many cases the wall hits its stop, and where this load is found; `None` where none does.
pub fn hits(data: &Loaded) -> Option<String> {
    let has_stop = |row: &&Row| row.number(&STOPS).is_some() && !row.is_springless();
    let all = data.finished().filter(has_stop).count();
    let hit = data.finished().filter(|row| row.hits_stop());
    let often = match (hit.count(), all) {
        (0, _) => return None,
        (_, 1) => "The wall hits its stop.".to_owned(),
        (hit, all) => format!("The wall hits its stop in {hit} of {}.", counted(all, "case")),
    };
    let load =
        "The load of such a hit is in no maximum; it is in the table Health, as the stop impulse.";
    Some(format!("{often} {load}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{SEAWALL_MASS, STATUS};

    #[test]
    fn walls_that_hit_their_stops_are_counted_among_those_that_have_one() {
        let said = |stops: &[&str]| {
            let row = |hits: &&str| Row::default().with(&STATUS, "ok").with(&STOPS, hits);
            hits(&Loaded { rows: stops.iter().map(row).collect(), ..Loaded::default() })
        };
        assert!(
            said(&["2", "", "0"]).unwrap().starts_with("The wall hits its stop in 1 of 2 cases. ")
        );
        assert!(said(&["3"]).unwrap().starts_with("The wall hits its stop. The load"));
        // A caisson has no stop, whatever its row counts.
        let row = |stops: u8| Row::default().with(&STATUS, "ok").with(&STOPS, stops);
        let rows = vec![row(1), row(0).with(&SEAWALL_MASS, 60)];
        let told = hits(&Loaded { rows, ..Loaded::default() }).unwrap();
        assert!(told.starts_with("The wall hits its stop. The load"), "{told}");
        assert_eq!([said(&["0", "0"]), said(&["", ""]), said(&[])], [None, None, None]);
    }
}
