use super::*;

struct Stretch(Range<usize>);

impl Part for Stretch {
    fn items(&self) -> Range<usize> {
        self.0.clone()
    }
}

#[test]
fn every_item_is_written_once_and_by_its_own_part() {
    for threads in [1, 2, 3] {
        let team = Team::of(threads);
        let count = 10;
        for cuts in [vec![0, 10], vec![0, 1, 1, 7, 10], vec![0, 3, 4, 5, 9, 10]] {
            let mut parts: Vec<_> = cuts.windows(2).map(|ends| Stretch(ends[0]..ends[1])).collect();
            let (mut single, mut double) = (vec![0; count], vec![[0; 2]; count]);
            let (rows, pairs) = (&mut single[..], double.as_flattened_mut());
            team.lead(|| {
                team.share(&mut parts, ([rows], pairs), &|part, ([rows], pairs)| {
                    assert_eq!((rows.len(), pairs.len()), (part.0.len(), 2 * part.0.len()));
                    for (place, item) in part.0.clone().enumerate() {
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
    let work = |_: &mut Stretch, ()| {
        std::hint::black_box((0..50_000_000_u64).fold(1, |a, b| std::hint::black_box(a ^ b)));
    };
    let team = Team::of(2);
    let mut parts: Vec<_> = (0..8).map(|part| Stretch(part..part + 1)).collect();
    let before = thread_processor_time();
    team.lead(|| team.share(&mut parts, (), &work));
    let after = (own_processor_time(), thread_processor_time());
    if let (Some(before), (Some(own), Some(all))) = (before, after) {
        // No processor is done with it in sixteen milliseconds. The other thread had its share of it, unless it
        // never got a processor.
        assert!(all - before > 0.016 && own <= all, "{before} {own} {all}");
    }
}

#[test]
fn a_piece_that_panics_ends_the_work_and_the_next_goes_on() {
    let team = Team::of(3);
    let mut parts: Vec<_> = (0..12).map(|part| Stretch(part..part + 1)).collect();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let count = |_: &mut Stretch, ()| {
        done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    };
    let thrown = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        team.lead(|| {
            team.share(&mut parts, (), &|part, ()| {
                count(part, ());
                assert!(part.0.start != 7, "the eighth");
            });
        });
    }));
    assert!(thrown.is_err());
    assert_eq!(done.load(std::sync::atomic::Ordering::Relaxed), 12);
    team.lead(|| team.share(&mut parts, (), &count));
    assert_eq!(done.load(std::sync::atomic::Ordering::Relaxed), 24);
}

#[test]
fn work_within_work_and_beside_it_is_done() {
    let team = Team::of(2);
    let sum = std::sync::atomic::AtomicUsize::new(0);
    let add = |part: &mut Stretch, ()| {
        sum.fetch_add(part.0.start, std::sync::atomic::Ordering::Relaxed);
    };
    let within = |_: &mut Stretch, ()| {
        let mut inner: Vec<_> = (0..5).map(|part| Stretch(part..part + 1)).collect();
        team.lead(|| team.share(&mut inner, (), &add));
    };
    let mut parts: Vec<_> = (0..200).map(|part| Stretch(part..part + 1)).collect();
    team.lead(|| {
        for _ in 0..100 {
            team.share(&mut parts, (), &within);
        }
    });
    // Without a leader one thread does it all.
    team.share(&mut parts[..3], (), &within);
    assert_eq!(sum.load(std::sync::atomic::Ordering::Relaxed), 10 * (200 * 100 + 3));
}
