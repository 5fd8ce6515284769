//! Signs of life: every rank sends one from time to time, and one that is silent for long is
//! reported.

use std::time::{Duration, Instant};

/// Number of signs of life within the time after which silence is reported.
const BEATS: u32 = 4;

/// A report on a rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum News {
    /// It has been silent for this long.
    Silent(usize, Duration),
    /// It has been heard again.
    Back(usize),
}

/// When each rank was last heard.
#[derive(Debug)]
pub(super) struct Pulse {
    patience: Duration,
    heard: Vec<Instant>,
    /// Whether the silence of a rank was reported.
    told: Vec<bool>,
    /// Ranks that have announced that they send no more.
    gone: Vec<bool>,
    spoke: Instant,
    looked: Instant,
}

impl Pulse {
    /// For this many ranks, all alive now. A rank that is silent for longer than `patience` is
    /// reported.
    pub(super) fn new(ranks: usize, patience: Duration, now: Instant) -> Pulse {
        let (heard, told, gone) = (vec![now; ranks], vec![false; ranks], vec![false; ranks]);
        Pulse { patience, heard, told, gone, spoke: now, looked: now }
    }

    /// A rank sends no more.
    pub(super) fn leave(&mut self, rank: usize) {
        self.gone[rank] = true;
    }

    /// A rank was heard, perhaps for the last time. Returns a report if its silence was reported.
    pub(super) fn hear(&mut self, rank: usize, now: Instant) -> Option<News> {
        self.heard[rank] = now;
        std::mem::take(&mut self.told[rank]).then_some(News::Back(rank))
    }

    /// Whether it is time for a sign of life; true once each time.
    pub(super) fn is_due(&mut self, now: Instant) -> bool {
        let due = now.duration_since(self.spoke) >= self.patience / BEATS;
        if due {
            self.spoke = now;
        }
        due
    }

    /// The ranks among these that are silent and not yet reported. While this process itself was
    /// stopped or busy, it heard nobody. So silence only counts from after that.
    pub(super) fn look(&mut self, ranks: impl Iterator<Item = usize>, now: Instant) -> Vec<News> {
        let away = now.duration_since(self.looked);
        self.looked = now;
        if away >= self.patience / BEATS {
            self.heard.iter_mut().for_each(|heard| *heard = now.max(*heard));
            return Vec::new();
        }
        let mut news = Vec::new();
        for rank in ranks {
            let silence = now.saturating_duration_since(self.heard[rank]);
            if silence >= self.patience && !self.told[rank] && !self.gone[rank] {
                self.told[rank] = true;
                news.push(News::Silent(rank, silence));
            }
        }
        news
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_silent_rank_is_told_once_and_once_more_when_it_is_back() {
        let start = Instant::now();
        let mut pulse = Pulse::new(3, 8 * SECOND, start);
        let mut told = Vec::new();
        for second in 1..30 {
            let now = start + second * SECOND;
            told.extend(pulse.hear(1, now));
            if second >= 20 {
                told.extend(pulse.hear(2, now));
            }
            told.extend(pulse.look(1..3, now));
        }
        pulse.leave(1);
        told.extend((30..50).flat_map(|second| {
            let back = pulse.hear(2, start + second * SECOND);
            pulse.look(1..3, start + second * SECOND).into_iter().chain(back)
        }));
        assert_eq!(told, [News::Silent(2, 8 * SECOND), News::Back(2)]);
    }

    #[test]
    fn who_did_not_listen_says_nothing_of_others() {
        let start = Instant::now();
        let mut pulse = Pulse::new(2, 8 * SECOND, start);
        assert_eq!(pulse.look(1..2, start + SECOND), []);
        assert_eq!(pulse.look(1..2, start + 100 * SECOND), [], "it was stopped itself");
        let told: Vec<_> =
            (101..120).flat_map(|second| pulse.look(1..2, start + second * SECOND)).collect();
        assert_eq!(told, [News::Silent(1, 8 * SECOND)]);
    }

    #[test]
    fn a_rank_that_is_heard_for_the_last_time_is_told_as_well() {
        let start = Instant::now();
        let mut pulse = Pulse::new(2, 2 * SECOND, start);
        assert_eq!(pulse.look(1..2, start), []);
        let looks = (1..9).map(|quarter| start + quarter * SECOND / 4);
        let told: Vec<_> = looks.flat_map(|now| pulse.look(1..2, now)).collect();
        assert_eq!(told, [News::Silent(1, 2 * SECOND)]);
        assert_eq!(pulse.hear(1, start + 3 * SECOND), Some(News::Back(1)));
        pulse.leave(1);
        assert_eq!(pulse.hear(1, start + 3 * SECOND), None);
    }

    #[test]
    fn beats_come_four_times_in_the_time_of_patience() {
        let start = Instant::now();
        let mut pulse = Pulse::new(1, 8 * SECOND, start);
        let due = (0..17).filter(|&second| pulse.is_due(start + second * SECOND)).count();
        assert_eq!(due, 8);
    }
}
