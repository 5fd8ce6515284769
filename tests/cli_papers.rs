//! The papers through the command line: their figures made again, a study beside their numbers, and two
//! studies side by side.

use std::fs;
use std::path::Path;

use crate::common::{Desk, TINY, column, ended, with_gauge, write_file};
use serde_json::Value;

#[test]
fn every_figure_of_both_papers_is_listed() {
    let list = ended(0, &["reproduce", "--list", "--format", "json"]).json();
    let list = list["figures"].as_array().unwrap();
    assert_eq!(list.len(), 32, "fifteen figures and a table of each");
    for figure in list {
        let made = figure["made"] == true;
        assert_eq!(made, figure["why_not"] == "", "{figure}");
        assert_eq!(made, figure["expected_time_s"].as_f64().is_some_and(|s| s > 0.0), "{figure}");
    }
    assert_eq!(list.iter().filter(|figure| figure["made"] == true).count(), 14 + 9);
    let text = ended(0, &["reproduce", "huang2019", "--list"]).out;
    assert!(text.starts_with("huang2019: Huang et al. 2019") && !text.contains("liang2017:"));
    assert!(text.contains("not made: It is a drawing of the set-up."), "{text}");
}

#[test]
fn a_figure_of_liang_is_made_and_made_again_without_a_run() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let set = "numerics.particle_spacing_m=0.025";
    let figure = ["reproduce", "liang2017", "--figure", "9", "--out", out.to_str().unwrap()];
    let command = [&figure[..], &["--set", set, "--format", "json"]].concat();
    let value = ended(0, &command).json();
    let numbers = value["numbers"].as_array().unwrap();
    // The largest force of the movable wall: 2.73 are printed, with either factor s.
    let force = |s: &str| {
        let wanted = |n: &&Value| {
            n["quantity"] == "first_force_max" && n["force_coupling"] == s && n["figure"] == "9"
        };
        let number = numbers.iter().find(wanted).unwrap_or_else(|| panic!("{numbers:#?}"));
        assert_eq!(number["printed"], "2.73");
        number["computed"].as_str().unwrap().parse::<f64>().unwrap()
    };
    let (as_printed, fitted) = (force("1"), force("0.4"));
    assert!((as_printed / 2.32 - 1.0).abs() < 0.02, "potential theory has 2.320: {as_printed}");
    assert!((fitted / 2.73 - 1.0).abs() < 0.05, "{fitted}");
    let sentences = value["sentences"].to_string();
    assert!(sentences.contains("the law as printed: 0 of 7 numbers are met"), "{sentences}");
    // The story: what coarse particles did was given other reasons.
    let coarse = "The particles are coarse, and a part of the differences may be theirs: 8.0 rows";
    assert!(sentences.contains(coarse), "{sentences}");

    let files = ["figure-9.svg", "figure-9.csv", "figure-9.md"].map(|name| out.join(name));
    let svg = fs::read_to_string(&files[0]).unwrap();
    roxmltree::Document::parse(&svg).unwrap();
    assert!(svg.contains("printed in the papers") && svg.contains("s = 0.4"));
    let page = fs::read_to_string(out.join("single_wall/report.html")).unwrap();
    assert!(page.contains("<h2>The papers</h2>"));

    let before = files.clone().map(|file| fs::read(file).unwrap());
    let again = ended(0, &command);
    assert!(again.err.contains("is finished"), "{}", again.err);
    assert_eq!(before, files.map(|file| fs::read(file).unwrap()));

    let in_words = ended(0, &[&figure[..], &["--set", set, "--figures", "pdf,png"]].concat());
    for name in ["figure-9-84mm-1.pdf", "figure-9-174mm.pdf", "figure-9-174mm.png"] {
        assert!(out.join(name).is_file(), "{name} of {:?}", fs::read_dir(&out).unwrap());
    }
    let text = in_words.out;
    let table = text.split("✗: not met").next().unwrap();
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
    let time = table.lines().find(|line| line.contains("t of first R*")).unwrap();
    assert_eq!(time.matches(" s ").count(), 3, "printed, and computed with either factor: {time}");

    let other = ended(2, &[&figure[..], &["--set", "numerics.particle_spacing_m=0.02"]].concat());
    assert!(other.err.contains("single_wall"), "{}", other.err);
}

