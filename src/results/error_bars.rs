//! Error bars: how far a case's readings may be from the truth. They come from its resolution
//! companions and from known properties of the method.
//!
//! For a reading f at the case's spacing and f_r at r times that spacing, the bar is
//! ```text
//! √( [ |f - f_r| / (r^p - 1) ]² + scatter² )
//! ```
//! - The first term is Richardson's estimate for the order p. The largest over all companions is
//!   taken, because two runs may agree by accident. p is 1: the water is compressible, and the error
//!   by that is proportional to 1/c0². A companion also has r times the 1/c0², so the estimate
//!   includes both errors. The error by sound falls like the spacing, that by the spacing no slower
//!   (`results/convergence`). p is 1.5 for levels and moments of solitary waves at upright walls. It
//!   is 0.5 for runups on beaches.
//! - **Scatter**: between neighbouring spacings readings vary by a share of their size, levels by a
//!   share of the spacing. High runups are off by a share of R²/h at any spacing. At a crest loads and
//!   levels vary with the place of its edge among the rows. For a volume over a crest it is the volume
//!   of the thickest water there over a length of one spacing.
//!
//! A wall that stands has no bar of its displacement where the force may be the one that moves it, by
//! the force's own bar.
//!
//! A bar is absolute, in the reading's own unit. At walls over level beds without a crest it holds for
//! more than nine cases in ten: the measurements are in `results/accuracy/coverage.md`. No constant
//! was fitted to the cases that are counted there. At crests and on beaches fewer hold
//! (docs/limits.md).

use super::record::CaseRecord;
pub use crate::quantities::Bars as ErrorBars;
use crate::scene::{Behind, CaseConfig, PaddleChoice, Scheme, SeawallScene};
use crate::simulation::{Maximum, Outcome};
use crate::study::{Case, Study, has_enough_rows};

/// Order of Richardson's estimate: that of the error by sound.
const ORDER: f64 = 1.0;
/// The same for levels and moments of a solitary wave at an upright wall. They depend on the water's
/// tip. It is between the orders of the error by sound, 1, and of that by a tip's curvature, 2.
const TIP_ORDER: f64 = 1.5;

/// The same for a runup on a beach, which is told where the tongue is one spacing thick. As a wave
/// turns back there its surface meets the beach without an angle: the tongue's thickness goes as the
/// square of the distance from its tip (Carrier & Greenspan 1958).
const TONGUE_ORDER: f64 = 0.5;

// Errors that companions do not show. With these values 95 % of the bars of 144 cases hold. Their
// walls and waves lie between those of the 300 cases, at six spacings
// (`results/accuracy/coverage_between.md`).
/// Scatter of a force, as a share of it.
const FORCE_SCATTER: f64 = 0.0028;
/// Scatter of a moment, as a share of it.
const MOMENT_SCATTER: f64 = 0.0045;
/// Scatter of a level, as a share of the spacing.
const LEVEL_SCATTER: f64 = 0.06;
/// What no spacing takes off a runup, as a share of R²/h. A wall's ghosts take the water in a tip that
/// falls to be as heavy as at rest.
const TIP_ERROR: f64 = 0.005;
/// Scatter of a displacement, as a share of it.
const DISPLACEMENT_SCATTER: f64 = 0.0021;

// The edge of a crest lies somewhere between two rows. Set by 18 crests, and judged by 36 others
// (docs/limits.md).
/// Scatter of a load at a wall with a crest, as a share of it times Δx/h.
const CREST_SCATTER: f64 = 0.3;
/// Scatter of a level there, as a share of the spacing.
const CREST_LEVEL_SCATTER: f64 = 0.2;

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
        let row = spacing / scene.still_water_depth_m;
        let [load_scatter, level_scatter] = match scene.behind {
            Behind::Nothing => [0.0, LEVEL_SCATTER * row],
            _ => [CREST_SCATTER * row, CREST_LEVEL_SCATTER * row],
        };
        let ratio = |other: &CaseConfig| other.numerics.particle_spacing_m / spacing;
        let refined = |read: &dyn Fn(&Outcome) -> Option<f64>, order: f64| {
            let own = read(outcome)?;
            let others = companions.iter().filter_map(|(config, outcome)| {
                Some(richardson(own, read(outcome)?, ratio(config), order))
            });
            Some((own, others.max_by(f64::total_cmp)?))
        };
        let tip_order = if is_measured(config, scene) { TIP_ORDER } else { ORDER };
        let tongue = scene.reads_tongue_at_a_spacing();
        let runup_order = if tongue { TONGUE_ORDER } else { tip_order };
        let value = |maximum: Option<Maximum>| maximum.map(|maximum| maximum.value);
        let relative = |read: &dyn Fn(&Outcome) -> Option<f64>, order: f64, scatter: f64| {
            let (own, resolution) = refined(read, order)?;
            Some(resolution.hypot(scatter * own))
        };
        let force_scatter = FORCE_SCATTER.hypot(load_scatter);
        let moment_scatter = MOMENT_SCATTER.hypot(load_scatter);
        let force = |read: &dyn Fn(&Outcome) -> Option<f64>| relative(read, ORDER, force_scatter);
        let moment =
            |read: &dyn Fn(&Outcome) -> Option<f64>| relative(read, tip_order, moment_scatter);
        let runup = |read: &dyn Fn(&Outcome) -> Option<f64>| {
            let (own, resolution) = refined(read, runup_order)?;
            Some(resolution.hypot(level_scatter).hypot(TIP_ERROR * own * own))
        };
        // A wall that stands, under a force that may be the one that moves it.
        let whole_force = force(&|o| Some(o.force_max.value));
        let limit = scene.onset_ratio(config.scene.force_unit_n_per_m());
        let may_move = outcome.displacement_max.is_some_and(|farthest| farthest.value == 0.0)
            && whole_force.is_some_and(|bar| outcome.force_max.value + bar > limit);
        let displacement = relative(&|o| value(o.displacement_max), ORDER, DISPLACEMENT_SCATTER);
        ErrorBars {
            force: force(&|o| value(o.first_force_max)),
            runup: runup(&|o| value(o.first_runup_max)),
            displacement: displacement.filter(|_| !may_move),
            whole_force,
            whole_runup: runup(&|o| Some(o.runup_max.value)),
            moment: moment(&|o| value(o.first_moment_max)),
            whole_moment: moment(&|o| value(o.moment_max)),
            overtopping: refined(&|o| Some(o.overtopped?.volume_m2), ORDER).and_then(|volume| {
                let thickness = outcome.overtopped?.thickness_max_m;
                Some(volume.1.hypot(spacing * thickness))
            }),
        }
    }
}

/// Whether a case is like those for which [`TIP_ORDER`] was measured.
fn is_measured(config: &CaseConfig, scene: &SeawallScene) -> bool {
    let numerics = &config.numerics;
    let corrected = numerics.scheme == Scheme::Wcsph && numerics.corrected_gradients;
    let solitary = scene.paddle == PaddleChoice::Solitary && scene.behind == Behind::Nothing;
    corrected && solitary && scene.is_upright_over_level_bed() && has_enough_rows(config, 1.0)
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

/// Richardson's estimate of the error of `fine` for the order `order`. `coarse` is the same quantity
/// at `ratio` times the spacing.
fn richardson(fine: f64, coarse: f64, ratio: f64, order: f64) -> f64 {
    (fine - coarse).abs() / (libm::pow(ratio, order) - 1.0)
}

#[cfg(test)]
mod tests;
