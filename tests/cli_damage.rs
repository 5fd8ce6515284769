//! Files of a study that are damaged or missing: what is told of them, and what mends them.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{
    Desk, TINY, Told, ended, journal_lines, run, seawall, sweep, with_gauge, write_file,
};

/// The files in a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// No case has to run for it: the study tells what the columns of probes hold.
#[test]
fn what_columns_of_probes_hold_is_told_and_mended() {
    let desk = Desk::new(&with_gauge(TINY));
    sweep(0, &desk.file, &desk.out, &[]);
    let path = desk.out.join("probes/columns.csv");
    let (before, lines) = (fs::read(&path).unwrap(), journal_lines(&desk.out));
    for report in [true, false] {
        for damaged in [None, Some("name,unit,method\n")] {
            match damaged {
                Some(text) => fs::write(&path, text).unwrap(),
                None => fs::remove_file(&path).unwrap(),
            }
            let words = ended(1, &["verify", &desk.dir]).out;
            assert_eq!(words, "probes/columns.csv is damaged or missing\n");
            if report {
                ended(0, &["report", &desk.dir]);
            } else {
                sweep(0, &desk.file, &desk.out, &[]);
            }
            assert_eq!(fs::read(&path).unwrap(), before);
            ended(0, &["verify", &desk.dir]);
        }
    }
    assert_eq!(journal_lines(&desk.out), lines, "no case ran again");
}

/// The story: a film of a study was refused as its cases were not those of its sweep file, which nobody had touched.
#[test]
fn a_recorded_stroke_that_has_changed_is_named() {
    let text = "name = \"a\"\n[scene]\npaddle = \"recorded-stroke\"\nend_time_s = 0.1\nrecorded_stroke = \"STROKE\"\n\
                [numerics]\nparticle_spacing_m = 0.05\n[grid]\nwave_height_ratio = [0.1]\n";
    let folder = tempfile::tempdir().unwrap();
    let stroke = folder.path().join("stroke.csv");
    let write = |end: f64| {
        fs::write(&stroke, format!("time_s,stroke_m\n0,0\n0.5,0.01\n1,{end}\n")).unwrap();
    };
    write(0.02);
    let desk = Desk::new(&text.replace("STROKE", stroke.to_str().unwrap()));
    sweep(0, &desk.file, &desk.out, &[]);
    ended(0, &["verify", &desk.dir, "--rerun", "1"]);
    write(0.03);
    let told = ended(2, &["verify", &desk.dir]).err;
    assert!(told.contains("scene.recorded_stroke names a file that may have changed"), "{told}");
}

/// The story: away from the file of its stroke a study could not be checked, and a report took changed data for good.
#[test]
fn a_study_is_checked_without_the_file_of_its_stroke() {
    let start = "name = \"a\"\n[scene]\npaddle = \"recorded-stroke\"\nend_time_s = 0.1\n";
    let numerics = "[numerics]\nparticle_spacing_m = 0.05\n[grid]\n";
    let named = "recorded_stroke = \"stroke.csv\"\n";
    checked_without_its_stroke(
        "scene",
        &format!("{start}{named}{numerics}boundary = [\"improved-shepard\"]\n"),
    );
    let swept = named.replace("\"stroke.csv\"", "[\"stroke.csv\"]");
    checked_without_its_stroke("grid", &format!("{start}{numerics}{swept}"));
}

/// The section names the file of the stroke.
fn checked_without_its_stroke(section: &str, text: &str) {
    let desk = Desk::new(text);
    fs::write(desk.path().join("stroke.csv"), "time_s,stroke_m\n0,0\n0.5,0.01\n1,0.02\n").unwrap();
    let at = |code: i32, folder: &Path, words: &[&str]| {
        Told::of(seawall().args(words).current_dir(folder).output().unwrap(), code)
    };
    at(0, desk.path(), &["sweep", &desk.file, "--out", &desk.dir, "--film", "none"]);
    let away = tempfile::tempdir().unwrap();
    let missing = &format!(
        "{section}.recorded_stroke: there is no file stroke.csv, sought from the folder where the program"
    );
    let told = at(0, away.path(), &["verify", &desk.dir]);
    assert_eq!(told.out, "1 case: every file is as it was written\n");
    assert!(told.err.contains("not compared with the journal") && told.err.contains(missing));
    let told = at(0, away.path(), &["report", &desk.dir]).err;
    assert!(told.contains(missing), "{told}");
    let told = at(2, away.path(), &["verify", &desk.dir, "--rerun", "1"]).err;
    assert!(told.contains(missing), "{told}");
    let history = files(&desk.out.join("histories")).swap_remove(0);
    let changed = fs::read_to_string(&history).unwrap().replace('1', "2");
    fs::write(&history, changed).unwrap();
    let damaged = format!("{} is damaged", history.display());
    let told = at(1, away.path(), &["verify", &desk.dir]).out;
    assert_eq!(told, format!("{damaged}\n"));
    let told = at(1, away.path(), &["report", &desk.dir]).err;
    assert!(told.contains(&damaged) && told.contains("1 file left out"), "{told}");
}

