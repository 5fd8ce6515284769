use super::*;
use crate::quantities::summary::SPRING_STIFFNESS;
use crate::results::made_up;
use crate::simulation::{FailureKind, Maximum};

fn file(grid: &str) -> SweepFile {
    let text = format!(
        "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\n{grid}"
    );
    SweepFile::read(&text, &[]).unwrap()
}

/// The force on a wall by its stiffness: a step in the logarithm.
fn force(stiffness: f64) -> f64 {
    2.0 + libm::tanh(1.5 * (libm::log10(stiffness) - 3.0))
}

/// A result in which the force is a function of the stiffness, `None` where the case fails.
fn record(study: &Study, case: &Case, force: impl Fn(f64) -> Option<f64>) -> CaseRecord {
    let stiffness = case.config.scene.seawall().unwrap().spring_stiffness_n_per_m.unwrap();
    let mut result = made_up(&case.config);
    let value = force(stiffness);
    result.outcome.force_max = Maximum { value: value.unwrap_or(0.0), time_s: 1.0 };
    let mut record = CaseRecord::new(study, case, &Ok(result), 0.0, "");
    if value.is_none() {
        record.outcome = None;
        record.failure = Some(FailureKind::NotANumber);
    }
    record
}

/// All rounds.
fn refined(file: &SweepFile, force: impl Fn(f64) -> Option<f64>) -> (Refinement, Study, Round) {
    let refinement = Refinement::of(file).unwrap();
    let all = |study: &Study| -> Vec<_> {
        study.cases.iter().map(|case| Some(record(study, case, &force))).collect()
    };
    let study = refinement.so_far(|study| Ok::<_, ConfigError>(all(study))).unwrap();
    let round = refinement.round(&study, &all(&study));
    (refinement, study, round)
}

fn stiffnesses(study: &Study) -> Vec<f64> {
    let one = |case: &Case| case.config.scene.seawall().unwrap().spring_stiffness_n_per_m.unwrap();
    study.cases.iter().map(one).collect()
}

#[test]
fn a_step_is_resolved_and_what_is_straight_is_left_alone() {
    for written in ["[1, 1e2, 1e4, 1e6]", "[1e6, 1e4, 1e2, 1]"] {
        let refine = "refine = { quantity = \"force_max\", to = 0.02 }";
        let file = file(&format!("spring_stiffness_n_per_m = {written}\n{refine}"));
        let (refinement, study, round) = refined(&file, |k| Some(force(k)));
        assert_eq!((round.points.len(), round.open, round.unknown), (0, 0, 0));
        let mut values = stiffnesses(&study);
        let falls = values[0] > values[1];
        assert_eq!(falls, written.starts_with("[1e6"));
        if falls {
            values.reverse();
        }
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");
        // The chord is as good as asked, everywhere.
        let scale = |k: f64| libm::log10(k);
        for pair in values.windows(2) {
            for share in 1..20 {
                let t = f64::from(share) / 20.0;
                let place = scale(pair[0]) * (1.0 - t) + scale(pair[1]) * t;
                let chord = force(pair[0]) * (1.0 - t) + force(pair[1]) * t;
                let off = (chord - force(libm::pow(10.0, place))).abs();
                assert!(off < 0.02, "{off} between {pair:?}");
            }
        }
        let places: Vec<_> = values.iter().map(|k| scale(*k)).collect();
        let widest = places.windows(2).map(|p| p[1] - p[0]).fold(0.0, f64::max);
        let least = places.windows(2).map(|p| p[1] - p[0]).fold(f64::INFINITY, f64::min);
        assert!(widest > 3.0 * least, "{places:?}");
        // An even grid would have the smallest step everywhere: more than twice as many points.
        assert!((refinement.count(&study) as f64) < 0.5 * 6.0 / least, "{values:?}");
    }
}

/// The middle of three points lies on the chord of the others, however the curve runs between them.
#[test]
fn three_points_of_a_step_are_not_taken_for_a_straight_line() {
    let text = "spring_stiffness_n_per_m = [1, 1e3, 1e6]\n\
        refine = { quantity = \"force_max\", to = 0.05 }";
    let (_, study, round) = refined(&file(text), |k| Some(force(k)));
    assert_eq!((round.points.len(), round.open), (0, 0));
    let values = stiffnesses(&study);
    for pair in values.windows(2) {
        let middle = 0.5 * (force(pair[0]) + force(pair[1]));
        let off = (middle - force((pair[0] * pair[1]).sqrt())).abs();
        assert!(off < 0.05, "{off} between {pair:?}");
    }
    // A line whose points differ little is not refined.
    let (refinement, study, _) = refined(&file(text), |k| Some(2.0 + 0.05 * libm::log10(k)));
    assert_eq!(refinement.count(&study), 0);
}

