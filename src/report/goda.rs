//! Goda's formula beside the force of each case on an upright wall. The scene gives the depth at
//! the wall, a crest and regular waves.

use toml::{Table, Value};

use super::load::Loaded;
use super::row::Row;
use crate::keys::{Section, number, read_value};
use crate::quantities::summary::{
    FIRST_FORCE_MAX, FORCE_MAX, MEASURED_WAVE_HEIGHT_RATIO, WAVE_HEIGHT_RATIO,
};
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
        let of_first = if self.is_regular() { None } else { row.number(&FIRST_FORCE_MAX) };
        let force = of_first.or_else(|| row.number(&FORCE_MAX))?;
        Some(force / self.of_case(row)?)
    }
}

/// The settings of a study's scenes.
pub struct Settings<'a> {
    data: &'a Loaded,
    /// `[scene]` of the study's file; `None` where the manifest has no file.
    scene: Option<Table>,
}

impl<'a> Settings<'a> {
    /// The settings of this study.
    pub fn of(data: &'a Loaded) -> Settings<'a> {
        Settings { data, scene: data.file().map(|file| file.scene) }
    }

    /// The setting of a row's case; `None` where no wave meets an upright wall in still water.
    pub fn at(&self, place: usize) -> Option<Setting> {
        if !self.data.rows[place].is_vertical() {
            return None;
        }
        self.scene_at(place).map_or(Some(Setting::PLAIN), |scene| setting(&scene))
    }

    /// `[scene]` of a row's case.
    fn scene_at(&self, place: usize) -> Option<Table> {
        let mut scene = self.scene.clone()?;
        for key in &self.data.keys {
            match &key.cells[place] {
                "" => drop(scene.remove(&key.name)),
                cell => drop(scene.insert(key.name.clone(), read_value(cell))),
            }
        }
        Some(scene)
    }
}

fn setting(scene: &Table) -> Option<Setting> {
    let word = |key: &str| scene.get(key).and_then(Value::as_str);
    if word("kind").is_some_and(|kind| kind != "seawall") {
        return None;
    }
    let metres = |key: &str| {
        let key = SeawallScene::keys().into_iter().find(|known| known.name == key)?;
        scene.get(key.name).cloned().or_else(key.default).as_ref().and_then(number)
    };
    let still = metres("still_water_depth_m")?;
    let heights = scene.get("bed").and_then(Value::as_array).into_iter().flatten();
    let heights = heights.map(|point| number(point.get(1)?)).collect::<Option<Vec<_>>>()?;
    let depth = still - heights.last().unwrap_or(&0.0);
    if depth <= 0.0 {
        return None;
    }
    let of_period = |period: f64| {
        let rate = std::f64::consts::TAU / period;
        Some(travelling(rate * rate * depth / metres("gravity_m_per_s2")?))
    };
    let period = metres("wave_period_s").filter(|_| word("paddle") == Some("wave-train"));
    let crest = word("behind").is_some_and(|behind| behind != "nothing");
    let freeboard = metres("crest_freeboard_m").filter(|_| crest);
    Some(Setting {
        depth: depth / still,
        in_waves: period.and_then(of_period).unwrap_or(0.0),
        freeboard: freeboard.map_or(f64::INFINITY, |height| height / depth),
        level: heights.iter().all(|height| *height == 0.0),
    })
}

/// The name of the column with the ratio.
pub const OVER_GODA: &str = "force_over_goda";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::study::Key;
    use serde_json::json;

    fn of(scene: &str) -> Option<Setting> {
        setting(&scene.parse().unwrap())
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
        let train = of("paddle = \"wave-train\"\nwave_period_s = 1.0").unwrap();
        assert!(train.is_regular() && !train.is_plain());
        // ω² h/g = 0.80486 = kh tanh kh at kh = 1.03651; sinh 2kh = 3.91152, cosh kh = 1.58703.
        let goda = 1.0 + 0.3 * 0.740_439 * (1.0 + 0.630_108 + 0.45);
        assert!((train.force(0.3) - goda).abs() < 1e-5, "{} {goda}", train.force(0.3));
    }

    #[test]
    fn a_swept_key_is_that_of_its_row() {
        let beds = ["[[0, 0], [1, 0], [2.5, 0.1]]", "[[0, 0], [1, 0], [2.5, 0.15]]"];
        let beds = Key::new("bed", beds);
        let row = || Row::default().with(&FORCE_MAX, 5.828).with(&WAVE_HEIGHT_RATIO, 0.3);
        let manifest = Some(json!({ "sweep_file": "[scene]\nwave_height_ratio = 0.3" }));
        let rows = vec![row(), row()];
        let data = Loaded { rows, manifest, keys: vec![beds], ..Loaded::default() };
        let settings = Settings::of(&data);
        let over = settings.at(0).unwrap().over(&data.rows[0]).unwrap();
        assert!((over - 2.0).abs() < 1e-9, "{over}");
        assert_ne!(settings.at(0), settings.at(1));
    }
}
