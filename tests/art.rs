//! The rules of the figures, measured in a real Chromium from the page itself: no text covers another
//! or leaves its frame, all can be read, series can be told apart, bounds look like bounds, nothing is
//! torn in print. Without a Chromium (`CHROMIUM` names one) the tests say so and pass.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::ended;
use serde_json::Value;

const WIDTHS: [u32; 3] = [1400, 800, 390];

/// The stored study of 300 movable walls, or those of them that are `wanted` by wave, stiffness and mass,
/// with histories that a formula makes up.
fn study(root: &Path, wanted: impl Fn([f64; 3]) -> bool) -> String {
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("results/liang2017_study");
    fs::copy(stored.join("manifest.json"), root.join("manifest.json")).unwrap();
    fs::create_dir(root.join("histories")).unwrap();
    let mut summary = csv::Reader::from_path(stored.join("summary.csv")).unwrap();
    let mut own = csv::Writer::from_path(root.join("summary.csv")).unwrap();
    own.write_record(summary.headers().unwrap()).unwrap();
    for row in summary.records().map(Result::unwrap) {
        let place = [3, 4, 5].map(|cell| row[cell].parse::<f64>().unwrap());
        if !wanted(place) {
            continue;
        }
        own.write_record(&row).unwrap();
        let file = root.join(format!("histories/{}.csv", &row[0]));
        fs::write(file, history(place[0], place[1])).unwrap();
    }
    own.flush().unwrap();
    ended(0, &["report", root.to_str().unwrap()]);
    fs::read_to_string(root.join("report.html")).unwrap()
}

fn history(wave: f64, stiffness: f64) -> String {
    let mut text = "time_s,force,runup,displacement,wall_velocity_m_per_s\n".to_owned();
    let give = 1.0 / (1.0 + stiffness / 400.0);
    for sample in 0..400 {
        let time = f64::from(sample) * 0.01;
        let pulse = (4.0 * (time - 2.0)).cosh().powi(-2) * (1.0 - 0.4 * give);
        let moved = 4.0 * wave * give * (1.0 + (3.0 * (time - 2.2)).tanh());
        writeln!(text, "{time},{},{},{moved},0", 1.0 + 4.0 * wave * pulse, 2.0 * wave * pulse)
            .unwrap();
    }
    text
}

/// Where a Chromium is.
fn chromium() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome-headless-shell"];
    let found = std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|file| file.is_file());
    named.or(found)
}

/// A page of frames, one for each width and one for print, around the measuring script.
fn harness(page: &str, widths: &[u32]) -> String {
    let quoted = |page: &str| page.replace('&', "&amp;").replace('"', "&quot;");
    let frame = |title: String, width: u32, page: &str| {
        format!(
            "<iframe title=\"{title}\" width=\"{width}\" height=\"900\" srcdoc=\"{}\"></iframe>",
            quoted(page)
        )
    };
    let of_width = |width: &u32| frame(format!("{width} px"), *width, page);
    let mut frames: String = widths.iter().map(of_width).collect();
    // Chromium applies rules of print to nothing that a script can see: here they are rules of all.
    frames += &frame("print".to_owned(), 700, &page.replace("@media print", "@media all"));
    let script = include_str!("art/measure.js");
    format!("<!DOCTYPE html><meta charset=\"utf-8\"><body><script>{script}</script>{frames}</body>")
}

/// What the script found; `None` without a Chromium.
fn measured(page: &str, widths: &[u32], dark: bool) -> Option<Value> {
    let Some(chromium) = chromium() else {
        println!("skipped: no Chromium on this machine (CHROMIUM can name one)");
        return None;
    };
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("harness.html");
    fs::write(&file, harness(page, widths)).unwrap();
    let profile = root.path().join("profile");
    let scheme = if dark { 0 } else { 1 };
    let output = Command::new(chromium)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .arg(format!("--blink-settings=preferredColorScheme={scheme}"))
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(["--virtual-time-budget=60000", "--dump-dom"])
        .arg(format!("file://{}", file.display()))
        .output()
        .unwrap();
    let dom = String::from_utf8(output.stdout).unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    let found = dom.split("<pre id=\"measured\">").nth(1).unwrap_or_else(|| panic!("{told}"));
    let json = found.split("</pre>").next().unwrap();
    let json = json.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    Some(serde_json::from_str(&json).unwrap())
}

