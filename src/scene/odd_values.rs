//! Values that are allowed but probably not intended: warnings, each with its key.

mod early;
mod probes;
mod released;
mod stroke;

use early::early;
use released::released;

use super::config::CaseConfig;
use super::kind::Scene;
use super::loose_wall::{self, FARTHEST_WALL};
use super::numerics::Numerics;
use super::seawall::SeawallScene;
use crate::keys::ConfigError;
use crate::math::decimal::rounded_up;

/// A wave tank shorter than this many still water depths is too short for a wave: a solitary wave
/// of half the depth is ten depths long.
const SHORTEST_TANK: f64 = 5.0;
/// Water, kg/m³: 958 when it boils, 1000 fresh, 1025 in the sea, 1240 in the Dead Sea.
const WATER: [f64; 2] = [900.0, 1300.0];

/// Gravity, m/s²: 9.76 to 9.84 on earth, which some round to 10.
const GRAVITY: [f64; 2] = [9.7, 10.0];

/// Number of digits in a bound, which must itself be allowed.
const DIGITS: usize = 4;

/// Runs with fewer steps show nothing.
const FEWEST_STEPS: f64 = 2.0;

/// Samples closer than this share of a time step add nothing to the steps.
const SHARE_OF_STEP: f64 = 0.1;

/// A reflected wave may add this share to a crest that is measured.
const MOST_ADDED: f64 = 0.05;

/// Values of a case that look like mistakes: key, value, and the usual value.
pub fn odd_values(config: &CaseConfig) -> Vec<ConfigError> {
    let scene = &config.scene;
    let all = [density(config), gravity(config), interval(config), end(config), released(scene)];
    let mut odd: Vec<_> = all.into_iter().flatten().collect();
    if let Some(scene) = config.scene.seawall() {
        let near =
            gauge(scene, &config.numerics).or_else(|| aground(scene)).or_else(|| meets(scene));
        let all = [tank(scene), threshold(scene), steep(scene), early(scene), loose(scene), near];
        let probes = probes::odd(scene, &config.probes);
        odd.extend(all.into_iter().chain(probes).flatten());
        odd.extend(scene.recorded.iter().flat_map(|keys| stroke::odd(&keys.recorded_stroke)));
    }
    odd
}

/// The same, each behind its key.
pub fn odd_by_key(config: &CaseConfig) -> Vec<(String, ConfigError)> {
    odd_values(config).into_iter().map(|odd| (odd.key.clone(), odd)).collect()
}

fn warning(key: &str, value: f64, told: String) -> ConfigError {
    ConfigError::new(&format!("scene.{key}"), value, told)
}

fn tank(scene: &SeawallScene) -> Option<ConfigError> {
    let depths = scene.tank_length_m / scene.still_water_depth_m;
    if depths >= SHORTEST_TANK || scene.wave_height_ratio == 0.0 {
        return None;
    }
    let told = format!(
        "the tank, tank_length_m = {}, is only {depths:.3} still water depths long; a wave needs \
         {SHORTEST_TANK} or more",
        scene.tank_length_m
    );
    Some(warning("still_water_depth_m", scene.still_water_depth_m, told))
}

fn density(config: &CaseConfig) -> Option<ConfigError> {
    let (density, [low, high]) = (config.scene.frame().density, WATER);
    let told = || {
        format!(
            "this is no water; its density is from {low} to {high} kg/m³, 1000 where it is fresh"
        )
    };
    let usual = (low..=high).contains(&density);
    (!usual).then(|| warning("water_density_kg_per_m3", density, told()))
}

fn gravity(config: &CaseConfig) -> Option<ConfigError> {
    let (gravity, [low, high]) = (config.scene.frame().gravity, GRAVITY);
    // Vortices and drops have none.
    let usual = gravity == 0.0 || (low..=high).contains(&gravity);
    let told = "this is no place on earth; gravity is from 9.76 to 9.84 m/s² there";
    (!usual).then(|| warning("gravity_m_per_s2", gravity, told.to_owned()))
}

fn threshold(scene: &SeawallScene) -> Option<ConfigError> {
    let wall = scene.wall;
    let gives_way = wall.moves() && wall.has_threshold() && scene.threshold_ratio < 1.0;
    let told = "still water alone presses with 1 and moves the wall from the first step; 1 or above \
                lets it stand until the wave comes";
    gives_way.then(|| warning("threshold_ratio", scene.threshold_ratio, told.to_owned()))
}

