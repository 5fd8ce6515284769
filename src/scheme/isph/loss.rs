//! The energy that the pressure takes from the water.
//!
//! Between walls at rest the pressure's work on the water is Σ V p D ū, where ū is the mean of a
//! step's old and new velocity. It is zero if ū has no divergence. Where two bodies of water meet,
//! there is a divergence at first. The step removes it, and energy is lost as in an inelastic
//! collision.

use super::Isph;
use super::options::Laplacian;
use super::solve::MEMORY;

impl Isph {
    /// -Σ V p D ū over a step of `dt` seconds, J/m. With a compact Laplacian the divergence that
    /// stays is not known. Then only the divergence that corrects the volume's error is counted.
    pub(super) fn pressure_loss(&mut self, dt: f64) -> f64 {
        if self.options.laplacian != Laplacian::Exact {
            let restored = &self.exact.restored;
            return -dt * self.expansion(|i, _| restored.get(i).copied().unwrap_or(0.0));
        }
        let exact = &mut self.exact;
        let pressures = self.dynamic.iter().zip(&self.carried.pressure);
        exact.scaled.clear();
        exact.scaled.extend(pressures.map(|(p, old)| p - MEMORY * old));
        self.system.matrix.multiply(self.path, &exact.scaled, &mut exact.compact);
        let (exact, volume) = (&self.exact, &self.near.volume);
        let (share, density) = (self.options.compact_share, self.options.density);
        // The pressure equation gives the divergence of the new velocity: see `Isph::solve_exact`.
        -dt * self.expansion(|i, pressure| {
            let kept = exact.softness[i] * pressure + share * exact.compact[i];
            let after = exact.aim[i] - dt * kept / (density * volume[i]);
            0.5 * (exact.before[i] + after)
        })
    }

    /// Σ V p times the divergence of a particle with this pressure, W/m.
    fn expansion(&self, divergence: impl Fn(usize, f64) -> f64) -> f64 {
        let terms = self
            .whole
            .iter()
            .enumerate()
            .map(|(i, &pressure)| self.near.volume[i] * pressure * divergence(i, pressure));
        terms.sum()
    }
}