#[test]
fn the_grid_keeps_its_order_and_lines_do_not_mix() {
    let text = "wave_height_ratio = [0.3, 0.5]\nspring_stiffness_n_per_m = [10, 1e3, 1e5]\n\
        refine = { quantity = \"force_max\", to = 0.05 }";
    let (refinement, study, _) = refined(&file(text), |k| Some(force(k)));
    let plain = Study::new(&file(text)).unwrap();
    assert_eq!(study.identity, plain.identity);
    assert!(plain.cases.iter().all(|case| study.cases.iter().any(|one| one.id == case.id)));
    let half = study.cases.len() / 2;
    let waves =
        study.cases.iter().map(|case| case.config.scene.seawall().unwrap().wave_height_ratio);
    let waves: Vec<_> = waves.collect();
    // Two waves: the middle is added, because there is no third point. Both lines have the same
    // curvature.
    assert!(waves.windows(2).all(|pair| pair[0] <= pair[1]), "{waves:?}");
    assert!(waves.contains(&0.4) && half > 3);
    assert!(study.cases.iter().enumerate().all(|(at, case)| case.index == at));
    for case in study.cases.iter().filter(|case| !refinement.is_written(case, None)) {
        let away = (0..2).filter(|key| refinement.is_written(case, Some(*key)));
        assert_eq!(away.count(), 1, "on a line of the grid as written: {:?}", case.assignments);
    }
}

#[test]
fn rounds_are_found_again_from_what_is_known_of_them() {
    let text = "spring_stiffness_n_per_m = [1, 1e2, 1e4, 1e6]\n\
        refine = { quantity = \"force_max\", to = 0.01 }";
    let file = file(text);
    let (_, whole, _) = refined(&file, |k| Some(force(k)));
    let refinement = Refinement::of(&file).unwrap();
    // Half of the second round is missing, so the study is that of the second round, and waits.
    let known = |study: &Study| -> Vec<_> {
        let one = |case: &Case| {
            (case.id != whole.cases[3].id).then(|| record(study, case, |k| Some(force(k))))
        };
        study.cases.iter().map(one).collect()
    };
    let waiting = refinement.so_far(|study| Ok::<_, ConfigError>(known(study))).unwrap();
    assert!(waiting.cases.len() < whole.cases.len());
    assert!(waiting.cases.iter().any(|case| case.id == whole.cases[3].id));
    assert!(waiting.cases.iter().all(|case| whole.cases.iter().any(|one| one.id == case.id)));
}

#[test]
fn most_and_the_smallest_piece_bound_what_is_added() {
    let grid = "spring_stiffness_n_per_m = [1, 1e2, 1e4, 1e6]";
    let asked = |to: f64, most: u32| {
        file(&format!("{grid}\nrefine = {{ quantity = \"force_max\", to = {to}, most = {most} }}"))
    };
    let (refinement, study, round) = refined(&asked(1e-3, 5), |k| Some(force(k)));
    assert_eq!(refinement.count(&study), 5);
    assert!(round.points.is_empty() && round.open > 0 && round.worst.unwrap() > 1e-3);
    // A jump never becomes straight, so its interval is halved down to a 64th.
    let (refinement, study, round) =
        refined(&asked(0.01, 1000), |k| Some(if k < 2e3 { 1.0 } else { 3.0 }));
    assert!(round.open > 0 && refinement.count(&study) < 40, "{}", refinement.count(&study));
    let places: Vec<_> = stiffnesses(&study).iter().map(|k| libm::log10(*k)).collect();
    let least = places.windows(2).map(|p| p[1] - p[0]).fold(f64::INFINITY, f64::min);
    assert!((least - 2.0 / 64.0).abs() < 1e-9, "{least}");
}

#[test]
fn nothing_is_added_beside_a_case_that_failed() {
    let text = "spring_stiffness_n_per_m = [1, 1e2, 1e4, 1e6]\n\
        refine = { quantity = \"force_max\", to = 1e-9 }";
    let (refinement, study, round) = refined(&file(text), |k| (k < 1e5).then(|| force(k)));
    assert!(round.unknown >= 1 && refinement.count(&study) > 0);
    assert!(stiffnesses(&study).iter().all(|k| *k <= 1e4 || *k == 1e6));
    let name = SPRING_STIFFNESS.name;
    assert_eq!(study.keys, [name]);
}
