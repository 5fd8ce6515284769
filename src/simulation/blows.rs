//! Impacts of the wall on its stop, and the sound that they make.

use serde::{Deserialize, Serialize};

use super::outcome::Maximum;
use crate::theory::wall_potential::CARRIED;

/// A weaker impact, over ½ρgd² √(h/g), is a touch: its sound is too faint to matter.
const WEAKEST: f64 = 0.02;
/// The wall must have been this far from its stop, over h, for a real impact.
const LEAST_TRAVEL: f64 = 0.01;
/// For this time, over d/c0, the sound is too loud for any reading of the force. This is one and a
/// half periods of the slowest mode of water of the depth d, and includes the first two rebounds.
const LOUD: f64 = 6.0;
/// It can still be heard for this long, over d/c0: three periods.
const AUDIBLE: f64 = 12.0;
/// Steps that an impact takes in water without sound.
const STEPS: f64 = 4.5;

/// Scales of an impact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Acoustics {
    /// Depth h of the still water at the paddle, metres.
    pub depth: f64,
    /// Its depth d at the wall, metres.
    pub depth_at_wall: f64,
    /// Gravity g, m/s².
    pub gravity: f64,
    /// c0, m/s; none where the water is incompressible.
    pub sound_speed: Option<f64>,
}

/// One hit on the stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Time at which the step of the impact begins, seconds.
    pub time_s: f64,
    /// Length of that step, seconds.
    pub dt: f64,
    /// Speed of the wall, m/s.
    pub speed: f64,
    /// R* at the wall then.
    pub runup: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Blow {
    time_s: f64,
    loud_until_s: f64,
    audible_until_s: f64,
}

/// All hits so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Blows {
    acoustics: Acoustics,
    blows: Vec<Blow>,
    /// The strongest impulse and its time; touches are included.
    strongest: Option<Maximum>,
    /// Whether the wall left its stop while an impact could be heard.
    kicked: bool,
    /// Whether X* is above zero.
    away: bool,
}

impl Blows {
    /// No impacts yet.
    pub fn new(acoustics: Acoustics) -> Blows {
        Blows { acoustics, blows: Vec::new(), strongest: None, kicked: false, away: false }
    }

    /// Records an impact of a wall whose largest X* so far is `farthest`.
    ///
    /// The water goes on when the wall stops. Its impulse on the wall is -m_a V with m_a = 0.543 ρ
    /// (d + R)².
    pub fn hit(&mut self, hit: Hit, farthest: f64) {
        let Acoustics { depth, depth_at_wall, gravity, sound_speed } = self.acoustics;
        // The water's depth at the wall now, over d.
        let relative_depth = (1.0 + hit.runup * (depth / depth_at_wall)).max(0.0);
        let wave_speed = (gravity * depth).sqrt();
        let impulse = -2.0 * CARRIED * relative_depth * relative_depth * hit.speed / wave_speed;
        let time_s = hit.time_s + hit.dt;
        if self.strongest.is_none_or(|strongest| impulse < strongest.value) {
            self.strongest = Some(Maximum { value: impulse, time_s });
        }
        if farthest > LEAST_TRAVEL && impulse <= -WEAKEST {
            let crossing = sound_speed.map_or(0.0, |speed| relative_depth * depth_at_wall / speed);
            let steps = hit.time_s + STEPS * hit.dt;
            let before = self.blows.last().map_or(0.0, |blow| blow.loud_until_s);
            self.blows.push(Blow {
                time_s,
                loud_until_s: steps.max(time_s + LOUD * crossing).max(before),
                audible_until_s: steps.max(time_s + AUDIBLE * crossing),
            });
        }
    }

    /// Follows the wall, at X* = `displacement`; `time` in seconds.
    pub fn follow(&mut self, time: f64, displacement: f64) {
        let away = displacement > 0.0;
        if away && !self.away {
            self.kicked = self.since_audible(time).is_some();
        }
        self.away = away;
    }

    /// Whether the sound of an impact hides the force at a time, seconds, which must not be before
    /// the last impact.
    pub fn drown(&self, time: f64) -> bool {
        self.blows.last().is_some_and(|blow| time < blow.loud_until_s)
    }

