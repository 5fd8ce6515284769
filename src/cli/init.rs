//! `seawall init`: a commented sweep file to start from.

use std::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::failure::BadInput;
use super::output::{Output, json_path, wrapped};
use crate::keys::{Key, named};
use crate::math::words::in_words;
use crate::scene::{Kind, numerics_keys, scene_keys};
use crate::study::SweepFile;

/// Write NAME.toml: a sweep file to start from, with comments. A file that is there already stays as it is.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall init two_waves
  seawall init two_waves && seawall check two_waves.toml && seawall sweep two_waves.toml")]
pub(super) struct InitArgs {
    /// The study's name. Its file is NAME.toml in the current directory.
    name: String,
}

/// The width of a comment, characters.
const WIDTH: usize = 78;
/// The keys that the file sets in `[scene]`; other keys stand there as comments.
const SCENE: [(&str, &str); 3] =
    [("wall", "\"movable\""), ("still_water_depth_m", "0.2"), ("tank_length_m", "2.5")];
/// Keys of `[scene]` that stand as comments, at their defaults.
const MORE_SCENE: [&str; 3] = ["end_after_stroke_centre_s", "threshold_ratio", "wave_gauge_m"];
/// The keys that the file sets in `[numerics]`.
const NUMERICS: [(&str, &str); 2] = [("particle_spacing_m", "0.016"), ("error_bars", "\"pair\"")];
const MORE_NUMERICS: [&str; 2] = ["sound_speed_ratio", "stop_when_settled"];
/// The keys that the file sweeps.
const GRID: [(&str, &str); 3] = [
    ("wave_height_ratio", "[0.3, 0.5]"),
    ("spring_stiffness_n_per_m", "{ from = 10, to = 1e6, points = 6, spacing = \"log\" }"),
    ("seawall_mass_kg_per_m", "[50]"),
];

pub(super) fn main(args: &InitArgs, output: &Output) -> anyhow::Result<u8> {
    let name = args.name.strip_suffix(".toml").unwrap_or(&args.name);
    let alone = format!("name = {}", toml::Value::from(name));
    SweepFile::read(&alone, &[]).map_err(|error| BadInput(error.to_string()))?;
    let path = PathBuf::from(format!("{name}.toml"));
    let file = OpenOptions::new().write(true).create_new(true).open(&path);
    let mut file = file.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => BadInput::of(&path, "is there already; choose another NAME"),
        _ => BadInput::of(&path, format_args!("cannot be written: {}", in_words(&error))),
    })?;
    file.write_all(text(name).as_bytes())?;
    let told = named(&path);
    let next = format!("{told}: 12 cases to start from\nnext: seawall check {told}\n");
    output.result(&next, &json!({ "file": json_path(&path) }))?;
    Ok(SUCCESS)
}

/// The file's text.
fn text(name: &str) -> String {
    let scene = scene_keys(Kind::DEFAULT);
    let about = format!(
        "A study for seawall. `seawall check {name}.toml` says what it will cost, `seawall sweep \
         {name}.toml` runs it, `seawall explain KEY` tells more of a key. A key behind # has its \
         default."
    );
    let mut text = String::new();
    comment(&mut text, &about);
    let _ = writeln!(text, "name = {name:?}\n\n[scene]");
    SCENE.iter().for_each(|(key, value)| set(&mut text, &scene, key, value));
    MORE_SCENE.iter().for_each(|key| left(&mut text, &scene, key));
    text.push_str("[numerics]\n");
    NUMERICS.iter().for_each(|(key, value)| set(&mut text, &numerics_keys(), key, value));
    MORE_NUMERICS.iter().for_each(|key| left(&mut text, &numerics_keys(), key));
    let about =
        "Every key may be swept: a list of values, or a range. The cases are all combinations.";
    comment(&mut text, about);
    text.push_str("[grid]\n");
    GRID.iter().for_each(|(key, value)| set(&mut text, &scene, key, value));
    text.truncate(text.trim_end().len());
    text + "\n"
}

/// A key with a value, below its meaning.
fn set(text: &mut String, keys: &[&Key], name: &str, value: &str) {
    about(text, keys, name);
    let _ = writeln!(text, "{name} = {value}\n");
}

/// A key as a comment, with its default.
fn left(text: &mut String, keys: &[&Key], name: &str) {
    about(text, keys, name);
    let default = keys.iter().find(|key| key.name == name).map(|key| key.default_in_words());
    let _ = writeln!(text, "# {name} = {}\n", default.unwrap_or_default());
}

fn about(text: &mut String, keys: &[&Key], name: &str) {
    let Some(key) = keys.iter().find(|key| key.name == name) else { return };
    let unit = match key.rule.unit {
        "" => String::new(),
        unit => format!("{unit}, "),
    };
    let meaning = key.meaning_in_words();
    let meaning = meaning.trim_end_matches('.');
    comment(text, &format!("{meaning} ({unit}{}).", key.allowed_in_words()));
}

fn comment(text: &mut String, told: &str) {
    for line in wrapped(told, WIDTH) {
        let _ = writeln!(text, "# {line}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    #[test]
    fn the_file_is_a_study_with_and_without_its_comments() {
        let is_key = |word: &str| MORE_SCENE.contains(&word) || MORE_NUMERICS.contains(&word);
        let written = text("a");
        assert!(written.lines().all(|line| line.chars().count() <= WIDTH + 2), "{written}");
        let open: Vec<_> = written
            .lines()
            .map(|line| {
                let key = |line: &&str| line.split(" = ").next().is_some_and(is_key);
                line.strip_prefix("# ").filter(key).unwrap_or(line)
            })
            .collect();
        for text in [written.clone(), open.join("\n")] {
            let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
            assert_eq!((study.cases.len(), study.companions.len()), (12, 12), "{text}");
        }
        assert!(open.len() > 30 && written.matches("\n# ").count() > 10, "{written}");
    }
}
