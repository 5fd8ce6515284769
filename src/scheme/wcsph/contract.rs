//! δ-SPH behind the contract of all schemes.

use super::Wcsph;
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::math::team::Team;
use crate::pairs::Fluid;
use crate::scheme::{
    Dissipation, Load, Scheme, SchemeState, StateEquation, StepError, StepWalls, Taken,
};
use crate::theory::central_field::CentralField;

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

    fn elastic_energy(&self) -> f64 {
        Wcsph::elastic_energy(self)
    }

    fn field(&self) -> Option<CentralField> {
        self.options.field
    }

    fn taken(&self) -> Taken {
        self.taken
    }

    fn take_on(&mut self, team: &Team) {
        Wcsph::take_on(self, team);
    }

    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError> {
        Wcsph::prepare(self, bodies, dt);
        Ok(())
    }

    fn load(&self, body: usize) -> Load {
        Wcsph::load(self, body)
    }

    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation {
        Wcsph::finish(self, dt, walls, sample)
    }

    fn level_at(&self, body: usize) -> f64 {
        Wcsph::level_at(self, body)
    }

    fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
        Wcsph::level_in_water(self, x, from)
    }

    fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        Wcsph::face_force(self, body, motion)
    }

    fn face_pressures(&mut self, body: usize, motion: &BodyMotion, pressures: &mut Vec<f64>) {
        Wcsph::face_pressures(self, body, motion, pressures);
    }

    fn can_be_kept(&self) -> bool {
        self.at_full_step()
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
        Wcsph::pair_evaluations(self)
    }

    fn list_rebuilds(&self) -> u64 {
        self.pairs.rebuilds()
    }

    fn boundary_fallbacks(&self) -> u64 {
        Wcsph::boundary_fallbacks(self)
    }

    fn phases(&self) -> Vec<(&'static str, f64)> {
        let t = &self.timings;
        vec![
            ("neighbours", t.neighbours),
            ("ghosts", t.ghosts),
            ("momentum", t.momentum),
            ("viscosity", t.viscosity),
            ("continuity", t.continuity),
            ("shifting", t.shifting),
            ("integration", t.integration),
        ]
    }
}
