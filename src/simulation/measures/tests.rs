use super::*;

const WATER: Acoustics =
    Acoustics { depth: 0.2, depth_at_wall: 0.2, gravity: 9.81, sound_speed: Some(11.2) };

/// Feeds F*, R*, X* and the stops at a time, every millisecond.
fn feed(thresholds: [f64; 2], at: impl Fn(f64) -> ([f64; 3], u32)) -> Measures {
    let mut measures = Measures::new(thresholds, WATER, None, 0);
    for k in 0..4000 {
        let time = 0.001 * f64::from(k);
        let ([force, runup, x], stops) = at(time);
        measures.push(StepReading { time, force, runup, displacement: x, stops }, None, None);
    }
    measures
}

/// With R* = F* - 1.
fn measure(force: impl Fn(f64) -> f64, x: impl Fn(f64) -> (f64, u32)) -> Measures {
    feed([1.1; 2], |time| {
        let (force, (x, stops)) = (force(time), x(time));
        ([force, force - 1.0, x], stops)
    })
}

fn bell(time: f64, centre: f64, height: f64) -> f64 {
    height * (-((time - centre) / 0.2).powi(2)).exp()
}

#[test]
fn the_first_impact_ends_when_the_force_stays_low_whatever_the_threshold() {
    for threshold in [1.02, 1.1, 1.15, 1.2, 1.7] {
        let force = |time| 1.0 + bell(time, 1.0, 1.0) + bell(time, 3.0, 1.5);
        let m = feed([threshold; 2], |time| ([force(time), force(time) - 1.0, 0.0], 0));
        assert!((m.first.force().unwrap().value - 2.0).abs() < 2e-3, "{threshold}");
        assert!((m.force.unwrap().value - 2.5).abs() < 2e-3, "{threshold}");
        assert!((m.first.runup().unwrap().value - 1.0).abs() < 1e-6, "{threshold}");
        let onset = 1.0 - 0.2 * (-(threshold - 1.0).ln()).sqrt();
        assert!((m.first.onset().unwrap() - onset).abs() < 3e-3, "{threshold}");
    }
}

#[test]
fn a_caisson_that_holds_has_its_first_impact_all_the_same() {
    let force = |time| 1.0 + bell(time, 1.0, 1.0) + bell(time, 3.0, 1.5);
    let told =
        |threshold| feed([threshold, 1.1], |time| ([force(time), force(time) - 1.0, 0.0], 0)).first;
    let (held, usual) = (told(3.0), told(1.1));
    assert_eq!(held.onset(), None);
    assert_eq!([held.force(), held.runup()], [usual.force(), usual.runup()]);
    assert_eq!([held.impulse(), held.rise_time()], [usual.impulse(), usual.rise_time()]);
    assert!(held.force().is_some() && held.rise_time().is_some());
}

#[test]
fn a_stop_after_real_travel_ends_it_and_a_touch_does_not() {
    let force = |t: f64| 1.0 + bell(t, 1.0, 1.0) + bell(t, 1.6, 1.5);
    let touched = measure(force, |t| (1e-4, u32::from(t > 0.9)));
    assert!(touched.first.force().unwrap().value > 2.4);
    let stopped = measure(force, |t| (0.3, u32::from(t > 1.25)));
    assert!(stopped.first.force().unwrap().value < 2.2);
}

#[test]
fn the_first_peak_is_closed_by_a_ten_percent_drop() {
    let m = measure(|t| 1.0 + bell(t, 1.0, 1.0) + bell(t, 1.5, 1.5), |_| (0.0, 0));
    assert!(m.first.force().unwrap().value > 2.4);
    assert!(m.first.force_peak().unwrap() < 2.1);
    assert!(m.first.runup_peak().unwrap() < 1.1);
}

#[test]
fn sound_is_not_water() {
    let m = measure(|t| 1.0 + 0.3 * (t * 700.0).sin(), |_| (0.0, 0));
    assert!(m.first.onset().is_none() && m.first.force().is_none());
    assert!(m.force_raw.unwrap() > 1.29 && m.force.unwrap().value < 1.12);
}

/// F* that rises with noise of this height and period, s, and falls again. R* has no noise.
fn noisy(height: f64, period: f64) -> Measures {
    feed([1.1; 2], |time| {
        let water = bell(time, 1.5, 2.0);
        let noise = height * (std::f64::consts::TAU * time / period).sin();
        ([1.0 + water + noise, 0.5 * water, 0.0], 0)
    })
}

#[test]
fn a_blip_neither_opens_nor_closes_the_first_impact() {
    let measures = feed([1.1; 2], |time| {
        let (blip, water) = (0.4 * bell(time / 0.05, 0.5 / 0.05, 1.0), bell(time, 2.0, 1.5));
        ([1.0 + blip + water, water + 0.3 * blip, 0.0], 0)
    });
    assert!((measures.first.force().unwrap().value - 2.5).abs() < 2e-3);
    assert!((measures.first.runup().unwrap().value - 1.5).abs() < 1e-3);
    assert!(measures.first.force_peak().unwrap() > 2.49);
}

#[test]
fn a_blip_alone_is_no_impact() {
    let m = measure(|t| 1.0 + 0.4 * bell(t / 0.05, 0.5 / 0.05, 1.0), |_| (0.0, 0));
    assert!(m.force.unwrap().value > 1.15);
    assert!(m.first.force().is_none() && m.first.force_peak().is_none());
    assert!(!m.first.is_under_way());
}

