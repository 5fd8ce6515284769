//! What the pressure takes from the energy of the water.
//!
//! Between walls that stand the pressure's work on the water is Σ V p D ū, with ū the mean of a step's old and new
//! velocity. That is none where ū has no divergence. Water that meets has one at first: what it loses as the step takes
//! that away, it loses like bodies that stay together after a hit.

use super::Isph;
use super::options::Laplacian;
use super::solve::MEMORY;

impl Isph {
    /// -Σ V p D ū over a step of `dt` seconds, J/m. A compact Laplacian does not tell what divergence it leaves:
    /// with one only the divergence that takes the volume's error back is counted.
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
        // The new velocity's divergence is what the pressure equation leaves: see `Isph::solve_exact`.
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
