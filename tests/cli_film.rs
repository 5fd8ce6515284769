//! `seawall film`, `run --film` and `sweep --film`, from outside.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::common::job::signal;
use crate::common::{Desk, TINY, ended, expect_code, results, run, seawall, write_file};

/// Two waves on one wall, coarse.
fn swept(directory: &Path, films: &[&str]) -> PathBuf {
    let text = TINY
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.03");
    let (file, out) = (write_file(directory, &text), directory.join("out"));
    let arguments = ["sweep", &file, "--out", out.to_str().unwrap()];
    ended(0, &[&arguments[..], films].concat());
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
    ended(0, &["report", out.to_str().unwrap()]);
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
    let file = file.to_str().unwrap();
    let command = ["sweep", file, "--out", out.to_str().unwrap()];
    let told = ended(0, &command).out;
    assert!(told.contains("2 of 2 cases are well; films "), "{told}");
    let told = ended(0, &["check", file]).out;
    assert!(told.lines().any(|line| line.ends_with(", without films")), "{told}");

    // A call that makes none tells them all the same.
    let value = ended(0, &[&command[..], &["--format", "json"]].concat()).json();
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
    let file = root.path().join("sweep.toml");
    let (file, out) = (file.to_str().unwrap(), plain.to_str().unwrap());
    fs::create_dir_all(plain.join("films/reasons.csv")).unwrap();
    let told = ended(0, &["sweep", file, "--out", out]).err;
    assert!(told.contains("out/films/reasons.csv: a directory stands in the place"), "{told}");
    fs::remove_dir_all(plain.join("films")).unwrap();
    fs::write(plain.join("films"), "in the way").unwrap();
    let told = ended(0, &["sweep", file, "--out", out]).err;
    assert!(told.contains("not filmed: ") && told.contains("out/films: "), "{told}");
    assert_eq!(results(&plain), before);
    ended(1, &["film", out, "wave_height_ratio=0.5"]);
    // What is kept beside the page cannot be written: as for `report` no error of the program.
    fs::remove_file(plain.join("derived.json")).unwrap();
    fs::create_dir(plain.join("derived.json")).unwrap();
    ended(2, &["film", out, "wave_height_ratio=0.5"]);

    let alone = root.path().join("alone");
    let case = ["run", file, "wave_height_ratio=0.5", "--out", alone.to_str().unwrap(), "--film"];
    ended(0, &case);
    fs::remove_dir_all(alone.join("films")).unwrap();
    fs::write(alone.join("films"), "in the way").unwrap();
    let journal = alone.join("journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, format!("{}\n", text.lines().next().unwrap())).unwrap();
    let told = ended(0, &case).err;
    assert!(told.contains("warning: case") && told.contains("not filmed: "), "{told}");
    let name = fs::read_dir(alone.join("histories")).unwrap().next().unwrap().unwrap().file_name();
    let history = |out: &Path| fs::read(out.join("histories").join(&name)).unwrap();
    assert_eq!(history(&alone), history(&plain));
}

#[test]
fn an_interrupted_film_is_made_by_the_same_command() {
    let text = TINY
        .replace("[0.4, 0.5]", "[0.5]")
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "particle_spacing_m = 0.01");
    let desk = Desk::new(&text);
    desk.sweep(&["--film", "none"]);
    let before = results(&desk.out);
    let mut child = seawall()
        .args(["sweep", &desk.file, "--out", &desk.dir])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let told = BufReader::new(child.stderr.take().unwrap()).lines();
    let mut told = told.map(Result::unwrap).skip_while(|line| line != "filming 1 case");
    assert!(told.next().is_some());
    assert!(signal(child.id(), "INT"));
    let rest: Vec<_> = told.collect();
    assert_eq!(child.wait().unwrap().code(), Some(3), "{rest:?}");
    assert!(films(&desk.out).is_empty() && !desk.out.join("films/reasons.csv").exists());
    desk.sweep(&[]);
    assert!(films(&desk.out).len() == 4 && desk.out.join("films/reasons.csv").exists());
    assert_eq!(results(&desk.out), before);
}

