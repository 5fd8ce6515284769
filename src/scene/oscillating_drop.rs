//! A drop in a central field that oscillates between ellipses for a long time: no walls, an exact
//! answer.

use std::f64::consts::TAU;

use super::contract::{SceneOfKind, Walls};
use super::filling::Filling;
use super::frame::Frame;
use super::numerics::Numerics;
use super::tank::Tank;
use crate::keys::{ConfigError, Range, section};
use crate::math::simd::SimdPath;
use crate::theory::central_field::CentralField;
use crate::theory::elliptic_drop::EllipticDrop;

section! {
    /// The `[scene]` table with `kind = "oscillating-drop"`, complete: the drop's centre is the origin.
    pub struct OscillatingDropScene in "scene" {
        /// R of the circle that it starts as.
        radius_m: f64 = 1.0, unit("m").within(1e-6, 1e6);
        /// Ω of the central acceleration -Ω² r; `sound_speed_ratio` is over Ω R.
        field_rate_per_s: f64 = 1.0, unit("1/s").within(1e-6, 1e6);
        /// A at the start: u = A x, v = -A y; at most 3 Ω.
        stretching_rate_per_s: f64 = 0.4, unit("1/s").above_zero();
        /// ρ0.
        water_density_kg_per_m3: f64 = 1000.0, unit("kg/m³").above_zero();
        /// The run ends after this many exact periods.
        end_after_periods: f64 = 3.0, plain().above_zero();
        /// Spacing of the history's samples.
        history_interval_s: Option<f64> = None, unit("s").above_zero().otherwise("a 100th of a period");
    }
}

/// Places on rings about the origin: (x, y, area).
struct Rings(Vec<[f64; 3]>);

impl Rings {
    fn new(radius: f64, spacing: f64) -> Rings {
        let count = (radius / spacing).round().max(1.0);
        let width = radius / count;
        let mut points = Vec::new();
        for ring in 0..count as u32 {
            let radius = (f64::from(ring) + 0.5) * width;
            let members = (TAU * radius / width).round();
            let area = TAU * radius * width / members;
            for k in 0..members as u32 {
                // Every other ring is turned by half a place.
                let angle = TAU * (f64::from(k) + 0.5 * f64::from(ring % 2)) / members;
                points.push([radius * libm::cos(angle), radius * libm::sin(angle), area]);
            }
        }
        Rings(points)
    }
}

impl OscillatingDropScene {
    /// The drop at its start.
    pub fn drop_at_start(&self) -> EllipticDrop {
        EllipticDrop::circle(self.radius_m, self.field_rate_per_s, self.stretching_rate_per_s)
    }

    fn rings(&self, numerics: &Numerics) -> Rings {
        Rings::new(self.radius_m, numerics.particle_spacing_m)
    }
}

impl SceneOfKind for OscillatingDropScene {
    fn depth_name(&self) -> &'static str {
        "drop's diameter"
    }

    fn walls(&self) -> Walls {
        Walls::None
    }

    fn not_for_isph(&self) -> Option<&'static str> {
        Some("lies in a central field, which isph does not know")
    }

    fn frame(&self) -> Frame {
        let period = self.drop_at_start().period();
        Frame {
            length: 2.0 * self.radius_m,
            depth: 2.0 * self.radius_m,
            gravity: 0.0,
            speed: Some(self.field_rate_per_s * self.radius_m),
            density: self.water_density_kg_per_m3,
            end_time: self.end_after_periods * period,
            history_interval: self.history_interval_s.unwrap_or(period / 100.0),
        }
    }

    fn water_area(&self) -> f64 {
        std::f64::consts::PI * self.radius_m * self.radius_m
    }

    fn particles(&self, numerics: &Numerics) -> usize {
        self.rings(numerics).0.len()
    }

    fn validate(&self, _: &Numerics) -> Result<(), ConfigError> {
        let most = 3.0 * self.field_rate_per_s;
        let range = Range::Within(1e-6 * most, most);
        range.check("scene.stretching_rate_per_s", self.stretching_rate_per_s)
    }

    fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (frame, start) = (self.frame(), self.drop_at_start());
        let state = frame.state_equation(numerics, frame.density);
        let points = self.rings(numerics).0.into_iter().map(|[x, y, area]| {
            let pressure = frame.density * start.pressure_over_density([x, y]);
            let density = state.density(pressure);
            [x, y, density, density * area]
        });
        let lattice = self.lattice(numerics);
        let filling = Filling {
            walls: self.walls(),
            field: Some(CentralField { centre: [0.0; 2], rate: self.field_rate_per_s }),
            ..Filling::of(lattice, points.collect(), frame.density)
        };
        let filling = filling.moving(|place| start.velocity(place));
        let other_speed = self.stretching_rate_per_s * self.radius_m;
        Tank { other_speed, ..filling.tank(frame, numerics, path) }
    }
}
