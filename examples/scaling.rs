//! Scaling by simulation: the real scheduler, driven with measured case times through a link that
//! only keeps books, for ten to ten thousand ranks and up to a million cases.
//!
//! `cargo run --release --example scaling` reads the wall times of the cases in
//! `results/liang2017_study/summary.csv` and writes `results/performance/scaling.md`, of which it
//! keeps what stands under "Notes". Times of the scheduler's own decisions are measured while it
//! makes them; filing is measured with thousands of cases, to the disk, and so is the coordinator's part, by what
//! it takes of its processor.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap, VecDeque};
use std::fmt::Write as _;
use std::time::Instant;

use seawall::execute::{Order, Posted, Report};
use seawall::math::simd::SimdPath;
use seawall::math::team::thread_processor_time;
use seawall::math::words::counted;
use seawall::results::{CaseRecord, Delivery, Directory, Filing, OpenMode};
use seawall::scene::CaseConfig;
use seawall::schedule::{Command, Event, Manager, Work};
use seawall::simulation::{CaseResult, Cost, Unwatched, cost, run_case, run_trunk};
use seawall::study::{Case, Plan, PlannedCase, PlannedTrunk, Study, SweepFile};

/// What one message costs on its way, seconds and seconds per byte: a slow network of a cluster.
const LATENCY: f64 = 20e-6;
const PER_BYTE: f64 = 1e-9;
/// What the coordinator's share of sending or receiving one takes, seconds.
const HANDLING: f64 = 2e-6;
/// Cases that are recorded to see how long that takes.
const RECORDED: usize = 20_000;
const SUMMARY: &str = "results/liang2017_study/summary.csv";
const MOVABLE: &str =
    "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 250\n";
const TABLE: &str = "results/performance/scaling.md";

/// The cases of one wave height in the measured study: they share a trunk.
struct Wave {
    config: CaseConfig,
    estimate: Cost,
    /// What each took from the trunk's end, seconds.
    branches: Vec<f64>,
    /// What their trunk must have taken, at the same speed.
    trunk: f64,
}

/// What messages weigh and what it takes to record a case, from real ones.
struct Measured {
    waves: Vec<Wave>,
    order_bytes: f64,
    checkpoint_bytes: f64,
    recording: Recording,
}

fn table(text: &str) -> toml::Table {
    text.parse().unwrap()
}

