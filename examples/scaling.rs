//! Scaling by simulation: the real scheduler, driven with measured case times through a link that
//! only keeps books, for ten to ten thousand ranks and up to a million cases.
//!
//! `cargo run --release --example scaling -- [NS_PER_PARTICLE_STEP]` writes
//! `results/performance/scaling.md`. Times of the scheduler's own decisions are measured while it
//! makes them; recording a case is measured by writing and renaming a file of a history's size.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};
use std::fmt::Write as _;
use std::time::Instant;

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{Unwatched, run_case, run_trunk};
use seawall::sweep::{Command, Event, Manager, Plan, PlannedCase, PlannedTrunk};

/// What one message costs on its way, seconds and seconds per byte: a slow network of a cluster.
const LATENCY: f64 = 20e-6;
const PER_BYTE: f64 = 1e-9;
/// A default case: particles, steps, and the share of them before the wall first moves.
const PARTICLES: u64 = 7_825;
const STEPS: u64 = 3_400;
const TRUNK_SHARE: f64 = 0.45;
/// Branches of a trunk: stiffnesses times masses.
const BRANCHES: usize = 100;
/// Durations differ from their estimate by up to this share, whatever the reason.
const JITTER: f64 = 0.1;

/// What messages weigh and what it takes to record a case, from real ones.
struct Measured {
    order_bytes: f64,
    result_bytes: f64,
    checkpoint_bytes: f64,
    record_s: f64,
    seconds_per_cost: f64,
}

fn measure(seconds_per_cost: f64) -> Measured {
    let table = |text: &str| text.parse::<toml::Table>().unwrap();
    let scene =
        table("wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 250\n");
    let case = CaseConfig::from_tables(&scene, &table("particle_spacing_m = 0.025")).unwrap();
    let path = SimdPath::widest();
    let trunk = run_trunk(&case.trunk().unwrap(), path, &Unwatched).unwrap();
    let result = run_case(&case, Some(&trunk.checkpoint), path, &Unwatched).unwrap();
    let result_bytes = postcard::to_stdvec(&result).unwrap();
    let grown = PARTICLES as f64 / f64::from(result.outcome.particles);
    let directory = std::env::temp_dir();
    let (from, to) = (directory.join("seawall_scaling.tmp"), directory.join("seawall_scaling"));
    let mut times: Vec<f64> = (0..101)
        .map(|_| {
            let start = Instant::now();
            std::fs::write(&from, &result_bytes).unwrap();
            std::fs::rename(&from, &to).unwrap();
            start.elapsed().as_secs_f64()
        })
        .collect();
    std::fs::remove_file(&to).ok();
    times.sort_by(f64::total_cmp);
    Measured {
        order_bytes: serde_json::to_string(&case).unwrap().len() as f64,
        result_bytes: result_bytes.len() as f64,
        checkpoint_bytes: trunk.checkpoint.len() as f64 * grown,
        record_s: times[50],
        seconds_per_cost,
    }
}

fn plan(cases: usize) -> Plan {
    let empty = toml::Table::new();
    let config = CaseConfig::from_tables(&empty, &empty).unwrap();
    let mut plan = Plan::default();
    let trunks = cases.div_ceil(BRANCHES);
    for trunk in 0..trunks {
        let first = plan.cases.len();
        let count = BRANCHES.min(cases - first);
        // Low waves are slower than high ones and take up to a third more steps.
        let steps = STEPS as f64 * (1.0 + 0.3 * (trunk % 7) as f64 / 7.0);
        let whole = (PARTICLES as f64 * steps) as u64;
        let cost = (whole as f64 * TRUNK_SHARE) as u64;
        for index in first..first + count {
            let branch_cost = whole - cost;
            plan.cases.push(PlannedCase { index, trunk: Some(trunk), cost: whole, branch_cost });
        }
        let branches = (first..first + count).collect();
        plan.trunks.push(PlannedTrunk { config: config.clone(), cost, branches });
    }
    plan
}

#[derive(Clone, Copy)]
enum Work {
    Trunk(usize),
    Case(usize),
}

