//! The report's page in a real Chromium: what it tells, what it answers to, and that it is whole
//! without its script. Skipped where there is no Chromium.

#[path = "common/chromium.rs"]
mod chromium;
mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use chromium::Chromium;
use common::{TINY, TINY_CASES, expect_code, run, seawall, write_file};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A study with films and error bars, computed once for all tests.
static STUDY: LazyLock<TempDir> = LazyLock::new(|| {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TINY);
    let out = root.path().join("out");
    let bars = "numerics.error_bars=pair";
    let arguments = ["sweep", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let finer = ["--set", "numerics.particle_spacing_m=0.02", "--set", bars, "--film", "auto"];
    expect_code(&run(&[&arguments[..], &finer].concat()), 0);
    root
});

fn page() -> PathBuf {
    STUDY.path().join("out/report.html")
}

/// Opens the study's page with a choice in its address.
fn opened(hash: &str) -> Option<Chromium> {
    let mut browser = Chromium::start()?;
    browser.resize(1400, 900);
    browser.open(&page(), hash);
    Some(browser)
}

/// Rows of the table of cases that are shown, with the text of a column.
fn cells(browser: &mut Chromium, column: &str) -> Vec<String> {
    let script = format!(
        "(() => {{ const t = document.querySelector('.listing[data-table=summary] table');
        const at = [...t.tHead.rows[0].cells].findIndex((c) => c.dataset.column === {column:?});
        return [...t.tBodies[0].rows].map((r) => r.cells[at].textContent); }})()"
    );
    serde_json::from_value(browser.run(&script)).unwrap()
}

fn number(browser: &mut Chromium, script: &str) -> u64 {
    browser.run(script).as_u64().unwrap_or_else(|| panic!("{script}"))
}

const MARKS: &str = "document.querySelectorAll('figure svg [data-case]').length";
const FADED: &str = "document.querySelectorAll(
    'figure svg .series.off [data-case], figure svg [data-case].off').length";

#[test]
fn a_point_tells_its_case_and_opens_its_history_and_film() {
    let Some(mut browser) = opened("") else { return };
    let film = "document.querySelector('[data-film]').dataset.film";
    let id = browser.run(film).as_str().unwrap().to_owned();
    let point = format!("figure svg [data-case='{id}']");
    browser.point_at(&point, false);
    let tip = browser.run("document.querySelector('.tip').innerText").to_string();
    for word in ["H/h = 0.", "N/m", "±", "Click for its history and film"] {
        assert!(tip.contains(word), "{tip}");
    }
    let here = format!("document.querySelectorAll(`svg .here[data-case='{id}']`).length");
    assert!(number(&mut browser, &here) > 3, "in the histories, too");
    browser.point_at(&point, true);
    let told = browser.run("document.querySelector('#case').innerText").to_string();
    for word in ["F*", "R*", "X*", "particle_spacing_m = 0.02", "Play its film"] {
        assert!(told.contains(word), "{told}");
    }
    assert_eq!(
        number(&mut browser, "document.querySelectorAll('#case .curve polyline').length"),
        3
    );
    browser.point_at("#case .play", true);
    let playing = "new Promise((told) => { const wait = () => {
        const play = document.querySelector('#case iframe')?.contentDocument?.getElementById('play');
        if (play?.textContent === 'Pause') told('Pause'); else { play?.click(); setTimeout(wait, 50); } }; wait(); })";
    assert_eq!(browser.run(playing), json!("Pause"));
    browser.run("document.body.focus()");
    browser.press("Escape");
    assert_eq!(browser.run("document.querySelector('#case').hidden"), json!(true));
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn a_choice_holds_for_figures_and_tables_and_stands_in_the_address() {
    let Some(mut browser) = opened("") else { return };
    let all = number(&mut browser, MARKS);
    assert_eq!(number(&mut browser, FADED), 0);
    browser.point_at("#choose fieldset button", true);
    let told = browser.run("document.querySelector('#choose output').textContent");
    assert_eq!(told, json!("4 of 8 cases are shown"));
    assert_eq!(cells(&mut browser, "wave_height_ratio"), ["0.4"; 4]);
    assert_eq!(number(&mut browser, FADED), all / 2);
    let forces = cells(&mut browser, "first_force_max");
    let middle = forces[1].split(' ').next().unwrap();
    let field = "document.querySelectorAll('.listing[data-table=summary] .filters input')";
    let column = "[...document.querySelectorAll('.listing[data-table=summary] th')]
        .findIndex((c) => c.dataset.column === 'first_force_max')";
    browser.run(&format!(
        "(() => {{ const f = {field}[{column}]; f.value = '<= {middle}';
        f.dispatchEvent(new Event('input')); }})()"
    ));
    browser.settle();
    browser.point_at(".listing[data-table=summary] th[data-column=first_force_max] button", true);
    let shown = cells(&mut browser, "first_force_max");
    assert!(!shown.is_empty() && shown.len() < 4, "{shown:?}");
    assert!(shown.is_sorted(), "{shown:?}");
    browser.point_at(".listing[data-table=summary] tbody tr", true);
    let hash = browser.run("location.hash").as_str().unwrap().to_owned();
    for word in ["wave_height_ratio=0.4", "summary.first_force_max=", "sort.summary=", "case="] {
        assert!(hash.contains(word), "{hash}");
    }
    let open = browser.run("document.querySelector('#case h2').textContent");
    assert_eq!(browser.complaints(), [""; 0]);

    browser.open(&page(), &hash);
    assert_eq!(cells(&mut browser, "first_force_max"), shown);
    assert_eq!(browser.run("document.querySelector('#case h2').textContent"), open);
    assert_eq!(browser.run("location.hash"), json!(hash));
    browser.point_at("#case .close", true);
    browser.point_at("#choose > button", true);
    assert_eq!(cells(&mut browser, "first_force_max").len(), TINY_CASES);
    assert_eq!(number(&mut browser, FADED), 0);
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn a_heading_sorts_up_and_down() {
    let Some(mut browser) = opened("") else { return };
    let head = ".listing[data-table=summary] th[data-column=spring_stiffness_n_per_m] button";
    browser.point_at(head, true);
    let up = ["10", "10", "10", "10", "10000", "10000", "10000", "10000"];
    assert_eq!(cells(&mut browser, "spring_stiffness_n_per_m"), up);
    browser.point_at(head, true);
    let down: Vec<_> = up.into_iter().rev().collect();
    assert_eq!(cells(&mut browser, "spring_stiffness_n_per_m"), down);
    browser.point_at(head, true);
    assert_eq!(cells(&mut browser, "wave_height_ratio")[..4], ["0.4"; 4], "as it was");
}

