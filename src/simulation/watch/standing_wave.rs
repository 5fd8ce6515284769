//! Period and decay of a standing wave.

use super::{Watch, half_swings, remembers, share_of};
use crate::pairs::Fluid;
use crate::simulation::told::Readings;
use crate::theory::standing_wave::StandingWave;

/// Follows how much of the wave's flow the water has.
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
}

impl Watch for Swing {
    remembers!(series);

    fn sample(&mut self, time: f64, fluid: &Fluid) {
        let flow = |place| self.wave.velocity(place).map(|part| self.surface_speed * part);
        self.series.push((time, share_of(fluid, flow)));
    }

    fn tell(&self, _: &Fluid, all: &mut Readings) {
        let exact = std::f64::consts::TAU / self.wave.frequency();
        all.tell("period_exact", exact, "s");
        let Some((half, peaks)) = half_swings(&self.series) else { return };
        all.tell("period", 2.0 * half, "s");
        all.tell("period_gap", 100.0 * (2.0 * half / exact - 1.0), "%");
        let (Some(first), Some(last)) = (peaks.first(), peaks.last()) else { return };
        if last.0 > first.0 {
            let span = last.0 - first.0;
            let kept = last.1 / first.1;
            let should = libm::exp(-self.wave.damping(self.viscosity) * span);
            all.tell("amplitude_kept", kept, "over the first peak's");
            all.tell("amplitude_kept_exact", should, "over the first peak's");
            all.tell("decay_gap", 100.0 * (kept - should), "% of the first peak");
            let rate = -libm::log(kept) / span;
            let per_viscosity = self.wave.damping(1.0);
            all.tell("damping_rate", rate, "1/s");
            all.tell("numerical_viscosity", rate / per_viscosity - self.viscosity, "m2/s");
        }
    }
}
