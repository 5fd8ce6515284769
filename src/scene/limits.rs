//! Known limits: told by `seawall check`, `run` and `sweep` before a run. They were measured by `seawall stress`,
//! `seawall accuracy` and `scripts/boundary_comparison`; see `results/stability`,
//! `results/accuracy` and `results/boundary_comparison`.

mod beds;
mod incompressible;
mod leaning;

use beds::BEDS;
use incompressible::INCOMPRESSIBLE;
use leaning::LEANING;

use super::config::CaseConfig;
use super::kind::Scene;
use super::limit_facts::{Facts, Limit};
use super::numerics::Slip;
use super::size;
use crate::boundary::{BoundaryChoice, GhostGravity};
use crate::kernel::KernelChoice;
use crate::scheme::wcsph::DensityDiffusion;

/// What is known to be wrong or inaccurate with a case, a line each. The same limit always has the
/// same line.
pub fn limits(config: &CaseConfig) -> Vec<&'static str> {
    let facts = Facts::of(config);
    let all = LIMITS.iter().chain(INCOMPRESSIBLE).chain(LEANING).chain(BEDS);
    all.filter(|(holds, _)| holds(&facts)).map(|(_, told)| *told).collect()
}

/// Whether an upright wall has narrower supports than waves there have by default.
fn is_narrow(case: &Facts) -> bool {
    case.numerics.support_radius_ratio < 4.9 && case.angle == 90.0
}

/// Whether walls take the mean of the water near them, as it is at the mirror point.
fn is_normalized_at_mirror(case: &Facts) -> bool {
    let at_mirror = case.numerics.ghost_gravity == GhostGravity::AtMirror;
    case.boundary(BoundaryChoice::Normalized) && at_mirror
}

/// Shorter waves lose much of their height.
const FEW_SPACINGS: f64 = 50.0;

