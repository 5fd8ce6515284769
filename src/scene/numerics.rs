//! Numerical choices of a run, every one of them a value that a scene file can set.

use serde::{Deserialize, Serialize};

use crate::boundary::{AMPLIFICATION_LIMIT, BoundaryChoice, GhostGravity, SfdiMatrix};
use crate::kernel::KernelChoice;
use crate::keys::{Rule, Section, section};
use crate::math::sparse::PreconditionerChoice;
use crate::scheme::StateEquationChoice;
use crate::scheme::isph::Laplacian;
use crate::scheme::wcsph::{DensityDiffusion, Precision, Shifting};

/// The lowest speed of sound that a file may have, over √(g h).
pub(super) const LEAST_SOUND_SPEED_RATIO: f64 = 4.0;

/// The set of equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Weakly compressible δ-SPH, Huang et al. 2019.
    Wcsph,
    /// Incompressible SPH, Liang et al. 2017.
    Isph,
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

/// A key that only δ-SPH reads.
const fn weakly(rule: Rule) -> Rule {
    rule.only("scheme", &["wcsph"])
}

/// A key that only incompressible SPH reads.
const fn incompressible(rule: Rule) -> Rule {
    rule.only("scheme", &["isph"])
}

section! {
    /// The keys of incompressible SPH.
    pub struct IncompressibleNumerics in "numerics" {
        /// Laplacian of the pressure.
        laplacian: Laplacian = Laplacian::Exact, incompressible(plain());
        /// Preconditioner of the pressure equation.
        preconditioner: PreconditionerChoice = PreconditionerChoice::Multigrid,
            incompressible(plain());
        /// Tolerance of the pressure equation's residual, relative to its right-hand side.
        solver_tolerance: f64 = 1e-2, incompressible(plain().within(1e-15, 0.1));
        /// Share of the compact Laplacian that is added to the exact one.
        compact_share: f64 = 0.05,
            incompressible(plain().within(1e-3, 1.0)).read_where("laplacian", &["exact"]);
        /// Δt / √(Δx/g).
        gravity_courant_number: f64 = 0.14,
            incompressible(plain().within(1e-4, 0.2)).label("Δt/√(Δx/g)");
        /// u Δt / Δx of the fastest particle.
        flow_courant_number: f64 = 0.2, incompressible(plain().within(1e-3, 1.0)).label("u Δt/Δx");
    }
}