#[test]
fn keys_do_what_the_pointer_does() {
    let Some(mut browser) = opened("") else { return };
    browser.run("document.querySelector('.listing[data-table=summary] tbody tr').focus()");
    browser.press("ArrowDown");
    browser.press("Enter");
    let second = browser.run("document.querySelectorAll('tbody tr')[1].dataset.case");
    let hash = browser.run("location.hash").to_string();
    assert!(hash.contains(second.as_str().unwrap()), "{hash}");
    browser.press("Escape");
    let focus = browser.run("document.activeElement.dataset.case");
    assert_eq!(focus, second, "back where it was");
    browser.run("document.querySelector('figure svg [data-case]').focus()");
    let first = browser.run("document.activeElement.dataset.case");
    browser.press("ArrowRight");
    let next = browser.run("document.activeElement.dataset.case");
    assert_ne!(first, next);
    assert_eq!(browser.run("document.querySelector('.tip').hidden"), json!(false));
    browser.press("Enter");
    let hash = browser.run("location.hash").to_string();
    assert!(hash.contains(next.as_str().unwrap()), "{hash}");
}

#[test]
fn a_copied_row_runs_and_comes_out_the_same() {
    let Some(mut browser) = opened("") else { return };
    browser.run(
        "Object.defineProperty(navigator, 'clipboard',
        { value: { writeText: (text) => { window.copied = text; return Promise.resolve(); } } })",
    );
    browser.point_at(".listing[data-table=summary] tbody tr:nth-child(3) .copy", true);
    let text = browser.run("window.copied").as_str().unwrap().to_owned();
    let id = browser.run("document.querySelectorAll('tbody tr')[2].dataset.case");
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), &text), root.path().join("out"));
    let output = run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    expect_code(&output, 0);
    let history = format!("histories/{}.csv", id.as_str().unwrap());
    let read = |root: &Path| fs::read(root.join("out").join(&history)).unwrap();
    assert_eq!(read(root.path()), read(STUDY.path()), "{text}");
}

