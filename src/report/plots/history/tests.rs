use std::fs;

use super::*;
use crate::quantities::summary::{FORCE_MAX, LOG10_K_STAR};
use crate::report::fixture;

fn drawn(directory: &tempfile::TempDir) -> Vec<Figure> {
    figures(&Loaded::read(directory.path()).unwrap()).unwrap()
}

#[test]
fn the_caption_says_what_was_picked_out_of_what() {
    let stiffnesses: Vec<f64> = (0..9).map(|power| 10_f64.powi(power)).collect();
    let figures = drawn(&fixture::movable(&[0.3, 0.5], &stiffnesses, &[50.0, 100.0, 250.0]));
    let told = "Shown are 6 of 27 finished cases of this wave height: 6 of 9 stiffnesses at \
                one of 3 masses.";
    assert!(figures[0].caption.ends_with(told), "{}", figures[0].caption);
    let few = drawn(&fixture::movable(&[0.5], &[10.0, 500.0], &[250.0]));
    assert!(!few[0].caption.contains("Shown"), "{}", few[0].caption);
}

/// The story: caissons were in no figure of histories.
#[test]
fn caissons_have_histories_too() {
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.5], &[10.0], &[50.0, 250.0]));
    data.set_all(&SPRING_STIFFNESS, "").set_all(&LOG10_K_STAR, "");
    let figure = figures(&data).unwrap().remove(0);
    let svg = figure.svg();
    assert!(svg.contains("caisson, m = 50 kg/m") && svg.contains("caisson, m = 250 kg/m"));
    assert!(figure.caption.contains("and displacement") && !figure.caption.contains("Shown"));
    // Caissons beside springs and a fixed wall have them as well.
    let stiffnesses: Vec<f64> = (0..7).map(|power| 10_f64.powi(power)).collect();
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.5], &stiffnesses, &[50.0]));
    data.rows[5].set(&SPRING_STIFFNESS, "").set(&SEAWALL_MASS, "");
    data.rows[4].set(&SPRING_STIFFNESS, "");
    data.rows.truncate(6);
    let caption = figures(&data).unwrap().remove(0).caption;
    assert!(!caption.contains("Shown"), "{caption}");
    data.rows.push(data.rows[4].clone().with(&SEAWALL_MASS, 70));
    data.rows.push(data.rows[4].clone().with(&SEAWALL_MASS, 90));
    let told = "Shown are 7 of 8 finished cases of this wave height: 4 of 4 stiffnesses, 2 of 3 \
                caissons, and the fixed wall.";
    let caption = figures(&data).unwrap().remove(0).caption;
    assert!(caption.ends_with(told), "{caption}");
    data.rows.iter_mut().for_each(|row| row.wall = Some("pontoon".into()));
    let figure = figures(&data).unwrap().remove(0);
    assert!(figure.caption.contains("2 of 3 pontoons") && figure.svg().contains("pontoon, m = "));
}

/// The story: a sweep over 36 crests of one wave made a page of 36 figures, with a line in each.
#[test]
fn cases_of_a_wave_that_differ_in_other_keys_share_a_figure() {
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.3, 0.5], &[10.0], &[50.0; 21]));
    let mut crests = 0..;
    data.rows.iter_mut().for_each(|row| {
        row.variant = format!("crest_freeboard_m = {}", crests.next().unwrap() % 21).into();
    });
    let both = figures(&data).unwrap();
    let names: Vec<_> = both.iter().map(|figure| &*figure.name).collect();
    assert_eq!(names, ["history-wave-0.3", "history-wave-0.5"]);
    let svg = both[0].svg();
    assert!(svg.contains("crest freeboard = 0 m") && svg.contains("crest freeboard = 20 m"));
    let caption = &both[0].caption;
    assert!(caption.contains("at the wall, k = 10 N/m, m = 50 kg/m, over"), "{caption}");
    let told = "Shown are 6 of 21 finished cases of this wave height: spread over their order.";
    assert!(caption.ends_with(told), "{caption}");
    // With two walls over each crest, a figure names one crest.
    data.set_all(&WAVE_HEIGHT_RATIO, 0.3);
    let each = figures(&data).unwrap();
    assert_eq!((each.len(), &*each[0].name), (6, "history-wave-0.3-crest-freeboard-m-0"));
    let told = "Of 21 combinations of other keys 6 have such a figure, spread evenly.";
    assert!(each[0].caption.ends_with(told), "{}", each[0].caption);
}

