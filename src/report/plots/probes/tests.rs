use super::*;
use crate::report::fixture;

/// A gauge that reads 1 and then 2.
fn gauge(name: &str, unit: &str) -> Series {
    let (name, unit) = (name.to_owned(), unit.to_owned());
    Series { name, unit, points: vec![(0.0, 1.0), (1.0, 2.0)], ..Series::default() }
}

#[test]
fn every_unit_has_a_panel() {
    let data = Loaded::read(fixture::dam_breaks(1).path()).unwrap();
    assert!(figures(&data).unwrap().is_empty(), "the directory is gone");
    let (_directory, data) = fixture::read(fixture::dam_breaks(1));
    let figures = figures(&data).unwrap();
    assert_eq!(figures.len(), 1);
    for word in ["p, kPa", "level, m", "P1", "front"] {
        assert!(figures[0].svg().contains(word), "{word}");
    }
    assert!(!figures[0].caption.contains("Shown"));
}

/// The story: a crest that no water passed had four panels of 0, and so had every case.
#[test]
fn panels_of_naught_are_left_out() {
    let (_directory, data) = fixture::read(fixture::dam_breaks(1));
    let path = data.directory.join("probes").join(format!("{}.csv", data.rows[0].id()));
    let text = |value: &str| format!("time_s,P1,front\n0,0,0\n0.1,{value},-3e-14\n");
    std::fs::write(&path, text("1e-14")).unwrap();
    assert!(figures(&data).unwrap().is_empty());
    std::fs::write(&path, text("5")).unwrap();
    let figure = figures(&data).unwrap().remove(0);
    assert!(figure.svg().contains("P1") && !figure.svg().contains("front"));
    assert!(figure.caption.contains("nothing but 0 are left out"), "{}", figure.caption);
}

#[test]
fn of_many_cases_a_few_are_shown_and_the_caption_says_so() {
    let directory = fixture::dam_breaks(9);
    let figures = figures(&Loaded::read(directory.path()).unwrap()).unwrap();
    assert_eq!(figures.len(), 4);
    for figure in &figures {
        assert!(figure.caption.contains("Shown are 4 of 9 cases"), "{}", figure.caption);
    }
    assert_eq!(figures[0].title, "Gauges, column height = 0.6 m");
}

#[test]
fn many_gauges_are_split_so_that_colours_differ() {
    let gauges: Vec<_> = (0..9).map(|index| gauge(&format!("P{index}"), "Pa")).collect();
    let strips = strips("a", &gauges);
    assert_eq!(strips.iter().map(|s| s.curves.len()).collect::<Vec<_>>(), [6, 3]);
    assert_eq!(strips[1].curves[0].points[0], (0.0, 1e-3), "in kPa");
}

/// The story: five gauges with five units were five blue lines without names.
#[test]
fn panels_say_whose_they_are() {
    let gauges = [gauge("P1", "Pa"), gauge("V", "m2"), gauge("P2", "Pa"), gauge("Q", "m2/s")];
    let strips = strips("a", &gauges);
    assert!(strips.iter().all(|strip| strip.legend), "each panel names its own");
    let told = strips.iter().map(|strip| strip.title.as_str());
    assert_eq!(told.collect::<Vec<_>>(), ["p, kPa", "volume, m²", "discharge, m²/s"]);
    let crest = [gauge("G1", "m"), gauge("crest_thickness_m", "m")];
    let told = super::strips("a", &crest).into_iter().map(|strip| strip.title);
    assert_eq!(told.collect::<Vec<_>>(), ["level, m", "crest thickness, m"]);
    // The story: an elevation had the axis of a level, though it does not start at the bed.
    let [level, mut elevation] = [gauge("G1", "m"), gauge("G2", "m")];
    elevation.method = "surface over still water where kernel coverage falls to 1/2".to_owned();
    let told = super::strips("a", &[level, elevation]).into_iter().map(|strip| strip.title);
    assert_eq!(told.collect::<Vec<_>>(), ["level, m", "surface over still water, m"]);
    let looks: Vec<_> =
        strips.iter().flat_map(|strip| &strip.curves).map(|line| line.entry.clone()).collect();
    let own = |index: usize, name: &str| Line::new(index, name, "a", Vec::new()).entry;
    assert_eq!(looks, [own(0, "P1"), own(1, "P2"), own(0, "V"), own(0, "Q")]);
}

/// The story: beside a gauge called "qberm" the discharge over a crest had no name, and in the
/// one legend of all panels eight gauges had the colours of the crest's columns.
#[test]
fn a_panel_names_its_own_curves_in_its_own_colours() {
    let mut gauges: Vec<_> = (1..9).map(|k| gauge(&format!("G{k}"), "m")).collect();
    gauges.extend([gauge("qberm", "m2/s"), gauge("overtopping_discharge_m2_per_s", "m2/s")]);
    gauges.extend([gauge("crest_thickness_m", "m"), gauge("crest_speed_m_per_s", "m/s")]);
    let svg = over_time::strips(&strips("a", &gauges)).svg(3);
    let panels: Vec<_> = svg.split("class=\"panel\"").skip(1).collect();
    let named = [
        ["G1", "G6"],
        ["G7", "G8"],
        ["qberm", "overtopping discharge"],
        ["crest thickness", "hue-0"],
        ["crest speed", "hue-0"],
    ];
    assert_eq!(panels.len(), named.len());
    for (panel, names) in panels.iter().zip(named) {
        for name in names {
            assert!(panel.contains(name), "{name}: {panel}");
        }
        let samples = panel.matches("sample hue-").count();
        let hues = (0..6).filter(|hue| panel.contains(&format!("sample hue-{hue}"))).count();
        assert_eq!(samples, hues, "no colour twice: {panel}");
    }
}

/// The story: the volume over a crest stood on the axis of a probe of the whole tank, as a flat
/// line.
#[test]
fn volumes_of_another_size_have_a_panel_of_their_own() {
    let volume = |name: &str, largest: f64| Series {
        points: vec![(0.0, 0.0), (1.0, largest)],
        ..gauge(name, "m2")
    };
    let all = [
        volume("tank", 4.5),
        volume("dry", 0.0),
        volume("behind", 0.012),
        volume("half", 2.0),
        volume("overtopping_volume_m2", 0.015),
    ];
    let strips = strips("a", &all);
    let names = |strip: &Strip| -> Vec<String> {
        strip.curves.iter().map(|line| line.entry.label.clone()).collect()
    };
    let told: Vec<_> = strips.iter().map(names).collect();
    assert_eq!(told, [vec!["tank", "dry", "half"], vec!["behind", "V over"]]);
}
