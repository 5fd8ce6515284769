//! Every sweep and scene that is shipped passes the same door as a user's own.

use std::fs;
use std::path::{Path, PathBuf};

use seawall::accuracy::{Matrix, Trial};
use seawall::keys::{Section, Shape};
use seawall::scene::{CaseConfig, Kind, Numerics, Preset, numerics_keys, scene_keys};
use seawall::study::{PHYSICS_VERSION, Study, SweepFile};
use toml::{Table, Value};

#[test]
fn every_scene_is_valid() {
    let mut shipped = files("sweeps/scenes");
    shipped.extend(files("sweeps/usace_1995"));
    assert!(shipped.len() >= 9);
    for path in shipped {
        let file = read(&path);
        assert!(!file.contains_key("grid"), "{}: a scene has no grid", path.display());
        validate(&path, &file);
    }
}

/// The story: the nightly study was compared with one of an older physics version, no case of which it has.
#[test]
fn the_nightly_reference_is_of_this_physics_version() {
    let manifest = fs::read_to_string("results/nightly/manifest.json").unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(
        manifest["physics_version"], PHYSICS_VERSION,
        "scripts/nightly --accept stores a new one"
    );
}

/// The story: a new key that was not `newer` changed the id of every stored case, and no test noticed.
#[test]
fn the_nightly_study_has_the_cases_that_are_stored() {
    let read = |path: &str| fs::read_to_string(path).unwrap();
    let manifest: serde_json::Value =
        serde_json::from_str(&read("results/nightly/manifest.json")).unwrap();
    if manifest["physics_version"] != PHYSICS_VERSION {
        return;
    }
    let file = SweepFile::read(&read("sweeps/nightly.toml"), &[]).unwrap();
    let cases = Study::new(&file).unwrap().cases;
    let ids: Vec<_> = cases.iter().map(|case| case.id.to_string()).collect();
    let summary = read("results/nightly/summary.csv");
    let stored = summary.lines().skip(1).map(|line| line.split(',').next().unwrap());
    assert_eq!(
        ids,
        stored.collect::<Vec<_>>(),
        "a new key is `newer`, or PHYSICS_VERSION rises with it"
    );
}

#[test]
fn every_corner_of_every_sweep_is_valid() {
    let mut shipped = files("sweeps");
    assert!(shipped.len() >= 6);
    shipped.extend(files("sweeps/boundary_comparison"));
    shipped.extend(files("sweeps/liang2017"));
    shipped.extend(files("sweeps/huang2019"));
    for path in shipped {
        let file = read(&path);
        if file.contains_key("case") {
            let matrix = Matrix::read(&fs::read_to_string(&path).unwrap());
            let matrix = matrix.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let (_, pairs) = matrix.study(false, "");
            let default = |pair: &&Trial| matrix.methods[pair.method].numerics.is_empty();
            for pair in pairs.iter().filter(default) {
                let (name, run) = (&matrix.cases[pair.case].name, &pair.run);
                assert!(run.is_ok(), "{}: {name}: {run:?}", path.display());
            }
            continue;
        }
        for last in [false, true] {
            validate(&path, &corner(&file, last));
        }
    }
}

/// The story: a shipped sweep could set what none of its cases reads, and users would copy it.
#[test]
fn every_key_of_a_shipped_file_is_read() {
    let folders = ["scenes", "usace_1995", "boundary_comparison", "liang2017", "huang2019", ""];
    for path in folders.iter().flat_map(|folder| files(&format!("sweeps/{folder}"))) {
        let text = fs::read_to_string(&path).unwrap();
        if !read(&path).contains_key("case") {
            let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
            assert_eq!(study.unread, [], "{}", path.display());
        }
    }
}

#[test]
fn names_are_the_files_own_and_differ() {
    let folders = ["sweeps", "sweeps/scenes", "sweeps/boundary_comparison", "sweeps/huang2019"];
    let mut names: Vec<_> = folders
        .into_iter()
        .flat_map(files)
        .map(|path| read(&path)["name"].as_str().unwrap().to_owned())
        .collect();
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "two files of one name would share an output directory");
}

