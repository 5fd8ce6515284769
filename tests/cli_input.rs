//! Bad and odd input: what is told names file, key, value and what is allowed, and nothing is written.

use std::fs;
use std::path::Path;

use crate::common::{Desk, TINY, Told, ended, expect_code, seawall, write_file};

/// A scene that runs in no time.
const SCENE: &str = "name = \"a\"\n[scene]\n[numerics]\nparticle_spacing_m = 0.025\n";

/// Runs a command in a directory of its own, with a scene, a sweep and a file that is neither.
fn in_directory(code: i32, arguments: &[&str]) -> (Told, Vec<String>) {
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name);
    fs::write(at("scene.toml"), SCENE).unwrap();
    fs::write(at("tiny.toml"), TINY).unwrap();
    fs::write(at("plain"), "").unwrap();
    fs::create_dir(at("empty")).unwrap();
    let output = seawall().args(arguments).current_dir(root.path()).output().unwrap();
    let entries = fs::read_dir(root.path()).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    (Told::of(output, code), names)
}

#[test]
fn bad_input_is_told_in_plain_words_and_nothing_is_written() {
    let both = "--set=grid.wave_gauge_m=[1.2, 1.3]";
    for (arguments, words) in [
        (
            &["check", "nope.toml"][..],
            "nope.toml: there is no such file or directory; give a sweep",
        ),
        (
            &["accuracy", "nope.toml"],
            "nope.toml: there is no such file or directory; give a file of cases and methods, or none: one is built in",
        ),
        (&["stress", "empty"], "empty: is a directory; give a file of cases and methods, such as"),
        (
            &["accuracy", "tiny.toml"],
            "tiny.toml: is a sweep or scene file; give a file of cases and methods, or none",
        ),
        (
            &["check", "empty"],
            "empty: is a directory; give a sweep or scene file, such as empty/NAME",
        ),
        (&["check", "."], ".: is a directory; give a sweep or scene file"),
        (&["run", "scene.toml", "--out", "plain"], "--out plain: is a file; give a directory"),
        (&["sweep", "tiny.toml", "--out", "plain/x"], "--out plain/x: plain is a file"),
        (
            &["run", "scene.toml", "--out", "/dev/null/x"],
            "--out /dev/null/x: nothing can be written there",
        ),
        (&["status", "nope"], "nope: no such directory; give the output directory of a study"),
        (&["report", "plain"], "plain: is a file; give the output directory of a study"),
        (&["film", "empty"], "empty: holds no manifest.json: not the output directory of a study"),
        (
            &["sweep", "tiny.toml", "--max-error", "-5"],
            "'-5' for '--max-error <PERCENT>': must be a",
        ),
        (&["sweep", "tiny.toml", "--max-error", "2%"], "'--max-error <PERCENT>': write 2: it is a"),
        (&["sweep", "tiny.toml", "--max-error", "nan"], "must be a percentage above 0"),
        (
            &["check", "scene.toml", "--set", "grid.wave_height_ratio=[nan]"],
            "scene.toml: grid.wave_height_ratio = nan: must be a finite number",
        ),
        (
            &["check", "scene.toml", "--set", "name=Gr\u{f6}\u{df}e"],
            "name = \"Gr\u{f6}\u{df}e\": must be a word of the letters a to z and A to Z",
        ),
        // The file was blamed for what it does not say.
        (
            &["check", "scene.toml", "--set", "numerics.slip=half"],
            "scene.toml: numerics.slip = \"half\": must be one of free, no (given by --set)",
        ),
        (
            &[
                "check",
                "scene.toml",
                "--set",
                "numerics.slip=no",
                "--set",
                "grid.shepard_lambda=[2, 3]",
                "--set",
                "numerics.boundary=sfdi",
            ],
            "scene.toml: grid.shepard_lambda: boundary = \"sfdi\" does not read it, nor does any other case (given",
        ),
        (
            &["check", "scene.toml", "--set", "numerics.particle_spacing_m=1e-5"],
            "scene.toml: numerics.particle_spacing_m = 0.00001: would cut 0.5 m² of water into \
             5,000,000,000 particles, and 20,000,000 are the most: choose 0.000159 m or more",
        ),
        (
            &["check", "tiny.toml", "--set", "grid.spring_stiffness_n_per_m=[\"500 N/m\"]"],
            "grid.spring_stiffness_n_per_m = \"500 N/m\": write 500, without quotes: the unit, N/m,",
        ),
        (
            &["sweep", "scene.toml", "--set", "numerics.particle_spacing_m=1cm", both],
            "numerics.particle_spacing_m = \"1cm\": write 0.01, without quotes: the unit, m, is in",
        ),
        (
            &["run", "tiny.toml"],
            "this file has 8 cases, and `seawall run` takes one: name it by the values of the swept \
             keys, as in `seawall run FILE wave_height_ratio=0.4 spring_stiffness_n_per_m=10",
        ),
        (
            &["check", "scene.toml", "--set", "scene.end_time_s=1e300"],
            "scene.toml: scene.end_time_s = 1e300: would take 2.0e302 steps, and 1e13 are the most",
        ),
        (
            &["sweep", "tiny.toml", "--set", "grid.wave_height_ratio=[1e-308]"],
            "steps, and 1e13 are the most; where no end_time_s is given, a low wave is a long one",
        ),
        (&["run", "tiny.toml", "wave_height_ratio=0.4"], "4 cases fit; say which one by spring_"),
    ] {
        let (Told { err: told, .. }, names) = in_directory(2, arguments);
        assert!(told.contains(words) && !told.contains("os error"), "{arguments:?}: {told}");
        assert_eq!(names, ["empty", "plain", "scene.toml", "tiny.toml"], "{arguments:?}");
    }
}

