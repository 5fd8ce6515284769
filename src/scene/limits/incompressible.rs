//! Known limits of incompressible SPH.

use crate::scene::limit_facts::Limit;
use crate::scene::numerics::ErrorBars;

/// A wall on a spring of this many ρgh hardly moves.
const STIFF: f64 = 50.0;

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
         0.03 to 0.05 h at 0.5 and 0.13 to 0.15 h at 0.6 at the default spacing",
    ),
    (
        |case| {
            let stiff = case.stiffness > STIFF && case.stiffness.is_finite();
            !case.weakly && case.wave >= 0.4 && stiff
        },
        "scheme = \"isph\" at H/h of 0.4 and more on a spring of 50 ρgh or stiffer: against potential theory F* was off by -2.1 \
         to 0.6 %, M* by -2 to 1.3 % and X* by -3.2 to 1.4 % at 8 mm; at 10 mm F* was up to 5 %, M* and X* up to 7 % low",
    ),
    (
        |case| !case.weakly && case.wave > 0.0 && case.numerics.error_bars != ErrorBars::None,
        "scheme = \"isph\" with error bars: they were set for scheme = \"wcsph\" and are too narrow; at H/h of 0.2 to 0.6 and \
         10 mm the truth was within 14 of 20 of F*, 9 of 20 of R*, 14 of 20 of M* and 7 of 15 of X*",
    ),
    (
        |case| !case.weakly && case.rows.is_some_and(|rows| rows > 32.0),
        "scheme = \"isph\" with more than 32 rows over the depth: a case of 25 rows takes half a \
         minute and more, one of half the spacing six times as long; scheme = \"wcsph\" is as \
         accurate in a fifth of the time",
    ),
];
