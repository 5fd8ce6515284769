//! A film in words: the title of its page, and the titles of its stills.

use super::is_read;
use super::take::Take;
use crate::math::decimal::significant;
use crate::scene::{CaseConfig, SeawallScene};
use crate::simulation::{CaseResult, HistoryRow};
use crate::study::CaseId;

/// Digits of parameters, as in the report.
const DIGITS: usize = 4;

/// The title of its page.
pub(super) fn title(config: &CaseConfig) -> String {
    let kind = config.scene.kind();
    match config.scene.seawall() {
        Some(scene) => {
            let height = significant(scene.wave_height_ratio, DIGITS);
            let waves = match &scene.wave_train {
                _ if scene.recorded.is_some() => "Waves of a recorded stroke".to_owned(),
                Some(train) => {
                    let period = significant(train.wave_period_s, DIGITS);
                    format!("Waves of H/h = {height} and T = {period} s")
                }
                None => format!("Wave of H/h = {height}"),
            };
            format!("{waves} at a {}", wall(scene))
        }
        None if kind == "taylor-green" => "Taylor-Green vortices".to_owned(),
        None => kind[..1].to_uppercase() + &kind[1..].replace('-', " "),
    }
}

/// The wall of a tank in words, and a bed before it.
fn wall(scene: &SeawallScene) -> String {
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
    let angle = match significant(scene.wall_angle_deg, DIGITS) {
        90.0 => String::new(),
        angle => format!(" at {angle}°"),
    };
    let crest = scene.crest.as_ref().map(|crest| {
        let [over, wide] = [crest.crest_freeboard_m, crest.crest_width_m];
        let [over, wide] = [over, wide].map(|metres| significant(metres, DIGITS));
        format!(" with its crest {over} m over still water and {wide} m wide")
    });
    let bed = scene.bed.as_ref().filter(|bed| !bed.is_level()).map(|bed| {
        let [from, to] = [bed.level_up_to(), bed.range()[1]].map(|m| significant(m, DIGITS));
        format!(" over a bed from x = {from} m on, up to {to} m high")
    });
    let [crest, bed] = [crest, bed].map(Option::unwrap_or_default);
    format!("{}{angle}{crest}{bed}{told}", scene.wall.title())
}

/// The line under it.
pub(super) fn about(config: &CaseConfig) -> String {
    let spacing = significant(1000.0 * config.numerics.particle_spacing_m, DIGITS);
    format!("Case {}, particles {spacing} mm apart.", CaseId::of(config))
}

/// The title of a still: the time, and the readings. The film has this span, s.
pub(super) fn moment(config: &CaseConfig, take: &Take, result: &CaseResult, span: f64) -> String {
    let row = |row: &&HistoryRow| (row.time_s - take.time_s).abs();
    let mut told = format!("t = {:.*} s", decimals(span), take.time_s);
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

/// Decimals of a time that tell instants of this span apart: two, or more where it is short; s.
fn decimals(span: f64) -> usize {
    if span > 0.0 { (1.0 - libm::log10(span).floor()).clamp(2.0, 8.0) as usize } else { 2 }
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

    /// The story: two films of a sweep over periods were both titled "Waves of H/h = 0.15 at a fixed
    /// wall".
    #[test]
    fn films_of_a_sweep_have_titles_of_their_own() {
        let train = "paddle = \"wave-train\"\nwave_height_ratio = 0.15\nend_time_s = 9\n";
        let told = |more: &str| title(&CaseConfig::of(&format!("{train}{more}"), ""));
        let waves = "Waves of H/h = 0.15 and T = 1.2 s at a fixed wall";
        assert_eq!(told("wave_period_s = 1.2"), waves);
        assert_ne!(told("wave_period_s = 1.5"), waves);
        let lean = told("wave_period_s = 1.2\nwall_angle_deg = 60");
        assert_eq!(lean, format!("{waves} at 60°"));
        let bed = told("wave_period_s = 1.2\nbed = [[0, 0], [1.6, 0], [2.5, 0.05]]");
        assert_eq!(bed, format!("{waves} over a bed from x = 1.6 m on, up to 0.05 m high"));
        let crest = "behind = \"outflow\"\ncrest_freeboard_m = 0.05\ncrest_width_m = 0.3";
        let crest = told(&format!("wave_period_s = 1.2\n{crest}"));
        let over = "with its crest 0.05 m over still water and 0.3 m wide";
        assert_eq!(crest, format!("{waves} {over}"));
    }

    /// The story: all stills of a run of 2 ms were at "t = 0.00 s".
    #[test]
    fn times_of_short_runs_have_more_decimals() {
        assert_eq!([0.0, 0.002, 0.3, 1.0, 35.0, 9000.0].map(decimals), [2, 4, 2, 2, 2, 2]);
    }

    #[test]
    fn parameters_of_a_range_are_rounded() {
        let scene = "wall = \"movable\"\nspring_stiffness_n_per_m = 1196.27902497698\n\
                     seawall_mass_kg_per_m = 50\nwave_height_ratio = 0.316227766";
        let told = "Wave of H/h = 0.3162 at a wall on a spring, k = 1196 N/m, m = 50 kg/m";
        assert_eq!(title(&CaseConfig::of(scene, "")), told);
    }
}
