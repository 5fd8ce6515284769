//! What a terminal shows: tables, progress, errors for programs, colours, and the commands that explain.

use std::fs;
use std::process::Output;

use crate::common::{Desk, TINY, Told, ended, run, seawall};

fn told(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A finished study with error bars, and what was told of it.
fn study() -> (Desk, Told) {
    let desk = Desk::new(&TINY.replace("[grid]", "error_bars = \"pair\"\n[grid]"));
    let told = desk.sweep(&["--film", "none"]);
    (desk, told)
}

#[test]
fn the_table_fits_a_terminal_and_shows_error_bars_and_cases_are_counted_alike() {
    let (desk, Told { out: text, err: notes }) = study();
    let rows: Vec<_> = text.lines().take(9).collect();
    assert!(rows.iter().all(|row| row.chars().count() <= 80), "{text}");
    assert!(rows[0].contains("F* max") && rows[0].contains("X* max"), "{text}");
    assert!(rows[1..].iter().all(|row| row.matches(" ± ").count() >= 2), "{text}");
    assert!(text.contains("\nmax: over the whole run; first, "), "{text}");
    assert!(notes.contains("8 cases and 8 companions for error bars on "), "{notes}");
    assert!(!notes.contains("of 16 cases"), "{notes}");
    let status = ended(0, &["status", &desk.dir]).out;
    assert!(status.contains("8 of 8 cases done"), "{status}");
    assert!(text.contains("8 of 8 cases are well"), "{text}");
}

/// Fixed walls had a column of X* without a number, for which one of R* was given up, and none of what goes over a crest.
#[test]
fn the_table_has_the_columns_of_which_some_case_has_a_number() {
    let crest = "name = \"a\"\n[scene]\nbehind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.13\n\
                 end_time_s = 0.3\n[numerics]\nparticle_spacing_m = 0.025\n[grid]\nwave_height_ratio = [0.2, 0.3]\n";
    let table = Desk::new(crest).sweep(&["--film", "none"]).out;
    let heading = table.lines().next().unwrap();
    assert!(heading.contains("R* max") && heading.contains("V over"), "{table}");
    assert!(!heading.contains("X*") && !heading.contains("first"), "{table}");
    assert!(table.contains("\nmax: over the whole run\n"), "{table}");
}

#[test]
fn progress_moves_within_a_case() {
    let scene =
        TINY.split("[grid]").next().unwrap().replace("wall = \"movable\"", "end_time_s = 8");
    let desk = Desk::new(&scene.replace("0.025", "0.0125"));
    let notes = desk.run(&["--threads", "1"]).err;
    let within = notes.lines().filter(|line| line.contains(" %  0 of 1 case, ")).count();
    let seconds = desk.run(&["--format", "json"]).json()["wall_time_s"].as_f64().unwrap();
    assert!(within > 0 || seconds < 2.5, "{seconds} s: {notes}");
}

#[test]
fn errors_are_objects_for_programs() {
    let desk = Desk::new("name = \"a\"\n[scene]\nwave_height_ratio = 2\n");
    let bad = ended(2, &["check", &desk.file, "--format", "json"]);
    let error = &bad.json()["error"];
    let field = |name: &str| error[name].as_str().unwrap_or_default().to_owned();
    assert_eq!((field("kind"), field("file")), ("bad-input".to_owned(), desk.file.clone()));
    assert_eq!(
        (field("key"), field("value")),
        ("scene.wave_height_ratio".to_owned(), "2".to_owned())
    );
    assert_eq!(field("allowed"), "must be a number from 0 to 0.8");
    assert!(bad.err.ends_with(&format!("{}\n", field("message"))), "{error}");
    assert_eq!(error["exit_code"], 2);
    for (arguments, kind) in [
        (&["sweep", "--format=json"][..], "usage"),
        (&["--format", "json", "sweeep"], "usage"),
        (&["status", "nowhere", "--format", "json", "--quiet"], "bad-input"),
    ] {
        let output = ended(2, arguments);
        assert_eq!(output.json()["error"]["kind"], kind, "{arguments:?}");
    }
}

/// Who asks for JSON gets it, and nothing besides with `--quiet`.
#[test]
fn quiet_json_is_the_answer_alone() {
    let quiet = ended(0, &["explain", "kernel", "--format", "json", "--quiet"]);
    assert_eq!(quiet.json(), ended(0, &["explain", "kernel", "--format", "json"]).json());
    assert!(quiet.err.is_empty());
    assert!(ended(0, &["explain", "kernel", "--quiet"]).out.is_empty());
    let number = env!("CARGO_PKG_VERSION");
    assert_eq!(ended(0, &["--version"]).out, format!("seawall {number}\n"));
    for arguments in [&["--version", "--format", "json"][..], &["--format=json", "sweep", "-V"]] {
        let version = ended(0, arguments);
        assert_eq!(version.json(), serde_json::json!({ "name": "seawall", "version": number }));
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
    let in_root = |code: i32, arguments: &[&str]| {
        Told::of(seawall().args(arguments).current_dir(root.path()).output().unwrap(), code)
    };
    in_root(0, &["init", "waves"]);
    assert!(in_root(0, &["check", "waves.toml"]).out.contains("\ncases               12\n"));
    fs::write(root.path().join("waves.toml"), "mine").unwrap();
    assert!(in_root(2, &["init", "waves"]).err.contains("waves.toml: is there already"));
    assert_eq!(fs::read_to_string(root.path().join("waves.toml")).unwrap(), "mine");
    let bad = in_root(2, &["init", "../waves"]).err;
    assert!(bad.contains("'/' is none of these"), "{bad}");
    let bad = in_root(2, &["init", "a\u{1b}"]).err;
    assert!(bad.starts_with("error: name = "), "{bad}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_standard_output_that_is_full_is_named() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = seawall().args(["explain", "force_max"]).stdout(full).output().unwrap();
    let told = Told::of(output, 70).err;
    assert_eq!(told, "error: standard output: no space left on device\n");
}

#[test]
fn keys_and_columns_are_explained() {
    let explain = |name: &str| ended(0, &["explain", name]).out;
    let key = explain("spring_stiffness_n_per_m");
    for line in ["unit       N/m", "allowed    0 or above", "only with  wall = \"movable\""] {
        assert!(key.contains(line), "{key}");
    }
    assert!(key.contains("column of summary.csv"), "{key}");
    let read = explain("shepard_lambda");
    assert!(read.contains("read only  with boundary = \"improved-shepard\""), "{read}");
    assert!(read.contains("only with  scheme = \"wcsph\""), "{read}");
    assert!(explain("force_max").contains("error bar force_max_error"));
    let symbol = explain("F*");
    assert!(symbol.contains("force_max: column") && symbol.contains("first_force_max: column"));
    assert!(explain("k").starts_with("spring_stiffness_n_per_m: key of [scene]"));
    assert!(explain("Viscosity").starts_with("artificial_viscosity: key of [numerics]"));
    assert!(explain("refine").contains("key of [grid] refine"));
    let nearly = ended(2, &["explain", "F_max"]).err;
    assert!(nearly.contains("did you mean force_max?"), "{nearly}");
    let strange = ended(2, &["explain", "F"]).err;
    assert!(!strange.contains("did you mean") && strange.contains("lists all"), "{strange}");
    let miss = ended(2, &["explain", "spring_stifness"]);
    assert!(miss.err.contains("did you mean spring_stiffness_n_per_m?"));
    let all = ended(0, &["explain"]).out;
    assert!(all.lines().all(|line| line.chars().count() <= 80));
    let listed = ["particle_spacing_m", "doubtful_reason", "paddle_work", "wall_velocity_m_per_s"];
    for name in listed {
        assert!(all.contains(&format!("\n  {name}")), "{name}");
    }
    let swing =
        all.split("kind = \"standing-wave\"\n").nth(1).unwrap().split("\n\n").next().unwrap();
    assert!(swing.contains("still_water_depth_m"), "shared with another kind: {swing}");
    let shared = explain("still_water_depth_m");
    assert!(shared.contains("kind = \"hydrostatic\", \"standing-wave\"\n"), "{shared}");
    let object = ended(0, &["explain", "courant_number", "--format", "json"]).json();
    assert_eq!(object["entries"][0]["allowed"], "0.001 to 2.5");
}

/// The story: of a key of numerics only the default was explained, though a preset gave another value.
#[test]
fn what_presets_make_of_a_key_is_explained() {
    let told = |name: &str| ended(0, &["explain", name]).out;
    assert!(
        told("numerics.kernel").contains("or         \"gaussian\" with preset = \"huang2019\"")
    );
    let viscosity = told("artificial_viscosity");
    for line in
        ["or         0.02 with preset = \"huang2019\"", "or         0.1 with preset = \"isph\""]
    {
        assert!(viscosity.contains(line), "{viscosity}");
    }
    assert!(told("time_step_s").contains("0.0005 with preset"));
    assert!(!told("courant_number").contains("\"isph\""), "its scheme does not read it");
    assert!(!told("shepard_lambda").contains("preset"));
    let presets = |name: &str| {
        let entries = ended(0, &["explain", name, "--format", "json"]).json()["entries"].clone();
        entries[0]["presets"].clone()
    };
    assert_eq!(presets("time_step_s"), serde_json::json!({ "huang2019": "0.0005" }));
    assert!(presets("shepard_lambda").is_null());
}

#[test]
fn a_case_of_a_study_is_shown_and_runs_alone_as_the_same_case() {
    let (desk, _) = study();
    let words =
        ["wave_height_ratio=0.5", "spring_stiffness_n_per_m=1e4", "seawall_mass_kg_per_m=50"];
    let text = ended(0, &[&["show", &desk.dir][..], &words].concat()).out;
    let id = text.lines().next().unwrap()["case ".len()..][..16].to_owned();
    for part in
        ["\nparameters\n", "\nresults\n", "\nhealth\n", " ± ", &format!("histories/{id}.csv")]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    // The story: the sentences about coarse particles had dots in their middle.
    let told = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let coarse = "coarse spacing 8.0 rows over the depth; below 10, forces are up to 3 %, displacements 9 % off, runups \
                  0.25 h low; one bar in four may miss";
    assert!(told.contains(coarse), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80 || line.contains('/')), "{text}");
    let impulse = text.lines().find(|line| line.starts_with("  first impulse ")).unwrap();
    assert!(impulse.ends_with(" ½ρgh² √(h/g)"), "{impulse}");
    let object = ended(0, &["show", &desk.dir, &id[..10], "--format", "json"]).json();
    assert_eq!(object["case"]["case_id"], id.as_str());
    assert!(object["case"]["force_error"].as_f64().unwrap() > 0.0, "{object}");
    assert_eq!(object["wall"], "movable", "a program was not told what kind of wall it is");
    let open = ended(2, &["show", &desk.dir, "wave_height_ratio=0.5"]);
    assert!(open.err.contains("4 cases fit; say which one by spring_stiffness_n_per_m"));
    let scene = ended(0, &[&["show", &desk.dir, "--toml"][..], &words].concat()).out;
    let alone = Desk::new(&scene);
    let run = alone.run(&[]).out;
    assert!(
        run.lines().any(|line| line.starts_with("first impulse ") && line.ends_with(" √(h/g)"))
    );
    let again = ended(0, &["show", &alone.dir, &id, "--format", "json"]);
    assert_eq!(again.json()["case"]["force_max"], object["case"]["force_max"]);
    assert_eq!(again.json()["case"]["force_max_error"], object["case"]["force_max_error"]);
}

/// A case that had not run yet was no case: "no such case; there is", and then nothing.
#[test]
fn a_case_that_is_not_finished_is_told_as_such() {
    let desk = Desk::new(TINY);
    desk.sweep(&["--film", "none"]);
    // As a sweep leaves it that is stopped: fewer lines, no case or two.
    let (journal, summary) = (desk.out.join("journal.jsonl"), desk.out.join("summary.csv"));
    let [lines, rows] = [&journal, &summary].map(|path| fs::read_to_string(path).unwrap());
    let first =
        |text: &str, count: usize| -> String { text.split_inclusive('\n').take(count).collect() };
    let show = |words: &[&str]| ended(2, &[&["show", &desk.dir], words].concat()).err;
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
    fs::write(&journal, &lines).unwrap();
    let words = show(&last);
    assert!(words.contains("which is finished; `seawall report "), "{words}");
    fs::remove_file(&summary).unwrap();
    let words = show(&last);
    assert!(words.contains("has no summary.csv; `seawall report "), "{words}");
}

#[test]
fn shells_and_man_are_told_of_every_command() {
    for shell in ["bash", "zsh", "fish"] {
        let script = ended(0, &["completions", shell]).out;
        for word in ["sweep", "show", "explain", "init", "max-error"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
        // Shells offered the command with which the program gives a piece of work to itself.
        assert!(!script.contains("apart"), "{shell}");
    }
    let page = ended(0, &["man"]);
    assert!(page.out.contains(".TH seawall 1"));
    let root = tempfile::tempdir().unwrap();
    ended(0, &["man", "--out", root.path().to_str().unwrap()]);
    let pages = fs::read_dir(root.path()).unwrap().count();
    assert!(pages >= 12 && root.path().join("seawall-show.1").is_file(), "{pages}");
}