#[test]
fn scenes_without_a_wave_have_one_figure() {
    let figures = drawn(&fixture::dam_breaks(1));
    assert_eq!(figures.len(), 1);
    assert_eq!(figures[0].name, "history");
    assert!(figures[0].svg().contains("F / (½ρgh²)") && figures[0].svg().contains("R / h"));
    assert!(!figures[0].caption.contains("Shown"), "{}", figures[0].caption);
    let many = drawn(&fixture::dam_breaks(9));
    let told = "Shown are 6 of 9 finished cases without a wave: spread over their order.";
    assert!(many[0].caption.ends_with(told), "{}", many[0].caption);
    assert!(many[0].svg().contains("column height = 0.6 m"), "a legend tells them apart");
}

#[test]
fn a_quantity_that_is_naught_throughout_has_no_panel() {
    let directory = fixture::dam_breaks(1);
    let history = "time_s,force,runup,displacement\n0,1,0,0\n1,1.1,0,0\n";
    std::fs::write(directory.path().join("histories/case-0000.csv"), history).unwrap();
    let figures = drawn(&directory);
    assert!(figures[0].svg().contains("F / (½ρgh²)") && !figures[0].svg().contains("R / h"));
}

#[test]
fn a_fixed_wall_has_two_panels_and_a_caption_of_both() {
    let caption = &drawn(&fixture::fixed())[0].caption;
    assert!(caption.starts_with("Force (unfiltered) and runup at the wall"), "{caption}");
}

/// The story: a beach before a dry wall had a panel of a force of 0.
#[test]
fn a_wall_that_no_water_comes_to_has_no_panel_of_its_force() {
    let (directory, data) = fixture::read(fixture::fixed());
    let figure = |force: &str| {
        for row in data.finished() {
            let path = directory.path().join("histories").join(format!("{}.csv", row.id()));
            fs::write(
                path,
                format!("time_s,force,runup,displacement\n0,0,0.1,0\n0.1,{force},0.2,0\n"),
            )
            .unwrap();
        }
        figures(&Loaded::read(directory.path()).unwrap()).unwrap().remove(0)
    };
    let [dry, wet] = ["0", "0.3"].map(figure);
    assert!(!dry.svg().contains("\"force\"") && dry.svg().contains("\"runup\""));
    assert!(dry.caption.contains("no water comes: it has no force"), "{}", dry.caption);
    assert!(wet.svg().contains("\"force\"") && wet.caption.starts_with("Force"));
}

/// The story: an impact at a crest had F* = 28.7 as the page told it, and its panel ended at 24. An
/// impact on the stop, which no maximum has in it, still leaves the panel.
#[test]
fn a_panel_holds_the_maximum_that_is_quoted() {
    let (directory, mut data) = fixture::read(fixture::fixed());
    data.rows.truncate(1);
    let rows = |row: i32| match row {
        50 => "50,90,0.1,0\n".to_owned(),
        70 => "70,28.7,0.1,0\n".to_owned(),
        _ => format!("{row},1,0.1,0\n"),
    };
    let history: String = (0..100).map(rows).collect();
    let path = directory.path().join("histories").join(format!("{}.csv", data.rows[0].id()));
    fs::write(path, format!("time_s,force,runup,displacement\n{history}")).unwrap();
    data.rows[0].set(&FORCE_MAX, 28.7);
    let figure = figures(&data).unwrap().remove(0);
    let axis = &figure.drawing.charts[0].y;
    assert!(axis.share(28.7) < 1.0 && axis.share(40.0) == 1.0, "{axis:?}");
}