/// The story: with a history gone, `verify --rerun` ended with 70 and kept for itself what else it had found. A film
/// whose history had other line ends was told to have \"365 lines, not 365\".
#[test]
fn what_runs_again_is_held_against_damaged_files() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let cases = crate::common::column(&desk.out, "case_id");
    let history = |case: &str| desk.out.join(format!("histories/{case}.csv"));
    let whole = fs::read(history(&cases[0])).unwrap();
    let page = fs::read(desk.out.join("report.html")).unwrap();
    fs::write(desk.out.join("report.html"), "").unwrap();
    let ways: [&dyn Fn(&Path); 4] = [
        &|path| fs::remove_file(path).unwrap(),
        &|path| {
            fs::remove_file(path).unwrap();
            std::os::unix::fs::symlink("nowhere", path).unwrap();
        },
        &|path| fs::write(path, b"\xff\xfe").unwrap(),
        &|path| {
            fs::write(path, String::from_utf8(whole.clone()).unwrap().replace('\n', "\r\n"))
                .unwrap();
        },
    ];
    for way in ways {
        way(&history(&cases[0]));
        let told = ended(1, &["verify", &desk.dir, "--rerun", "8"]).out;
        let of_case = told.lines().filter(|line| line.contains(&cases[0])).count();
        assert!(of_case == 2 && told.contains("report.html is damaged"), "{told}");
        let told = ended(1, &["film", &desk.dir, &cases[0]]).err;
        let (_, why) = told.split_once(&format!("{}.csv ", cases[0])).expect(&told);
        let damage = ["is damaged, and no fault", "is missing, and no fault"];
        assert!(damage.iter().any(|damage| why.starts_with(damage)), "{told}");
        assert!(!told.contains("lines, not"), "{told}");
        let _ = fs::remove_file(history(&cases[0]));
        fs::write(history(&cases[0]), &whole).unwrap();
    }
    let summary = fs::read(desk.out.join("summary.csv")).unwrap();
    fs::remove_file(desk.out.join("summary.csv")).unwrap();
    let told = ended(1, &["verify", &desk.dir, "--rerun", "1"]).out;
    assert!(told.contains("run again: summary.csv: there is no such file"), "{told}");
    fs::write(desk.out.join("summary.csv"), summary).unwrap();
    fs::write(desk.out.join("report.html"), page).unwrap();
    ended(0, &["verify", &desk.dir]);
    fs::remove_file(desk.out.join("journal.jsonl")).unwrap();
    let told = ended(2, &["film", &desk.dir, &cases[0]]).err;
    assert!(told.contains("holds no journal.jsonl"), "{told}");
}

/// A report without the files that cannot be drawn, with their names, and whole again after the same command.
#[test]
fn a_report_leaves_out_what_is_damaged_and_names_it() {
    let desk = Desk::new(&with_gauge(TINY));
    sweep(0, &desk.file, &desk.out, &[]);
    let ways: [fn(&Path); 4] = [
        |path| fs::remove_file(path).unwrap(),
        |path| fs::write(path, "").unwrap(),
        |path| fs::write(path, "time_s,force\nx,y\n").unwrap(),
        |path| {
            let mut bytes = fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 0x80;
            fs::write(path, bytes).unwrap();
        },
    ];
    for folder in ["histories", "probes", "envelopes"] {
        for (number, way) in ways.iter().enumerate() {
            let path = files(&desk.out.join(folder)).swap_remove(number);
            way(&path);
            let words = ended(1, &["report", &desk.dir]).err;
            let name = path.file_name().unwrap().to_str().unwrap();
            assert!(words.lines().any(|line| line.contains(name)), "{words}");
            assert!(words.contains("1 file left out: the same `seawall sweep`"), "{words}");
            assert!(fs::read_to_string(desk.out.join("report.html")).unwrap().contains("</html>"));
            // Without what tells how the file was, what cannot be read shows all the same.
            let manifest = fs::read(desk.out.join("manifest.json")).unwrap();
            fs::remove_file(desk.out.join("manifest.json")).unwrap();
            assert_ne!(run(&["report", &desk.dir]).status.code(), Some(2));
            fs::write(desk.out.join("manifest.json"), manifest).unwrap();
            sweep(0, &desk.file, &desk.out, &[]);
            ended(0, &["report", &desk.dir]);
            ended(0, &["verify", &desk.dir]);
        }
    }
}

