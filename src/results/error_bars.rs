//! Error bars: how far a case's readings may be from the truth, from its resolution companions and
//! from what is known about the method.
//!
//! For a reading f at the case's spacing and f_r at r times that spacing the bar is
//! ```text
//! √( [ |f - f_r| / (r^p - 1) ]² + sound² + scatter² )
//! ```
//! the first term being Richardson's with the order p = 1.5, the largest over all companions (two runs
//! may agree by accident). The others are what coarser particles do not show:
//! - **sound**: the water is compressible, and answers a push as late as sound crosses its depth. At an
//!   upright wall over a flat bed force and displacement are read without it;
//! - **scatter**: readings vary by a share of their size between neighbouring spacings, levels by a
//!   share of the spacing.
//!
//! A bar is absolute, in the reading's own unit, and holds for more than nine cases in ten:
//! `results/accuracy/coverage.md` has what was measured. No constant was set by the cases that are
//! counted there.

use super::record::CaseRecord;
pub use crate::quantities::Bars as ErrorBars;
use crate::scene::{CaseConfig, Scheme, SeawallScene};
use crate::simulation::{Maximum, Outcome};
use crate::study::Study;
use crate::theory::wall_potential::CARRIED;

/// Order p of all readings. Fixed walls have 0.9 to 1.9 for the crest, 2.4 to 3.1 for the runup at
/// H/h = 0.6 (`results/convergence`).
const ORDER: f64 = 1.5;
/// Error by sound over [`sound_number`], of F* as it pushes and of 1 + R*: fixed walls at c0 = 8 and 24 √(g h)
/// have 0.07 and 0.10 (F* at H/h = 0.5 and 0.6), 0.10, 0.13 and 0.22 (R* at 0.3, 0.5 and 0.6).
const SOUND: f64 = 0.10;
/// A spring that swings as fast as sound in the water takes up to twice what pushes it.
const SWING: f64 = 2.0;
/// Scatter of a force, as a share of it, which nine in ten stay below: 1.65 times the root mean square of four fixed
/// walls at seven spacings (`results/convergence`).
const FORCE_SCATTER: f64 = 0.0025;
/// Scatter of a level, as a share of the spacing: fixed walls of H/h = 0.5 at twelve spacings.
const LEVEL_SCATTER: f64 = 0.03;
/// Scatter of a displacement, as a share of it: two walls at three spacings and four sound speeds.
const DISPLACEMENT_SCATTER: f64 = 0.004;

impl ErrorBars {
    /// The bars of a case that has ended well, from those of its companions that have.
    pub fn new(
        config: &CaseConfig,
        outcome: &Outcome,
        companions: &[(&CaseConfig, &Outcome)],
    ) -> ErrorBars {
        // Other scenes have none of these readings.
        let Some(scene) = config.scene.seawall() else { return ErrorBars::default() };
        let spacing = config.numerics.particle_spacing_m;
        let ratio = |other: &CaseConfig| other.numerics.particle_spacing_m / spacing;
        let refined = |read: &dyn Fn(&Outcome) -> Option<f64>| {
            let own = read(outcome)?;
            let others = companions.iter().filter_map(|(config, outcome)| {
                Some(richardson(own, read(outcome)?, ratio(config), ORDER))
            });
            Some((own, others.max_by(f64::total_cmp)?))
        };
        let bar = |terms: &[f64]| terms.iter().map(|term| term * term).sum::<f64>().sqrt();
        let value = |maximum: Option<Maximum>| maximum.map(|maximum| maximum.value);
        let depth = 1.0 + value(outcome.first_runup_max).unwrap_or(0.0).max(0.0);
        let sound = match config.numerics.scheme {
            Scheme::Wcsph => SOUND * sound_number(scene, depth, config.numerics.sound_speed_ratio),
            Scheme::Isph => 0.0,
        };
        let heard = if scene.reads_without_sound() { 0.0 } else { sound };
        let force = |read: &dyn Fn(&Outcome) -> Option<f64>| {
            let (own, resolution) = refined(read)?;
            Some(bar(&[resolution, heard * own, FORCE_SCATTER * own]))
        };
        let runup = |read: &dyn Fn(&Outcome) -> Option<f64>| {
            let (own, resolution) = refined(read)?;
            let level = LEVEL_SCATTER * spacing / scene.still_water_depth_m;
            Some(bar(&[resolution, sound * (1.0 + own), level]))
        };
        let displacement = || {
            let (own, resolution) = refined(&|o| value(o.displacement_max))?;
            let force = value(outcome.first_force_max).unwrap_or(1.0);
            let excess = (force - scene.threshold_ratio).max(0.1 * force);
            let followed = SWING * heard * force / excess * following(scene, depth);
            Some(bar(&[resolution, followed * own, DISPLACEMENT_SCATTER * own]))
        };
        ErrorBars {
            force: force(&|o| value(o.first_force_max)),
            runup: runup(&|o| value(o.first_runup_max)),
            displacement: displacement(),
            whole_force: force(&|o| Some(o.force_max.value)),
            whole_runup: runup(&|o| Some(o.runup_max.value)),
        }
    }
}