/// Escape characters used to reach the terminal as they are, and a value of 5,000 characters filled it.
#[test]
fn messages_are_text_and_short() {
    let long = format!("scene.wall=\"{}\"", "x".repeat(5000));
    let long_key = format!("scene.{}=1", "x".repeat(5000));
    for arguments in [
        &["check", "scene.toml", "--set", "scene.wall=\"\u{1b}[31mred\""][..],
        &["check", "scene.toml", "--set", "scene.\u{1b}[31mred=1"],
        &["check", "\u{1b}[31mred"],
        &["status", "\u{1b}[31mred"],
        &["check", "scene.toml", "--set", &long],
        &["check", "scene.toml", "--set", &long_key],
        &["sweep", "scene.toml", "--max-error", "\u{1b}[31mred"],
        &["sweep", "scene.toml", "--threads", &long],
        &["sweep", "scene.toml", &long],
    ] {
        for more in [&[][..], &["--format", "json"]] {
            let (Told { out, err: words }, _) = in_directory(2, &[arguments, more].concat());
            assert!(
                !words.contains('\u{1b}') && words.contains("error: "),
                "{arguments:?}: {words}"
            );
            assert!(words.len() < 1500, "{arguments:?}: {} characters", words.len());
            assert!(!out.contains('\u{1b}'), "{arguments:?}");
        }
    }
}

/// A path that is no UTF-8 text used to end everything once it was computed.
#[test]
#[cfg(target_os = "linux")]
fn a_path_that_is_no_text_is_a_path() {
    use std::os::unix::ffi::OsStrExt;
    let desk = Desk::new(TINY);
    let out = desk.path().join(std::ffi::OsStr::from_bytes(b"o\xffut"));
    for command in ["sweep", "report", "status", "verify"] {
        let mut run = seawall();
        run.args([command, "--format", "json"]);
        match command {
            "sweep" => run.arg(&desk.file).arg("--out").arg(&out),
            _ => run.arg(&out),
        };
        let output = run.output().unwrap();
        expect_code(&output, 0);
        let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(value.is_object(), "{command}");
    }
    assert!(out.join("report.html").is_file());
}

#[test]
fn a_key_in_a_section_and_in_the_grid_is_an_error_in_the_file_too() {
    let root = tempfile::tempdir().unwrap();
    let text = TINY.replace("[numerics]", "wave_height_ratio = 0.3\n[numerics]");
    let file = write_file(root.path(), &text);
    for command in ["check", "sweep"] {
        let told = ended(2, &[command, &file]).err;
        let words = "sweep.toml: scene.wave_height_ratio = 0.3: stands in [scene] and in [grid]";
        assert!(told.contains(words), "{told}");
    }
    // On the command line it is meant.
    let single = write_file(root.path(), &format!("{SCENE}kernel = \"gaussian\"\n"));
    let kernels = "grid.kernel=[\"gaussian\", \"wendland-c2\"]";
    ended(0, &["check", &single, "--set", kernels]);
}

