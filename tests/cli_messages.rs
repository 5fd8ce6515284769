//! What the program says: refusals before anything is written, and marks beside doubtful numbers.

use std::fs;

use crate::common::{Desk, TINY, Told, ended, write_file};

/// A single scene of a second or less: its wall is still moving when it ends.
fn short_scene() -> String {
    let scene = TINY.split("[grid]").next().unwrap();
    scene.replace(
        "wall = \"movable\"",
        "wall = \"movable\"\nwave_height_ratio = 0.5\n\
        spring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50",
    )
}

#[test]
fn more_particles_than_a_machine_holds_are_refused_by_every_command() {
    let desk = Desk::new(TINY);
    let Desk { file, dir, .. } = &desk;
    let fine = ["--set", "numerics.particle_spacing_m=1e-5"];
    let refuse = |command: &[&str]| {
        let output = ended(2, &[command, &fine].concat());
        assert!(output.err.contains("20,000,000 are the most: choose 0.0001"));
    };
    refuse(&["sweep", file, "--out", dir]);
    refuse(&["check", file]);
    desk.write(&short_scene());
    refuse(&["run", file, "--out", dir]);
    let text = ended(0, &["check", file, "--set", "numerics.particle_spacing_m=0.000101"]).out;
    assert!(text.contains("GiB") && text.contains(" days on"), "{text}");
    assert!(text.contains("known limit, 1 case: more than 1,000,000 particles"), "{text}");
    assert!(!desk.out.exists());
}

#[test]
fn check_shows_what_is_on() {
    let desk = Desk::new(TINY);
    let check = |settings: &[&str]| ended(0, &[&["check", &desk.file], settings].concat()).out;
    let single = check(&["--set", "numerics.precision=f32", "--set", "numerics.retries=2"]);
    assert!(single.contains("\nprecision           f32\n"), "{single}");
    assert!(single.contains("\nretries             2\n"), "{single}");
    let isph = check(&["--set", "numerics.scheme=isph"]);
    assert!(isph.contains("\nlaplacian           exact\n"), "{isph}");
    assert!(!isph.contains("bulk damping") && !isph.contains("precision"), "{isph}");
}

#[test]
fn check_and_sweep_answer_an_empty_grid_alike() {
    let desk = Desk::new("name = \"a\"\n[grid]\n");
    let [check, sweep] = ["check", "sweep"].map(|command| ended(2, &[command, &desk.file]).err);
    assert_eq!(check, sweep);
    assert!(check.contains("grid: holds no key"), "{check}");
}

#[test]
fn a_file_that_is_no_text_is_told_as_such() {
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("latin.toml");
    fs::write(&file, b"name = \"a\"\n# H\xf6he\n").unwrap();
    for command in ["check", "sweep", "run", "accuracy"] {
        let text = ended(2, &[command, file.to_str().unwrap()]).err;
        assert!(
            text.ends_with("latin.toml: line 2: is not UTF-8 text; save it as UTF-8\n"),
            "{text}"
        );
    }
}

#[test]
fn lower_bounds_are_marked_and_nothing_is_filmed_twice() {
    let desk = Desk::new(&short_scene());
    let command = ["run", &desk.file, "--threads", "1", "--out", &desk.dir];
    let first = ended(0, &command);
    let (text, notes) = (first.out, first.err);
    assert!(notes.contains("1 case on 1 thread,"), "{notes}");
    let line = text.lines().find(|line| line.starts_with("X* max")).unwrap();
    assert!(line.contains("≥ ") && line.ends_with(" s, still moving at the end"), "{line}");
    // The spring's force is that of the same instant. `show` marked it, and `run` did not.
    let shown = ended(0, &["show", &desk.dir]).out;
    for (told, text) in [("run", &text), ("show", &shown)] {
        let line = |name: &str| text.lines().map(str::trim).find(|line| line.starts_with(name));
        let [largest, spring] = ["X* max", "spring F* max"].map(|name| line(name).unwrap());
        assert!(largest.contains("≥ ") && spring.contains("≥ "), "{told}: {largest}, {spring}");
    }
    let notes = ended(0, &[&command[..], &["--vtk"]].concat()).err;
    assert!(notes.contains("--vtk: nothing was written") && notes.contains("--fresh"), "{notes}");
    assert!(!desk.out.join("vtk").exists());
    let filmed = ended(0, &[&command[..], &["--vtk", "0.5", "--fresh"]].concat());
    assert!(!filmed.err.contains("nothing was written") && desk.out.join("vtk").exists());
}