/// What is wrong, a line each.
fn problems(found: &Value) -> Vec<&str> {
    found["problems"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect()
}

#[test]
fn the_page_of_a_study_keeps_the_rules_in_light_and_in_dark() {
    let root = tempfile::tempdir().unwrap();
    let page = study(root.path(), |_| true);
    for dark in [false, true] {
        let Some(found) = measured(&page, &WIDTHS, dark) else { return };
        let wrong = problems(&found);
        assert!(
            wrong.is_empty(),
            "dark: {dark}, {} rules broken:\n{}",
            wrong.len(),
            wrong.join("\n")
        );
        // What was not looked at cannot be wrong.
        for (what, least) in [
            ("panels", 150),
            ("texts", 3000),
            ("contrasts", 10_000),
            ("pairs of series", 1000),
            ("bounds", 500),
            ("figures", 10),
            ("breakAfter", 10),
            ("breakInside", 60),
            ("heads", 3),
        ] {
            assert!(found["counts"][what].as_u64().unwrap_or(0) >= least, "{what}: {found}");
        }
    }
}

#[test]
fn figures_of_one_panel_keep_the_rules_and_use_the_width() {
    // One mass: displacement, force and runup have a panel each. One wave: so has the map of forces.
    let of_one_mass = |[_, _, mass]: [f64; 3]| mass == 250.0;
    let of_one_wave = |[wave, ..]: [f64; 3]| wave == 0.5;
    for (wanted, class) in [
        (&of_one_mass as &dyn Fn([f64; 3]) -> bool, "class=\"beside\""),
        (&of_one_wave, "class=\"alone\""),
    ] {
        let root = tempfile::tempdir().unwrap();
        let page = study(root.path(), wanted);
        assert!(page.contains(class), "{class}");
        for dark in [false, true] {
            let Some(found) = measured(&page, &WIDTHS, dark) else { return };
            let wrong = problems(&found);
            assert!(wrong.is_empty(), "{class}, dark: {dark}:\n{}", wrong.join("\n"));
            assert!(found["counts"]["figures"].as_u64() > Some(5), "{found}");
        }
    }
}

#[test]
fn broken_rules_are_seen() {
    let root = tempfile::tempdir().unwrap();
    let mut page = study(root.path(), |[wave, ..]| wave == 0.5);
    let broken = [
        ("texts overlap", "<text class=\"title\"", "<text dy=\"-16\" class=\"title\""),
        ("small text", "font-size=\"10\"", "font-size=\"8.5\""),
        ("little contrast", "--hue-0: #5360ff", "--hue-0: #b0b0ff"),
        ("series look alike", "stroke-dasharray=\"8 3\"", "stroke-dasharray=\"4 2\""),
        ("torn in print", "break-after: avoid", "break-after: auto"),
        ("a heading may stand alone", "height: 7rem", "height: 1rem"),
        (
            "a table's head is not repeated",
            "button { display: contents",
            "button { display: inline",
        ),
        ("text leaves its frame", "text-anchor=\"end\"", "text-anchor=\"end\" dx=\"-60\""),
        ("few ticks", "class=\"tick\"", "class=\"other\""),
        ("a figure wastes the width", "class=\"alone\"", "class=\"left\""),
    ];
    for (rule, from, to) in broken {
        assert!(page.contains(from), "{rule}: {from}");
        page = page.replace(from, to);
    }
    let Some(found) = measured(&page, &WIDTHS, false) else { return };
    let wrong = problems(&found);
    for (rule, ..) in broken {
        assert!(wrong.iter().any(|line| line.contains(rule)), "{rule}: {wrong:?}");
    }
}

#[test]
fn names_of_methods_do_not_overlap() {
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("results/accuracy/figures");
    let svg = fs::read_to_string(stored.join("error-against-time.svg")).unwrap();
    let page = format!("<body><div class=\"plot\">{svg}</div></body>");
    let Some(found) = measured(&page, &[1000], false) else { return };
    // The front is drawn in the colour of its dots: only words are looked at.
    let mut wrong = problems(&found);
    wrong.retain(|line| line.contains("text"));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(found["counts"]["texts"].as_u64().unwrap() > 45, "{found}");
}
