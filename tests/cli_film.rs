//! `seawall film`, `run --film` and `sweep --film`, from outside.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{TINY, expect_code, results, run, write_file};

/// Two waves on one wall, coarse.
fn swept(directory: &Path, films: &[&str]) -> PathBuf {
    let text = TINY
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.04");
    let (file, out) = (write_file(directory, &text), directory.join("out"));
    let arguments = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    expect_code(&run(&[&arguments[..], films].concat()), 0);
    out
}

fn films(out: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(out.join("films")) else { return Vec::new() };
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let mut names: Vec<_> = entries.map(|entry| name(entry.unwrap())).collect();
    names.sort();
    names
}

#[test]
fn a_case_is_filmed_only_where_it_comes_out_the_same() {
    let root = tempfile::tempdir().unwrap();
    let out = swept(root.path(), &[]);
    let before = results(&out);
    let film = |words: &[&str]| run(&[&["film", out.to_str().unwrap()], words].concat());
    let told = |words: &[&str], code: i32| {
        let output = film(words);
        expect_code(&output, code);
        String::from_utf8(output.stderr).unwrap()
    };
    let near = told(&["wave_hight_ratio=0.5"], 2);
    assert!(
        near.contains("wave_hight_ratio: unknown key; did you mean wave_height_ratio?"),
        "{near}"
    );
    assert!(told(&[], 2).contains("2 cases fit; say which one by wave_height_ratio (0.4, 0.5)"));
    assert!(films(&out).is_empty());

    assert!(told(&["wave_height_ratio=0.5"], 0).contains("the same to the bit"));
    let names = films(&out);
    assert!(names.len() == 2 && names[0].ends_with(".html") && names[1].ends_with(".svg"));
    assert_eq!(results(&out), before, "a film changes no result");

    fs::remove_dir_all(out.join("films")).unwrap();
    let history = out.join("histories").join(names[1].replace(".svg", ".csv"));
    let text = fs::read_to_string(&history).unwrap();
    let line = text.lines().nth(100).unwrap();
    fs::write(&history, text.replacen(line, &format!("{line}1"), 1)).unwrap();
    let planted = told(&["wave_height_ratio=0.5"], 1);
    assert!(planted.contains("did not come out the same: line 101 of the history is"), "{planted}");
    assert!(films(&out).is_empty(), "no film of something else is left");
}

#[test]
fn a_sweep_films_what_is_worth_a_look_and_its_report_links_to_it() {
    let root = tempfile::tempdir().unwrap();
    let plain = swept(root.path(), &[]);
    let before = results(&plain);
    assert!(films(&plain).is_empty());
    let out = swept(root.path(), &["--film", "auto", "--fresh"]);
    assert_eq!(results(&out), before);
    let pages: Vec<_> = films(&out).into_iter().filter(|name| name.ends_with(".html")).collect();
    assert!(!pages.is_empty());
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(pages.iter().all(|page| report.contains(&format!("films/{page}"))));
}

#[test]
fn a_film_that_cannot_be_is_refused_before_anything_runs() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    let out = root.path().join("out");
    let arguments = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let output = run(&[&arguments[..], &["--film", "wave_height_ratio=0.45"]].concat());
    expect_code(&output, 2);
    assert!(String::from_utf8_lossy(&output.stderr).contains("there is 0.4, 0.5"));
    assert!(!out.exists());
}

#[test]
fn a_run_is_filmed_also_when_it_is_finished() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.split("[grid]").next().unwrap().replace(
        "wall = \"movable\"",
        "wall = \"movable\"\nspring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50",
    );
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let arguments = ["run", file.to_str().unwrap(), "--out", out.to_str().unwrap(), "--film"];
    expect_code(&run(&arguments), 0);
    let name = films(&out)[0].clone();
    let page = fs::read(out.join("films").join(&name)).unwrap();
    assert!(page.len() < 400_000);
    fs::remove_dir_all(out.join("films")).unwrap();
    expect_code(&run(&arguments), 0);
    assert_eq!(fs::read(out.join("films").join(&name)).unwrap(), page);
    let speed = run(&[&arguments[..], &["speed"]].concat());
    expect_code(&speed, 0);
    assert_ne!(fs::read(out.join("films").join(&name)).unwrap(), page);
}
