//! The doors hold against text and bytes that nobody meant: sweep file, `--set`, journal, checkpoint, summary.
//! A fixed seed, so that every run tries the same. What is refused is fine; a panic is not.

mod common;

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{Desk, TINY};
use seawall::math::simd::SimdPath;
use seawall::results::{Checkpoint, Directory, OpenMode, read_journal};
use seawall::scene::CaseConfig;
use seawall::simulation::{Monitor, Unwatched, run_case, run_trunk};
use seawall::study::{Override, Study, SweepFile};

/// Numbers that look random (xorshift).
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end.max(1) as u64) as usize
    }

    fn of<'a, T: ?Sized>(&mut self, all: &[&'a T]) -> &'a T {
        all[self.below(all.len())]
    }

    /// Some bytes, changed in one to four places.
    fn mutated(&mut self, bytes: &[u8], words: &[&str]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len() + 1);
            let end = (at + self.below(40)).min(bytes.len());
            match self.below(6) {
                0 if at < bytes.len() => bytes[at] ^= 1 << self.below(8),
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let copy = bytes[at..end].to_vec();
                    bytes.splice(at..at, copy);
                }
                3 => bytes.truncate(at),
                4 => {
                    let word = self.of(words);
                    drop(bytes.splice(at..end, word.bytes()));
                }
                _ => drop(bytes.splice(at..at, self.of(words).bytes())),
            }
        }
        bytes
    }
}

/// What hurts in a text.
const WORDS: &[&str] = &[
    "[",
    "]",
    "{",
    "}",
    "[[",
    "\"",
    "\"\"\"",
    "'",
    "=",
    ",",
    ".",
    "\n",
    "\0",
    "\u{1b}[31m",
    "\u{feff}",
    "nan",
    "-inf",
    "inf",
    "1e308",
    "1e-308",
    "-0.0",
    "99999999999999999999",
    "-1",
    "true",
    "[grid]",
    "[scene]",
    "wall = \"movable\"",
    "kind = \"dam-break\"",
    "bed = [[0, 0], [1, 0.1]]",
    "[[probe]]",
    "{ from = 0, to = 1, points = 3 }",
    "1979-05-27",
    "wave_height_ratio",
    "numerics.",
    "limits.steps",
];

/// More cases are not looked at: they are not wrong, only many.
const MANY: usize = 2000;

/// Reads a file as `check` does.
fn check(text: &str, set: &[Override]) {
    let Ok(file) = SweepFile::read(text, set) else { return };
    if file.grid.iter().map(|axis| axis.values.len()).product::<usize>() <= MANY {
        let _ = Study::new(&file);
    }
}

#[test]
fn sweep_files_and_settings_that_nobody_meant_are_refused_or_taken() {
    let mut dice = Dice(0x5eed_0001);
    let scenes = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("sweeps/scenes")).unwrap();
    let mut texts: Vec<_> = scenes.map(|it| it.unwrap().path()).filter(|it| it.is_file()).collect();
    texts.sort();
    let texts: Vec<_> = texts.iter().filter_map(|path| fs::read_to_string(path).ok()).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).chain([TINY]).collect();
    for _ in 0..4000 {
        let text = dice.of(&texts);
        let bytes = dice.mutated(text.as_bytes(), WORDS);
        check(&String::from_utf8_lossy(&bytes), &[]);
    }
    let settings = [
        "scene.wall=\"movable\"",
        "grid.wave_height_ratio=[0.1, 0.2]",
        "numerics.particle_spacing_m=0.02",
        "limits.steps=100",
        "probe.name=\"P\"",
    ];
    for _ in 0..4000 {
        let setting = dice.of(&settings);
        let bytes = dice.mutated(setting.as_bytes(), WORDS);
        if let Ok(set) = String::from_utf8_lossy(&bytes).parse::<Override>() {
            check(TINY, &[set]);
        }
    }
}

#[test]
fn files_of_results_that_nobody_wrote_are_told_or_mended() {
    let desk = Desk::new(TINY);
    desk.sweep(&[]);
    let study = Study::new(&SweepFile::read(TINY, &[]).unwrap()).unwrap();
    let words = [
        "{\"sum\":\"",
        "\",\"entry\":{\"case\":",
        "}",
        "\n",
        "null",
        "-1",
        "1e999",
        ",",
        "\"\"",
        "\0",
    ];
    let mut dice = Dice(0x5eed_0002);
    let path = desk.out.join("journal.jsonl");
    let whole = fs::read(&path).unwrap();
    for trial in 0..600 {
        fs::write(&path, dice.mutated(&whole, &words)).unwrap();
        let _ = read_journal(&desk.out);
        if trial % 10 == 0 {
            let simd = SimdPath::widest();
            drop(Directory::open(&desk.out, &study, OpenMode::Resume, None, simd));
        }
    }
    fs::write(&path, &whole).unwrap();
    for name in ["summary.csv", "manifest.json", "energy.csv"] {
        let path = desk.out.join(name);
        let whole = fs::read(&path).unwrap();
        for _ in 0..15 {
            fs::write(&path, dice.mutated(&whole, &words)).unwrap();
            let _ = seawall::report::write(&desk.out);
        }
        fs::write(&path, &whole).unwrap();
    }
}

/// Ends a run that a damaged clock would make endless.
#[derive(Default)]
struct Patience(AtomicUsize);

impl Monitor for Patience {
    fn over_limit(&self, _steps: u64) -> Option<String> {
        (self.0.fetch_add(1, Ordering::Relaxed) > 1000).then(|| "enough".to_owned())
    }
}

#[test]
fn checkpoints_that_nobody_kept_are_refused() {
    let scene = "tank_length_m = 1.0\nwave_gauge_m = 0.5\nend_after_stroke_centre_s = 0.1\nwall = \
                 \"movable\"\nspring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50";
    let numerics = "particle_spacing_m = 0.05";
    let config =
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap();
    let simd = SimdPath::widest();
    let trunk = run_trunk(&config.trunk().unwrap(), simd, &Unwatched).unwrap();
    let mut dice = Dice(0x5eed_0003);
    for _ in 0..300 {
        let bytes = dice.mutated(&trunk.checkpoint, &["\0\0\0\0", "\u{7f}"]);
        let ended = run_case(&config, Some(&bytes), simd, &Patience::default());
        assert!(ended.is_err() || bytes == trunk.checkpoint);
    }
    // As it lies on the disk.
    let root = tempfile::tempdir().unwrap();
    fs::write(root.path().join("journal.jsonl"), "").unwrap();
    let kept = Checkpoint::of_case(root.path(), "00000000000000ab".parse().unwrap(), simd);
    kept.write(&trunk.checkpoint).unwrap();
    let whole = fs::read(kept.path()).unwrap();
    for _ in 0..300 {
        let bytes = dice.mutated(&whole, &["{\"sum\":\"", "\",\"checkpoint\":", "\n", "\0"]);
        fs::write(kept.path(), &bytes).unwrap();
        assert!(kept.read().is_err() || bytes == whole);
    }
}
