//! Decay of Taylor-Green vortices.

use super::{Watch, kinetic_energy, remembers, share_of};
use crate::pairs::Fluid;
use crate::simulation::named_readings::Readings;
use crate::theory::taylor_green::TaylorGreen;

/// Follows the share of the vortices that is left.
pub(super) struct Vortices {
    flow: TaylorGreen,
    viscosity: f64,
    energy_at_start: f64,
    last: (f64, f64),
}

impl Vortices {
    pub(super) fn new(flow: TaylorGreen, viscosity: f64, fluid: &Fluid) -> Vortices {
        Vortices { flow, viscosity, energy_at_start: kinetic_energy(fluid), last: (0.0, 1.0) }
    }
}

impl Watch for Vortices {
    remembers!(last);

    fn sample(&mut self, time: f64, fluid: &Fluid) {
        self.last = (time, share_of(fluid, |place| self.flow.velocity(place)));
    }

    fn tell(&self, fluid: &Fluid, all: &mut Readings) {
        let (time, kept) = self.last;
        let should = libm::exp(-self.flow.damping(self.viscosity) * time);
        let energy = kinetic_energy(fluid) / self.energy_at_start;
        all.tell("velocity_kept", kept, "over U");
        all.tell("velocity_kept_exact", should, "over U");
        all.tell("decay_gap", 100.0 * (kept - should), "% of U");
        all.tell("kinetic_energy_kept", energy, "over the start's");
        all.tell("kinetic_energy_gap", 100.0 * (energy - should * should), "% of the start's");
        if kept > 0.0 && time > 0.0 {
            let rate = -libm::log(kept) / time;
            let numerical = rate / self.flow.damping(1.0) - self.viscosity;
            all.tell("numerical_viscosity", numerical, "m2/s");
        }
    }
}