section! {
    /// The `[numerics]` table, complete: presets and defaults are already filled in.
    pub struct Numerics in "numerics" {
        /// Which set of equations is stepped.
        scheme: Scheme = Scheme::Wcsph, plain();
        /// Smoothing kernel.
        kernel: KernelChoice = KernelChoice::WendlandC2, plain();
        /// Support radius of the kernel over the particle spacing.
        support_radius_ratio: f64 = 5.0, plain().within(2.0, 8.0).label("support radius/Δx");
        /// How ghost particles get their values.
        boundary: BoundaryChoice = BoundaryChoice::ImprovedShepard, weakly(plain());
        /// Exponent λ of the improved Shepard weight (Huang et al. 2019, Eq. 20).
        shepard_lambda: f64 = 2.0,
            weakly(plain().within(0.1, 32.0)).read_where("boundary", &["improved-shepard"]);
        /// Factor σ of its exponential; 0 is the formula as printed, in metres.
        shepard_sigma: f64 = 1.0,
            weakly(plain().within(0.0, 32.0)).read_where("boundary", &["improved-shepard"]);
        /// The full matrix, or the diagonal of the source.
        sfdi_matrix: SfdiMatrix = SfdiMatrix::Full, plain().read_where("boundary", &["sfdi"]);
        /// Largest Σ|w_j| of the weights that may be used, before a simpler method stands in.
        amplification_limit: f64 = AMPLIFICATION_LIMIT, plain().within(1.0, 1e6)
            .read_where("boundary", &["sfdi", "mls-linear", "mls-quadratic"]);
        /// What gravity makes of a ghost's pressure. `falling` takes the water's own acceleration along
        /// walls off it.
        ghost_gravity: GhostGravity = GhostGravity::InSum, weakly(plain());
        /// Tangential condition at walls.
        slip: Slip = Slip::Free, weakly(plain());
        /// Particle spacing. It is stretched slightly, so that whole columns fill the tank. It is at most a
        /// quarter of the depth, and no finer than 20,000,000 particles allow.
        particle_spacing_m: f64 = 0.01, unit("m").above_zero();
        /// c0 / √(g h).
        sound_speed_ratio: f64 = 8.0, weakly(plain().within(LEAST_SOUND_SPEED_RATIO, 200.0));
        /// State equation.
        state_equation: StateEquationChoice = StateEquationChoice::Linear, weakly(plain());
        /// Kernel gradients corrected to first order, in the pair of forms that conserves momentum
        /// and energy; off in both papers.
        corrected_gradients: bool = true, weakly(plain()).label("gradient correction");
        /// The correction of a full step comes from the step before. This takes it on to the present, as
        /// far as it has changed in that step.
        extrapolated_correction: bool = false, weakly(plain()).newer();
        /// Density diffusion.
        density_diffusion: DensityDiffusion = DensityDiffusion::Hydrostatic, weakly(plain());
        /// δ of Huang et al. 2019, Eq. 5.
        density_diffusion_coefficient: f64 = 0.1, weakly(plain().within(0.0, 1.0))
            .read_where("density_diffusion", &["renormalised", "hydrostatic", "molteni"]).label("δ");
        /// α of Huang et al. 2019, Eq. 5.
        artificial_viscosity: f64 = 0.08, plain().within(0.0, 1.0).label("viscosity");
        /// Artificial viscosity acts only on pairs that lose energy by it.
        limited_viscosity: bool = true, weakly(plain()).newer();
        /// Particle shifting.
        shifting: Shifting = Shifting::Interior, plain();
        /// Strength A of the shifting.
        shifting_coefficient: f64 = 0.5,
            plain().within(0.0, 10.0).read_where("shifting", &["interior", "deep"])
                .label("shifting strength");
        /// How fast the error of the particles' volume is taken back, over c0/R. It wants gravity and corrected
        /// gradients. With `isph` c0 is 8 √(g h) here.
        volume_feedback: f64 = 0.0, plain().within(0.0, 0.02).newer();
        /// The bed gives back to the water what work its pressure does, so no energy is made or lost there. A level bed
        /// does not read it.
        conservative_bed: bool = false, weakly(plain()).newer();
        /// A wall that ends in a crest gives back what work its pressure does while water is at the crest, and what is
        /// behind it does so all the time. Other walls do not read it.
        conservative_crest: bool = false, weakly(plain()).newer();
        /// How long the water is let come to rest before the clock starts, slowed down over a sixth of that time. It is for
        /// seawalls.
        relaxation_time_s: f64 = 0.0, weakly(unit("s").within(0.0, 1e4)).newer();
        /// Water near the surface gives up what it presses by more than 5 ρgh, as the surface lets go of sound. It wants
        /// gravity and corrected gradients.
        surface_relief: bool = false, weakly(plain()).newer();
        /// c0 Δt / Δx.
        courant_number: f64 = 1.8, weakly(plain().within(1e-3, 2.5)).label("c0 Δt/Δx");
        /// γ: pressures are taken γ Δt ahead of the densities, which damps sound.
        bulk_damping: f64 = 0.1, weakly(plain().within(0.0, 1.0));
        /// Steps per full step: the others follow the sound alone and hold the pairs' geometry.
        acoustic_substeps: u32 = 3, weakly(plain().within(1.0, 8.0)).label("steps per full step");
        /// Upper bound on the time step.
        time_step_s: Option<f64> = None, unit("s").above_zero().label("time step bound");
        /// Further attempts, each with half the time step, where a run becomes unstable.
        retries: u32 = 0, plain().within(0.0, 6.0).newer();
        /// End a run once no reported maximum is likely to be passed any more; of waves at vertical
        /// seawalls. Such a run is short: it has none of the defaults of waves that come back.
        stop_when_settled: bool = false, plain().newer().label("stops when settled");
        /// Kinematic viscosity ν, of either scheme.
        kinematic_viscosity_m2_per_s: Option<f64> = None, unit("m²/s").within(0.0, 1.0).label("ν");
        /// Precision of the pair terms of δ-SPH's full steps.
        precision: Precision = Precision::F64, weakly(plain());
        /// Coarser companions of a case, from which its error bars come. They change neither the case's
        /// results nor its identity.
        error_bars: ErrorBars = ErrorBars::None, plain();
    }
    with {
        /// What incompressible SPH reads besides.
        incompressible: IncompressibleNumerics where scheme == Scheme::Isph;
    }
}

impl Numerics {
    /// The keys of incompressible SPH; its defaults for another scheme.
    pub(super) fn incompressible(&self) -> IncompressibleNumerics {
        self.incompressible.clone().unwrap_or_else(IncompressibleNumerics::defaults)
    }
}