/// The second sweep made a summary without the bars of the first one. The manifest still told the file that asked for
/// them. So `verify` called the summary damaged, and `report` put the bars back.
#[test]
fn other_error_bars_of_the_same_cases_are_no_damage() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let summary = || fs::read_to_string(out.join("summary.csv")).unwrap();
    let mut bars_of = std::collections::BTreeMap::new();
    for bars in ["triple", "none", "pair", "triple", "none"] {
        let text = text.replace("[grid]", &format!("error_bars = {bars:?}\n[grid]"));
        sweep(0, &write_file(root.path(), &text), &out, &[]);
        let swept = summary();
        let mut rows = csv::Reader::from_reader(swept.as_bytes());
        let column = rows.headers().unwrap().iter().position(|name| name == "force_error").unwrap();
        let told: Vec<_> = rows.records().map(|row| row.unwrap()[column].to_owned()).collect();
        assert!(told.len() == 2 && told.iter().all(|bar| bar.is_empty() == (bars == "none")));
        assert_eq!(*bars_of.entry(bars).or_insert_with(|| told.clone()), told, "{bars}");
        ended(0, &["verify", directory, "--rerun", "1"]);
        let words = ended(0, &["report", directory]).err;
        assert!(!words.contains("summary.csv"), "{bars}: {words}");
        assert_eq!(summary(), swept, "{bars}");
    }
}

/// Of a study that was stopped, `verify` counts what is finished, for people and for programs.
#[test]
fn verify_counts_what_is_finished() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let out = root.path().join("out");
    let directory = out.to_str().unwrap();
    sweep(0, &write_file(root.path(), &text), &out, &[]);
    let journal = fs::read_to_string(out.join("journal.jsonl")).unwrap();
    let shorter = journal.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(out.join("journal.jsonl"), format!("{shorter}\n")).unwrap();
    for table in ["summary.csv", "energy.csv"] {
        fs::remove_file(out.join(table)).unwrap();
    }
    let people = ended(0, &["verify", directory]);
    assert_eq!(people.out, "1 case: every file is as it was written\n");
    let told = ended(0, &["verify", directory, "--format", "json"]).json();
    assert_eq!(told, serde_json::json!({ "cases": 1, "rerun": 0, "damage": [] }));
}

/// The story: `verify --rerun 2` of a study whose cases had all failed ran none again, and did not say so.
#[test]
fn a_study_of_failed_cases_has_none_to_run_again() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[50, 250]", "[50]");
    let out = root.path().join("out");
    let limited = text.replace("[grid]", "[limits]\nsteps = 3\n[grid]");
    sweep(1, &write_file(root.path(), &limited), &out, &[]);
    let told = ended(0, &["verify", out.to_str().unwrap(), "--rerun", "2"]).out;
    assert!(told.ends_with("none ran again: no case of this study has ended well\n"), "{told}");
}

/// As `derived.json.partial: Permission denied (os error 13)` it was told, of a file that nobody knows, and a film
/// only once its case had run.
#[test]
fn a_study_that_cannot_be_written_is_told_plainly() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &["--film", "none"]);
    // In the way of the next one, also for who may write everywhere.
    fs::create_dir(desk.out.join("derived.json.partial")).unwrap();
    let case = &crate::common::column(&desk.out, "case_id")[0];
    for command in [&["report", &desk.dir][..], &["film", &desk.dir, case]] {
        let told = ended(2, command).err;
        let told = told.split_once("derived.json: cannot be written: ").unwrap().1;
        assert!(told.starts_with("a directory stands in the place of this file; "), "{told}");
        assert!(told.ends_with("with nothing else in the way of its files\n"), "{told}");
    }
    assert!(!desk.out.join("films").exists(), "nothing runs");
}

