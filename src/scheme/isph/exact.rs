//! Data for the exact Laplacian: the divergence of the gradient that moves the water.

use super::operators::Operators;
use crate::water::Slack;

/// A particle with a support below this completeness is spray.
const SPRAY: f64 = 0.15;
/// Where the water takes no pressure.
const SLACK: Slack = Slack { spray: [0.30, SPRAY], tension: [0.5, 0.3] };
/// The largest share of its divergence that a particle may keep without a pressure against it.
const SOFTEST: f64 = 0.99;

/// Inputs and results of products with the exact Laplacian, an entry per particle.
#[derive(Debug, Clone, Default)]
pub(super) struct Exact {
    /// ∇p of every particle.
    pub slope: Vec<[f64; 2]>,
    /// C: how far a particle changes its volume instead of taking a pressure.
    pub softness: Vec<f64>,
    /// κ^(-1/2). κ scales the compact Laplacian to the size of the exact one.
    pub scale: Vec<f64>,
    pub scaled: Vec<f64>,
    pub compact: Vec<f64>,
    /// Divergence at the start of the step, 1/s.
    pub before: Vec<f64>,
    /// Divergence at mid-step that this step aims at, 1/s.
    pub aim: Vec<f64>,
    /// The part of the aim that corrects the error of the volume; empty where that is left alone.
    pub restored: Vec<f64>,
}

impl Exact {
    /// Sets the divergence at mid-step for which the velocity at the step's end is divergence-free
    /// there.
    ///
    /// Between the middles of two steps the operator D itself changes. A velocity that had the
    /// divergence t, the last step's aim, then has D u, which is `now`. Half as much change is to
    /// come until the end of this step, so the aim is t' = -½ (D u - t). With it the pressure does
    /// no work over a step, to second order. With an aim of zero it took out energy in proportion
    /// to Δt. If there was no step yet (`last` is `None`), nothing has changed, and the aim is
    /// zero.
    ///
    /// Returns |V (D u - t')|.
    pub fn aim_at(&mut self, now: &[f64], last: Option<&[f64]>, volume: &[f64]) -> f64 {
        self.before.clear();
        self.before.extend_from_slice(now);
        let aim = &mut self.aim;
        aim.clear();
        match last {
            Some(last) => aim.extend(now.iter().zip(last).map(|(now, old)| -0.5 * (now - old))),
            None => aim.resize(now.len(), 0.0),
        }
        let asked = now.iter().zip(&*aim).zip(volume);
        let square: f64 = asked.map(|((now, aim), volume)| (volume * (now - aim)).powi(2)).sum();
        square.sqrt()
    }

    /// Softens particles that do not take their full pressure. These are spray, which has too few
    /// neighbours to feel one, and water near the surface that was under tension in the last step.
    /// They keep a share s of their divergence: C = s/(1 - s) times the diagonal.
    pub fn soften(
        &mut self,
        operators: &Operators,
        tense: impl Fn(usize) -> bool,
        diagonal: &mut [f64],
    ) {
        let n = diagonal.len();
        self.softness.clear();
        self.scale.clear();
        for (i, diagonal) in diagonal.iter_mut().enumerate() {
            let completeness = operators.completeness[i];
            let share = SLACK.share(completeness, tense(i)).clamp(0.0, SOFTEST);
            let kappa = operators.kappa(i, SPRAY);
            let softness = share / (1.0 - share) * *diagonal;
            self.softness.push(softness * kappa);
            self.scale.push(1.0 / kappa.sqrt());
            *diagonal += softness;
        }
        self.slope.resize(n, [0.0; 2]);
        self.scaled.resize(n, 0.0);
        self.compact.resize(n, 0.0);
    }
}
