//! Probes in places that water never reaches.

use crate::keys::ConfigError;
use crate::scene::probe::{Probe, ProbeKind};
use crate::scene::seawall::{SeawallScene, WallChoice};

/// Sums of decimals have smaller errors than this, metres.
const ROUNDING: f64 = 1e-9;

/// The first of each kind: one with a wrong height, and one with a wrong place along the tank.
pub(super) fn odd(scene: &SeawallScene, probes: &[Probe]) -> [Option<ConfigError>; 2] {
    [
        buried(scene, probes).or_else(|| walled_in(scene, probes)),
        outside(scene, probes).or_else(|| passed(scene, probes)),
    ]
}

/// Heights of probes are measured from the paddle's foot, also where the bed is higher.
fn buried(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let bed = scene.bed.as_ref()?;
    let (probe, height) = probes.iter().find_map(|it| Some((it, it.bed_over_it(bed)?)))?;
    let told = format!(
        "{} stands under the bed, which is {height:.4} m high there, and reads no pressure; heights count from the \
         paddle's foot",
        probe.name
    );
    Some(ConfigError::new("probe.y_m", probe.y_m?, told))
}

/// Under a crest, and under the floor behind it, there is no water.
fn walled_in(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let crest = scene.crest.as_ref().filter(|_| scene.wall == WallChoice::Fixed)?;
    let face = scene.tank_length_m;
    let back = face + crest.crest_width_m;
    let top = scene.still_water_depth_m + crest.crest_freeboard_m;
    let inside = |probe: &&Probe| {
        let Some((x, y)) = probe.x_m.zip(probe.y_m) else { return false };
        let floor = scene.floor.as_ref().is_some_and(|floor| x > back && y < floor.floor_height_m);
        probe.kind == ProbeKind::Pressure && (x > face && x < back && y < top - ROUNDING || floor)
    };
    let probe = probes.iter().find(inside)?;
    let told = format!(
        "{} stands inside the wall, which is {top:.4} m high from {face:.4} to {back:.4} m, or under the floor behind it, \
         and reads no pressure",
        probe.name
    );
    Some(ConfigError::new("probe.y_m", probe.y_m?, told))
}

/// Where a paddle has passed there is no water.
fn passed(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    probes.first()?;
    let stroke = scene.paddle()?.goes_forth();
    let (probe, x) = probes.iter().find_map(|it| Some((it, it.x_m.filter(|x| *x < stroke)?)))?;
    let told = format!(
        "{} stands where the paddle goes, up to {stroke:.3} m into the tank: once that has passed, no water is there",
        probe.name
    );
    Some(ConfigError::new("probe.x_m", x, told))
}

/// If a wall leans away, moves or lets water fall behind it, water goes farther than the wall.
/// Otherwise it does not.
fn outside(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let flies_on = scene.crest.is_some() && scene.floor.is_none();
    if scene.wall != WallChoice::Fixed || scene.wall_angle_deg > 90.0 || flies_on {
        return None;
    }
    let end = scene.tank_length_m + scene.behind_m()[0];
    let (probe, x) = probes.iter().find_map(|it| Some((it, it.x_m.filter(|x| *x > end)?)))?;
    let told = format!(
        "{} stands outside the tank, which ends at {end:.4} m: no water comes there",
        probe.name
    );
    Some(ConfigError::new("probe.x_m", x, told))
}
