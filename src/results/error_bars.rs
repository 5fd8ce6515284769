//! Error bars: how far a case's readings may be from the truth. They come from its resolution
//! companions and from known properties of the method.
//!
//! For a reading f at the case's spacing and f_r at r times that spacing, the bar is
//! ```text
//! √( [ |f - f_r| / (r - 1) ]² + scatter² )
//! ```
//! - The first term is Richardson's estimate for order 1. The largest over all companions is taken,
//!   because two runs may agree by accident. The water is compressible, and the error by that is
//!   proportional to 1/c0². A companion also has r times the 1/c0², so the estimate includes both
//!   errors. The error by sound falls like the spacing, that by the spacing no slower
//!   (`results/convergence`).
//! - **Scatter**: between neighbouring spacings readings vary by a share of their size, levels by a
//!   share of the spacing. For a volume over a crest it is the volume of the thickest water there
//!   over a length of one spacing.
//!
//! A bar is absolute, in the reading's own unit, and holds for more than nine cases in ten: the
//! measurements are in `results/accuracy/coverage.md`. No constant was fitted to the cases that are
//! counted there.

use super::record::CaseRecord;
pub use crate::quantities::Bars as ErrorBars;
use crate::scene::CaseConfig;
use crate::simulation::{Maximum, Outcome};
use crate::study::{Case, Study};

// Errors that companions do not show. With these values 95 % of the bars of 144 cases hold. Their
// walls and waves lie between those of the 300 cases, at six spacings
// (`results/accuracy/coverage_between.md`).
/// Scatter of a force, as a share of it.
const FORCE_SCATTER: f64 = 0.0028;
/// Scatter of a level, as a share of the spacing. It is that of the lowest wave, whose tip is not
/// sharp.
const LEVEL_SCATTER: f64 = 0.07;
/// Scatter of a displacement, as a share of it.
const DISPLACEMENT_SCATTER: f64 = 0.0021;

impl ErrorBars {
    /// The bars of a successful case, from those of its companions that were successful.
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
                Some(richardson(own, read(outcome)?, ratio(config)))
            });
            Some((own, others.max_by(f64::total_cmp)?))
        };
        let value = |maximum: Option<Maximum>| maximum.map(|maximum| maximum.value);
        let relative = |read: &dyn Fn(&Outcome) -> Option<f64>, scatter: f64| {
            let (own, resolution) = refined(read)?;
            Some(resolution.hypot(scatter * own))
        };
        let force = |read: &dyn Fn(&Outcome) -> Option<f64>| relative(read, FORCE_SCATTER);
        let runup = |read: &dyn Fn(&Outcome) -> Option<f64>| {
            let (_, resolution) = refined(read)?;
            Some(resolution.hypot(LEVEL_SCATTER * spacing / scene.still_water_depth_m))
        };
        ErrorBars {
            force: force(&|o| value(o.first_force_max)),
            runup: runup(&|o| value(o.first_runup_max)),
            displacement: relative(&|o| value(o.displacement_max), DISPLACEMENT_SCATTER),
            whole_force: force(&|o| Some(o.force_max.value)),
            whole_runup: runup(&|o| Some(o.runup_max.value)),
            overtopping: refined(&|o| Some(o.overtopped?.volume_m2)).and_then(|(_, resolution)| {
                let thickness = outcome.overtopped?.thickness_max_m;
                Some(resolution.hypot(spacing * thickness))
            }),
        }
    }
}

/// The smallest possible bar of force and displacement for a case, percent, for any particle
/// spacing. It is the scatter between spacings.
pub fn narrowest_bar_percent(config: &CaseConfig) -> Option<f64> {
    let scene = config.scene.seawall()?;
    let displacement = if scene.wall.moves() { DISPLACEMENT_SCATTER } else { 0.0 };
    Some(100.0 * displacement.max(FORCE_SCATTER))
}

impl Study {
    /// The error bars of a case; none if it or its companions were not successful. `records` are in
    /// the order of [`Study::runs`].
    pub fn error_bars(&self, case: usize, records: &[Option<CaseRecord>]) -> ErrorBars {
        let own = records.get(case).and_then(Option::as_ref);
        own.map_or_else(Default::default, |own| self.error_bars_of(own, records))
    }

