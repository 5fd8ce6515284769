//! The expected cost of a study: time and memory, for people.

use crate::execute::available_cores;
use crate::math::simd::SimdPath;
use crate::scene::{CaseConfig, Scheme};
use crate::simulation::cost;
use crate::study::{Plan, Study};

/// Seconds on the cores of this machine, and the number of these cores.
pub(super) fn estimated_time(study: &Study, plan: &Plan) -> (f64, usize) {
    let cores = available_cores();
    (processor_time(study, plan) / cores.min(study.run_count()).max(1) as f64, cores)
}

/// Seconds that a study takes on this machine's cores, or on so many threads.
pub(super) fn expected_seconds(study: &Study, threads: Option<usize>) -> f64 {
    let cores = available_cores();
    let at_once = threads.unwrap_or(cores).min(cores).min(study.run_count()).max(1);
    processor_time(study, &Plan::new(study, true, cost, |_| true)) / at_once as f64
}

/// Seconds that one core takes for all cases of a study.
pub(super) fn seconds_of_a_core(study: &Study) -> f64 {
    processor_time(study, &Plan::new(study, false, cost, |_| true))
}

/// Seconds for all cases of a study, and the number of cores.
pub(super) fn time_of_all(study: &Study) -> (f64, usize) {
    estimated_time(study, &Plan::new(study, true, cost, |_| true))
}

/// Seconds that one core takes for a plan. They are within a factor of two on the measured
/// machines: an AMD EPYC (Zen 5) is faster, an Intel Xeon (Sapphire Rapids) slower.
fn processor_time(study: &Study, plan: &Plan) -> f64 {
    let time = |cost: u64, config: &CaseConfig| {
        let numerics = &config.numerics;
        let share = match numerics.scheme {
            Scheme::Wcsph => {
                substeps_share(numerics.acoustic_substeps)
                    * support_share(numerics.support_radius_ratio)
                    * walls_share(config)
            }
            Scheme::Isph => 1.0,
        };
        share * cost as f64 / particle_steps_per_second(numerics.scheme, SimdPath::widest())
    };
    let trunks = plan.trunks.iter().map(|trunk| time(trunk.cost, &trunk.config));
    let cases = plan.cases.iter().map(|case| {
        let own = if case.trunk.is_some() { case.branch_cost } else { case.cost };
        time(own, &study.run(case.index).config)
    });
    trunks.chain(cases).sum()
}

/// The time with so many acoustic substeps to a full step, over that with three. A substep takes a quarter of a full
/// step. A wave at a wall took 1.95 times as long with full steps alone.
fn substeps_share(substeps: u32) -> f64 {
    0.5 + 1.5 / f64::from(substeps)
}

/// The time with supports of so many spacings, over that with five. Neighbours take three quarters
/// of the time (docs/performance.md).
fn support_share(ratio: f64) -> f64 {
    0.26 + 0.74 * (ratio / 5.0).powi(2)
}

/// The time with this water's walls and bed, over that of twenty rows on a level bed. Water is next to walls along a line,
/// so their part goes as one over the rows. With beds that slope tanks of 10 to 33 rows took 1.9 to 1.3 times as long.
fn walls_share(config: &CaseConfig) -> f64 {
    let Some(scene) = config.scene.seawall() else { return 1.0 };
    let rows = scene.still_water_depth_m / config.numerics.particle_spacing_m;
    let bed = if scene.bed.is_some() { 1.0 + 9.0 / rows } else { 1.0 };
    bed * (1.0 + 7.0 / rows) / (1.0 + 7.0 / 20.0)
}

/// Particle-steps per second and core. Those of δ-SPH, with supports of five spacings and one full
/// step in three, lie between the two machines of docs/measured.md, 5.0 and 9.6 million with AVX-512.
/// So do those of incompressible water, for `sweeps/scenes/movable_wall.toml` at 12.5 mm.
fn particle_steps_per_second(scheme: Scheme, simd: SimdPath) -> f64 {
    match (scheme, simd) {
        (Scheme::Isph, SimdPath::Portable) => 2.7e5,
        (Scheme::Isph, _) => 6e5,
        (Scheme::Wcsph, SimdPath::Avx512) => 7e6,
        (Scheme::Wcsph, SimdPath::Avx2) => 4.4e6,
        (Scheme::Wcsph, SimdPath::Portable) => 2e6,
    }
}

/// Bytes for people: `15.2 MiB`, `28.0 GiB`.
pub(super) fn binary(bytes: u64) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    if mebibytes < 1024.0 {
        format!("{mebibytes:.1} MiB")
    } else {
        format!("{:.1} GiB", mebibytes / 1024.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::SweepFile;

    /// Seconds of one core for a single scene.
    fn seconds(numerics: &str) -> f64 {
        let text = format!("name = \"a\"\n[numerics]\n{numerics}");
        let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
        seconds_of_a_core(&study)
    }

    #[test]
    fn incompressible_water_is_expected_to_cost_several_times_as_much() {
        let ratio = seconds("scheme = \"isph\"") / seconds("");
        assert!((2.0..8.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn full_steps_cost_more_than_those_that_follow_the_sound() {
        let ratio = seconds("acoustic_substeps = 1") / seconds("");
        assert!((1.8..2.2).contains(&ratio), "{ratio}");
    }

    #[test]
    fn narrow_supports_cost_less_though_they_take_more_steps() {
        let [three, four] =
            [3.0, 4.0].map(|ratio| seconds(&format!("support_radius_ratio = {ratio:?}")));
        assert!(three < four && four < seconds(""), "{three} {four}");
    }

    /// The story: beaches of fourteen rows took more than twice the time that was told.
    #[test]
    fn beds_cost_the_more_the_fewer_rows_there_are() {
        let share = |scene: &str, spacing: f64| {
            walls_share(&CaseConfig::of(scene, &format!("particle_spacing_m = {spacing}")))
        };
        let bed = "bed = [[0, 0], [1, 0], [2.5, 0.08]]";
        let ratios = [0.02, 0.008].map(|spacing| share(bed, spacing) / share("", spacing));
        assert!((1.8..2.0).contains(&ratios[0]) && (1.3..1.45).contains(&ratios[1]), "{ratios:?}");
        assert_eq!([share("", 0.01), share("kind = \"hydrostatic\"", 0.02)], [1.0; 2]);
    }

    #[test]
    fn memory_is_told_in_units_that_fit() {
        assert_eq!(binary(20_000_000), "19.1 MiB");
        assert_eq!(binary(30_008_000_000), "27.9 GiB");
    }
}
