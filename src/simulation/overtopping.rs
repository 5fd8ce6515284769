//! Water that goes over the crest of a wall: its volume, thickness and speed.

use serde::{Deserialize, Serialize};

use super::looks::Looks;
use super::named_readings::{ProbeColumn, Readings};
use super::outcome::Overtopped;
use crate::boundary::Crest;
use crate::pairs::Fluid;
use crate::scene::{CREST_COLUMNS, Tank};
use crate::scheme::Scheme;

/// Width of a column on the crest, in particle spacings.
const COLUMN: f64 = 3.0;
/// Water counts as gone over gradually, along this many particle spacings around the back.
const WAY: f64 = 5.0;
/// Water of a wave still goes over while the discharge is above this share of its maximum.
const STILL_GOES: f64 = 0.02;
/// A column has a speed if it holds the water of at least this many particles.
const FEWEST: f64 = 3.0;

/// Water on the crest and behind it at an instant, per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Sight {
    /// Water behind the back, less that at the start, m².
    pub volume: f64,
    /// Water beyond the back, m². Water near the back counts in part: see [`passed`].
    pub beyond: f64,
    /// Growth of `beyond` since the last look, m²/s.
    pub discharge: f64,
    /// Of the fullest column, m.
    pub thickness: f64,
    /// Of the fastest column, m/s; none if no column has a speed.
    pub speed: Option<f64>,
}

/// Follows the water that goes over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Overtopping {
    /// Mass of all water at the start, kg per metre of width.
    start_mass: f64,
    looks: Looks,
    /// Time of the last look, s.
    looked: Option<f64>,
    last: Sight,
    most: Sight,
}

impl Overtopping {
    /// No water has gone over yet.
    pub fn open(fluid: &Fluid) -> Overtopping {
        let (looks, looked, last, most) = Default::default();
        Overtopping { start_mass: mass(fluid), looks, looked, last, most }
    }

    /// Whether to look now, from `start` on, s; see [`Looks::is_due`].
    pub fn is_due(&mut self, time: f64, start: f64, intervals: (f64, f64)) -> bool {
        self.looks.is_due(time, start, intervals)
    }

    /// Looks at the water at a time, s.
    pub fn look(&mut self, time: f64, tank: &Tank, crest: &Crest) {
        let (looked, before) = (self.looked.replace(time), self.last.beyond);
        self.last = sight(tank, crest);
        self.last.discharge =
            looked.map_or(0.0, |then| (self.last.beyond - before) / (time - then));
        let (most, last) = (&mut self.most, self.last);
        most.volume = last.volume;
        most.discharge = most.discharge.max(last.discharge);
        most.thickness = most.thickness.max(last.thickness);
        // `None` is less than any speed.
        most.speed = if last.speed > most.speed { last.speed } else { most.speed };
    }

    /// The results of the last look, in the order of [`columns`].
    pub fn values(&self) -> [f64; 4] {
        let Sight { volume, discharge, thickness, speed, .. } = self.last;
        [volume, discharge, thickness, speed.unwrap_or(0.0)]
    }

    /// The water that has gone over by now.
    pub fn overtopped(&self) -> Overtopped {
        let Sight { volume, discharge, thickness, speed, .. } = self.most;
        Overtopped {
            volume_m2: volume,
            discharge_max_m2_per_s: discharge,
            thickness_max_m: thickness,
            speed_max_m_per_s: speed,
        }
    }

    /// Whether water of a wave still goes over.
    pub fn goes_on(&self) -> bool {
        self.last.discharge > STILL_GOES * self.most.discharge
    }

    /// Tells where all the water is.
    pub fn tell(&self, water: &dyn Scheme, all: &mut Readings) {
        let (taken, left) = (water.taken(), mass(water.fluid()));
        let on_top = |fluid: &Fluid, [front, back]: [f64; 2]| -> f64 {
            let on = (0..fluid.len()).filter(|&k| fluid.x[k] > front && fluid.x[k] <= back);
            on.fold(0.0, |sum, k| sum + fluid.mass[k])
        };
        let crest = water.walls().crest.as_ref();
        let on_crest = crest.map(|at| on_top(water.fluid(), at.ends));
        let kept = crest.filter(|crest| crest.end.is_some());
        let behind = kept.map(|at| on_top(water.fluid(), [at.ends[1], f64::INFINITY]));
        let before = left - on_crest.unwrap_or(0.0) - behind.unwrap_or(0.0);
        all.tell("water_at_start", self.start_mass, "kg/m");
        all.tell("water_in_tank", before, "kg/m");
        all.tell("water_on_crest", on_crest, "kg/m");
        all.tell("water_taken_away", taken.mass, "kg/m");
        all.tell("particles_taken_away", f64::from(taken.particles), "");
        all.tell("water_gap", self.start_mass - left - taken.mass, "kg/m");
        all.tell("water_behind", behind, "kg/m");
    }
}

/// Columns of `probes/<case_id>.csv`, behind those of the probes.
pub(super) fn columns() -> [ProbeColumn; 4] {
    let told = [
        ("m2", "mass behind the back of the crest over the density"),
        ("m2/s", "growth of the water beyond the back of the crest, over five spacings around it"),
        ("m", "volume of the fullest column on the crest over its width"),
        ("m/s", "momentum over mass of the fastest column on the crest"),
    ];
    std::array::from_fn(|at| ProbeColumn {
        name: CREST_COLUMNS[at].to_owned(),
        unit: told[at].0.to_owned(),
        method: told[at].1.to_owned(),
    })
}

