//! Where water takes no pressure.

use super::super::Isph;

/// A particle is spray from this completeness ...
const SPRAY_FROM: f64 = 0.30;
/// ... and wholly so from this.
const SPRAY_FULL: f64 = 0.15;
/// Tension is kept from this completeness ...
const TENSION_FULL: f64 = 0.5;
/// ... and wholly given up from this.
const TENSION_FROM: f64 = 0.3;
/// The largest share of a divergence that a particle may keep instead of taking a pressure.
const SOFTEST: f64 = 0.99;
/// Bound on κ.
const FULLEST: f64 = 3.0;

impl Isph {
    /// Particles that give way instead of taking a pressure: spray, which has too few neighbours to
    /// feel one, and water near the surface that was under tension in the last step. A share s of
    /// the divergence stays with them: C = s/(1 - s) times the diagonal.
    ///
    /// κ = ½ tr (Σ F ΔΔᵀ)⁻¹, Schwaiger's (2008) normalisation of a support that is cut off, takes the
    /// compact Laplacian to the size of the exact one.
    pub(in super::super) fn soften(&mut self) {
        let options = &self.options;
        let gravity = options.density * options.gravity;
        let exact = &mut self.exact;
        exact.softness.clear();
        exact.scale.clear();
        for i in 0..self.fluid.len() {
            let completeness = self.operators.completeness[i];
            let spray = (SPRAY_FROM - completeness) / (SPRAY_FROM - SPRAY_FULL);
            let still = gravity * (options.still_level - self.points.y[i]);
            let slack = if self.carried.pressure[i] + still < 0.0 {
                (TENSION_FULL - completeness) / (TENSION_FULL - TENSION_FROM)
            } else {
                0.0
            };
            let share = spray.max(slack).clamp(0.0, SOFTEST);
            let [xx, xy, yy] = self.operators.moment[i];
            let determinant = xx * yy - xy * xy;
            let kappa = if determinant > 0.0 && completeness > SPRAY_FULL {
                (0.5 * (xx + yy) / determinant).clamp(1.0 / FULLEST, FULLEST)
            } else {
                FULLEST
            };
            let softness = share / (1.0 - share) * self.matrix.diagonal[i];
            exact.softness.push(softness * kappa);
            exact.scale.push(1.0 / kappa.sqrt());
            self.matrix.diagonal[i] += softness;
        }
    }
}
