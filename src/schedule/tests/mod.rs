//! The scheduler against a fake link: random orders, failures and interrupts.

mod makespan;

use super::*;
use crate::scene::CaseConfig;
use crate::study::{PlannedCase, PlannedTrunk};

/// xorshift: a test that fails can be repeated from its seed.
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

fn plan(trunks: usize, branches: usize, solo: usize, dice: &mut Dice) -> Plan {
    let empty = toml::Table::new();
    let config = CaseConfig::from_tables(&empty, &empty).unwrap();
    let mut plan = Plan::default();
    for trunk in 0..trunks {
        let cost = 50 + dice.below(50) as u64;
        let first = plan.cases.len();
        for index in first..first + branches {
            let branch_cost = 1 + dice.below(100) as u64;
            let trunk = Some(trunk);
            plan.cases.push(PlannedCase { index, trunk, cost: cost + branch_cost, branch_cost });
        }
        let branches = (first..first + branches).collect();
        plan.trunks.push(PlannedTrunk { config: config.clone(), cost, branches });
    }
    for _ in 0..solo {
        let cost = 1 + dice.below(200) as u64;
        let index = plan.cases.len();
        plan.cases.push(PlannedCase { index, trunk: None, cost, branch_cost: cost });
    }
    plan
}

/// Ranks that do their work, and check that it can be done.
struct FakeLink {
    running: Vec<(usize, Work)>,
    checkpoints: BTreeSet<(usize, usize)>,
    runs: Vec<u32>,
    cancelled: bool,
}

impl FakeLink {
    fn new(cases: usize) -> FakeLink {
        FakeLink {
            running: Vec::new(),
            checkpoints: BTreeSet::new(),
            runs: vec![0; cases],
            cancelled: false,
        }
    }

    fn obey(&mut self, commands: &mut Vec<Command>) {
        for command in commands.drain(..) {
            match command {
                Command::Run { rank, work, from } => {
                    assert!(!self.cancelled, "no work after an interrupt");
                    if let Some(Held { trunk, holder }) = from {
                        assert!(self.checkpoints.contains(&(holder, trunk)), "holder has it");
                        self.checkpoints.insert((rank, trunk));
                    }
                    self.running.push((rank, work));
                }
                Command::Drop { rank, trunk } => {
                    assert!(self.checkpoints.remove(&(rank, trunk)), "dropped once");
                }
                Command::Cancel => self.cancelled = true,
            }
        }
    }
}

struct Trouble {
    failing_trunks: bool,
    interrupt_after: Option<usize>,
}

fn simulate(plan: &Plan, capacities: &[usize], trouble: &Trouble, dice: &mut Dice) -> FakeLink {
    let mut manager = Manager::new(plan, capacities);
    let mut link = FakeLink::new(plan.cases.len());
    let mut commands = Vec::new();
    for rank in 0..capacities.len() {
        manager.on(Event::Ready { rank }, &mut commands);
        link.obey(&mut commands);
    }
    let mut events = 0;
    while !manager.finished() {
        assert!(!link.running.is_empty(), "work is left, but nothing runs");
        for (rank, &capacity) in capacities.iter().enumerate() {
            let tasks = link.running.iter().filter(|&&(at, _)| at == rank).count();
            assert!(tasks <= capacity.max(1) + 1, "at most one task is prefetched");
        }
        events += 1;
        let pick = dice.below(link.running.len());
        let (rank, work) = link.running.swap_remove(pick);
        let event = match work {
            _ if link.cancelled && dice.below(3) > 0 => Event::GivenBack { rank, work },
            Work::Trunk(trunk) => {
                let ok = !trouble.failing_trunks || dice.below(2) == 0;
                if ok {
                    link.checkpoints.insert((rank, trunk));
                }
                Event::Done { rank, work, ok }
            }
            Work::Case(case) => {
                link.runs[case] += 1;
                Event::Done { rank, work, ok: true }
            }
        };
        manager.on(event, &mut commands);
        link.obey(&mut commands);
        if trouble.interrupt_after == Some(events) {
            manager.on(Event::Interrupted, &mut commands);
            link.obey(&mut commands);
        }
    }
    assert!(link.running.is_empty());
    if !link.cancelled {
        assert_eq!(manager.unfinished(), 0);
        assert_eq!(manager.open, 0, "trunks that run or whose checkpoint is held");
        assert!(link.checkpoints.is_empty(), "left over: {:?}", link.checkpoints);
    }
    link
}