#[test]
fn what_a_run_has_filmed_is_verified() {
    let desk = Desk::new(&short_scene());
    for (option, ending, folder) in [("--vtk", ".vtu", "vtk"), ("--film", ".svg", "films")] {
        let out = desk.path().join(folder);
        let directory = out.to_str().unwrap();
        let spacing = "numerics.particle_spacing_m=0.05";
        let run_it = ["run", &desk.file, "--set", spacing, "--out", directory, option];
        ended(0, &run_it);
        ended(0, &["verify", directory]);
        let case = fs::read_dir(out.join("histories")).unwrap().next().unwrap().unwrap().path();
        let case = case.file_stem().unwrap().to_str().unwrap().to_owned();
        let inside = if folder == "vtk" { out.join("vtk").join(&case) } else { out.join("films") };
        let path = fs::read_dir(inside).unwrap().map(|entry| entry.unwrap().path());
        let path = path.into_iter().find(|path| path.to_str().unwrap().ends_with(ending)).unwrap();
        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 2;
        fs::write(&path, bytes).unwrap();
        let verified = ended(1, &["verify", directory]);
        let name = path.strip_prefix(&out).unwrap().to_str().unwrap();
        assert_eq!(verified.out, format!("{name} is damaged\n"));
        // A report makes its own files and leaves what was filmed.
        ended(0, &["report", directory]);
        assert_eq!(ended(1, &["verify", directory]).out, format!("{name} is damaged\n"));
        ended(0, &[&run_it[..], &["--fresh"]].concat());
        ended(0, &["verify", directory]);
    }
}

