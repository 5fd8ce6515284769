//! What the recorded strokes of the 1995 flume say by themselves, beside what its first gauges say: no run is needed.
//!
//!     cargo run --release --example strokes -- results/experiments
//!
//! The paddle of a solitary wave goes S = √(16 H/(3h)) h. Its largest speed is that of the water under the
//! crest: c H/(h + H) with c = √(g(h + H)). The crest leaves it at the middle of its stroke.

mod common;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use common::{number, read};
use seawall::math::root::bisected;

const DEPTH: f64 = 0.218;
const GRAVITY: f64 = 9.81;
/// Gauges over the level bed: column, and place in the cases A and B, metres.
const GAUGES: [(&str, [f64; 2]); 2] = [("gauge_4_m", [12.64, 14.06]), ("gauge_5_m", [15.04; 2])];
/// A crest is in the middle between where the surface passes this share of it.
const SHARE: f64 = 0.7;
/// The wave's water lies within this time of its crest, s.
const LASTS: f64 = 2.0;

type Failed = Box<dyn Error>;
type Series = Vec<(f64, f64)>;

fn main() -> Result<(), Failed> {
    let out = std::env::args().nth(1).map(PathBuf::from).ok_or("give OUT")?;
    let mut page = String::from(HEAD);
    page.push_str("| case | stroke, m | H by the stroke, m | largest speed, m/s | H by it, m |");
    page.push_str(" mid-stroke, s |\n|---|---|---|---|---|---|\n");
    let mut waves = String::from(WAVES);
    for (number, case) in ["a", "b", "c"].into_iter().enumerate() {
        let stroke =
            series(Path::new(&format!("sweeps/usace_1995/stroke_{case}.csv")), "stroke_m")?;
        let start = stroke[0].1;
        let way = stroke[stroke.len() - 1].1 - start;
        let speed = stroke.windows(3).map(|w| (w[2].1 - w[0].1) / (w[2].0 - w[0].0));
        let speed = speed.fold(0.0, f64::max);
        let middle = crossings(&stroke, start + 0.5 * way).next().ok_or("no stroke")?;
        let by_way = 3.0 * way * way / (16.0 * DEPTH);
        let of_speed = |h: f64| celerity(h) * h / (DEPTH + h) - speed;
        let name = case.to_uppercase();
        writeln!(
            page,
            "| {name} | {way:.4} | {by_way:.4} | {speed:.3} | {:.4} | {middle:.2} |",
            root(of_speed)
        )?;
        if case == "c" {
            continue;
        }
        let mut before: Option<(f64, f64)> = None;
        for (column, places) in GAUGES {
            let levels = series(&out.join(format!("usace_1995/gauges_{case}.csv")), column)?;
            let (time, height) = crest(&levels)?;
            let volume: f64 = levels
                .windows(2)
                .filter(|w| (w[0].0 - time).abs() < LASTS)
                .map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0))
                .sum::<f64>()
                * celerity(height);
            let place = places[number];
            let expected = middle + (place - 0.5 * way) / celerity(height);
            let between = before.map_or(String::new(), |(at, then)| {
                format!("{:.2} ({:.2})", (place - at) / (time - then), celerity(height))
            });
            before = Some((place, time));
            writeln!(
                waves,
                "| {name} | {} | {height:.4} | {:+.0} % | {volume:.4} | {:+.0} % | {time:.2} | {:+.2} | {between} |",
                &column[6..7],
                100.0 * (by_way / height - 1.0),
                100.0 * (volume / (way * DEPTH) - 1.0),
                time - expected
            )?;
        }
    }
    Ok(fs::write(out.join("strokes.md"), page + &waves + FOOT)?)
}

const HEAD: &str = "# What the flume's strokes say by themselves

Made by `cargo run --release --example strokes -- results/experiments` from the recorded strokes and the measured gauges
alone. No run stands behind it. A solitary wave of height H on water of the depth h is made by a stroke of √(16 H/(3h)) h,
whose largest speed is c H/(h + H), with c = √(g(h + H)).

";

const WAVES: &str = "
Over the level bed the gauges measured this. The water of a wave is c times the surface over time within 2 s of its
crest; the paddle pushed S h. The crest leaves the paddle at the middle of its stroke, at S/2 from where it began.

| case | gauge | crest, m | H by the stroke | water, m² | over S h | crest at, s | later than from the stroke, s | speed from gauge 4, m/s (theory) |
|---|---|---|---|---|---|---|---|---|
";

const FOOT: &str = "
In case A stroke and gauges contradict each other. By length and by speed the paddle makes a higher wave than was
measured. A sixth to a quarter of the water that it pushed never passed the gauges. In case B the height agrees. In both
cases crests pass the gauges 0.2 to 0.3 s later than a wave of the measured height that leaves with the stroke, but between
the gauges they are as fast as in theory. So the clocks or the paddle's place differ, not the speed. The strokes begin at
-0.145 m (A, B) and -0.203 m (C). Were the gauges' origin the zero of that record, the waves would have so much farther to go:
0.1 s of the 0.2 to 0.3 s. Two gauges 1.0 to 2.4 m apart over a level bed differ by 6 to 7 % in the height of the same wave: no
computation can be within 3 % of both.
";

fn celerity(height: f64) -> f64 {
    (GRAVITY * (DEPTH + height)).sqrt()
}

/// Where a function that rises passes zero, between nothing and the depth.
fn root(function: impl Fn(f64) -> f64) -> f64 {
    bisected([0.0, 2.0 * DEPTH], |at| function(at) >= 0.0)[0]
}

fn series(path: &Path, column: &str) -> Result<Series, Failed> {
    let rows = read(path)?;
    let point = |row| number(row, "time_s").zip(number(row, column));
    let points: Option<Series> = rows.iter().map(point).collect();
    points.ok_or_else(|| format!("{}: no number in time_s or {column}", path.display()).into())
}

/// When a series passes a level either way.
fn crossings(series: &[(f64, f64)], level: f64) -> impl Iterator<Item = f64> {
    series.windows(2).filter_map(move |w| {
        let [(t0, y0), (t1, y1)] = [w[0], w[1]];
        ((y0 < level) != (y1 < level)).then(|| t0 + (t1 - t0) * (level - y0) / (y1 - y0))
    })
}

/// When the first crest passes, and how high it is. The wave that comes back from the wall is later.
fn crest(series: &[(f64, f64)]) -> Result<(f64, f64), Failed> {
    let highest = series.iter().map(|row| row.1).fold(0.0, f64::max);
    let first = crossings(series, 0.6 * highest).next().ok_or("no crest")?;
    let near: Vec<_> = series.iter().copied().filter(|row| (row.0 - first).abs() < LASTS).collect();
    let height = near.iter().map(|row| row.1).fold(0.0, f64::max);
    let all: Vec<f64> = crossings(&near, SHARE * height).collect();
    let [up, .., down] = all[..] else { return Err("no crest".into()) };
    Ok((0.5 * (up + down), height))
}