fn mass(fluid: &Fluid) -> f64 {
    fluid.mass.iter().sum()
}

/// Beginnings of columns of this width that cover the crest. The first begins at its front, the
/// last ends at its back. They overlap if no whole number of them fits, so that nothing jumps where
/// a column is added.
fn beginnings([front, back]: [f64; 2], width: f64) -> impl Iterator<Item = f64> {
    let room = back - front - width;
    let steps = (room / width - 1e-9).ceil().max(0.0);
    (0..=steps as usize).map(move |k| if k == 0 { front } else { front + room * k as f64 / steps })
}

/// The share of a particle that counts as gone over: none half a `WAY` before the back, all half a
/// `WAY` behind it.
///
/// Its slope is (15/8) (1 - (2 at)²)². With it, rows of particles at any distance give a steady
/// sum. With a share that grows linearly, the sum would rise and fall by up to a third.
fn passed(at: f64) -> f64 {
    let part = (at + 0.5).clamp(0.0, 1.0);
    part * part * part * (part * (6.0 * part - 15.0) + 10.0)
}

/// The water at an instant. The discharge needs two instants.
fn sight(tank: &Tank, crest: &Crest) -> Sight {
    let (water, spacing, density) = (tank.water.as_ref(), tank.spacing, tank.frame.density);
    let [front, back] = crest.ends;
    let width = (COLUMN * spacing).min(back - front);
    let fluid = water.fluid();
    let mut behind = water.taken().mass - tank.mass_behind;
    let mut beyond = water.taken().mass;
    let mut on_top = Vec::new();
    let way = (WAY * spacing).min(2.0 * (back - front));
    for k in (0..fluid.len()).filter(|&k| fluid.x[k] > front) {
        let mut past = fluid.x[k] - back;
        if past > 0.0 {
            // Water that flows down the back has gone over, and is taken away there.
            past += (crest.height - fluid.y[k]).max(0.0);
        }
        beyond += fluid.mass[k] * passed(past / way);
        if fluid.x[k] > back {
            behind += fluid.mass[k];
        } else {
            on_top.push(k);
        }
    }
    // Mass and momentum along the crest, column by column.
    let columns: Vec<[f64; 2]> = beginnings(crest.ends, width)
        .map(|from| {
            let inside = on_top.iter().filter(|&&k| (from..=from + width).contains(&fluid.x[k]));
            inside.fold([0.0; 2], |[mass, momentum], &k| {
                [mass + fluid.mass[k], momentum + fluid.mass[k] * fluid.vx[k]]
            })
        })
        .collect();
    // Half a particle less, because particles weigh a little less than their cell.
    let fewest = (FEWEST - 0.5) * density * spacing * spacing;
    let moving = columns.iter().filter(|[mass, _]| *mass > fewest);
    Sight {
        volume: behind / density,
        beyond: beyond / density,
        discharge: 0.0,
        thickness: columns.iter().map(|[mass, _]| mass / (density * width)).fold(0.0, f64::max),
        speed: moving.map(|[mass, momentum]| (momentum / mass).max(0.0)).reduce(f64::max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest discharge of a steady stream was once a fifth too high at sixteen rows, as whole
    /// columns of particles came and went.
    #[test]
    fn columns_of_particles_go_by_as_a_steady_stream() {
        for apart in [0.8, 1.0, 1.13, 1.3] {
            let beyond = |at: f64| -> f64 {
                (-9..=9).map(|n| apart * passed((f64::from(n) * apart + at) / WAY)).sum()
            };
            for step in 0..10 {
                let at = 0.1 * apart * f64::from(step);
                let stream = (beyond(at + 0.01) - beyond(at)) / 0.01;
                assert!((stream - 1.0).abs() < 0.02, "{stream} at {apart}");
            }
        }
    }

    #[test]
    fn water_goes_over_until_a_fiftieth_of_the_largest_discharge() {
        let goes_on = |discharge: f64| {
            let mut all = Overtopping::open(&Fluid::default());
            (all.most.discharge, all.last.discharge) = (1.0, discharge);
            all.goes_on()
        };
        assert_eq!([0.03, 0.01, 0.0, -0.1].map(goes_on), [true, false, false, false]);
    }

    #[test]
    fn columns_cover_the_crest_and_grow_in_number_without_a_jump() {
        let of = |back: f64| beginnings([1.0, back], 0.1).collect::<Vec<_>>();
        assert_eq!(of(1.1), [1.0]);
        for back in [1.11, 1.199, 1.2, 1.201, 1.37] {
            let all = of(back);
            assert!((all.last().unwrap() + 0.1 - back).abs() < 1e-12, "{all:?}");
            assert!(all.windows(2).all(|pair| pair[1] - pair[0] < 0.1 + 1e-9), "{all:?}");
        }
        assert_eq!([of(1.199).len(), of(1.2).len(), of(1.201).len()], [2, 2, 3]);
    }
}
