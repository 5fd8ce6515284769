//! How fast the report's page opens and answers, in a real Chromium. Skipped where there is none.

#[path = "common/chromium.rs"]
mod chromium;
mod common;
#[path = "common/study_page.rs"]
mod study_page;

use std::fs;

use chromium::Chromium;
use common::ended;
use serde_json::json;
use study_page::{STUDY, many, number};

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
    ended(0, &["report", path.parent().unwrap().to_str().unwrap()]);
    assert!(fs::metadata(&path).unwrap().len() < 5_000_000);
    let mut times: Vec<f64> = (0..5).map(|_| browser.open(&path, "")).collect();
    times.sort_by(f64::total_cmp);
    println!("300 cases, eight films: opened after {times:?} ms");
    assert!(times[2] < SLOWEST_OPENING_MS, "{times:?}");
    let films = "document.querySelectorAll('script[id^=film-]').length";
    assert_eq!(number(&mut browser, films), 8);
    assert_eq!(browser.complaints(), [""; 0]);
}
