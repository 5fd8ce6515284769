//! The report's page in a real Chromium: what it tells, what it answers to, and that it is whole
//! without its script. Skipped where there is no Chromium.

#[path = "common/chromium.rs"]
mod chromium;
mod common;
#[path = "common/study_page.rs"]
mod study_page;

use std::fs;
use std::path::Path;

use chromium::Chromium;
use common::{Desk, TINY_CASES};
use serde_json::{Value, json};
use study_page::{STUDY, many, number, page};

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

/// A unit behind the number once emptied all tables without a word.
#[test]
fn a_filter_that_is_not_understood_is_told_and_holds_nothing_back() {
    let Some(mut browser) = opened("#summary.first_force_max=%3C2+N") else { return };
    let told = ".listing[data-table=summary] .unread";
    let told = format!("document.querySelector('{told}:not([hidden])')?.textContent ?? ''");
    assert_eq!(cells(&mut browser, "first_force_max").len(), TINY_CASES);
    let words = browser.run(&told).as_str().unwrap().to_owned();
    assert!(words.contains("“<2 N” is not understood") && words.contains("0.2..0.4"), "{words}");
    browser.open(&page(), "#summary.first_force_max=%3C0.1&summary.stops=%3C");
    assert_eq!(cells(&mut browser, "first_force_max"), [""; 0], "one that is understood");
    assert_eq!(browser.run(&told), json!(""), "a sign alone is the start of one");
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
    let desk = Desk::new(&text);
    desk.run(&[]);
    let history = format!("histories/{}.csv", id.as_str().unwrap());
    let read = |root: &Path| fs::read(root.join("out").join(&history)).unwrap();
    assert_eq!(read(desk.path()), read(STUDY.path()), "{text}");
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

/// Once sections had the heights of the window before until they came near, and so the page jumped.
#[test]
fn what_is_left_out_has_its_size_also_after_a_change_of_window_or_choice() {
    let Some(mut browser) = Chromium::start() else { return };
    browser.resize(1400, 900);
    browser.open(&many(5, 3), "");
    let frames = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))";
    let seen =
        "(async () => { for (let y = 0; y < document.documentElement.scrollHeight; y += 600) {
        scrollTo(0, y); await new Promise(requestAnimationFrame); } scrollTo(0, 0); })()";
    let heights = "[...document.querySelectorAll('main > section, main > .beside')].map((part) =>
        part.querySelector('h2').textContent + ' ' + Math.round(part.getBoundingClientRect().height))";
    let left_out =
        "[...document.querySelectorAll('main > section, main > .beside')].filter((part) =>
        !part.querySelector('h2').checkVisibility({ contentVisibilityAuto: true })).length";
    let lay_out = |value: &str| {
        format!(
            "document.querySelectorAll('main > section, main > .beside').forEach((part) => {{
            part.style.contentVisibility = '{value}'; }})"
        )
    };
    browser.run(seen);
    let mut last = Vec::new();
    for change in ["390", "800", "choice"] {
        match change.parse() {
            Ok(width) => browser.resize(width, 900),
            Err(_) => browser.point_at("#choose fieldset button", true),
        }
        browser.run(frames);
        browser.settle();
        browser.run(frames);
        browser.run(frames);
        assert!(number(&mut browser, left_out) > 5, "{change}: far sections are left out");
        let kept = words(&mut browser, heights);
        browser.run(&lay_out("visible"));
        assert_eq!(kept, words(&mut browser, heights), "{change}");
        assert_ne!(kept, last, "{change} changes heights");
        browser.run(&lay_out(""));
        last = kept;
    }
    assert_eq!(browser.complaints(), [""; 0]);
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
    assert_eq!(words(&mut browser, &spare), ["m = 100 kg/m (m* = 2.5)"]);
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
