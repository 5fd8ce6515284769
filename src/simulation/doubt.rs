//! Whether a quoted number is doubtful, so that its history should be looked at first.

mod still_water;

use super::blows::Blows;
use super::doubt_reasons::END_OF_RUN;
use super::face_gaps::FaceGaps;
use super::found_energy::Found;
use super::health::LASTING_GAP;
use super::outcome::{Maximum, Outcome};

/// A force gap above this, percent, is doubtful at the time of a largest force ...
const FORCE_GAP_PERCENT: f64 = 1.5;
/// ... if it is also above this many times (Δx/h)², percent, which matters below ten rows.
const FORCE_GAP_OF_SPACING: f64 = 150.0;
/// An energy gap above this, percent, of either sign, is doubtful.
const ENERGY_GAP_PERCENT: f64 = 3.0;
/// So is energy from nowhere above this, percent of the paddle's work, at any check ...
const FOUND_PERCENT: f64 = 1.0;
/// ... and, until the first impact's largest force, above this many times (Δx/h)², percent. The
/// scheme is of second order. Until then sound runs have up to 66 of it at 16 mm and 86 at 25 mm.
/// Runs at a Courant number of 2.5 have 170 and more at 16 mm, 186 and more at 8 mm.
const FOUND_OF_SPACING: f64 = 125.0;
/// So is a compression by the water's own weight above this at the foot of the wall, percent.
const COMPRESSION_PERCENT: f64 = 6.0;
/// Force and runup at the end show no wave if they exceed those of still water by less than this,
/// over its force and over h.
const RIPPLE: f64 = 0.01;
/// An impulse is cut off where the force is still above this share of the impact's F* - 1.
const STILL_PRESSES: f64 = 0.1;
/// Without the effect of sound a wall goes hardly farther than it went, and not this many times as far.
const FARTHER: f64 = 1.1;

/// The data by which a finished case is judged, besides its outcome.
pub(super) struct Evidence<'a> {
    /// The two ways to read the force.
    pub gaps: &'a FaceGaps,
    /// The largest mean of the gap over some ten looks, relative to the larger of the force and the
    /// hydrostatic one.
    pub largest_gap: f64,
    /// Hits on the stop.
    pub blows: &'a Blows,
    /// Whether the wall left its stop in the sound of an impact on the way to its largest X*.
    pub kicked: bool,
    /// Largest |X*| of any step, with the effect of sound.
    pub farthest: f64,
    /// Energy that has come from nowhere.
    pub found: &'a Found,
    /// The energy that this is relative to, as a rule the paddle's work, J per metre of width ...
    pub work: f64,
    /// ... and in words.
    pub counted_in: &'static str,
    /// Δx/h, or Δx over the depth at the wall if that is less.
    pub spacing: f64,
    /// Δx over the least still water on the way to the wall; that is less over a submerged sill.
    pub spacing_on_way: f64,
    /// Whether a paddle makes a wave.
    pub is_wave: bool,
    /// Force on the wall at rest less that on the paddle, over ρgh²/2, if both should be equal.
    pub lopsided: Option<f64>,
    /// Whether still water presses an upright wall over a bed, and by its weight alone.
    pub over_bed: bool,
    /// Whether nothing makes a wave, and still water alone would not move the wall.
    pub stays_still: bool,
    /// g h/c0², percent; zero where the water is incompressible.
    pub compression_percent: f64,
    /// A later maximum counts as one at the end, seconds.
    pub end: f64,
    /// Whether the run ends in the first impact of a wall that stands. One that swings back goes on
    /// being pressed.
    pub in_impact: bool,
    /// Whether water of a single wave goes over the crest as the run ends.
    pub goes_over: bool,
}

