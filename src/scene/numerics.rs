//! Numerical choices of a run, every one of them a value that a scene file can set.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConfigError;
use crate::boundary::{AMPLIFICATION_LIMIT, SfdiMatrix};
use crate::kernel::KernelChoice;
use crate::math::sparse::PreconditionerChoice;
use crate::scheme::StateEquationChoice;
use crate::scheme::isph::Laplacian;
use crate::scheme::wcsph::{DensityDiffusion, Precision, Shifting};

/// Which set of equations is stepped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Weakly compressible δ-SPH, Huang et al. 2019.
    Wcsph,
    /// Incompressible SPH, Liang et al. 2017.
    Isph,
}

/// How ghost particles get their values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryChoice {
    /// Improved Shepard interpolation, Huang et al. 2019, Eqs. 17-21.
    ImprovedShepard,
    /// Normalized kernel, Huang et al. 2019, Eqs. 14-16.
    Normalized,
    /// Simplified finite difference interpolation, Eqs. 10-13.
    Sfdi,
    /// Moving least squares, linear basis, Eqs. 8-9.
    MlsLinear,
    /// Moving least squares, quadratic basis.
    MlsQuadratic,
    /// Dummy particles: the normalized kernel around the ghost itself, Adami et al. 2012.
    Dummy,
}

/// Where gravity and the wall's acceleration enter a ghost's pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GhostGravity {
    /// Inside the sum, from each neighbour to the ghost: exact at rest.
    InSum,
    /// At the mirror point, as Huang et al. 2019 print it.
    AtMirror,
}

/// Tangential condition at walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Slip {
    /// The tangential velocity is continued through the wall.
    Free,
    /// The tangential velocity is reversed at the wall.
    No,
}

/// Resolution companions that yield the error bars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ErrorBars {
    /// No companions, no bars.
    None,
    /// The same case at twice the particle spacing: about an eighth more work.
    Pair,
    /// At √2 times the spacing, too: about half as much work again.
    Triple,
}

/// The `[numerics]` table, complete: presets and defaults are already filled in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Scheme.
    pub scheme: Scheme,
    /// Smoothing kernel.
    pub kernel: KernelChoice,
    /// Support radius of the kernel over the particle spacing.
    pub support_radius_ratio: f64,
    /// Boundary interpolator.
    pub boundary: BoundaryChoice,
    /// Exponent λ of the improved Shepard weight (Huang et al. 2019, Eq. 20).
    pub shepard_lambda: f64,
    /// Factor σ of its exponential; 0 is the formula as printed, in metres.
    pub shepard_sigma: f64,
    /// Matrix of `sfdi`: the full one, or the diagonal of the source.
    pub sfdi_matrix: SfdiMatrix,
    /// Largest Σ|w_j| of the weights that `sfdi` and the `mls` methods may use, before a simpler
    /// method stands in.
    pub amplification_limit: f64,
    /// Placement of the ghosts' pressure correction.
    pub ghost_gravity: GhostGravity,
    /// Tangential condition at walls.
    pub slip: Slip,
    /// Particle spacing, metres; stretched slightly so that whole columns fill the tank.
    pub particle_spacing_m: f64,
    /// c0 / √(g h).
    pub sound_speed_ratio: f64,
    /// State equation.
    pub state_equation: StateEquationChoice,
    /// Kernel gradients corrected to first order, in the pair of forms that conserves momentum
    /// and energy; off in both papers.
    pub corrected_gradients: bool,
    /// Density diffusion.
    pub density_diffusion: DensityDiffusion,
    /// δ of Huang et al. 2019, Eq. 5.
    pub density_diffusion_coefficient: f64,
    /// α of Huang et al. 2019, Eq. 5.
    pub artificial_viscosity: f64,
    /// Particle shifting.
    pub shifting: Shifting,
    /// Strength A of the shifting.
    pub shifting_coefficient: f64,
    /// c0 Δt / Δx.
    pub courant_number: f64,
    /// γ: pressures are taken γ Δt ahead of the densities, which damps sound.
    pub bulk_damping: f64,
    /// Steps per full step: the others follow the sound alone and hold the pairs' geometry.
    pub acoustic_substeps: u32,
    /// Upper bound on the time step, seconds; none by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_step_s: Option<f64>,
    /// Further attempts, each with half the time step, where a run becomes unstable.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub retries: u32,
    /// End a run once no reported maximum is likely to be passed any more.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub stop_when_settled: bool,
    /// Laplacian of the pressure; `isph` only, like the keys below down to `precision`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub laplacian: Option<Laplacian>,
    /// Preconditioner of the pressure equation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preconditioner: Option<PreconditionerChoice>,
    /// Tolerance of the pressure equation's residual, relative to its right-hand side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solver_tolerance: Option<f64>,
    /// Share of the volume error that a step's source term takes back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_relaxation: Option<f64>,
    /// Share of the last step's dynamic pressure that the next one starts from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_memory: Option<f64>,
    /// Share of the compact Laplacian that is added to the exact one, `laplacian = "exact"` only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compact_share: Option<f64>,
    /// Kinematic viscosity, m²/s, of either scheme.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinematic_viscosity_m2_per_s: Option<f64>,
    /// Δt / √(Δx/g).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_courant_number: Option<f64>,
    /// u Δt / Δx of the fastest particle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow_courant_number: Option<f64>,
    /// Precision of the pair terms.
    pub precision: Precision,
    /// Error bars; they decide no answer and are no part of a case's identity.
    pub error_bars: ErrorBars,
}

