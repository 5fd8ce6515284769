//! Presets: named sets of numerics.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::numerics::{IncompressibleNumerics, Numerics, Scheme};
use crate::boundary::GhostGravity;
use crate::kernel::KernelChoice;
use crate::keys::Section;
use crate::scheme::wcsph::{DensityDiffusion, Shifting};

/// Named sets of numerics that `preset` may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// What this program has found to be best.
    Default,
    /// Huang et al. 2019.
    Huang2019,
    /// Incompressible SPH.
    Isph,
}

impl Numerics {
    /// The values of a preset.
    pub fn preset(preset: Preset) -> Numerics {
        static DEFAULTS: LazyLock<Numerics> = LazyLock::new(Numerics::defaults);
        let default = DEFAULTS.clone();
        match preset {
            Preset::Default => default,
            Preset::Huang2019 => Numerics {
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
            },
            Preset::Isph => Numerics {
                scheme: Scheme::Isph,
                particle_spacing_m: 0.008,
                support_radius_ratio: 4.0,
                artificial_viscosity: 0.1,
                kinematic_viscosity_m2_per_s: Some(0.0),
                incompressible: Some(IncompressibleNumerics::defaults()),
                ..default
            },
        }
    }
}
