//! Axes and period of a drop that oscillates between ellipses.

use super::{Watch, half_swings, remembers};
use crate::pairs::Fluid;
use crate::simulation::named_readings::Readings;
use crate::theory::elliptic_drop::EllipticDrop;

/// Follows the semi-axes, and those of the exact drop.
pub(super) struct Drop {
    start: EllipticDrop,
    exact: (f64, EllipticDrop),
    /// (a - b)/R over time.
    series: Vec<(f64, f64)>,
    worst: f64,
    longest: [f64; 2],
    area: f64,
}

impl Drop {
    pub(super) fn new(start: EllipticDrop) -> Drop {
        Drop {
            start,
            exact: (0.0, start),
            series: Vec::new(),
            worst: 0.0,
            longest: [0.0; 2],
            area: 1.0,
        }
    }
}

/// Semi-axes by second moments: <x²> = a²/4 in an even ellipse; metres.
fn axes(fluid: &Fluid) -> [f64; 2] {
    let mass: f64 = fluid.mass.iter().sum();
    [&fluid.x, &fluid.y].map(|places| {
        let terms = places.iter().zip(&fluid.mass);
        let (sum, squares) = terms.fold((0.0, 0.0), |(sum, squares), (place, mass)| {
            (sum + mass * place, squares + mass * place * place)
        });
        2.0 * (squares / mass - (sum / mass) * (sum / mass)).max(0.0).sqrt()
    })
}

impl Watch for Drop {
    remembers!(exact, series, worst, longest, area);

    fn sample(&mut self, time: f64, fluid: &Fluid) {
        let [a, b] = axes(fluid);
        let (since, exact) = self.exact;
        if time > since {
            self.exact = (time, exact.after(time - since));
        }
        let radius = self.start.radius;
        let should = self.exact.1.axes();
        let gap = (a - should[0]).abs().max((b - should[1]).abs());
        self.worst = self.worst.max(gap / radius);
        self.longest = [self.longest[0].max(a / radius), self.longest[1].max(should[0] / radius)];
        self.area = a * b / (radius * radius);
        self.series.push((time, (a - b) / radius));
    }

    fn tell(&self, _: &Fluid, all: &mut Readings) {
        let exact = self.start.period();
        all.tell("longest_axis", self.longest[0], "R");
        all.tell("longest_axis_exact", self.longest[1], "R");
        all.tell("axis_gap", 100.0 * self.worst, "% of R, largest over the run");
        all.tell("area_gap", 100.0 * (self.area - 1.0), "% of pi R2, at the end");
        all.tell("period_exact", exact, "s");
        // The start itself is a zero crossing, and noise may cross zero there again.
        let later: Vec<_> = self.series.iter().copied().filter(|(t, _)| *t > 0.1 * exact).collect();
        if let Some((half, peaks)) = half_swings(&later) {
            all.tell("period", 2.0 * half, "s");
            all.tell("period_gap", 100.0 * (2.0 * half / exact - 1.0), "%");
            let swing = |drop: EllipticDrop| {
                let [a, b] = drop.axes();
                (a - b) / drop.radius
            };
            let should = swing(self.start.after(0.25 * exact)).abs();
            if let Some((_, last)) = peaks.last() {
                let gap = 100.0 * (last / should - 1.0);
                all.tell("swing_gap", gap, "% of the exact a - b, last peak");
            }
        }
    }
}