/// The narrowest bar of force and displacement that a case may get, percent, however fine its
/// particles: scatter between spacings and, where it counts, the sound of its water at the least depth.
pub fn narrowest_bar_percent(config: &CaseConfig) -> Option<f64> {
    let scene = config.scene.seawall()?;
    let sound = match config.numerics.scheme {
        Scheme::Wcsph if !scene.reads_without_sound() => {
            SOUND * sound_number(scene, 1.0, config.numerics.sound_speed_ratio)
        }
        _ => 0.0,
    };
    let displacement = if scene.wall.moves() { DISPLACEMENT_SCATTER } else { 0.0 };
    Some(100.0 * sound.hypot(FORCE_SCATTER).max(displacement))
}

impl Study {
    /// The error bars of a case, none where it or its companions have not ended well; `records`
    /// are in the order of [`Study::runs`].
    pub fn error_bars(&self, case: usize, records: &[Option<CaseRecord>]) -> ErrorBars {
        let own = records.get(case).and_then(Option::as_ref);
        own.map_or_else(Default::default, |own| self.error_bars_of(own, records))
    }

    /// Likewise, of a record that is not among the others.
    pub(super) fn error_bars_of(
        &self,
        own: &CaseRecord,
        records: &[Option<CaseRecord>],
    ) -> ErrorBars {
        let outcome = |run: usize| records.get(run)?.as_ref()?.outcome.as_ref();
        let companions: Vec<_> = self.companions_of[own.index]
            .iter()
            .filter_map(|&run| Some((&self.run(run).config, outcome(run)?)))
            .collect();
        own.outcome.as_ref().map_or_else(Default::default, |outcome| {
            ErrorBars::new(&self.cases[own.index].config, outcome, &companions)
        })
    }
}

/// The square of the rate at which a wave loads a wall, 1/s²: (κ c)² = ¾ ε (1 + ε) g/h of a solitary
/// wave of ε = H/h.
fn rate_squared(scene: &SeawallScene) -> f64 {
    let epsilon = scene.wave_height_ratio;
    0.75 * epsilon * (1.0 + epsilon) * scene.gravity_m_per_s2 / scene.still_water_depth_m
}

/// (rate · d/c0)², d the depth at the wall: what a quarter-wave of sound in the water column adds to a
/// force that rises at this rate, but for a factor. `depth` is d/h, `ratio` is c0/√(g h).
fn sound_number(scene: &SeawallScene, depth: f64, ratio: f64) -> f64 {
    let unit = scene.still_water_depth_m / scene.gravity_m_per_s2;
    rate_squared(scene) * unit * (depth / ratio).powi(2)
}

/// How closely a wall's displacement follows the force: 1 for a spring that swings much faster than
/// the force rises, 0 for one that is much slower.
fn following(scene: &SeawallScene, depth: f64) -> f64 {
    let stiffness = scene.spring_stiffness_n_per_m.unwrap_or(0.0);
    let carried = scene.water_density_kg_per_m3 * (scene.still_water_depth_m * depth).powi(2);
    let mass = scene.seawall_mass_kg_per_m.unwrap_or(0.0) + CARRIED * carried;
    let swing = stiffness / mass;
    swing / (swing + rate_squared(scene))
}

