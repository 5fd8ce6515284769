//! Presets, and the numerics of a scene by its file.

use std::cell::RefCell;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::contract::Walls;
use super::frame::Frame;
use super::kind::Scene;
use super::numerics::{IncompressibleNumerics, LEAST_SOUND_SPEED_RATIO, Numerics, Scheme};
use crate::boundary::{BoundaryChoice, GhostGravity};
use crate::kernel::KernelChoice;
use crate::keys::{ConfigError, Section, Shared, check_conditions, number, section};
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

section! {
    /// What `[numerics]` has besides numerics.
    pub(super) struct Base in "numerics" {
        /// The values that hold where no key gives another. With `scheme = "isph"` the preset
        /// `default` is `isph`.
        preset: Preset = Preset::Default, plain();
    }
}

/// Rows of particles over the depth at which the sound speed is [`RATIO`] times √(g h).
const ROWS: f64 = 12.5;
const RATIO: f64 = 8.0;

/// Time for still water to come to rest before a shore, in √(h/g).
const RELAXES_OVER: f64 = 40.0;

/// c0/√(g h) for which the error by sound, proportional to 1/c0², falls like the spacing; to two
/// decimals.
pub(super) fn sound_speed_ratio(depth: f64, particle_spacing: f64) -> f64 {
    let ratio = RATIO * (depth / (ROWS * particle_spacing)).sqrt();
    if ratio.is_finite() {
        ((100.0 * ratio).round() / 100.0).max(LEAST_SOUND_SPEED_RATIO)
    } else {
        RATIO
    }
}

/// Numerics that were already read.
struct Known {
    table: Table,
    base: Numerics,
    numerics: Shared<Numerics>,
}

thread_local! {
    /// The last ones on this thread. Cases of a study mostly share them, and they are most of a
    /// case.
    static LAST: RefCell<Option<Known>> = const { RefCell::new(None) };
}

/// Whether a table has -0, which equals 0 and is written differently.
fn has_minus_zero(table: &Table) -> bool {
    table.values().filter_map(Value::as_float).any(|value| value == 0.0 && value.is_sign_negative())
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

    /// Reads the `[numerics]` table of a scene. It must already be known that all its keys exist.
    ///
    /// # Errors
    /// The first value that does not fit.
    pub(super) fn of_scene(scene: &Scene, table: &Table) -> Result<Shared<Numerics>, ConfigError> {
        let mut preset = Base::read(table, None)?.preset;
        let own = preset == Preset::Default;
        let scheme = table.get("scheme").and_then(Value::as_str);
        if own && scheme == Some("isph") {
            preset = Preset::Isph;
        }
        if preset == Preset::Isph && scheme == Some("wcsph") {
            let allowed = "preset = \"isph\" is of scheme = \"isph\"";
            return Err(ConfigError::new("numerics.scheme", "\"wcsph\"", allowed));
        }
        let mut base = Numerics::preset(preset);
        if matches!(scene, Scene::DamBreak(_)) || scene.walls() == Walls::Closed {
            // If a front hits a wall, there is no time in which pairs could hold their geometry. In
            // a full box no surface lets sound escape, and full steps would feed resonances.
            base.acoustic_substeps = 1;
        }
        let timed = table.get("stop_when_settled").and_then(Value::as_bool) != Some(true);
        match preset {
            Preset::Default => {
                let spacing = table.get("particle_spacing_m").and_then(number);
                base.suit(scene, spacing.unwrap_or(base.particle_spacing_m), timed);
            }
            // After a splash the particles of water are too far apart.
            Preset::Isph if matches!(scene, Scene::DamBreak(_)) => base.volume_feedback = 0.006,
            Preset::Isph | Preset::Huang2019 => {}
        }
        LAST.with_borrow_mut(|last| match last {
            Some(known)
                if known.base == base && known.table == *table && !has_minus_zero(table) =>
            {
                Ok(known.numerics.clone())
            }
            _ => {
                let numerics = Numerics::read(table, Some(&base))?;
                check_conditions(table, &numerics)?;
                let numerics = Shared::from(numerics);
                // -0 equals 0, but has another text.
                *last = (!has_minus_zero(table)).then(|| Known {
                    table: table.clone(),
                    base,
                    numerics: numerics.clone(),
                });
                Ok(numerics)
            }
        })
    }

    /// Applies the settings of the preset `default` to a scene of this kind. The particle spacing
    /// is in metres. `timed` is whether the run can only end at its end time.
    fn suit(&mut self, scene: &Scene, particle_spacing: f64, timed: bool) {
        if scene.hits_at_once() {
            // Long steps add energy to water that is hit all at once.
            self.courant_number = 0.6;
        } else if scene.stirs_at_gentle_shore() || scene.walls() == Walls::Closed {
            // Long steps also add energy to tongues, and to water that tears.
            self.courant_number = 0.9;
        }
        if !scene.has_crest_at_upright_wall() {
            // A wide support helps where a crest strains a lattice. For thin sheets and wedges it
            // is worse, and water at rest starts to creep after some ten seconds.
            self.support_radius_ratio = 4.0;
            self.artificial_viscosity = 0.1;
            self.shifting_coefficient = 0.25;
        }
        let solitary = scene.has_solitary_wave_at_upright_wall();
        if solitary {
            self.artificial_viscosity = 0.09;
        }
        if (solitary && scene.falls_free()) || scene.plunges_on_water() {
            // Single particles beside a cavity would keep it open.
            self.surface_relief = true;
        }
        if solitary && scene.is_upright_over_level_bed() {
            self.sound_speed_ratio = sound_speed_ratio(scene.frame().depth, particle_spacing);
        }
        if solitary || scene.has_waves_that_go_on() {
            // On the way to the wall small gains and losses of energy add up.
            self.extrapolated_correction = true;
            self.limited_viscosity = false;
        }
        let again = timed && scene.hits_again();
        let leans = scene.seawall().is_some_and(|tank| tank.wall_angle_deg != 90.0);
        let uneven = scene.bed().is_some() || scene.has_crested_wall();
        if scene.has_waves_that_go_on() || uneven || (again && leans) {
            // Water creeps along slopes, and along walls that regular waves keep meeting. Under
            // trains before a crest, the forces on face and ghosts differ by up to 3.5 % at ten
            // rows.
            self.boundary = BoundaryChoice::Normalized;
        }
        if scene.has_waves_that_go_on() {
            // Ghosts that take all water to be at rest remove energy of waves at the wall.
            self.ghost_gravity = GhostGravity::Falling;
        }
        self.conservative_crest = scene.has_crested_wall();
        if scene.has_waves_that_go_on() || scene.stirs_at_shore(particle_spacing) || again {
            // Its volume needs correction where stirred water has the time to sink.
            self.shifting = Shifting::Deep;
            self.volume_feedback = 0.002;
        }
        let calms = scene.stirs_at_leaning_wall();
        if calms {
            // In the corners water would begin to turn, and sink.
            self.boundary = BoundaryChoice::Normalized;
            self.artificial_viscosity = 0.3;
            self.shifting = Shifting::Deep;
            self.volume_feedback = 0.01;
        }
        if scene.has_shore() || (calms && scene.seawall().is_some()) {
            let Frame { depth, gravity, .. } = scene.frame();
            self.relaxation_time_s = RELAXES_OVER * (depth / gravity).sqrt();
        }
        if scene.stirs_over_bed() {
            // Where the bed bends down, water that moves round the bend would gain energy by
            // shifting.
            self.shifting = Shifting::Deep;
            self.conservative_bed = true;
        }
    }
}
