//! `accuracy`, `stress` and `--max-error` from outside: files, exit codes, resuming.

use std::fs;

use crate::common::{Desk, TINY, Told, ended, expect_code, journal_lines, run};

/// A short tank at rest and a wave in it, with two methods of which one is unknown.
const MATRIX: &str = r#"
name = "tiny_matrix"
[[case]]
name = "still"
about = "water at rest"
quick = true
scene = { wave_height_ratio = 0.0, end_time_s = 0.5, tank_length_m = 1.0, wave_gauge_m = 0.5 }
numerics = { particle_spacing_m = 0.04 }
truth = { force_end = 1.0, runup_end = 0.0 }
pass = { force_end = [0.9, 1.1] }
[[case]]
name = "impossible"
about = "water at rest that is asked to press twice as hard"
scene = { wave_height_ratio = 0.0, end_time_s = 0.5, tank_length_m = 1.0, wave_gauge_m = 0.5 }
numerics = { particle_spacing_m = 0.05 }
pass = { force_end = [1.9, 2.1] }
[[method]]
name = "default"
quick = true
[[method]]
name = "unknown"
numerics = { kernel = "no-such-kernel" }
"#;

#[test]
fn stress_judges_by_the_criteria_and_resumes() {
    let desk = Desk::new(MATRIX);
    let command = ["stress", &desk.file, "--out", &desk.dir];
    ended(1, &command);
    let lines = journal_lines(&desk.out);
    let again = ended(1, &[&command[..], &["--format", "json"]].concat());
    assert_eq!(journal_lines(&desk.out), lines, "nothing is run twice");
    let told: serde_json::Value = again.json();
    let verdicts: Vec<_> = told["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["verdict"].as_str().unwrap())
        .collect();
    assert_eq!(verdicts, ["passed", "not-there", "missed", "not-there"]);
    let page = fs::read_to_string(desk.out.join("stress.md")).unwrap();
    assert!(page.contains("Criterion: force_end in [1.9, 2.1]"), "{page}");
    let quick = desk.path().join("quick");
    let quiet =
        ended(0, &["stress", command[1], "--quick", "--quiet", "--out", quick.to_str().unwrap()]);
    assert!(quiet.out.is_empty());
}

#[test]
fn accuracy_writes_its_table_figure_and_page() {
    let desk = Desk::new(MATRIX);
    ended(0, &["accuracy", &desk.file, "--quick", "--out", &desk.dir]);
    let table = fs::read_to_string(desk.out.join("accuracy.csv")).unwrap();
    assert!(table.lines().any(|line| line.starts_with("all,default,")), "{table}");
    assert!(
        desk.out.join("accuracy.md").is_file()
            && desk.out.join("figures/error-against-time.svg").is_file()
    );
}

#[test]
fn what_is_no_matrix_is_refused() {
    let desk = Desk::new(TINY);
    for command in ["accuracy", "stress"] {
        let output = ended(2, &[command, &desk.file]);
        assert!(output.err.contains("sweep.toml"));
    }
}

/// All three were "no case that this program can run", which was true of one.
#[test]
fn why_nothing_runs_is_told() {
    let own = MATRIX.replace("kernel = \"no-such-kernel\" }", "}\ncases = [\"still\"]");
    for (text, more, reason) in [
        (MATRIX, ["--quick", "--case", "impossible"], "marked as quick; leave --quick out"),
        (
            own.as_str(),
            ["--case=impossible", "--method", "unknown"],
            "no such method is for such a case",
        ),
        (MATRIX, ["--case=still", "--method", "unknown"], "can run: numerics.kernel = \"no-such"),
    ] {
        let desk = Desk::new(text);
        let told = ended(2, &[&["stress", &desk.file, "--out", &desk.dir][..], &more].concat()).err;
        assert!(told.contains(reason), "{told}");
        assert!(!desk.out.exists());
    }
}

#[test]
fn a_wanted_error_is_chosen_for_verified_and_told() {
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[10, 1e4]", "[10]");
    let desk = Desk::new(&text);
    let sweep = |error: &str| run(&["sweep", &desk.file, "--max-error", error, "--out", &desk.dir]);
    expect_code(&sweep("0"), 2);
    expect_code(&sweep("60"), 0);
    let table = fs::read_to_string(desk.out.join("max_error.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2);
    assert!(table.lines().skip(1).all(|line| line.ends_with(",60,true")), "{table}");
    expect_code(&sweep("50"), 2); // another sweep's directory
    let swept = text.replace("particle_spacing_m = 0.025\n", "");
    let swept = swept.replace("[grid]", "[grid]\nparticle_spacing_m = [0.02, 0.04]");
    fs::write(&desk.file, swept).unwrap();
    let told = ended(2, &["sweep", &desk.file, "--max-error", "2", "--out", "nowhere"]);
    assert!(told.err.contains("[grid] sweeps it"));
}

/// The story: a case that was doubtful at its first, coarse spacing had narrow bars. It was left there, and nothing but
/// `met = false` told it.
#[test]
fn a_doubtful_case_is_run_again_finer_and_what_cannot_be_met_is_told() {
    let text = "name = \"steep\"\n[scene]\nwall = \"fixed\"\n[grid]\nwave_height_ratio = [0.6]\n";
    let desk = Desk::new(text);
    let sweep = |more: &[&str]| {
        let command = ["sweep", &desk.file, "--max-error", "9", "--film", "none"];
        ended(0, &[&command[..], more].concat())
    };
    let told = sweep(&["--out", &desk.dir]).err;
    assert!(told.contains("not within 9 %: 1 case doubtful; these run once more"), "{told}");
    let table = fs::read_to_string(desk.out.join("max_error.csv")).unwrap();
    assert!(table.ends_with(",9,true\n") && !table.contains(",0.025,"), "{table}");
    // A process that died before or in its second round left a study that `status` called finished.
    let status = ["status", &desk.dir, "--exit-code"];
    ended(0, &status);
    let journal = desk.out.join("journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let ends = text.match_indices('\n').map(|(end, _)| end + 1).filter(|end| *end < text.len());
    for end in ends {
        fs::write(&journal, &text[..end]).unwrap();
        ended(3, &status);
    }
    fs::write(&journal, &text).unwrap();

    // Finer particles would not make a run longer.
    let short = desk.path().join("short");
    let short = ["--out", short.to_str().unwrap(), "--set", "scene.end_time_s=2"];
    let Told { out, err } = sweep(&short);
    assert!(out.ends_with("\nnot within 9 %: 1 case doubtful\n"), "{out}");
    assert!(!err.contains("run once more"), "{err}");
    let told = sweep(&[&short[..], &["--format", "json"]].concat()).json();
    assert_eq!(told["accuracy"]["missed"], serde_json::json!({ "doubtful": 1 }));
}

/// `check` told default numerics with the ids and the cost of other cases than those that the sweep then had.
#[test]
fn check_chooses_numerics_for_a_wanted_error_as_sweep_does() {
    let text = TINY.replace("[0.4, 0.5]", "[0.4]").replace("[10, 1e4]", "[10]");
    let text = text.replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.02");
    let desk = Desk::new(&text);
    let told = |arguments: &[&str]| ended(0, &[arguments, &["--format", "json"]].concat()).json();
    let checked = told(&["check", &desk.file, "--max-error", "60"]);
    assert_eq!(checked["max_error_percent"], 60.0);
    assert_eq!(checked["companions"], 2);
    assert_ne!(checked["cases"], told(&["check", &desk.file])["cases"]);
    assert_eq!(checked, told(&["sweep", &desk.file, "--dry-run", "--max-error", "60"]));
    ended(0, &["sweep", &desk.file, "--max-error", "60", "--out", &desk.dir]);
    let table = fs::read_to_string(desk.out.join("max_error.csv")).unwrap();
    let swept: Vec<_> = table.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    let cases = checked["cases"].as_array().unwrap().iter();
    assert_eq!(cases.map(|case| case["id"].as_str().unwrap()).collect::<Vec<_>>(), swept);

    fs::write(&desk.file, text.replace("[grid]", "[accuracy]\nmax_error_percent = 60\n[grid]"))
        .unwrap();
    assert_eq!(checked, told(&["check", &desk.file]));
    let Told { out: words, err: notes } = ended(0, &["check", &desk.file]);
    assert!(notes.contains("the cheapest that is expected to be within 60 %"), "{notes}");
    assert!(words.contains("\nmax error           60 %: these are the numerics that"), "{words}");
    assert!(words.contains(" with what runs again, without films\n"), "{words}");
    let seconds =
        ["estimated_time_s", "longest_time_s"].map(|name| checked[name].as_f64().unwrap());
    assert!(seconds[1] > 5.0 * seconds[0], "{seconds:?}");

    // A single scene runs as it is.
    let scene = "name = \"a\"\n[accuracy]\nmax_error_percent = 60";
    fs::write(&desk.file, scene).unwrap();
    let warned = told(&["check", &desk.file])["warnings"].to_string();
    assert!(warned.contains("accuracy.max_error_percent = 60: only `seawall sweep`"), "{warned}");
    let words = ended(2, &["check", &desk.file, "--max-error", "2"]).err;
    assert!(words.contains("--max-error 2: chooses the numerics of a sweep"), "{words}");
}
