//! Pressures of the ghosts, from those of the water around their mirror points.

use super::exchange::Exchange;
use super::gathering::{Places, Renewed};
use super::ghosts::{Ghosts, Site};
use super::image::Press;
use crate::body::BodyMotion;
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::pairs::Factors;

impl Exchange {
    /// From where the water's mean pressure holds to a ghost, metres.
    pub(super) fn lever(&self, ghosts: &Ghosts, g: usize, motion: &BodyMotion) -> [f64; 2] {
        let (means, lane) = (&self.means[g / LANES], g % LANES);
        let anchor = if self.rules.gravity_in_sum {
            [means.x[lane], means.y[lane]]
        } else {
            [ghosts.target_x[g] + motion.offset, ghosts.target_y[g]]
        };
        [ghosts.x[g] + motion.offset - anchor[0], ghosts.y[g] - anchor[1]]
    }

    /// Density of the water around a ghost's mirror point, kg/m³.
    pub(super) fn density(&self, g: usize) -> f64 {
        let rules = &self.rules;
        let mean = self.means[g / LANES].pressure[g % LANES];
        rules.surface_density + mean / (rules.sound_speed * rules.sound_speed)
    }

    /// Interpolates the pressures anew, with the weights, wetness and corrections at hand and the
    /// ghosts where they were, and puts them into the numbers that ghosts have as neighbours.
    pub fn refresh_pressures(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        pressure: &[f64],
        factors: &mut [Factors],
    ) {
        let rules = self.rules;
        let places: Places<1> = |means| [&mut means.pressure];
        self.renew(path, ([pressure], places), factors, &|renewed| {
            let Renewed { blocks, first, images, means, factors } = renewed;
            let factors = Some(factors);
            dispatch(path, Press { blocks, first, images, means, ghosts, bodies, rules, factors });
        });
    }

    /// How much of a ghost counts.
    pub(super) fn wet_share_of(&self, ghosts: &Ghosts, body: usize, g: usize) -> f64 {
        match ghosts.face[g] {
            Site::ALWAYS_WET => 1.0,
            face => self.wet_share(body, face as usize),
        }
    }
}
