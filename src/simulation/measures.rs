//! Maxima of a run, of its first impact and of its first peak, gathered step by step.

use serde::{Deserialize, Serialize};

use super::blows::{Acoustics, Blows, Hit};
use super::first_impact::{FirstImpact, Reading};
use super::outcome::Maximum;
use super::pressed::Pressed;
use super::quiet_force::{Push, Quiet, QuietForce};
use super::quiet_travel::{Mount, QuietTravel};
use super::sound::Compression;
use super::waves::Waves;

/// Span of the force's running mean over √(h/g).
pub(super) const MEAN_SPAN: f64 = 0.07;

/// Maxima so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measures {
    quiet: QuietForce,
    travel: QuietTravel,
    /// Whether sound is taken off.
    listens: bool,
    /// The first impact.
    pub first: FirstImpact,
    /// Hits on the stop.
    pub blows: Blows,
    /// Over the whole run: F* (running mean without sound), R*, X*.
    pub force: Option<Maximum>,
    /// R*.
    pub runup: Option<Maximum>,
    /// X*.
    pub displacement: Option<Maximum>,
    /// Whether that X* was on a way out that began in the sound of a blow.
    pub kicked: bool,
    /// Largest F* of a single step in which no blow can be heard.
    pub force_raw: Option<f64>,
    /// The last reading's F*, R*, X*.
    pub last: [f64; 3],
    /// The wall's stops so far.
    stops: u32,
    /// Pressures along the wall and their moment.
    pub pressed: Pressed,
    /// Each wave of a train.
    pub waves: Option<Waves>,
}

impl Measures {
    /// For F_threshold over the hydrostatic force, the scales of the water, and so many points on the
    /// wall's face. The water's compression is told once in `turn` seconds, if at all.
    pub fn new(
        threshold_ratio: f64,
        acoustics: Acoustics,
        turn: Option<f64>,
        points: usize,
    ) -> Measures {
        let unit_time = (acoustics.depth / acoustics.gravity).sqrt();
        Measures {
            quiet: QuietForce::new(MEAN_SPAN * unit_time, turn),
            travel: QuietTravel::new(),
            listens: turn.is_some(),
            first: FirstImpact::new(threshold_ratio, unit_time),
            blows: Blows::new(acoustics),
            force: None,
            runup: None,
            displacement: None,
            kicked: false,
            force_raw: None,
            last: [0.0; 3],
            stops: 0,
            pressed: Pressed::new(points, MEAN_SPAN * unit_time),
            waves: None,
        }
    }

    /// Takes one step's readings, the water's compression where a turn of steps has ended, and what holds
    /// the wall. What a blow on the stop drowns of the force counts for nothing.
    pub fn push(
        &mut self,
        reading: Reading,
        compression: Option<Compression>,
        mount: Option<Mount>,
    ) {
        let Reading { time, force, runup, displacement, stops } = reading;
        let stopped = stops != self.stops;
        (self.last, self.stops) = ([force, runup, displacement], stops);
        Maximum::raise(&mut self.runup, runup, time);
        if let Some(waves) = &mut self.waves {
            waves.run_up(time, runup);
        }
        if stopped {
            self.follow(time, Push::default(), mount);
        }
        self.blows.follow(time, displacement);
        self.travel.push(time, displacement);
        let drowned = self.blows.drown(time);
        if drowned {
            self.quiet.clear();
            self.first.interrupt();
        } else {
            if self.blows.since_audible(time).is_none() {
                self.force_raw = Some(self.force_raw.map_or(force, |raw| raw.max(force)));
            }
            if let Some(quiet) = self.quiet.push((time, force), compression) {
                self.feel(quiet, mount);
            }
        }
        if drowned || !self.listens {
            self.follow(time, Push::default(), mount);
        }
        self.first.push_motion(&reading);
    }

    /// Takes a force without its sound, and the displacements until then.
    fn feel(&mut self, quiet: Quiet, mount: Option<Mount>) {
        let Quiet { time, force, sound } = quiet;
        self.follow(time, sound, mount);
        Maximum::raise(&mut self.force, force, time);
        self.first.push_force(time, force, self.stops);
        if let Some(waves) = &mut self.waves {
            waves.press(time, force);
        }
    }

    /// Takes the wall's displacements until then, s, while sound pushes it like this.
    fn follow(&mut self, until: f64, sound: Push, mount: Option<Mount>) {
        while let Some((at, displacement)) = self.travel.next(until, sound, mount) {
            let before = self.displacement;
            Maximum::raise(&mut self.displacement, displacement, at);
            if self.displacement != before {
                self.kicked = self.blows.kicked();
            }
            self.first.push_travel(displacement, at);
        }
    }

