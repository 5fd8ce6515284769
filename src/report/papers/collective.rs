//! Numbers that the papers print for many cases at once: how much a response changes with the
//! spring's stiffness.

use super::Found;
use crate::math::lists::grouped;
use crate::papers::Printed;
use crate::quantities::Column;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, LOG10_K_STAR, SEAWALL_MASS,
    WAVE_HEIGHT_RATIO,
};
use crate::report::config::Config;
use crate::report::row::Row;

/// Tolerance of limits, as they are printed with two digits.
const SLACK: f64 = 0.01;
/// Below this log₁₀ k* a wall counts as free. Above its opposite it counts as fixed.
const FREE: f64 = -4.0;

/// The kind of a number for many cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// The largest change of a response on one side of a stiffness, percent of its value at the far end.
    Change { of: &'static Column, below: bool },
    /// The largest value from this stiffness on.
    Above { of: &'static Column },
    /// The runup at a nearly fixed wall over that at a free wall, less one, percent.
    Rise,
}

type Case<'a> = (&'a Row, &'a Config);

impl Kind {
    /// The kind with this name in `data/paper_values.csv`.
    pub fn of(quantity: &str) -> Option<Kind> {
        let (x, f, r) = (&DISPLACEMENT_MAX, &FIRST_FORCE_MAX, &FIRST_RUNUP_MAX);
        Some(match quantity {
            "displacement_change_below" => Kind::Change { of: x, below: true },
            "displacement_above" => Kind::Above { of: x },
            "first_force_change_below" => Kind::Change { of: f, below: true },
            "first_force_change_above" => Kind::Change { of: f, below: false },
            "first_runup_change_below" => Kind::Change { of: r, below: true },
            "first_runup_change_above" => Kind::Change { of: r, below: false },
            "runup_rise" => Kind::Rise,
            _ => return None,
        })
    }

    /// The wave and mass with the largest value, for every way in which the cases were computed.
    pub fn found<'a>(self, printed: &'static Printed, cases: &[Case<'a>]) -> Vec<Found<'a>> {
        let mut found: Vec<Found> = Vec::new();
        for group in groups(cases) {
            let Some((computed, (row, config))) = self.read(printed, &group) else { continue };
            let new = Found { printed, row, config, computed, error: None, bound: false };
            match found.iter_mut().find(|old| old.row.variant == row.variant) {
                Some(old) if old.computed >= computed => {}
                Some(old) => *old = new,
                None => found.push(new),
            }
        }
        found
    }

    /// For cases of one wave and mass: the value, and the case that has it.
    fn read<'a>(self, printed: &Printed, group: &[Case<'a>]) -> Option<(f64, Case<'a>)> {
        match self {
            Kind::Change { of, below } => {
                let limit = printed.log10_k_star?;
                let side = |k: f64| if below { k <= limit + SLACK } else { k >= limit - SLACK };
                let mut values = values(group, of, side);
                if !below {
                    values.reverse();
                }
                let (_, outer, _) = *values.first().filter(|_| values.len() > 1)?;
                let change = |value: f64| 100.0 * ((value - outer) / outer).abs();
                let changes = values.iter().map(|&(_, value, case)| (change(value), case));
                changes.filter(|change| change.0.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0))
            }
            Kind::Above { of } => {
                let limit = printed.log10_k_star?;
                let values = values(group, of, |k| k >= limit - SLACK).into_iter();
                values.map(|(_, value, case)| (value, case)).max_by(|a, b| a.0.total_cmp(&b.0))
            }
            Kind::Rise => {
                let free = values(group, &FIRST_RUNUP_MAX, |k| k < FREE);
                let fixed = values(group, &FIRST_RUNUP_MAX, |k| k > -FREE);
                let ((_, free, case), (_, fixed, _)) = (*free.first()?, *fixed.last()?);
                Some((100.0 * (fixed / free - 1.0), case))
            }
        }
    }
}

/// Stiffness, value and case, in order of rising stiffness.
fn values<'a>(
    group: &[Case<'a>],
    column: &Column,
    side: impl Fn(f64) -> bool,
) -> Vec<(f64, f64, Case<'a>)> {
    let value = |&(row, config): &Case<'a>| {
        let stiffness = row.number(&LOG10_K_STAR).filter(|&k| side(k))?;
        Some((stiffness, row.number(column)?, (row, config)))
    };
    let mut values: Vec<_> = group.iter().filter_map(value).collect();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    values
}

/// Cases of the same wave, mass and variant.
fn groups<'a>(cases: &[Case<'a>]) -> Vec<Vec<Case<'a>>> {
    let keyed = cases.iter().map(|&(row, config)| {
        let place = [&WAVE_HEIGHT_RATIO, &SEAWALL_MASS];
        let place = place.map(|column| row.number(column).map(f64::to_bits));
        ((&row.variant, place), (row, config))
    });
    grouped(keyed)
}
