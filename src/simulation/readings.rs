//! Readings of the probes of a finished run.

use super::named_readings::{ProbeTable, Readings};
use crate::scene::{Probe, ProbeKind, Scene};
use crate::scheme::SolverSummary;

/// A pressure wave has arrived when it passes this share of ρgH.
const ARRIVAL: f64 = 0.1;
/// Span of the running mean that separates noise from the flow, over √(H/g).
const NOISE_SPAN: f64 = 0.1;
/// Buchner's plateau, over √(H/g).
const PLATEAU: [f64; 2] = [3.0, 5.3];
/// Time in which a column rings after its release, over √(H/g).
const RINGING: [f64; 2] = [0.0, 0.5];

/// Adds the readings of all probes, in the order of the scene.
pub(super) fn tell_probes(all: &mut Readings, scene: &Scene, probes: &[Probe], table: &ProbeTable) {
    let frame = scene.frame();
    let unit = (frame.depth / frame.gravity).sqrt();
    let full = frame.density * frame.gravity * frame.depth;
    for (column, probe) in probes.iter().enumerate() {
        let series: Vec<(f64, f64)> = table.rows().map(|(time, row)| (time, row[column])).collect();
        let mut push = |what: &str, value: Option<f64>, unit: &str| {
            all.tell(&format!("{}_{what}", probe.name), value, unit);
        };
        let pressure = probe.kind == ProbeKind::Pressure;
        match scene {
            Scene::Hydrostatic(_) if pressure => {
                let depth = frame.depth - probe.y_m.unwrap_or(0.0);
                let exact = frame.density * frame.gravity * depth;
                if exact <= 0.0 {
                    continue;
                }
                let gap = |value: f64| 100.0 * (value / exact - 1.0);
                let worst = series.iter().map(|&(_, p)| gap(p).abs()).fold(0.0, f64::max);
                let part = |from: f64, to: f64| {
                    mean(&series, [from * frame.end_time, to * frame.end_time]).map(gap)
                };
                push("worst_gap", Some(worst), "% of rho g depth");
                push("worst_gap_full", Some(worst * exact / full), "% of rho g h");
                push("mean_gap", part(0.0, 1.0), "% of rho g depth");
                let drift = part(0.8, 1.0).zip(part(0.2, 0.4)).map(|(late, early)| late - early);
                push("drift", drift, "% of rho g depth");
            }
            Scene::DamBreak(_) if pressure => {
                let over = |window: [f64; 2]| window.map(|time| time * unit);
                let arrived = series.iter().find(|(_, p)| *p > ARRIVAL * full);
                let dry_at_first = series.first().is_some_and(|&(_, p)| p < ARRIVAL * full);
                if dry_at_first {
                    push("arrival", arrived.map(|(time, _)| time / unit), "sqrt(H/g)");
                    push("plateau", mean(&series, over(PLATEAU)).map(|p| p / full), "rho g H");
                    let noise = noise(&series, over(PLATEAU), NOISE_SPAN * unit);
                    push("plateau_noise", noise.map(|p| p / full), "rho g H");
                } else {
                    let noise = noise(&series, over(RINGING), NOISE_SPAN * unit);
                    push("ringing", noise.map(|p| p / full), "rho g H");
                }
            }
            _ => {
                let highest = series.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1));
                push("max", highest.map(|(_, value)| value), probe.unit());
                push("max_time", highest.map(|(time, _)| time), "s");
            }
        }
    }
}

/// Mean over a window of time by the trapezoid rule; `None` if the series does not fill it.
fn mean(series: &[(f64, f64)], [from, to]: [f64; 2]) -> Option<f64> {
    let inside: Vec<_> = series.iter().filter(|(t, _)| *t >= from && *t <= to).collect();
    let (first, last) = (inside.first()?.0, inside.last()?.0);
    if last - first < 0.9 * (to - from) {
        return None;
    }
    let areas =
        inside.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0));
    Some(areas.sum::<f64>() / (last - first))
}

/// Root mean square of the difference from a centred running mean over `span`, in a window of time.
fn noise(series: &[(f64, f64)], [from, to]: [f64; 2], span: f64) -> Option<f64> {
    let mut squares = Vec::new();
    for &(time, value) in series.iter().filter(|(t, _)| *t >= from && *t <= to) {
        let near = series.iter().filter(|(t, _)| (t - time).abs() <= 0.5 * span);
        let (count, sum) = near.fold((0.0, 0.0), |(n, sum), (_, v)| (n + 1.0, sum + v));
        if count < 3.0 {
            return None;
        }
        squares.push((value - sum / count).powi(2));
    }
    let count = squares.len() as f64;
    (count > 0.0).then(|| (squares.iter().sum::<f64>() / count).sqrt())
}

/// Adds how the pressure equation was solved, and how incompressible the water stayed.
pub(super) fn tell_solver(all: &mut Readings, solver: &SolverSummary) {
    all.tell("solver_iterations_per_step", solver.iterations_per_step, "1");
    all.tell("solver_residual_max", solver.worst_residual, "1");
    all.tell("velocity_divergence_rms_max", solver.worst_divergence, "1");
    all.tell("volume_drift_max", solver.worst_volume_drift, "1");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_what_a_smooth_course_lacks() {
        let series = |noise: f64| -> Vec<(f64, f64)> {
            (0..2000)
                .map(|k| (0.001 * f64::from(k), if k % 2 == 0 { noise } else { -noise }))
                .map(|(t, n)| (t, 3.0 + 2.0 * t + n))
                .collect()
        };
        assert!(noise(&series(0.0), [0.5, 1.5], 0.05).unwrap() < 2e-3);
        assert!((noise(&series(0.1), [0.5, 1.5], 0.05).unwrap() - 0.1).abs() < 0.005);
        assert!((mean(&series(0.0), [0.5, 1.5]).unwrap() - 5.0).abs() < 1e-9);
        assert_eq!(mean(&series(0.0), [1.5, 2.5]), None);
        assert_eq!(noise(&series(0.0), [0.5, 1.5], 1e-4), None);
    }
}
