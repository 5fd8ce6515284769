//! The whole report of made-up studies.

use super::*;

#[test]
fn the_same_files_give_the_same_bytes() {
    let directory = fixture::sweep();
    let read = |name: &str| fs::read(directory.path().join(name)).unwrap();
    let page = write(directory.path()).unwrap().page;
    assert_eq!(page, directory.path().join("report.html"));
    let names = ["report.html", "figures/response-force.svg", "tables/summary.csv"];
    let first = names.map(read);
    write(directory.path()).unwrap();
    assert_eq!(first, names.map(read));
}

/// The story: figures for print kept old error bars, and `verify` found nothing wrong.
#[test]
fn files_for_print_last_as_long_as_their_figure() {
    let directory = fixture::sweep();
    write(directory.path()).unwrap();
    let at = |name: &str| directory.path().join(name);
    let ours = "figures/response-force-84mm-1.pdf";
    let theirs = at("figures/response-force-mine.pdf");
    [at(ours), theirs.clone()].iter().for_each(|path| fs::write(path, "").unwrap());
    assert!(write(directory.path()).unwrap().made.iter().any(|made| made == ours));
    assert!(at(ours).is_file());
    fs::write(at("figures/response-force.svg"), "what it was").unwrap();
    assert!(write(directory.path()).unwrap().made.iter().all(|made| made != ours));
    assert!(!at(ours).exists() && theirs.is_file());
}

#[test]
fn a_sweep_in_which_every_case_failed_still_has_a_page() {
    let directory = fixture::sweep();
    let path = directory.path().join("summary.csv");
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<_> = text.lines().collect();
    fs::write(&path, format!("{}\n{}\n", lines[0], lines[lines.len() - 1])).unwrap();
    let page = fs::read_to_string(write(directory.path()).unwrap().page).unwrap();
    assert!(page.contains("None came to its end"));
}

/// The story: a study that was interrupted before its first case ended made `report` panic.
#[test]
fn a_study_without_a_case_still_has_a_page() {
    let directory = fixture::dam_breaks(0);
    let file = "[scene]\nkind = \"dam-break\"\n[grid]\ncolumn_height_m = [0.3, 0.6]\n";
    let manifest = serde_json::json!({
        "name": "fixture", "keys": ["column_height_m"], "cases": 2, "sweep_file": file
    });
    fs::write(directory.path().join("manifest.json"), manifest.to_string()).unwrap();
    let page = fs::read_to_string(write(directory.path()).unwrap().page).unwrap();
    assert!(page.contains("fixture"));
}
