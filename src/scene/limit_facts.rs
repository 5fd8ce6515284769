//! Facts about a case for the known limits.

use std::f64::consts::TAU;

use super::config::CaseConfig;
use super::crest::Behind;
use super::kind::Scene;
use super::numerics::{Numerics, Scheme};
use super::probe::ProbeKind;
use super::seawall::SeawallScene;
use crate::boundary::{BoundaryChoice, Profile};
use crate::scheme::isph::Laplacian;
use crate::scheme::wcsph::Shifting;
use crate::theory::hydrostatics::wall_force;

/// Whether a case has a known limit, and the warning.
pub(super) type Limit = (fn(&Facts<'_>) -> bool, &'static str);

/// Walls on springs of this many ρgh, 1e4 N/m in water of 0.2 m, hardly move under any wave.
const STIFF: f64 = 5.0;

/// Facts about a case.
pub(super) struct Facts<'a> {
    pub config: &'a CaseConfig,
    pub numerics: &'a Numerics,
    /// Whether it runs with δ-SPH.
    pub weakly: bool,
    /// H/h at a seawall, 0 for no wave.
    pub wave: f64,
    /// Rows of particles over the depth before a seawall.
    pub rows: Option<f64>,
    /// Stiffness of a seawall's spring over ρgh; infinite for a fixed wall, 0 without a wall.
    pub stiffness: f64,
    /// Angle between bed and seawall, degrees; 90 without a seawall.
    pub angle: f64,
}

/// Stiffness of a seawall's spring over ρgh, infinite for a fixed wall. A coupling below 1 makes it as much larger.
fn stiffness(scene: &SeawallScene) -> f64 {
    let (density, gravity) = (scene.water_density_kg_per_m3, scene.gravity_m_per_s2);
    let wall = scene.law(wall_force(scene.force_depth_m(), density, gravity));
    let weight = density * gravity * scene.still_water_depth_m;
    wall.restraint().map_or(f64::INFINITY, |held| held.stiffness / weight)
}

