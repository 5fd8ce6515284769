//! Probes in places that water never reaches.

use crate::keys::ConfigError;
use crate::scene::probe::{Probe, ProbeKind, Side};
use crate::scene::seawall::SeawallScene;

/// Sums of decimals have smaller errors than this, metres.
const ROUNDING: f64 = 1e-9;
/// A paddle that goes back or forth by less than this, in depths, hardly does so.
const LEAST_WAY: f64 = 2e-3;

/// The first of each kind: one with a wrong height, and one with a wrong place along the tank.
pub(super) fn odd(scene: &SeawallScene, probes: &[Probe]) -> [Option<ConfigError>; 2] {
    [
        buried(scene, probes)
            .or_else(|| walled_in(scene, probes))
            .or_else(|| over_crest(scene, probes)),
        outside(scene, probes)
            .or_else(|| passed(scene, probes))
            .or_else(|| uncounted(scene, probes))
            .or_else(|| roofed(scene, probes)),
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
    let crest = scene.crest.as_ref()?;
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

/// A wall with a crest ends there.
fn over_crest(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let top = scene.still_water_depth_m + scene.crest.as_ref()?.crest_freeboard_m;
    let mut in_wall = probes
        .iter()
        .filter(|probe| probe.kind == ProbeKind::Pressure && probe.wall == Some(Side::Right));
    let (probe, y) = in_wall.find_map(|it| Some((it, it.y_m.filter(|y| *y > top + ROUNDING)?)))?;
    let told = format!(
        "{} stands above the wall's crest, which is {top:.4} m high, and reads no pressure on the wall",
        probe.name
    );
    Some(ConfigError::new("probe.y_m", y, told))
}

/// Where a paddle has passed there is no water. A volume is that of all water beyond.
fn passed(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let mut at_places = probes.iter().filter(|probe| probe.kind != ProbeKind::Volume).peekable();
    at_places.peek()?;
    let stroke = scene.paddle()?.goes_forth();
    if stroke < LEAST_WAY * scene.still_water_depth_m {
        return None;
    }
    let (probe, x) = at_places.find_map(|it| Some((it, it.x_m.filter(|x| *x < stroke)?)))?;
    let told = format!(
        "{} stands where the paddle goes, up to {stroke:.3} m into the tank: once that has passed, no water is there",
        probe.name
    );
    Some(ConfigError::new("probe.x_m", x, told))
}

/// A volume from x = 0 on is meant to be that of all water, of which some follows a paddle back.
fn uncounted(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let whole = |probe: &&Probe| probe.kind == ProbeKind::Volume && probe.x_m == Some(0.0);
    let probe = probes.iter().find(whole)?;
    let back = scene.paddle()?.goes_back();
    let how = if back >= LEAST_WAY * scene.still_water_depth_m {
        format!("up to {back:.3} m back from there")
    } else if scene.absorption {
        "back from there as it absorbs waves".to_owned()
    } else {
        return None;
    };
    let told = format!(
        "{} counts water from x = 0 on, and the paddle goes {how}: water behind x = 0 is not counted",
        probe.name
    );
    Some(ConfigError::new("probe.x_m", 0.0, told))
}

/// Under a wall that leans over the water a gauge reads at most the wall's face.
fn roofed(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    if scene.wall_angle_deg >= 90.0 {
        return None;
    }
    let tan = libm::tan(scene.wall_angle_deg.to_radians());
    let edge = scene.tank_length_m - scene.still_water_depth_m / tan;
    let gauges =
        probes.iter().filter(|probe| matches!(probe.kind, ProbeKind::Level | ProbeKind::Elevation));
    let mut gauges = gauges.filter_map(|it| Some((it, it.x_m?)));
    let (probe, x) = gauges.find(|(_, x)| *x > edge + ROUNDING)?;
    let told = format!(
        "{} stands under the wall, which leans over the water: from {edge:.3} m on still water reaches its face, and a gauge \
         reads the face, whatever the water does",
        probe.name
    );
    Some(ConfigError::new("probe.x_m", x, told))
}

/// If a wall leans away, moves or lets water fall behind it, water goes farther than the wall.
/// Otherwise it does not.
fn outside(scene: &SeawallScene, probes: &[Probe]) -> Option<ConfigError> {
    let flies_on = scene.crest.is_some() && scene.floor.is_none();
    if scene.wall.moves() || scene.wall_angle_deg > 90.0 || flies_on {
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
