//! `seawall film`, `run --film` and `sweep --film`, from outside.

mod common;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use common::{TINY, expect_code, results, run, seawall, write_file};

/// Two waves on one wall, coarse.
fn swept(directory: &Path, films: &[&str]) -> PathBuf {
    let text = TINY
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.03");
    let (file, out) = (write_file(directory, &text), directory.join("out"));
    let arguments = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    expect_code(&run(&[&arguments[..], films].concat()), 0);
    out
}

/// Pages and stills.
fn films(out: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(out.join("films")) else { return Vec::new() };
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let names = entries.map(|entry| name(entry.unwrap()));
    let mut names: Vec<_> = names.filter(|name| name != "reasons.csv").collect();
    names.sort();
    names
}

#[test]
fn a_case_is_filmed_only_where_it_comes_out_the_same() {
    let root = tempfile::tempdir().unwrap();
    let out = swept(root.path(), &["--film", "none"]);
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
    let [furthest, highest, page, crest] = &names[..] else { panic!("{names:?}") };
    assert!(page.ends_with(".html") && crest.ends_with(".svg"), "{names:?}");
    assert_eq!(*furthest, page.replace(".html", "-furthest.svg"));
    assert_eq!(
        *highest,
        page.replace(".html", "-highest.svg"),
        "another frame than the largest force"
    );
    let moment = |still: &str| {
        let text = fs::read_to_string(out.join("films").join(still)).unwrap();
        let words = text.split("X* = ").nth(1).unwrap().split([' ', '"']).next().unwrap();
        words.parse::<f64>().unwrap()
    };
    assert!(moment(furthest) > 2.0 * moment(crest), "the wall went on after the largest force");
    let still = fs::read_to_string(out.join("films").join(furthest)).unwrap();
    assert!(
        still.contains("(dashed: the wall at rest)") && still.contains("stroke-dasharray"),
        "where it stood"
    );
    let report = run(&["report", out.to_str().unwrap()]);
    expect_code(&report, 0);
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert_eq!(report.matches("class=\"still\"").count(), 2, "both stills are in the report");
    assert_eq!(results(&out), before, "a film changes no result");

    fs::remove_dir_all(out.join("films")).unwrap();
    let history = out.join("histories").join(crest.replace(".svg", ".csv"));
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
    let plain = swept(root.path(), &["--film", "none"]);
    let before = results(&plain);
    assert!(films(&plain).is_empty());
    let out = swept(root.path(), &["--fresh"]);
    assert_eq!(results(&out), before);
    let pages: Vec<_> = films(&out).into_iter().filter(|name| name.ends_with(".html")).collect();
    assert!(!pages.is_empty());
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(pages.iter().all(|page| report.contains(&format!("films/{page}"))));
    let reasons = fs::read_to_string(out.join("films/reasons.csv")).unwrap();
    assert_eq!(reasons.lines().count(), 1 + pages.len(), "{reasons}");
    for line in reasons.lines().skip(1) {
        let (id, reason) = line.split_once(',').unwrap();
        assert!(pages.contains(&format!("{id}.html")), "{reasons}");
        assert!(report.contains(&format!("({}) <a href=\"films/{id}", reason.trim_matches('"'))));
    }

    // What is there is not made again; what is missing is.
    let page = out.join("films").join(&pages[0]);
    let written = || fs::metadata(&page).unwrap().modified().unwrap();
    let first = written();
    swept(root.path(), &[]);
    assert_eq!(written(), first);
    fs::remove_file(&page).unwrap();
    swept(root.path(), &[]);
    assert!(page.exists());

    // The time at the end is that of the cases; that of films stands beside it.
    fs::remove_file(&page).unwrap();
    let file = root.path().join("sweep.toml");
    let command = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let told = String::from_utf8(run(&command).stdout).unwrap();
    assert!(told.contains("2 of 2 cases are well; films "), "{told}");
    let told = String::from_utf8(run(&["check", file.to_str().unwrap()]).stdout).unwrap();
    assert!(told.lines().any(|line| line.ends_with(", without films")), "{told}");

    // A call that makes none tells them all the same.
    let output = run(&[&command[..], &["--format", "json"]].concat());
    expect_code(&output, 0);
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let names = value["films"].as_array().unwrap().iter().map(|path| path.as_str().unwrap());
    let names: Vec<_> = names.map(|path| path.rsplit('/').next().unwrap().to_owned()).collect();
    assert_eq!(names, pages);
    assert_eq!(value["film_time_s"], 0.0);
}

#[test]
fn a_film_that_cannot_be_written_costs_no_result() {
    let root = tempfile::tempdir().unwrap();
    let plain = swept(root.path(), &["--film", "none"]);
    let before = results(&plain);
    fs::write(plain.join("films"), "in the way").unwrap();
    let file = root.path().join("sweep.toml");
    let (file, out) = (file.to_str().unwrap(), plain.to_str().unwrap());
    let output = run(&["sweep", file, "--out", out]);
    expect_code(&output, 0);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("not filmed: ") && told.contains("out/films: "), "{told}");
    assert_eq!(results(&plain), before);
    expect_code(&run(&["film", out, "wave_height_ratio=0.5"]), 1);
    // What is kept beside the page cannot be written: as for `report` no error of the program.
    fs::remove_file(plain.join("derived.json")).unwrap();
    fs::create_dir(plain.join("derived.json")).unwrap();
    expect_code(&run(&["film", out, "wave_height_ratio=0.5"]), 2);

    let alone = root.path().join("alone");
    let case = ["run", file, "wave_height_ratio=0.5", "--out", alone.to_str().unwrap(), "--film"];
    expect_code(&run(&case), 0);
    fs::remove_dir_all(alone.join("films")).unwrap();
    fs::write(alone.join("films"), "in the way").unwrap();
    let journal = alone.join("journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, format!("{}\n", text.lines().next().unwrap())).unwrap();
    let output = run(&case);
    expect_code(&output, 0);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("warning: case") && told.contains("not filmed: "), "{told}");
    let name = fs::read_dir(alone.join("histories")).unwrap().next().unwrap().unwrap().file_name();
    let history = |out: &Path| fs::read(out.join("histories").join(&name)).unwrap();
    assert_eq!(history(&alone), history(&plain));
}