    /// Seconds since an impact that can still be heard at a time, if any.
    pub fn since_audible(&self, time: f64) -> Option<f64> {
        let heard = |blow: &&Blow| time > blow.time_s && time < blow.audible_until_s;
        self.blows.iter().rfind(heard).map(|blow| time - blow.time_s)
    }

    /// Whether the wall left its stop, this time, while an impact could be heard.
    pub fn kicked(&self) -> bool {
        self.kicked
    }

    /// Strongest impulse of the water on the wall, over ½ρgd² √(h/g), and its time.
    pub fn strongest(&self) -> Option<Maximum> {
        self.strongest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: Acoustics =
        Acoustics { depth: 0.2, depth_at_wall: 0.2, gravity: 9.81, sound_speed: Some(11.2) };

    fn hit(speed: f64) -> Hit {
        Hit { time_s: 1.0, dt: 0.001, speed, runup: 0.25 }
    }

    #[test]
    fn a_blow_is_its_speed_times_the_added_mass() {
        for sound_speed in [Some(11.2), Some(33.6), None] {
            let mut blows = Blows::new(Acoustics { sound_speed, ..WATER });
            blows.hit(hit(0.3), 0.5);
            let added_mass = 0.543 * 1000.0 * 0.25_f64.powi(2);
            let unit = 0.5 * 1000.0 * 9.81 * 0.04 * (0.2_f64 / 9.81).sqrt();
            let expected = -added_mass * 0.3 / unit;
            assert!((blows.strongest().unwrap().value - expected).abs() < 1e-12);
        }
    }

    /// The story: over a bed of half the depth a wave of R* = 0.25 is half as deep again at the wall.
    /// The impulse was that of a quarter more, 16 % too small and more.
    #[test]
    fn over_a_bed_the_added_mass_is_that_of_the_water_at_the_wall() {
        let mut blows = Blows::new(Acoustics { depth_at_wall: 0.1, ..WATER });
        blows.hit(hit(0.3), 0.5);
        let added_mass = 0.543 * 1000.0 * 0.15_f64.powi(2);
        let unit = 0.5 * 1000.0 * 9.81 * 0.01 * (0.2_f64 / 9.81).sqrt();
        let expected = -added_mass * 0.3 / unit;
        assert!((blows.strongest().unwrap().value - expected).abs() < 1e-12);
        let crossing = 0.15 / 11.2;
        assert!(blows.drown(1.001 + 5.99 * crossing) && !blows.drown(1.001 + 6.01 * crossing));
    }

    #[test]
    fn its_sound_lasts_as_long_as_the_depth_and_the_speed_of_sound_say() {
        let mut blows = Blows::new(WATER);
        blows.hit(hit(0.3), 0.5);
        let crossing = 0.25 / 11.2;
        assert!(blows.drown(1.001 + 5.99 * crossing) && !blows.drown(1.001 + 6.01 * crossing));
        assert!(blows.since_audible(1.001 + 11.9 * crossing).is_some());
        assert!(blows.since_audible(1.001 + 12.1 * crossing).is_none());
        assert!(blows.since_audible(0.99).is_none(), "before the blow");
        let mut still = Blows::new(Acoustics { sound_speed: None, ..WATER });
        still.hit(hit(0.3), 0.5);
        assert!(still.drown(1.004) && !still.drown(1.005));
    }

    #[test]
    fn a_touch_is_no_blow() {
        for (speed, farthest) in [(0.01, 0.5), (0.3, 0.009)] {
            let mut blows = Blows::new(WATER);
            blows.hit(hit(speed), farthest);
            assert!(!blows.drown(1.002) && blows.strongest().is_some());
        }
    }

    #[test]
    fn a_wall_that_leaves_in_the_sound_of_a_blow_is_kicked() {
        let mut blows = Blows::new(WATER);
        for (time, displacement, kicked) in
            [(0.5, 0.1, false), (1.0, 0.0, false), (1.02, 0.01, true), (2.0, 0.2, true)]
        {
            blows.follow(time, displacement);
            assert_eq!(blows.kicked(), kicked, "{time}");
            if displacement == 0.0 {
                blows.hit(hit(0.3), 0.5);
            }
        }
        blows.follow(2.5, 0.0);
        blows.follow(3.0, 0.1);
        assert!(!blows.kicked());
    }
}
