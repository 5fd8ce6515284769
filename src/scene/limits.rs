//! Known limits: what `seawall check` warns of before a run. Measured by `seawall stress` and
//! `seawall accuracy` and `scripts/boundary_comparison`; see `results/stability`, `results/accuracy` and
//! `results/boundary_comparison`.

use super::config::CaseConfig;
use super::facts::Facts;
use super::kind::Scene;
use super::numerics::{GhostGravity, Slip};
use super::size;
use crate::boundary::BoundaryChoice;

/// What is known to go wrong, or to be inaccurate, with a case; a line each, the same line for the
/// same limit.
pub fn limits(config: &CaseConfig) -> Vec<&'static str> {
    let facts = Facts::of(config);
    LIMITS.iter().filter(|(holds, _)| holds(&facts)).map(|(_, told)| *told).collect()
}

type Limit = (fn(&Facts<'_>) -> bool, &'static str);

const LIMITS: &[Limit] = &[
    (
        |case| case.weakly && case.numerics.courant_number > 2.0,
        "courant_number above 2: energy comes from nowhere, 11 % of the paddle's work at 2.3, and at \
         2.5 the run ends; retries = 1 would start it again with half the step",
    ),
    (
        |case| case.boundary(BoundaryChoice::ImprovedShepard) && case.has_bed(),
        "boundary = \"improved-shepard\" over a bed that is not level: it leans on the nearest particle, \
         and still water on a slope began to turn, by 5 mm/s after 30 s at ten rows; boundary = \
         \"normalized\" kept it below 1 mm/s",
    ),
    (
        |case| case.stirs_at_shore(),
        "a bed steeper than 1:2 that comes out of the water, without shifting = \"deep\" and volume_feedback \
         = 0.002: still water began to turn beside it, and energy came from nowhere after 51 to 134 s",
    ),
    (
        |case| case.rests_long_at_shore(),
        "still water for more than 100 s before a bed steeper than 1:2 that comes out of it: for so long it \
         rested at ten to twenty rows, but at ten rows energy came from nowhere in four of eight runs, \
         after 117 to 296 s",
    ),
    (
        |case| case.hits_again() && case.sinks(),
        "a wave that comes back to the wall, without volume_feedback = 0.002: water that is stirred \
         sinks through itself, by 2 % of its depth within 40 s and 9 % within 80 s at twelve rows",
    ),
    (
        |case| case.stirs(),
        "a steep bed under water without shifting = \"deep\" and steep_feedback = 0.15: still water began \
         to turn at the upper end of upright steps after 10 to 40 s",
    ),
    (
        |case| {
            case.weakly && case.scene().has_steep_bed() && case.rows.is_some_and(|rows| rows > 20.0)
        },
        "a steep bed under water at more than twenty rows: that still water rests for 300 s was seen at \
         ten, sixteen and twenty rows",
    ),
    (
        |case| case.boundary(BoundaryChoice::ImprovedShepard) && case.has_crest(),
        "boundary = \"improved-shepard\" at a crest that water goes over: at sixteen rows 0.6 % of the \
         paddle's work came from nowhere, and face and force were 6.7 % apart; boundary = \"normalized\" kept \
         them within 0.2 and 3.0 %",
    ),
    (
        |case| case.boundary(BoundaryChoice::ImprovedShepard) && case.is_long_train(),
        "boundary = \"improved-shepard\" for a train of more than ten waves: its walls put energy into the \
         water, up to half of the work exchanged in thirty periods at sixteen rows; boundary = \"normalized\" \
         kept the budget of fifty periods within 1.5 %",
    ),
    (
        |case| case.boundary(BoundaryChoice::Sfdi) && case.rows.is_some(),
        "boundary = \"sfdi\": its weights jump as another particle becomes the nearest; a wave of \
         H/h = 0.5 at a vertical wall gained 1.4 % of the paddle's work from nowhere",
    ),
    (
        |case| case.boundary(BoundaryChoice::Dummy) && case.scene().frame().end_time > 20.0,
        "boundary = \"dummy\" for more than 20 s: still water creeps at the walls; after 300 s ten \
         rows of it pressed 9 % too little and stood 0.08 h low",
    ),
    (
        |case| {
            let at_mirror = case.numerics.ghost_gravity == GhostGravity::AtMirror;
            case.boundary(BoundaryChoice::Normalized) && at_mirror
        },
        "boundary = \"normalized\" with ghost_gravity = \"at-mirror\": pressure at the bed of still \
         water was up to 3.1 % off; \"in-sum\" keeps it within 0.2 %",
    ),
    (
        |case| case.breaks() && case.numerics.slip == Slip::No,
        "slip = \"no\" in a dam break: the bed holds the front back as far as the kernel reaches, at \
         30 rows it came 0.6 to 1.1 √(H/g) late",
    ),
    (
        |case| case.breaks() && case.numerics.corrected_gradients,
        "corrected_gradients in a dam break: thin water bears no pressure, a gauge feels the jet 0.1 \
         to 0.2 √(H/g) later than with preset = \"huang2019\"",
    ),
    (
        |case| case.leaves_divergence(),
        "laplacian = \"symmetric\" or \"schwaiger\" leaves divergence in the water and wants \
         gravity_courant_number = 0.035; \"exact\" does neither",
    ),
    (
        |case| !case.weakly && case.wave >= 0.5 && case.stands,
        "scheme = \"isph\" at H/h of 0.5 and more on a wall that hardly moves: the runup is read low, \
         by some 0.04 h at 0.5 and 0.14 h at 0.6 at the default spacing; forces hold",
    ),
    (
        |case| !case.weakly && case.rows.is_some_and(|rows| rows > 32.0),
        "scheme = \"isph\" with more than 32 rows over the depth: a case of 25 rows takes half a \
         minute and more, one of half the spacing six times as long; scheme = \"wcsph\" is as \
         accurate in a fifth of the time",
    ),
    (
        |case| case.uncorrected() && matches!(case.scene(), Scene::TaylorGreen(_)),
        "vortices without corrected_gradients and shifting decay too fast: by 14 % of their speed at \
         20 particles across each, against 4.5 % with them",
    ),
    (
        |case| case.uncorrected() && matches!(case.scene(), Scene::StandingWave(_)),
        "a standing wave without corrected_gradients lost 46 % of its amplitude",
    ),
    (
        |case| {
            matches!(case.scene(), Scene::StandingWave(wave) if wave.end_after_periods > 10.0)
                && case.sinks()
        },
        "a standing wave for more than 10 periods: without shifting = \"deep\" and volume_feedback = \
         0.002 its particles crept closer, and from the twelfth period on it sank by some 2 % of its \
         depth; boundary = \"normalized\" keeps it stillest",
    ),
    (
        |case| case.numerics.volume_feedback > 0.0 && !case.numerics.corrected_gradients,
        "volume_feedback without corrected_gradients: it has nothing to take back, as the plain \
         divergence keeps the volume",
    ),
    (
        |case| case.uncorrected() && matches!(case.scene(), Scene::RotatingPatch(_)),
        "a rotating patch without corrected_gradients and shifting lost 6 % of its kinetic energy, \
         and its particles clustered",
    ),
    (
        |case| case.uncorrected() && case.rows.is_some_and(|rows| rows < 20.0),
        "waves without corrected_gradients at fewer than 20 rows over the depth: forces on the wall \
         were up to 20 % high, and runups 18 % low",
    ),
    (
        |case| matches!(case.scene(), Scene::OscillatingDrop(drop) if drop.end_after_periods > 10.0),
        "an oscillating drop for more than 10 periods: after 30 its axes enclosed 30 % less than the \
         exact drop's with corrected_gradients, and swung 63 % too little without",
    ),
    (
        |case| size::particles(&case.config.scene, &case.config.numerics) > 1e6,
        "more than 1,000,000 particles: 1.4 GiB and some hours of one core upwards, both for each \
         case at once; 20,000,000 are the most that are taken",
    ),
    (
        |case| case.rows.is_some_and(|rows| rows < 10.0),
        "fewer than 10 particles over the depth: the wave loses height, forces are 1 to 3 % and \
         runups up to 20 % low",
    ),
    (
        |case| case.weakly && case.wave >= 0.6 && case.stands,
        "H/h of 0.6 and more on a wall that hardly moves: the tip of the water is thinner than a \
         particle, and the runup is off, at H/h = 0.6 by up to 0.03 h at 10 mm and 0.1 h at 16 mm",
    ),
    (
        |case| case.wave > 0.75,
        "H/h above 0.75: such a wave breaks on its way, and no reference covers it",
    ),
];

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
        let beach = "tank_length_m = 2\nbed = [[0, 0], [1, 0], [2, 0.1]]";
        assert_eq!(count(beach, ""), 1);
        assert_eq!(count(beach, "boundary = \"normalized\""), 0);
        let train =
            "paddle = \"wave-train\"\nwave_period_s = 1\nwave_height_ratio = 0.1\nend_time_s";
        assert_eq!(count(&format!("{train} = 20"), "boundary = \"improved-shepard\""), 1);
        assert_eq!(count(&format!("{train} = 9"), "boundary = \"improved-shepard\""), 0);
        assert_eq!(count(&format!("{train} = 20"), ""), 0);
        let standing = "kind = \"standing-wave\"\nend_after_periods = 20";
        assert_eq!(count(standing, ""), 1);
        assert_eq!(count(standing, "volume_feedback = 0.002\nshifting = \"deep\""), 0);
        let ridge = "tank_length_m = 2\nbed = [[0, 0], [1, 0], [1, 0.1], [2, 0.1]]";
        assert_eq!(count(ridge, "boundary = \"normalized\""), 0);
        let finer = "particle_spacing_m = 0.008\nboundary = \"normalized\"";
        assert_eq!(count(ridge, finer), 1);
        let steep = "tank_length_m = 2\nbed = [[0, 0], [1, 0], [2, 1]]";
        assert_eq!(count(steep, "boundary = \"normalized\""), 0);
        let interior = "boundary = \"normalized\"\nshifting = \"interior\"";
        assert_eq!(count(steep, interior), 1);
        let still = format!("{steep}\nwave_height_ratio = 0\nend_time_s");
        assert_eq!(count(&format!("{still} = 90"), "boundary = \"normalized\""), 0);
        assert_eq!(count(&format!("{still} = 110"), "boundary = \"normalized\""), 1);
        let sinks = "volume_feedback = 0";
        assert_eq!([8, 20].map(|s| count(&format!("end_time_s = {s}"), sinks)), [0, 1]);
        assert_eq!(count("end_time_s = 20", ""), 0);
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
    }
}
