//! Known limits of incompressible SPH.

use super::is_narrow;
use crate::scene::limit_facts::Limit;
use crate::scene::numerics::ErrorBars;

pub(super) const INCOMPRESSIBLE: &[Limit] = &[
    (
        |case| !case.weakly && case.hits_again() && case.numerics.volume_feedback == 0.0,
        "scheme = \"isph\" and a wave that comes back to the wall: its water sinks through itself, by 1 % of its \
         depth in 25 to 40 s; volume_feedback = 0.002 holds it, and takes energy from the wave",
    ),
    (
        |case| case.leaves_divergence(),
        "laplacian = \"symmetric\" or \"schwaiger\" leaves divergence in the water and wants \
         gravity_courant_number = 0.035; \"exact\" does neither",
    ),
    (
        |case| !case.weakly && case.wave >= 0.5 && case.stands(),
        "scheme = \"isph\" at H/h of 0.5 and more on a wall that hardly moves: the runup is read low, by \
         0.02 to 0.03 h at 0.5 and 0.10 to 0.12 h at 0.6 at the default spacing; at 0.6 the moment is 1 to 2 % low",
    ),
    (
        |case| !case.weakly && case.wave >= 0.4 && is_narrow(case),
        "scheme = \"isph\" with support_radius_ratio below 5 and H/h of 0.4 and more: the lattice breaks up; with 4 forces \
         at fixed walls scattered by 1 to 2 %, and walls on stiff springs swung up to 12 % too far",
    ),
    (
        |case| !case.weakly && case.wave > 0.4 && case.numerics.error_bars != ErrorBars::None,
        "scheme = \"isph\" with error bars at H/h above 0.4: those of R* are too narrow; at 0.5 and 0.6 and 10 mm they held 2 \
         of 8. Those of F*, M* and X* held all of 20, 20 and 15",
    ),
    (
        |case| !case.weakly && case.rows.is_some_and(|rows| rows > 32.0),
        "scheme = \"isph\" with more than 32 rows over the depth: a case of 25 rows takes half a \
         minute and more, one of half the spacing six times as long; scheme = \"wcsph\" is as \
         accurate in a fifth of the time",
    ),
];
