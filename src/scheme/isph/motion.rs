//! Velocities, positions and shifting: the second half of a step.

use super::operators::Operators;
use super::parting::Parting;
use super::{Isph, IsphOptions};
use crate::pairs::{Fluid, sum_in_turn};
use crate::scheme::{Dissipation, StepWalls};
use crate::water::{HoldInside, SHIFT_LIMIT, shifted_share};

impl Isph {
    /// Corrects velocities by the pressure gradient (Liang et al. 2017, Eq. 9). Then it moves the
    /// particles with the mean of old and new velocity (Eq. 10) and shifts them.
    ///
    /// Pressure and accelerations are affine in the responding wall's acceleration. So the final
    /// value of that is put in without another solve.
    pub(super) fn advance(&mut self, dt: f64, walls: &StepWalls<'_>) -> Dissipation {
        let n = self.fluid.len();
        let options = self.options;
        if self.responded {
            let a = self.answer;
            for (own, response) in self.settled.iter_mut().zip(&self.accelerations) {
                *own = [own[0] + a * response[0], own[1] + a * response[1]];
            }
        }
        self.planes.clear();
        self.planes.extend(
            (self.ghosts.bodies.iter().zip(walls.bodies))
                .map(|(body, motion)| body.plane.moved(motion.offset + dt * motion.velocity)),
        );
        let (settled, drag) = (&self.settled, &self.drag);
        let shifting = Shifting { options: &options, operators: &self.operators, dt };
        let Fluid { x, y, vx, vy, mass, .. } = &mut self.fluid;
        let [powers, works] = &mut self.spent;
        powers.resize(n, 0.0);
        works.resize(n, 0.0);
        let fields = [x, y, vx, vy, powers, works].map(Vec::as_mut_slice);
        self.near.change(fields, |i, [x, y, u, v, power, work]| {
            let ([along, up], [drag_x, drag_y], [old_u, old_v]) = (settled[i], drag[i], [*u, *v]);
            *u += dt * (along + drag_x);
            *v += dt * (up - options.gravity + drag_y);
            *x += 0.5 * dt * (old_u + *u);
            *y += 0.5 * dt * (old_v + *v);
            *power = 0.5 * mass[i] * (drag_x * (old_u + *u) + drag_y * (old_v + *v));
            *work = 0.0;
            if let Some([right, rise]) = shifting.of(i, [*u, *v]) {
                *x += right;
                *y += rise;
                *work = mass[i] * options.gravity * rise;
            }
        });
        let [mut viscous_power, mut shifting_work] =
            self.spent.each_ref().map(|spent| spent.iter().fold(0.0, |sum, spent| sum - spent));
        if options.viscosity > 0.0 {
            // The drag of the bodies does work on the water. That is no loss of the water's.
            let drags = walls.bodies.iter().zip(&self.drag_on_bodies);
            viscous_power -= drags.map(|(body, drag)| drag * body.velocity).sum::<f64>();
        }
        if options.shifting_coefficient > 0.0 {
            shifting_work -= options.gravity * self.part(dt);
        }
        shifting_work += self.pressure_loss(dt);
        let Fluid { x, y, vx, vy, mass, .. } = &mut self.fluid;
        let walls = (&self.ghosts, &*self.planes, walls.bodies);
        let hold = HoldInside::of((n, mass), [options.spacing, options.gravity], walls);
        let rows = [[x, y], [vx, vy]].map(|pair| pair.map(Vec::as_mut_slice));
        shifting_work -= sum_in_turn(self.path, n, rows, &hold);
        Dissipation { viscous_power, diffusion_power: 0.0, shifting_work }
    }

    /// Moves crowded particles near the surface apart; returns Σ m δy, kg m per metre.
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

/// Shifting of a step.
struct Shifting<'a> {
    options: &'a IsphOptions,
    operators: &'a Operators,
    /// The time step, seconds.
    dt: f64,
}

impl Shifting<'_> {
    /// δr = -A h |u| Δt ∇C with ∇C = Σ V ∇W, for a particle with the velocity u. None near the
    /// surface.
    fn of(&self, i: usize, [u, v]: [f64; 2]) -> Option<[f64; 2]> {
        let Shifting { options, operators, dt } = self;
        if options.shifting_coefficient == 0.0 || operators.grip[i] > 0.0 {
            return None;
        }
        let inside = shifted_share(operators.completeness[i], options.shifting_fades_in);
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let speed = (u * u + v * v).sqrt();
        let factor = options.shifting_coefficient * smoothing * speed * dt * inside;
        let limit = SHIFT_LIMIT * options.spacing;
        let [sx, sy] = operators.sway[i];
        // s = Σ F Δ points to where neighbours are crowded.
        Some([(-factor * sx).clamp(-limit, limit), (-factor * sy).clamp(-limit, limit)])
    }
}