#[test]
fn an_interrupted_film_is_made_by_the_same_command() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY
        .replace("[0.4, 0.5]", "[0.5]")
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.01");
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let (file, path) = (file.to_str().unwrap(), out.to_str().unwrap());
    expect_code(&run(&["sweep", file, "--out", path, "--film", "none"]), 0);
    let before = results(&out);
    let mut child = seawall()
        .args(["sweep", file, "--out", path])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let told = BufReader::new(child.stderr.take().unwrap()).lines();
    let mut told = told.map(Result::unwrap).skip_while(|line| line != "filming 1 case");
    assert!(told.next().is_some());
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let rest: Vec<_> = told.collect();
    assert_eq!(child.wait().unwrap().code(), Some(3), "{rest:?}");
    assert!(films(&out).is_empty() && !out.join("films/reasons.csv").exists());
    expect_code(&run(&["sweep", file, "--out", path]), 0);
    assert!(films(&out).len() == 4 && out.join("films/reasons.csv").exists());
    assert_eq!(results(&out), before);
}

#[test]
fn cases_whose_numerics_were_chosen_are_filmed_verified_and_told() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "courant_number = 1.4");
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let (file, path) = (file.to_str().unwrap(), out.to_str().unwrap());
    // The first spacings do not do for all: a second round runs finer.
    let sweep = ["sweep", file, "--out", path, "--max-error", "0.6", "--film", "none"];
    let output = run(&sweep);
    expect_code(&output, 0);
    let before = results(&out);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("these run once more with finer particles"), "{told}");
    for wave in ["wave_height_ratio=0.4", "wave_height_ratio=0.5"] {
        let output = run(&["film", path, wave]);
        expect_code(&output, 0);
        let text = run(&["show", path, wave, "--toml"]);
        expect_code(&text, 0);
        let scene = root.path().join("scene.toml");
        fs::write(&scene, &text.stdout).unwrap();
        let check = run(&[
            "run",
            scene.to_str().unwrap(),
            "--out",
            root.path().join(wave).to_str().unwrap(),
        ]);
        expect_code(&check, 0);
    }
    assert_eq!(films(&out).len(), 8);
    assert_eq!(results(&out), before);
    let mut again = fs::read_dir(out.join("histories")).unwrap().map(|entry| entry.unwrap());
    let is_there = |entry: &fs::DirEntry| {
        let alone =
            ["0.4", "0.5"].map(|wave| root.path().join(format!("wave_height_ratio={wave}")));
        alone.iter().any(|out| out.join("histories").join(entry.file_name()).exists())
    };
    assert_eq!(again.by_ref().filter(is_there).count(), 2, "the scene files are those cases");
    expect_code(&run(&["verify", path, "--rerun", "1"]), 0);
    // A summary that is lost comes back from the journal.
    let summary = fs::read(out.join("summary.csv")).unwrap();
    fs::remove_file(out.join("summary.csv")).unwrap();
    fs::write(out.join("summary.csv"), "case_id\n").unwrap();
    expect_code(&run(&["report", path]), 0);
    assert_eq!(fs::read(out.join("summary.csv")).unwrap(), summary);
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
    let text = text.replace("[numerics]", "[numerics]\nerror_bars = \"pair\"");
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let arguments = ["run", file.to_str().unwrap(), "--out", out.to_str().unwrap(), "--film"];
    expect_code(&run(&arguments), 0);
    // Its companion for error bars is not filmed, and what it tells is told.
    let again = |more: &[&str]| run(&[&arguments[..4], more].concat()).stdout;
    let record: serde_json::Value = serde_json::from_slice(&again(&["--format", "json"])).unwrap();
    let id = record["id"].as_str().unwrap();
    assert!(films(&out).iter().all(|name| name.starts_with(id)), "{:?}", films(&out));
    let bar = record["error_bars"]["force_max_error"].as_f64().unwrap();
    let summary = fs::read_to_string(out.join("summary.csv")).unwrap();
    assert!(bar > 0.0 && summary.contains(&format!(",{bar},")), "{bar} in {summary}");
    let told = String::from_utf8(again(&[])).unwrap();
    let force = told.lines().find(|line| line.starts_with("F* max ")).unwrap();
    assert!(force.contains('±') && !told.contains("error"), "{told}");
    let name = films(&out)[1].clone();
    let page = fs::read(out.join("films").join(&name)).unwrap();
    assert!(page.len() < 400_000);
    fs::remove_dir_all(out.join("films")).unwrap();
    expect_code(&run(&arguments), 0);
    assert_eq!(fs::read(out.join("films").join(&name)).unwrap(), page);
    let speed = run(&[&arguments[..], &["speed"]].concat());
    expect_code(&speed, 0);
    assert_ne!(fs::read(out.join("films").join(&name)).unwrap(), page);
}
