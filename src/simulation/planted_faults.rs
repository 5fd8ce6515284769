//! Faults that no scene file can cause, and the doubt that they must raise.

use super::{CaseResult, Stopped, Unwatched, run_case};
use crate::boundary::MISSING_ROW;
use crate::math::simd::SimdPath;
use crate::scene::CaseConfig;

/// A soft wall under a wave of H/h = 0.3. One of the five rows of ghosts behind it may be missing.
fn without_row(row: Option<i64>) -> Result<CaseResult, Stopped> {
    let scene = "wall = \"movable\"\nwave_height_ratio = 0.3\n\
        spring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 100";
    let config = CaseConfig::of(scene, "particle_spacing_m = 0.02");
    MISSING_ROW.set(row);
    let result = run_case(&config, None, SimdPath::widest(), &Unwatched);
    MISSING_ROW.set(None);
    result
}

/// The outermost row is out of reach of particles half a spacing from the wall. Without it no
/// quoted number changes. Each other missing row is noticed or ends the run.
#[test]
fn a_missing_row_of_ghosts_is_caught_where_it_moves_a_number() {
    let sound = without_row(None).unwrap().outcome;
    assert_eq!(sound.doubtful_reason, None);
    let outermost = without_row(Some(4)).unwrap().outcome;
    assert_eq!(outermost.doubtful_reason, None);
    let [force, farthest] = [
        outermost.force_max.value / sound.force_max.value,
        outermost.displacement_max.unwrap().value / sound.displacement_max.unwrap().value,
    ];
    assert!((force - 1.0).abs() < 1e-3 && (farthest - 1.0).abs() < 2e-3, "{force} {farthest}");
    let next = without_row(Some(3)).unwrap().outcome.doubtful_reason.unwrap_or_default();
    assert!(next.contains("force at rest: still water pressed the wall -0."), "{next}");
    for row in [0, 1] {
        assert!(matches!(without_row(Some(row)), Err(Stopped::Failed(_))), "{row}");
    }
}
