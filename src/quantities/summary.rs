//! The columns of `summary.csv`, in their order. Swept keys follow in a column each.

use serde::Serialize;

use super::case::reached;
use super::column::{Read, bar, count, flag, maximum, number, text};
use super::{Digits, Unit, quantities};

/// The name that a choice has in scene files.
fn word(choice: impl Serialize) -> Option<String> {
    match serde_json::to_value(choice) {
        Ok(serde_json::Value::String(name)) => Some(name),
        _ => None,
    }
}

quantities! { Read;
    /// hash of everything that decides the answer, 16 hexadecimal digits
    CASE_ID = text("case_id", |case| Some(case.id.clone())).symbol("case");
    /// `ok`, or `failed`
    STATUS = text("status", |case| {
        Some(if case.outcome.is_some() { "ok" } else { "failed" }.to_owned())
    });
    /// why it failed: `<kind> at t = <time> s: <detail>`, see below; an `ok` row with a reason
    /// recovered from it with smaller time steps (`retries`)
    REASON = text("reason", |case| Some(case.reason.to_owned()));
    /// nominal wave height H/h
    WAVE_HEIGHT_RATIO = number("wave_height_ratio", Unit::None, |case| {
        Some(case.seawall()?.wave_height_ratio)
    })
    .symbol("H/h");
    /// k, per metre of width
    SPRING_STIFFNESS = number("spring_stiffness_n_per_m", Unit::NewtonsPerMetre, |case| {
        case.movable()?.spring_stiffness_n_per_m
    })
    .symbol("k");
    /// m, per metre of width
    SEAWALL_MASS = number("seawall_mass_kg_per_m", Unit::KilogramsPerMetre, |case| {
        case.movable()?.seawall_mass_kg_per_m
    })
    .symbol("m");
    /// log10 of k* = k/(ρgh²); empty for k = 0
    LOG10_K_STAR = number("log10_k_star", Unit::None, |case| case.log10_k_star())
        .symbol("log₁₀ k*")
        .digits(Digits::Decimals(2));
    /// m* = m/(ρh²)
    M_STAR = number("m_star", Unit::None, |case| case.m_star()).symbol("m*");
    /// height of the first crest that passes `wave_gauge_m`, over h
    MEASURED_WAVE_HEIGHT_RATIO = number("measured_wave_height_ratio", Unit::None, |case| {
        case.outcome?.measured_wave_height_ratio
    })
    .symbol("H/h measured")
    .digits(Digits::Decimals(4));
    /// largest force F* (running mean) of the whole run
    FORCE_MAX = maximum("force_max", Unit::Force, |case| Some(reached(case.outcome?.force_max)))
        .symbol("F* max")
        .bar("force_max_error");
    /// largest runup R* of the whole run
    RUNUP_MAX = maximum("runup_max", Unit::Runup, |case| Some(reached(case.outcome?.runup_max)))
        .symbol("R* max")
        .bar("runup_max_error");
    /// largest displacement X* of the whole run
    DISPLACEMENT_MAX = maximum("displacement_max", Unit::Displacement, |case| {
        case.outcome?.displacement_max.map(reached)
    })
    .symbol("X* max")
    .bar("displacement_error")
    .bound("displacement_truncated");
    /// largest force F* (running mean) of the first impact
    FIRST_FORCE_MAX = maximum("first_force_max", Unit::Force, |case| {
        case.outcome?.first_force_max.map(reached)
    })
    .symbol("first F*")
    .bar("force_error");
    /// largest runup R* of the first impact
    FIRST_RUNUP_MAX = maximum("first_runup_max", Unit::Runup, |case| {
        case.outcome?.first_runup_max.map(reached)
    })
    .symbol("first R*")
    .bar("runup_error");
    /// largest displacement X* of the first impact
    FIRST_DISPLACEMENT_MAX = maximum("first_displacement_max", Unit::Displacement, |case| {
        case.outcome?.first_displacement_max.map(reached)
    })
    .symbol("first X*");
    /// the running maximum when F* - 1 has first dropped 10 % below it
    FIRST_FORCE_PEAK = number("first_force_peak", Unit::Force, |case| {
        case.outcome?.first_force_peak
    })
    .symbol("first peak, F*");
    /// the running maximum when R* has first dropped 10 % below it
    FIRST_RUNUP_PEAK = number("first_runup_peak", Unit::Runup, |case| {
        case.outcome?.first_runup_peak
    })
    .symbol("first peak, R*");
    /// largest F* of any single step, but for those in which the sound of a stop can be heard
    FORCE_MAX_RAW = number("force_max_raw", Unit::Force, |case| Some(case.outcome?.force_max_raw))
        .symbol("F* max of any step");
    /// F* at the end
    FORCE_END = number("force_end", Unit::Force, |case| Some(case.outcome?.force_end))
        .symbol("F* at the end");
    /// R* at the end
    RUNUP_END = number("runup_end", Unit::Runup, |case| Some(case.outcome?.runup_end))
        .symbol("R* at the end");
    /// X* at the end
    DISPLACEMENT_END = number("displacement_end", Unit::Displacement, |case| {
        case.outcome?.displacement_end
    })
    .symbol("X* at the end");
    /// first time that the force stayed above the threshold for 0.02 s
    ONSET_TIME = number("onset_time_s", Unit::Seconds, |case| case.outcome?.onset_time_s)
        .symbol("onset");
    /// when the paddle passes the middle of its stroke
    STROKE_CENTRE = number("stroke_centre_s", Unit::Seconds, |case| case.outcome?.stroke_centre_s)
        .symbol("stroke centre");
    /// the maximum is at the very end: a lower bound
    DISPLACEMENT_TRUNCATED = flag("displacement_truncated", |case| {
        case.outcome?.displacement_truncated
    })
    .symbol("still moving");
    /// how often the wall came back onto its stop
    STOPS = count("stops", |case| case.outcome?.stops.map(u64::from));
    /// largest gap between the momentum reaction and the pressure on the face, of the larger of
    /// force and hydrostatic force
    FORCE_GAP = number("force_gap_percent", Unit::Percent, |case| {
        Some(case.outcome?.force_gap_percent)
    })
    .digits(Digits::Decimals(3));
    /// residual of the energy budget, of the paddle's work (in still water, of the initial
    /// potential energy)
    ENERGY_GAP = number("energy_gap_percent", Unit::Percent, |case| {
        Some(case.outcome?.energy_gap_percent)
    })
    .digits(Digits::Decimals(3));
    /// largest number of particles seen outside the tank
    PARTICLES_LOST = count("particles_lost", |case| {
        Some(u64::from(case.outcome?.particles_lost))
    });
    /// error bar of `first_force_max`, see [physics.md](physics.md#error-bars); empty with
    /// `error_bars = "none"`, and where the companions failed
    FORCE_ERROR = bar("force_error", Unit::Force, |case| case.bars.force);
    /// error bar of `first_runup_max`
    RUNUP_ERROR = bar("runup_error", Unit::Runup, |case| case.bars.runup);
    /// error bar of `displacement_max`
    DISPLACEMENT_ERROR = bar("displacement_error", Unit::Displacement, |case| {
        case.bars.displacement
    });
    /// time steps, the shared trunk's included
    STEPS = count("steps", |case| Some(case.outcome?.steps));
    /// particles of water
    PARTICLES = count("particles", |case| Some(u64::from(case.outcome?.particles)));
    /// pairs of particles that were summed over, the shared trunk's included
    PAIR_EVALUATIONS = count("pair_evaluations", |case| Some(case.outcome?.pair_evaluations));
    /// wall time, the shared trunk's not included
    WALL_TIME = number("wall_time_s", Unit::Seconds, |case| Some(case.wall_time_s));
    /// the scheme
    SCHEME = text("scheme", |case| word(case.config.numerics.scheme));
    /// the interpolator at walls
    BOUNDARY = text("boundary", |case| word(case.config.numerics.boundary));
    /// the smoothing kernel
    KERNEL = text("kernel", |case| word(case.config.numerics.kernel));
    /// the spacing of particles at the start
    PARTICLE_SPACING = number("particle_spacing_m", Unit::Metres, |case| {
        Some(case.config.numerics.particle_spacing_m)
    });
    /// the factor s of the wall's law of motion
    FORCE_COUPLING = number("force_coupling", Unit::None, |case| {
        Some(case.seawall()?.force_coupling)
    })
    .symbol("s");
    /// the water's own force on the wall in the first step: forces count from there, see
    /// [physics.md](physics.md)
    FORCE_AT_REST = number("force_at_rest", Unit::Force, |case| Some(case.outcome?.force_at_rest))
        .newer();
    /// how many times a ghost that counts was filled with what a simpler interpolation gave,
    /// because the chosen one had too few or badly placed neighbours
    BOUNDARY_FALLBACKS = count("boundary_fallbacks", |case| {
        Some(case.outcome?.boundary_fallbacks)
    })
    .newer();
    /// gap of the two force readings at `force_max`, signed: of the means over 0.14 √(h/g), less
    /// what it is at rest
    FORCE_MAX_GAP = number("force_max_gap_percent", Unit::Percent, |case| {
        Some(case.outcome?.force_max_gap_percent)
    })
    .newer();
    /// strongest impulse of the water on the wall by a hit on its stop; negative, as it is suction;
    /// 0 where the wall never came back; in no maximum of the force, see
    /// [physics.md](physics.md#the-seawall)
    STOP_IMPULSE = maximum("stop_impulse", Unit::Impulse, |case| {
        let impulse = case.outcome?.stop_impulse?;
        Some((impulse.value, (impulse.value != 0.0).then_some(impulse.time_s)))
    })
    .newer();
    /// error bar of `force_max`
    FORCE_MAX_ERROR = bar("force_max_error", Unit::Force, |case| case.bars.whole_force).newer();
    /// error bar of `runup_max`
    RUNUP_MAX_ERROR = bar("runup_max_error", Unit::Runup, |case| case.bars.whole_runup).newer();
    /// `true` where something touches a quoted number
    DOUBTFUL = flag("doubtful", |case| Some(case.outcome?.doubtful_reason.is_some())).newer();
    /// what that is, see [physics.md](physics.md#health)
    DOUBTFUL_REASON = text("doubtful_reason", |case| case.outcome?.doubtful_reason.clone()).newer();
}