impl Facts<'_> {
    /// The facts about a case.
    pub fn of(config: &CaseConfig) -> Facts<'_> {
        let numerics = &config.numerics;
        let seawall = config.scene.seawall();
        Facts {
            config,
            numerics,
            weakly: numerics.scheme == Scheme::Wcsph,
            wave: seawall.map_or(0.0, |scene| scene.wave_height_ratio),
            rows: seawall.map(|scene| scene.still_water_depth_m / numerics.particle_spacing_m),
            stiffness: seawall.map_or(0.0, stiffness),
            angle: seawall.map_or(90.0, |scene| scene.wall_angle_deg),
        }
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.config.scene
    }

    /// Whether a seawall hardly moves.
    pub fn stands(&self) -> bool {
        self.stiffness >= STIFF
    }

    /// Whether regular waves make its particles creep closer.
    pub fn sinks(&self) -> bool {
        let numerics = self.numerics;
        self.weakly && numerics.corrected_gradients && numerics.volume_feedback == 0.0
    }

    /// Whether it is a dam break: water that breaks.
    pub fn breaks(&self) -> bool {
        self.weakly && matches!(self.scene(), Scene::DamBreak(_))
    }

    /// Whether it runs without gradient corrections and the shifting that belongs to them.
    pub fn uncorrected(&self) -> bool {
        self.weakly && !self.numerics.corrected_gradients
    }

    /// Whether it has vortices with a row of particles on the line between two of them, under a
    /// pressure that does not last.
    pub fn may_tear(&self) -> bool {
        let Scene::TaylorGreen(scene) = self.scene() else { return false };
        let rows = (scene.box_side_m / self.numerics.particle_spacing_m).round();
        let corrected = self.weakly && self.numerics.corrected_gradients;
        let long_steps = self.numerics.courant_number > 1.2;
        corrected && long_steps && rows % 2.0 == 1.0 && scene.background_pressure_ratio < 3.0
    }

    /// Whether ghosts get their values in this way.
    pub fn boundary(&self, choice: BoundaryChoice) -> bool {
        self.weakly && self.numerics.boundary == choice
    }

    /// Whether its bed rises out of the water, or ends just under it, and no correction keeps the
    /// water calm.
    pub fn stirs_at_shore(&self) -> bool {
        let spacing = self.numerics.particle_spacing_m;
        self.scene().stirs_at_shore(spacing) && self.lets_stir(self.numerics.volume_feedback > 0.0)
    }

    /// Whether still water before a leaning wall begins to turn, as not all that calms it is on.
    pub fn stirs_at_leaning_wall(&self) -> bool {
        let calmed = self.numerics.artificial_viscosity >= 0.3
            && !self.lets_stir(self.numerics.volume_feedback > 0.0);
        self.scene().stirs_at_leaning_wall() && !(self.weakly && calmed)
    }

    /// Whether its wave comes back to the wall before the run ends.
    pub fn hits_again(&self) -> bool {
        self.scene().hits_again() && !self.numerics.stop_when_settled
    }

    /// Whether its bed stirs the water, and no correction keeps it calm.
    pub fn stirs(&self) -> bool {
        self.scene().stirs_over_bed() && self.lets_stir(self.numerics.conservative_bed)
    }

    /// Without the corrections that calm water beside a steep bed: a measure of its own, and the
    /// shifting.
    fn lets_stir(&self, measure: bool) -> bool {
        let stilled = measure && self.numerics.shifting == Shifting::Deep;
        self.weakly && !stilled
    }

    /// Whether the bed is not level.
    pub fn has_bed(&self) -> bool {
        self.scene().bed().is_some()
    }

    /// Whether water may go over its wall.
    pub fn has_crest(&self) -> bool {
        self.scene().has_crested_wall()
    }

    /// Whether a gauge of level or pressure stands on a dry floor behind a wall.
    pub fn has_gauge_on_floor(&self) -> bool {
        let Some(scene) = self.scene().seawall().filter(|scene| scene.behind == Behind::Floor)
        else {
            return false;
        };
        let gauges = [ProbeKind::Level, ProbeKind::Elevation, ProbeKind::Pressure];
        self.config.probes.iter().any(|probe| {
            let behind = probe.x_m.is_some_and(|x| x > scene.tank_length_m);
            behind && gauges.contains(&probe.kind)
        })
    }

    /// Whether it has more than ten waves, one after another.
    pub fn is_long_train(&self) -> bool {
        let Some(scene) = self.scene().seawall() else { return false };
        let period = scene.wave_train.as_ref().map(|train| train.wave_period_s);
        let regular = period.is_some_and(|period| self.scene().frame().end_time > 10.0 * period);
        let recorded = scene.recorded.as_ref().map(|keys| keys.recorded_stroke.turns());
        regular || recorded.is_some_and(|turns| turns > 20)
    }

    /// Particle spacings from crest to crest of regular waves.
    pub fn spacings_to_a_wave(&self) -> Option<f64> {
        let waves = self.scene().seawall()?.regular_waves()?;
        Some(waves.length() / self.numerics.particle_spacing_m)
    }

    /// Particle spacings from crest to crest of a standing wave, and its height over its length.
    pub fn standing(&self) -> Option<[f64; 2]> {
        let Scene::StandingWave(wave) = self.scene() else { return None };
        let length = TAU / wave.wave().wavenumber;
        let height = 2.0 * wave.amplitude_ratio * wave.still_water_depth_m;
        Some([length / self.numerics.particle_spacing_m, height / length])
    }

    /// A over Ω of a drop.
    pub fn stretching(&self) -> Option<f64> {
        let Scene::OscillatingDrop(drop) = self.scene() else { return None };
        Some(drop.stretching_rate_per_s / drop.field_rate_per_s)
    }

    /// Whether a wave goes over a steep part of its bed.
    pub fn goes_over_steep_bed(&self) -> bool {
        self.wave > 0.0 && self.scene().has_steep_bed()
    }

    /// Whether a wave runs up a beach, where a thin tongue is read too low with this many rows.
    pub fn reads_thin_tongues(&self) -> bool {
        let coarse = self.rows.is_some_and(|rows| rows <= 40.0);
        let reads = self.scene().seawall().is_some_and(SeawallScene::reads_tongue_at_a_spacing);
        self.wave > 0.0 && coarse && reads
    }

    /// Whether runups are read at a thickness at which a tongue's particles lie apart.
    pub fn thins_out(&self) -> bool {
        let thickness = self.scene().seawall().and_then(|scene| scene.runup_thickness_m);
        thickness.is_some_and(|thickness| thickness < self.numerics.particle_spacing_m)
    }

    /// Whether its bed has a trench too narrow for particles.
    pub fn has_filled_trench(&self) -> bool {
        let trench = self.scene().bed().and_then(Profile::narrowest_trench);
        trench.is_some_and(|breadth| breadth < 0.99 * self.numerics.particle_spacing_m)
    }

    /// Whether a steep face ends just under the still water, or within a support radius above it.
    pub fn ends_low(&self) -> bool {
        let (depth, spacing) = (self.scene().frame().depth, self.numerics.particle_spacing_m);
        let reach = [spacing, self.numerics.support_radius_ratio * spacing];
        let low = self.scene().bed().is_some_and(|bed| bed.ends_low(depth, reach));
        self.weakly && (low || self.scene().ends_just_under(spacing))
    }

    /// Rows of still water at a wall whose bed ends under water.
    pub fn rows_at_wall(&self) -> Option<f64> {
        let depth = self.scene().frame().depth - self.scene().bed()?.end()[1];
        (depth > 0.0).then(|| depth / self.numerics.particle_spacing_m)
    }

    /// Whether its bed falls by two rows or more within five spacings of the wall.
    pub fn falls_before_wall(&self) -> bool {
        let (spacing, bed) = (self.numerics.particle_spacing_m, self.scene().bed());
        bed.map(|bed| (bed, bed.end())).is_some_and(|(bed, [wall, foot])| {
            bed.highest_between(wall - 5.0 * spacing, wall) - foot > 1.9 * spacing
        })
    }

    /// Whether a wave is too high for the still water at its wall.
    pub fn breaks_at_wall(&self) -> bool {
        let rows = self.rows.zip(self.rows_at_wall());
        rows.is_some_and(|(rows, at_wall)| self.wave * rows > 0.75 * at_wall)
    }

    /// Whether a wave may reach a dry wall.
    pub fn hits_dry_wall(&self) -> bool {
        self.weakly && self.scene().hits_dry_wall()
    }

    /// Whether the operator for the pressure leaves divergence at such steps.
    pub fn leaves_divergence(&self) -> bool {
        let leaves = self.numerics.incompressible().laplacian != Laplacian::Exact;
        !self.weakly && leaves && self.scene().frame().gravity_number(self.numerics) > 0.035
    }
}
