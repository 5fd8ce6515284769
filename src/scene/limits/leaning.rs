//! Known limits of walls that lean.

use crate::boundary::BoundaryChoice;
use crate::scene::limit_facts::Limit;

pub(super) const LEANING: &[Limit] = &[
    (
        |case| case.stirs_at_leaning_wall(),
        "still water before a wall that leans, for more than 30 √(h/g): it begins to turn, and sinks by some hundredths \
         of its depth; the preset default calms it by artificial_viscosity = 0.3, shifting = \"deep\" and \
         volume_feedback = 0.01",
    ),
    (
        |case| {
            let leans = case.angle != 90.0;
            leans && case.hits_again() && case.boundary(BoundaryChoice::ImprovedShepard)
        },
        "boundary = \"improved-shepard\" for a wave that comes back to a leaning wall: 9 to 18 % of the \
         paddle's work came from nowhere in 40 s at ten rows, and 4 to 7 % at sixteen; the default, \
         boundary = \"normalized\", had the budget open by 6 % at most",
    ),
    (
        |case| case.weakly && case.angle > 110.0,
        "wall_angle_deg above 110: the tip of still water on such a wall is thinner than a particle, and within half \
         a second its level reads 0.01 (120 degrees) to 0.04 h (145) low at twenty rows; runups count from the start",
    ),
    (
        |case| {
            case.weakly
                && case.angle != 90.0
                && case.wave > 0.0
                && case.scene().has_waves_that_go_on()
        },
        "a train before a wall that leans: within 12 s (H/h = 0.1) the energy budget was open by -5 to -7 % at 60 degrees, \
         3 % at 110 and 7 to 12 % at 130 at fifteen rows, by -4 % at 60 and 5 % at 130 at 24; runups at 130 degrees rose from \
         0.111 h to 0.127 h between the two, and forces held",
    ),
    (
        |case| case.weakly && case.angle <= 60.0 && case.wave >= 0.4,
        "wall_angle_deg of 60 or less under H/h of 0.4 and more: at 0.5 face and force were 2 to 5 % apart, and \
         runups were 8 to 20 % lower at ten rows than at twenty",
    ),
    (
        |case| case.weakly && case.angle > 60.0 && case.angle <= 80.0 && case.wave >= 0.55 - 1e-9,
        "wall_angle_deg of 60 to 80 under H/h of 0.55 and more: at 72 degrees and 0.65 the runup was 1.78, 1.92 and 2.14 h at \
         14.5, 10 and 7.25 mm; six runs at 65 to 80 degrees, 0.55 and 0.65 and 10 mm were doubtful",
    ),
    (
        |case| case.weakly && case.angle >= 115.0 && case.wave >= 0.3,
        "wall_angle_deg of 115 and more under H/h of 0.3 and more: at 0.5 runups at ten rows were 6 % (120 degrees), \
         9 % (134) and 13 % (148) lower than at twenty, where that at 148 still was 4 % lower than at 28; error bars \
         held at ten to twenty rows",
    ),
    (
        |case| !case.weakly && case.scene().wall_angle_deg() != 90.0,
        "scheme = \"isph\" before a wall that leans: still water pressed the toe of walls of 62 to 71 degrees 3 to 5 % too \
         much, and of 111 to 115 degrees 2 to 3 % too little, at ten and twenty rows alike",
    ),
];
