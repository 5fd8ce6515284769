//! What a study leaves, beside what docs/files.md tells of it; and columns that mean nothing for a case.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::common::{Desk, ended};

/// Regular waves at a wall, coarse and short.
const TRAIN: &str = "name = \"few\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\npaddle = \"wave-train\"\n\
                     wave_period_s = 1\nend_time_s = 3.5\n[numerics]\nparticle_spacing_m = 0.025\n\
                     error_bars = \"pair\"\n[grid]\nwave_height_ratio = [0.25, 0.3]\n";

/// Files of a directory by their paths in it, with words in the place of ids: those of companions, too.
fn told_as(root: &Path, folder: &Path, all: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            told_as(root, &path, all);
            continue;
        }
        let path = path.strip_prefix(root).unwrap().to_str().unwrap();
        let start = path.rfind(['/', '-']).map_or(0, |at| at + 1);
        let id =
            path.get(start..start + 16).or(path.rsplit('/').next().and_then(|name| name.get(..16)));
        let is_id = |id: &&str| id.chars().all(|c| c.is_ascii_hexdigit());
        all.insert(id.filter(is_id).map_or(path.to_owned(), |id| path.replace(id, "<case_id>")));
    }
}

/// The story: files and columns came to the program, and the list of them stayed as it was.
#[test]
fn every_file_that_a_study_leaves_is_told() {
    let desk = Desk::new(
        "name = \"all\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\nend_after_stroke_centre_s = 0.8\n\
         wall = \"fixed\"\nbehind = \"outflow\"\ncrest_width_m = 0.2\n[numerics]\nparticle_spacing_m = 0.03\n\
         [[probe]]\nname = \"G1\"\nkind = \"level\"\nx_m = 0.5\n\
         [grid]\nwave_height_ratio = [0.4, 0.5]\ncrest_freeboard_m = [0.05, 0.1]\n",
    );
    desk.sweep(&["--film", "auto"]);
    ended(0, &["report", &desk.dir, "--froude-scale", "20"]);
    let mut left = BTreeSet::new();
    told_as(&desk.out, &desk.out, &mut left);
    let train = Desk::new(TRAIN);
    train.sweep(&["--film", "none"]);
    told_as(&train.out, &train.out, &mut left);
    assert!(left.len() > 20, "{left:?}");
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/files.md");
    let docs = fs::read_to_string(docs).unwrap();
    let is_told = |path: &str| {
        let name = path.rsplit('/').next().unwrap();
        // Figures and tables are told by their stems, of which one may be `swept-<key>`.
        let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
        let parts = ["swept-", "history-wave-", "probes-", "fixed-wall"];
        let family = parts.iter().find(|part| stem.starts_with(**part));
        docs.contains(&format!("`{path}`"))
            || docs.contains(&format!("`{name}`"))
            || docs.contains(&format!("`{stem}`"))
            || family.is_some_and(|part| docs.contains(&format!("`{part}")))
    };
    let untold: Vec<_> = left.iter().filter(|path| !is_told(path)).collect();
    assert!(untold.is_empty(), "docs/files.md does not tell of {untold:?}");
    // Names stand in code: `case` alone is a word of many sentences.
    let code = docs.split('`').skip(1).step_by(2);
    let names = code.flat_map(|code| code.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
    let names: BTreeSet<_> = names.collect();
    let tables = left.iter().filter(|path| path.starts_with("tables/"));
    let paths = tables.flat_map(|path| [&desk.out, &train.out].map(|out| out.join(path)));
    for path in paths.filter(|path| path.exists()) {
        let table = fs::read_to_string(&path).unwrap();
        let columns = table.lines().next().unwrap().split(',');
        let untold: Vec<_> = columns.filter(|column| !names.contains(column)).collect();
        assert!(untold.is_empty(), "docs/files.md does not tell of {untold:?} in {path:?}");
    }
}

/// The story: a train, of which every wave comes onto what the ones before have left, had a first impact in every
/// table.
#[test]
fn of_regular_waves_no_first_impact_is_told() {
    let desk = Desk::new(TRAIN);
    let told = desk.sweep(&["--film", "none"]).out;
    assert!(told.contains("F* max") && !told.contains("first"), "{told}");
    let ids = crate::common::column(&desk.out, "case_id");
    assert!(
        crate::common::column(&desk.out, "first_force_max").iter().any(|cell| !cell.is_empty())
    );
    // A study that was moved without its files of waves is still one of a train.
    fs::rename(desk.out.join("waves"), desk.path().join("waves")).unwrap();
    let shown = ended(0, &["show", &desk.dir, &ids[0]]).out;
    let word = |word: &str| shown.lines().any(|line| line.trim_start().starts_with(word));
    assert!(word("wave period              1 s"), "{shown}");
    assert!(word("F* max") && !word("first") && !word("rise time"), "{shown}");
    let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
    for column in ["first_force_max", "first_impulse", "rise_time_s"] {
        assert!(!page.contains(&format!("data-column=\"{column}\"")), "{column}");
    }
    assert!(page.contains("data-column=\"force_max\""));
    let table = fs::read_to_string(desk.out.join("tables/summary.csv")).unwrap();
    let at = table.lines().next().unwrap().split(',').position(|name| name == "first_force_max");
    let first = table.lines().skip(1).map(|line| line.split(',').nth(at.unwrap()).unwrap());
    assert!(first.clone().count() == 2 && first.into_iter().all(str::is_empty), "{table}");
}

/// The story: a recorded stroke was called `H/h = 0.5`, the default of a key that nobody had set. When the number was
/// left out of the rows, curves and maps went with it.
#[test]
fn a_recorded_stroke_is_not_called_by_a_height_that_nobody_asked_for() {
    let stroke = "time_s,stroke_m\n0,0\n0.2,0.02\n0.4,0.08\n0.6,0.1\n0.8,0.1\n";
    let scene = "name = \"record\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\nend_time_s = 1.5\n\
                 paddle = \"recorded-stroke\"\nwall = \"movable\"\nspring_stiffness_n_per_m = 1000\n\
                 [numerics]\nparticle_spacing_m = 0.03\n[grid]\nseawall_mass_kg_per_m = [50, 100]\n";
    let desk = Desk::new("");
    let path = desk.path().join("stroke.csv");
    fs::write(&path, stroke).unwrap();
    let told = |more: &str| {
        let named = format!("[scene]\n{more}recorded_stroke = {:?}\n", path.to_str().unwrap());
        desk.write(&scene.replace("[scene]\n", &named));
        desk.sweep(&["--film", "none", "--fresh"]);
        let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
        // Comments of the script have their own example.
        let page = page.lines().filter(|line| !line.starts_with("//")).collect::<String>();
        (page, ended(0, &["show", &desk.dir, "m=50"]).out)
    };
    let (page, shown) = told("");
    assert!(!page.contains("H/h = ") && !shown.contains("H/h  "), "{page}{shown}");
    for kept in ["m = 50 kg/m", "recorded stroke</", "Histories, recorded stroke"] {
        assert!(page.contains(kept), "{kept}");
    }
    let (page, shown) = told("wave_height_ratio = 0.4\n");
    assert!(page.contains("H/h = 0.4") && shown.contains("H/h  "), "{page}{shown}");
}
