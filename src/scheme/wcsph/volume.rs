//! Corrects the volume that particles lose.
//!
//! The corrected divergence is not the rate of change of any property of the particles. They can
//! move round and come back with the same densities, but closer together. After some twelve
//! periods, water under waves sinks through this. The potential energy that is freed stirs it. ½ tr
//! Σ V_j (x_j - x_i) ⊗ ∇W measures crowding: it is 1 inside the water, and more where particles
//! crowd. Densities follow it slowly, and the pressure then drives the particles apart.

use super::correction::surface_share;
use super::{Wcsph, WcsphOptions, Workspace};
use crate::pairs::{Double, Fluid, Here, Summed};
use crate::water::{Shortfall, VOLUME_DEPTHS};

/// Changes densities by the error of the volume: δρ = ρ e · rate, e = ½ tr Σ - 1 + the shortfall.
///
/// The depth is taken to be p/(ρg).
struct Restore<'a> {
    mass: &'a [f64],
    work: &'a Workspace,
    options: &'a WcsphOptions,
    shortfall: &'a Shortfall,
    /// Share of the error that is corrected now.
    rate: f64,
}

/// From 0 at the first depth to 1 at the second.
#[inline(always)]
fn faded_in<D: Double>(depth: D, [from, full]: [f64; 2]) -> D {
    let inside = (depth - D::splat(from)) * D::splat(1.0 / (full - from));
    inside.max(D::splat(0.0)).min(D::splat(1.0))
}

impl Summed<&mut [f64]> for Restore<'_> {
    /// Adds up the elastic energy gained, J/m.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, densities: &mut &mut [f64]) -> D {
        let (work, options) = (self.work, self.options);
        let density = here.in_rows::<D>(densities);
        let pressure = here.of::<D>(&work.pressure);
        let depth =
            pressure.div(density) * D::splat(1.0 / (options.gravity * options.support_radius));
        // The correction is the inverse of the sum, times the share from [`surface_share`].
        let [xx, xy, yy] = here.all::<D, 3>([
            &work.next_correction_xx,
            &work.next_correction_xy,
            &work.next_correction_yy,
        ]);
        let share = surface_share(here.of::<D>(&work.completeness), options.first_row_share());
        let determinant = xx.mul_sub(yy, xy * xy).max(D::splat(0.1));
        let half_trace = (share * (xx + yy)).div(determinant) * D::splat(0.5);
        let [shortfall, _] =
            here.change([depth, depth], |_, [depth, _]| [self.shortfall.at(depth), 0.0]);
        let error = half_trace - D::splat(1.0) + shortfall;
        let rise = density * error * faded_in(depth, VOLUME_DEPTHS) * D::splat(self.rate);
        here.put(densities, density + rise);
        here.of::<D>(self.mass) * pressure.div(density * density) * rise
    }
}

impl Wcsph {
    /// Corrects the volume that was lost since the last full step, if that is wanted. Returns the
    /// energy that is lost.
    pub(super) fn restore_volume(&mut self) -> f64 {
        let Some(shortfall) = &self.shortfall else { return 0.0 };
        let options = &self.options;
        let n = self.fluid.padded_len();
        let Fluid { density, mass, .. } = &mut self.fluid;
        let restore = Restore {
            mass,
            work: &self.work,
            options,
            shortfall,
            rate: options.volume_feedback
                * options.state.sound_speed
                * self.scaling.inverse_radius
                * self.since_full,
        };
        -self.pairs.sum_each(&mut density[..n], &restore)
    }
}
