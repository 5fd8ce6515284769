//! What a terminal shows: tables, progress, errors for programs, colours, and the commands that explain.

mod common;

use std::fs;
use std::process::Output;

use common::{TINY, expect_code, run, seawall, write_file};
use serde_json::Value;

fn told(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", told(&output.stdout)))
}

/// A finished study with error bars, in a directory of its own.
fn study() -> (tempfile::TempDir, String, Output) {
    let root = tempfile::tempdir().unwrap();
    let bars = TINY.replace("[grid]", "error_bars = \"pair\"\n[grid]");
    let file = write_file(root.path(), &bars);
    let out = root.path().join("out").to_str().unwrap().to_owned();
    let output = run(&["sweep", file.to_str().unwrap(), "--out", &out, "--film", "none"]);
    expect_code(&output, 0);
    (root, out, output)
}

#[test]
fn the_table_fits_a_terminal_and_shows_error_bars_and_cases_are_counted_alike() {
    let (_root, out, output) = study();
    let (text, notes) = (told(&output.stdout), told(&output.stderr));
    let rows: Vec<_> = text.lines().take(9).collect();
    assert!(rows.iter().all(|row| row.chars().count() <= 80), "{text}");
    assert!(rows[0].contains("F* max") && rows[0].contains("X* max"), "{text}");
    assert!(rows[1..].iter().all(|row| row.matches(" ± ").count() >= 2), "{text}");
    assert!(text.contains("\nmax: of the whole run; first, "), "{text}");
    assert!(notes.contains("8 cases and 8 companions for error bars on "), "{notes}");
    assert!(!notes.contains("of 16 cases"), "{notes}");
    let status = told(&run(&["status", &out]).stdout);
    assert!(status.contains("8 of 8 cases done"), "{status}");
    assert!(text.contains("8 of 8 cases are well"), "{text}");
}

#[test]
fn progress_moves_within_a_case() {
    let root = tempfile::tempdir().unwrap();
    let scene =
        TINY.split("[grid]").next().unwrap().replace("wall = \"movable\"", "end_time_s = 8");
    let file = write_file(root.path(), &scene.replace("0.025", "0.0125"));
    let out = root.path().join("out");
    let output =
        run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap(), "--threads", "1"]);
    expect_code(&output, 0);
    let notes = told(&output.stderr);
    let within = notes.lines().filter(|line| line.contains(" %  0 of 1 case, ")).count();
    let seconds = json(&run(&[
        "run",
        file.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
        "--format",
        "json",
    ]))["wall_time_s"]
        .as_f64()
        .unwrap();
    assert!(within > 0 || seconds < 2.5, "{seconds} s: {notes}");
}

#[test]
fn errors_are_objects_for_programs() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), "name = \"a\"\n[scene]\nwave_height_ratio = 2\n");
    let file = file.to_str().unwrap();
    let bad = run(&["check", file, "--format", "json"]);
    expect_code(&bad, 2);
    let error = &json(&bad)["error"];
    let field = |name: &str| error[name].as_str().unwrap_or_default().to_owned();
    assert_eq!((field("kind"), field("file")), ("bad-input".to_owned(), file.to_owned()));
    assert_eq!(
        (field("key"), field("value")),
        ("scene.wave_height_ratio".to_owned(), "2".to_owned())
    );
    assert_eq!(field("allowed"), "must be a number from 0 to 0.8");
    assert!(told(&bad.stderr).ends_with(&format!("{}\n", field("message"))), "{error}");
    assert_eq!(error["exit_code"], 2);
    for (arguments, kind) in [
        (&["sweep", "--format=json"][..], "usage"),
        (&["--format", "json", "sweeep"], "usage"),
        (&["status", "nowhere", "--format", "json", "--quiet"], "bad-input"),
    ] {
        let output = run(arguments);
        expect_code(&output, 2);
        assert_eq!(json(&output)["error"]["kind"], kind, "{arguments:?}");
    }
}

/// Who asks for JSON gets it, and nothing besides with `--quiet`.
#[test]
fn quiet_json_is_the_answer_alone() {
    let quiet = run(&["explain", "kernel", "--format", "json", "--quiet"]);
    expect_code(&quiet, 0);
    assert_eq!(json(&quiet), json(&run(&["explain", "kernel", "--format", "json"])));
    assert!(quiet.stderr.is_empty());
    assert!(run(&["explain", "kernel", "--quiet"]).stdout.is_empty());
    let number = env!("CARGO_PKG_VERSION");
    assert_eq!(told(&run(&["--version"]).stdout), format!("seawall {number}\n"));
    for arguments in [&["--version", "--format", "json"][..], &["--format=json", "sweep", "-V"]] {
        let version = run(arguments);
        expect_code(&version, 0);
        assert_eq!(json(&version), serde_json::json!({ "name": "seawall", "version": number }));
    }
}