#[test]
fn waves_in_two_panels_of_one_legend_do_not_look_alike() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let mut command =
        vec!["reproduce", "liang2017", "--figure", "5", "--out", out.to_str().unwrap()];
    for set in ["grid.wave_height_ratio=[0.1, 0.4]", "numerics.particle_spacing_m=0.03"] {
        command.extend(["--set", set]);
    }
    let told = ended(0, &command).out;
    let svg = fs::read_to_string(out.join("figure-5.svg")).unwrap();
    // The low wave and the high one were both of the first look of their panel.
    assert!(svg.contains("hue-0") && svg.contains("hue-3") && !svg.contains("hue-1"), "{svg}");
    let text = fs::read_to_string(out.join("figure-5.md")).unwrap();
    for text in [text, told.replace('\n', " ")] {
        assert!(text.contains("Computed by isph with particles 0.03 m apart."), "{text}");
    }
}

#[test]
fn a_figure_of_huang_tells_times_per_step() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let sets = ["grid.particle_spacing_m=[0.06, 0.05]", "scene.end_time_s=0.05"];
    let mut command = vec!["reproduce", "huang2019", "--figure", "9", "--format", "json"];
    command.extend(["--out", out.to_str().unwrap()]);
    sets.iter().for_each(|set| command.extend(["--set", set]));
    let output = ended(0, &command);
    let numbers = output.json()["numbers"].as_array().unwrap().clone();
    assert_eq!(numbers.len(), 4 * 2, "four ratios are printed, at two spacings each");
    for number in &numbers {
        let ratio: f64 = number["computed"].as_str().unwrap().parse().unwrap();
        assert!(ratio > 0.05 && ratio < 20.0, "{number}");
    }
    let svg = fs::read_to_string(out.join("figure-9.svg")).unwrap();
    assert!(svg.contains("over improved Shepard") && svg.contains("mls-quadratic"));
}

#[test]
fn what_cannot_be_made_is_told() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let bad: [(&[&str], &str); 6] = [
        (
            &["liang2018", "--figure", "9"],
            "PAPER = \"liang2018\": must be one of liang2017, huang2019",
        ),
        (&["liang2017", "--figure", "16"], "--figure 16: liang2017 has 1, 2, 3"),
        (&["liang2017", "--figure", "6"], "Fig. 6 of liang2017 is not made: It is a drawing"),
        (&["huang2019", "--figure", "table-1"], "Table 1 of huang2019 is not made: "),
        (&["liang2017"], "--figure <N>"),
        (
            &["liang2017", "--figure", "9", "--set", "numerics.kernel=round"],
            "sweeps/liang2017/single_wall.toml (inside the program): numerics.kernel = \"round\"",
        ),
    ];
    for (arguments, message) in bad {
        let command = [&["reproduce", "--out", out.to_str().unwrap()], arguments].concat();
        let output = ended(2, &command);
        assert!(output.err.contains(message), "{}", output.err);
    }
    assert!(!out.exists(), "nothing was written");
}

/// A study of the tiny tank with other values.
fn sweep(root: &Path, name: &str, changes: &[(&str, &str)]) -> String {
    let folder = root.join(name);
    fs::create_dir(&folder).unwrap();
    let start = TINY.replace("[50, 250]", "[50]");
    let text = changes.iter().fold(start, |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    });
    let (file, out) = (write_file(&folder, &text), folder.join("out"));
    ended(0, &["sweep", &file, "--out", out.to_str().unwrap(), "--film", "none"]);
    out.to_str().unwrap().to_owned()
}

