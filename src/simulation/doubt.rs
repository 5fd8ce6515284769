//! Whether anything touches a quoted number, so that its history should be looked at first.

use super::blows::Blows;
use super::face_gaps::FaceGaps;
use super::found::Found;
use super::health::LASTING_GAP;
use super::outcome::{Maximum, Outcome};
use super::quoted::{forces, others};

/// A gap of force above this, percent, is doubtful where a largest force is ...
const FORCE_GAP_PERCENT: f64 = 1.5;
/// ... and above so many times (Δx/h)², percent, where that is more: with fewer than ten rows of particles.
const FORCE_GAP_OF_SPACING: f64 = 150.0;
/// A gap of energy above this, percent, either way, is doubtful.
const ENERGY_GAP_PERCENT: f64 = 3.0;
/// So is energy from nowhere above this, percent of the paddle's work, at any look ...
const FOUND_PERCENT: f64 = 1.0;
/// ... and, until the first impact's largest force, above so many times (Δx/h)², percent. The scheme is
/// of second order: until then sound runs find up to 66 of it at 16 mm and 86 at 25 mm, those of a
/// Courant number of 2.5 170 and more at 16 mm and 186 and more at 8 mm.
const FOUND_OF_SPACING: f64 = 125.0;
/// And water at the foot of the wall that its own weight makes denser by more than this, percent.
const COMPRESSION_PERCENT: f64 = 6.0;
/// Still water presses wall and paddle alike: of sound ghosts within so many times (Δx/h)².
const LOPSIDED_OF_SPACING: f64 = 0.1;

/// What a finished case is judged by, besides its outcome.
pub(super) struct Evidence<'a> {
    /// The two ways to read the force.
    pub gaps: &'a FaceGaps,
    /// The largest mean of their gap over some ten looks, over the larger of the force and the hydrostatic one.
    pub largest_gap: f64,
    /// Hits on the stop.
    pub blows: &'a Blows,
    /// Whether the largest X* is of a way out that began in the sound of a blow.
    pub kicked: bool,
    /// Energy that has come from nowhere.
    pub found: &'a Found,
    /// What it is counted in, the paddle's work as a rule, J per metre of width.
    pub work: f64,
    /// Δx/h.
    pub spacing: f64,
    /// Whether a paddle makes a wave.
    pub is_wave: bool,
    /// How much more the wall was pressed than the paddle at rest, over ρgh²/2, where both are alike.
    pub lopsided: Option<f64>,
    /// g h/c0², percent; zero where the water is incompressible.
    pub compression_percent: f64,
}

