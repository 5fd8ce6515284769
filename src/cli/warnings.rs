//! Values that a file hardly intends: reported by `check`, `run` and `sweep`, which go on.

use std::f64::consts::SQRT_2;
use std::path::Path;

use rayon::prelude::*;

use super::cost::time_of_all;
use super::known_limits::KnownLimits;
use super::output::{Output, duration};
use crate::execute::available_cores;
use crate::keys::named;
use crate::math::decimal::significant;
use crate::math::tally::Tally;
use crate::math::words::counted;
use crate::quantities::Unit;
use crate::scene::{SeawallScene, odd_by_key};
use crate::simulation::{Cost, Limits, cost};
use crate::study::{Case, Study, Unread};

/// A study that takes longer than this is reported with the keys that make it long, seconds.
const LONG_S: f64 = 86_400.0;

/// Prints the warnings of a file and its known limits as notes.
pub(super) fn tell(file: &Path, study: &Study, output: &Output) {
    for line in warnings(study, time_of_all(study)) {
        output.note(format_args!("warning: {}: {line}", named(file)));
    }
    KnownLimits::of(study).tell(output);
}

/// The odd values of a study and the keys that are not read, a line per key, and its cost if high. `time` is from [`time_of_all`].
pub(super) fn warnings(study: &Study, time: (f64, usize)) -> Vec<String> {
    let odd = Tally::of(&study.cases, |case| odd_by_key(&case.config));
    let odd = odd.lines(|cases| format!(" (in {})", counted(cases, "case"))).into_iter();
    let odd = odd.chain(unread(study)).chain(unaimed(study)).chain(without_bars(study));
    let odd = odd.chain(unbarred(study)).chain(refined_to_steps(study));
    odd.chain(long(study, time)).chain(limited(study)).collect()
}

/// Keys that some cases do not read, a line per key.
fn unread(study: &Study) -> impl Iterator<Item = String> {
    let all = study.cases.len();
    study.unread.iter().map(move |Unread { told, cases }| match *cases == all {
        true => told.to_string(),
        false => format!("{told} (in {})", counted(*cases, "case")),
    })
}

/// A single scene runs as it is, even if its file aims at an error.
fn unaimed(study: &Study) -> Option<String> {
    let percent = study.max_error_percent.filter(|_| study.keys.is_empty())?;
    Some(format!(
        "accuracy.max_error_percent = {percent}: only `seawall sweep` of a file with [grid] chooses numerics; this \
         scene has those of the file"
    ))
}

/// How many cases ask for error bars that they cannot have, and why the first cannot.
fn without_bars(study: &Study) -> Option<String> {
    let cases = Some(study.without_bars).filter(|&cases| cases > 0)?;
    let mut own = study.cases.iter().zip(&study.companions_of).filter(|(_, own)| own.is_empty());
    let why = own.find_map(|(case, _)| case.config.coarsened(SQRT_2).err());
    let why = why.map(|error| format!(" ({error})")).unwrap_or_default();
    Some(format!(
        "numerics.error_bars: {} will have none, as a companion with coarser particles cannot run{why}; a smaller \
         numerics.particle_spacing_m helps",
        counted(cases, "case")
    ))
}

/// A volume is refined until it is known better than a few particles tell it.
const PARTICLES: f64 = 4.0;

/// Volumes over a crest count whole particles: below some of them a curve has steps, and points are spent on these.
fn refined_to_steps(study: &Study) -> Option<String> {
    let refine = study.refine.as_ref()?;
    let asked = refine.column().unit == Unit::SquareMetres;
    let spacing = |case: &Case| case.config.numerics.particle_spacing_m;
    let area = study.cases.iter().map(spacing).fold(0.0, f64::max).powi(2);
    (asked && refine.to < PARTICLES * area).then(|| {
        format!(
            "grid.refine.to = {}: a volume counts whole particles, here of up to {} m²; with less than {PARTICLES} of them \
             points are spent on steps",
            refine.to,
            significant(area, 2)
        )
    })
}

/// How many cases ask for error bars but are no seawalls: their companions run for nothing.
fn unbarred(study: &Study) -> Option<String> {
    let pairs = study.cases.iter().zip(&study.companions_of);
    let in_vain =
        pairs.filter(|(case, own)| !own.is_empty() && case.config.scene.seawall().is_none());
    let cases = Some(in_vain.count()).filter(|&cases| cases > 0)?;
    Some(format!(
        "numerics.error_bars: {} will have none, as only scenes of seawalls have them; \"none\" saves the time of their \
         companions",
        counted(cases, "case")
    ))
}

/// How many cases are expected to take more than `[limits]` allows.
fn limited(study: &Study) -> Option<String> {
    let limits = study.limits;
    if limits == Limits::default() {
        return None;
    }
    let over = |case: &&Case| {
        let Cost { steps, memory_bytes, .. } = cost(&case.config);
        limits.on_steps(steps).is_some() || limits.on_memory(memory_bytes, "").is_some()
    };
    let over = study.cases.par_iter().filter(over).count();
    let told = || format!("limits: {} will probably need more and fail", counted(over, "case"));
    (over > 0).then(told)
}

/// The keys that make a study long, and how long it is.
fn long(study: &Study, (seconds, cores): (f64, usize)) -> Option<String> {
    if seconds <= LONG_S {
        return None;
    }
    let longest = study.cases.iter().max_by_key(|case| cost(&case.config).steps)?;
    let (frame, numerics) = (longest.config.scene.frame(), &longest.config.numerics);
    let steps = (frame.end_time - longest.config.scene.start_s()) / frame.time_step(numerics);
    let is_told = |scene: &SeawallScene| scene.end_time_s.is_some();
    let ends = if longest.config.scene.seawall().is_none_or(is_told) {
        "end_time_s"
    } else {
        "end_after_stroke_centre_s"
    };
    Some(format!(
        "takes about {} on {}: the longest case ends at {} s, after {steps:.1e} steps, with particles \
         {} m apart (scene.{ends}, numerics.particle_spacing_m)",
        duration(seconds),
        counted(cores, "core"),
        significant(frame.end_time, 6),
        numerics.particle_spacing_m
    ))
}

/// Reports if there are more threads than processors.
pub(super) fn tell_threads(threads: Option<u16>, output: &Output) {
    let processors = available_cores();
    if let Some(threads) = threads.filter(|&threads| usize::from(threads) > processors) {
        output.note(format_args!(
            "warning: --threads {threads}: this machine has {}; more threads make nothing faster, and \
             every case at once takes memory",
            counted(processors, "processor")
        ));
    }
}