#[test]
fn without_its_script_the_page_is_whole() {
    let Some(mut browser) = Chromium::start() else { return };
    browser.call("Emulation.setScriptExecutionDisabled", json!({ "value": true }));
    browser.open(&page(), "");
    let text = browser.run("document.body.innerText").as_str().unwrap().to_owned();
    for word in ["What was run", "8 cases", "Largest force", "±", "Provenance", "[grid]"] {
        assert!(text.contains(word), "{word} in {text}");
    }
    assert!(!text.contains("Choose cases") && !text.contains("Press Play"), "{text}");
    let rows = "document.querySelectorAll('.listing[data-table=summary] tbody tr').length";
    assert_eq!(number(&mut browser, rows), TINY_CASES as u64);
    let still = "document.querySelector('.film .poster svg').getBoundingClientRect().height > 100";
    assert_eq!(browser.run(still), json!(true));
    assert_eq!(browser.complaints(), [""; 0]);
}

#[test]
fn a_table_prints_whole() {
    let Some(mut browser) = opened("") else { return };
    let script = "(() => { dispatchEvent(new Event('beforeprint'));
        const rows = document.querySelectorAll('.listing[data-table=summary] tbody tr').length;
        dispatchEvent(new Event('afterprint'));
        return [rows, document.querySelectorAll('.listing[data-table=summary] tbody tr').length]; })()";
    browser.open(&many(10, 10), "");
    let rows = browser.run(script);
    assert_eq!(rows[0], json!(1000));
    assert!(rows[1].as_u64().unwrap() < 300, "on the screen only what is near: {rows}");
}

#[test]
fn arrows_lead_down_a_long_table_and_nothing_moves() {
    let Some(mut browser) = opened("") else { return };
    browser.open(&many(10, 10), "");
    let tall = "document.documentElement.scrollHeight";
    let remembered = number(&mut browser, tall);
    browser.run(
        "document.querySelectorAll('main > section, main > .beside').forEach((part) => {
        part.style.contentVisibility = 'visible'; })",
    );
    assert_eq!(number(&mut browser, tall), remembered, "what is left out keeps its size");
    browser.run("document.querySelector('.listing[data-table=summary] tbody tr').focus()");
    for _ in 0..60 {
        browser.press("ArrowDown");
    }
    let focus = browser.run("document.activeElement.dataset.case");
    assert_eq!(focus, json!(format!("{:016x}", 60)));
    assert_eq!(browser.complaints(), [""; 0]);
}

