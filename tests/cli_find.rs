//! `seawall find`: the part of a study that meets a condition, from the files of a real one.

use std::fs;
use std::path::Path;

use crate::common::{Desk, SOFT, TINY, column, ended};
use serde_json::Value;

const SPRINGS: &str =
    r#"spring_stiffness_n_per_m = { from = 1e2, to = 1e6, points = 5, spacing = "log" }"#;

fn find(out: &Path, condition: &str) -> Value {
    ended(0, &["find", out.to_str().unwrap(), condition, "--format", "json"]).json()
}

fn refused(out: &Path, condition: &str) -> String {
    let output = ended(2, &["find", out.to_str().unwrap(), condition]);
    assert!(output.out.is_empty());
    output.err
}

#[test]
fn a_condition_is_met_by_the_cases_of_the_summary_that_meet_it() {
    let desk = Desk::new(&format!("{SOFT}{SPRINGS}\n"));
    desk.sweep(&[]);
    let forces = column(&desk.out, "first_force_max");
    let forces: Vec<f64> = forces.iter().map(|cell| cell.parse().unwrap()).collect();
    assert_eq!(forces.len(), 5);
    let (least, most) = (forces[0], forces[4]);
    assert!(most > least + 0.1, "{forces:?}");
    let limit = 0.5 * (least + most);

    let found = find(&desk.out, &format!("first_force_max < {limit}"));
    let expected = forces.iter().filter(|force| **force < limit).count();
    assert_eq!(found["met"].as_u64(), Some(expected as u64));
    assert_eq!(found["meeting"].as_array().unwrap().len(), expected);
    let ends = found["boundaries"].as_array().unwrap();
    assert!(!ends.is_empty());
    for end in ends {
        assert_eq!(
            (end["key"].as_str(), end["scale"].as_str()),
            (Some("spring_stiffness_n_per_m"), Some("log"))
        );
        let [from, at, to] = ["from", "at", "to"].map(|name| end[name].as_f64().unwrap());
        assert!(1e2 <= from && from <= at && at <= to && to <= 1e6, "{end}");
        assert_eq!(end["basis"], "bend");
    }

    // The story: "how far off it may be" was told of ranges that no error bar had gone into.
    let text = ended(0, &["find", &desk.dir, &format!("first_force_max < {limit}")]).out;
    let bare = "not before, not after: the range of the interpolation\n\
                alone, as the cases have no error bars of these numbers\n";
    assert!(text.ends_with(bare), "{text}");
    let text = ended(0, &["find", &desk.dir, "first_force_max > 1"]).out;
    assert!(text.starts_with("5 of 5 cases meet first_force_max > 1"), "{text}");

    let told = refused(&desk.out, "first_force_mx < 2");
    assert!(told.contains("did you mean first_force_max?"), "{told}");
    let told = refused(&desk.out, "first_force_max ~ 2");
    assert!(told.contains("write COLUMN < NUMBER"), "{told}");

    // A study with a case that has not come to its end.
    let path = desk.out.join("summary.csv");
    let summary = fs::read_to_string(&path).unwrap();
    let shorter = summary.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(&path, format!("{shorter}\n")).unwrap();
    let told = refused(&desk.out, "first_force_max < 2");
    assert!(told.contains("the study is not finished, 1 case left"), "{told}");
}

#[test]
fn a_directory_without_a_study_is_told() {
    let root = tempfile::tempdir().unwrap();
    let told = refused(root.path(), "force_max < 2");
    assert!(told.contains("holds no summary.csv"), "{told}");
}

