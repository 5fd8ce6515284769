//! Properties of a scene on which its default numerics depend.

use super::contract::SceneOfKind;
use super::frame::Frame;
use super::kind::Scene;
use super::seawall::SeawallScene;
use crate::boundary::Profile;

/// Above this H/h the water that a solitary wave throws up an upright wall falls freely, and closes
/// cavities before the wall.
pub const FALLS_FREE: f64 = 0.7;

/// After this many √(h/g) of stirring, water without volume correction has lost some hundredths of
/// a wave's energy (H/h = 0.3, twelve rows).
const SINKS_AFTER: f64 = 70.0;

/// Slightly more than the rise per length of a slope of 1:2.
const STEEP: f64 = 0.46;

/// Slightly less than the rise per length of a slope of 1:5. Over such slopes water starts to
/// circulate in long runs. Still water of sixteen rows did so over slopes of 1:2 to 1:4: within a
/// minute energy came from nowhere, or the water sank by 1 to 5 %.
const STIRS: f64 = 0.19;

/// A longer run, in √(h/g), is long over slopes under water, and for still water before walls that
/// lean, which began to turn after 30 to 60. The first that ended early, with
/// sixteen rows over slopes of 1:2, did so after 43.
const STIRS_AFTER: f64 = 30.0;

/// A longer run, in √(h/g), is long before a shore no steeper than 1:2. Still water of ten rows
/// before shores of 1:6 to 1:20 was stirred until energy came from nowhere, after 820 to 1,260. The
/// waves of the flume of 1995 and of Synolakis end before that.
const STIRS_AT_GENTLE_SHORE_AFTER: f64 = 200.0;

/// Rows above the end of a steep face below which still water there needs correction. With 0.1 to
/// 1.2 rows it circulated in 26 of 57 runs of 60 s, with 1.5 to 2.4 in none of 15.
const LAST_ROW: f64 = 1.5;

impl Scene {
    /// Whether crests climb an upright wall, and strain the lattice of the water there.
    pub(super) fn has_crest_at_upright_wall(&self) -> bool {
        match self {
            Scene::Seawall(scene) => scene.wave_height_ratio > 0.0 && scene.wall_angle_deg == 90.0,
            Scene::StandingWave(_) => true,
            _ => false,
        }
    }

    /// Whether a solitary wave meets an upright wall over a bed that is nowhere steeper than 1:2.
    pub(super) fn has_solitary_wave_at_upright_wall(&self) -> bool {
        let steep = self.has_steep_bed() || self.has_steep_shore();
        self.has_crest_at_upright_wall() && !self.has_waves_that_go_on() && !steep
    }

    /// Whether a run to the end time lasts until a solitary wave is at the wall again, and so long
    /// that the stirred water sinks. The wall and then the paddle reflect the wave.
    pub(super) fn hits_again(&self) -> bool {
        self.seawall().is_some_and(|scene| {
            let Frame { length, end_time, .. } = scene.frame();
            let single = scene.wave_height_ratio > 0.0 && !self.has_train();
            let returns = end_time - scene.start_s() > 3.0 * length / scene.celerity();
            single && returns && self.lasts(SINKS_AFTER)
        })
    }

    /// Whether its wave is so steep that water thrown up a wall falls freely and closes cavities.
    pub(super) fn falls_free(&self) -> bool {
        self.seawall().is_some_and(|scene| scene.wave_height_ratio > FALLS_FREE)
    }

    /// Whether it is a tank with an upright wall and a level bed.
    pub(super) fn is_upright_over_level_bed(&self) -> bool {
        self.seawall().is_some_and(SeawallScene::is_upright_over_level_bed)
    }

    /// Whether its paddle makes one wave after another.
    fn has_train(&self) -> bool {
        self.seawall()
            .is_some_and(|scene| scene.wave_train.is_some() || scene.plays_one_wave_after_another())
    }

    /// Whether its waves meet a wall again and again: a train, a stroke that
    /// goes back and forth, or a standing wave.
    pub(super) fn has_waves_that_go_on(&self) -> bool {
        self.has_train() || matches!(self, Scene::StandingWave(_))
    }

    /// Whether water may go over its wall.
    pub(super) fn has_crested_wall(&self) -> bool {
        self.seawall().is_some_and(|scene| scene.crest.is_some())
    }

    /// Whether still water covers a part of its bed that is steeper than 1:2.
    pub(super) fn has_steep_bed(&self) -> bool {
        self.bed().is_some_and(|bed| bed.is_steep_under(self.frame().depth, STEEP))
    }