/// What `check` prints, and what another command notes, of a scene with a value set.
fn warnings_of(setting: &str) -> [String; 2] {
    let desk = Desk::new(SCENE);
    let check = ended(0, &["check", &desk.file, "--set", setting]);
    let grid = ["--dry-run", "--set", "grid.wave_gauge_m=[1.2, 1.3]"];
    let sweep = ended(0, &[&["sweep", &desk.file, "--set", setting][..], &grid].concat());
    [check.out, sweep.out]
}

#[test]
fn odd_values_are_warned_of_and_taken() {
    for (setting, words) in [
        (
            "scene.still_water_depth_m=0.6",
            "scene.still_water_depth_m = 0.6: the tank, tank_length_m",
        ),
        ("scene.water_density_kg_per_m3=1", "scene.water_density_kg_per_m3 = 1: this is no water"),
        (
            "scene.history_interval_s=1e-9",
            "scene.history_interval_s = 0.000000001: is much shorter",
        ),
        ("scene.end_time_s=1e-308", "the case ends before its second step"),
        ("scene.end_time_s=1e9", "the longest case ends at 1000000000 s, after 2.0e11 steps"),
    ] {
        for text in warnings_of(setting) {
            let line = text.lines().find(|line| line.starts_with("warning: "));
            assert!(line.is_some_and(|line| line.contains(words)), "{setting}: {text}");
        }
    }
    let quiet = warnings_of("scene.still_water_depth_m=0.2");
    assert!(quiet.iter().all(|text| !text.contains("warning")), "{quiet:?}");
}

#[test]
fn runs_and_sweeps_note_what_check_warns_of() {
    let desk = Desk::new(TINY);
    let short = ["--set", "scene.end_time_s=0.02", "--set", "scene.threshold_ratio=0.5"];
    let places = ["--out", &desk.dir, "--threads", "1000"];
    let sweep = ended(0, &[&["sweep", &desk.file][..], &short, &places].concat());
    let case = ["wave_height_ratio=0.4", "spring_stiffness_n_per_m=10", "seawall_mass_kg_per_m=50"];
    let places = ["--out", desk.path().to_str().unwrap(), "--threads", "1000"];
    let places = [places[0], &format!("{}/single", places[1]), places[2], places[3]];
    let single = ended(0, &[&["run", &desk.file][..], &case, &short, &places].concat());
    for output in [sweep, single] {
        let notes = output.err;
        let moved = "sweep.toml: scene.threshold_ratio = 0.5: still water alone presses with 1";
        assert!(notes.contains(moved), "{notes}");
        assert!(notes.contains("warning: --threads 1000: this machine has"), "{notes}");
    }
    // The case of a sweep file that runs alone is the same case.
    let id = |directory: &Path| {
        let mut reader = csv::Reader::from_path(directory.join("summary.csv")).unwrap();
        reader.records().next().unwrap().unwrap()[0].to_owned()
    };
    assert_eq!(id(&desk.out), id(&desk.path().join("single")));
}

#[test]
fn a_bad_instruction_set_in_the_environment_is_refused_by_all_that_computes() {
    let desk = Desk::new(TINY);
    let before = fs::read_dir(desk.path()).unwrap().count();
    let with = |code: i32, arguments: &[&str]| {
        let mut command = seawall();
        command.env("SEAWALL_SIMD_LIMIT", "sse").current_dir(desk.path());
        Told::of(command.args(arguments).output().unwrap(), code)
    };
    for arguments in [
        &["sweep", &desk.file][..],
        &["run", &desk.file],
        &["film", "."],
        &["verify", ".", "--rerun", "1"],
        &["reproduce", "liang2017", "--figure", "13"],
        &["accuracy"],
        &["stress"],
    ] {
        let told = with(2, arguments).err;
        let words = "SEAWALL_SIMD_LIMIT=sse: must be avx512, avx2 or portable";
        assert!(told.contains(words), "{arguments:?}: {told}");
    }
    assert_eq!(fs::read_dir(desk.path()).unwrap().count(), before, "nothing is written");
    for arguments in [&["check", &desk.file][..], &["sweep", &desk.file, "--dry-run"]] {
        with(0, arguments);
    }
}

