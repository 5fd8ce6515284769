//! A case that branches from a trunk and the same case run alone, from rest: all files, all columns.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{Desk, ended};

/// A short, coarse tank.
const TANK: &str = "[scene]\ntank_length_m = 1.0\nwave_gauge_m = 0.5\n";

/// What a directory holds of a case: cells of its row in `summary.csv` by their columns, its row of
/// `energy.csv`, its history, its probes.
fn files_of(out: &Path, id: &str) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    for name in ["summary.csv", "energy.csv"] {
        let mut reader = csv::Reader::from_path(out.join(name)).unwrap();
        let header = reader.headers().unwrap().clone();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        let row = rows.iter().find(|row| row.iter().any(|cell| cell == id)).unwrap();
        let cells = header.iter().zip(row).filter(|(column, _)| *column != "wall_time_s");
        all.extend(cells.map(|(column, cell)| (format!("{name} {column}"), cell.to_owned())));
    }
    for folder in ["histories", "probes", "readings", "envelopes", "waves"] {
        if let Ok(text) = fs::read_to_string(out.join(folder).join(format!("{id}.csv"))) {
            all.insert(folder.to_owned(), text);
        }
    }
    all
}

/// Runs a sweep with branches, and each of its cases alone; both must leave the same. Returns the
/// summary.
fn compare(text: &str) -> Vec<BTreeMap<String, String>> {
    let desk = Desk::new(text);
    let out = desk.path().join("sweep");
    ended(
        0,
        &["sweep", &desk.file, "--out", out.to_str().unwrap(), "--threads", "2", "--film", "none"],
    );
    let manifest = fs::read_to_string(out.join("manifest.json")).unwrap();
    assert!(!manifest.contains("\"branches\": 0"), "nothing branched");
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let place = reader.headers().unwrap().iter().position(|name| name == "case_id").unwrap();
    let ids: Vec<_> = reader.records().map(|row| row.unwrap()[place].to_owned()).collect();
    assert!(ids.len() > 1);
    let compared = ids.iter().map(|id| {
        let alone = desk.path().join(id);
        ended(0, &["run", &desk.file, id, "--out", alone.to_str().unwrap()]);
        let [branch, whole] = [&out, &alone].map(|out| files_of(out, id));
        // A summary has a column for each swept key.
        let told = whole.iter().filter(|(name, cell)| branch.get(*name) != Some(cell));
        let told: Vec<_> = told.map(|(name, cell)| beside(name, cell, branch.get(name))).collect();
        assert!(told.is_empty(), "case {id}, alone and as a branch: {told:#?}");
        assert!(whole.len() > 40 && whole.contains_key("histories"), "{whole:?}");
        branch
    });
    compared.collect()
}

/// Two texts in one line, as far as they fit; of files the first line that differs.
fn beside(name: &str, whole: &str, branch: Option<&String>) -> String {
    let branch = branch.map_or("", String::as_str);
    let mut pairs = whole.lines().zip(branch.lines());
    let (whole, branch) = pairs.find(|(a, b)| a != b).unwrap_or((whole, branch));
    format!("{name}: {whole:.60}, {branch:.60}")
}

fn number(case: &BTreeMap<String, String>, column: &str) -> f64 {
    case[&format!("summary.csv {column}")].parse().unwrap()
}

/// What a trunk is for: the water comes to rest once, and no branch does that again.
#[test]
fn walls_before_water_that_comes_to_rest_first() {
    let grid = "end_after_stroke_centre_s = 0.9\nseawall_mass_kg_per_m = 50\nwall = \"movable\"\n\
                wave_height_ratio = 0.5\nbed = [[0, 0], [0.5, 0], [0.8, 0.1], [1, 0.1]]\n\
                [numerics]\nparticle_spacing_m = 0.025\nrelaxation_time_s = 1\n\
                [grid]\nspring_stiffness_n_per_m = [10, 1e5]\n";
    compare(&format!("name = \"at_rest\"\n{TANK}{grid}"));
}