#[test]
fn there_are_no_colours_where_nobody_wants_them() {
    let plain = |output: &Output| !output.stdout.contains(&0x1b) && !output.stderr.contains(&0x1b);
    for arguments in [&["--help"][..], &["sweep"], &["explain", "kernel"], &["check", "nope"]] {
        assert!(plain(&run(arguments)), "{arguments:?}: no terminal");
    }
    // `script` makes a terminal of its own.
    let program = env!("CARGO_BIN_EXE_seawall");
    let in_terminal = |no_colour: bool| {
        let mut command = std::process::Command::new("script");
        command.args(["-qec", &format!("{program} sweep; true"), "/dev/null"]).env("TERM", "xterm");
        command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        if no_colour {
            command.env("NO_COLOR", "1");
        }
        command.output().ok().filter(|output| output.status.success())
    };
    let Some((coloured, colourless)) = in_terminal(false).zip(in_terminal(true)) else {
        return; // there is no `script` here
    };
    assert!(told(&coloured.stdout).contains("Usage") && !plain(&coloured));
    assert!(plain(&colourless), "{}", told(&colourless.stdout));
}

#[test]
fn init_writes_a_study_that_passes_and_never_overwrites() {
    let root = tempfile::tempdir().unwrap();
    let in_root =
        |arguments: &[&str]| seawall().args(arguments).current_dir(root.path()).output().unwrap();
    expect_code(&in_root(&["init", "waves"]), 0);
    let check = in_root(&["check", "waves.toml"]);
    expect_code(&check, 0);
    assert!(told(&check.stdout).contains("\ncases               12\n"));
    fs::write(root.path().join("waves.toml"), "mine").unwrap();
    let again = in_root(&["init", "waves"]);
    expect_code(&again, 2);
    assert!(told(&again.stderr).contains("waves.toml: is there already"));
    assert_eq!(fs::read_to_string(root.path().join("waves.toml")).unwrap(), "mine");
    let bad = in_root(&["init", "../waves"]);
    expect_code(&bad, 2);
    assert!(told(&bad.stderr).contains("'/' is none of these"), "{}", told(&bad.stderr));
}

#[test]
fn keys_and_columns_are_explained() {
    let explain = |name: &str| {
        let output = run(&["explain", name]);
        expect_code(&output, 0);
        told(&output.stdout)
    };
    let key = explain("spring_stiffness_n_per_m");
    for line in ["unit       N/m", "allowed    0 or above", "only with  wall = \"movable\""] {
        assert!(key.contains(line), "{key}");
    }
    assert!(key.contains("column of summary.csv"), "{key}");
    assert!(explain("force_max").contains("error bar force_max_error"));
    let symbol = explain("F*");
    assert!(symbol.contains("force_max: column") && symbol.contains("first_force_max: column"));
    assert!(explain("k").starts_with("spring_stiffness_n_per_m: key of [scene]"));
    assert!(explain("refine").contains("key of [grid] refine"));
    let nearly = told(&run(&["explain", "F_max"]).stderr);
    assert!(nearly.contains("did you mean force_max?"), "{nearly}");
    let strange = told(&run(&["explain", "F"]).stderr);
    assert!(!strange.contains("did you mean") && strange.contains("lists all"), "{strange}");
    let miss = run(&["explain", "spring_stifness"]);
    expect_code(&miss, 2);
    assert!(told(&miss.stderr).contains("did you mean spring_stiffness_n_per_m?"));
    let all = told(&run(&["explain"]).stdout);
    assert!(all.lines().all(|line| line.chars().count() <= 80));
    let listed = ["particle_spacing_m", "doubtful_reason", "paddle_work", "wall_velocity_m_per_s"];
    for name in listed {
        assert!(all.contains(&format!("\n  {name}")), "{name}");
    }
    let object = json(&run(&["explain", "courant_number", "--format", "json"]));
    assert_eq!(object["entries"][0]["allowed"], "0.001 to 2.5");
}

