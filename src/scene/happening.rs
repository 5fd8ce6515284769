//! What happens in a scene, as far as the numerics that suit it depend on that.

use super::frame::Frame;
use super::kind::Scene;
use super::seawall::SeawallScene;
use crate::boundary::Profile;

/// H/h above which what a solitary wave throws up an upright wall comes down free of the rest, and closes cavities in
/// front of the wall.
pub const FALLS_FREE: f64 = 0.7;

/// After so many √(h/g) of stirring, water whose volume is not held has lost some hundredths of a wave's energy by it
/// (H/h = 0.3, twelve rows).
const SINKS_AFTER: f64 = 70.0;

impl Scene {
    /// Whether a crest climbs an upright wall, and strains the lattice of its water there.
    pub(super) fn has_crest_at_upright_wall(&self) -> bool {
        self.seawall().is_some_and(|s| s.wave_height_ratio > 0.0 && s.wall_angle_deg == 90.0)
    }

    /// Whether a single wave meets an upright wall over a bed that is nowhere steeper than 1:2.
    pub(super) fn has_solitary_wave_at_upright_wall(&self) -> bool {
        let steep = self.has_steep_bed() || self.has_steep_shore();
        self.has_crest_at_upright_wall() && !self.has_train() && !steep
    }

    /// Whether a run to the end time lasts until a solitary wave, thrown back by its upright wall and then by the
    /// paddle, is at the wall again, and so long that what this stirs sinks.
    pub(super) fn hits_again(&self) -> bool {
        self.has_solitary_wave_at_upright_wall()
            && self.seawall().is_some_and(|scene| {
                let Frame { length, depth, gravity, end_time, .. } = scene.frame();
                let celerity = (gravity * depth * (1.0 + scene.wave_height_ratio)).sqrt();
                let time = end_time - scene.start_s();
                time > 3.0 * length / celerity && time > SINKS_AFTER * (depth / gravity).sqrt()
            })
    }

    /// Whether its wave is so steep that what it throws up a wall falls free and closes cavities.
    pub(super) fn falls_free(&self) -> bool {
        self.seawall().is_some_and(|scene| scene.wave_height_ratio > FALLS_FREE)
    }

    /// Whether it is a tank with an upright wall and a level bed.
    pub(super) fn is_upright_over_level_bed(&self) -> bool {
        self.seawall().is_some_and(SeawallScene::is_upright_over_level_bed)
    }

    /// Whether its paddle makes waves that go on.
    pub(super) fn has_train(&self) -> bool {
        self.seawall().is_some_and(|scene| scene.wave_train.is_some())
    }

    /// Whether still water covers a stretch of its bed that is steeper than 1:2.
    pub(super) fn has_steep_bed(&self) -> bool {
        self.bed().is_some_and(|bed| bed.is_steep_under(self.frame().depth))
    }

    /// Whether a stretch of its bed that is steeper than 1:2 comes out of the still water.
    pub(super) fn has_steep_shore(&self) -> bool {
        self.bed().is_some_and(|bed| bed.is_steep_at(self.frame().depth))
    }

    /// The bed, where it is not level.
    pub(super) fn bed(&self) -> Option<&Profile> {
        self.seawall()?.uneven_bed()
    }

    /// Whether water falls on a floor or on other water, and hits it all at once.
    pub(super) fn plunges(&self) -> bool {
        match self {
            Scene::Seawall(scene) => scene.behind.keeps(),
            _ => self.plunges_on_water(),
        }
    }

    /// Whether a jet falls on water in front of it, and closes cavities.
    pub(super) fn plunges_on_water(&self) -> bool {
        matches!(self, Scene::DamBreak(scene) if scene.plunges())
    }
}
