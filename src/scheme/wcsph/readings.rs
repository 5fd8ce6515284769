//! Readings of the water: loads on bodies, levels.

use super::Wcsph;
use crate::body::BodyMotion;
use crate::pairs::GHOST_MARGIN;
use crate::scheme::Load;
use crate::water::first_level;

impl Wcsph {
    /// Force on a body and its added mass, from the last [`Wcsph::prepare`].
    pub fn load(&self, body: usize) -> Load {
        let [force, added_mass] = self.work.loads[body];
        Load { force, added_mass }
    }

    /// Σ m ∫ p/ρ² dρ. Tension counts as far as it acts: what the surface does not feel does no work,
    /// as it grows or as it goes.
    pub fn elastic_energy(&self) -> f64 {
        (0..self.fluid.len()).map(|k| self.elastic_energy_of(k)).sum()
    }

    /// That of one particle.
    pub(super) fn elastic_energy_of(&self, k: usize) -> f64 {
        let (density, state) = (self.fluid.density[k], &self.options.state);
        let acting =
            if density < state.surface_density { self.work.carried.tension[k] } else { 1.0 };
        self.fluid.mass[k] * state.elastic_energy(density) * acting
    }

    /// Level of the water at an upright body, metres above the bed.
    pub fn level_at(&self, body: usize) -> f64 {
        self.exchange.level(&self.ghosts, body, self.held_bodies[body].offset)
    }

    /// Force on a body by integrating the interpolated pressure over its face, N per metre.
    pub fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        let fluid = self.work.water(&self.records[..self.fluid.padded_len()], false);
        let motion = BodyMotion { offset: self.held_bodies[body].offset, ..*motion };
        self.exchange.face_force(self.pairs.path, &self.ghosts, body, &motion, fluid)
    }

    /// Pressures at the points of a body's face, Pa, from the means at its ghosts' mirror points.
    pub fn face_pressures(&self, body: usize, motion: &BodyMotion, pressures: &mut Vec<f64>) {
        let motion = BodyMotion { offset: self.held_bodies[body].offset, ..*motion };
        self.exchange.face_pressures(&self.ghosts, body, &motion, pressures);
    }

    /// Level of the free surface at x, metres above the bed: upwards from `from`, the first
    /// height at which the kernel's coverage Σ W V falls to 1/2. Upright walls mirror the water.
    pub fn level_in_water(&mut self, x: f64, from: f64) -> f64 {
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
}
