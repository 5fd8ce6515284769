//! Corrects the error of the particles' volume.
//!
//! Each step removes the corrected divergence, which is not the rate of change of any property of
//! the particles. So after splashes particles are too far apart. Columns of 10 to 40 rows that had
//! fallen stood 4 to 11 % too high in the end, at any solver's tolerance. The crowding of particles
//! is measured as in δ-SPH (`wcsph/volume.rs`), by e = ½ tr Σ F ΔΔᵀ - 1 plus its shortfall under a
//! level surface. The step aims at a divergence of e times a rate instead of zero.

use super::Isph;
use crate::water::VOLUME_DEPTHS;

impl Isph {
    /// Adds the divergence that corrects the error of the volume, 1/s, to the step's aim.
    pub(super) fn aim_at_volume(&mut self) {
        let restored = &mut self.exact.restored;
        restored.clear();
        let Some((shortfall, rate)) = &self.shortfall else { return };
        let options = &self.options;
        let weight = options.density * options.gravity;
        let [from, full] = VOLUME_DEPTHS;
        let heights = &self.near.places[1];
        let last = self.carried.pressure.iter().zip(heights).zip(&self.operators.moment);
        restored.extend(last.map(|((pressure, height), [xx, _, yy])| {
            let head = pressure / weight + options.still_level - height;
            let depth = head / options.support_radius;
            let share = ((depth - from) / (full - from)).clamp(0.0, 1.0);
            rate * share * (0.5 * (xx + yy) - 1.0 + shortfall.at(depth))
        }));
        for (aim, more) in self.exact.aim.iter_mut().zip(restored) {
            *aim += *more;
        }
    }
}
