//! Known limits: what `seawall check` warns of before a run. Measured by `seawall stress` and
//! `seawall accuracy` and `scripts/boundary_comparison`; see `results/stability`, `results/accuracy` and
//! `results/boundary_comparison`.

use super::config::CaseConfig;
use super::kind::Scene;
use super::numerics::{BoundaryChoice, GhostGravity, Scheme, Slip};
use super::seawall::SeawallScene;
use super::size;
use crate::scheme::isph::Laplacian;

/// Walls this stiff, N/m per metre of width, stand as good as still under the highest waves.
const STIFF: f64 = 1e4;

/// Seconds for which still water has rested with every way of taking ghosts' values.
const LONG: f64 = 20.0;

/// Periods over which drops have followed the exact one.
const MANY_PERIODS: f64 = 10.0;

/// Rows of particles over the depth from which waves do without gradient corrections.
const FEW_ROWS: f64 = 20.0;

/// Rows of particles over the depth above which a case of incompressible water takes minutes.
const COSTLY_ROWS: f64 = 32.0;

/// Particles above which a case takes gigabytes and hours.
const MANY_PARTICLES: f64 = 1e6;

/// What is known to go wrong, or to be inaccurate, with a case; a line each, the same line for the
/// same limit.
pub fn limits(config: &CaseConfig) -> Vec<&'static str> {
    let mut found = Vec::new();
    let numerics = &config.numerics;
    if numerics.scheme == Scheme::Wcsph && numerics.courant_number > 2.0 {
        found.push(
            "courant_number above 2: energy comes from nowhere, 11 % of the paddle's work at 2.3, \
             and at 2.5 the run ends; retries = 1 would start it again with half the step",
        );
    }
    if numerics.scheme == Scheme::Wcsph {
        at_walls(config, &mut found);
    }
    if numerics.scheme == Scheme::Isph {
        incompressible(config, &mut found);
    }
    if numerics.scheme == Scheme::Wcsph && !numerics.corrected_gradients {
        found.extend(uncorrected(config));
    }
    if matches!(&config.scene, Scene::OscillatingDrop(drop) if drop.end_after_periods > MANY_PERIODS)
    {
        found.push(
            "an oscillating drop for more than 10 periods: after 30 its axes enclosed 30 % less than \
             the exact drop's with corrected_gradients, and swung 63 % too little without",
        );
    }
    if size::particles(config) > MANY_PARTICLES {
        found.push(
            "more than 1,000,000 particles: 1.4 GiB and some hours of one core upwards, both for each \
             case at once; 20,000,000 are the most that are taken",
        );
    }
    let Some(scene) = config.scene.seawall() else { return found };
    let rows = scene.still_water_depth_m / numerics.particle_spacing_m;
    if rows < 10.0 {
        found.push(
            "fewer than 10 particles over the depth: the wave loses height, forces are 1 to 3 % \
             and runups up to 20 % low",
        );
    }
    if scene.wave_height_ratio >= 0.6 && stands(scene) && numerics.scheme == Scheme::Wcsph {
        found.push(
            "H/h of 0.6 and more on a wall that hardly moves: the tip of the water is thinner than \
             a particle, and the runup is read low, by about 0.1 h at the default spacing",
        );
    }
    let stiff_and_light = scene.seawall_mass_kg_per_m.is_some_and(|mass| mass < 2.0)
        && scene.spring_stiffness_n_per_m.is_some_and(|k| k >= 1e6);
    if stiff_and_light {
        found.push(
            "a wall below 2 kg/m on a spring of 1e6 N/m and more rings: its force maximum was \
             measured 14 % above a fixed wall's",
        );
    }
    if scene.wave_height_ratio > 0.75 {
        found.push("H/h above 0.75: such a wave breaks on its way, and no reference covers it");
    }
    found
}

/// Whether the wall hardly moves.
fn stands(scene: &SeawallScene) -> bool {
    !scene.wall.moves() || scene.spring_stiffness_n_per_m.is_some_and(|k| k >= STIFF)
}

/// What is lost without gradient corrections and the shifting that goes with them.
fn uncorrected(config: &CaseConfig) -> Option<&'static str> {
    let numerics = &config.numerics;
    match &config.scene {
        Scene::TaylorGreen(_) => Some(
            "vortices without corrected_gradients and shifting decay too fast: by 14 % of their \
             speed at 20 particles across each, against 4.5 % with them",
        ),
        Scene::StandingWave(_) => {
            Some("a standing wave without corrected_gradients lost 46 % of its amplitude")
        }
        Scene::RotatingPatch(_) => Some(
            "a rotating patch without corrected_gradients and shifting lost 6 % of its kinetic \
             energy, and its particles clustered",
        ),
        Scene::Seawall(scene)
            if scene.still_water_depth_m < FEW_ROWS * numerics.particle_spacing_m =>
        {
            Some(
                "waves without corrected_gradients at fewer than 20 rows over the depth: forces on \
                 the wall were up to 20 % high, and runups 18 % low",
            )
        }
        _ => None,
    }
}

