//! A film's page in a real Chromium: its script finds every particle where it was. Skipped where there is
//! no Chromium.

#[path = "common/chromium.rs"]
mod chromium;

use std::path::Path;

use chromium::Chromium;
use seawall::film::{Colour, Filming, PageFilm};
use seawall::pairs::Fluid;
use seawall::results::made_up;
use seawall::scene::CaseConfig;
use seawall::simulation::{Film, Unwatched};

const COLUMNS: usize = 60;
const ROWS: usize = 15;
const FRAMES: usize = 50;
const SPACING: f64 = 0.02;

/// Places and pressures of all particles: a wave that runs along the tank, and spray at its end, which
/// leaps farther from frame to frame than any prediction.
fn water(frame: usize) -> Vec<[f64; 3]> {
    let (t, mut seed) = (frame as f64, 1 + frame as u32);
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24) - 0.5
    };
    let particle = |at: usize| {
        let [x, y] = [at / ROWS, at % ROWS].map(|place| SPACING * (place as f64 + 0.5));
        if frame == 0 {
            return [x, y, 9810.0 * (0.3 - y)];
        }
        let crest = 1.0 / ((x - 0.03 * t) / 0.1).cosh().powi(2);
        let spray = if x > 1.1 && t > 30.0 { 0.4 } else { 0.001 };
        let [x, y] = [x + 0.05 * crest, y * (1.0 + 0.5 * crest)].map(|at| at + spray * noise());
        [x, y, 9810.0 * (0.3 + 0.15 * crest - y).max(0.0)]
    };
    (0..COLUMNS * ROWS).map(particle).collect()
}

/// Shows the water to a camera; no simulation takes part.
fn film(folder: &Path) -> std::path::PathBuf {
    let page = PageFilm { colour: Colour::Pressure, folder: folder.to_owned() };
    let scene =
        "kind = \"hydrostatic\"\nstill_water_depth_m = 0.3\ntank_length_m = 1.2\nend_time_s = 1"
            .to_owned();
    let numerics = format!("particle_spacing_m = {SPACING}");
    let [scene, numerics] = [scene, numerics].map(|text| text.parse().unwrap());
    let config = CaseConfig::from_tables(&scene, &numerics).unwrap();
    let shot = Filming::Page(page).shoot(&config, &Unwatched, |monitor| {
        for frame in 0..FRAMES {
            let water = water(frame);
            let mut fluid = Fluid::at_rest(water.iter().map(|&[x, y, _]| [x, y, 1000.0, 1.0]));
            // A run sorts its particles anew now and then; their numbers stay with them.
            let (count, turn) = (water.len(), 7 * frame);
            fluid.x[..count].rotate_left(turn);
            fluid.y[..count].rotate_left(turn);
            fluid.id[..count].rotate_left(turn);
            let mut pressure: Vec<_> = water.iter().map(|point| point[2]).collect();
            pressure.rotate_left(turn);
            let time_s = 0.02 * frame as f64;
            let (fluid, pressure) = (&fluid, &pressure[..]);
            monitor.film(&Film { time_s, walls: [0.0; 2], fluid, pressure, faces: &[] });
        }
        Ok(made_up(&config))
    });
    shot.unwrap().1.unwrap();
    let mut pages = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    pages.find(|path| path.extension().is_some_and(|ending| ending == "html")).unwrap()
}

#[test]
fn the_script_finds_every_particle_where_it_was() {
    let Some(mut browser) = Chromium::start() else { return };
    let root = tempfile::tempdir().unwrap();
    browser.open(&film(root.path()), "");
    let read = "(() => { const film = JSON.parse(document.getElementById('film').textContent);
        const end = parseFloat(document.querySelector('.scale').lastElementChild.textContent);
        return [film.x0, film.y0, film.quantum, 1000 * end, film.colours.length,
            decode(film).map((frame) => [...frame])]; })()";
    type Read = (f64, f64, f64, f64, usize, Vec<Vec<f64>>);
    let told = browser.run(read);
    let (x0, y0, quantum, end, levels, frames): Read = serde_json::from_value(told).unwrap();
    assert_eq!(frames.len(), FRAMES);
    assert!(quantum < SPACING / 20.0, "{quantum} m");
    for (number, frame) in frames.iter().enumerate() {
        // The first frame is rounded; later ones leave out what is less than a quantum.
        let off = if number == 0 { 0.501 } else { 1.001 };
        assert_eq!(frame.len(), 3 * COLUMNS * ROWS);
        for (at, [x, y, pressure]) in water(number).into_iter().enumerate() {
            let level = (pressure / end).clamp(0.0, 1.0) * (levels - 1) as f64;
            let exact = [(x - x0) / quantum, (y - y0) / quantum, level];
            for (exact, found) in exact.iter().zip(&frame[3 * at..]) {
                assert!((exact - found).abs() < off, "frame {number}, {at}: {exact}, not {found}");
            }
        }
    }
    assert_eq!(browser.complaints(), [""; 0]);
}

/// The story: an axis of runups up to 0.0009 h was labelled 0.00, 0.00 and 0.00.
#[test]
fn levels_that_are_near_one_another_are_told_apart() {
    let Some(mut browser) = Chromium::start() else { return };
    let root = tempfile::tempdir().unwrap();
    let path = film(root.path());
    let page = std::fs::read_to_string(&path).unwrap();
    let (mark, end) = ("<script type=\"application/json\" id=\"film\">", "</script>");
    let from = page.find(mark).unwrap() + mark.len();
    let to = from + page[from..].find(end).unwrap();
    let mut film: serde_json::Value = serde_json::from_str(&page[from..to]).unwrap();
    let curve = |symbol: &str, high: f64| serde_json::json!({ "symbol": symbol, "name": symbol, "low": 0.0, "high": high, "values": [0.0, high] });
    film["history"] = serde_json::json!({
        "time_s": [0.0, 1.0],
        "curves": [curve("F*", 1.05), curve("R*", 0.0009)],
    });
    std::fs::write(&path, format!("{}{film}{}", &page[..from], &page[to..])).unwrap();
    browser.open(&path, "");
    let told =
        browser.run("[...document.querySelectorAll('.levels span')].map((one) => one.textContent)");
    let levels = ["1.05", "0.53", "0.00", "0.00090", "0.00045", "0.00000"];
    assert_eq!(serde_json::from_value::<Vec<String>>(told).unwrap(), levels);
    assert_eq!(browser.complaints(), [""; 0]);
}