/// A choice that no run makes, and a scene that none takes, could change unseen.
#[test]
fn same_answers_has_every_choice_and_every_scene() {
    let script = fs::read_to_string(root().join("scripts/same_answers")).unwrap();
    let words = |text: &str| -> Vec<String> {
        let parts = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '-');
        parts.map(str::to_owned).collect()
    };
    // What a key is set to, as "scene.behind=floor" or as a list of the grid, which a variable may hold.
    let set_to = |key: &str| -> Vec<String> {
        let all = script.split_whitespace().filter_map(|word| word.split_once(&format!(".{key}=")));
        let texts = all.map(|(_, text)| if text.contains('$') { script.as_str() } else { text });
        texts.flat_map(words).collect()
    };
    let scenes: String =
        files("sweeps/scenes").iter().map(|path| fs::read_to_string(path).unwrap()).collect();
    let of_scenes = Kind::ALL.iter().flat_map(|&kind| scene_keys(kind));
    for key in numerics_keys().into_iter().chain(of_scenes) {
        let Shape::Names(names) = (key.shape)() else { continue };
        let default = (key.default)();
        let default = default.as_ref().and_then(Value::as_str);
        for name in names.iter().filter(|name| Some(**name) != default) {
            let is_run = set_to(key.name).iter().any(|word| word == name)
                || scenes.contains(&format!("{} = {name:?}", key.name));
            assert!(is_run, "no run has {} = {name:?}", key.name);
        }
    }
    for path in files("sweeps/scenes") {
        let name = format!(" scenes/{} ", path.file_name().unwrap().to_str().unwrap());
        assert!(script.contains(&name), "no run takes {}", path.display());
    }
}

/// Tables of papers hold how long steps took, and no two runs agree in that.
#[test]
fn same_answers_leaves_out_how_long_a_step_took() {
    let script = root().join("scripts/same_answers");
    let places = tempfile::tempdir().unwrap();
    let differs = |quantity: &str| {
        let [old, new] = ["0.97", "0.99"].map(|computed| {
            let file = places.path().join(computed);
            let text =
                format!("paper,figure,quantity,computed\nhuang2019,4,{quantity},{computed}\n");
            fs::write(&file, text).unwrap();
            file
        });
        let compare = r#"set -e; source <(sed -n "/^cells() {/,/^}/p" "$0"); cells "$1" "$2""#;
        let mut bash = std::process::Command::new("bash");
        let told = bash.args(["-c", compare]).args([&script, &old, &new]).output().unwrap();
        assert!(told.status.success());
        String::from_utf8(told.stdout).unwrap()
    };
    assert_eq!(differs("step_time_of_sfdi"), "");
    assert_eq!(differs("force"), "line 2, computed: 0.99 instead of 0.97\n");
}

