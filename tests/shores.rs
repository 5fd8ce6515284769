//! Tongues of water on shores whose bed gives back.

use crate::beds::computed_with;

/// Water of 0.2 m and ten rows before a beach of 1:10.
const BEACH: &str =
    "tank_length_m = 5.1\nbed = [[0, 0], [1.5, 0], [5.1, 0.36]]\nwave_gauge_m = 1\n";

/// What a tongue covered as it ran up counted as water that ran into the bed, and the bed's ghosts pushed it back along
/// their face. Of a train's energy 10 % was missing then, and the second wave here got up to 0.375 h, with 4 % missing.
#[test]
fn tongues_keep_their_energy() {
    let train = "paddle = \"wave-train\"\nwave_period_s = 1.4\nabsorption = true\nwave_height_ratio = 0.12\nend_time_s = 20";
    let single = "wave_height_ratio = 0.3\nend_time_s = 12";
    for (waves, numerics, runup) in
        [(train, "", 0.09), (single, "conservative_bed = true\ncourant_number = 0.9", 0.45)]
    {
        let case = computed_with(&format!("{BEACH}{waves}"), numerics, &[]);
        let (gap, highest) = (case.outcome.energy_gap_percent, case.outcome.runup_max.value);
        println!("{waves}: {gap} % missing, {highest} h");
        assert!(gap.abs() < 2.0 && highest > runup, "{waves}: {gap} %, {highest} h");
    }
}

/// Where a bed bends, ghosts of one face have water of the other on one side alone. Pushes that were handed back there
/// once stirred still water.
#[test]
fn still_water_rests_where_a_shore_bends() {
    let beach = "tank_length_m = 3\nwave_gauge_m = 0.5\nwave_height_ratio = 0\nend_time_s = 60\n\
                 bed = [[0, 0], [1, 0], [2, 0.18], [2.3, 0.2], [3, 0.4]]";
    let numerics = "conservative_bed = true\nvolume_feedback = 0.002\nshifting = \"deep\"";
    let still = computed_with(beach, numerics, &[]);
    println!("{} J/m", still.energy.kinetic);
    assert!(still.energy.kinetic < 1e-3, "{}", still.energy.kinetic);
}
