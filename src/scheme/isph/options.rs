//! Physics decisions of the scheme, resolved once per run.

use serde::{Deserialize, Serialize};

use crate::kernel::KernelChoice;
use crate::math::sparse::PreconditionerChoice;

/// Discrete Laplacian of the pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Laplacian {
    /// The divergence of the gradient that moves the water: velocities are divergence-free to the
    /// solver's tolerance.
    Exact,
    /// 2 Σ V_j F_ij (p_j - p_i), Liang et al. 2017, Eq. 4: a symmetric matrix.
    Symmetric,
    /// The same less 2 s·∇p, after Schwaiger (2008): zero on every linear field, not symmetric.
    Schwaiger,
}

/// Everything the scheme needs to know besides the particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsphOptions {
    /// Smoothing kernel.
    pub kernel: KernelChoice,
    /// Support radius R, metres.
    pub support_radius: f64,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// ρ0, kg/m³.
    pub density: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Height at which the still water's pressure is zero, metres. The unknown, the dynamic
    /// pressure p + ρ g (y - level), refers to it.
    pub still_level: f64,
    /// Kinematic viscosity, m²/s.
    pub viscosity: f64,
    /// ε: share of the compact Laplacian that is added to the exact one.
    pub compact_share: f64,
    /// Acceleration that scales the flow, m/s²: gravity, where there is any.
    pub acceleration: f64,
    /// Speed that scales the scheme's own viscosity, m/s.
    pub viscous_speed: f64,
    /// α of the viscosity that acts on what is not linear in the velocity.
    pub artificial_viscosity: f64,
    /// Strength A of the shifting; 0 is off.
    pub shifting_coefficient: f64,
    /// Completenesses of the support between which shifting fades in.
    pub shifting_fades_in: [f64; 2],
    /// Laplacian.
    pub laplacian: Laplacian,
    /// Preconditioner of the pressure equation.
    pub preconditioner: PreconditionerChoice,
    /// Tolerance of the solve, relative to the right-hand side.
    pub solver_tolerance: f64,
    /// u Δt/Δx of the fastest particle.
    pub courant_number: f64,
    /// How fast the error of the volume is taken back, 1/s; 0 where it is left alone.
    pub volume_rate: f64,
}

impl IsphOptions {
    /// The whole pressure, Pa, where the dynamic one is this, at a height in metres.
    #[inline(always)]
    pub fn whole_pressure(&self, dynamic: f64, height: f64) -> f64 {
        dynamic + self.density * self.gravity * (self.still_level - height)
    }
}