#[test]
fn a_case_of_a_study_is_shown_and_runs_alone_as_the_same_case() {
    let (root, out, _) = study();
    let words =
        ["wave_height_ratio=0.5", "spring_stiffness_n_per_m=1e4", "seawall_mass_kg_per_m=50"];
    let shown = run(&[&["show", &out][..], &words].concat());
    expect_code(&shown, 0);
    let text = told(&shown.stdout);
    let id = text.lines().next().unwrap()["case ".len()..][..16].to_owned();
    for part in
        ["\nparameters\n", "\nresults\n", "\nhealth\n", " ± ", &format!("histories/{id}.csv")]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let by_prefix = run(&["show", &out, &id[..10], "--format", "json"]);
    expect_code(&by_prefix, 0);
    let object = json(&by_prefix);
    assert_eq!(object["case"]["case_id"], id.as_str());
    assert!(object["case"]["force_error"].as_f64().unwrap() > 0.0, "{object}");
    let open = run(&["show", &out, "wave_height_ratio=0.5"]);
    expect_code(&open, 2);
    assert!(told(&open.stderr).contains("4 cases fit; say which one by spring_stiffness_n_per_m"));
    let scene = run(&[&["show", &out, "--toml"][..], &words].concat());
    expect_code(&scene, 0);
    let (file, single) = (root.path().join("case.toml"), root.path().join("single"));
    fs::write(&file, &scene.stdout).unwrap();
    let single = single.to_str().unwrap();
    expect_code(&run(&["run", file.to_str().unwrap(), "--out", single]), 0);
    let again = run(&["show", single, &id, "--format", "json"]);
    expect_code(&again, 0);
    assert_eq!(json(&again)["case"]["force_max"], object["case"]["force_max"]);
    assert_eq!(json(&again)["case"]["force_max_error"], object["case"]["force_max_error"]);
}

/// A case that had not run yet was no case: "no such case; there is", and then nothing.
#[test]
fn a_case_that_is_not_finished_is_told_as_such() {
    let (root, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let file = write_file(root.path(), TINY);
    let arguments = ["sweep", file.to_str().unwrap(), "--film", "none", "--out"];
    expect_code(&run(&[&arguments, &[out.path().to_str().unwrap()][..]].concat()), 0);
    // As a sweep leaves it that is stopped: fewer lines, no case or two.
    let (journal, summary) = (out.path().join("journal.jsonl"), out.path().join("summary.csv"));
    let [lines, rows] = [&journal, &summary].map(|path| fs::read_to_string(path).unwrap());
    let first =
        |text: &str, count: usize| -> String { text.split_inclusive('\n').take(count).collect() };
    let show = |words: &[&str]| {
        let output = run(&[&["show", out.path().to_str().unwrap()], words].concat());
        expect_code(&output, 2);
        told(&output.stderr)
    };
    let last = ["H/h=0.5", "k=1e4", "m=250"];
    for finished in [0, 2] {
        fs::write(&journal, first(&lines, 1 + finished)).unwrap();
        fs::write(&summary, first(&rows, 1 + finished)).unwrap();
        let words = show(&last);
        let id = words.split(' ').nth(2).unwrap();
        assert!(rows.lines().last().unwrap().starts_with(id), "{words}");
        assert!(words.contains(" is not finished yet; `seawall status "), "{words}");
        assert_eq!(show(&[id]), words);
        let words = show(&["H/h=0.5"]);
        assert!(words.contains("4 cases fit; say which one by spring_stiffness_n"), "{words}");
        let words = show(&["H/h=0.6"]);
        assert!(words.contains("H/h=0.6: no such case; there is 0.4, 0.5"), "{words}");
    }
    fs::remove_file(&summary).unwrap();
    let words = show(&last);
    assert!(words.contains("has no summary.csv; `seawall sweep` or `run` of the same"), "{words}");
}

#[test]
fn shells_and_man_are_told_of_every_command() {
    for shell in ["bash", "zsh", "fish"] {
        let output = run(&["completions", shell]);
        expect_code(&output, 0);
        let script = told(&output.stdout);
        for word in ["sweep", "show", "explain", "init", "max-error"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
        // Shells offered the command with which the program gives a piece of work to itself.
        assert!(!script.contains("apart"), "{shell}");
    }
    let page = run(&["man"]);
    expect_code(&page, 0);
    assert!(told(&page.stdout).contains(".TH seawall 1"));
    let root = tempfile::tempdir().unwrap();
    expect_code(&run(&["man", "--out", root.path().to_str().unwrap()]), 0);
    let pages = fs::read_dir(root.path()).unwrap().count();
    assert!(pages >= 12 && root.path().join("seawall-show.1").is_file(), "{pages}");
}
