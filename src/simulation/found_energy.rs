//! Energy that has come from nowhere, over time.

use serde::{Deserialize, Serialize};

/// The result of every check of the energy budget.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Time, s; energy that has come from nowhere until then, J per metre of width; negative where
    /// some is lost.
    looks: Vec<[f64; 2]>,
}

impl Found {
    /// Makes room for this many more checks.
    pub fn make_room(&mut self, more: usize) {
        self.looks.reserve_exact(more);
    }

    /// Takes a check at a time, s: all other terms of the budget less the work done.
    pub fn push(&mut self, time: f64, found: f64) {
        self.looks.push([time, found]);
    }

    /// The most energy that had come from nowhere at any check until a time, s, J per metre of
    /// width; at least 0.
    pub fn most_until(&self, time: f64) -> f64 {
        let until = self.looks.iter().take_while(|look| look[0] <= time);
        until.map(|look| look[1]).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_found_later_does_not_count() {
        let mut found = Found::default();
        [(0.1, -1.0), (0.2, 2.0), (0.3, 1.0), (0.4, 5.0)]
            .into_iter()
            .for_each(|(time, joules)| found.push(time, joules));
        let until = [0.15, 0.2, 0.35, 9.0].map(|time| found.most_until(time));
        assert_eq!(until, [0.0, 2.0, 2.0, 5.0]);
    }
}
