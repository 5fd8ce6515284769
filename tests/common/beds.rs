//! Cases over a bed, computed through the library.

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case};
use toml::Table;

const NUMERICS: &str = "boundary = \"normalized\"\n";
/// Ten rows of water of 0.2 m.
const SPACING: f64 = 0.02;

/// A case of water of ten rows over a bed, with probes.
pub fn computed(scene: &str, probes: &[Table]) -> CaseResult {
    computed_with(scene, "", probes)
}

/// The same with numerics of its own, too.
pub fn computed_with(scene: &str, numerics: &str, probes: &[Table]) -> CaseResult {
    computed_at(SPACING, scene, numerics, probes)
}

/// The same with particles so far apart, metres.
pub fn computed_at(spacing: f64, scene: &str, numerics: &str, probes: &[Table]) -> CaseResult {
    let table = |text: &str| text.parse::<Table>().unwrap();
    let numerics = table(&format!("{NUMERICS}particle_spacing_m = {spacing}\n{numerics}"));
    let mut config = CaseConfig::from_tables(&table(scene), &numerics).unwrap();
    config.probes = probes.iter().map(|table| table.clone().try_into().unwrap()).collect();
    run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap()
}

/// Surface over still water at places.
pub fn gauges(places: &[f64]) -> Vec<Table> {
    let gauge = |(number, x): (usize, &f64)| {
        format!("name = \"g{number}\"\nkind = \"elevation\"\nx_m = {x}").parse().unwrap()
    };
    places.iter().enumerate().map(gauge).collect()
}
