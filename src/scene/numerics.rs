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
        /// Support radius of the kernel over the particle spacing. The preset `default` has 5 for
        /// waves at upright walls and standing waves alone, and 4 for all else.
        support_radius_ratio: f64 = 5.0, plain().within(2.0, 8.0).label("support radius/Δx");
        /// How ghost particles get their values. Trains, standing waves, beds that are not level, crests, and waves that come
        /// back to a leaning wall (see `volume_feedback`) have `normalized` by default.
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
        /// What gravity makes of a ghost's pressure. `falling` takes the water's own acceleration along walls off it. Wave
        /// trains and standing waves have that by default.
        ghost_gravity: GhostGravity = GhostGravity::InSum, weakly(plain());
        /// Tangential condition at walls.
        slip: Slip = Slip::Free, weakly(plain());
        /// Particle spacing. It is stretched slightly, so that whole columns fill the tank. It is at most a
        /// quarter of the depth, and no finer than 20,000,000 particles allow.
        particle_spacing_m: f64 = 0.01, unit("m").above_zero();
        /// c0 / √(g h). Solitary waves at upright walls over a level bed have 8 √(h / (12.5 Δx)) by
        /// default, 10.12 with 20 rows of particles: error by sound then falls as the spacing does.
        sound_speed_ratio: f64 = 8.0, weakly(plain().within(LEAST_SOUND_SPEED_RATIO, 200.0));
        /// State equation.
        state_equation: StateEquationChoice = StateEquationChoice::Linear, weakly(plain());
        /// Kernel gradients corrected to first order, in the pair of forms that conserves momentum
        /// and energy; off in both papers.
        corrected_gradients: bool = true, weakly(plain()).label("gradient correction");
        /// The correction of a full step comes from the step before. This takes it on to the present, as
        /// far as it has changed in that step. Trains, standing waves, and solitary waves at upright walls over beds no
        /// steeper than 1:2, have it by default.
        extrapolated_correction: bool = false, weakly(plain()).newer();
        /// Density diffusion.
        density_diffusion: DensityDiffusion = DensityDiffusion::Hydrostatic, weakly(plain());
        /// δ of Huang et al. 2019, Eq. 5.
        density_diffusion_coefficient: f64 = 0.1, weakly(plain().within(0.0, 1.0))
            .read_where("density_diffusion", &["renormalised", "hydrostatic", "molteni"]).label("δ");
        /// α of Huang et al. 2019, Eq. 5. By default 0.1 with 4 spacings, and 0.09 for solitary waves at
        /// upright walls over beds no steeper than 1:2. Still water before a wall that leans has 0.3 in runs of more than
        /// 30 √(h/g).
        artificial_viscosity: f64 = 0.08, plain().within(0.0, 1.0).label("viscosity");
        /// Artificial viscosity acts only on pairs that lose energy by it. Trains, standing waves, and solitary waves at
        /// upright walls over beds no steeper than 1:2, have it off by default.
        limited_viscosity: bool = true, weakly(plain()).newer();
        /// Particle shifting. Trains, standing waves, steep beds and waves that come back have `deep` by default, see `volume_feedback` and
        /// `conservative_bed`.
        shifting: Shifting = Shifting::Interior, plain();
        /// Strength A of the shifting. With 4 spacings by default 0.25.
        shifting_coefficient: f64 = 0.5,
            plain().within(0.0, 10.0).read_where("shifting", &["interior", "deep"])
                .label("shifting strength");
        /// How fast the error of the particles' volume is taken back, over c0/R. Trains and standing waves have 0.002 by
        /// default.
        /// So do steep shores, which are beds steeper than 1:2 that come out of the still water, and such beds that end less than
        /// one and a half rows under it. In runs of more than
        /// 70 √(h/g) shores from 1:5 on have it, and in runs of more than 200 √(h/g) all. So do waves that come back:
        /// a solitary wave is at its wall again, and the run lasts more than 70 √(h/g) and is without `stop_when_settled`.
        /// It wants gravity and corrected gradients. With `isph` c0 is 8 √(g h) here, and dam breaks alone have it by
        /// default, 0.006.
        volume_feedback: f64 = 0.0, plain().within(0.0, 0.02).newer();
        /// The bed gives back to the water what work its pressure does, so no energy is made or lost there. Beds that
        /// are steeper than 1:2 somewhere under still water have it by default, and in runs of more than 30 √(h/g) those
        /// from 1:5 on. Stretches that come out of the water do not count for that. Shores have it for trains, and those
        /// no steeper than 1:2 in runs of more than 200 √(h/g). A level bed does not read it.
        conservative_bed: bool = false, weakly(plain()).newer();
        /// A wall that ends in a crest gives back what work its pressure does while water is at the crest, and what is
        /// behind it does so all the time. Walls with a crest have it by default. Others do not read it.
        conservative_crest: bool = false, weakly(plain()).newer();
        /// How long the water is let come to rest before the clock starts, slowed down over a sixth of that time. Beds that
        /// come out of the still water have 40 √(h/g) by default. So has still water before a wall that leans, in runs of
        /// more than 30 √(h/g). It is for seawalls.
        relaxation_time_s: f64 = 0.0, weakly(unit("s").within(0.0, 1e4)).newer();
        /// Water near the surface gives up what it presses by more than 5 ρgh, as the surface lets go of
        /// sound. Solitary waves above H/h = 0.7 at upright walls over beds no steeper than 1:2 have it by
        /// default, and dam breaks of more than 8 √(H/g) or 4 L/√(gH). It wants gravity and corrected gradients.
        surface_relief: bool = false, weakly(plain()).newer();
        /// c0 Δt / Δx. By default 0.6 in dam breaks, where water falls behind a wall, and where a wave may run up to a
        /// wall that stands dry, up to 2 H over the still water. Boxes that water fills have 0.9. So have trains, and
        /// runs of more than 200 √(h/g), before shores no steeper than 1:2.
        courant_number: f64 = 1.8, weakly(plain().within(1e-3, 2.5)).label("c0 Δt/Δx");
        /// γ: pressures are taken γ Δt ahead of the densities, which damps sound.
        bulk_damping: f64 = 0.1, weakly(plain().within(0.0, 1.0));
        /// Steps per full step: the others follow the sound alone and hold the pairs' geometry. In a
        /// dam break, and in a box that water fills, 1 by default.
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
