use super::*;
use crate::quantities::{named, of_a_single_wave};

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
        stop_impulse_time_s,force_max_error,runup_max_error,doubtful,doubtful_reason,moment_max,\
        moment_max_time_s,first_moment_max,first_moment_max_time_s,first_impulse,rise_time_s,\
        spring_force_max,spring_force_max_time_s,overtopping_volume_m2,\
        overtopping_discharge_max_m2_per_s,crest_thickness_max_m,crest_speed_max_m_per_s,coarse_spacing,\
        overtopping_volume_error_m2,moment_error,moment_max_error";
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

/// The story: a list beside the declarations named those of the first impact whose names do not say it.
#[test]
fn what_is_called_first_is_of_the_first_impact() {
    let of_first: Vec<_> = names().filter(|name| of_a_single_wave(name)).collect();
    for name in names().filter(|name| name.starts_with("first_")) {
        assert!(of_first.contains(&name), "{name}");
    }
    for name in [
        "measured_wave_height_ratio",
        "rise_time_s",
        "force_error",
        "runup_error",
        "first_force_max_time_s",
    ] {
        assert!(of_first.contains(&name.to_owned()), "{name}");
    }
    assert!(!of_first.contains(&"force_max_time_s".to_owned()) && of_first.len() < 20);
}

/// The story: seven places paired a column of the first impact with that of the whole run by hand.
#[test]
fn a_result_of_the_first_impact_has_one_of_the_whole_run() {
    let paired = ALL.iter().filter(|column| column.whole.is_some());
    let paired: Vec<_> = paired.map(|column| (column.name, column.of_whole_run().name)).collect();
    let results = ["force", "runup", "displacement", "moment"];
    let pairs = results.map(|of| (format!("first_{of}_max"), format!("{of}_max")));
    assert_eq!(paired, pairs.each_ref().map(|(first, whole)| (first.as_str(), whole.as_str())));
    for column in RESULTS {
        assert_eq!(column.unit, column.of_whole_run().unit);
        assert!(!column.of_whole_run().of_a_single_wave, "{}", column.name);
    }
}
