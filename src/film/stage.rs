//! The surroundings of the water, and the part of the world that a film shows.

use serde::Serialize;

use super::take::Take;
use crate::boundary::Profile;
use crate::scene::{CaseConfig, Scene, SeawallScene, WallLook, Walls};

/// The wall at the end of the tank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum WallKind {
    /// There are no walls at all.
    None,
    /// It is fixed.
    Fixed,
    /// It has a spring behind it.
    Spring,
    /// It slides.
    Caisson,
    /// It is fixed, and ends in a crest that is drawn with the bed.
    Crest,
}

impl WallKind {
    fn of(scene: &SeawallScene) -> WallKind {
        match scene.wall.look() {
            WallLook::Slab if scene.crest.is_some() => WallKind::Crest,
            WallLook::Slab => WallKind::Fixed,
            WallLook::Sprung => WallKind::Spring,
            WallLook::Block => WallKind::Caisson,
        }
    }
}

/// A rectangle of the world, metres.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct View {
    pub x0: f64,
    pub x1: f64,
    pub y0: f64,
    pub y1: f64,
}

/// The part of the tank that follows the wall, metres.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Near {
    /// From its left side to the wall.
    pub x: f64,
    /// Its width.
    pub width: f64,
}

/// Walls and views, lengths in metres.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Stage {
    pub depth: f64,
    pub length: f64,
    pub spacing: f64,
    pub wall: WallKind,
    /// Angle of the wall from the bed, degrees.
    pub angle: f64,
    /// The bed if it is not level, and a wall with a crest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bed: Option<Profile>,
    /// Height of the walls in the drawing.
    pub tall: f64,
    /// Height of a closed box; none if there is air.
    pub lid: Option<f64>,
    /// Fixed end of the spring.
    pub post: f64,
    pub whole: View,
    /// None if all of the world is near.
    pub near: Option<Near>,
}

/// Height of a wall's crest over the paddle's foot, metres.
fn crest_top(scene: &Scene) -> Option<f64> {
    let scene = scene.seawall()?;
    Some(scene.still_water_depth_m + scene.crest.as_ref()?.crest_freeboard_m)
}

/// Width of a wall's crest, metres.
fn crest_width(scene: &Scene) -> f64 {
    let crest = scene.seawall().and_then(|scene| scene.crest.as_ref());
    crest.map_or(0.0, |crest| crest.crest_width_m)
}

/// The line of the ground: the bed, a wall with a crest, and the ground behind it, up to an end
/// wall of this height.
fn ground(scene: &SeawallScene, tall: f64) -> Option<Profile> {
    let Some(crest) = &scene.crest else { return scene.bed.clone() };
    let length = scene.tank_length_m;
    let level = vec![[0.0, 0.0], [length, 0.0]];
    let mut points = scene.bed.as_ref().map_or(level, |bed| bed.points().to_vec());
    let (top, back) =
        (scene.still_water_depth_m + crest.crest_freeboard_m, length + crest.crest_width_m);
    points.extend([[length, top], [back, top]]);
    match &scene.floor {
        Some(floor) => {
            let (end, low) = (back + floor.floor_length_m, floor.floor_height_m);
            points.extend([[back, low], [end, low], [end, tall]]);
        }
        None => points.push([back, 0.0]),
    }
    Profile::checked(points).ok()
}

/// Length behind a wall's crest that is also drawn, and its depth, metres.
fn floor_behind(scene: &Scene) -> [f64; 2] {
    let floor = scene.seawall().and_then(|scene| scene.floor.as_ref());
    floor.map_or([0.0; 2], |floor| [floor.floor_length_m, floor.floor_height_m.min(0.0)])
}

impl Stage {
    /// The stage of a case with the water in these instants.
    pub fn of(config: &CaseConfig, takes: &[Take]) -> Stage {
        let (scene, frame) = (&config.scene, config.scene.frame());
        let (depth, length) = (frame.depth, frame.length);
        let spacing = config.numerics.particle_spacing_m;
        let (wall, angle) = match scene {
            _ if scene.walls() == Walls::None => (WallKind::None, 90.0),
            Scene::Seawall(scene) => (WallKind::of(scene), scene.wall_angle_deg),
            Scene::Hydrostatic(scene) => (WallKind::Fixed, scene.wall_angle_deg),
            _ => (WallKind::Fixed, 90.0),
        };
        let points = || takes.iter().flat_map(|take| &take.points);
        let extreme = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points().map(|point| f64::from(point[axis])).fold(start, pick)
        };
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        let margin = 0.15 * depth;
        if wall == WallKind::None {
            let whole = View {
                x0: extreme(0, f64::min, high) - margin,
                x1: extreme(0, f64::max, low) + margin,
                y0: extreme(1, f64::min, high) - margin,
                y1: extreme(1, f64::max, low) + margin,
            };
            let (tall, lid, post, near) = (0.0, None, 0.0, None);
            let bed = None;
            return Stage {
                depth,
                length,
                spacing,
                wall,
                angle,
                bed,
                tall,
                lid,
                post,
                whole,
                near,
            };
        }
        let lid = (scene.walls() == Walls::Closed).then_some(length);
        let top = extreme(1, f64::max, depth).min(4.0 * depth);
        let crown = crest_top(scene).unwrap_or(0.0);
        let tall = lid.unwrap_or(top.max(1.3 * depth).max(crown) + 0.5 * margin);
        let farthest = takes.iter().map(|take| take.walls[1]).fold(0.0, f64::max);
        let left = takes.iter().map(|take| take.walls[0]).fold(0.0, f64::min);
        let post = length + farthest + 0.7 * depth;
        let lean = (angle - 90.0).to_radians().tan() * tall;
        let [floor_length, lowest] = floor_behind(scene);
        let behind = match wall {
            WallKind::Spring => post + 0.1 * depth,
            WallKind::Caisson => length + farthest + 0.9 * depth,
            WallKind::Crest if floor_length > 0.0 => {
                length + crest_width(scene) + floor_length + margin
            }
            WallKind::Crest => length + crest_width(scene) + 0.6 * depth,
            _ => length + lean.max(0.0) + margin,
        };
        let (x0, y0) = (left - margin, lowest - margin);
        let whole = View { x0, x1: behind, y0, y1: tall + 0.5 * margin };
        let near = scene.seawall().is_some().then(|| {
            let beyond = behind - length - farthest;
            Near { x: 2.6 * depth, width: 2.6 * depth + beyond }
        });
        let bed = scene.seawall().and_then(|scene| ground(scene, tall));
        Stage { depth, length, spacing, wall, angle, bed, tall, lid, post, whole, near }
    }

    /// Height of the bed, metres.
    pub fn bed_at(&self, x: f64) -> f64 {
        self.bed.as_ref().map_or(0.0, |bed| bed.height(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: a wall with a high crest ran out of its picture at the top.
    #[test]
    fn a_high_crest_is_in_the_picture() {
        let crest = "behind = \"outflow\"\ncrest_freeboard_m = 0.3\ncrest_width_m = 0.1";
        let config = CaseConfig::of(crest, "particle_spacing_m = 0.02");
        let take = Take { time_s: 0.0, walls: [0.0; 2], points: vec![[1.0, 0.19, 0.0]] };
        let whole = Stage::of(&config, &[take]).whole;
        assert!(whole.y1 > 0.5, "the crest is at 0.5 m, the picture ends at {}", whole.y1);
    }
}