impl Evidence<'_> {
    /// Why the case is doubtful, if it is. Reasons are separated by semicolons. Each starts with
    /// its kind and a colon.
    pub fn doubt(&self, outcome: &Outcome) -> Option<String> {
        let mut reasons = Vec::new();
        reasons.extend(self.gap(outcome));
        reasons.extend(self.voids());
        reasons.extend(self.energy(outcome));
        reasons.extend(self.compression(outcome));
        reasons.extend(self.at_rest().or_else(|| self.at_rest_over_bed(outcome)));
        reasons.extend(self.wanders(outcome));
        reasons.extend(self.stops(outcome));
        reasons.extend(self.pumped(outcome));
        reasons.extend(self.cut_off(outcome));
        reasons.extend(self.goes_on(outcome));
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }

    /// The gap between the two readings of the force, at each quoted force.
    fn gap(&self, outcome: &Outcome) -> Option<String> {
        let allowed = FORCE_GAP_PERCENT.max(FORCE_GAP_OF_SPACING * self.spacing * self.spacing);
        let at =
            |(name, maximum): (&'static str, Maximum)| (name, self.gaps.around(maximum.time_s));
        let open = forces(outcome).map(at).filter(|(_, gap)| gap.abs() > allowed);
        let told: Vec<_> = open.map(|(name, gap)| format!("{gap:+.1} % at {name}")).collect();
        let told = told.join(", ");
        (!told.is_empty()).then(|| format!("force gap: the pressure on the face is off by {told}"))
    }

    /// Cavities at the wall that do not end the run.
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
        let second_order = |spacing: f64| FOUND_OF_SPACING * spacing * spacing;
        let of_spacing = second_order(self.spacing);
        // Over a sill there are fewer rows, which find more energy. But the bound for any check
        // holds there too.
        let of_first = of_spacing.max(second_order(self.spacing_on_way).min(FOUND_PERCENT));
        let until = |time: f64| 100.0 * self.found.most_until(time) / self.work;
        let (first, ever) = (outcome.first_force_max.filter(|_| self.is_wave), f64::INFINITY);
        let early = first.map_or(0.0, |first| until(first.time_s));
        let found = if early > of_first { early } else { until(ever) };
        let is_open = early > of_first || found > FOUND_PERCENT.max(of_spacing);
        is_open.then(|| format!("energy: {found:.1} % of {} came from nowhere", self.counted_in))
    }

    fn compression(&self, outcome: &Outcome) -> Option<String> {
        let compression = self.compression_percent * (1.0 + outcome.runup_max.value);
        (compression > COMPRESSION_PERCENT)
            .then(|| format!("compression: its weight makes the water {compression:.1} % denser"))
    }

    /// Forces and runups that would have risen further. Displacements have a column of their own
    /// for that.
    fn cut_off(&self, outcome: &Outcome) -> Option<String> {
        let risen = |maximum: Maximum, still: f64| maximum.value > still + RIPPLE;
        let force = ("force_max", outcome.force_max, 1.0);
        let runup = ("runup_max", outcome.runup_max, 0.0);
        let at_end = |&(_, maximum, still): &(&str, Maximum, f64)| {
            self.is_wave && maximum.time_s >= self.end && risen(maximum, still)
        };
        let told: Vec<_> =
            [force, runup].into_iter().filter(at_end).map(|(name, ..)| name).collect();
        (!told.is_empty()).then(|| {
            format!("{END_OF_RUN}: {} at the very end, so more may have followed", told.join(", "))
        })
    }

    /// An impulse and a volume that would have grown further.
    fn goes_on(&self, outcome: &Outcome) -> Option<String> {
        let first = outcome.first_force_max.filter(|_| self.in_impact);
        let presses = first
            .is_some_and(|first| outcome.force_end - 1.0 > STILL_PRESSES * (first.value - 1.0));
        let sums = [("first_impulse", presses), ("overtopping_volume_m2", self.goes_over)];
        let told: Vec<_> = sums.iter().filter(|(_, grows)| *grows).map(|(name, _)| *name).collect();
        (!told.is_empty())
            .then(|| format!("{END_OF_RUN}: {} still grew, so it is a part", told.join(", ")))
    }

    /// Sound that was taken off wrongly.
    fn pumped(&self, outcome: &Outcome) -> Option<String> {
        let told = outcome.displacement_max?.value;
        (told > FARTHER * self.farthest).then(|| {
            let times = told / self.farthest;
            format!("sound: displacement_max is {times:.1} times what the wall went with its sound")
        })
    }

    /// Maxima in the sound of an impact on the stop.
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

/// The largest force of the run, named by its column, and that of the first impact if it is
/// another.
fn forces(outcome: &Outcome) -> impl Iterator<Item = (&'static str, Maximum)> {
    let other = outcome.first_force_max.filter(|first| first.time_s != outcome.force_max.time_s);
    present([("force_max", Some(outcome.force_max)), ("first_force_max", other)])
}

/// The other quoted maxima.
fn others(outcome: &Outcome) -> impl Iterator<Item = (&'static str, Maximum)> {
    present([
        ("runup_max", Some(outcome.runup_max)),
        ("displacement_max", outcome.displacement_max),
        ("first_runup_max", outcome.first_runup_max),
        ("first_displacement_max", outcome.first_displacement_max),
    ])
}

/// The maxima that exist.
fn present<const N: usize>(
    maxima: [(&'static str, Option<Maximum>); N],
) -> impl Iterator<Item = (&'static str, Maximum)> {
    maxima.into_iter().filter_map(|(name, maximum)| Some((name, maximum?)))
}

#[cfg(test)]
mod tests;