#[test]
fn springs_from_soft_to_stiff_and_a_fixed_wall() {
    let grid = "end_after_stroke_centre_s = 0.9\nseawall_mass_kg_per_m = 50\n\
                [numerics]\nparticle_spacing_m = 0.025\n\
                [[probe]]\nname = \"p\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = 0.05\n\
                [grid]\nwall = [\"fixed\", \"movable\"]\nwave_height_ratio = [0.005, 0.5]\n\
                spring_stiffness_n_per_m = [0, 10, 1e5, 1e7]\n";
    let cases = compare(&format!("name = \"springs\"\n{TANK}{grid}"));
    let moved = |case: &BTreeMap<String, String>| {
        let cell = &case["summary.csv displacement_max"];
        (!cell.is_empty()).then(|| cell.parse::<f64>().unwrap() > 0.0)
    };
    for kind in [None, Some(false), Some(true)] {
        assert!(cases.iter().any(|case| moved(case) == kind), "{kind:?}");
    }
}

/// Crests of one height share a trunk, which ends before any water has gone over.
#[test]
fn crests_that_water_goes_over() {
    let grid = "end_after_stroke_centre_s = 1.4\nbehind = \"outflow\"\ncrest_width_m = 0.125\n\
                [numerics]\nparticle_spacing_m = 0.025\nboundary = \"normalized\"\n\
                [grid]\ncrest_freeboard_m = [0.05, 0.1]\nforce_coupling = [0.5, 1]\n";
    let cases = compare(&format!("name = \"crests\"\n{TANK}{grid}"));
    let over: Vec<f64> = cases.iter().map(|case| number(case, "overtopping_volume_m2")).collect();
    assert!(over[0] == over[1] && over[2] == over[3], "{over:?}");
    assert!(over[0] > over[2] && over[2] > 1e-3, "{over:?}");
    assert!(cases.iter().all(|case| case["probes"].contains("crest_thickness_m")));
}

#[test]
fn caissons_that_slide_and_that_stand() {
    let grid = "end_after_stroke_centre_s = 0.9\nwall = \"caisson\"\nseawall_mass_kg_per_m = 60\n\
                submerged_weight_n_per_m = 300\nstatic_friction = 0.6\n\
                [numerics]\nparticle_spacing_m = 0.025\n\
                [grid]\nwave_height_ratio = [0.005, 0.5]\nkinetic_friction = [0.3, 0.5]\n";
    let cases = compare(&format!("name = \"caissons\"\n{TANK}{grid}"));
    let slid = |case: &&BTreeMap<String, String>| number(case, "displacement_max") > 0.0;
    assert_eq!((cases.len(), cases.iter().filter(slid).count()), (4, 2));
}

#[test]
fn walls_in_incompressible_water() {
    let grid = "end_after_stroke_centre_s = 0.5\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                [numerics]\nscheme = \"isph\"\nparticle_spacing_m = 0.04\n\
                [grid]\nwave_height_ratio = [0.005, 0.5]\nspring_stiffness_n_per_m = [10, 1e6]\n";
    let cases = compare(&format!("name = \"incompressible\"\n{TANK}{grid}"));
    assert!(cases.iter().any(|case| case["summary.csv displacement_max"] == "0"));
}

/// A wall that never moves may end its run in what would be its trunk.
#[test]
fn runs_that_end_early_before_and_after_their_walls_could_move() {
    let grid = "end_after_stroke_centre_s = 30\nseawall_mass_kg_per_m = 50\n\
                threshold_ratio = 1.6\n\
                [numerics]\nparticle_spacing_m = 0.04\nstop_when_settled = true\n\
                sound_speed_ratio = 8\n\
                [grid]\nwall = [\"fixed\", \"movable\"]\nwave_height_ratio = [0.1, 0.3]\n\
                spring_stiffness_n_per_m = [1e4, 1e6]\n";
    let cases = compare(&format!("name = \"settled\"\n{TANK}{grid}"));
    let ended_early = |case: &&BTreeMap<String, String>| {
        let last = case["histories"].lines().last().unwrap();
        last.split(',').next().unwrap().parse::<f64>().unwrap() < 25.0
    };
    let stood = |case: &&BTreeMap<String, String>| {
        ended_early(case) && case["summary.csv displacement_max"] == "0"
    };
    let early = cases.iter().filter(ended_early);
    assert!(early.count() > 3 && cases.iter().any(|case| stood(&case)));
}
