//! Readings of walls on stiff springs in incompressible water.

use super::*;
use crate::body::Restraint;

/// A wall of 50 kg/m on 1e6 N/m leaves its stop at 0.7 s and swings as it follows the wave. Its period is 1.15 times that
/// in still water.
#[test]
fn the_swing_of_a_stiff_spring_is_no_maximum() {
    let held = Restraint { threshold: 0.0, mass: 50.0, stiffness: 1e6 };
    let mount = Mount::new(&held, 0.2, 9.81, 196.2, 11.2);
    let told = |smooth: bool, swing: f64| {
        let mut measures = Measures::new([1.1; 2], WATER, None, 3);
        if smooth {
            measures.smooth(0.1428);
        }
        for k in 0..2500 {
            let time = 0.001 * f64::from(k);
            let swings = (time - 0.7).clamp(0.0, 0.2) / 0.2 * swing;
            let press = bell(time, 1.2, 2.0) + swings * (103.0 * time).sin();
            let displacement = if time < 0.7 { 0.0 } else { 1e-3 * press };
            let force = 1.0 + press;
            let reading = StepReading { time, force, runup: 0.0, displacement, stops: 0 };
            measures.push(reading, None, mount);
            measures.press(time, press, &[press; 3]);
        }
        measures.finish(mount);
        let pressures = measures.pressed.envelope(&[0.05, 0.1, 0.15], &measures.first);
        let force = measures.first.force().unwrap().value - 1.0;
        let displacement = 1e3 * measures.displacement.unwrap().value;
        [
            force,
            displacement,
            measures.pressed.moment().unwrap().value,
            pressures[1].pressure_max_pa,
        ]
    };
    for value in told(false, 0.1) {
        assert!(value > 2.05, "{value}");
    }
    for swing in [0.0, 0.1] {
        for value in told(true, swing) {
            assert!((value - 2.0).abs() < 0.01, "{swing}: {value}");
        }
    }
}

/// What a wall feels before it hits its stop counts, if less smoothly.
#[test]
fn smooth_readings_reach_up_to_a_stop() {
    let held = Restraint { threshold: 0.0, mass: 5.0, stiffness: 1e5 };
    let mount = Mount::new(&held, 0.2, 9.81, 196.2, 11.2);
    let mut measures = Measures::new([1.1; 2], WATER, None, 0);
    measures.smooth(0.1428);
    for k in 0..1000 {
        let time = 0.001 * f64::from(k);
        let press = if time < 0.5 { 4.0 * time } else { 0.0 };
        let stops = u32::from(time >= 0.5);
        let (force, displacement) = (1.0 + press, 0.02 * press);
        measures.push(StepReading { time, force, runup: 0.0, displacement, stops }, None, mount);
    }
    assert!(measures.first.force().unwrap().value > 2.97);
    assert!(measures.displacement.unwrap().value > 0.0395);
}