    /// Takes note that no reading follows.
    pub fn finish(&mut self, mount: Option<Mount>) {
        let mut rest = Vec::new();
        self.quiet.finish(|quiet| rest.push(quiet));
        rest.into_iter().for_each(|quiet| self.feel(quiet, mount));
        self.follow(f64::INFINITY, Push::default(), mount);
    }

    /// Takes the moment about the wall's foot, over ρgh³/6, and the pressures along its face, Pa, of the
    /// last step's reading.
    pub fn press(&mut self, time: f64, moment: f64, pressures: &[f64]) {
        if self.blows.drown(time) {
            self.pressed.interrupt();
        } else {
            self.pressed.push(time, moment, pressures, &self.first);
        }
    }

    /// Takes note that the wall hits its stop in the step of the last reading: it begins at `time`,
    /// lasts `dt`, s, and the wall comes with `speed`, m/s.
    pub fn hit(&mut self, time: f64, dt: f64, speed: f64) {
        let farthest = self.displacement.map_or(0.0, |farthest| farthest.value);
        self.blows.hit(Hit { time_s: time, dt, speed, runup: self.last[1] }, farthest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: Acoustics = Acoustics { depth: 0.2, gravity: 9.81, sound_speed: Some(11.2) };

    /// Feeds F*, R*, X* and the stops at a time, every millisecond.
    fn feed(threshold: f64, at: impl Fn(f64) -> ([f64; 3], u32)) -> Measures {
        let mut measures = Measures::new(threshold, WATER, None, 0);
        for k in 0..4000 {
            let time = 0.001 * f64::from(k);
            let ([force, runup, x], stops) = at(time);
            measures.push(Reading { time, force, runup, displacement: x, stops }, None, None);
        }
        measures
    }

    /// With R* = F* - 1.
    fn measure(force: impl Fn(f64) -> f64, x: impl Fn(f64) -> (f64, u32)) -> Measures {
        feed(1.1, |time| {
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
            let m = feed(threshold, |time| ([force(time), force(time) - 1.0, 0.0], 0));
            assert!((m.first.force().unwrap().value - 2.0).abs() < 2e-3, "{threshold}");
            assert!((m.force.unwrap().value - 2.5).abs() < 2e-3, "{threshold}");
            assert!((m.first.runup().unwrap().value - 1.0).abs() < 1e-6, "{threshold}");
            let onset = 1.0 - 0.2 * (-(threshold - 1.0).ln()).sqrt();
            assert!((m.first.onset().unwrap() - onset).abs() < 3e-3, "{threshold}");
        }
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

    /// F* that rises in noise of the given height and period, s, and falls again; R* is without noise.
    fn noisy(height: f64, period: f64) -> Measures {
        feed(1.1, |time| {
            let water = bell(time, 1.5, 2.0);
            let noise = height * (std::f64::consts::TAU * time / period).sin();
            ([1.0 + water + noise, 0.5 * water, 0.0], 0)
        })
    }

    #[test]
    fn a_blip_neither_opens_nor_closes_the_first_impact() {
        let measures = feed(1.1, |time| {
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

    /// A wall that comes back at 1.5 s with `speed`, m/s, in F* = 1 + a bell, and what it meets then:
    /// suction and a rebound to F* = 4, told to be sound or not.
    fn struck(farthest: f64, speed: f64) -> Measures {
        let mut measures = Measures::new(1.1, WATER, None, 0);
        for k in 0..4000 {
            let time = 0.001 * f64::from(k);
            let displacement = if (0.8..1.5).contains(&time) { farthest } else { 0.0 };
            let sound = match time - 1.5 {
                since if since < 0.0 => 0.0,
                since => 5.0 * (-30.0 * since).exp() * -(90.0 * since).cos(),
            };
            let force = 1.0 + bell(time, 1.0, 1.0) + sound;
            let stops = u32::from(time >= 1.5);
            measures.push(Reading { time, force, runup: 0.0, displacement, stops }, None, None);
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
        // The same readings: a stiff wall, and one that comes slowly.
        for (farthest, speed) in [(0.009, 0.3), (0.5, 0.01)] {
            let m = struck(farthest, speed);
            assert!(m.force.unwrap().value > 2.2 && m.force_raw.unwrap() > 2.5, "{m:?}");
        }
    }
}