#[test]
fn two_studies_stand_side_by_side() {
    let root = tempfile::tempdir().unwrap();
    let spacing = "particle_spacing_m = 0.025";
    let with_bars = format!("{spacing}\nerror_bars = \"pair\"");
    let fine = sweep(root.path(), "fine", &[(spacing, &with_bars)]);
    let changes = [(spacing, "particle_spacing_m = 0.03125"), ("[10, 1e4]", "[10.0, 1e5]")];
    let coarse = sweep(root.path(), "coarse", &changes);
    let out = root.path().join("difference");
    let arguments = ["compare", &fine, &coarse];
    let value =
        ended(0, &[&arguments[..], &["--format", "json", "--out", out.to_str().unwrap()]].concat())
            .json();
    assert_eq!(value["pairs"], 2, "two waves on the soft spring: {value:#}");
    let text = ended(0, &arguments).out;
    assert!(text.contains("\nB less A, all at k = 10 N/m, m = 50 kg/m\n"), "{text}");
    let keys = value["keys"].as_array().unwrap();
    let keys: Vec<_> =
        keys.iter().map(|key| ["key", "a", "b"].map(|s| key[s].as_str().unwrap())).collect();
    let differing = [
        ["error_bars", "pair", "none"],
        ["particle_spacing_m", "0.025", "0.03125"],
        ["sound_speed_ratio", "6.4", "5.72"],
    ];
    assert_eq!(keys, differing);
    assert!(value["only_in_a"][0].as_str().unwrap().contains("k = 10000 N/m"));
    assert_eq!(value["only_in_b"].as_array().unwrap().len(), 2);
    let tally = &value["summary"]["displacement_max"];
    assert_eq!((&tally["cases"], &tally["unit"]), (&Value::from(2), &Value::from("%")));
    assert!(tally["worst"].as_f64().unwrap() >= tally["median"].as_f64().unwrap());
    // The sizes are those of the two summaries.
    let displacement =
        |case: &Value, side: &str| case["differences"]["displacement_max"][side].as_f64().unwrap();
    for case in value["cases"].as_array().unwrap() {
        let [a, b, difference, percent] =
            ["a", "b", "difference", "percent"].map(|s| displacement(case, s));
        assert!(
            (b - a - difference).abs() < 1e-12 && (100.0 * difference / a - percent).abs() < 1e-9
        );
        assert!(percent.abs() > 1e-6 && percent.abs() < 20.0, "{case}");
        let force = &case["differences"]["displacement_max"];
        assert!(
            force["error_a"].is_f64()
                && force["error_b"].is_null()
                && force["within_bars"].is_boolean()
        );
    }
    let table = fs::read_to_string(out.join("compare.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2);
    roxmltree::Document::parse(&fs::read_to_string(out.join("compare.svg")).unwrap()).unwrap();

    let text = ended(0, &arguments).out;
    assert!(
        text.contains("2 pairs of cases at the same point; 2 only in A, 2 only in B"),
        "{text}"
    );
    assert!(text.contains("numerics.particle_spacing_m"), "{text}");
    assert!(!Path::new(&fine).join("tables/papers.csv").exists(), "this is not the papers' tank");
}

#[test]
fn what_cannot_be_compared_is_told() {
    let root = tempfile::tempdir().unwrap();
    let one = sweep(root.path(), "one", &[("[0.4, 0.5]", "[0.4]"), ("[10, 1e4]", "[10]")]);
    let other = sweep(root.path(), "other", &[("[0.4, 0.5]", "[0.5]"), ("[10, 1e4]", "[10]")]);
    let apart = ended(2, &["compare", &one, &other]);
    assert!(apart.err.contains("have no case in common"), "{}", apart.err);
    assert!(apart.err.contains("H/h = 0.4") && apart.err.contains("H/h = 0.5"));
    let nowhere = root.path().join("nowhere");
    let missing = ended(2, &["compare", &one, nowhere.to_str().unwrap()]);
    assert!(missing.err.contains("nowhere: no such directory"), "{}", missing.err);
    let file = root.path().join("one/sweep.toml");
    let unwritable = ended(2, &["compare", &one, &one, "--out", file.to_str().unwrap()]);
    assert!(unwritable.err.contains("--out"), "{}", unwritable.err);
    let same = ended(0, &["compare", &one, &one]);
    assert!(!same.out.contains("They differ in"));
    // The story: "have no case in common" was followed by the same words for both studies.
    fs::remove_file(Path::new(&other).join("manifest.json")).unwrap();
    let untold = ended(2, &["compare", &one, &other]);
    let why = format!("{other}: manifest.json is missing or damaged");
    assert!(untold.err.contains(&why), "{}", untold.err);
}

/// The story: a threshold that was asked for ran, and the figure drew the paper's beside the curve.
#[test]
fn a_figure_draws_the_threshold_that_was_asked_for() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let figure = ["reproduce", "liang2017", "--figure", "7", "--out", out.to_str().unwrap()];
    let set = ["--set", "numerics.particle_spacing_m=0.05", "--set", "scene.threshold_ratio=1.5"];
    ended(0, &[&figure[..], &set].concat());
    let drawn = fs::read_to_string(out.join("figure-7.svg")).unwrap();
    assert!(drawn.contains("threshold, 1.5") && !drawn.contains("threshold, 1.1"), "{drawn}");
}

/// A record made from a case's own gauge: a centimetre higher, and later by what does not count.
#[test]
fn a_case_is_held_against_measurements() {
    let desk = Desk::new(&with_gauge(TINY));
    ended(0, &["sweep", &desk.file, "--out", &desk.dir, "--quiet", "--film", "none"]);
    let path = desk.path().join("measured.csv");
    let record = path.to_str().unwrap();
    let which = ended(2, &["compare", &desk.dir, record]);
    assert!(which.err.contains("measured.csv: no such file"), "{}", which.err);
    let mut probes =
        fs::read_dir(desk.out.join("probes")).unwrap().map(|file| file.unwrap().path());
    let probe = probes.find(|path| !path.ends_with("columns.csv")).unwrap();
    let id = probe.file_stem().unwrap().to_str().unwrap().to_owned();
    let rows = fs::read_to_string(&probe).unwrap();
    let raised = rows.lines().skip(1).step_by(3).map(|row| {
        let (time, level) = row.split_once(',').unwrap();
        format!("{time},{},7\n", level.parse::<f64>().unwrap() + 0.01)
    });
    let text = format!("time_s,level,levle\n{}99,99,99\n", raised.collect::<String>());
    fs::write(&path, text).unwrap();
    let which = ended(2, &["compare", &desk.dir, record]);
    assert!(which.err.contains("--case: 8 cases fit; say which one by"), "{}", which.err);
    // The story: the comma form, which `--film` takes, was told to be no case.
    let keys = ["--case", "H/h=0.5,k=1e4,m=50", "--format", "json"];
    let value = ended(0, &[&["compare", &desk.dir, record], &keys[..]].concat()).json();
    let ids = column(&desk.out, "case_id");
    assert!(ids.iter().any(|id| value["case_id"] == **id), "{value}");
    let out = desk.path().join("beside");
    let options = ["--case", &id[..9], "--out", out.to_str().unwrap()];
    let told = ended(0, &[&["compare", &desk.dir, record], &options[..]].concat());
    assert!(
        told.err.contains("left out levle") && told.err.contains("did you mean level"),
        "{}",
        told.err
    );
    assert!(told.out.contains("level") && told.out.contains(&id), "{}", told.out);
    roxmltree::Document::parse(&fs::read_to_string(out.join("compare.svg")).unwrap()).unwrap();
    let table = fs::read_to_string(out.join("compare.csv")).unwrap();
    assert!(table.lines().nth(1).unwrap().starts_with("level,m,0,"), "{table}");
    let json = ["--case", &id, "--format", "json", "--between", "0.2", "0.6"];
    let value = ended(0, &[&["compare", &desk.dir, record], &json[..]].concat()).json();
    let column = &value["columns"][0];
    let number = |key: &str| column[key].as_f64().unwrap();
    assert!((number("rms") - 0.01).abs() < 1e-9, "{column}");
    assert!(number("from_s") >= 0.2 && number("to_s") <= 0.6, "{column}");
    let back = ended(2, &["compare", &desk.dir, record, "--case", &id, "--between", "2", "1"]);
    assert!(back.err.contains("the second time must be later"), "{}", back.err);
    // The story: a gauge that failed for a while, and one in millimetres, passed without a word.
    let count = rows.lines().count();
    let in_mm = rows.lines().skip(1).enumerate().map(|(at, row)| {
        let (time, level) = row.split_once(',').unwrap();
        let seen = !(count / 3..2 * count / 3).contains(&at);
        let level = 1e3 * level.parse::<f64>().unwrap();
        if seen { format!("{time}, {level}\n") } else { format!("{time},\n") }
    });
    fs::write(&path, format!("time_s, level\n{}", in_mm.collect::<String>())).unwrap();
    let told = ended(0, &["compare", &desk.dir, record, "--case", &id, "--format", "json"]);
    assert!(told.err.contains("level has no values for 0."), "{}", told.err);
    let (value, mm) = (told.json(), ": is the column in mm?");
    assert!(told.err.contains(mm) && value["slips"][0].as_str().unwrap().ends_with(mm), "{value}");
    assert!(value["columns"][0]["gaps_s"].as_f64().unwrap() > 0.1, "{value}");
    let two = ended(2, &["compare", &desk.dir, &desk.dir, "--case", &id]);
    assert!(two.err.contains("--case is for a CSV file"), "{}", two.err);
}

#[test]
fn a_figure_tells_before_it_runs_what_it_needs() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let figure = ["reproduce", "liang2017", "--figure", "9", "--out", out.to_str().unwrap()];
    let command = [&figure[..], &["--set", "numerics.particle_spacing_m=0.04"]].concat();
    let dry = [&command[..], &["--dry-run"]].concat();
    let told = ended(0, &dry).out;
    assert!(told.starts_with("Fig. 9 of liang2017: ") && told.contains("single_wall"), "{told}");
    assert!(told.contains("2 cases, about") && told.ends_with("nothing was run\n"), "{told}");
    assert!(!out.exists());
    ended(0, &command);
    let after = ended(0, &dry).out;
    assert!(after.contains("in all, 2 of them finished, into"), "{after}");
    let json = ended(0, &[&dry[..], &["--fresh", "--format", "json"]].concat()).json();
    assert_eq!((&json["runs"][0]["cases"], &json["runs"][0]["finished"]), (&2.into(), &0.into()));
    let error = ended(2, &["reproduce", "--list", "--dry-run"]).err;
    assert!(error.contains("--dry-run"), "{error}");
}