/// A case without retries keeps the identity that it had before there were any.
fn is_zero(retries: &u32) -> bool {
    *retries == 0
}

/// Δt / √(Δx/g) of incompressible SPH by default.
pub(super) const GRAVITY_COURANT_NUMBER: f64 = 0.14;
/// Share of the compact Laplacian that is added to the exact one by default.
pub(super) const COMPACT_SHARE: f64 = 0.05;

/// Keys that only δ-SPH reads.
pub(super) const WEAKLY_COMPRESSIBLE: &[&str] = &[
    "boundary",
    "shepard_lambda",
    "shepard_sigma",
    "ghost_gravity",
    "slip",
    "sound_speed_ratio",
    "state_equation",
    "corrected_gradients",
    "density_diffusion",
    "density_diffusion_coefficient",
    "courant_number",
    "bulk_damping",
    "acoustic_substeps",
    "precision",
];

/// Names that `preset` may take.
pub const PRESETS: &[&str] = &["default", "huang2019", "isph"];

impl Numerics {
    /// The values of a named preset, `None` for an unknown name.
    pub fn preset(name: &str) -> Option<Numerics> {
        let default = Numerics {
            scheme: Scheme::Wcsph,
            kernel: KernelChoice::WendlandC2,
            support_radius_ratio: 5.0,
            boundary: BoundaryChoice::ImprovedShepard,
            shepard_lambda: 2.0,
            shepard_sigma: 1.0,
            sfdi_matrix: SfdiMatrix::Full,
            amplification_limit: AMPLIFICATION_LIMIT,
            ghost_gravity: GhostGravity::InSum,
            slip: Slip::Free,
            particle_spacing_m: 0.009,
            sound_speed_ratio: 8.0,
            state_equation: StateEquationChoice::Linear,
            corrected_gradients: true,
            density_diffusion: DensityDiffusion::Hydrostatic,
            density_diffusion_coefficient: 0.1,
            artificial_viscosity: 0.08,
            shifting: Shifting::Interior,
            shifting_coefficient: 0.5,
            courant_number: 1.8,
            bulk_damping: 0.1,
            acoustic_substeps: 3,
            time_step_s: None,
            retries: 0,
            stop_when_settled: false,
            laplacian: None,
            preconditioner: None,
            solver_tolerance: None,
            volume_relaxation: None,
            pressure_memory: None,
            compact_share: None,
            kinematic_viscosity_m2_per_s: None,
            gravity_courant_number: None,
            flow_courant_number: None,
            precision: Precision::F64,
            error_bars: ErrorBars::None,
        };
        match name {
            "default" => Some(default),
            "huang2019" => Some(Numerics {
                particle_spacing_m: 0.008,
                kernel: KernelChoice::Gaussian,
                support_radius_ratio: 3.9,
                ghost_gravity: GhostGravity::AtMirror,
                corrected_gradients: false,
                density_diffusion: DensityDiffusion::Renormalised,
                artificial_viscosity: 0.02,
                shifting: Shifting::None,
                sound_speed_ratio: 10.0,
                courant_number: 0.9,
                bulk_damping: 0.0,
                acoustic_substeps: 1,
                time_step_s: Some(5e-4),
                ..default
            }),
            "isph" => Some(Numerics {
                scheme: Scheme::Isph,
                particle_spacing_m: 0.008,
                support_radius_ratio: 4.0,
                artificial_viscosity: 0.1,
                laplacian: Some(Laplacian::Exact),
                preconditioner: Some(PreconditionerChoice::Multigrid),
                solver_tolerance: Some(1e-2),
                volume_relaxation: Some(0.0),
                pressure_memory: Some(0.98),
                compact_share: Some(COMPACT_SHARE),
                kinematic_viscosity_m2_per_s: Some(0.0),
                gravity_courant_number: Some(GRAVITY_COURANT_NUMBER),
                flow_courant_number: Some(0.2),
                ..default
            }),
            _ => None,
        }
    }

