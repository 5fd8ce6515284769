//! Forces of a study in newtons: where depths differ, F* of one case is over another unit than that
//! of the next.

use rayon::prelude::*;

use super::load::Loaded;

/// Keys that change the scale of F*.
const SCALING: [&str; 6] = [
    "bed",
    "still_water_depth_m",
    "column_height_m",
    "gravity_m_per_s2",
    "water_density_kg_per_m3",
    "tank_length_m",
];

/// Whether a swept key changes what starred numbers are over.
pub fn rescales(key: &str) -> bool {
    SCALING.contains(&key)
}

/// Whether cases of a study may have F* over different units.
pub fn differ(data: &Loaded) -> bool {
    data.keys.iter().any(|key| rescales(&key.name))
}

/// What F* of each row is over, N/m; `None` where all have the same unit, or the files do not tell
/// it of every finished case.
pub fn scales(data: &Loaded) -> Option<Vec<f64>> {
    let of = |place: usize| match data.case(place) {
        Some(case) => Some(case.scene.force_unit_n_per_m()),
        None => (!data.rows[place].is_ok()).then_some(0.0),
    };
    differ(data).then(|| (0..data.rows.len()).into_par_iter().map(of).collect()).flatten()
}