struct Ranks {
    queues: Vec<VecDeque<(Work, f64, f64)>>,
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
        if let Some((work, ready, duration)) = self.queues[rank].pop_front() {
            let end = now.max(ready) + duration;
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
    bytes: f64,
}

fn simulate(plan: &Plan, count: usize, measured: &Measured) -> Outcome {
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
    let mut dice = 0x9E37_79B9_7F4A_7C15_u64;
    let mut jitter = move || {
        dice ^= dice << 13;
        dice ^= dice >> 7;
        dice ^= dice << 17;
        1.0 + JITTER * (2.0 * (dice >> 11) as f64 / (1_u64 << 53) as f64 - 1.0)
    };
    let mut handle = |event: Event, at: f64, extra: f64, ranks: &mut Ranks| {
        let start = Instant::now();
        manager.on(event, &mut commands);
        let spent = start.elapsed().as_secs_f64() + extra;
        coordinator = f64::max(coordinator, at) + spent;
        busy += spent;
        for command in commands.drain(..) {
            let order = LATENCY + PER_BYTE * measured.order_bytes;
            let arrival = coordinator + order;
            let (rank, work, ready, cost) = match command {
                Command::RunTrunk { rank, trunk } => {
                    (rank, Work::Trunk(trunk), arrival, plan.trunks[trunk].cost)
                }
                Command::RunCase { rank, case, from } => {
                    let fetch = from.filter(|source| source.holder != rank).map_or(0.0, |_| {
                        bytes += measured.checkpoint_bytes;
                        2.0 * LATENCY + PER_BYTE * measured.checkpoint_bytes
                    });
                    (rank, Work::Case(case), arrival + fetch, plan.cases[case].branch_cost)
                }
                Command::Drop { .. } | Command::Cancel => continue,
            };
            bytes += measured.order_bytes;
            let duration = cost as f64 * measured.seconds_per_cost * jitter();
            ranks.queues[rank].push_back((work, ready, duration));
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
        let (event, size, extra) = match work {
            Work::Trunk(trunk) => (Event::TrunkDone { rank, trunk, ok: true }, 64.0, 0.0),
            Work::Case(case) => {
                (Event::CaseDone { rank, case }, measured.result_bytes, measured.record_s)
            }
        };
        let arrival = end + LATENCY + PER_BYTE * size;
        if handle(event, arrival, extra, &mut ranks) {
            break;
        }
    }
    let _ = handle;
    let longest = plan.trunks.iter().map(|trunk| {
        let branch = trunk.branches.iter().map(|&case| plan.cases[case].branch_cost).max();
        trunk.cost + branch.unwrap_or(0)
    });
    let chain = longest.max().unwrap_or(0) as f64 * measured.seconds_per_cost;
    let bytes = bytes + plan.cases.len() as f64 * measured.result_bytes;
    Outcome {
        makespan: end,
        bound: chain.max(ranks.working_s / count as f64),
        busy: busy / end,
        bytes,
    }
}

fn main() {
    let nanoseconds = std::env::args().nth(1).map_or(150.0, |word| word.parse().unwrap());
    let measured = measure(nanoseconds * 1e-9);
    let mut text = format!(
        "# Scaling, by simulation\n\n\
         The real scheduler (`sweep::Manager`), driven with case times of {nanoseconds} ns per \
         particle and step\n({PARTICLES} particles, {STEPS} steps and more, durations off their \
         estimate by up to {:.0} %), {BRANCHES} branches per\ntrunk, one task at a time per rank, \
         messages of {:.0} µs and 1 GB/s. Measured and counted in: the\nscheduler's decisions, \
         {:.0} µs to record a case, orders of {:.1} kB, results of {:.0} kB, checkpoints of\n{:.2} \
         MB where a branch runs on another rank than its trunk. Made by \
         `examples/scaling.rs`.\n\nThe bound is the larger of all work over all ranks and the \
         longest trunk with its longest branch. With\nmore ranks than cases only the latter \
         counts.\n\n\
         | ranks | cases | makespan, s | bound, s | makespan over bound | coordinator busy | \
         messages, MB |\n|---|---|---|---|---|---|---|\n",
        100.0 * JITTER,
        1e6 * LATENCY,
        1e6 * measured.record_s,
        1e-3 * measured.order_bytes,
        1e-3 * measured.result_bytes,
        1e-6 * measured.checkpoint_bytes,
    );
    for ranks in [10, 100, 1_000, 10_000] {
        for cases in [300, 10_000, 100_000, 1_000_000] {
            let o = simulate(&plan(cases), ranks, &measured);
            writeln!(
                text,
                "| {ranks} | {cases} | {:.1} | {:.1} | {:.3} | {:.2} % | {:.0} |",
                o.makespan,
                o.bound,
                o.makespan / o.bound,
                100.0 * o.busy,
                1e-6 * o.bytes
            )
            .unwrap();
        }
    }
    std::fs::create_dir_all("results/performance").unwrap();
    std::fs::write("results/performance/scaling.md", &text).unwrap();
    print!("{text}");
}