#[test]
fn a_sweep_file_may_come_through_a_pipe() {
    use std::io::Write;
    use std::process::Stdio;

    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let text = "name = \"piped\"\n[scene]\nkind = \"hydrostatic\"\nend_time_s = 0.05\n\
                [grid]\nparticle_spacing_m = [0.05, 0.06]\n";
    let mut child = seawall()
        .args(["sweep", "/dev/stdin", "--film", "none", "--quiet", "--out"])
        .arg(&out)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(crate::common::journal_lines(&out), 1 + 2);

    // Before its end a study cannot be filmed, which is told in words.
    std::fs::remove_file(out.join("summary.csv")).unwrap();
    let film = ended(2, &["film", out.to_str().unwrap(), "particle_spacing_m=0.05"]);
    assert!(film.err.contains("has no summary.csv"));
}

/// The story: `check /dev/zero` filled the memory, and with a pipe that nobody writes into no command ended.
#[test]
fn a_file_without_an_end_is_refused() {
    let root = tempfile::tempdir().unwrap();
    let [pipe, long] = ["pipe", "long"].map(|name| root.path().join(name));
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    fs::File::create(&long).unwrap().set_len(2 << 30).unwrap();
    let long = (long.to_str().unwrap(), "is longer than 64 MiB, the most that is read; give a");
    let pipe = (pipe.to_str().unwrap(), "nobody writes into this pipe; give a sweep or scene file");
    for (file, words) in [("/dev/zero", long.1), long, pipe] {
        let mut commands =
            vec![vec!["check", file], vec!["slurm", file, "--nodes", "1", "--time", "9"]];
        commands.extend(["sweep", "run", "accuracy"].map(|command| vec![command, file]));
        for command in commands {
            let told = ended(2, &command).err;
            // Each asks for what it takes.
            let words = match command[0] {
                "accuracy" => words.replace("sweep or scene file", "file of cases and methods"),
                _ => words.to_owned(),
            };
            assert!(told.contains(&format!("{file}: {words}")), "{command:?}: {told}");
        }
    }
    let stroke = format!("scene.recorded_stroke={}", pipe.0);
    let paddle = ["--set", "scene.paddle=recorded-stroke", "--set", &stroke];
    let desk = Desk::new(TINY);
    let told = ended(2, &[&["check", &desk.file][..], &paddle].concat()).err;
    assert!(told.contains("cannot be read: nobody writes into this pipe; a path"), "{told}");
}

/// The story: a sweep file of one case was refused, as it "has 1 cases, and `seawall run` takes one".
#[test]
fn a_sweep_file_of_one_case_needs_no_words() {
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("one.toml");
    let text = "name = \"one\"\n[scene]\nkind = \"hydrostatic\"\nend_time_s = 0.05\n\
                [grid]\nparticle_spacing_m = [0.05, 0.06]\n";
    fs::write(&file, text).unwrap();
    let one = "grid.particle_spacing_m=[0.06]";
    let with = |arguments: &[&str]| {
        let mut command = seawall();
        command.arg("run").arg(&file).args(["--set", one]).args(arguments);
        command.current_dir(root.path()).output().unwrap()
    };
    expect_code(&with(&[]), 0);
    let made: Vec<_> = fs::read_dir(root.path().join("results/runs")).unwrap().collect();
    let made = made[0].as_ref().unwrap().path();
    assert!(made.file_name().unwrap().to_string_lossy().starts_with("one-"), "{made:?}");
    // What the command line set is in the case's own file, and is not set once more.
    ended(0, &["verify", made.to_str().unwrap(), "--rerun", "1"]);
    expect_code(&with(&["particle_spacing_m=0.06"]), 0);
    expect_code(&with(&["particle_spacing_m=0.05"]), 2);
}