/// A run that was stopped was kept as an answer, and the script went on with the next. The story: where this was asked
/// with INT, it failed under a parent that ignores INT, as its children do, too.
#[test]
fn same_answers_keeps_nothing_when_it_is_stopped() {
    use std::os::unix::fs::PermissionsExt;
    use std::os::unix::process::CommandExt;
    use std::process::{Command, Stdio};
    let room = tempfile::tempdir().unwrap();
    let [program, began, kept] = ["program", "began", "kept"].map(|name| room.path().join(name));
    let text =
        format!("#!/bin/sh\ntrap 'exit 3' INT TERM\ntouch {}\nsleep 20 & wait\n", began.display());
    fs::write(&program, text).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let mut script = Command::new(root().join("scripts/same_answers"));
    script.arg("keep").args([&kept, &program]).args(["--only", "smoke", "--only", "nightly"]);
    let script = script.stderr(Stdio::piped()).process_group(0).spawn().unwrap();
    while !began.exists() {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    // As a terminal does: to all of them.
    let everybody = format!("-{}", script.id());
    assert!(Command::new("kill").args(["-TERM", "--", &everybody]).status().unwrap().success());
    let told = script.wait_with_output().unwrap();
    assert_eq!((told.status.code(), kept.exists()), (Some(3), false), "{told:?}");
}

/// Five of them took `--help` for work: they installed packages, and built for minutes.
#[test]
fn every_script_tells_what_it_does_and_does_nothing_else() {
    use std::os::unix::fs::PermissionsExt;
    let room = tempfile::tempdir().unwrap();
    for tool in ["cargo", "apt-get", "sudo", "rustup", "python3", "mpirun"] {
        let file = room.path().join(tool);
        fs::write(&file, format!("#!/bin/sh\necho {tool} >&2\nexit 1\n")).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", room.path().display(), std::env::var("PATH").unwrap());
    for entry in fs::read_dir(root().join("scripts")).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            continue;
        }
        let mut script = std::process::Command::new(&entry);
        script.arg("--help").env("PATH", &path).env("CARGO_TARGET_DIR", room.path());
        let told = script.output().unwrap();
        let words = String::from_utf8_lossy(&told.stdout);
        let name = entry.display();
        assert_eq!(told.status.code(), Some(0), "{name}: {told:?}");
        assert!(words.lines().count() >= 3 && !words.contains("set -e"), "{name}: {words}");
        assert!(told.stderr.is_empty(), "{name}: {told:?}");
    }
}

#[test]
fn every_script_is_in_the_architecture() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let (_, table) = text.split_once("| script | what it does |").unwrap();
    for entry in fs::read_dir(root().join("scripts")).unwrap().map(|entry| entry.unwrap()) {
        let name = entry.file_name().into_string().unwrap();
        let told = table.contains(&format!("`{name}`"));
        assert!(told || entry.path().is_dir(), "the table of scripts has no {name}");
    }
}

#[test]
fn the_study_of_liang_has_its_300_cases() {
    for name in ["liang2017", "liang2017_as_published"] {
        let grid =
            read(&root().join(format!("sweeps/{name}.toml")))["grid"].as_table().unwrap().clone();
        let cases: usize = grid.values().map(|values| values.as_array().unwrap().len()).product();
        assert_eq!(cases, 300, "{name}");
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
    files.sort();
    files
}

fn read(path: &Path) -> Table {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.starts_with("# "), "{}: it opens with what it is", path.display());
    text.parse().unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The sweep's first or last case: the scene with one value of each swept key.
fn corner(file: &Table, last: bool) -> Table {
    let mut file = file.clone();
    let grid = file.remove("grid").expect("a sweep has a grid");
    // The one that has the keys of both schemes.
    let numerics = Numerics::preset(Preset::Isph).table();
    for (key, values) in grid.as_table().unwrap() {
        let values = values.as_array().unwrap();
        let value = if last { values.last() } else { values.first() };
        let section = if numerics.get(key).is_some() { "numerics" } else { "scene" };
        let section = file[section].as_table_mut().unwrap();
        section.insert(key.clone(), value.unwrap().clone());
    }
    // Where walls are swept, only movable ones take what belongs to them.
    let scene = file["scene"].as_table_mut().unwrap();
    if grid.get("wall").is_some() && scene["wall"].as_str() == Some("fixed") {
        scene.remove("spring_stiffness_n_per_m");
        scene.remove("seawall_mass_kg_per_m");
    }
    file
}

fn validate(path: &Path, file: &Table) {
    let table = |name: &str| file.get(name).and_then(Value::as_table).cloned().unwrap_or_default();
    let probes = file.get("probe").and_then(Value::as_array).cloned().unwrap_or_default();
    let probes: Vec<_> = probes.iter().map(|probe| probe.as_table().unwrap().clone()).collect();
    CaseConfig::with_probes(&table("scene"), &table("numerics"), &probes)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}