    /// The keys of incompressible SPH: their ranges, and that nobody else sets those it alone reads.
    fn validate_incompressible(&self, check: &Check) -> Result<(), ConfigError> {
        let numbers = [
            ("solver_tolerance", self.solver_tolerance, 1e-15, 0.1),
            ("volume_relaxation", self.volume_relaxation, 0.0, 1.0),
            ("pressure_memory", self.pressure_memory, 0.0, 1.0),
            ("compact_share", self.compact_share, 1e-3, 1.0),
            ("kinematic_viscosity_m2_per_s", self.kinematic_viscosity_m2_per_s, 0.0, 1.0),
            ("gravity_courant_number", self.gravity_courant_number, 1e-4, 0.2),
            ("flow_courant_number", self.flow_courant_number, 1e-3, 1.0),
        ];
        for (key, value, low, high) in numbers {
            if let Some(value) = value {
                check.range(key, value, low, high)?;
            }
        }
        if self.scheme == Scheme::Isph {
            return Ok(());
        }
        let of_both = |key: &str| key == "kinematic_viscosity_m2_per_s";
        let set = numbers.iter().filter(|(key, ..)| !of_both(key));
        let set = set.clone().find(|(_, value, ..)| value.is_some()).map(|(key, ..)| *key);
        let set = set
            .or(self.laplacian.map(|_| "laplacian"))
            .or(self.preconditioner.map(|_| "preconditioner"));
        match set {
            Some(key) => Err(check.error(key, "", "belongs to scheme = \"isph\"")),
            None => Ok(()),
        }
    }

    pub(super) fn validate(&self) -> Result<(), ConfigError> {
        let check = Check::section("numerics");
        check.range("support_radius_ratio", self.support_radius_ratio, 2.0, 8.0)?;
        check.range("shepard_lambda", self.shepard_lambda, 0.1, 32.0)?;
        check.range("shepard_sigma", self.shepard_sigma, 0.0, 32.0)?;
        check.range("amplification_limit", self.amplification_limit, 1.0, 1e6)?;
        check.positive("particle_spacing_m", self.particle_spacing_m)?;
        check.range("sound_speed_ratio", self.sound_speed_ratio, 4.0, 200.0)?;
        check.range(
            "density_diffusion_coefficient",
            self.density_diffusion_coefficient,
            0.0,
            1.0,
        )?;
        check.range("artificial_viscosity", self.artificial_viscosity, 0.0, 1.0)?;
        check.range("shifting_coefficient", self.shifting_coefficient, 0.0, 10.0)?;
        check.range("courant_number", self.courant_number, 1e-3, 2.5)?;
        if self.retries > 6 {
            return Err(check.error("retries", self.retries, "must be a whole number from 0 to 6"));
        }
        check.range("bulk_damping", self.bulk_damping, 0.0, 1.0)?;
        check.range("acoustic_substeps", f64::from(self.acoustic_substeps), 1.0, 8.0)?;
        self.validate_incompressible(&check)?;
        if let Some(step) = self.time_step_s {
            check.positive("time_step_s", step)?;
        }
        Ok(())
    }
}