/// The cases of a summary that ended well.
fn waves(path: &str) -> Vec<Wave> {
    let mut reader = csv::Reader::from_path(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let mut times: BTreeMap<u64, Vec<[f64; 2]>> = BTreeMap::new();
    for row in reader.deserialize::<BTreeMap<String, String>>() {
        let row = row.unwrap();
        if row["status"] == "ok" {
            let number = |key: &str| row[key].parse::<f64>().unwrap();
            let height = (1e6 * number("wave_height_ratio")).round() as u64;
            times.entry(height).or_default().push([number("wall_time_s"), number("steps")]);
        }
    }
    let wave = |(height, times): (u64, Vec<[f64; 2]>)| {
        let scene = format!("wave_height_ratio = {:?}\n{MOVABLE}", height as f64 * 1e-6);
        let config = CaseConfig::from_tables(&table(&scene), &toml::Table::new()).unwrap();
        let estimate = cost(&config);
        let trunk_steps = estimate.steps as f64 * estimate.trunk_share;
        let branches: Vec<f64> = times.iter().map(|[seconds, _]| *seconds).collect();
        let steps: f64 = times.iter().map(|[_, steps]| steps - trunk_steps).sum();
        let trunk = branches.iter().sum::<f64>() / steps * trunk_steps;
        Wave { config, estimate, branches, trunk }
    };
    times.into_iter().map(wave).collect()
}

fn measure() -> Measured {
    let waves = waves(SUMMARY);
    let numerics = table("particle_spacing_m = 0.025");
    let case = CaseConfig::from_tables(&table(MOVABLE), &numerics).unwrap();
    let path = SimdPath::widest();
    let trunk = run_trunk(&case.trunk().unwrap(), path, &Unwatched).unwrap();
    let result = run_case(&case, Some(&trunk.checkpoint), path, &Unwatched).unwrap();
    let grown = waves[0].estimate.particles as f64 / f64::from(result.outcome.particles);
    Measured {
        waves,
        order_bytes: serde_json::to_string(&case).unwrap().len() as f64,
        checkpoint_bytes: trunk.checkpoint.len() as f64 * grown,
        recording: recording(&result),
    }
}

/// What it costs to file a case, and to take it in.
struct Recording {
    /// A rank writes the files of a case and puts them on the disk, seconds.
    file_s: f64,
    /// The coordinator takes its message in, seconds. It writes what has begun and ended, the journal's line, and
    /// the order of the next case. Lines go to the disk beside it.
    record_s: f64,
    message_bytes: f64,
}

fn recording(result: &CaseResult) -> Recording {
    let sweep = format!(
        "name = \"scaling\"\n[scene]\n{MOVABLE}[grid]\n\
         wave_height_ratio = {{ from = 0.1, to = 0.4, points = {RECORDED}, spacing = \"linear\" }}"
    );
    let study = Study::new(&SweepFile::read(&sweep, &[]).unwrap()).unwrap();
    let results = tempfile::tempdir_in("results").unwrap();
    let path = results.path().join("scaling");
    let (mut directory, _) =
        Directory::open(&path, &study, OpenMode::Resume, None, SimdPath::widest()).unwrap();
    let filing = Filing::here(&path).syncing();
    let start = Instant::now();
    let report = |case: &Case| Report::CaseDone {
        case: case.index,
        result: Ok(filing.deliver(Some(case.id), result.clone())),
        wall_time_s: 1.0,
        cpu_time_s: Some(1.0),
    };
    let reports: Vec<_> = study.cases.iter().map(report).collect();
    let file_s = start.elapsed().as_secs_f64() / RECORDED as f64;
    let message = |report: Report| postcard::to_stdvec(&vec![report]).unwrap();
    let messages: Vec<_> = reports.into_iter().map(message).collect();
    // Of its processor alone: what else runs on this machine does not count, nor does the disk beside it.
    let spent = || thread_processor_time().expect("the system tells what a thread takes");
    let before = spent();
    for (case, message) in study.cases.iter().zip(&messages) {
        directory.attempts().turn(None, &[case.id]).unwrap();
        let order = Order::Run {
            work: Work::Case(case.index),
            config: Posted::from(&case.config),
            from: None,
            apart: false,
            limits: study.limits,
            files: Some(case.id),
        };
        std::hint::black_box(postcard::to_stdvec(&order).unwrap());
        let mut reports: Vec<Report> = postcard::from_bytes(message).unwrap();
        let Some(Report::CaseDone { result: Ok(Delivery::Filed(filed)), .. }) = reports.pop()
        else {
            panic!("a case was not filed")
        };
        let record = CaseRecord::of_filed(&study, case, &filed, 1.0, "host");
        directory.record_filed(record, &filed).unwrap();
        directory.attempts().turn(Some(case.id), &[]).unwrap();
        directory.sync(false).unwrap();
    }
    let record_s = (spent() - before) / RECORDED as f64;
    directory.sync(true).unwrap();
    Recording { file_s, record_s, message_bytes: messages[0].len() as f64 }
}

/// What the scheduler plans with, and what its tasks take in truth, seconds.
struct Planned {
    plan: Plan,
    trunk_seconds: Vec<f64>,
    case_seconds: Vec<f64>,
}

/// So many cases: the measured ones over and over.
fn planned(cases: usize, waves: &[Wave]) -> Planned {
    let mut planned =
        Planned { plan: Plan::default(), trunk_seconds: Vec::new(), case_seconds: Vec::new() };
    let plan = &mut planned.plan;
    for (trunk, wave) in waves.iter().cycle().enumerate() {
        let first = plan.cases.len();
        let count = wave.branches.len().min(cases - first);
        if count == 0 {
            break;
        }
        let whole = wave.estimate.particles * wave.estimate.steps;
        let cost = (whole as f64 * wave.estimate.trunk_share) as u64;
        for index in first..first + count {
            let branch_cost = whole - cost;
            plan.cases.push(PlannedCase { index, trunk: Some(trunk), cost: whole, branch_cost });
        }
        planned.case_seconds.extend(&wave.branches[..count]);
        planned.trunk_seconds.push(wave.trunk);
        let branches = (first..first + count).collect();
        plan.trunks.push(PlannedTrunk { config: wave.config.clone(), cost, branches });
    }
    planned
}

struct Ranks {
    queues: Vec<VecDeque<(Work, f64, [f64; 2])>>,
    busy: Vec<bool>,
    done: BinaryHeap<Reverse<(u64, usize, u64)>>,
    running: Vec<Option<Work>>,
    working_s: f64,
    number: u64,
}

impl Ranks {
    /// Starts the next task of a rank, at the earliest at `now`.
    fn start(&mut self, rank: usize, now: f64) {
        if self.busy[rank] {
            return;
        }
        if let Some((work, ready, [duration, filing])) = self.queues[rank].pop_front() {
            let end = now.max(ready) + duration + filing;
            self.busy[rank] = true;
            self.running[rank] = Some(work);
            self.working_s += duration;
            self.number += 1;
            self.done.push(Reverse(((end * 1e9) as u64, rank, self.number)));
        }
    }
}

struct Outcome {
    makespan: f64,
    bound: f64,
    busy: f64,
    /// Through the coordinator.
    bytes: f64,
    /// From rank to rank.
    checkpoints: f64,
    /// Of the scheduler, per message that it takes in, seconds.
    decision: f64,
}

fn simulate(planned: &Planned, count: usize, measured: &Measured) -> Outcome {
    let plan = &planned.plan;
    let mut manager = Manager::new(plan, &vec![1; count]);
    let mut ranks = Ranks {
        queues: vec![VecDeque::new(); count],
        busy: vec![false; count],
        done: BinaryHeap::new(),
        running: vec![None; count],
        working_s: 0.0,
        number: 0,
    };
    let (mut commands, mut coordinator, mut busy, mut bytes) = (Vec::new(), 0.0, 0.0, 0.0);
    let mut checkpoints = 0.0;
    let (mut deciding, mut taken_in) = (0.0, 0_u64);
    let mut handle = |event: Event, at: f64, extra: f64, ranks: &mut Ranks| {
        let start = Instant::now();
        manager.on(event, &mut commands);
        let decision = start.elapsed().as_secs_f64();
        deciding += decision;
        taken_in += 1;
        let orders = commands.iter().filter(|command| matches!(command, Command::Run { .. }));
        let spent = decision + extra + HANDLING * (1 + orders.count()) as f64;
        coordinator = f64::max(coordinator, at) + spent;
        busy += spent;
        for command in commands.drain(..) {
            let order = LATENCY + PER_BYTE * measured.order_bytes;
            let arrival = coordinator + order;
            let Command::Run { rank, work, from } = command else { continue };
            let fetch = from.filter(|held| held.holder != rank).map_or(0.0, |_| {
                checkpoints += measured.checkpoint_bytes;
                2.0 * LATENCY + PER_BYTE * measured.checkpoint_bytes
            });
            let duration = match work {
                Work::Trunk(trunk) => planned.trunk_seconds[trunk],
                Work::Case(case) => planned.case_seconds[case],
            };
            let ready = arrival + fetch;
            bytes += measured.order_bytes;
            let filing = match work {
                Work::Trunk(_) => 0.0,
                Work::Case(_) => measured.recording.file_s,
            };
            ranks.queues[rank].push_back((work, ready, [duration, filing]));
            ranks.start(rank, coordinator);
        }
        manager.finished()
    };
    for rank in 0..count {
        handle(Event::Ready { rank }, 0.0, 0.0, &mut ranks);
    }
    let mut end = 0.0;
    while let Some(Reverse((nanoseconds, rank, _))) = ranks.done.pop() {
        end = nanoseconds as f64 * 1e-9;
        let work = ranks.running[rank].take().expect("a rank that ends has run");
        ranks.busy[rank] = false;
        ranks.start(rank, end);
        let event = Event::Done { rank, work, ok: true };
        let (size, extra) = match work {
            Work::Trunk(_) => (64.0, 0.0),
            Work::Case(_) => (measured.recording.message_bytes, measured.recording.record_s),
        };
        let arrival = end + LATENCY + PER_BYTE * size;
        if handle(event, arrival, extra, &mut ranks) {
            break;
        }
    }
    let _ = handle;
    let chains = plan.trunks.iter().zip(&planned.trunk_seconds).map(|(trunk, seconds)| {
        let branches = trunk.branches.iter().map(|&case| planned.case_seconds[case]);
        seconds + branches.fold(0.0, f64::max)
    });
    let chain = chains.fold(0.0, f64::max);
    let bytes = bytes + plan.cases.len() as f64 * measured.recording.message_bytes;
    // The last case is done once it is recorded.
    let end = f64::max(end, coordinator);
    Outcome {
        makespan: end,
        bound: chain.max(ranks.working_s / count as f64),
        busy: busy / end,
        bytes,
        checkpoints,
        decision: deciding / taken_in as f64,
    }
}

/// Up to where the scheduler keeps its ranks at work, and how busy that keeps the coordinator. With fewer than
/// a hundred cases per rank it is the last cases that count.
fn conclusion(rows: &[(usize, usize, Outcome)]) -> String {
    let enough = |ranks: &usize, cases: &usize| *cases >= 100 * *ranks;
    let kept = rows.iter().map(|row| row.0).filter(|count| {
        let of = rows.iter().filter(|(ranks, cases, _)| ranks == count && enough(ranks, cases));
        let mut efficiencies = of.map(|(_, _, o)| o.bound / o.makespan).peekable();
        efficiencies.peek().is_some() && efficiencies.all(|efficiency| efficiency > 0.95)
    });
    let kept = kept
        .max()
        .map_or("No number of ranks".to_owned(), |n| format!("Up to {}", counted(n, "rank")));
    let mut text = format!(
        "\n{kept} the bound is more than 95 % of the makespan wherever there are a hundred cases or more \
         per rank.\n"
    );
    let busiest = rows.iter().map(|(_, _, o)| 100.0 * o.busy).fold(0.0, f64::max);
    text += &format!("The coordinator is busy for {busiest:.0} % of the time at most.\n");
    text
}

fn main() {
    let measured = measure();
    let all = || measured.waves.iter().flat_map(|wave| &wave.branches);
    let mut sorted: Vec<f64> = all().copied().collect();
    sorted.sort_by(f64::total_cmp);
    let mut text = format!(
        "# Scaling, by simulation\n\n\
         The real scheduler (`schedule::Manager`), driven with the wall times of the {} cases in\n\
         `{SUMMARY}` over and over: {:.2} s in the median, {:.2} to {:.2} s,\n{} branches per \
         trunk, a trunk in {:.2} s. The scheduler plans with its own estimates. One task at a \
         time per\nrank, messages of {:.0} µs and 1 GB/s, {:.0} µs to send or receive one (taken, not \
         measured). Measured and\ncounted in: the scheduler's decisions; {:.1} ms of a rank to file a case \
         and wait for the disk; {:.0} µs of the\ncoordinator to record one; orders of {:.1} kB, reports of \
         {:.2} kB. Checkpoints of {:.2} MB go from rank to rank\nwhere a branch runs elsewhere than its trunk. \
         Made by `examples/scaling.rs`.\n\nThe bound is the larger of all work over \
         all ranks and the longest trunk with its longest branch. With\nmore ranks than cases \
         only the latter counts.\n\n\
         | ranks | cases | makespan, s | bound, s | makespan over bound | coordinator busy | \
         scheduler, µs per message | through the coordinator, MB | between ranks, MB |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        sorted.len(),
        sorted[sorted.len() / 2],
        sorted[0],
        sorted[sorted.len() - 1],
        measured.waves[0].branches.len(),
        measured.waves[0].trunk,
        1e6 * LATENCY,
        1e6 * HANDLING,
        1e3 * measured.recording.file_s,
        1e6 * measured.recording.record_s,
        1e-3 * measured.order_bytes,
        1e-3 * measured.recording.message_bytes,
        1e-6 * measured.checkpoint_bytes,
    );
    let mut rows = Vec::new();
    for ranks in [10, 100, 1_000, 10_000] {
        for cases in [300, 10_000, 100_000, 1_000_000] {
            let o = simulate(&planned(cases, &measured.waves), ranks, &measured);
            writeln!(
                text,
                "| {ranks} | {cases} | {:.1} | {:.1} | {:.3} | {:.2} % | {:.2} | {:.0} | {:.0} |",
                o.makespan,
                o.bound,
                o.makespan / o.bound,
                100.0 * o.busy,
                1e6 * o.decision,
                1e-6 * o.bytes,
                1e-6 * o.checkpoints
            )
            .unwrap();
            rows.push((ranks, cases, o));
        }
    }
    text += &conclusion(&rows);
    // What a reader has added stays.
    let old = std::fs::read_to_string(TABLE).unwrap_or_default();
    if let Some((_, notes)) = old.split_once("\n## Notes") {
        text += &format!("\n## Notes{notes}");
    }
    std::fs::create_dir_all("results/performance").unwrap();
    std::fs::write(TABLE, &text).unwrap();
    print!("{text}");
}
