//! Forces of a study in newtons: where depths differ, F* of one case is over another unit than that
//! of the next.

use rayon::prelude::*;

use super::load::Loaded;
use super::scene_file::SceneFile;
use crate::scene::Scene;

/// Keys that change the scale of F*.
const SCALING: [&str; 6] = [
    "bed",
    "still_water_depth_m",
    "column_height_m",
    "gravity_m_per_s2",
    "water_density_kg_per_m3",
    "tank_length_m",
];

/// What F* of a scene is over, N/m. The depth is that at the wall, or the still water's if the wall
/// stands dry.
pub fn scale(scene: &Scene) -> f64 {
    let frame = scene.frame();
    frame.static_force(scene.seawall().map_or(frame.depth, |scene| scene.force_depth_m()))
}

/// Whether cases of a study may have F* over different units.
pub fn differ(data: &Loaded) -> bool {
    data.keys.iter().any(|key| SCALING.contains(&key.name.as_str()))
}

/// What F* of each row is over, N/m; `None` where all have the same unit, or the files do not tell
/// it of every finished case.
pub fn scales(data: &Loaded) -> Option<Vec<f64>> {
    let file = differ(data).then(|| SceneFile::of(data)).flatten()?;
    let of = |place: usize| match file.config(data, place) {
        Some(config) => Some(scale(&config.scene)),
        None => (!data.rows[place].is_ok()).then_some(0.0),
    };
    (0..data.rows.len()).into_par_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: vortices have no gravity, and their F* is over ρU² times the side. The page told
    /// half of their force in newtons.
    #[test]
    fn a_force_without_gravity_has_a_scale_of_its_own() {
        let scene = "kind = \"taylor-green\"\nspeed_m_per_s = 0.7\nbox_side_m = 0.5";
        let unit = scale(&crate::scene::CaseConfig::of(scene, "").scene);
        assert!((unit - 1000.0 * 0.49 * 0.5).abs() < 1e-9, "{unit}");
    }
}
