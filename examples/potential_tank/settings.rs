//! What may be chosen about the numerics.

use clap::Args;

/// Numerics of a run.
#[derive(Debug, Clone, Copy, PartialEq, Args)]
pub struct Settings {
    /// Nodes on the surface
    #[arg(long, default_value_t = 161)]
    pub nodes: usize,
    /// Longest time step, seconds
    #[arg(long, default_value_t = 0.00125)]
    pub step: f64,
    /// Width of the refinement at the paddle, a share of the nodes
    #[arg(long, default_value_t = 0.1)]
    pub paddle: f64,
    /// Width of the refinement at the wall, a share of the nodes
    #[arg(long, default_value_t = 0.2)]
    pub wall: f64,
    /// Spacing at the contact points, in the unit of the widths
    #[arg(long, default_value_t = 0.03)]
    pub floor: f64,
    /// Share of a sawtooth taken out of the surface at every step
    #[arg(long, default_value_t = 0.05)]
    pub smoothing: f64,
    /// Longest step times the wall's frequency
    #[arg(long, default_value_t = 0.25)]
    pub phase: f64,
    /// Longest step times the surface's fastest rate of stretching
    #[arg(long, default_value_t = 0.15)]
    pub stretch: f64,
}

impl Settings {
    /// These, then others for a surface that grows too sharp at the wall, each less exact there.
    pub fn attempts(self) -> [Settings; 3] {
        let smoother = Settings { smoothing: self.smoothing.max(0.5), ..self };
        [self, smoother, Settings { floor: self.floor.max(0.06), ..smoother }]
    }
}