#[test]
fn a_sweeps_table_marks_lower_bounds_and_doubtful_cases() {
    let desk = Desk::new(TINY);
    let coarse = ["--set", "numerics.particle_spacing_m=0.05"];
    let text = desk.sweep(&coarse).out;
    let mut reader = csv::Reader::from_path(desk.out.join("summary.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let place = |name: &str| headers.iter().position(|header| header == name).unwrap();
    let (bound, [doubt, reason]) =
        (place("displacement_truncated"), ["doubtful", "doubtful_reason"].map(place));
    let bounds = rows.iter().filter(|row| &row[bound] == "true").count();
    let doubtful = rows.iter().filter(|row| &row[doubt] == "true").count();
    assert!(bounds > 0 && doubtful > 0, "{bounds} {doubtful}");
    assert!(rows.iter().all(|row| row[reason].is_empty() == (&row[doubt] == "false")));
    // Once in every such row, and once below the table.
    assert_eq!(text.matches('≥').count(), bounds + 1, "{text}");
    let line = format!("{doubtful} finished case");
    assert!(text.lines().any(|told| told.starts_with(&line)), "{text}");
    assert!(text.contains(" doubtful (doubtful_reason in summary.csv)"), "{text}");
    assert_eq!(text.lines().filter(|line| line.ends_with("doubtful")).count(), doubtful, "{text}");
}

#[test]
fn coarse_particles_have_a_sentence_of_their_own_and_no_doubt() {
    let desk = Desk::new(TINY);
    let text = desk.sweep(&[]).out;
    let sentence =
        "8 finished cases have coarse particles (coarse_spacing in summary.csv)\n  8.0 rows ";
    assert!(text.contains(sentence), "{text}");
    assert!(text.lines().all(|line| line.starts_with("report: ") || line.chars().count() <= 80));
    let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
    assert!(page.contains("8 of 8 results have coarse particles: 8.0 rows over the depth; "));
    // The story: `check` told of lower forces and of runups up to 20 % low, and nothing of displacements.
    let off = "forces are up to 3 %, displacements 9 % off, runups 0.25 h low";
    assert!(ended(0, &["check", &desk.file]).out.contains(off));
    let mut reader = csv::Reader::from_path(desk.out.join("summary.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let place = |name: &str| headers.iter().position(|header| header == name).unwrap();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert!(rows.iter().filter(|row| &row[place("doubtful")] == "false").count() >= 4);
    for row in rows {
        assert!(!row[place("doubtful_reason")].contains("coarse"), "{row:?}");
        assert!(row[place("coarse_spacing")].starts_with("8.0 rows over the depth; below 10, "));
        // Bars of 1 % stood beside a sentence of 3 %. Here there are none.
        assert!(row[place("coarse_spacing")].ends_with(off));
    }
}

/// The story: `check` alone told of known limits. Who ran a file at once never heard that its preset
/// reads forces a fifth too high.
#[test]
fn known_limits_are_told_by_run_and_sweep() {
    let scene = TINY.split("[grid]").next().unwrap().replace("wall = \"movable\"\n", "");
    let scene = Desk::new(&scene.replace("= 0.8", "= 0.1").replace("= 0.025", "= 0.05"));
    let preset = ["--set", "numerics.preset=huang2019"];
    let told = scene.run(&preset).err;
    let limit = "known limit, 1 case: waves at a wall without corrected_gradients: ";
    assert!(told.contains(limit) && told.contains("the moment 23 % high"), "{told}");
    assert_eq!(told.matches(limit).count(), 1, "{told}");
    let quiet = scene.run(&[&preset[..], &["--fresh", "--quiet"]].concat()).err;
    assert!(!quiet.contains("known limit"), "{quiet}");
    let desk = Desk::new(&TINY.replace("= 0.8", "= 0.1").replace("= 0.025", "= 0.05"));
    let told = desk.sweep(&["--film", "none"]).err;
    let limit = "known limit, 8 cases: fewer than 10 particles over the depth";
    assert_eq!(told.matches(limit).count(), 1, "{told}");
}

#[test]
fn a_directory_that_cannot_be_written_is_bad_input() {
    let desk = Desk::new(TINY);
    desk.sweep(&["--set", "numerics.particle_spacing_m=0.05"]);
    fs::remove_dir_all(desk.out.join("figures")).unwrap();
    fs::write(desk.out.join("figures"), "in the way").unwrap();
    let text = ended(2, &["report", &desk.dir]).err;
    assert_eq!(text.matches("something else stands in its place").count(), 1, "{text}");
    assert!(text.contains("figures: cannot be written: "), "{text}");
}

#[test]
fn a_method_with_a_comma_in_its_name_can_be_chosen() {
    let root = tempfile::tempdir().unwrap();
    let out = root.path().join("out");
    let out_name = out.to_str().unwrap();
    let wrong = ended(2, &["accuracy", "--method", "R 3, dx 7", "--out", out_name]);
    assert!(wrong.err.contains("\"R 3, dx 0.0125\""), "{}", wrong.err);
    // The case is refused first, so nothing runs.
    let command = ["accuracy", "--case", "no such case", "--method", "R 3, dx 0.0125"];
    let refused = ended(2, &[&command[..], &["--out", out_name]].concat()).err;
    assert!(refused.contains("--case = \"no such case\""));
    assert!(!out.exists());
}

#[test]
fn figures_for_print_come_in_two_widths_and_no_other_format() {
    let root = tempfile::tempdir().unwrap();
    let stored = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("results/nightly");
    for name in ["summary.csv", "manifest.json"] {
        fs::copy(stored.join(name), root.path().join(name)).unwrap();
    }
    let directory = root.path().to_str().unwrap();
    let words = ended(2, &["report", directory, "--figures", "pdf,tiff"]).err;
    assert!(words.contains("tiff") && words.contains("svg, pdf, png"), "{words}");
    assert!(!root.path().join("figures").exists(), "nothing is written");
    let command = ["report", directory, "--figures", "pdf"];
    if !cfg!(feature = "print") {
        assert!(ended(2, &command).err.contains("--features print"));
        return;
    }
    ended(0, &command);
    for width in ["84mm", "174mm"] {
        let file = root.path().join(format!("figures/response-force-{width}.pdf"));
        assert!(fs::read(file).unwrap().starts_with(b"%PDF"));
    }
    assert!(!root.path().join("figures/response-force-84mm.png").exists());
}

/// Whatever a path holds, no message lets it move the cursor or begin a line.
#[test]
fn paths_are_told_as_text() {
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), TINY), root.path().join("a\n\u{1b}[31mb"));
    let directory = out.to_str().unwrap();
    let sweep = || ended(0, &["sweep", &file, "--out", directory, "--checkpoint-every-s", "0.001"]);
    sweep();
    let history = || fs::read_dir(out.join("histories")).unwrap().next().unwrap().unwrap().path();
    let told_whole = |told: Told, words: &str| {
        let text = told.out + &told.err;
        assert!(text.lines().any(|line| line.contains(words)), "{text}");
        assert!(!text.contains('\u{1b}') && !text.contains("\n["), "{text:?}");
        let whole = text.lines().filter(|line| line.contains("31mb"));
        assert!(whole.into_iter().all(|line| line.contains(r"a\n\u{1b}[31mb")), "{text:?}");
    };
    fs::write(history(), "").unwrap();
    told_whole(ended(1, &["verify", directory]), ".csv is damaged");
    // No checkpoint can be written beside a file of the folder's name.
    fs::write(out.join("checkpoints"), "").unwrap();
    told_whole(sweep(), "no checkpoint could be written");
}

#[test]
fn error_bars_that_nobody_can_make_are_told_with_the_reason() {
    let scene = "name = \"a\"\n[scene]\nbehind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.07\n\
                 [numerics]\nparticle_spacing_m = 0.012\nerror_bars = \"pair\"\n[grid]\n\
                 wave_height_ratio = [0.3]\n";
    let desk = Desk::new(scene);
    let told = ended(0, &["check", &desk.file]).out;
    let why = "1 case will have none, as a companion with coarser particles cannot run (scene.crest_width_m";
    assert!(told.contains(why), "{told}");
    assert!(!told.contains("error_bars = \"pair\" tells"), "{told}");
    // The companions of a dam break ran, and no word said that nothing comes of them.
    let column = "name = \"a\"\n[scene]\nkind = \"dam-break\"\n[numerics]\nerror_bars = \"pair\"\n";
    let told = ended(0, &["check", &Desk::new(column).file]).out;
    let why = "error_bars: 1 case will have none, as only scenes of seawalls have them";
    assert!(told.contains(why), "{told}");
}

/// The story: `--quiet` prints nothing but errors. Of failed cases it printed nothing either.
#[test]
fn failed_cases_are_told_whatever_is_left_out() {
    let limits = |file: &str| format!("{file}\n[limits]\nsteps = 3\n");
    let desk = Desk::new(&limits(TINY));
    let told = ended(1, &["sweep", &desk.file, "--out", &desk.dir, "--film", "none", "--quiet"]);
    assert_eq!(told.out, "");
    assert_eq!(told.err.lines().count(), 1, "{}", told.err);
    assert!(told.err.starts_with("error: 8 cases failed, see "), "{}", told.err);
    let scene = TINY.split("[grid]").next().unwrap().replace("wall = \"movable\"\n", "");
    let scene = Desk::new(&limits(&scene));
    let told = ended(1, &["run", &scene.file, "--out", &scene.dir, "--quiet"]).err;
    assert!(told.starts_with("error: case ") && told.contains(" failed: over-limit"), "{told}");
}