/// Richardson's estimate of the error of `fine`, from the same quantity on a spacing `ratio` times
/// as large and the order of convergence p: |f - f_r|/(r^p - 1).
pub fn richardson(fine: f64, coarse: f64, ratio: f64, order: f64) -> f64 {
    (fine - coarse).abs() / (libm::pow(ratio, order) - 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;

    fn config(spacing: f64) -> CaseConfig {
        let scene = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 50";
        let numerics = format!("particle_spacing_m = {spacing:?}");
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap()
    }

    /// Readings that converge to 2, 1 and 3 with order `order`, on an exact wave.
    fn outcome(spacing: f64, order: f64) -> Outcome {
        let mut outcome = made_up(&config(spacing)).outcome;
        let maximum = |value| Some(Maximum { value, time_s: 2.0 });
        let error = (spacing / 0.1).powf(order);
        outcome.measured_wave_height_ratio = Some(0.5);
        outcome.first_force_max = maximum(2.0 + error);
        outcome.force_max.value = 2.5 + error;
        outcome.runup_max.value = 1.2 - error;
        outcome.first_runup_max = maximum(1.0 - error);
        outcome.displacement_max = maximum(3.0 - 2.0 * error);
        outcome
    }

    fn bars(spacings: &[f64], order: f64) -> ErrorBars {
        let runs: Vec<_> =
            spacings.iter().map(|&spacing| (config(spacing), outcome(spacing, order))).collect();
        let companions: Vec<_> =
            runs[1..].iter().map(|(config, outcome)| (config, outcome)).collect();
        ErrorBars::new(&runs[0].0, &runs[0].1, &companions)
    }

    #[test]
    fn richardson_is_exact_for_a_pure_power() {
        let read = |spacing: f64| 1.0 + 3.0 * spacing.powf(1.5);
        let error = richardson(read(0.1), read(0.2), 2.0, 1.5);
        assert!((error - (read(0.1) - 1.0).abs()).abs() < 1e-12);
    }

    #[test]
    fn the_limit_lies_inside_for_every_order_from_one_and_a_half() {
        for order in [1.5, 1.75, 2.0] {
            for spacings in [&[0.01, 0.02][..], &[0.01, 0.01 * std::f64::consts::SQRT_2, 0.02]] {
                let bars = bars(spacings, order);
                let error = 0.1_f64.powf(order);
                assert!(bars.force.unwrap() >= error && bars.runup.unwrap() >= error);
                assert!(bars.whole_force.unwrap() >= error && bars.whole_runup.unwrap() >= error);
                assert!(bars.displacement.unwrap() >= 2.0 * error);
                assert!(bars.force.unwrap() < 3.0 * error + 0.02, "{order}: {bars:?}");
            }
        }
    }

    #[test]
    fn agreement_by_accident_leaves_scatter_and_sound() {
        let outcome = outcome(0.01, 1.0);
        let of = |wall: &str, numerics: &str| {
            let text = format!("particle_spacing_m = 0.01\n{numerics}");
            let scene = format!("{wall}\nwave_height_ratio = 0.6");
            let config =
                CaseConfig::from_tables(&scene.parse().unwrap(), &text.parse().unwrap()).unwrap();
            ErrorBars::new(&config, &outcome, &[(&self::config(0.02), &outcome)])
        };
        let stiff =
            "wall = \"movable\"\nspring_stiffness_n_per_m = 1e7\nseawall_mass_kg_per_m = 50";
        let alone = |numerics: &str| of(stiff, numerics);
        let (loud, quiet) = (alone("sound_speed_ratio = 8"), alone("sound_speed_ratio = 80"));
        let scatter = FORCE_SCATTER * 2.1;
        assert!((quiet.force.unwrap() - scatter).abs() < 1e-3 * scatter);
        assert!((quiet.runup.unwrap() - LEVEL_SCATTER * 0.05).abs() < 1e-4);
        assert!(loud.runup.unwrap() > 0.005);
        assert_eq!(loud.force, quiet.force);
        // At a leaning wall the force is read with its sound.
        let leaning = of("wall_angle_deg = 120", "sound_speed_ratio = 8");
        assert!(leaning.force.unwrap() > 1.5 * scatter);
        assert_eq!(loud.displacement, quiet.displacement);
        assert!((loud.displacement.unwrap() - DISPLACEMENT_SCATTER * 2.8).abs() < 1e-12);
        // On a bed a wall is read with its sound. A stiff spring passes the force's error on, and more as
        // only the excess moves it.
        let bed = of(&format!("{stiff}\nbed = [[0, 0], [2, 0], [2.2, 0.02], [2.5, 0.02]]"), "");
        assert!(bed.displacement.unwrap() / 2.8 > 1.5 * bed.force.unwrap() / 2.1);
        let isph = alone("preset = \"isph\"").displacement.unwrap();
        assert!((isph - DISPLACEMENT_SCATTER * 2.8).abs() < 1e-12);
    }

    #[test]
    fn no_bar_is_narrower_than_the_narrowest() {
        let (own, told) = (config(0.01), outcome(0.01, 40.0));
        let bars = ErrorBars::new(&own, &told, &[(&config(0.02), &told)]);
        let percent = |bar: Option<f64>, value: f64| 100.0 * bar.unwrap() / value;
        let first = told.first_force_max.unwrap().value;
        let widest = percent(bars.force, first)
            .max(percent(bars.displacement, told.displacement_max.unwrap().value));
        let narrowest = narrowest_bar_percent(&own).unwrap();
        assert!(narrowest >= 0.4 && widest > narrowest * (1.0 - 1e-12), "{widest} {narrowest}");
        assert!(widest < 2.0 * narrowest, "{widest} {narrowest}");
    }

    #[test]
    fn a_slow_spring_does_not_follow_sound() {
        let soft = following(config(0.01).scene.seawall().unwrap(), 1.5);
        assert!(soft < 1e-3, "{soft}");
    }

    #[test]
    fn without_companions_there_are_no_bars() {
        assert_eq!(bars(&[0.01], 1.0), ErrorBars::default());
    }
}
