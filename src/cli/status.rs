//! `seawall status`: how far a sweep is, from its files alone.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use serde::Serialize;
use serde_json::{Value, json};

use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::{Output, duration};
use super::table::Table;
use super::watch::{View, Watch};
use super::{CASES_FAILED, INTERRUPTED, SUCCESS, options, stored};
use crate::keys::brief;
use crate::math::name::name_of;
use crate::math::words::counted;
use crate::results::{
    Closing, Derived, Fared, Header, Load, Lock, Manifest, RankInfo, read_journal_header,
    read_journal_in_blocks,
};

/// Show what is done, what failed and why, what is left, and the time to go.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall status results/runs/nightly
  seawall status results/runs/nightly --format json
  seawall status results/runs/nightly --exit-code || echo 'not done, or not all well'
  seawall status results/runs/nightly --watch 30")]
pub(super) struct StatusArgs {
    /// The output directory of a sweep.
    dir: PathBuf,
    /// End with the sweep's own exit code: 0 all well, 1 some case failed, 3 something is left.
    #[arg(long)]
    exit_code: bool,
    /// Look again every so many seconds while the sweep runs, and tell how fast it goes.
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = "10", value_parser = options::seconds(0.1, 1e6), allow_negative_numbers = true)]
    watch: Option<f64>,
}

/// Values of a key that are listed where cases failed.
const MOST_VALUES: usize = 20;

/// What the journal tells.
struct Known {
    header: Option<Header>,
    /// How many cases there are, where points were added.
    added: Option<usize>,
    /// The last line of each run, by its place.
    latest: BTreeMap<usize, Fared>,
}

impl Known {
    /// Its first line alone.
    fn of_header(directory: &Path) -> anyhow::Result<Known> {
        let header = read_journal_header(directory)?;
        Ok(Known { header, added: None, latest: BTreeMap::new() })
    }

    /// All of it.
    fn of_journal(directory: &Path) -> anyhow::Result<Known> {
        let (mut added, mut places) = (None, None);
        if let Ok(Some(study)) = stored::in_rounds(directory) {
            // Points that were added have moved the others' places; finer numerics have ids of their own.
            added = Some(study.cases.len());
            let index = study.runs().map(|case| (case.id, case.index));
            places = Some(index.collect::<HashMap<_, _>>());
        }
        let place = |fared: Fared| match &places {
            Some(places) => Some((*places.get(&fared.id)?, fared)),
            None => Some((fared.index, fared)),
        };
        let mut latest = BTreeMap::new();
        let content = read_journal_in_blocks(directory, |block: Vec<Fared>| {
            latest.extend(block.into_iter().map(Fared::brief).filter_map(place));
        })?;
        Ok(Known { header: content.header, added, latest })
    }
}

/// What a look at a directory shows.
struct Seen {
    text: String,
    value: Value,
    left: usize,
    failed: usize,
    running: bool,
    view: View,
}

pub(super) fn main(args: &StatusArgs, output: &Output) -> anyhow::Result<u8> {
    let mut seen = look(args)?;
    let mut watch = Watch::begin(seen.view);
    while let Some(pause) = args.watch.filter(|_| seen.running) {
        output.result(&watch.told(&seen.text, seen.view), &seen.value)?;
        std::thread::sleep(Duration::from_secs_f64(pause));
        seen = look(args)?;
    }
    output.result(&watch.told(&seen.text, seen.view), &seen.value)?;
    Ok(match (seen.left, seen.failed) {
        _ if !args.exit_code => SUCCESS,
        (0, 0) => SUCCESS,
        (0, _) => CASES_FAILED,
        _ => INTERRUPTED,
    })
}

