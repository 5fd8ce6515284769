//! The energy budget. Each term is summed on its own, so the residual is a true gap.

use serde::{Deserialize, Serialize};

use super::outcome::EnergyBudget;
use crate::body::{Wall, WallStep};
use crate::scheme::{Dissipation, Scheme};

/// Energy of the water at an instant, J per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct WaterEnergy {
    /// ½ Σ m u².
    pub kinetic: f64,
    /// Σ m g y, and that of a central field.
    pub potential: f64,
    /// Σ m ∫ p/ρ² dρ. Of tension only the share that acts in the scheme.
    pub elastic: f64,
    /// The energy of the water that has left over a crest.
    pub taken: f64,
}

impl WaterEnergy {
    /// Sums over the particles.
    pub fn of(water: &dyn Scheme, gravity: f64) -> WaterEnergy {
        let (fluid, field) = (water.fluid(), water.field());
        let elastic = water.elastic_energy();
        let taken = water.taken().energy;
        let mut energy = WaterEnergy { elastic, taken, ..WaterEnergy::default() };
        for k in 0..fluid.len() {
            let (vx, vy, mass) = (fluid.vx[k], fluid.vy[k], fluid.mass[k]);
            energy.kinetic += 0.5 * mass * (vx * vx + vy * vy);
            energy.potential += mass * gravity * fluid.y[k];
            if let Some(field) = field {
                energy.potential += mass * field.potential([fluid.x[k], fluid.y[k]]);
            }
        }
        energy
    }

    /// The water's initial energy that can turn into other forms: its motion if it moves, else its
    /// height.
    pub fn given(&self) -> f64 {
        if self.kinetic > 0.0 { self.kinetic } else { self.potential }
    }
}

/// Works and losses so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// At the start.
    pub start: WaterEnergy,
    paddle_work: f64,
    /// The largest magnitude of the paddle's work so far.
    most_work: f64,
    /// The energy that has passed between paddle and water in either direction, without the push of
    /// still water, J per metre of width.
    exchanged: f64,
    threshold_device: f64,
    stops: f64,
    viscous: f64,
    density_diffusion: f64,
    shifting: f64,
    last_sample: f64,
    last_powers: [f64; 2],
}

impl Ledger {
    /// A ledger for water with this energy, at the time `time`, s.
    pub fn open(start: WaterEnergy, time: f64) -> Ledger {
        Ledger { start, last_sample: time, ..Ledger::default() }
    }

    /// Adds the paddle's work over one step, from the water's force on it along x, and the force of
    /// still water.
    pub fn book_paddle(&mut self, [force, at_rest]: [f64; 2], travel: f64) {
        self.paddle_work -= force * travel;
        self.most_work = self.most_work.max(self.paddle_work.abs());
        self.exchanged += ((force - at_rest) * travel).abs();
    }

    /// Adds the energy that the wall's holding parts take over one step, from the water's force on
    /// the wall. `counted` is the force that the wall's law uses.
    pub fn book_wall(&mut self, wall: &Wall, [force, counted]: [f64; 2], step: WallStep) {
        self.threshold_device += (force - wall.driving(counted, step.travel)) * step.travel;
        self.stops += step.stop_loss;
    }

    /// Adds the losses of a step. Powers were summed only where `sampled`; between samples the
    /// trapezoid rule holds.
    pub fn book_losses(&mut self, time: f64, sampled: bool, losses: Dissipation) {
        self.shifting += losses.shifting_work;
        if sampled {
            let span = 0.5 * (time - self.last_sample);
            self.viscous += span * (losses.viscous_power + self.last_powers[0]);
            self.density_diffusion += span * (losses.diffusion_power + self.last_powers[1]);
            self.last_sample = time;
            self.last_powers = [losses.viscous_power, losses.diffusion_power];
        }
    }

    /// The energy to which gaps are relative: the largest magnitude of the paddle's work so far, J
    /// per metre of width. The work of a train goes up and down with the push of still water, and
    /// may be close to zero at the end. A paddle that `absorbs` takes back the energy it gives. So
    /// the energy that passed in either direction counts if it is more.
    pub fn worked(&self, absorbs: bool) -> f64 {
        if absorbs { self.most_work.max(self.exchanged) } else { self.most_work }
    }

    /// The budget with the water's present energy.
    pub fn close(&self, now: WaterEnergy, wall: &Wall) -> EnergyBudget {
        EnergyBudget {
            paddle_work: self.paddle_work,
            kinetic: now.kinetic - self.start.kinetic,
            potential: now.potential - self.start.potential,
            elastic: now.elastic - self.start.elastic,
            wall_kinetic: wall.kinetic_energy(),
            spring: wall.spring_energy(),
            threshold_device: self.threshold_device,
            stops: self.stops,
            viscous: self.viscous,
            density_diffusion: self.density_diffusion,
            shifting: self.shifting,
            outflow: now.taken - self.start.taken,
        }
    }
}

impl EnergyBudget {
    /// Paddle work less all other terms, J per metre of width.
    pub fn residual(&self) -> f64 {
        // Without `..`: a new term cannot be forgotten.
        let EnergyBudget {
            paddle_work,
            kinetic,
            potential,
            elastic,
            wall_kinetic,
            spring,
            threshold_device,
            stops,
            viscous,
            density_diffusion,
            shifting,
            outflow,
        } = *self;
        let bodies = [wall_kinetic, spring, threshold_device, stops];
        let losses = [viscous, density_diffusion, shifting, outflow];
        let found =
            bodies.into_iter().chain(losses).fold(kinetic + potential + elastic, |a, b| a + b);
        paddle_work - found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_before_the_clock_begins() {
        let mut ledger = Ledger::open(WaterEnergy::default(), 86400.0);
        let losses =
            Dissipation { viscous_power: 2.0, diffusion_power: -3.0, ..Dissipation::default() };
        [86400.0, 86401.0].into_iter().for_each(|time| ledger.book_losses(time, true, losses));
        assert_eq!([ledger.viscous, ledger.density_diffusion], [2.0, -3.0]);
    }

    #[test]
    fn a_gap_is_told_of_the_most_work_there_was() {
        // A paddle that moves forward and back against still water.
        let mut ledger = Ledger::default();
        for travel in [0.1, -0.099] {
            ledger.book_paddle([-200.0, -200.0], travel);
        }
        assert!((ledger.worked(false) - 20.0).abs() < 1e-12);
        assert_eq!(ledger.worked(false), ledger.worked(true));
        // Four hundred times it gives 0.1 J more than still water takes, and takes it back.
        for _ in 0..400 {
            [0.01, -0.01]
                .into_iter()
                .for_each(|travel| ledger.book_paddle([-210.0, -200.0], travel));
        }
        assert!((ledger.worked(false) - 20.0).abs() < 1e-9);
        assert!((ledger.worked(true) - 80.0).abs() < 1e-9);
    }
}
