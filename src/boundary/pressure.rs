//! Pressures of the ghosts, from those of the water around their mirror points.

use super::exchange::Exchange;
use super::ghosts::{Ghosts, Site};
use super::sums::GatherPressure;
use crate::body::BodyMotion;
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::particles::Record;

impl Exchange {
    /// A ghost's pressure, Pa, and its response to its body's acceleration, Pa/(m/s²); a body that
    /// `responds` has its acceleration left out of the first, others have no response.
    pub(super) fn pressure(
        &self,
        ghosts: &Ghosts,
        g: usize,
        wet: f64,
        motion: &BodyMotion,
        responds: bool,
    ) -> (f64, f64) {
        let rules = &self.rules;
        let (means, lane) = (&self.means[g / LANES], g % LANES);
        let mean = means.pressure[lane];
        let density = rules.surface_density + mean / (rules.sound_speed * rules.sound_speed);
        let anchor = if rules.gravity_in_sum {
            [means.x[lane], means.y[lane]]
        } else {
            [ghosts.target_x[g] + motion.offset, ghosts.target_y[g]]
        };
        let reach_x = ghosts.x[g] + motion.offset - anchor[0];
        let still = mean - density * rules.gravity * (ghosts.y[g] - anchor[1]);
        let per_acceleration = -density * reach_x;
        if wet < 1.0 {
            (still.max(0.0), 0.0)
        } else if responds {
            (still, per_acceleration)
        } else {
            (still + per_acceleration * motion.acceleration, 0.0)
        }
    }

    /// Gives the ghosts that count the water's new pressures, with the weights, wetness and corrections at
    /// hand and the ghosts where they were.
    pub fn refresh_pressures(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        responds: usize,
        pressure: &[f64],
        ghost_records: &mut [Record],
    ) {
        let Exchange { team, parts, scale, means, .. } = self;
        let (scale, blocks) = (&scale[..], ghosts.len() / LANES);
        team.share(parts, &mut means[..], &|part, means| {
            dispatch(path, GatherPressure { part, scale, means, blocks, pressure });
        });
        for &g in self.counting() {
            let g = g as usize;
            let number = ghosts.target_body[g / LANES] as usize;
            let wet = self.wet_share_of(ghosts, number, g);
            let motion = &bodies[number];
            let (pressure, _) = self.pressure(ghosts, g, wet, motion, number == responds);
            press(&mut ghost_records[g].0, pressure, self.correction[g]);
        }
    }

    /// How much of a ghost counts.
    pub(super) fn wet_share_of(&self, ghosts: &Ghosts, body: usize, g: usize) -> f64 {
        match ghosts.face[g] {
            Site::ALWAYS_WET => 1.0,
            face => self.wet_share(body, face as usize),
        }
    }
}

/// Pressure times correction, into a ghost's record.
pub(super) fn press(record: &mut [f64; 8], pressure: f64, correction: [f64; 3]) {
    record[Record::PRESSURE] = pressure * correction[0];
    record[Record::PRESSURE_XY] = pressure * correction[1];
    record[Record::PRESSURE_YY] = pressure * correction[2];
}
