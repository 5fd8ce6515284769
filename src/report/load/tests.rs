use super::*;
use crate::report::fixture;
use serde_json::json;

#[test]
fn reads_failed_rows_and_ignores_columns_it_does_not_know() {
    let (_directory, loaded) = fixture::read(fixture::sweep());
    assert_eq!(loaded.failed().count(), 1);
    let failed = loaded.failed().next().unwrap();
    assert_eq!(failed.number(&summary::FIRST_FORCE_MAX), None);
    assert!(failed.text(&summary::REASON).starts_with("runaway-speed"));
    assert_eq!(loaded.name(), Some("fixture"));
    let first = loaded.rows[0].text(&summary::CASE_ID);
    assert!(loaded.history(first).unwrap().points("force").len() > 100);
    assert!(loaded.history("no-such-case").unwrap().0.is_empty());
}

#[test]
fn a_missing_column_is_named_with_its_file() {
    let directory = fixture::sweep();
    let path = directory.path().join("summary.csv");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace(",first_runup_max,", ",first_runup,")).unwrap();
    let told = Loaded::read(directory.path()).unwrap_err().to_string();
    assert!(told.ends_with("summary.csv: no column \"first_runup_max\""), "{told}");
}

#[test]
fn a_cell_that_is_no_number_is_named_with_file_and_line() {
    let directory = fixture::sweep();
    let path = directory.path().join("summary.csv");
    let text = fs::read_to_string(&path).unwrap();
    let broken = text.replacen(",ok,,0.3,", ",ok,,high,", 1);
    assert_ne!(text, broken);
    fs::write(&path, broken).unwrap();
    let told = Loaded::read(directory.path()).unwrap_err().to_string();
    assert!(told.contains("summary.csv, line "), "{told}");
    assert!(told.contains(", column \"wave_height_ratio\": "), "{told}");
}

#[test]
fn an_absent_summary_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let told = Loaded::read(directory.path()).unwrap_err().to_string();
    assert!(told.starts_with("cannot read ") && told.contains("summary.csv"), "{told}");
}

#[test]
fn what_an_interrupted_sweep_has_not_come_to_is_left() {
    let rows = vec![Default::default(); 5];
    let loaded =
        |manifest| Loaded { rows: rows.clone(), manifest: Some(manifest), ..Loaded::default() };
    assert_eq!(loaded(json!({ "cases": 8 })).left(), 3);
    assert_eq!(loaded(json!({ "cases": 5 })).left(), 0);
    assert_eq!(loaded(json!({})).left(), 0);
}

/// The story: any wall with a mass and without a spring was called a caisson.
#[test]
fn a_wall_without_a_spring_is_what_the_file_calls_it() {
    let directory = fixture::sweep();
    let kind = || Loaded::read(directory.path()).unwrap().rows[0].kind().to_owned();
    assert_eq!(kind(), "caisson", "no file says");
    let manifest = json!({ "sweep_file": "[scene]\nwall = \"pontoon\"" });
    fs::write(directory.path().join("manifest.json"), manifest.to_string()).unwrap();
    assert_eq!(kind(), "pontoon");
    let (summary, swept) = (directory.path().join("summary.csv"), "wall\n");
    let text = fs::read_to_string(&summary).unwrap().replacen("colour\n", swept, 1);
    fs::write(&summary, text).unwrap();
    assert_eq!(kind(), "blue", "a swept key");
}
