use super::*;

#[test]
fn every_item_is_written_once_and_by_its_own_part() {
    for threads in [1, 2, 3] {
        let team = Team::of(threads);
        let count = 10;
        for cuts in [vec![0, 10], vec![0, 1, 1, 7, 10], vec![0, 3, 4, 5, 9, 10]] {
            let mut parts: Vec<_> = cuts.windows(2).map(|ends| ends[0]..ends[1]).collect();
            let (mut single, mut double) = (vec![0; count], vec![[0; 2]; count]);
            let (rows, pairs) = (&mut single[..], double.as_flattened_mut());
            team.lead(|| {
                team.share(&mut parts, ([rows], pairs), &|part, ([rows], pairs)| {
                    assert_eq!((rows.len(), pairs.len()), (part.len(), 2 * part.len()));
                    for (place, item) in part.clone().enumerate() {
                        rows[place] += item;
                        pairs[2 * place] += item;
                        pairs[2 * place + 1] += 100 + item;
                    }
                });
            });
            assert!(single.iter().copied().eq(0..count), "{threads} {cuts:?} {single:?}");
            assert!((0..count).all(|k| double[k] == [k, 100 + k]), "{double:?}");
        }
    }
}

#[test]
fn short_work_takes_no_longer_than_the_clock_says() {
    for _ in 0..20 {
        let (clock, before) = (std::time::Instant::now(), thread_processor_time());
        std::hint::black_box((0..1_000_000_u64).fold(1, |a, b| std::hint::black_box(a ^ b)));
        let after = thread_processor_time();
        let most = clock.elapsed().as_secs_f64() + 3e-4;
        if let (Some(before), Some(after)) = (before, after) {
            assert!(after - before < most, "{} of {most}", after - before);
        }
    }
}

#[test]
fn the_time_of_a_team_counts() {
    let work = || (0..50_000_000_u64).fold(1, |a, b| std::hint::black_box(a ^ b));
    let before = thread_processor_time();
    Team::of(2).lead(work);
    let after = (own_processor_time(), thread_processor_time());
    if let (Some(before), (Some(own), Some(all))) = (before, after) {
        // It takes any processor longer than two milliseconds.
        assert!(all - before > 0.002 && own - before < 0.5 * (all - before), "{own} {all}");
    }
}
