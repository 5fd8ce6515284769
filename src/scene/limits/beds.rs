//! Known limits of beds that are not level, and of crests.

use std::f64::consts::SQRT_2;

use crate::boundary::BoundaryChoice;
use crate::scene::limit_facts::{Facts, Limit};
use crate::scene::numerics::Slip;

fn is_coarse_over_crest(case: &Facts) -> bool {
    case.has_crest() && case.wave > 0.0 && case.rows.is_some_and(|rows| rows < 20.0 - 1e-6)
}

/// Whether the nearest companion could run: otherwise there are no error bars.
fn may_have_bars(case: &Facts) -> bool {
    case.config.coarsened(SQRT_2).is_ok()
}

/// What was measured over crests, and where to learn more.
macro_rules! few_rows_over_a_crest {
    ($more:literal) => {
        concat!(
            "a crest that water goes over at fewer than 20 rows over the depth: at 10 and 14 rows volumes of 0.1 to \
             0.5 h² were 6 % below to 8 % above those of 40 rows, and smaller ones 50 % below to 18 % above; ",
            $more
        )
    };
}

pub(super) const BEDS: &[Limit] = &[
    (
        |case| case.boundary(BoundaryChoice::ImprovedShepard) && case.has_bed(),
        "boundary = \"improved-shepard\" over a bed that is not level: it leans on the nearest particle, \
         and still water on a slope began to turn, by 5 mm/s after 30 s at ten rows; boundary = \
         \"normalized\" kept it below 1 mm/s",
    ),
    (
        |case| case.stirs_at_shore(),
        "a bed steeper than 1:2 that comes out of the water or ends less than one and a half rows under it, a shore \
         from 1:5 on in a long run, or a gentler one in a very long one, without shifting = \"deep\" and \
         volume_feedback = 0.002: still water began to turn beside it, and energy came from nowhere after 51 to 134 s",
    ),
    (
        |case| case.ends_low(),
        "a steep face that ends near the still water, from one and a half rows under it to a support radius above it: still \
         water there moved with up to 0.3 J/m after 60 s; energy came from nowhere in one of 111 runs of 60 s at ten to \
         twenty rows",
    ),
    (
        |case| case.rows_at_wall().is_some_and(|rows| rows < 4.0),
        "a bed that leaves fewer than four rows of still water at the wall: at one to two rows forces were up to \
         15 % off, and runups up to 20 %, and error bars were too narrow; at three to four rows it was up to 4 and 13 %, \
         and still water pressed 1.4 to 2.4 % too hard",
    ),
    (
        |case| case.falls_before_wall(),
        "a bed that falls by two rows of particles or more within five spacings of the wall: still water pressed 8 to 35 % \
         too little at ten to sixteen rows, face and force were 3 to 34 % apart, and a runup was read 48 % low",
    ),
    (
        |case| case.breaks_at_wall(),
        "a wave higher than 0.75 of the still water at its wall: it breaks there; at 0.8 forces were 7 % lower at five rows \
         over that depth than at ten, and 3 % at seven; at 1.2 they were up to 10 % apart at five to ten rows, and up to 55 % \
         apart at four to six rows of less water",
    ),
    (
        |case| case.hits_dry_wall(),
        "a wave that runs up a beach to a wall whose foot is dry: its tongue is a spacing or two thick and hits it all at \
         once; on 1:10 forces under H/h = 0.4 were 25 % lower to 18 % higher at 10 to 16 rows than at 20; with courant_number = 1.8 four \
         of twelve runs ended early",
    ),
    (
        |case| {
            let makes_energy = case.numerics.slip == Slip::Free && !case.numerics.conservative_bed;
            case.weakly && case.goes_over_steep_bed() && makes_energy
        },
        "waves over a bed steeper than 1:2 without conservative_bed: as water runs back over its edge energy comes \
         from nowhere, 2 to 10 % of the paddle's work at upright steps and up to 31 % in ten periods of a train; two of \
         nine waves over upright steps ended their runs at twenty rows",
    ),
    (
        |case| case.stirs(),
        "a bed steeper than 1:2 under water, from 1:5 on in a long run, or one no steeper than 1:2 that comes out of it in \
         a very long one, without shifting = \"deep\" and conservative_bed = true: still water began to turn at the upper ends of \
         slopes and steps after 6 to 40 s, and before gentle shores energy came from nowhere after 117 to 193 s",
    ),
    (
        |case| {
            case.weakly && case.scene().has_steep_bed() && case.rows.is_some_and(|rows| rows > 20.0)
        },
        "a steep bed under water at more than twenty rows: still water was seen to rest over such beds at ten, \
         sixteen and twenty rows",
    ),
    (
        |case| !case.numerics.conservative_crest && case.has_crest(),
        "conservative_crest = false at a crest that water goes over: water crowds before it; at ten rows trains missed \
         24 and 43 % of their energy (freeboards of 0.1 and 0.05 h), and face and force were up to 5 % apart",
    ),
    (
        |case| is_coarse_over_crest(case) && may_have_bars(case),
        few_rows_over_a_crest!("error_bars = \"pair\" tells of each how far it may be off"),
    ),
    (
        |case| is_coarse_over_crest(case) && !may_have_bars(case),
        few_rows_over_a_crest!("error bars need a smaller particle_spacing_m here"),
    ),
    (
        |case| {
            let keys = case.scene().seawall().and_then(|scene| scene.crest.as_ref());
            let clear = 1.5 * case.numerics.particle_spacing_m - 1e-9;
            keys.is_some_and(|crest| crest.crest_freeboard_m < clear)
        },
        "a freeboard of less than one and a half particle spacings: still water moved at the crest's edge there; R* was up to \
         0.03 h without a wave, and at a tenth of a spacing pressures fell by 5.6 % of ρgh in 60 s",
    ),
    (
        |case| {
            let few = case.rows.is_some_and(|rows| rows < 15.0);
            case.has_crest() && case.wave >= 0.6 - 1e-9 && few
        },
        "a crest that water goes over, under H/h of 0.6 and more at fewer than 15 rows: F* was up to 2.7 % and M* up to 4.2 % \
         high (H/h = 0.65, a freeboard of 0.4 h), by 1.2 and 1.8 error bars",
    ),
    (
        |case| case.has_gauge_on_floor(),
        "a gauge on a dry floor behind the wall: levels are right from three rows of water on, and pressures were 30 to 41 % too \
         high there; with less water both read too little, down to a fiftieth; a probe of kind = \"volume\" tells all of it",
    ),
    (
        |case| case.reads_thin_tongues(),
        "a beach at forty rows over the depth or fewer: where the water ends is read where it is one spacing thick, so \
         runups are low and rise as the spacing falls; at twenty rows those of H/h = 0.03 and 0.06 were 1 % below linear theory \
         over 1:2, 3 to 14 % over 1:3 and 1:5, 18 and 26 % over 1:8, 47 and 63 % over 1:20; runup_thickness_m tells them at one \
         thickness for all spacings",
    ),
    (
        |case| case.thins_out(),
        "runup_thickness_m of less than a particle spacing: runups that were told at half a spacing were up to 8 % below linear \
         theory over 1:5 and 1:8 (H/h = 0.06) and 18 % over 1:20 (0.03), those at 0.35 to 0.38 spacings up to 16 %",
    ),
    (
        |case| case.has_filled_trench(),
        "a trench in the bed that is narrower than a particle spacing: no particle fits; still water over one of half a \
         spacing pressed 2 % too little, and its runup was read down in the trench, 0.7 h off",
    ),
];
