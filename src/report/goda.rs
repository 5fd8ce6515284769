//! Goda's formula beside the force of each case on an upright wall. The scene gives the depth at
//! the wall, a crest and regular waves.

use std::cell::RefCell;
use std::collections::HashMap;

use super::load::Loaded;
use super::row::{PLACE, Row};
use super::study::Key;
use crate::body::WaveTrainKeys;
use crate::quantities::summary::{FIRST_FORCE_MAX, MEASURED_WAVE_HEIGHT_RATIO, WAVE_HEIGHT_RATIO};
use crate::scene::SeawallScene;
use crate::theory::goda::Goda;
use crate::theory::wavemaker::travelling;

/// The values of a scene that the formula needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Depth of the still water at the wall over that at the paddle.
    depth: f64,
    /// 2π times the depth at the wall over the length of regular waves; 0 for other waves.
    in_waves: f64,
    /// Height of the crest over still water, over the depth at the wall; infinite without a crest.
    freeboard: f64,
    /// Whether the bed is level all along.
    level: bool,
}

impl Setting {
    /// An endless wall on a level bed, in a single wave.
    pub const PLAIN: Setting =
        Setting { depth: 1.0, in_waves: 0.0, freeboard: f64::INFINITY, level: true };

    /// Whether the setting is that of the exact solitary wave at a wall.
    pub fn is_plain(self) -> bool {
        self == Setting::PLAIN
    }

    /// Whether the waves are regular.
    pub fn is_regular(self) -> bool {
        self.in_waves > 0.0
    }

    /// F* by the formula for waves of H/h, h being the depth at the paddle.
    pub fn force(self, wave_height_ratio: f64) -> f64 {
        let Setting { depth, in_waves, freeboard, .. } = self;
        Goda { ratio: wave_height_ratio / depth, depth_in_waves: in_waves, freeboard }.force()
    }

    /// F* by the formula for a case's wave. A single wave has its measured height, if known.
    /// Regular waves have the nominal one: the gauge measures only their first crest.
    pub fn of_case(self, row: &Row) -> Option<f64> {
        let measured = row.number(&MEASURED_WAVE_HEIGHT_RATIO).filter(|_| !self.is_regular());
        let wave = measured.or_else(|| row.number(&WAVE_HEIGHT_RATIO));
        wave.filter(|wave| *wave > 0.0).map(|wave| self.force(wave))
    }

    /// The case's force over the formula's: of the first impact, or for regular waves the largest.
    pub fn over(self, row: &Row) -> Option<f64> {
        Some(row.number(row.impact(&FIRST_FORCE_MAX))? / self.of_case(row)?)
    }
}

/// The settings of a study's cases. Cases that differ in wave, stiffness and mass alone share one.
pub struct Settings<'a> {
    data: &'a Loaded,
    /// The other swept keys.
    keys: Vec<&'a Key>,
    known: RefCell<HashMap<Vec<&'a str>, Option<Setting>>>,
}

