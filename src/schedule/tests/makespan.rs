//! The time that plans take, compared with the shortest possible time.

use super::*;

/// The time that a plan takes on ranks that run one task after the other.
fn makespan(plan: &Plan, ranks: usize) -> u64 {
    let mut manager = Manager::new(plan, &vec![1; ranks]);
    let mut commands = Vec::new();
    for rank in 0..ranks {
        manager.on(Event::Ready { rank }, &mut commands);
    }
    let mut free_at = vec![0; ranks];
    let mut ends = BTreeSet::new();
    let mut now = 0;
    loop {
        for command in commands.drain(..) {
            let Command::Run { rank, work, from } = command else { continue };
            let cost = match work {
                Work::Trunk(trunk) => plan.trunks[trunk].cost,
                Work::Case(case) if from.is_some() => plan.cases[case].branch_cost,
                Work::Case(case) => plan.cases[case].cost,
            };
            free_at[rank] = free_at[rank].max(now) + cost;
            ends.insert((free_at[rank], rank, work));
        }
        let Some((end, rank, work)) = ends.pop_first() else { return now };
        now = end;
        manager.on(Event::Done { rank, work, ok: true }, &mut commands);
    }
}

#[test]
fn nobody_idles_for_long() {
    let mut dice = Dice(11);
    let mut plan = plan(5, 60, 0, &mut dice);
    for case in &mut plan.cases {
        case.branch_cost = 90 + dice.below(20) as u64;
    }
    for trunk in &mut plan.trunks {
        trunk.cost = 80;
    }
    for (ranks, slack) in [(1, 0), (2, 110), (4, 250), (16, 300), (64, 300)] {
        let ideal = plan.total_cost() / ranks as u64;
        let taken = makespan(&plan, ranks);
        assert!(taken <= ideal + slack, "{ranks} ranks: {taken} instead of {ideal}");
    }
}

#[test]
fn dearer_branches_are_shared_so_that_all_ranks_end_together() {
    let mut plan = plan(2, 20, 0, &mut Dice(7));
    for (place, case) in plan.cases.iter_mut().enumerate() {
        case.branch_cost = if place < 20 { 107 } else { 100 };
    }
    for trunk in &mut plan.trunks {
        trunk.cost = 80;
    }
    // With one trunk's branches on each rank it would take 70 longer.
    assert_eq!(makespan(&plan, 2), plan.total_cost().div_ceil(2));
}