fn look(args: &StatusArgs) -> anyhow::Result<Seen> {
    demand_output_of_study(&args.dir, "journal.jsonl")?;
    let manifest = Manifest::read(&args.dir);
    let companions = manifest.as_ref().map_or(0, |manifest| manifest.companions);
    // Of a closed study in which nothing failed nothing more is to be told.
    let closed = Closing::read(&args.dir).is_some_and(|closing| closing.failed == 0);
    let known = if closed { Known::of_header(&args.dir)? } else { Known::of_journal(&args.dir)? };
    let Known { header, added, mut latest } = known;
    // Where the journal's first line is lost, the manifest tells the same.
    let lost = manifest.as_ref().filter(|_| !latest.is_empty());
    let header = header.or_else(|| {
        let Manifest { name, sweep, cases, .. } = lost?;
        Some(Header::new(name, sweep, *cases, lost?.simd_path()?))
    });
    let Some(header) = header else {
        let reason = "the sweep was stopped before it began, or the journal's first line is lost";
        return Err(BadInput::of(&args.dir, reason).into());
    };
    let cases = added.unwrap_or(header.cases);
    // Lines beyond the cases are resolution companions.
    let companions_done = latest.split_off(&cases).len().min(companions);
    let records: Vec<_> = latest.into_values().collect();
    let failed: Vec<_> = records.iter().filter(|record| record.failure.is_some()).collect();
    let (done, companions_done) =
        if closed { (cases, companions) } else { (records.len(), companions_done) };
    let left = cases.saturating_sub(done);
    let running = Lock::is_held(&args.dir);
    let to_go = match &manifest {
        Some(manifest) if closed && !manifest.sessions.is_empty() => Some(0.0),
        _ => time_to_go(&records, left, manifest.as_ref()),
    };
    let companions_left = companions - companions_done;
    let groups = group(&failed);

    let owed = Derived::is_owed(&args.dir);
    let state = match left + companions_left {
        _ if running => "running",
        0 if owed => "stopped after its cases; the same command makes films and page",
        0 => "finished",
        _ => "stopped; the same command goes on",
    };
    let mut text = format!(
        "{}: {state}\n{done} of {} done, {} failed, {left} left",
        header.name,
        counted(cases, "case"),
        failed.len()
    );
    if let Some(seconds) = to_go.filter(|_| left > 0) {
        text.push_str(&format!(", about {} to go", duration(seconds)));
    }
    if companions > 0 {
        text.push_str(&format!(
            "\n{companions_done} of {} for error bars done",
            counted(companions, "companion")
        ));
    }
    text.push('\n');
    for Failures { reason, cases, example, values } in &groups {
        text.push_str(&format!("\n{reason}: {}, such as\n  {example}\n", counted(*cases, "case")));
        let mut table = Table::default();
        for (key, values) in values {
            let counts = values.iter().map(|(value, count)| format!("{} ({count})", brief(value)));
            let more = values.len().saturating_sub(MOST_VALUES);
            let more = (more > 0).then(|| counted(more, "other") + " (--format json has all)");
            let counts: Vec<_> = counts.take(MOST_VALUES).chain(more).collect();
            table.row([key.clone(), counts.join(", ")]);
        }
        text.push_str(&table.render());
    }
    let mut value = json!({
        "name": header.name,
        "cases": cases,
        "done": done,
        "ok": done - failed.len(),
        "failed": failed.len(),
        "left": left,
        "companions": companions,
        "companions_left": companions_left,
        "films_and_page_left": owed,
        "running": running,
        "time_to_go_s": to_go,
        "simd": header.simd,
        "failures": groups,
    });
    let session = manifest.as_ref().and_then(|manifest| manifest.sessions.last());
    let ranks = session.map_or(&[][..], |session| &session.ranks);
    let load = Load::read(&args.dir).filter(|_| running);
    let load = load.or_else(|| session.and_then(|session| session.load.clone()));
    let told = load.as_ref().and_then(Load::told);
    text.extend(told.map(|told| format!("{told}\n")));
    let share = |load: &Load, rank: usize| json!({ "busy_share": load.share(rank), "rank": rank });
    value["load"] = json!(load.as_ref().map(|load| json!({
        "busy_share": load.whole_share(),
        "ranks": (0..load.ranks.len()).map(|rank| share(load, rank)).collect::<Vec<_>>(),
    })));
    let view = View {
        busy_s: load.as_ref().map(Load::busy_s),
        done: done + companions_done,
        spent_s: records.iter().map(|record| record.wall_time_s).sum(),
        ranks: ranks.len(),
        places: ranks.iter().map(RankInfo::places).sum(),
    };
    let (left, failed) = (left + companions_left + usize::from(owed), failed.len());
    Ok(Seen { text, value, left, failed, running, view })
}

/// Failures of one kind: how many cases of each value of each swept key.
#[derive(Default, Serialize)]
struct Failures {
    reason: String,
    cases: usize,
    example: String,
    values: BTreeMap<String, BTreeMap<String, usize>>,
}

fn group(failed: &[&Fared]) -> Vec<Failures> {
    let mut groups: BTreeMap<_, Failures> = BTreeMap::new();
    for record in failed {
        let kind = record.failure.map_or_else(|| "failed".to_owned(), name_of);
        let group = groups.entry(kind).or_insert_with_key(|kind| Failures {
            reason: kind.clone(),
            example: record.reason.clone(),
            ..Failures::default()
        });
        group.cases += 1;
        for (key, value) in &record.values {
            let counts = group.values.entry(key.clone()).or_default();
            *counts.entry(value.to_string()).or_default() += 1;
        }
    }
    groups.into_values().collect()
}

/// The mean time of a finished case, times those left, over the places of the last session.
fn time_to_go(records: &[Fared], left: usize, manifest: Option<&Manifest>) -> Option<f64> {
    let spent: f64 = records.iter().map(|record| record.wall_time_s).sum();
    let session = manifest?.sessions.last()?;
    let places: usize = session.ranks.iter().map(|rank| rank.places()).sum();
    let mean = spent / (!records.is_empty()).then_some(records.len())? as f64;
    Some(mean * left as f64 / places.max(1) as f64)
}