#[test]
fn cases_whose_numerics_were_chosen_are_filmed_verified_and_told() {
    let text = TINY
        .replace("[10, 1e4]", "[10]")
        .replace("[50, 250]", "[50]")
        .replace("particle_spacing_m = 0.025", "courant_number = 1.4");
    let desk = Desk::new(&text);
    // The first spacings do not do for all: a second round runs finer.
    let sweep = ["sweep", &desk.file, "--out", &desk.dir, "--max-error", "0.6", "--film", "none"];
    let told = ended(0, &sweep).err;
    assert!(told.contains("these run once more with finer particles"), "{told}");
    // An id goes with its numerics: that of the first round was told by `check`, that of the last by the tables.
    let check = ["check", &desk.file, "--max-error", "0.6", "--format", "json"];
    let first = ended(0, &check).json()["cases"][1]["id"].as_str().unwrap().to_owned();
    let table = fs::read_to_string(desk.out.join("max_error.csv")).unwrap();
    let last = table.lines().nth(2).unwrap().split(',').next().unwrap();
    assert_ne!(first, last);
    let film = |id| [&sweep[..6], &["--film", id]].concat();
    ended(0, &film(last));
    let anew = ["--fresh"];
    ended(0, &[&film(&first)[..], &anew].concat());
    assert!(films(&desk.out).contains(&format!("{last}.html")));
    fs::remove_dir_all(desk.out.join("films")).unwrap();
    let before = results(&desk.out);
    for wave in ["wave_height_ratio=0.4", "wave_height_ratio=0.5"] {
        ended(0, &["film", &desk.dir, wave]);
        let text = ended(0, &["show", &desk.dir, wave, "--toml"]);
        let scene = desk.path().join("scene.toml");
        fs::write(&scene, &text.out).unwrap();
        ended(
            0,
            &["run", scene.to_str().unwrap(), "--out", desk.path().join(wave).to_str().unwrap()],
        );
    }
    assert_eq!(films(&desk.out).len(), 8);
    assert_eq!(results(&desk.out), before);
    let mut again = fs::read_dir(desk.out.join("histories")).unwrap().map(|entry| entry.unwrap());
    let is_there = |entry: &fs::DirEntry| {
        let alone =
            ["0.4", "0.5"].map(|wave| desk.path().join(format!("wave_height_ratio={wave}")));
        alone.iter().any(|out| out.join("histories").join(entry.file_name()).exists())
    };
    assert_eq!(again.by_ref().filter(is_there).count(), 2, "the scene files are those cases");
    ended(0, &["verify", &desk.dir, "--rerun", "1"]);
    // A summary that is lost comes back from the journal.
    let summary = fs::read(desk.out.join("summary.csv")).unwrap();
    fs::remove_file(desk.out.join("summary.csv")).unwrap();
    fs::write(desk.out.join("summary.csv"), "case_id\n").unwrap();
    ended(0, &["report", &desk.dir]);
    assert_eq!(fs::read(desk.out.join("summary.csv")).unwrap(), summary);
}

#[test]
fn a_film_that_cannot_be_is_refused_before_anything_runs() {
    let desk = Desk::new(TINY);
    let arguments = ["sweep", &desk.file, "--out", &desk.dir];
    let output = ended(2, &[&arguments[..], &["--film", "wave_height_ratio=0.45"]].concat());
    assert!(output.err.contains("there is 0.4, 0.5"));
    assert!(!desk.out.exists());
}

#[test]
fn a_run_is_filmed_also_when_it_is_finished() {
    let text = TINY.split("[grid]").next().unwrap().replace(
        "wall = \"movable\"",
        "wall = \"movable\"\nspring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50",
    );
    let text = text.replace("[numerics]", "[numerics]\nerror_bars = \"pair\"");
    let desk = Desk::new(&text);
    let arguments = ["run", &desk.file, "--out", &desk.dir, "--film"];
    ended(0, &arguments);
    // Its companion for error bars is not filmed, and what it tells is told.
    let again = |more: &[&str]| run(&[&arguments[..4], more].concat()).stdout;
    let record: serde_json::Value = serde_json::from_slice(&again(&["--format", "json"])).unwrap();
    let id = record["id"].as_str().unwrap();
    assert!(films(&desk.out).iter().all(|name| name.starts_with(id)), "{:?}", films(&desk.out));
    let bar = record["error_bars"]["force_max_error"].as_f64().unwrap();
    let summary = fs::read_to_string(desk.out.join("summary.csv")).unwrap();
    assert!(bar > 0.0 && summary.contains(&format!(",{bar},")), "{bar} in {summary}");
    let told = String::from_utf8(again(&[])).unwrap();
    let force = told.lines().find(|line| line.starts_with("F* max ")).unwrap();
    assert!(force.contains('±') && !told.contains("error"), "{told}");
    let name = films(&desk.out)[1].clone();
    let page = fs::read(desk.out.join("films").join(&name)).unwrap();
    assert!(page.len() < 400_000);
    fs::remove_dir_all(desk.out.join("films")).unwrap();
    ended(0, &arguments);
    assert_eq!(fs::read(desk.out.join("films").join(&name)).unwrap(), page);
    ended(0, &[&arguments[..], &["speed"]].concat());
    assert_ne!(fs::read(desk.out.join("films").join(&name)).unwrap(), page);
}

/// The story: water that fills a box had a "Highest runup", and a panel of gaps between its vortices as
/// R / h. Its force was said to be over ½ρgh², without gravity.
#[test]
fn water_without_a_level_has_no_runup() {
    let desk = Desk::new(
        "name = \"box\"\n[scene]\nkind = \"taylor-green\"\nend_time_s = 0.2\n\
         [numerics]\nparticle_spacing_m = 0.05",
    );
    ended(0, &["run", &desk.file, "--out", &desk.dir, "--film"]);
    ended(0, &["report", &desk.dir]);
    let read = |name: &str| fs::read_to_string(desk.out.join(name)).unwrap();
    let figure = read("figures/history.svg");
    assert!(figure.contains("F / (ρU²L)") && !figure.contains("R / h"), "{figure}");
    let [page, still] = &films(&desk.out)[..] else { panic!("{:?}", films(&desk.out)) };
    assert!(!read(&format!("films/{still}")).contains("R* ="));
    let film = read(&format!("films/{page}"));
    assert!(film.contains("force on the wall over ρU²L") && !film.contains("runup over h"));
    let film = film.split("id=\"film\">").nth(1).unwrap().split("</script>").next().unwrap();
    let film: serde_json::Value = serde_json::from_str(film).unwrap();
    assert_eq!(film["highest"], film["crest"], "there is no button of its own");
}