/// A made-up study of ten masses and so many waves and stiffnesses, from the rows of the small one.
fn many(waves: usize, stiffnesses: usize) -> PathBuf {
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

/// Words that a script finds in the page.
fn words(browser: &mut Chromium, script: &str) -> Vec<String> {
    serde_json::from_value(browser.run(script)).unwrap()
}

#[test]
fn a_choice_is_drawn_where_figures_show_a_part_at_first() {
    let Some(mut browser) = Chromium::start() else { return };
    let path = many(5, 3);
    let figure = "[...document.querySelectorAll('figure')]
        .find((figure) => figure.textContent.includes('against-stiffness'))";
    let texts = |selector: &str| {
        format!(
            "[...{figure}.querySelectorAll('{selector}')].map((element) => element.textContent)"
        )
    };
    let panels = texts(".panels > svg:not([hidden]) .heading");
    let spare = texts("li.spare:not([hidden])");
    let curves = texts("svg:not([hidden]) .series.spare:not([hidden])");

    browser.open(&path, "");
    let at_first = words(&mut browser, &panels);
    assert_eq!(at_first, ["H/h = 0.2", "H/h = 0.22", "H/h = 0.24"].map(|wave| [wave; 3]).concat());
    assert!(words(&mut browser, &curves).is_empty() && words(&mut browser, &spare).is_empty());

    browser.open(&path, "#wave_height_ratio=0.23");
    assert_eq!(words(&mut browser, &panels), ["H/h = 0.23"; 3]);
    assert!(words(&mut browser, &curves).is_empty(), "ten masses at once are too many");
    browser.open(&path, "#wave_height_ratio=0.23&seawall_mass_kg_per_m=100");
    assert_eq!(words(&mut browser, &panels), ["H/h = 0.23"; 3]);
    assert_eq!(words(&mut browser, &curves).len(), 3);
    assert_eq!(words(&mut browser, &spare), ["m* = 2.5"]);
    let none = "document.querySelectorAll('figure .nothing:not([hidden])').length";
    assert_eq!(browser.run(&format!("{figure}.querySelector('.nothing')")), Value::Null);
    browser.point_at("#choose > button", true);
    assert_eq!(words(&mut browser, &panels), at_first);

    browser.open(&path, "#summary.first_force_max=%3E100");
    assert!(browser.run(none).as_u64() > Some(3), "figures that show nothing say so");
    browser.point_at("#choose > button", true);
    assert_eq!(browser.run(none), json!(0));
    assert_eq!(browser.complaints(), [""; 0]);
}

/// An act may take 100 ms on a quiet machine. This is half as much again, in processor time of the page's
/// thread: that hardly grows where the machine is busy.
const SLOWEST_MS: f64 = 150.0;

#[test]
fn ten_thousand_cases_answer_at_once() {
    let Some(mut browser) = Chromium::start() else { return };
    let path = many(20, 50);
    browser.resize(1400, 900);
    browser.count_processor_time();
    let open = browser.open(&path, "");
    browser.run(
        "window.buttons = document.querySelectorAll('#choose fieldset button');
        window.heads = [...document.querySelectorAll('.listing[data-table=summary] th')];
        window.head = heads.find((cell) => cell.dataset.column === 'first_force_max');
        window.fields = document.querySelectorAll('.listing[data-table=summary] .filters input');
        window.type = (text, at = head.cellIndex) => {
            fields[at].value = text; fields[at].dispatchEvent(new Event('input')); };
        window.later = setTimeout; window.held = []; 0",
    );
    let acts = [
        ("choice", "buttons[3].click()"),
        ("second", "buttons[4].click()"),
        ("third", "buttons[25].click()"),
        ("all", "document.querySelector('#choose > button').click()"),
        ("table", "fields[0].scrollIntoView()"),
        ("< 2", "type('< 2')"),
        ("< 1.5", "type('< 1.5')"),
        ("cleared", "type('')"),
        ("sorted", "head.querySelector('button').click()"),
        ("by text", "heads[0].querySelector('button').click()"),
        ("text", "type('1', 0)"),
        ("text cleared", "type('', 0)"),
    ];
    let mut took = vec![Vec::new(); acts.len()];
    for _ in 0..5 {
        browser.run("document.querySelector('figure').scrollIntoView()");
        for ((name, act), took) in acts.iter().zip(&mut took) {
            // What a person waits for: all that the script does at once, styles and layout. What
            // follows it unseen is held until that has been measured.
            browser.run("window.setTimeout = (act) => held.push(act)");
            let before = browser.processor_ms();
            browser.run(&format!("{act}; document.body.offsetHeight"));
            took.push(browser.processor_ms() - before);
            browser.run("window.setTimeout = later; held.splice(0).forEach((act) => later(act))");
            browser.settle();
            if *name == "third" {
                let told = browser.run("document.querySelector('#choose output').textContent");
                assert_eq!(told, json!("20 of 10000 cases are shown"));
            }
        }
    }
    let middle = |took: &mut Vec<f64>| {
        took.sort_by(f64::total_cmp);
        (10.0 * took[took.len() / 2]).round() / 10.0
    };
    let medians: Vec<_> =
        acts.iter().zip(&mut took).map(|((name, _), took)| (*name, middle(took))).collect();
    let size = fs::metadata(&path).unwrap().len();
    println!("10,000 cases: {size} bytes, open after {open} ms; medians of five, ms: {medians:?}");
    assert!(medians.iter().all(|(_, ms)| *ms < SLOWEST_MS), "{medians:?}");
    assert_eq!(browser.complaints(), [""; 0]);
}

/// Three times what a page may take to open on a quiet machine.
const SLOWEST_OPENING_MS: f64 = 3000.0;

#[test]
fn a_page_of_300_cases_with_films_opens_at_once() {
    let Some(mut browser) = Chromium::start() else { return };
    let path = many(5, 6);
    let folder = path.with_file_name("films");
    fs::create_dir_all(&folder).unwrap();
    let made = STUDY.path().join("out/films");
    let film = fs::read_dir(&made).unwrap().map(|file| file.unwrap().path());
    let film = film.filter(|path| path.extension().is_some_and(|end| end == "html")).min().unwrap();
    for index in 0..8 {
        for end in ["html", "svg"] {
            let copy = folder.join(format!("{index:016x}.{end}"));
            fs::copy(film.with_extension(end), copy).unwrap();
        }
    }
    expect_code(&run(&["report", path.parent().unwrap().to_str().unwrap()]), 0);
    assert!(fs::metadata(&path).unwrap().len() < 5_000_000);
    let mut times: Vec<f64> = (0..5).map(|_| browser.open(&path, "")).collect();
    times.sort_by(f64::total_cmp);
    println!("300 cases, eight films: opened after {times:?} ms");
    assert!(times[2] < SLOWEST_OPENING_MS, "{times:?}");
    let films = "document.querySelectorAll('script[id^=film-]').length";
    assert_eq!(number(&mut browser, films), 8);
    assert_eq!(browser.complaints(), [""; 0]);
}
