//! Whether anything touches a quoted number, so that its history should be looked at first.

use super::blows::Blows;
use super::face_gaps::FaceGaps;
use super::outcome::{Maximum, Outcome};

/// A gap of force above this, percent, is doubtful where a largest force is.
const FORCE_GAP_PERCENT: f64 = 1.5;
/// So is one of energy above this, percent, either way.
const ENERGY_GAP_PERCENT: f64 = 3.0;
/// So is energy from nowhere above this, percent of the paddle's work.
const FOUND_PERCENT: f64 = 1.0;
/// And water at the foot of the wall that its own weight makes denser by more than this, percent.
const COMPRESSION_PERCENT: f64 = 6.0;

/// What a finished case is judged by, besides its outcome.
pub(super) struct Evidence<'a> {
    /// The two ways to read the force.
    pub gaps: &'a FaceGaps,
    /// Hits on the stop.
    pub blows: &'a Blows,
    /// Whether the largest X* is of a way out that began in the sound of a blow.
    pub kicked: bool,
    /// Most energy that has come from nowhere, percent of the paddle's work.
    pub found_percent: f64,
    /// g h/c0², percent; zero where the water is incompressible.
    pub compression_percent: f64,
}

impl Evidence<'_> {
    /// Why the case is doubtful, if it is.
    pub fn doubt(&self, outcome: &Outcome) -> Option<String> {
        let mut reasons = Vec::new();
        let forces =
            [("force_max", Some(outcome.force_max)), ("first_force_max", outcome.first_force_max)];
        let others = [
            ("runup_max", Some(outcome.runup_max)),
            ("displacement_max", outcome.displacement_max),
            ("first_runup_max", outcome.first_runup_max),
            ("first_displacement_max", outcome.first_displacement_max),
        ];
        for (name, maximum) in told(forces) {
            let gap = self.gaps.around(maximum.time_s);
            if gap.abs() > FORCE_GAP_PERCENT {
                reasons.push(format!("{name}: the pressure on the face is {gap:+.1} % off"));
            }
        }
        let gap = outcome.energy_gap_percent;
        if gap.abs() > ENERGY_GAP_PERCENT {
            reasons.push(format!("energy gap {gap:+.1} %"));
        } else if self.found_percent > FOUND_PERCENT {
            let found = self.found_percent;
            reasons.push(format!("{found:.1} % of the paddle's work came from nowhere"));
        }
        let compression = self.compression_percent * (1.0 + outcome.runup_max.value);
        if compression > COMPRESSION_PERCENT {
            reasons.push(format!("the water is compressed by {compression:.1} %"));
        }
        for (name, maximum) in told(forces).chain(told(others)) {
            if let Some(since) = self.blows.since_audible(maximum.time_s) {
                reasons
                    .push(format!("{name}: {since:.3} s after a blow on the stop, in its sound"));
            }
        }
        let heard = |maximum: Maximum| self.blows.since_audible(maximum.time_s).is_some();
        if self.kicked && !outcome.displacement_max.is_some_and(heard) {
            reasons.push("displacement_max: the sound of a stop set the wall off".to_owned());
        }
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }
}

fn told<const N: usize>(
    maxima: [(&'static str, Option<Maximum>); N],
) -> impl Iterator<Item = (&'static str, Maximum)> {
    maxima.into_iter().filter_map(|(name, maximum)| Some((name, maximum?)))
}

#[cfg(test)]
mod tests {
    use super::super::blows::{Acoustics, Hit};
    use super::super::outcome::Maximum;
    use super::*;

    fn at(value: f64, time_s: f64) -> Maximum {
        Maximum { value, time_s }
    }

    /// F* = 2 at 1 s, R* = 0.5 at 1.1 s, X* = 0.8 at 1.5 s; a weaker load at 2.5 s.
    fn outcome() -> Outcome {
        Outcome {
            force_max: at(2.0, 1.0),
            runup_max: at(0.5, 1.1),
            displacement_max: Some(at(0.8, 1.5)),
            first_force_max: Some(at(2.0, 1.0)),
            first_runup_max: Some(at(0.5, 1.1)),
            first_displacement_max: Some(at(0.8, 1.5)),
            force_gap_percent: 60.0,
            energy_gap_percent: 1.0,
            ..Outcome::default()
        }
    }

    /// What a sound case leaves, with a void of a share of the force in a stretch of time, s.
    fn doubt(
        outcome: &Outcome,
        [from, to]: [f64; 2],
        void: f64,
        change: impl Fn(&mut Evidence<'_>),
    ) -> Option<String> {
        let mut gaps = FaceGaps::new(0.1428);
        for k in 0..800 {
            let time = 0.005 * f64::from(k);
            let lost = if (from..to).contains(&time) { void } else { 0.0 };
            gaps.push(time, [1.046 * (1.0 - lost), 1.0]);
        }
        let water = Acoustics { depth: 0.2, gravity: 9.81, sound_speed: Some(11.2) };
        let mut blows = Blows::new(water);
        blows.hit(Hit { time_s: 2.0, dt: 0.001, speed: 0.3, runup: 0.0 }, 0.8);
        let mut evidence = Evidence {
            gaps: &gaps,
            blows: &blows,
            kicked: false,
            found_percent: 0.1,
            compression_percent: 1.6,
        };
        change(&mut evidence);
        evidence.doubt(outcome)
    }

    #[test]
    fn a_gap_counts_where_a_quoted_force_is_and_nowhere_else() {
        assert_eq!(doubt(&outcome(), [2.0, 2.3], 0.6, |_| ()), None, "after a stop");
        let told = doubt(&outcome(), [0.9, 1.1], 0.06, |_| ()).unwrap();
        assert!(told.contains("force_max: ") && told.contains("first_force_max: "), "{told}");
        assert!(told.contains("-6.0 %"), "{told}");
    }

    #[test]
    fn energy_counts_on_either_side() {
        let with = |energy_gap_percent| {
            let outcome = Outcome { energy_gap_percent, ..outcome() };
            doubt(&outcome, [0.0, 0.0], 0.0, |_| ())
        };
        assert_eq!(with(2.9), None);
        assert_eq!(with(3.1).unwrap(), "energy gap +3.1 %");
        assert_eq!(with(-15.2).unwrap(), "energy gap -15.2 %");
        let found = doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.found_percent = 1.1).unwrap();
        assert!(found.contains("came from nowhere"), "{found}");
    }

    #[test]
    fn soft_water_is_doubtful() {
        let with = |ratio: f64| {
            doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.compression_percent = 100.0 / ratio.powi(2))
        };
        assert_eq!((with(8.0), with(7.0)), (None, None));
        assert!(with(4.0).unwrap().contains("compressed by 9.4 %"));
    }

    #[test]
    fn a_maximum_in_the_sound_of_a_blow_is_named() {
        let late = Outcome { force_max: at(2.3, 2.15), ..outcome() };
        let told = doubt(&late, [0.0, 0.0], 0.0, |_| ()).unwrap();
        assert_eq!(told, "force_max: 0.149 s after a blow on the stop, in its sound");
        let later = Outcome { force_max: at(2.3, 2.4), ..outcome() };
        assert_eq!(doubt(&later, [0.0, 0.0], 0.0, |_| ()), None);
        let kicked = doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.kicked = true).unwrap();
        assert!(kicked.starts_with("displacement_max"), "{kicked}");
    }
}
