//! The page of a small study with films and error bars, and pages of large studies made from its rows.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use tempfile::TempDir;

use crate::chromium::Chromium;
use crate::common::{TINY, ended, expect_code, seawall, write_file};

/// A study with films and error bars, computed once for all tests.
pub static STUDY: LazyLock<TempDir> = LazyLock::new(|| {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    let out = root.path().join("out");
    let bars = "numerics.error_bars=pair";
    let arguments = ["sweep", &file, "--out", out.to_str().unwrap()];
    let finer = ["--set", "numerics.particle_spacing_m=0.02", "--set", bars, "--film", "auto"];
    ended(0, &[&arguments[..], &finer].concat());
    root
});

/// Its page.
pub fn page() -> PathBuf {
    STUDY.path().join("out/report.html")
}

/// A whole number that a script tells.
pub fn number(browser: &mut Chromium, script: &str) -> u64 {
    browser.run(script).as_u64().unwrap_or_else(|| panic!("{script}"))
}

/// A made-up study of ten masses and so many waves and stiffnesses, from the rows of the small one.
pub fn many(waves: usize, stiffnesses: usize) -> PathBuf {
    let root = STUDY.path().join(format!("many-{waves}-{stiffnesses}"));
    fs::create_dir_all(&root).unwrap();
    let mut reader = csv::Reader::from_path(STUDY.path().join("out/summary.csv")).unwrap();
    let head = reader.headers().unwrap().clone();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let mut writer = csv::Writer::from_path(root.join("summary.csv")).unwrap();
    writer.write_record(&head).unwrap();
    for index in 0..10 * waves * stiffnesses {
        let (wave, rest) = (index / (10 * stiffnesses), index % (10 * stiffnesses));
        let power = 0.05 * (rest / 10) as f64;
        let (k, m) = (10_f64.powf(1.0 + power), 50.0 * (1 + rest % 10) as f64);
        let cell = |name: &str, cell: &str| match name {
            "case_id" => format!("{index:016x}"),
            "wave_height_ratio" => (0.2 + 0.01 * wave as f64).to_string(),
            "spring_stiffness_n_per_m" => k.to_string(),
            "seawall_mass_kg_per_m" => m.to_string(),
            "log10_k_star" => (k / 392.4).log10().to_string(),
            "m_star" => (m / 40.0).to_string(),
            "first_force_max" => (1.0 + 0.001 * (index * 7919 % 3000) as f64).to_string(),
            _ => cell.to_owned(),
        };
        let row = &rows[index % rows.len()];
        writer.write_record(head.iter().zip(row).map(|(name, text)| cell(name, text))).unwrap();
    }
    writer.flush().unwrap();
    fs::copy(STUDY.path().join("out/manifest.json"), root.join("manifest.json")).unwrap();
    expect_code(&seawall().args(["report".as_ref(), root.as_os_str()]).output().unwrap(), 0);
    root.join("report.html")
}
