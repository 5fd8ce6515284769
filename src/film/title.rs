//! A film in words: the title of its page, and the titles of its stills.

use super::camera::Take;
use crate::math::decimal::significant;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, HistoryRow};
use crate::study::CaseId;

/// Digits of parameters, as in the report.
const DIGITS: usize = 4;

/// The title of its page.
pub(super) fn title(config: &CaseConfig) -> String {
    let kind = config.scene.kind();
    match config.scene.seawall() {
        Some(scene) => {
            if scene.recorded.is_some() {
                return format!("Waves of a recorded stroke at a {}", wall(config));
            }
            let wave = if scene.wave_train.is_some() { "Waves" } else { "Wave" };
            let height = significant(scene.wave_height_ratio, DIGITS);
            format!("{wave} of H/h = {height} at a {}", wall(config))
        }
        None if kind == "taylor-green" => "Taylor-Green vortices".to_owned(),
        None => kind[..1].to_uppercase() + &kind[1..].replace('-', " "),
    }
}

/// The wall of a tank in words.
fn wall(config: &CaseConfig) -> String {
    let Some(scene) = config.scene.seawall() else { return String::new() };
    let numbers = [
        (scene.spring_stiffness_n_per_m, "k", " N/m"),
        (scene.seawall_mass_kg_per_m, "m", " kg/m"),
    ];
    let told: String = numbers
        .iter()
        .filter_map(|(value, name, unit)| {
            Some(format!(", {name} = {}{unit}", significant((*value)?, DIGITS)))
        })
        .collect();
    // Walls that move neither lean nor have a crest.
    let more = match &scene.crest {
        _ if scene.wall_angle_deg != 90.0 => format!(" at {}°", scene.wall_angle_deg),
        Some(crest) => format!(" with its crest {} m over still water", crest.crest_freeboard_m),
        None => String::new(),
    };
    format!("{}{more}{told}", scene.wall.title())
}

/// The line under it.
pub(super) fn about(config: &CaseConfig) -> String {
    let spacing = significant(1000.0 * config.numerics.particle_spacing_m, DIGITS);
    format!("Case {}, particles {spacing} mm apart.", CaseId::of(config))
}

/// The title of a still: the time, and the readings.
pub(super) fn moment(config: &CaseConfig, take: &Take, result: &CaseResult) -> String {
    let row = |row: &&HistoryRow| (row.time_s - take.time_s).abs();
    let mut told = format!("t = {:.2} s", take.time_s);
    if let Some(row) = result.history.iter().min_by(|a, b| row(a).total_cmp(&row(b))) {
        let moves = config.scene.seawall().is_some_and(|scene| scene.wall.moves());
        let mut tell = |symbol: &str, of: fn(&HistoryRow) -> f64, always: bool| {
            if always || is_read(result, of) {
                told += &format!(", {symbol} = {:.2}", of(row));
            }
        };
        tell("F*", |row| row.force, false);
        tell("R*", |row| row.runup, false);
        tell("X*", |row| row.displacement, moves);
    }
    told
}

/// Whether there are readings: without a wall there is no force and no runup.
pub(super) fn is_read(result: &CaseResult, of: fn(&HistoryRow) -> f64) -> bool {
    result.history.iter().any(|row| of(row) != 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A recorded stroke was once titled by the default wave height, which nobody had asked for.
    #[test]
    fn a_recorded_stroke_has_no_height() {
        let scene = "paddle = \"recorded-stroke\"\nend_time_s = 3\nrecorded_stroke = \"sweeps/scenes/recorded_stroke.csv\"";
        let told = title(&CaseConfig::of(scene, ""));
        assert_eq!(told, "Waves of a recorded stroke at a fixed wall");
    }

    #[test]
    fn parameters_of_a_range_are_rounded() {
        let scene = "wall = \"movable\"\nspring_stiffness_n_per_m = 1196.27902497698\n\
                     seawall_mass_kg_per_m = 50\nwave_height_ratio = 0.316227766";
        let told = "Wave of H/h = 0.3162 at a wall on a spring, k = 1196 N/m, m = 50 kg/m";
        assert_eq!(title(&CaseConfig::of(scene, "")), told);
    }
}