impl Evidence<'_> {
    /// Why the case is doubtful, if it is: reasons with semicolons between them, each behind its kind
    /// and a colon.
    pub fn doubt(&self, outcome: &Outcome) -> Option<String> {
        let mut reasons = Vec::new();
        reasons.extend(self.gap(outcome));
        reasons.extend(self.voids());
        reasons.extend(self.energy(outcome));
        reasons.extend(self.compression(outcome));
        reasons.extend(self.at_rest());
        reasons.extend(self.stops(outcome));
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }

    /// The two readings of the force, where a quoted force is.
    fn gap(&self, outcome: &Outcome) -> Option<String> {
        let allowed = FORCE_GAP_PERCENT.max(FORCE_GAP_OF_SPACING * self.spacing * self.spacing);
        let at =
            |(name, maximum): (&'static str, Maximum)| (name, self.gaps.around(maximum.time_s));
        let open = forces(outcome).map(at).filter(|(_, gap)| gap.abs() > allowed);
        let told: Vec<_> = open.map(|(name, gap)| format!("{gap:+.1} % at {name}")).collect();
        let told = told.join(", ");
        (!told.is_empty()).then(|| format!("force gap: the pressure on the face is off by {told}"))
    }

    /// Cavities at the wall, where they do not end a run.
    fn voids(&self) -> Option<String> {
        let percent = 100.0 * self.largest_gap;
        (self.is_wave && self.largest_gap > LASTING_GAP).then(|| {
            format!(
                "force gap: for a while the pressure on the face was off by {percent:.0} %, beside cavities"
            )
        })
    }

    fn energy(&self, outcome: &Outcome) -> Option<String> {
        let gap = outcome.energy_gap_percent;
        if gap.abs() > ENERGY_GAP_PERCENT {
            return Some(format!("energy: the budget is open by {gap:+.1} %"));
        }
        let of_spacing = FOUND_OF_SPACING * self.spacing * self.spacing;
        let until = |time: f64| 100.0 * self.found.most_until(time) / self.work;
        let (first, ever) = (outcome.first_force_max.filter(|_| self.is_wave), f64::INFINITY);
        let early = first.map_or(0.0, |first| until(first.time_s));
        let found = if early > of_spacing { early } else { until(ever) };
        let is_open = early > of_spacing || found > FOUND_PERCENT.max(of_spacing);
        is_open.then(|| format!("energy: {found:.1} % of the paddle's work came from nowhere"))
    }

    fn compression(&self, outcome: &Outcome) -> Option<String> {
        let compression = self.compression_percent * (1.0 + outcome.runup_max.value);
        (compression > COMPRESSION_PERCENT)
            .then(|| format!("compression: its weight makes the water {compression:.1} % denser"))
    }

    fn at_rest(&self) -> Option<String> {
        let apart = self
            .lopsided
            .filter(|apart| apart.abs() > LOPSIDED_OF_SPACING * self.spacing * self.spacing);
        apart.map(|apart| {
            let percent = 100.0 * apart;
            format!(
                "force at rest: still water pressed the wall {percent:+.2} % more than the paddle"
            )
        })
    }

    /// Maxima in the sound of a hit on the stop.
    fn stops<'a>(&'a self, outcome: &'a Outcome) -> impl Iterator<Item = String> + use<'a> {
        let told = |(name, maximum): (&'static str, Maximum)| {
            let since = self.blows.since_audible(maximum.time_s)?;
            Some(format!(
                "stop impact: {name} is {since:.3} s after the wall hit its stop, in the sound of it"
            ))
        };
        let heard = |maximum: Maximum| self.blows.since_audible(maximum.time_s).is_some();
        let kicked = self.kicked && !outcome.displacement_max.is_some_and(heard);
        let set_off = "stop impact: displacement_max is on a way out that the sound of it set off";
        let set_off = kicked.then(|| set_off.to_owned());
        forces(outcome).chain(others(outcome)).filter_map(told).chain(set_off)
    }
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
        let mut found = Found::default();
        [(0.5, 0.2), (2.0, 0.8)].into_iter().for_each(|(time, joules)| found.push(time, joules));
        let mut evidence = Evidence {
            gaps: &gaps,
            largest_gap: 0.1,
            blows: &blows,
            kicked: false,
            found: &found,
            work: 100.0,
            spacing: 0.06,
            is_wave: true,
            lopsided: Some(1e-4),
            compression_percent: 1.6,
        };
        change(&mut evidence);
        evidence.doubt(outcome)
    }

    #[test]
    fn a_gap_counts_where_a_quoted_force_is_and_nowhere_else() {
        assert_eq!(doubt(&outcome(), [2.0, 2.3], 0.6, |_| ()), None, "after a stop");
        let told = doubt(&outcome(), [0.9, 1.1], 0.06, |_| ()).unwrap();
        let words = "off by -6.0 % at force_max";
        assert_eq!(told, format!("force gap: the pressure on the face is {words}"));
    }

    #[test]
    fn cavities_at_the_wall_count_where_they_do_not_end_a_run() {
        let with = |gap| doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.largest_gap = gap);
        assert_eq!(with(0.5), None);
        let words = "for a while the pressure on the face was off by 74 %, beside cavities";
        assert_eq!(with(0.743).unwrap(), format!("force gap: {words}"));
        let collapse = |e: &mut Evidence<'_>| (e.largest_gap, e.is_wave) = (1.5, false);
        assert_eq!(doubt(&outcome(), [0.0, 0.0], 0.0, collapse), None);
    }

    #[test]
    fn energy_counts_on_either_side() {
        let with = |energy_gap_percent| {
            let outcome = Outcome { energy_gap_percent, ..outcome() };
            doubt(&outcome, [0.0, 0.0], 0.0, |_| ())
        };
        assert_eq!(with(2.9), None);
        assert_eq!(with(3.1).unwrap(), "energy: the budget is open by +3.1 %");
        assert_eq!(with(-15.2).unwrap(), "energy: the budget is open by -15.2 %");
    }

    #[test]
    fn energy_from_nowhere_counts_against_what_the_spacing_makes() {
        let with = |work: f64, spacing: f64| {
            let change = |e: &mut Evidence<'_>| (e.work, e.spacing) = (work, spacing);
            doubt(&outcome(), [0.0, 0.0], 0.0, change)
        };
        // 0.2 of it until the largest force at 1 s, 0.8 in all.
        assert_eq!(with(100.0, 0.045), None);
        let told = with(100.0, 0.035).unwrap();
        assert_eq!(told, "energy: 0.2 % of the paddle's work came from nowhere");
        assert_eq!(with(81.0, 0.07), None);
        assert!(with(79.0, 0.07).unwrap().contains("1.0 % of the paddle's work"));
    }

    #[test]
    fn coarse_particles_alone_are_no_doubt() {
        let with = |spacing: f64, void: f64| {
            doubt(&outcome(), [0.9, 1.1], void, |e| e.spacing = spacing).unwrap_or_default()
        };
        assert_eq!(with(0.125, 0.02), "");
        assert!(with(0.125, 0.03).starts_with("force gap: "));
    }

    #[test]
    fn still_water_presses_both_walls_alike() {
        let with = |lopsided| doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.lopsided = Some(lopsided));
        assert_eq!(with(-3e-4), None);
        assert!(
            with(-5e-4).unwrap().starts_with("force at rest: still water pressed the wall -0.05")
        );
    }

    #[test]
    fn soft_water_is_doubtful() {
        let with = |ratio: f64| {
            doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.compression_percent = 100.0 / ratio.powi(2))
        };
        assert_eq!((with(8.0), with(7.0)), (None, None));
        assert_eq!(with(4.0).unwrap(), "compression: its weight makes the water 9.4 % denser");
    }

    #[test]
    fn a_maximum_in_the_sound_of_a_blow_is_named() {
        let late = Outcome { force_max: at(2.3, 2.15), ..outcome() };
        let told = doubt(&late, [0.0, 0.0], 0.0, |_| ()).unwrap();
        let words = "force_max is 0.149 s after the wall hit its stop, in the sound of it";
        assert_eq!(told, format!("stop impact: {words}"));
        let later = Outcome { force_max: at(2.3, 2.4), ..outcome() };
        assert_eq!(doubt(&later, [0.0, 0.0], 0.0, |_| ()), None);
        let kicked = doubt(&outcome(), [0.0, 0.0], 0.0, |e| e.kicked = true).unwrap();
        assert!(kicked.starts_with("stop impact: displacement_max"), "{kicked}");
    }
}
