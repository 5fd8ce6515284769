//! Period and decay of a standing wave.

use super::{Watch, half_swings, remembers, share_of};
use crate::pairs::Fluid;
use crate::simulation::named_readings::Readings;
use crate::theory::standing_wave::StandingWave;

/// Follows the share of the wave's flow in the water's motion.
pub(super) struct Swing {
    wave: StandingWave,
    surface_speed: f64,
    viscosity: f64,
    series: Vec<(f64, f64)>,
}

impl Swing {
    pub(super) fn new(wave: StandingWave, surface_speed: f64, viscosity: f64) -> Swing {
        Swing { wave, surface_speed, viscosity, series: Vec::new() }
    }

    /// None if the wave is too viscous to swing.
    fn exact(&self) -> Option<Exact> {
        let period = std::f64::consts::TAU / self.wave.frequency();
        if self.viscosity == 0.0 {
            return Some(Exact { period, peaks: None });
        }
        // One period more than the water had.
        let until = self.series.last().map_or(0.0, |last| last.0) + period;
        let (half, peaks) = half_swings(&self.wave.swing(self.viscosity, until))?;
        Some(Exact { period: 2.0 * half, peaks: Some(peaks) })
    }
}

impl Watch for Swing {
    remembers!(series);

    fn sample(&mut self, time: f64, fluid: &Fluid) {
        let flow = |place| self.wave.velocity(place).map(|part| self.surface_speed * part);
        self.series.push((time, share_of(fluid, flow)));
    }

    fn tell(&self, _: &Fluid, all: &mut Readings) {
        let exact = self.exact();
        all.tell("period_exact", exact.as_ref().map(|exact| exact.period), "s");
        let Some((half, peaks)) = half_swings(&self.series) else { return };
        all.tell("period", 2.0 * half, "s");
        let gap = |exact: &Exact| 100.0 * (2.0 * half / exact.period - 1.0);
        all.tell("period_gap", exact.as_ref().map(gap), "%");
        let (Some(first), Some(last)) = (peaks.first(), peaks.last()) else { return };
        if last.0 > first.0 {
            let kept = last.1 / first.1;
            let should = exact.and_then(|exact| exact.between(peaks.len()));
            let share = should.map(|should| should.0);
            all.tell("amplitude_kept", kept, "over the first peak's");
            all.tell("amplitude_kept_exact", share, "over the first peak's");
            let gap = |should: f64| 100.0 * (kept - should);
            all.tell("decay_gap", share.map(gap), "% of the first peak");
            let rate = -libm::log(kept) / (last.0 - first.0);
            let per_viscosity = self.wave.damping(1.0);
            all.tell("damping_rate", rate, "1/s");
            let beyond = should.map(|(_, exact)| (rate - exact) / per_viscosity);
            all.tell("numerical_viscosity", beyond, "m2/s");
        }
    }
}

/// The wave by linear theory.
struct Exact {
    /// Period, seconds.
    period: f64,
    /// Its peaks with their times, if it decays.
    peaks: Option<Vec<(f64, f64)>>,
}

impl Exact {
    /// The share that is left from the first to the last of this many peaks, and its decay rate,
    /// 1/s.
    fn between(&self, count: usize) -> Option<(f64, f64)> {
        let Some(peaks) = &self.peaks else { return Some((1.0, 0.0)) };
        let (first, last) = (peaks.first()?, peaks.get(count.checked_sub(1)?)?);
        let left = last.1 / first.1;
        Some((left, -libm::log(left) / (last.0 - first.0)))
    }
}