/// Limits of incompressible SPH; see `results/liang2017`.
fn incompressible(config: &CaseConfig, found: &mut Vec<&'static str>) {
    let numerics = &config.numerics;
    let limit = numerics.gravity_courant_number.is_some_and(|courant| courant > 0.035);
    if limit && matches!(numerics.laplacian, Some(Laplacian::Symmetric | Laplacian::Schwaiger)) {
        found.push(
            "laplacian = \"symmetric\" or \"schwaiger\" leaves divergence in the water and wants \
             gravity_courant_number = 0.035; \"exact\" does neither",
        );
    }
    let Some(scene) = config.scene.seawall() else { return };
    if scene.wave_height_ratio >= 0.5 && stands(scene) {
        found.push(
            "scheme = \"isph\" at H/h of 0.5 and more on a wall that hardly moves: the runup is read low, \
             by some 0.04 h at 0.5 and 0.14 h at 0.6 at the default spacing; forces hold",
        );
    }
    if scene.still_water_depth_m / numerics.particle_spacing_m > COSTLY_ROWS {
        found.push(
            "scheme = \"isph\" with more than 32 rows over the depth: a case of 25 rows takes half a \
             minute and more, one of half the spacing six times as long; scheme = \"wcsph\" is as \
             accurate in a fifth of the time",
        );
    }
}

/// Limits of how ghosts take their values.
fn at_walls(config: &CaseConfig, found: &mut Vec<&'static str>) {
    let numerics = &config.numerics;
    let breaks = matches!(config.scene, Scene::DamBreak(_));
    if numerics.boundary == BoundaryChoice::Sfdi && config.scene.seawall().is_some() {
        found.push(
            "boundary = \"sfdi\": its weights jump as another particle becomes the nearest; a wave of \
             H/h = 0.5 at a vertical wall gained 1.4 % of the paddle's work from nowhere",
        );
    }
    let end = config.scene.frame().end_time;
    if numerics.boundary == BoundaryChoice::Dummy && end > LONG {
        found.push(
            "boundary = \"dummy\" for more than 20 s: still water creeps at the walls; after 300 s ten \
             rows of it pressed 9 % too little and stood 0.08 h low",
        );
    }
    if numerics.boundary == BoundaryChoice::Normalized
        && numerics.ghost_gravity == GhostGravity::AtMirror
    {
        found.push(
            "boundary = \"normalized\" with ghost_gravity = \"at-mirror\": pressure at the bed of \
             still water was up to 3.1 % off; \"in-sum\" keeps it within 0.2 %",
        );
    }
    if breaks && numerics.slip == Slip::No {
        found.push(
            "slip = \"no\" in a dam break: the bed holds the front back as far as the kernel reaches, \
             at 30 rows it came 0.6 to 1.1 √(H/g) late",
        );
    }
    if breaks && numerics.corrected_gradients {
        found.push(
            "corrected_gradients in a dam break: thin water bears no pressure, a gauge feels the jet \
             0.1 to 0.2 √(H/g) later than with preset = \"huang2019\"",
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_limit_is_told_and_the_default_is_clear_of_them() {
        let count = |scene: &str, numerics: &str| {
            let config =
                CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap());
            limits(&config.unwrap()).len()
        };
        assert_eq!(count("", ""), 0);
        assert_eq!(count("", "courant_number = 2.3"), 1);
        assert_eq!(count("", "particle_spacing_m = 0.0005"), 1);
        assert_eq!(count("", "boundary = \"sfdi\""), 1);
        assert_eq!(count("", "boundary = \"normalized\""), 0);
        assert_eq!(count("", "boundary = \"normalized\"\nghost_gravity = \"at-mirror\""), 1);
        assert_eq!(count("kind = \"dam-break\"", ""), 1);
        assert_eq!(count("kind = \"dam-break\"", "preset = \"huang2019\""), 0);
        assert_eq!(count("kind = \"dam-break\"", "boundary = \"mls-quadratic\""), 1);
        assert_eq!(count("kind = \"dam-break\"", "preset = \"huang2019\"\nslip = \"no\""), 1);
        let long = "kind = \"hydrostatic\"\nend_time_s = 35";
        assert_eq!(count(long, "boundary = \"mls-linear\""), 0);
        assert_eq!(count(long, "boundary = \"dummy\""), 1);
        assert_eq!(count("kind = \"hydrostatic\"\nend_time_s = 300", ""), 0);
        assert_eq!(count("kind = \"oscillating-drop\"", ""), 0);
        assert_eq!(count("kind = \"oscillating-drop\"\nend_after_periods = 30", ""), 1);
        let isph = "scheme = \"isph\"";
        assert_eq!(count("wave_height_ratio = 0.4", isph), 0);
        assert_eq!(count("wave_height_ratio = 0.5", isph), 1);
        assert_eq!(count("wave_height_ratio = 0.6", isph), 1);
        let fine = "scheme = \"isph\"\nparticle_spacing_m = 0.004";
        assert_eq!(count("wave_height_ratio = 0.4", fine), 1);
        let compact = "scheme = \"isph\"\nlaplacian = \"symmetric\"";
        assert_eq!(count("wave_height_ratio = 0.4", compact), 1);
        assert_eq!(count("", "particle_spacing_m = 0.025"), 1);
        assert_eq!(count("wave_height_ratio = 0.6", ""), 1);
        assert_eq!(count("wave_height_ratio = 0.8", ""), 2);
        let vortices = "kind = \"taylor-green\"";
        assert_eq!(count(vortices, ""), 0);
        let source = "preset = \"huang2019\"";
        assert_eq!(count(vortices, source), 1);
        assert_eq!(count("kind = \"standing-wave\"", source), 1);
        assert_eq!(count("kind = \"rotating-patch\"", source), 1);
        assert_eq!(count("", source), 0);
        assert_eq!(count("", "preset = \"huang2019\"\nparticle_spacing_m = 0.0125"), 1);
        let soft = "wave_height_ratio = 0.6\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    spring_stiffness_n_per_m = 10";
        assert_eq!(count(soft, ""), 0);
        let ringing =
            "wall = \"movable\"\nseawall_mass_kg_per_m = 1\nspring_stiffness_n_per_m = 1e7";
        assert_eq!(count(ringing, ""), 1);
    }
}
