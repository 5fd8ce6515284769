//! The columns of `summary.csv`, in their order. Swept keys follow in a column each.

use super::Unit::{
    Displacement, Force, Impulse, KilogramsPerMetre, Metres, MetresPerSecond, Moment,
    NewtonsPerMetre, Percent, Pure, Runup, Seconds, SquareMetres, SquareMetresPerSecond,
};
use super::column::{Read, count, flag, maximum, number, text};
use super::{Column, quantities};
use crate::math::name::name_of;

quantities! { Read;
    /// hash of everything that decides the answer, 16 hexadecimal digits
    CASE_ID = text("case_id", "case", |c| Some(c.id.clone()));
    /// `ok`, or `failed`
    STATUS = text("status", "", |c| Some(c.outcome.map_or("failed", |_| "ok").to_owned()));
    /// why it failed: `<kind> at t = <time> s: <detail>`; an `ok` row with a reason recovered from it
    /// with smaller time steps (`retries`)
    REASON = text("reason", "", |c| Some(c.reason.to_owned()));
    /// nominal wave height H/h
    WAVE_HEIGHT_RATIO = number("wave_height_ratio", "H/h", Pure, |c| {
        Some(c.seawall()?.wave_height_ratio)
    });
    /// k, per metre of width
    SPRING_STIFFNESS = number("spring_stiffness_n_per_m", "k", NewtonsPerMetre, |c| {
        c.movable()?.spring_stiffness_n_per_m
    });
    /// m, per metre of width
    SEAWALL_MASS = number("seawall_mass_kg_per_m", "m", KilogramsPerMetre, |c| {
        c.movable()?.seawall_mass_kg_per_m
    });
    /// log10 of k* = k/(ρgh²); empty for k = 0
    LOG10_K_STAR = number("log10_k_star", "log₁₀ k*", Pure, |c| c.log10_k_star()).decimals(2);
    /// m* = m/(ρh²)
    M_STAR = number("m_star", "m*", Pure, |c| c.m_star());
    /// height of the first crest that passes `wave_gauge_m`, over h
    MEASURED_WAVE_HEIGHT_RATIO = number("measured_wave_height_ratio", "H/h measured", Pure, |c| {
        c.outcome?.measured_wave_height_ratio
    }).decimals(4).of_a_single_wave();
    /// largest force F* (running mean) of the whole run
    FORCE_MAX = maximum("force_max", "F* max", Force, |c| Some(c.outcome?.force_max))
        .bar("force_max_error");
    /// largest runup R* of the whole run
    RUNUP_MAX = maximum("runup_max", "R* max", Runup, |c| Some(c.outcome?.runup_max))
        .bar("runup_max_error");
    /// largest displacement X* of the whole run; of a caisson to either side
    DISPLACEMENT_MAX = maximum("displacement_max", "X* max", Displacement, |c| {
        c.outcome?.displacement_max
    }).bar("displacement_error").bound("displacement_truncated");
    /// largest force F* (running mean) of the first impact
    FIRST_FORCE_MAX = maximum("first_force_max", "first F*", Force, |c| c.outcome?.first_force_max)
        .bar("force_error").whole("force_max").of_a_single_wave();
    /// largest runup R* of the first impact
    FIRST_RUNUP_MAX = maximum("first_runup_max", "first R*", Runup, |c| c.outcome?.first_runup_max)
        .bar("runup_error").whole("runup_max").of_a_single_wave();
    /// largest displacement X* of the first impact; of a caisson to either side
    FIRST_DISPLACEMENT_MAX = maximum("first_displacement_max", "first X*", Displacement, |c| {
        c.outcome?.first_displacement_max
    }).bound("displacement_truncated").whole("displacement_max").of_a_single_wave();
    /// first peak of F*: the largest so far when F* - 1 first falls 10 % below it
    FIRST_FORCE_PEAK = number("first_force_peak", "first peak, F*", Force, |c| {
        c.outcome?.first_force_peak
    }).of_a_single_wave();
    /// first peak of R*: the largest so far when R* first falls 10 % below it
    FIRST_RUNUP_PEAK = number("first_runup_peak", "first peak, R*", Runup, |c| {
        c.outcome?.first_runup_peak
    }).of_a_single_wave();
    /// largest F* of any single step, but for those in which the sound of a stop can be heard
    FORCE_MAX_RAW = number("force_max_raw", "F* max of any step", Force, |c| {
        Some(c.outcome?.force_max_raw)
    });
    /// F* at the end
    FORCE_END = number("force_end", "F* at the end", Force, |c| Some(c.outcome?.force_end));
    /// R* at the end
    RUNUP_END = number("runup_end", "R* at the end", Runup, |c| Some(c.outcome?.runup_end));
    /// X* at the end
    DISPLACEMENT_END = number("displacement_end", "X* at the end", Displacement, |c| {
        c.outcome?.displacement_end
    });
    /// first time that the force stayed above the threshold for 0.02 s
    ONSET_TIME = number("onset_time_s", "onset", Seconds, |c| c.outcome?.onset_time_s);
    /// when the paddle passes the middle of its stroke
    STROKE_CENTRE = number("stroke_centre_s", "stroke centre", Seconds, |c| {
        c.outcome?.stroke_centre_s
    });
    /// `true` where `displacement_max` is reached at the very end of the run: a lower bound then
    DISPLACEMENT_TRUNCATED = flag("displacement_truncated", "still moving", |c| {
        c.outcome?.displacement_truncated
    });
    /// how often the wall came back onto its stop
    STOPS = count("stops", |c| c.outcome?.stops.map(u64::from));
    /// largest gap between the two readings of the force, by the water's momentum and by the pressure on
    /// the face; over the force, or that of still water where it is larger
    FORCE_GAP = number("force_gap_percent", "", Percent, |c| {
        Some(c.outcome?.force_gap_percent)
    }).decimals(3);
    /// gap of the energy budget, over the largest value of the paddle's work; in still water over the
    /// initial potential energy; with a paddle that absorbs over all work that passed either way, where that is more
    ENERGY_GAP = number("energy_gap_percent", "", Percent, |c| {
        Some(c.outcome?.energy_gap_percent)
    }).decimals(3);
    /// largest number of particles seen outside the tank
    PARTICLES_LOST = count("particles_lost", |c| Some(c.outcome?.particles_lost.into()));
    /// error bar of `first_force_max`, see [physics.md](physics.md#error-bars); empty with
    /// `error_bars = "none"`, and where the companions failed
    FORCE_ERROR = number("force_error", "", Force, |c| c.bars.force)
        .significant(3).of_a_single_wave();
    /// error bar of `first_runup_max`
    RUNUP_ERROR = number("runup_error", "", Runup, |c| c.bars.runup)
        .significant(3).of_a_single_wave();
    /// error bar of `displacement_max`
    DISPLACEMENT_ERROR = number("displacement_error", "", Displacement, |c| {
        c.bars.displacement
    }).significant(3);
    /// time steps, the shared trunk's included
    STEPS = count("steps", |c| Some(c.outcome?.steps));
    /// particles of water
    PARTICLES = count("particles", |c| Some(c.outcome?.particles.into()));
    /// pairs of particles that were summed over, the shared trunk's included
    PAIR_EVALUATIONS = count("pair_evaluations", |c| Some(c.outcome?.pair_evaluations));
    /// time on the clock, the shared trunk's not included
    WALL_TIME = number("wall_time_s", "", Seconds, |c| Some(c.wall_time_s));
    /// the scheme
    SCHEME = text("scheme", "", |c| Some(name_of(c.config.numerics.scheme)));
    /// the interpolator at walls; incompressible water has none: its walls mirror it
    BOUNDARY = text("boundary", "", |c| {
        c.has_interpolator().then(|| name_of(c.config.numerics.boundary))
    });
    /// the smoothing kernel
    KERNEL = text("kernel", "", |c| Some(name_of(c.config.numerics.kernel)));
    /// the spacing of particles at the start
    PARTICLE_SPACING = number("particle_spacing_m", "", Metres, |c| {
        Some(c.config.numerics.particle_spacing_m)
    });
    /// the factor s of the wall's law of motion
    FORCE_COUPLING = number("force_coupling", "coupling s", Pure, |c| {
        Some(c.seawall()?.force_coupling)
    });
    // Directories of the first version end here.
    /// the water's own force on the wall in the first step: the forces of a seawall count from
    /// there, see [walls.md](walls.md#force)
    FORCE_AT_REST = number("force_at_rest", "F* at rest", Force, |c| Some(c.outcome?.force_at_rest));
    /// how many times a ghost that counts was filled with what a simpler interpolation gave,
    /// because the chosen one had too few or badly placed neighbours
    BOUNDARY_FALLBACKS = count("boundary_fallbacks", |c| {
        c.outcome.filter(|_| c.has_interpolator()).map(|outcome| outcome.boundary_fallbacks)
    });
    /// signed gap of the two force readings at `force_max`, less the gap at rest; both are means over
    /// 0.14 √(h/g)
    FORCE_MAX_GAP = number("force_max_gap_percent", "", Percent, |c| {
        Some(c.outcome?.force_max_gap_percent)
    }).decimals(3);
    /// strongest impulse of the water on the wall by a hit on its stop; negative, as it is suction;
    /// 0, without a time, where the wall never came back; in no maximum of the force, see
    /// [physics.md](physics.md#the-seawall)
    STOP_IMPULSE = maximum("stop_impulse", "stop impulse", Impulse, |c| {
        c.outcome?.stop_impulse
    });
    /// error bar of `force_max`
    FORCE_MAX_ERROR = number("force_max_error", "", Force, |c| c.bars.whole_force).significant(3);
    /// error bar of `runup_max`
    RUNUP_MAX_ERROR = number("runup_max_error", "", Runup, |c| c.bars.whole_runup).significant(3);
    /// `true` where something casts doubt on a quoted number
    DOUBTFUL = flag("doubtful", "", |c| Some(c.outcome?.doubtful_reason.is_some()));
    /// what makes the case doubtful, see [physics.md](physics.md#health)
    DOUBTFUL_REASON = text("doubtful_reason", "", |c| c.outcome?.doubtful_reason.clone());
    /// largest moment M* (running mean) of the water about the wall's foot, of the whole run; 1 is
    /// that of still water on an upright wall, see [physics.md](physics.md#loads-on-the-wall)
    MOMENT_MAX = maximum("moment_max", "M* max", Moment, |c| c.outcome?.moment_max)
        .bar("moment_max_error");
    /// largest moment M* (running mean) of the first impact
    FIRST_MOMENT_MAX = maximum("first_moment_max", "first M*", Moment, |c| {
        c.outcome?.first_moment_max
    }).bar("moment_error").whole("moment_max").of_a_single_wave();
    /// integral of F* - 1 over the first impact; where a wall swings back the end of the run may cut it off
    FIRST_IMPULSE = number("first_impulse", "first impulse", Impulse, |c| {
        c.outcome?.first_impulse
    }).decimals(4).of_a_single_wave();
    /// time in which F* - 1 rises from 10 to 90 % of its maximum of the first impact
    RISE_TIME = number("rise_time_s", "rise time", Seconds, |c| c.outcome?.rise_time_s)
        .decimals(4).of_a_single_wave();
    /// largest force of the spring, k X of the largest displacement; empty where there is no spring
    SPRING_FORCE_MAX = maximum("spring_force_max", "spring F* max", Force, |c| {
        c.spring_force_max()
    }).bound("displacement_truncated");
    /// water that has gone past the back of the wall's crest by the end, per metre of width; empty where
    /// the wall has no crest
    OVERTOPPING_VOLUME = number("overtopping_volume_m2", "V over", SquareMetres, |c| {
        Some(c.outcome?.overtopped?.volume_m2)
    }).significant(4).bar("overtopping_volume_error_m2");
    /// largest discharge at the back of the crest, a mean over five spacings, of samples
    /// `history_interval_s` apart; empty where the wall has none
    OVERTOPPING_DISCHARGE = number(
        "overtopping_discharge_max_m2_per_s", "q max", SquareMetresPerSecond,
        |c| Some(c.outcome?.overtopped?.discharge_max_m2_per_s)
    ).significant(4);
    /// thickest water on the crest, of samples `history_interval_s` apart; empty where the wall has none
    CREST_THICKNESS = number("crest_thickness_max_m", "crest d max", Metres, |c| {
        Some(c.outcome?.overtopped?.thickness_max_m)
    }).significant(4);
    /// fastest water on the crest, away from the tank: the mean over a column, of samples
    /// `history_interval_s` apart; empty where it was too thin to tell, and where the wall has no crest
    CREST_SPEED = number("crest_speed_max_m_per_s", "crest u max", MetresPerSecond, |c| {
        c.outcome?.overtopped?.speed_max_m_per_s
    }).significant(4);
    /// what to expect of the numbers where fewer than 10 rows of particles stand over the depth, or over the
    /// depth at the wall where that is less; empty where there are more
    COARSE_SPACING = text("coarse_spacing", "", |c| c.coarse_spacing());
    /// error bar of `overtopping_volume_m2`
    OVERTOPPING_VOLUME_ERROR = number("overtopping_volume_error_m2", "", SquareMetres, |c| {
        c.bars.overtopping
    }).significant(3);
    /// error bar of `first_moment_max`
    MOMENT_ERROR = number("moment_error", "", Moment, |c| c.bars.moment)
        .significant(3).of_a_single_wave();
    /// error bar of `moment_max`
    MOMENT_MAX_ERROR = number("moment_max_error", "", Moment, |c| c.bars.whole_moment)
        .significant(3);
}

/// The results that are compared, and drawn against what was swept.
pub const RESULTS: [&Column; 4] =
    [&FIRST_FORCE_MAX, &FIRST_RUNUP_MAX, &DISPLACEMENT_MAX, &OVERTOPPING_VOLUME];

/// The columns of the first version, which every directory has.
pub fn first_version() -> impl Iterator<Item = &'static Column> {
    ALL.iter().copied().take_while(|column| **column != FORCE_AT_REST)
}

/// The names of the columns, those of times included.
pub fn names() -> impl Iterator<Item = String> {
    ALL.iter().flat_map(|column| std::iter::once(column.name.to_owned()).chain(column.time_name()))
}

#[cfg(test)]
mod tests;