    /// Whether a part of its bed that is steeper than 1:2 rises out of the still water.
    pub(super) fn has_steep_shore(&self) -> bool {
        self.comes_out(STEEP)
    }

    /// Whether water above a slope of its bed needs correction, so that it is not stirred until the
    /// run ends.
    pub(super) fn stirs_over_bed(&self) -> bool {
        let rise = if self.lasts(STIRS_AFTER) { STIRS } else { STEEP };
        let under = self.bed().is_some_and(|bed| bed.is_steep_under(self.frame().depth, rise));
        under || self.stirs_at_gentle_shore() || (self.has_train() && self.has_steep_shore())
    }

    /// The same for water before a shore, or over a steep face that ends just under the water. The
    /// particle spacing is in metres.
    pub(super) fn stirs_at_shore(&self, particle_spacing: f64) -> bool {
        let rise = if self.lasts(SINKS_AFTER) { STIRS } else { STEEP };
        self.comes_out(rise)
            || self.ends_just_under(particle_spacing)
            || self.stirs_at_gentle_shore()
    }

    /// Whether water before a shore no steeper than 1:2 is stirred, by regular waves or in a long
    /// run. Before steeper shores a bed that gives back did not calm it.
    pub(super) fn stirs_at_gentle_shore(&self) -> bool {
        let long = self.has_train() || self.lasts(STIRS_AT_GENTLE_SHORE_AFTER);
        long && self.has_shore() && !self.has_steep_shore()
    }

    /// Whether still water stands before a wall that leans, until it would begin to turn there. A
    /// wave needs water of less viscosity.
    pub(super) fn stirs_at_leaning_wall(&self) -> bool {
        self.wall_angle_deg() != 90.0 && self.is_still() && self.lasts(STIRS_AFTER)
    }

    /// Whether nothing moves its still water: there is a wall, and nothing makes a wave.
    pub fn is_still(&self) -> bool {
        match self {
            Scene::Seawall(scene) => scene.is_still(),
            Scene::Hydrostatic(_) => true,
            _ => false,
        }
    }

    /// Angle of its right wall from the bed; 90 where no wall may lean.
    pub(super) fn wall_angle_deg(&self) -> f64 {
        match self {
            Scene::Seawall(scene) => scene.wall_angle_deg,
            Scene::Hydrostatic(scene) => scene.wall_angle_deg,
            _ => 90.0,
        }
    }

    /// Whether a part of its bed steeper than 1:2 ends so near the still water's surface that
    /// hardly a row of particles with this spacing, metres, fits above it.
    pub(super) fn ends_just_under(&self, particle_spacing: f64) -> bool {
        let (depth, near) = (self.frame().depth, LAST_ROW * particle_spacing);
        self.bed().is_some_and(|bed| bed.is_steep_just_under(depth, STEEP, near))
    }

    /// Whether its bed rises out of the still water.
    pub(super) fn has_shore(&self) -> bool {
        self.comes_out(0.0)
    }

    /// Whether a part of its bed steeper than this (its rise per length) rises out of the still
    /// water.
    pub(super) fn comes_out(&self, rise: f64) -> bool {
        self.bed().is_some_and(|bed| bed.is_steep_at(self.frame().depth, rise))
    }

    /// Whether a run to the end time takes longer than this many √(h/g).
    fn lasts(&self, times: f64) -> bool {
        let Frame { depth, gravity, end_time, .. } = self.frame();
        end_time - self.start_s() > times * (depth / gravity).sqrt()
    }

    /// The bed, where it is not level.
    pub(super) fn bed(&self) -> Option<&Profile> {
        self.seawall()?.uneven_bed()
    }

    /// Whether water hits a wall, a floor or other water all at once.
    pub(super) fn hits_at_once(&self) -> bool {
        match self {
            Scene::Seawall(scene) => scene.behind.keeps() || self.hits_dry_wall(),
            Scene::DamBreak(_) => true,
            _ => false,
        }
    }

    /// Whether a wave may reach a dry wall, up to twice the wave's height, which it hits all at
    /// once.
    pub(super) fn hits_dry_wall(&self) -> bool {
        self.seawall().zip(self.bed()).is_some_and(|(scene, bed)| {
            let depth = scene.still_water_depth_m;
            bed.ends_dry(depth, depth * (1.0 + 2.0 * scene.wave_height_ratio))
        })
    }

    /// Whether a jet falls onto water before it, and closes cavities.
    pub(super) fn plunges_on_water(&self) -> bool {
        matches!(self, Scene::DamBreak(scene) if scene.plunges())
    }
}