impl<'a> Settings<'a> {
    /// The settings of this study.
    pub fn of(data: &'a Loaded) -> Settings<'a> {
        let other = |key: &&Key| PLACE.iter().all(|column| column.name != key.name);
        Settings { data, keys: data.keys.iter().filter(other).collect(), known: RefCell::default() }
    }

    /// The setting of a row's case; `None` where no wave meets an upright wall in still water, or
    /// its scene is not known. Without the study's file it is the plain one.
    pub fn at(&self, place: usize) -> Option<Setting> {
        if !self.data.rows[place].is_vertical() {
            return None;
        }
        let cells = self.keys.iter().map(|key| &key.cells[place]).collect();
        let mut known = self.known.borrow_mut();
        let made = || match &self.data.file {
            None => Some(Setting::PLAIN),
            Some(_) => setting(self.data.case(place)?.scene.seawall()?),
        };
        *known.entry(cells).or_insert_with(made)
    }
}

fn setting(scene: &SeawallScene) -> Option<Setting> {
    let still = scene.still_water_depth_m;
    let depth = Some(scene.depth_at_wall_m()).filter(|depth| *depth > 0.0)?;
    let of_period = |keys: &WaveTrainKeys| {
        let rate = std::f64::consts::TAU / keys.wave_period_s;
        travelling(rate * rate * depth / scene.gravity_m_per_s2)
    };
    let freeboard = scene.crest.as_ref().map(|crest| crest.crest_freeboard_m / depth);
    Some(Setting {
        depth: depth / still,
        in_waves: scene.wave_train.as_ref().map_or(0.0, of_period),
        freeboard: freeboard.unwrap_or(f64::INFINITY),
        level: scene
            .bed
            .as_ref()
            .is_none_or(|bed| bed.points().iter().all(|point| point[1] == 0.0)),
    })
}

/// The name of the column with the ratio.
pub const OVER_GODA: &str = "force_over_goda";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::FORCE_MAX;
    use crate::scene::CaseConfig;

    fn of(scene: &str) -> Option<Setting> {
        setting(CaseConfig::of(scene, "").scene.seawall()?)
    }

    #[test]
    fn the_depth_at_the_wall_counts() {
        assert!(of("").unwrap().is_plain());
        assert!(of("bed = [[0, 0], [2.5, 0]]").unwrap().is_plain());
        // A wave of 0.06 m before a wall in 0.1 m of water: 1 + 1.1 · 0.6 (2 + 0.9).
        let slope = of("bed = [[0, 0], [1, 0], [2.5, 0.1]]").unwrap();
        assert!(!slope.is_plain() && (slope.force(0.3) - 2.914).abs() < 1e-9);
        assert_eq!(of("bed = [[0, 0], [1, 0], [2.5, 0.3]]"), None, "a dry wall");
        let ridge = of("bed = [[0, 0], [1, 0], [1.2, 0.1], [1.4, 0], [2.5, 0]]").unwrap();
        assert!(!ridge.is_plain() && (ridge.force(0.3) - 1.8085).abs() < 1e-9);
        assert_eq!(of("kind = \"hydrostatic\""), None);
    }

    #[test]
    fn crests_and_lengths_count() {
        let crest = "behind = \"outflow\"\ncrest_freeboard_m = 0.05\ncrest_width_m = 0.1";
        let lower = of(crest).unwrap();
        // The triangle of 0.45 h reaches 0.25 h above the still level: 2 · 0.25 (1 - 0.25/0.9).
        assert!((lower.force(0.3) - 1.0 - 0.33 * (2.0 + 0.361_111_1)).abs() < 1e-6);
        let train = of("paddle = \"wave-train\"\nwave_period_s = 1.0\nend_time_s = 8").unwrap();
        assert!(train.is_regular() && !train.is_plain());
        // ω² h/g = 0.80486 = kh tanh kh at kh = 1.03651; sinh 2kh = 3.91152, cosh kh = 1.58703.
        let goda = 1.0 + 0.3 * 0.740_439 * (1.0 + 0.630_108 + 0.45);
        assert!((train.force(0.3) - goda).abs() < 1e-5, "{} {goda}", train.force(0.3));
    }

    #[test]
    fn a_swept_key_is_that_of_its_row() {
        let beds = ["[[0, 0], [1, 0], [2.5, 0.1]]", "[[0, 0], [1, 0], [2.5, 0.15]]"];
        let data =
            Loaded::swept(&[("bed", &beds)]).made_from("[scene]\nwave_height_ratio = 0.3", &[]);
        let settings = Settings::of(&data);
        let row = Row::default().with(&FORCE_MAX, 5.828).with(&WAVE_HEIGHT_RATIO, 0.3);
        let over = settings.at(0).unwrap().over(&row).unwrap();
        assert!((over - 2.0).abs() < 1e-9, "{over}");
        assert_ne!(settings.at(0), settings.at(1));
    }
}