/// The names of the columns, those of times included.
pub fn names() -> impl Iterator<Item = String> {
    ALL.iter().flat_map(|column| std::iter::once(column.name.to_owned()).chain(column.time_name()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::named;

    #[test]
    fn the_columns_are_those_of_the_contract() {
        let contract = "case_id,status,reason,wave_height_ratio,spring_stiffness_n_per_m,\
            seawall_mass_kg_per_m,log10_k_star,m_star,measured_wave_height_ratio,\
            force_max,force_max_time_s,runup_max,runup_max_time_s,displacement_max,\
            displacement_max_time_s,first_force_max,first_force_max_time_s,first_runup_max,\
            first_runup_max_time_s,first_displacement_max,first_displacement_max_time_s,\
            first_force_peak,first_runup_peak,force_max_raw,force_end,runup_end,displacement_end,\
            onset_time_s,stroke_centre_s,displacement_truncated,stops,force_gap_percent,\
            energy_gap_percent,particles_lost,force_error,runup_error,displacement_error,\
            steps,particles,pair_evaluations,wall_time_s,scheme,boundary,kernel,\
            particle_spacing_m,force_coupling,force_at_rest,boundary_fallbacks,force_max_gap_percent,stop_impulse,\
            stop_impulse_time_s,force_max_error,runup_max_error,doubtful,doubtful_reason";
        assert_eq!(names().collect::<Vec<_>>().join(","), contract);
    }

    #[test]
    fn bars_and_bounds_are_columns() {
        for column in ALL {
            let of = |name: Option<&'static str>| name.map(|name| named(name).unwrap());
            assert!(of(column.bar).is_none_or(|bar| bar.unit == column.unit), "{}", column.name);
            assert!(of(column.bound).is_none_or(|flag| matches!(flag.read, Read::Flag(_))));
        }
    }
}
