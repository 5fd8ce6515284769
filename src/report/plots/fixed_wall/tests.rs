use super::*;
use crate::quantities::summary::{FORCE_AT_REST, FORCE_MAX};
use crate::report::fixture;

#[test]
fn an_inclined_wall_is_not_drawn_against_an_upright_ones_answer() {
    let (_directory, mut data) = fixture::read(fixture::fixed());
    let upright = figures(&data).remove(0);
    assert!(upright.svg().contains("exact solitary wave"));
    assert!(upright.svg().contains("Goda"));
    assert!(upright.caption.contains("reflected by a vertical wall"));
    for row in &mut data.rows {
        row.wall_angle_deg = Some(120.0);
    }
    let inclined = figures(&data).remove(0);
    assert!(!inclined.svg().contains("exact solitary wave"));
    assert!(!inclined.svg().contains("Goda"));
    assert!(inclined.caption.contains("inclined") && !inclined.caption.contains("Line"));
}

/// The story: a train of H/h = 0.17 stood at 0.066, the height of the little crest that it begins with.
#[test]
fn a_train_stands_at_its_own_height_and_not_at_its_first_crest() {
    let directory = fixture::fixed();
    let mut data = Loaded::read(directory.path()).unwrap();
    let single = figures(&data).remove(0);
    assert!(single.caption.contains("first impact") && single.caption.contains("gauge"));
    let file = "[scene]\npaddle = \"wave-train\"\nwave_period_s = 1.0\nend_time_s = 8";
    data = data.made_from(file, &[]);
    data.rows.iter_mut().for_each(|row| row.regular = true);
    let train = figures(&data).remove(0);
    let told = "whole run on a fixed wall against the wave height (nominal)";
    assert!(train.caption.contains(told), "{}", train.caption);
    let svg = train.svg();
    let drawn = |column: &Column| svg.contains(&format!("\"{}\"", column.name));
    assert!(drawn(&WAVE_HEIGHT_RATIO) && !drawn(&MEASURED_WAVE_HEIGHT_RATIO));
    assert!(drawn(&FORCE_MAX) && !drawn(&FIRST_FORCE_MAX));
    // Goda's points had no case: the page's script failed at one under the pointer, and keys died.
    assert!(svg.contains("by Goda's formula") && !svg.contains("data-case=\"\""), "{svg}");
    // A case without a first impact was left out.
    data.rows[0].set(&FIRST_FORCE_MAX, "").set(&FIRST_RUNUP_MAX, "");
    let id = data.rows[0].id().to_owned();
    assert!(figures(&data).remove(0).svg().contains(&id));
}

/// The story: a beach had no figure of runup over waves, as no water pressed on its dry wall.
#[test]
fn a_beach_before_a_dry_wall_has_its_runup_drawn() {
    let (_directory, mut data) = fixture::read(fixture::fixed());
    data.set_all(&FIRST_FORCE_MAX, "").set_all(&FIRST_RUNUP_MAX, "");
    data.set_all(&FORCE_MAX, 0.0).set_all(&FORCE_AT_REST, 0.0);
    let beach = figures(&data).remove(0);
    assert_eq!(beach.title, "Runup before a fixed wall");
    let told = "Largest runup of the whole run before a fixed wall against the wave height";
    assert!(beach.caption.starts_with(told), "{}", beach.caption);
    assert!(beach.caption.contains("no water comes to it"), "{}", beach.caption);
    let svg = beach.svg();
    assert!(svg.contains("\"runup_max\"") && !svg.contains("\"force_max\""), "{svg}");
    assert!(!svg.contains("Goda") && !svg.contains("exact solitary wave"), "{svg}");
    // A wave that reaches the wall presses on it.
    data.rows[0].set(&FORCE_MAX, 0.3);
    assert_eq!(figures(&data).remove(0).title, "Runup and force at a fixed wall");
}
