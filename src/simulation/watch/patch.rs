//! Arms and conserved quantities of a patch in free rotation.

use super::{Watch, kinetic_energy, remembers};
use crate::pairs::Fluid;
use crate::simulation::named_readings::Readings;
use crate::theory::rotating_patch::RotatingPatch;

pub(super) struct Patch {
    start: RotatingPatch,
    energy: f64,
    angular_momentum: f64,
    time: f64,
}

impl Patch {
    pub(super) fn new(start: RotatingPatch, fluid: &Fluid) -> Patch {
        let (energy, angular_momentum) = (kinetic_energy(fluid), angular_momentum(fluid));
        Patch { start, energy, angular_momentum, time: 0.0 }
    }
}

impl Watch for Patch {
    remembers!(time);

    fn sample(&mut self, time: f64, _: &Fluid) {
        self.time = time;
    }

    fn tell(&self, fluid: &Fluid, all: &mut Readings) {
        let side = self.start.side;
        let places = (0..fluid.len()).map(|k| [fluid.x[k], fluid.y[k]]);
        let arm = places.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
        let change = |now: f64, start: f64| 100.0 * (now / start - 1.0);
        let spin = change(angular_momentum(fluid), self.angular_momentum);
        let energy = change(kinetic_energy(fluid), self.energy);
        let drift = drift(fluid) / side;
        all.tell("arm", arm / side, "L");
        all.tell("arm_without_pressure", self.start.ballistic_arm(self.time) / side, "L");
        all.tell("angular_momentum_gap", spin, "%");
        all.tell("kinetic_energy_gap", energy, "%");
        all.tell("centre_drift", drift, "L");
    }
}

/// Σ m (x v - y u), clockwise taken positive, kg m²/s per metre of width.
fn angular_momentum(fluid: &Fluid) -> f64 {
    (0..fluid.len())
        .map(|k| fluid.mass[k] * (fluid.y[k] * fluid.vx[k] - fluid.x[k] * fluid.vy[k]))
        .sum()
}

/// Distance of the centre of mass from the origin, metres.
fn drift(fluid: &Fluid) -> f64 {
    let mass: f64 = fluid.mass.iter().sum();
    let mean = |places: &[f64]| {
        places.iter().zip(&fluid.mass).map(|(place, mass)| place * mass).sum::<f64>() / mass
    };
    mean(&fluid.x).hypot(mean(&fluid.y))
}