const CALM: Trouble = Trouble { failing_trunks: false, interrupt_after: None };

#[test]
fn every_case_runs_exactly_once_in_any_order() {
    for seed in 1..200 {
        let mut dice = Dice(seed);
        let plan = plan(dice.below(6), 2 + dice.below(9), dice.below(12), &mut dice);
        let capacities: Vec<_> = (0..1 + dice.below(7)).map(|_| 1 + dice.below(3)).collect();
        for failing_trunks in [false, true] {
            let trouble = Trouble { failing_trunks, ..CALM };
            let link = simulate(&plan, &capacities, &trouble, &mut dice);
            assert!(link.runs.iter().all(|&runs| runs == 1), "seed {seed}: {:?}", link.runs);
        }
    }
}

#[test]
fn an_interrupt_stops_everything_and_loses_nothing() {
    for seed in 1..100 {
        let mut dice = Dice(seed);
        let plan = plan(3, 6, 5, &mut dice);
        let trouble = Trouble { interrupt_after: Some(1 + dice.below(12)), ..CALM };
        let link = simulate(&plan, &[1, 2], &trouble, &mut dice);
        assert!(link.cancelled);
        assert!(link.runs.iter().all(|&runs| runs <= 1));
    }
}

#[test]
fn trunks_start_in_order_of_their_longest_chain() {
    let mut dice = Dice(5);
    let mut plan = plan(3, 2, 0, &mut dice);
    plan.trunks[1].cost = 1000;
    let mut manager = Manager::new(&plan, &[1]);
    let mut commands = Vec::new();
    manager.on(Event::Ready { rank: 0 }, &mut commands);
    assert_eq!(commands[0], Command::Run { rank: 0, work: Work::Trunk(1), from: None });
}

#[test]
fn branches_prefer_the_rank_of_their_trunk() {
    let mut dice = Dice(9);
    let plan = plan(2, 40, 0, &mut dice);
    let mut manager = Manager::new(&plan, &[1, 1]);
    let mut commands = Vec::new();
    manager.on(Event::Ready { rank: 0 }, &mut commands);
    manager.on(Event::Ready { rank: 1 }, &mut commands);
    let trunk_of = |rank: usize, commands: &[Command]| {
        commands.iter().find_map(|command| match *command {
            Command::Run { rank: at, work: Work::Trunk(trunk), .. } if at == rank => Some(trunk),
            _ => None,
        })
    };
    let trunks = [trunk_of(0, &commands).unwrap(), trunk_of(1, &commands).unwrap()];
    commands.clear();
    for rank in [0, 1] {
        let work = Work::Trunk(trunks[rank]);
        manager.on(Event::Done { rank, work, ok: true }, &mut commands);
    }
    let far = |command: &&Command| {
        matches!(command, Command::Run { rank, from: Some(source), .. }
            if *rank != source.holder)
    };
    assert_eq!(commands.iter().find(far), None);
    assert!(commands.len() >= 2);
}

#[test]
fn a_million_cases_on_ten_thousand_ranks_are_scheduled_in_seconds() {
    let mut dice = Dice(3);
    let plan = plan(1000, 1000, 0, &mut dice);
    let ranks = 10_000;
    let mut manager = Manager::new(&plan, &vec![1; ranks]);
    let mut commands = Vec::new();
    let mut running = std::collections::VecDeque::new();
    for rank in 0..ranks {
        manager.on(Event::Ready { rank }, &mut commands);
    }
    let mut runs = 0;
    loop {
        for command in commands.drain(..) {
            if let Command::Run { rank, work, .. } = command {
                runs += usize::from(matches!(work, Work::Case(_)));
                running.push_back(Event::Done { rank, work, ok: true });
            }
        }
        let Some(event) = running.pop_front() else { break };
        manager.on(event, &mut commands);
    }
    assert_eq!(runs, 1_000_000);
    assert!(manager.finished());
}