/// Without `derived.json` all was well, whatever had become of page and figures. A directory in the place of one was
/// "missing", and what the system said of it was all that `report` and `sweep` told.
#[test]
fn what_page_and_figures_were_is_missed_and_a_directory_told() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &["--film", "auto"]);
    fs::remove_file(desk.out.join("derived.json")).unwrap();
    let told = ended(1, &["verify", &desk.dir]).out;
    assert!(told.starts_with("derived.json is missing: ") && told.contains("`seawall report`"));
    ended(0, &["report", &desk.dir]);
    ended(0, &["verify", &desk.dir]);
    let names = [
        "report.html",
        "histories.csv.gz",
        "tables/summary.csv",
        "figures/response-force.svg",
        "derived.json",
        "energy.csv",
    ];
    for name in names {
        let path = desk.out.join(name);
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        let told = ended(1, &["verify", &desk.dir]).out;
        assert!(told.starts_with(&format!("{name} is a directory")), "{told}");
        let sweep = ["sweep", &desk.file, "--out", &desk.dir, "--film", "none"];
        // One code and one message from both; with 70 the sweep used to end.
        let words = [&["report", &desk.dir][..], &sweep].map(|command| {
            let told = ended(2, command).err;
            told.lines().last().unwrap().split_once(name).expect(&told).1.to_owned()
        });
        assert_eq!(words[0], words[1]);
        let told = ": cannot be written: a directory stands in the place of this file; a study's directory must be";
        assert!(words[0].starts_with(told), "{}", words[0]);
        fs::remove_dir(&path).unwrap();
        ended(0, &["report", &desk.dir]);
        ended(0, &["verify", &desk.dir]);
    }
    // The film of a case stays told once a sweep could not make it again.
    let film = files(&desk.out.join("films"))
        .into_iter()
        .find(|path| path.to_str().unwrap().ends_with(".html"));
    let film = film.unwrap();
    fs::remove_file(&film).unwrap();
    fs::create_dir(&film).unwrap();
    sweep(0, &desk.file, &desk.out, &["--film", "auto"]);
    let told = ended(1, &["verify", &desk.dir]).out;
    assert!(told.ends_with(".html is a directory\n"), "{told}");
}

/// The story: `report` asked for a sweep to make the summary again, though its journal had every case.
#[test]
fn a_report_makes_the_summary_again() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &["--film", "none"]);
    let summary = desk.out.join("summary.csv");
    let before = fs::read(&summary).unwrap();
    fs::remove_file(&summary).unwrap();
    // Whoever needs it says so: they named a sweep, which takes longer.
    let readers: [&[&str]; 4] = [
        &["find", &desk.dir, "force_max < 2"],
        &["show", &desk.dir],
        &["film", &desk.dir],
        &["compare", &desk.dir, &desk.dir],
    ];
    let remedy = format!("has no summary.csv; `seawall report {}` makes it", desk.dir);
    for words in readers {
        let told = ended(2, words).err;
        assert!(told.contains(&remedy), "{told}");
    }
    let told = ended(0, &["report", &desk.dir]).err;
    assert!(told.contains("summary.csv: made again from the journal"), "{told}");
    assert_eq!(fs::read(&summary).unwrap(), before);
    ended(0, &["verify", &desk.dir]);
    // Without the manifest nobody can.
    fs::remove_file(&summary).unwrap();
    fs::remove_file(desk.out.join("manifest.json")).unwrap();
    let told = ended(2, &["report", &desk.dir]).err;
    assert!(told.contains("has no summary.csv; `seawall sweep` or `run` of the same"), "{told}");
    for words in [readers[0], readers[1], readers[3]] {
        assert!(ended(2, words).err.contains("summary.csv; `seawall sweep` or `run` of"));
    }
}

/// The story: of a sweep that was killed early `find` said that `report` makes the summary, and `report` that a sweep does.
#[test]
fn what_makes_the_summary_of_a_killed_sweep_is_told_alike() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &["--film", "none"]);
    let (summary, journal) = (desk.out.join("summary.csv"), desk.out.join("journal.jsonl"));
    let whole = fs::read_to_string(&journal).unwrap();
    for done in [0, 1] {
        let early: String = whole.split_inclusive('\n').take(1 + done).collect();
        fs::write(&journal, early).unwrap();
        let _ = fs::remove_file(&summary);
        let left = 8 - done;
        let told = format!("has no summary.csv, with {left} of 8 cases left; `seawall sweep` or");
        for words in [&["find", &desk.dir, "F* < 3"][..], &["report", &desk.dir]] {
            let words = ended(2, words).err;
            assert!(words.contains(&told), "{words}");
        }
    }
    sweep(0, &desk.file, &desk.out, &["--film", "none"]);
    ended(0, &["report", &desk.dir]);
}

/// The story: what a parser of tables says of it was all that was told.
#[test]
fn a_damaged_summary_is_told_with_what_mends_it() {
    let desk = Desk::new(TINY);
    sweep(0, &desk.file, &desk.out, &[]);
    let summary = desk.out.join("summary.csv");
    let text = fs::read_to_string(&summary).unwrap();
    for damaged in [String::new(), text.replacen(",ok,", ",ok,\"", 1), text.replace(",0.4,", ",x,")]
    {
        fs::write(&summary, damaged).unwrap();
        let told = ended(2, &["find", &desk.dir, "force_max < 2"]).err;
        let remedy = format!("is damaged; `seawall report {}` makes it again\n", desk.dir);
        assert!(told.ends_with(&remedy), "{told}");
    }
    ended(0, &["report", &desk.dir]);
    assert_eq!(fs::read_to_string(&summary).unwrap(), text);
}
