use super::*;

const HEIGHTS: [f64; 4] = [0.025, 0.075, 0.125, 0.175];

#[test]
fn a_triangle_acts_at_a_third_of_its_height() {
    let rows = 200;
    let apart = 0.2 / f64::from(rows);
    let along = (0..rows).map(|row| (f64::from(row) + 0.5) * apart);
    let pressures: Vec<f64> = along.clone().map(|y| 9810.0 * (0.2 - y)).collect();
    let lever = Lever::of(&pressures, along, None);
    assert!((lever.arm / (0.2 / 3.0) - 1.0).abs() < 1e-4, "{lever:?}");
    assert!((lever.force / 196.2 - 1.0).abs() < 1e-12, "{lever:?}");
    assert_eq!(Lever::of(&[0.0; 4], HEIGHTS.into_iter(), None), Lever::default());
}

/// The story: a crest that took one row of particles more made the moment of the same water 6 %
/// larger.
#[test]
fn the_last_row_presses_as_far_as_the_wall_goes() {
    let apart = 0.02;
    let lever = |height: f64| {
        let rows = (height / apart).round() as usize;
        let along = (0..rows).map(|row| (row as f64 + 0.5) * apart);
        let pressures: Vec<f64> = along.clone().map(|y| 9810.0 * (0.3 - y)).collect();
        Lever::of(&pressures, along, Some(height))
    };
    for height in [0.221, 0.2299, 0.2301, 0.239, 0.24] {
        let force = 9810.0 * (0.3 - 0.5 * height) * height;
        let moment = 9810.0 * (0.15 - height / 3.0) * height * height;
        let told = lever(height);
        assert!((told.force / force - 1.0).abs() < 0.002, "{height}: {told:?}");
        assert!((told.force * told.arm / moment - 1.0).abs() < 0.01, "{height}: {told:?}");
    }
}

/// A pulse that runs up the wall, with sound that a mean removes.
fn pressures(time: f64) -> [f64; 4] {
    HEIGHTS.map(|y| {
        let bell = (-((time - 1.0 - y) / 0.1).powi(2)).exp();
        1000.0 * bell + 50.0 * (time * std::f64::consts::TAU / 0.011).sin()
    })
}

fn pressed() -> (Pressed, FirstImpact) {
    let (mut pressed, mut first) = (Pressed::new(4, 0.01), FirstImpact::new([1.1; 2], 0.1428));
    for step in 0..3000 {
        let time = 0.001 * f64::from(step);
        let pressures = pressures(time);
        let sum = pressures.iter().sum::<f64>();
        if time > 0.005 {
            first.push_force(time - 0.005, 1.0 + 5e-4 * sum, 0);
        }
        pressed.push(time, 1e-3 * sum, &pressures, (&first, false));
    }
    (pressed, first)
}

#[test]
fn the_envelope_holds_at_least_what_was_there_at_once() {
    let (pressed, first) = pressed();
    let envelope = pressed.envelope(&HEIGHTS, &first);
    assert_eq!(envelope.len(), 4);
    let sum: f64 = envelope.iter().map(|row| row.pressure_max_pa).sum();
    let at_once = 1e3 * pressed.moment().unwrap().value;
    assert!(sum >= at_once && sum < 1.5 * at_once, "{sum} against {at_once}");
    for row in envelope {
        assert!((row.pressure_max_pa / 1000.0 - 1.0).abs() < 0.03, "{row:?}");
        assert_eq!(row.first_pressure_max_pa, Some(row.pressure_max_pa));
    }
    assert_eq!(pressed.first_moment(&first), pressed.moment());
}

#[test]
fn a_dry_wall_has_no_envelope_and_still_water_no_first_impact() {
    let (dry, none) = (Pressed::new(4, 0.01), FirstImpact::new([1.1; 2], 0.1428));
    assert!(dry.envelope(&HEIGHTS, &none).is_empty());
    let mut still = Pressed::new(4, 0.01);
    (0..50)
        .for_each(|k| still.push(0.001 * f64::from(k), 1.0, &[3.0, 2.0, 1.0, 0.0], (&none, false)));
    let rows = still.envelope(&HEIGHTS, &none);
    assert_eq!((rows.len(), rows[0].first_pressure_max_pa), (3, None));
    assert_eq!(rows[2].pressure_max_pa, 1.0);
}