#[test]
fn noise_in_the_midst_of_a_rise_does_not_end_the_first_impact() {
    for period in [0.05, 0.07, 0.1, 0.15] {
        let (m, quiet) = (noisy(0.5, period), noisy(0.0, period));
        let quiet = quiet.first.runup().unwrap().value;
        assert!((m.first.runup().unwrap().value - quiet).abs() < 1e-9, "{period}");
        assert!(m.first.force().unwrap().value > 2.9, "{period}");
    }
}

/// A wall that comes back at 1.5 s at `speed`, m/s, with F* = 1 + a bell. Then there is suction and
/// a rebound to F* = 4, which may or may not count as sound.
fn struck(farthest: f64, speed: f64) -> Measures {
    let mut measures = Measures::new([1.1; 2], WATER, None, 0);
    for k in 0..4000 {
        let time = 0.001 * f64::from(k);
        let displacement = if (0.8..1.5).contains(&time) { farthest } else { 0.0 };
        let sound = match time - 1.5 {
            since if since < 0.0 => 0.0,
            since => 5.0 * (-30.0 * since).exp() * -(90.0 * since).cos(),
        };
        let force = 1.0 + bell(time, 1.0, 1.0) + sound;
        let stops = u32::from(time >= 1.5);
        measures.push(StepReading { time, force, runup: 0.0, displacement, stops }, None, None);
        if k == 1499 {
            measures.hit(time, 0.001, speed);
        }
    }
    measures
}

#[test]
fn the_sound_of_a_blow_is_in_no_maximum_of_the_force() {
    let m = struck(0.5, 0.3);
    for force in [m.force, m.first.force()] {
        assert!((force.unwrap().value - 2.0).abs() < 2e-3, "{force:?}");
    }
    assert!((m.force_raw.unwrap() - 2.0).abs() < 2e-3);
    assert!(m.blows.strongest().unwrap().value < -0.2);
}

#[test]
fn touches_leave_the_maxima_of_the_force_alone() {
    // The same readings for a stiff wall, and for a slow one.
    for (farthest, speed) in [(0.009, 0.3), (0.5, 0.01)] {
        let m = struck(farthest, speed);
        assert!(m.force.unwrap().value > 2.2 && m.force_raw.unwrap() > 2.5, "{m:?}");
    }
}

/// Where sound is removed, the mean comes late. A stop once removed the last 0.03 s of the impulse,
/// up to 2.3 %.
#[test]
fn an_impulse_reaches_up_to_the_blow_that_ends_it() {
    let force = |time: f64| 1.0 + bell(time, 1.0, 1.0);
    for turn in [None, Some(0.003)] {
        let mut measures = Measures::new([1.1; 2], WATER, turn, 0);
        for k in 0..2000 {
            let (time, stopped) = (0.001 * f64::from(k), k > 1250);
            let displacement = if stopped { 0.0 } else { 0.3 };
            let (force, stops) = (force(time), u32::from(stopped));
            let reading = StepReading { time, force, runup: 0.2, displacement, stops };
            measures.push(reading, None, None);
            if k == 1250 {
                measures.hit(time, 0.001, 0.5);
            }
        }
        let within = (0..=1250).map(|k| force(0.001 * f64::from(k))).filter(|force| *force > 1.15);
        let whole = within.map(|force| 0.001 * (force - 1.0)).sum::<f64>();
        let told = measures.first.impulse().unwrap();
        assert!((told / whole - 1.0).abs() < 0.01, "{turn:?}: {told} of {whole}");
    }
}

/// The story: a caisson slid 0.05 h towards the water. It was told not to have moved.
#[test]
fn a_wall_that_nothing_drives_back_goes_to_either_side() {
    let m = measure(|t| 1.0 + bell(t, 1.0, 1.0), |t| (-bell(t, 2.0, 0.05), 0));
    let farthest = m.displacement.unwrap();
    assert!((farthest.value - 0.05).abs() < 1e-5 && (farthest.time_s - 2.0).abs() < 2e-3);
}

/// The story: a caisson broke loose at F* = 2.5. Its largest force was told as 2.46, as the mean
/// over time went across the fall behind.
#[test]
fn a_wall_that_breaks_loose_has_borne_its_limit() {
    let rises = |time: f64| 1.0 + 15.0 * (time - 0.9).max(0.0);
    let slides = |time| ([if time < 1.0 { rises(time) } else { 2.0 }, 0.5, 0.0], 0);
    let told = |step: Option<(&WallStep, bool)>| {
        let mut measures = Measures::new([2.5, 1.1], WATER, None, 0);
        for k in 0..2000 {
            let time = 0.001 * f64::from(k);
            let ([force, runup, displacement], stops) = slides(time);
            measures.push(StepReading { time, force, runup, displacement, stops }, None, None);
            if let (1000, Some((step, rested))) = (k, step) {
                measures.note(time, 0.001, step, rested);
            }
        }
        [measures.force, measures.first.force()].map(|force| force.unwrap().value)
    };
    let step = WallStep { travel: 1e-6, jumps: true, ..WallStep::default() };
    let back = WallStep { travel: -1e-6, ..step };
    assert!(told(None)[0] < 2.49);
    assert_eq!(told(Some((&step, true))), [2.5; 2]);
    for other in [(&back, true), (&step, false)] {
        assert_eq!(told(Some(other)), told(None), "towards the water, or as it turns round");
    }
}