fn steep(scene: &SeawallScene) -> Option<ConfigError> {
    let period = scene.wave_train.as_ref()?.wave_period_s;
    let waves = scene.regular_waves()?;
    let [steep, most] = waves.steepness(scene.wave_height_ratio, scene.still_water_depth_m);
    let told = || {
        format!(
            "waves of wave_height_ratio = {} would be {steep:.3} of their length high, and break from \
         {most:.3} on",
            scene.wave_height_ratio
        )
    };
    (steep > most).then(|| warning("wave_period_s", period, told()))
}

fn end(config: &CaseConfig) -> Option<ConfigError> {
    let frame = config.scene.frame();
    let (end, step) = (frame.end_time, frame.time_step(&config.numerics));
    let told =
        || format!("the case ends before its second step of {step:.1e} s: nothing will happen");
    (end - config.scene.start_s() < FEWEST_STEPS * step).then(|| warning("end_time_s", end, told()))
}

/// The run ends early, because the wall goes too far.
fn loose(scene: &SeawallScene) -> Option<ConfigError> {
    let (way, stiffness) = (loose_wall::displacement(scene)?, scene.spring_stiffness_n_per_m?);
    let told = || {
        format!(
            "so soft a spring may let the wall go some {way:.0} h; a run fails as wall-unstable where it goes more than \
         {FARTHEST_WALL} h"
        )
    };
    (way > FARTHEST_WALL).then(|| warning("spring_stiffness_n_per_m", stiffness, told()))
}

/// Nearer to the paddle than a support radius the level is that at its face. Where the paddle has
/// been there is no water later.
fn gauge(scene: &SeawallScene, numerics: &Numerics) -> Option<ConfigError> {
    let paddle = scene.paddle()?;
    let stroke = paddle.goes_forth();
    let least = stroke + numerics.support_radius_ratio * numerics.particle_spacing_m;
    let told = || {
        format!(
            "the paddle goes {stroke:.3} m into the tank, and a gauge nearer than {} m reads the water at its face, no wave",
            rounded_up(least, DIGITS)
        )
    };
    (scene.wave_gauge_m < least).then(|| warning("wave_gauge_m", scene.wave_gauge_m, told()))
}

/// A solitary wave is H sech² κx, and an upright wall reflects it. When its crest passes the gauge,
/// the reflected wave adds sech² 2κd of its height there, at the distance d from the wall.
fn meets(scene: &SeawallScene) -> Option<ConfigError> {
    scene.paddle()?.stroke_centre()?;
    let away = (scene.tank_length_m - scene.wave_gauge_m) / scene.still_water_depth_m;
    let spread = 2.0 * away * (0.75 * scene.wave_height_ratio).sqrt();
    let more = 1.0 / libm::cosh(spread).powi(2);
    let told = || {
        format!(
            "the gauge stands so near to the wall that what is sent back adds up to {:.0} % to the crest that it measures",
            100.0 * more
        )
    };
    (scene.is_upright_over_level_bed() && more > MOST_ADDED)
        .then(|| warning("wave_gauge_m", scene.wave_gauge_m, told()))
}

/// On a dry beach a gauge measures from the bed.
fn aground(scene: &SeawallScene) -> Option<ConfigError> {
    let height = scene.bed.as_ref()?.height(scene.wave_gauge_m);
    let told = || {
        format!(
            "the gauge stands on a beach that is {height:.3} m high there, and reads how thick the water on it is, no wave"
        )
    };
    (height >= scene.still_water_depth_m)
        .then(|| warning("wave_gauge_m", scene.wave_gauge_m, told()))
}

fn interval(config: &CaseConfig) -> Option<ConfigError> {
    let frame = config.scene.frame();
    let (interval, step) = (frame.history_interval, frame.time_step(&config.numerics));
    let run = frame.end_time - config.scene.start_s();
    if interval >= run {
        let told = format!(
            "is as long as the run, {:.3} s, or longer: the history has no line between its start and its end",
            run
        );
        return Some(warning("history_interval_s", interval, told));
    }
    let told = || {
        format!(
            "is much shorter than a time step ({step:.1e} s): every step is sampled, which is slow, and the \
         history has some {:.0} lines",
            run / step
        )
    };
    let samples = matches!(config.scene, Scene::Seawall(_) | Scene::Hydrostatic(_));
    (samples && interval < SHARE_OF_STEP * step)
        .then(|| warning("history_interval_s", interval, told()))
}

#[cfg(test)]
mod tests;
