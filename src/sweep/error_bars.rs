//! Error bars: how far a case's readings may be from the truth, from its resolution companions and
//! from what is known about the method.
//!
//! For a reading f at the case's spacing and f_r at r times that spacing the bar is
//! ```text
//! √( [ |f - f_r| / (r^p - 1) ]² + Σ known² )
//! ```
//! the first term being Richardson's with a measured order p, the largest over all companions (two
//! runs may agree by accident). The known terms are those that refining the particles does not
//! show, or not reliably:
//! - **wave**: what the measured wave differs from the nominal one by, times the secant slope of
//!   the reading over the wave height;
//! - **compression**: still water weighs g h/(6 c0²) too little on the wall;
//! - **scatter**: force and displacement vary by a share of their size between neighbouring
//!   spacings, levels by a share of the spacing.
//!
//! A bar is absolute, in the reading's own unit, and holds for about nine cases in ten:
//! `results/accuracy/coverage.md` has what was measured.

use crate::scene::{CaseConfig, SeawallScene};
use crate::simulation::{Maximum, Outcome};

/// Order p of force and displacement: measured 1.2 and more on fixed walls, less under breaking.
const ORDER: f64 = 1.0;
/// Order p of the runup where the tip of the water is thinner than a particle: 0.65, measured at
/// H/h = 0.6 on a fixed wall ...
const TIP_ORDER: f64 = 0.65;
/// ... which is from this H/h on, on walls ...
const TIP_WAVE: f64 = 0.55;
/// ... at least as stiff as this, N/m.
const TIP_STIFFNESS: f64 = 1e4;
/// Scatter of a force maximum, as a share of F* - 1: what covers fixed walls at 0.0125 and 0.016 m.
const FORCE_SCATTER: f64 = 0.016;
/// Scatter of a level, as a share of the spacing.
const LEVEL_SCATTER: f64 = 0.2;
/// Scatter of a displacement maximum, as a share of it.
const DISPLACEMENT_SCATTER: f64 = 0.01;

/// Estimated absolute errors; `None` where the case has no such reading or no companion has.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ErrorBars {
    /// Of `first_force_max`.
    pub force: Option<f64>,
    /// Of `first_runup_max`.
    pub runup: Option<f64>,
    /// Of `displacement_max`.
    pub displacement: Option<f64>,
}

impl ErrorBars {
    /// The bars of a case that has ended well, from those of its companions that have.
    pub fn new(
        config: &CaseConfig,
        outcome: &Outcome,
        companions: &[(&CaseConfig, &Outcome)],
    ) -> ErrorBars {
        // Other scenes have none of these readings.
        let Some(scene) = config.scene.seawall() else { return ErrorBars::default() };
        let depth = scene.still_water_depth_m;
        let spacing = config.numerics.particle_spacing_m;
        let ratio = |other: &CaseConfig| other.numerics.particle_spacing_m / spacing;
        let refined = |order: f64, read: &dyn Fn(&Outcome) -> Option<f64>| {
            let own = read(outcome)?;
            let others = companions.iter().filter_map(|(config, outcome)| {
                Some(richardson(own, read(outcome)?, ratio(config), order))
            });
            Some((own, others.max_by(f64::total_cmp)?))
        };
        let nominal = scene.wave_height_ratio;
        let wave = outcome
            .measured_wave_height_ratio
            .filter(|_| nominal > 0.0)
            .map_or(0.0, |measured| (measured / nominal - 1.0).abs());
        let stiffness = config.numerics.sound_speed_ratio;
        let compression = 1.0 / (6.0 * stiffness * stiffness);
        let bar = |terms: &[f64]| terms.iter().map(|term| term * term).sum::<f64>().sqrt();
        let value = |maximum: Option<Maximum>| maximum.map(|maximum| maximum.value);
        ErrorBars {
            force: refined(ORDER, &|o| value(o.first_force_max)).map(|(own, resolution)| {
                let dynamic = (own - 1.0).abs();
                bar(&[resolution, wave * dynamic, compression, FORCE_SCATTER * dynamic])
            }),
            runup: refined(runup_order(scene), &|o| value(o.first_runup_max)).map(
                |(own, resolution)| bar(&[resolution, wave * own, LEVEL_SCATTER * spacing / depth]),
            ),
            displacement: refined(ORDER, &|o| value(o.displacement_max)).map(
                |(own, resolution)| bar(&[resolution, wave * own, DISPLACEMENT_SCATTER * own]),
            ),
        }
    }
}

fn runup_order(scene: &SeawallScene) -> f64 {
    let stands = scene.spring_stiffness_n_per_m.is_none_or(|stiffness| stiffness >= TIP_STIFFNESS);
    if stands && scene.wave_height_ratio >= TIP_WAVE { TIP_ORDER } else { ORDER }
}

/// Richardson's estimate of the error of `fine`, from the same quantity on a spacing `ratio` times
/// as large and the order of convergence p: |f - f_r|/(r^p - 1).
pub fn richardson(fine: f64, coarse: f64, ratio: f64, order: f64) -> f64 {
    (fine - coarse).abs() / (libm::pow(ratio, order) - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Unwatched;
    use crate::sweep::{Runner, fake::FakeRunner};

    fn config(spacing: f64) -> CaseConfig {
        let scene = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 50";
        let numerics = format!("particle_spacing_m = {spacing:?}");
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap()
    }

    /// Readings that converge to 2, 1 and 3 with order `order`, on an exact wave.
    fn outcome(spacing: f64, order: f64) -> Outcome {
        let mut outcome =
            FakeRunner::default().case(&config(spacing), None, &Unwatched).unwrap().outcome;
        let maximum = |value| Some(Maximum { value, time_s: 2.0 });
        let error = (spacing / 0.1).powf(order);
        outcome.measured_wave_height_ratio = Some(0.5);
        outcome.first_force_max = maximum(2.0 + error);
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
    fn the_limit_lies_inside_for_every_order_from_one_to_two() {
        for order in [1.0, 1.5, 2.0] {
            for spacings in [&[0.01, 0.02][..], &[0.01, 0.01 * std::f64::consts::SQRT_2, 0.02]] {
                let bars = bars(spacings, order);
                let error = 0.1_f64.powf(order);
                assert!(bars.force.unwrap() >= error && bars.runup.unwrap() >= error);
                assert!(bars.displacement.unwrap() >= 2.0 * error);
                assert!(bars.force.unwrap() < 3.0 * error + 0.02, "{order}: {bars:?}");
            }
        }
    }

    #[test]
    fn agreement_by_accident_leaves_the_known_errors() {
        let outcome = outcome(0.01, 1.0);
        let bars = ErrorBars::new(&config(0.01), &outcome, &[(&config(0.02), &outcome)]);
        let (force, runup) = (bars.force.unwrap(), bars.runup.unwrap());
        assert!(force > FORCE_SCATTER * 1.1 && force < 0.02, "{force}");
        assert!((runup - LEVEL_SCATTER * 0.01 / 0.2).abs() < 1e-12, "{runup}");
    }

    #[test]
    fn without_companions_there_are_no_bars() {
        assert_eq!(bars(&[0.01], 1.0), ErrorBars::default());
    }
}
