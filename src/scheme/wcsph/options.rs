//! Physics decisions of the scheme, resolved once per run.

use serde::{Deserialize, Serialize};

use super::Precision;
use super::correction::first_row_share;
use crate::kernel::KernelChoice;
use crate::pairs::Double;
use crate::scheme::StateEquation;
use crate::theory::central_field::CentralField;
use crate::water::{SHIFT_DEEP, SHIFT_INTERIOR, StateEquationChoice};

/// Density diffusion (the δ term).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DensityDiffusion {
    /// With the renormalised density gradient, Huang et al. 2019, Eqs. 5-6.
    Renormalised,
    /// Molteni's form with the hydrostatic part subtracted: as quiet at rest, and cheaper.
    Hydrostatic,
    /// Molteni's plain form: drifts at rest.
    Molteni,
    /// Standard weakly compressible SPH.
    None,
}

/// Particle shifting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shifting {
    /// In the interior, fading out towards the free surface.
    Interior,
    /// The same, but only where the surface is out of reach: for waves that go on for long.
    Deep,
    /// Off.
    None,
}

impl Shifting {
    /// Completenesses of the support between which it fades in.
    pub fn fades_in(self) -> Option<[f64; 2]> {
        match self {
            Shifting::Interior => Some(SHIFT_INTERIOR),
            Shifting::Deep => Some(SHIFT_DEEP),
            Shifting::None => None,
        }
    }
}

/// Everything the scheme needs to know besides the particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WcsphOptions {
    /// Smoothing kernel.
    pub kernel: KernelChoice,
    /// Support radius R, metres.
    pub support_radius: f64,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// State equation.
    pub state: StateEquation,
    /// ρ0, kg/m³.
    pub density: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Depth of still water, metres.
    pub still_depth: f64,
    /// Kernel gradients corrected to first order.
    pub corrected_gradients: bool,
    /// The correction of a step before, extrapolated to the present: L + (L - L_before).
    pub extrapolated_correction: bool,
    /// Density diffusion.
    pub density_diffusion: DensityDiffusion,
    /// δ.
    pub diffusion_coefficient: f64,
    /// α.
    pub artificial_viscosity: f64,
    /// Whether viscosity acts only on pairs that lose energy by it.
    pub limited_viscosity: bool,
    /// Shifting.
    pub shifting: Shifting,
    /// A, see [`super::Wcsph::finish`].
    pub shifting_coefficient: f64,
    /// How fast densities correct the error of the volume, over c0/R: see `volume.rs`.
    pub volume_feedback: f64,
    /// The bed gives its work on the water back to it.
    pub conservative_bed: bool,
    /// So does a wall that ends in a crest, with the ground behind it.
    pub conservative_crest: bool,
    /// Whether water near the surface gives up pressure that is higher than it can have.
    pub surface_relief: bool,
    /// γ: the time by which pressures are ahead of densities, in time steps.
    pub bulk_damping: f64,
    /// Steps per full step, at least 1.
    pub acoustic_substeps: u32,
    /// Precision of the pair terms.
    pub precision: Precision,
    /// ν, m²/s: physical viscosity, besides the artificial one; 0 if there is none.
    pub kinematic_viscosity: f64,
    /// A force towards a centre.
    pub field: Option<CentralField>,
}

/// Height above the bed to which a solitary wave can throw water up a wall, over the depth: 1 + 4
/// H/h. H/h = 1 is taken, which no solitary wave has.
const HIGHEST_FALL: f64 = 5.0;

impl WcsphOptions {
    /// h of the terms α h c0 and δ h c0: R/2 for Wendland C2, R/3 for the Gaussian.
    pub fn smoothing_length(&self) -> f64 {
        self.kernel.smoothing_length_ratio() * self.support_radius
    }

    /// The largest density that water near the surface can keep, kg/m³; infinite without a limit.
    ///
    /// In steady flow the largest pressure is that at stagnation points. Here the head is that of
    /// the highest fall, [`HIGHEST_FALL`]. A higher pressure is sound. The surface relieves it
    /// within the time in which sound crosses the support.
    pub(super) fn most_at_surface(&self) -> f64 {
        if !self.surface_relief {
            return f64::INFINITY;
        }
        self.state.density(self.density * self.gravity * HIGHEST_FALL * self.still_depth)
    }

    /// The first row's share of the gradient's correction, see [`first_row_share`].
    pub(super) fn first_row_share(&self) -> f64 {
        first_row_share(2.0 * self.smoothing_length() / self.spacing)
    }

    /// dρ over that of the field that density diffusion smooths, where it is not near 1: with Tait's
    /// equation water under pressure is stiffer, (ρ_s/ρ)⁵.
    #[inline(always)]
    pub(super) fn softer<D: Double>(&self, density: D) -> Option<D> {
        let hydrostatic = self.density_diffusion == DensityDiffusion::Hydrostatic;
        (hydrostatic && self.state.choice == StateEquationChoice::Tait).then(|| {
            let ratio = D::splat(self.state.surface_density).div(density);
            ratio * ratio * ratio * ratio * ratio
        })
    }

    /// Minus ∂ρ/∂y of still water at the surface, on which density diffusion does not act, kg/m⁴.
    pub(super) fn hydrostatic_slope(&self) -> f64 {
        match self.density_diffusion {
            DensityDiffusion::Hydrostatic => {
                let c = self.state.sound_speed;
                self.state.surface_density * self.gravity / (c * c)
            }
            _ => 0.0,
        }
    }
}
