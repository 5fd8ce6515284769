//! Where water takes no pressure.

use super::super::Isph;
use crate::water::Slack;

/// A support below this completeness is wholly spray.
const SPRAY: f64 = 0.15;
/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.30, SPRAY], tension: [0.5, 0.3] };
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
            let still = gravity * (options.still_level - self.points.y[i]);
            let tense = self.carried.pressure[i] + still < 0.0;
            let share = SLACK.share(completeness, tense).clamp(0.0, SOFTEST);
            let [xx, xy, yy] = self.operators.moment[i];
            let determinant = xx * yy - xy * xy;
            let kappa = if determinant > 0.0 && completeness > SPRAY {
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
