//! Velocities, places, shifting: the second half of a step.

use super::Isph;
use super::parting::Parting;
use crate::scheme::{Dissipation, StepWalls};
use crate::water::{HoldInside, SHIFT_LIMIT, shifted_share};

impl Isph {
    /// Corrects velocities by the pressure gradient (Liang et al. 2017, Eq. 9), moves the particles
    /// with the mean of old and new velocity (Eq. 10) and shifts them.
    ///
    /// Pressure and accelerations are affine in the responding wall's acceleration, so that its
    /// settled value is put in without another solve.
    pub(super) fn advance(&mut self, dt: f64, walls: &StepWalls<'_>) -> Dissipation {
        let n = self.fluid.len();
        let options = self.options;
        if self.responded {
            let a = walls.acceleration;
            for (pressure, response) in self.pressure.iter_mut().zip(&self.carried.response) {
                *pressure += a * response;
            }
            for (own, response) in self.settled.iter_mut().zip(&self.accelerations) {
                *own = [own[0] + a * response[0], own[1] + a * response[1]];
            }
        }
        self.planes.clear();
        self.planes.extend(
            (self.ghosts.bodies.iter().zip(walls.bodies))
                .map(|(body, motion)| body.plane.moved(motion.offset + dt * motion.velocity)),
        );
        let mut viscous_power = 0.0;
        let mut shifting_work = 0.0;
        for i in 0..n {
            let velocity = [self.fluid.vx[i], self.fluid.vy[i]];
            let mut change = self.settled[i];
            change[1] -= options.gravity;
            let drag = self.drag[i];
            viscous_power -= self.fluid.mass[i] * (drag[0] * velocity[0] + drag[1] * velocity[1]);
            change = [change[0] + drag[0], change[1] + drag[1]];
            let new = [velocity[0] + dt * change[0], velocity[1] + dt * change[1]];
            self.fluid.vx[i] = new[0];
            self.fluid.vy[i] = new[1];
            self.fluid.x[i] += 0.5 * dt * (velocity[0] + new[0]);
            self.fluid.y[i] += 0.5 * dt * (velocity[1] + new[1]);
            shifting_work -= self.fluid.mass[i] * options.gravity * self.shift(i, dt);
        }
        if options.shifting_coefficient > 0.0 {
            shifting_work -= options.gravity * self.part(dt);
        }
        let (fluid, planes, bodies) = (&mut self.fluid, &*self.planes, walls.bodies);
        HoldInside { planes, bed: None, bodies, skin: 1e-3 * options.spacing }
            .run(self.path, fluid);
        Dissipation { viscous_power, diffusion_power: 0.0, shifting_work }
    }

    /// δr = -A h |u| Δt ∇C, ∇C = Σ V ∇W, away from the surface only; returns how far it lifts.
    fn shift(&mut self, i: usize, dt: f64) -> f64 {
        let options = &self.options;
        if options.shifting_coefficient == 0.0 || self.operators.grip[i] > 0.0 {
            return 0.0;
        }
        let inside = shifted_share(self.operators.completeness[i], options.shifting_fades_in);
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let factor = options.shifting_coefficient * smoothing * self.fluid.speed(i) * dt * inside;
        let limit = SHIFT_LIMIT * options.spacing;
        let [sx, sy] = self.operators.sway[i];
        // s = Σ F Δ points to where neighbours crowd.
        let [dx, dy] = [-factor * sx, -factor * sy].map(|shift| shift.clamp(-limit, limit));
        self.fluid.x[i] += dx;
        self.fluid.y[i] += dy;
        dy
    }

    /// Parts what crowds near the surface; returns Σ m δy, kg m per metre.
    pub(super) fn part(&mut self, dt: f64) -> f64 {
        let Isph { options, near, points, operators, fluid, .. } = self;
        let parting = Parting {
            near,
            points,
            completeness: &operators.completeness,
            strength: options.shifting_coefficient,
            fades_in: options.shifting_fades_in,
            spacing: options.spacing,
            dt,
        };
        parting.part(fluid)
    }
}