/// A wall with F* below 2 was listed without a word, and then hit its stop with far more.
#[test]
fn a_wall_that_hits_its_stop_is_marked_in_the_tables() {
    let longer = TINY.replace("end_after_stroke_centre_s = 0.8", "end_after_stroke_centre_s = 1.6");
    let desk = Desk::new(&longer);
    let swept = desk.sweep(&["--film", "none"]);
    let stopped = column(&desk.out, "stops").iter().filter(|stops| *stops != "0").count();
    assert!(stopped > 0);
    let line = "* the wall hit its stop afterwards; no maximum counts the load of that hit\n";
    let text = swept.out;
    assert_eq!((text.matches(" *  ").count(), text.matches(line).count()), (stopped, 1), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");

    let told = ended(0, &["find", &desk.dir, "force_max < 100"]).out;
    let marked = told.lines().filter(|line| line.ends_with('*')).count();
    assert_eq!((marked, told.matches(line).count()), (stopped, 1), "{told}");
    let value = find(&desk.out, "force_max < 100");
    let hits = value["meeting"].as_array().unwrap().iter().filter(|case| case["hits_stop"] == true);
    assert_eq!(hits.count(), stopped);
}

/// Steps were told as 814.0.
#[test]
fn counts_are_told_whole() {
    let desk = Desk::new(TINY);
    desk.sweep(&["--film", "none"]);
    let (ids, told) =
        (column(&desk.out, "case_id"), ended(0, &["find", &desk.dir, "steps > 1"]).out);
    let words: Vec<_> = told.split_whitespace().collect();
    let before = words.windows(2).filter(|pair| ids.iter().any(|id| id == pair[1]));
    let steps: Vec<_> = before.map(|pair| pair[0].to_owned()).collect();
    assert_eq!(steps, column(&desk.out, "steps"), "{told}");
}

/// A range of stiffnesses reached far past the grid, and a condition on a key came back as a boundary.
#[test]
fn boundaries_keep_to_the_grid_and_say_what_the_condition_does_not() {
    let desk = Desk::new(TINY);
    desk.sweep(&["--film", "none"]);
    let told = |condition: &str| ended(0, &["find", &desk.dir, condition]).out;
    let one = told("H/h = 0.5 and k = 1e4 and m = 50");
    assert!(one.starts_with("1 of 8 cases meets wave_height_ratio = 0.5 and "), "{one}");
    let key = told("k < 1000");
    assert!(key.starts_with("4 of 8 cases meet") && !key.contains("where it begins"), "{key}");
    let both = told("H/h = 0.5 and X* < 1");
    assert!(both.contains("not before, not after: how far off it may be\n"), "{both}");
    let along = both.split("where it begins and ends\n").nth(1).unwrap();
    assert!(along.lines().skip(1).all(|line| !line.trim_start().starts_with("H/h")), "{along}");
    assert!(
        told("X* = 1").ends_with("= holds to four digits; < and > tell where a value is crossed\n")
    );
}

#[test]
fn ranges_with_error_bars_tell_how_far_off_a_boundary_may_be() {
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let desk = Desk::new(&text.replace("[grid]", "error_bars = \"pair\"\n[grid]"));
    desk.sweep(&["--film", "none"]);
    let forces = column(&desk.out, "first_force_max");
    let limit: f64 = forces.iter().map(|cell| cell.parse::<f64>().unwrap() / 2.0).sum();
    let told = ended(0, &["find", &desk.dir, &format!("first_force_max < {limit}")]).out;
    assert!(told.contains("not before, not after: how far off it may be\n"), "{told}");
    let raw = column(&desk.out, "force_max_raw");
    let limit: f64 = raw.iter().map(|cell| cell.parse::<f64>().unwrap() / 2.0).sum();
    let told = ended(0, &["find", &desk.dir, &format!("force_max_raw < {limit}")]).out;
    assert!(told.contains("as the cases have no error bars of these numbers\n"), "{told}");
}

/// The story: "above 0.2406 m" was told of F*, which is over another depth at the wall in the next case.
#[test]
fn boundaries_between_depths_say_that_the_unit_changes() {
    let scene = TINY
        .split("[grid]")
        .next()
        .unwrap()
        .replace("wall = \"movable\"", "wave_height_ratio = 0.4");
    let desk = Desk::new(&format!("{scene}[grid]\nstill_water_depth_m = [0.2, 0.25]\n"));
    desk.sweep(&[]);
    let forces = column(&desk.out, "force_max");
    let forces: Vec<f64> = forces.iter().map(|cell| cell.parse().unwrap()).collect();
    let find = |condition: &str| ended(0, &["find", &desk.dir, condition]).out;
    let note = "numbers with a star are over each case's own depth";
    let told = find(&format!("force_max < {}", 0.5 * (forces[0] + forces[1])));
    assert!(told.contains(note), "{forces:?}: {told}");
    let told = find("still_water_depth_m < 0.22");
    assert!(!told.contains(note), "{told}");
}