    /// The companions of a successful case that failed, with their records. `records` are in the
    /// order of [`Study::runs`].
    pub fn failed_companions<'a>(
        &'a self,
        own: &CaseRecord,
        records: &'a [Option<CaseRecord>],
    ) -> impl Iterator<Item = (&'a Case, &'a CaseRecord)> {
        let of = own.is_ok().then(|| &self.companions_of[own.index]);
        let all = of.into_iter().flatten().filter_map(|&run| records.get(run)?.as_ref());
        all.filter(|record| !record.is_ok()).map(|record| (self.run(record.index), record))
    }

    /// The bars of a record that is not among the others.
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

/// Richardson's estimate of the error of `fine` for order 1. `coarse` is the same quantity at
/// `ratio` times the spacing.
fn richardson(fine: f64, coarse: f64, ratio: f64) -> f64 {
    (fine - coarse).abs() / (ratio - 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::simulation::Overtopped;

    fn config(spacing: f64) -> CaseConfig {
        let scene = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 50";
        CaseConfig::of(scene, &format!("particle_spacing_m = {spacing:?}"))
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
    fn richardson_is_exact_for_the_first_order() {
        let read = |spacing: f64| 1.0 + 3.0 * spacing;
        assert!((richardson(read(0.1), read(0.2), 2.0) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn the_limit_lies_inside_for_every_order_from_one() {
        for order in [1.0, 1.5, 2.0] {
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

    /// A case's error by sound, proportional to 1/c0², is covered by its companions, for any c0.
    #[test]
    fn the_error_by_sound_lies_inside() {
        for ratio in [8.0, 10.12, 16.0] {
            let mut own = config(0.01);
            own.numerics.sound_speed_ratio = ratio;
            let coarse = own.coarsened(2.0).unwrap();
            let told = |config: &CaseConfig| {
                let error = 0.5 / config.numerics.sound_speed_ratio.powi(2);
                let mut outcome = outcome(0.01, 40.0);
                outcome.first_runup_max = Some(Maximum { value: 1.0 + error, time_s: 2.0 });
                (outcome, error)
            };
            let ((fine, error), (coarser, _)) = (told(&own), told(&coarse));
            let bar = ErrorBars::new(&own, &fine, &[(&coarse, &coarser)]).runup.unwrap();
            assert!(bar >= 0.99 * error && bar < error + 0.0031, "{ratio}: {bar} for {error}");
        }
    }

    #[test]
    fn agreement_by_accident_leaves_scatter() {
        let (own, told) = (config(0.01), outcome(0.01, 1.0));
        let bars = ErrorBars::new(&own, &told, &[(&config(0.02), &told)]);
        assert!((bars.force.unwrap() - FORCE_SCATTER * 2.1).abs() < 1e-12);
        assert!((bars.runup.unwrap() - LEVEL_SCATTER * 0.05).abs() < 1e-12);
        assert!((bars.displacement.unwrap() - DISPLACEMENT_SCATTER * 2.8).abs() < 1e-12);
    }

    /// A volume over a crest also has a bar if a companion has a volume. If it is dry at both
    /// spacings, the bar is 0.
    #[test]
    fn what_goes_over_a_crest_has_a_bar() {
        let told = |volume_m2, thickness_max_m| {
            let over = Overtopped { volume_m2, thickness_max_m, ..Overtopped::default() };
            Outcome { overtopped: Some(over), ..outcome(0.01, 1.0) }
        };
        let bar = |own: &Outcome, other: &Outcome| {
            ErrorBars::new(&config(0.01), own, &[(&config(0.02), other)]).overtopping
        };
        assert_eq!(bar(&told(0.0, 0.0), &told(0.0, 0.0)), Some(0.0));
        let far = bar(&told(0.01, 0.03), &told(0.016, 0.05)).unwrap();
        assert!((far - 0.006_f64.hypot(0.01_f64 * 0.03)).abs() < 1e-15, "{far}");
        assert_eq!(bar(&told(0.01, 0.03), &outcome(0.02, 1.0)), None);
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
        assert!(narrowest > 0.25 && widest > narrowest * (1.0 - 1e-12), "{widest} {narrowest}");
        assert!(widest < 2.0 * narrowest, "{widest} {narrowest}");
    }

    #[test]
    fn without_companions_there_are_no_bars() {
        assert_eq!(bars(&[0.01], 1.0), ErrorBars::default());
    }
}