const LIMITS: &[Limit] = &[
    (
        |case| case.weakly && case.numerics.courant_number > 2.0,
        "courant_number above 2: energy comes from nowhere, up to 1.7 % of the paddle's work at 2.3 and 4 % at \
         2.5 (H/h = 0.3 and 0.5, twelve to twenty rows)",
    ),
    (
        |case| case.hits_again() && case.sinks(),
        "a wave that comes back to the wall, without volume_feedback = 0.002: water that is stirred \
         sinks through itself, by 2 % of its depth within 40 s and 9 % within 80 s at twelve rows",
    ),
    (
        |case| case.spacings_to_a_wave().is_some_and(|spacings| spacings < FEW_SPACINGS),
        "regular waves of fewer than 50 particle spacings from crest to crest: near the paddle they were 3 to \
         7 % lower than asked at 48, and 9 to 18 % at 30, the more the deeper the water",
    ),
    (
        |case| case.standing().is_some_and(|[spacings, _]| spacings < FEW_SPACINGS),
        "a standing wave of fewer than 50 particle spacings from crest to crest: in five periods it lost 14 to 16 % \
         of its amplitude at 40, 55 to 64 % at 20 and over 95 % at 10",
    ),
    (
        |case| case.standing().is_some_and(|[_, steepness]| steepness >= 0.1),
        "a standing wave whose height, twice its amplitude, is 0.1 of its length or more: period_exact is that of \
         small waves; it swung 1.2 % slower at 0.1, 2.7 % at 0.15 and 5 % at 0.2",
    ),
    (
        |case| case.stretching().is_some_and(|rate| rate < 0.3),
        "an oscillating drop that is stretched at less than 0.3 of its field's rate: its energy gap counts from \
         little energy, and was -4 % (0.2) to -18 % (0.05) at 40 rings and -21 to -147 % at 10",
    ),
    (
        |case| case.stretching().is_some_and(|rate| rate > 1.0),
        "an oscillating drop that is stretched faster than its field's rate: at 1.5 times that its axes were off by \
         9 % of its radius at 10 rings, and by 5 % at 20 and at 40",
    ),
    (
        |case| case.boundary(BoundaryChoice::ImprovedShepard) && case.is_long_train(),
        "boundary = \"improved-shepard\" for a train of more than ten waves: its walls put energy into the \
         water, up to half of the work exchanged in thirty periods at sixteen rows; boundary = \"normalized\" \
         kept the budget of fifty periods within 1.5 %",
    ),
    (
        |case| case.boundary(BoundaryChoice::Sfdi) && case.rows.is_some(),
        "boundary = \"sfdi\": its weights jump as another particle becomes the nearest; waves of H/h = 0.5 and \
         0.6 at a vertical wall gained 0.6 and 1.2 % of the paddle's work from nowhere",
    ),
    (
        |case| case.boundary(BoundaryChoice::Dummy) && case.scene().frame().end_time > 20.0,
        "boundary = \"dummy\" for more than 20 s: still water creeps at the walls; after 300 s ten \
         rows of it pressed 9 % too little and stood 0.08 h low",
    ),
    (
        |case| is_normalized_at_mirror(case) && !case.uncorrected(),
        "boundary = \"normalized\" with ghost_gravity = \"at-mirror\": pressure at the bed of still \
         water was up to 3.3 % off; \"in-sum\" keeps it within 0.2 %",
    ),
    (
        |case| is_normalized_at_mirror(case) && case.uncorrected(),
        "boundary = \"normalized\" with ghost_gravity = \"at-mirror\" and without corrected_gradients: still water grows \
         restless; the pressure at the bed was up to 49 % of ρgh off after 5 s, and F* rose to 1.72; \"in-sum\" keeps it \
         within 0.5 %, boundary = \"improved-shepard\" within 0.9 %",
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
        |case| {
            let spacing = case.numerics.particle_spacing_m;
            matches!(case.scene(), Scene::DamBreak(dam) if dam.rows_in_the_end(spacing) < 4.0)
        },
        "a dam break whose water covers the tank by fewer than four rows of particles: energy came from nowhere, \
         2 to 5 % at three rows, and at two runs ended early",
    ),
    (
        |case| case.uncorrected() && matches!(case.scene(), Scene::TaylorGreen(_)),
        "vortices without corrected_gradients decay too fast: by 27 to 44 % of their speed at 20 particles \
         across each, against 10 % with them",
    ),
    (
        |case| case.may_tear(),
        "vortices in an odd number of rows with courant_number above 1.2, under a mean pressure below 3 ρU²: the pressure \
         falls below 0, and the water may tear; with 1.8 two of 13 such runs ended early and three lost 8 to 24 % of \
         their energy; 60 runs with 0.9 gained 3 % at most",
    ),
    (
        |case| case.uncorrected() && matches!(case.scene(), Scene::StandingWave(_)),
        "a standing wave without corrected_gradients lost 30 to 76 % of its amplitude in five periods at 15 rows, \
         and 17 to 52 % at 30",
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
        "a rotating patch without corrected_gradients lost 5 to 17 % of its kinetic energy at 50 particles along \
         its side, and its particles clustered",
    ),
    (
        |case| case.uncorrected() && case.wave > 0.0,
        "waves at a wall without corrected_gradients: at fewer than 20 rows over the depth forces were 20 % high \
         to 8 % low, and runups up to 21 % low; at sixteen rows under H/h = 0.47 the force was 5 % and the moment 23 % high, \
         and the runup 5 % low; at 25 rows forces were up to 5 % and displacements 9 % low, and \
         runups 15 % off; this hardly falls with the spacing, so error bars do not tell it",
    ),
    (
        |case| {
            let plain = case.numerics.density_diffusion == DensityDiffusion::Molteni;
            case.weakly && case.wave > 0.0 && plain
        },
        "density_diffusion = \"molteni\" before a seawall: it moves still water; at ten to sixteen rows forces were 2 % \
         low (H/h of 0.15 to 0.3) to 2 % high (0.6), runups up to 15 % high and displacements up to 6 % low, by up to \
         12 error bars; \"hydrostatic\" does not",
    ),
    (
        |case| {
            case.numerics.kernel == KernelChoice::CubicSpline
                && case.numerics.support_radius_ratio > 2.7
        },
        "kernel = \"cubic-spline\" with a support of more than 2.7 spacings: particles pair up, and still water of 0.3 m \
         ended as clustering after 3 to 9 s, with both schemes; support_radius_ratio = 2.6 does not",
    ),
    (
        |case| case.weakly && case.numerics.kernel == KernelChoice::WendlandC4,
        "kernel = \"wendland-c4\" with scheme = \"wcsph\": still water of twenty rows moved with 2.5 J/m after 35 s, and its \
         force was 1 % low",
    ),
    (
        |case| case.weakly && case.wave > 0.0 && case.numerics.slip == Slip::No,
        "slip = \"no\" before a seawall: its bed holds the water back as far as the kernel reaches; forces \
         were up to 3 % off, and displacements 10 % at 14 rows and 7 % at 25; error bars were too narrow, by up \
         to a factor of 6",
    ),
    (
        |case| matches!(case.scene(), Scene::OscillatingDrop(drop) if drop.end_after_periods > 10.0),
        "an oscillating drop for more than 10 periods: stretched at 0.4 of its field's rate, with corrected_gradients, \
         runs of 10 to 25 rings ended after 15 to 25 periods, as energy came from nowhere; without, it swung 58 % too \
         little after 30",
    ),
    (
        |case| size::particles(&case.config.scene, &case.config.numerics) > 1e6,
        "more than 1,000,000 particles: 1.4 GiB and some hours of one core upwards, both for each \
         case at once; 20,000,000 are the most that are taken",
    ),
    (
        |case| case.rows.is_some_and(|rows| rows < 10.0 - 1e-9) && !case.has_bed(),
        "fewer than 10 particles over the depth: forces are up to 3 %, displacements 9 % off, runups \
         0.25 h low, and one error bar in four may miss",
    ),
    (
        |case| case.rows.is_some_and(|rows| rows < 10.0 - 1e-9) && case.has_bed(),
        "fewer than 10 particles over the depth, and a bed that is not level: numbers are further off than over a level \
         bed, where forces are up to 3 % off, and one error bar in four may miss",
    ),
    (
        |case| {
            let default = case.weakly && case.numerics.corrected_gradients;
            default && case.wave > 0.3 && is_narrow(case) && !case.has_bed()
        },
        "support_radius_ratio below 5 and H/h above 0.3 at an upright wall: at H/h = 0.5, 8 to 12.5 mm, error bars missed by \
         up to a factor of 3.4; with 4 spacings runups were 0.03 h high, with 3.5 moments 5 %",
    ),
    (
        |case| case.weakly && case.wave >= 0.6 && case.stands(),
        "H/h of 0.6 and more on a wall that hardly moves: the tip of the water is thinner than a \
         particle, and the runup is off, at H/h = 0.6 by up to 0.03 h at 10 mm and 0.1 h at 16 mm",
    ),
    (
        |case| case.wave > 0.75,
        "H/h above 0.75: such a wave breaks on its way, and no reference covers it",
    ),
];

#[cfg(test)]
mod tests;
