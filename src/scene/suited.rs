//! Numerics that a preset takes for some scenes, each with its reason. No other place tells them.

mod rules;

pub use rules::SUITED;

use super::kind::Scene;
use super::numerics::{LEAST_SOUND_SPEED_RATIO, Numerics};
use super::preset::Preset;

/// Other defaults of a preset, for some scenes.
#[derive(Debug)]
pub struct Suited {
    presets: &'static [Preset],
    /// The scenes.
    pub scenes: &'static str,
    /// The keys of `[numerics]`, and their values as in a file or as a formula.
    pub keys: &'static [(&'static str, &'static str)],
    /// Why.
    pub why: &'static str,
    holds: fn(&Asked) -> bool,
    set: fn(&mut Numerics, &Asked),
}

/// What the defaults depend on.
#[derive(Debug)]
pub(super) struct Asked<'a> {
    pub scene: &'a Scene,
    /// Metres.
    pub particle_spacing: f64,
    /// Whether the run can only end at its end time.
    pub timed: bool,
}

/// What some scenes have of a key by default, in words, where that is something else.
pub fn other_defaults(name: &str) -> impl Iterator<Item = String> {
    SUITED.iter().filter_map(move |suited| {
        let (_, value) = suited.keys.iter().find(|(key, _)| *key == name)?;
        Some(format!("{value} in {}", suited.scenes))
    })
}

impl Asked<'_> {
    fn stirs_at_wall_that_leans(&self) -> bool {
        let leans = self.scene.seawall().is_some_and(|tank| tank.wall_angle_deg != 90.0);
        self.timed && self.scene.hits_again() && leans
    }
}

impl Numerics {
    /// Takes what a preset has for a scene.
    pub(super) fn suit(&mut self, preset: Preset, asked: &Asked) {
        let of_preset = SUITED.iter().filter(|suited| suited.presets.contains(&preset));
        for suited in of_preset.filter(|suited| (suited.holds)(asked)) {
            (suited.set)(self, asked);
        }
    }
}

/// Rows of particles over the depth at which the sound speed is [`RATIO`] times √(g h).
const ROWS: f64 = 12.5;
const RATIO: f64 = 8.0;

/// c0/√(g h) for which the error by sound, proportional to 1/c0², falls like the spacing; to two
/// decimals.
pub(super) fn sound_speed_ratio(depth: f64, particle_spacing: f64) -> f64 {
    let ratio = RATIO * (depth / (ROWS * particle_spacing)).sqrt();
    if ratio.is_finite() {
        ((100.0 * ratio).round() / 100.0).max(LEAST_SOUND_SPEED_RATIO)
    } else {
        RATIO
    }
}

#[cfg(test)]
mod tests {
    use toml::Table;

    use super::*;
    use crate::keys::Section;

    /// The story: someone changes a default here and forgets the words beside it.
    #[test]
    fn what_is_told_is_what_is_set() {
        let table: Table = toml::from_str("kind = \"seawall\"\nwave_height_ratio = 0.3").unwrap();
        let scene = super::super::kind::Kind::DEFAULT.read(&table).unwrap();
        let asked = Asked { scene: &scene, particle_spacing: 0.02, timed: true };
        for suited in SUITED {
            let before = Numerics::preset(suited.presets[0]);
            let mut after = before.clone();
            (suited.set)(&mut after, &asked);
            let mut changed = Vec::new();
            before.differing(&after, &mut changed);
            let mut told: Vec<_> = suited.keys.iter().map(|(key, _)| *key).collect();
            changed.sort();
            told.sort();
            assert_eq!(changed, told, "{}", suited.scenes);
            for (key, value) in suited.keys.iter().filter(|(_, value)| !value.contains('√')) {
                assert_eq!(after.entry(key).unwrap().to_string(), *value, "{key}");
            }
        }
    }
}
