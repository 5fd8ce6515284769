//! δ-SPH behind the contract of all schemes.

use super::Wcsph;
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::math::team::Team;
use crate::pairs::{Fluid, GHOST_MARGIN};
use crate::scheme::{
    Dissipation, Load, Scheme, SchemeState, StateEquation, StepError, StepWalls, Taken,
};
use crate::theory::central_field::CentralField;
use crate::water::first_level;

impl Scheme for Wcsph {
    fn fluid(&self) -> &Fluid {
        &self.fluid
    }

    fn walls(&self) -> &Ghosts {
        &self.ghosts
    }

    fn kernel(&self) -> (KernelChoice, f64) {
        (self.options.kernel, self.options.support_radius)
    }

    fn pressures(&self) -> &[f64] {
        &self.work.pressure
    }

    fn density_rates(&self) -> Option<&[f64]> {
        Some(&self.work.carried.density_rate)
    }

    fn state_equation(&self) -> Option<&StateEquation> {
        Some(&self.options.state)
    }

    /// Σ m ∫ p/ρ² dρ.
    fn elastic_energy(&self) -> f64 {
        (0..self.fluid.len()).map(|k| self.elastic_energy_of(k)).sum()
    }

    fn field(&self) -> Option<CentralField> {
        self.options.field
    }

    fn taken(&self) -> Taken {
        self.taken
    }

    fn take_on(&mut self, team: &Team) {
        self.pairs.take_on(team);
        self.exchange.take_on(team);
    }

    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError> {
        Wcsph::prepare(self, bodies, dt);
        Ok(())
    }

    fn load(&self, body: usize) -> Load {
        let [force, added_mass] = self.work.loads[body];
        Load { force, added_mass }
    }

    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation {
        Wcsph::finish(self, dt, walls, sample)
    }

    fn level_at(&self, body: usize) -> f64 {
        self.exchange.level(&self.ghosts, body, self.held_bodies[body].offset)
    }

    /// The search goes upwards from `from`, to the first height at which the kernel's coverage Σ W
    /// V falls to 1/2.
    fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
        let radius = self.options.support_radius;
        let margin = GHOST_MARGIN * self.options.spacing;
        let factor = self.options.kernel.normalisation() / (radius * radius);
        let bodies = self.ghosts.bodies.iter().zip(&self.held_bodies);
        let face = bodies
            .map(|(body, motion)| body.plane.moved(motion.offset))
            .find(|plane| plane.normal[1] == 0.0 && (plane.point[0] - x).abs() < radius)
            .map(|plane| plane.point[0]);
        let near = &mut self.column;
        near.clear();
        let reach = radius + margin;
        self.pairs.sorted().0.visit_box([x - reach, x + reach], [f64::MIN, f64::MAX], |range| {
            for k in range.filter(|&k| (self.fluid.x[k] - x).abs() < radius) {
                let volume = self.fluid.mass[k] / self.fluid.density[k];
                near.push((self.fluid.x[k] - x) / radius, self.fluid.y[k] / radius, volume);
                let image = face.map(|face| 2.0 * face - self.fluid.x[k] - x);
                if let Some(image) = image.filter(|image| image.abs() < radius) {
                    near.push(image / radius, self.fluid.y[k] / radius, volume);
                }
            }
        });
        let (path, kernel) = (self.pairs.path, self.options.kernel);
        let coverage = |y: f64| factor * near.coverage(path, kernel, y / radius);
        first_level(coverage, from, self.options.spacing)
    }

    fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        let fluid = self.work.water(&self.records[..self.fluid.padded_len()], false);
        let motion = BodyMotion { offset: self.held_bodies[body].offset, ..*motion };
        self.exchange.face_force(self.pairs.path, &self.ghosts, body, &motion, fluid)
    }

    fn face_pressures(&mut self, body: usize, motion: &BodyMotion, pressures: &mut Vec<f64>) {
        let motion = BodyMotion { offset: self.held_bodies[body].offset, ..*motion };
        let fluid = self.work.water(&self.records[..self.fluid.padded_len()], false);
        let body = (body, &motion);
        self.exchange.face_pressures(self.pairs.path, &self.ghosts, body, fluid, pressures);
    }

    fn can_be_kept(&self) -> bool {
        self.substep == 0
    }

    fn slow_down(&mut self, share: f64) {
        let Fluid { vx, vy, .. } = &mut self.fluid;
        vx.iter_mut().chain(vy).for_each(|speed| *speed *= share);
    }

    fn state(&self) -> SchemeState {
        SchemeState::Wcsph(Box::new(Wcsph::state(self)))
    }

    fn restore(&mut self, state: SchemeState) {
        let SchemeState::Wcsph(state) = state else {
            unreachable!("a checkpoint is bound to its scheme")
        };
        Wcsph::restore(self, *state);
    }

    fn pair_evaluations(&self) -> u64 {
        self.pair_evaluations
    }

    fn list_rebuilds(&self) -> u64 {
        self.pairs.rebuilds()
    }

    fn boundary_fallbacks(&self) -> u64 {
        self.boundary_fallbacks
    }

    fn phases(&self) -> Vec<(&'static str, f64)> {
        self.phases.seconds_by_name()
    }
}

impl Wcsph {
    /// The elastic energy of one particle. Tension counts by the share of it that acts. The part
    /// that does not act does no work, as it grows or as it decreases.
    pub(super) fn elastic_energy_of(&self, k: usize) -> f64 {
        let (density, state) = (self.fluid.density[k], &self.options.state);
        let acting =
            if density < state.surface_density { self.work.carried.tension[k] } else { 1.0 };
        self.fluid.mass[k] * state.elastic_energy(density) * acting
    }
}
