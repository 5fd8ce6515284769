//! What tank, paddle and wall of a seawall require of each other.

use super::leaning;
use super::numerics::{Numerics, Scheme};
use super::seawall::{FORCE_COUPLING, PaddleChoice, SeawallScene, THRESHOLD_RATIO, error};
use crate::body::CaissonKeys;
use crate::keys::ConfigError;
use crate::math::decimal::{rounded_down, rounded_up};

/// Number of instants of a stroke at which its reach is checked.
const INSTANTS: u32 = 200;
/// Digits of bounds in messages.
pub(super) const DIGITS: usize = 4;
/// A paddle that never stops is checked for this long, seconds.
const LONGEST: f64 = 1e4;

impl SeawallScene {
    /// Checks tank, paddle and wall against each other.
    pub(super) fn validate_parts(&self) -> Result<(), ConfigError> {
        if self.wave_gauge_m >= self.tank_length_m {
            return error("wave_gauge_m", self.wave_gauge_m, "must lie inside the tank");
        }
        self.validate_end()?;
        self.validate_paddle()?;
        self.validate_wall()
    }

    fn validate_end(&self) -> Result<(), ConfigError> {
        if let Some(end) = self.end_time_s {
            let start = self.start_s();
            let allowed = format!("must be after {start} s, where the recorded stroke begins");
            return if end > start { Ok(()) } else { error("end_time_s", end, &allowed) };
        }
        if self.wave_height_ratio == 0.0 {
            return error("end_time_s", "", "is needed where wave_height_ratio = 0");
        }
        if self.paddle != PaddleChoice::Solitary {
            return error("end_time_s", "", "is needed where no stroke ends a run");
        }
        Ok(())
    }

    fn validate_paddle(&self) -> Result<(), ConfigError> {
        if let Some((keys, waves)) = self.wave_train.as_ref().zip(self.regular_waves())
            && !waves.is_fit(self.wave_height_ratio, self.still_water_depth_m)
        {
            let allowed = format!(
                "must be {} s or less: longer waves are too long for their height, as H L²/h³ must be below 8π²/3",
                rounded_down(self.longest_period_s(), DIGITS)
            );
            return error("wave_period_s", keys.wave_period_s, &allowed);
        }
        let reach = self.recorded.as_ref().map_or(0.0, |keys| keys.recorded_stroke.reach());
        if reach > 0.5 * self.tank_length_m {
            let allowed = format!("goes {reach:.3} m far, more than half the tank's length");
            return error("recorded_stroke", "", &allowed);
        }
        let forth = self.paddle().map_or(0.0, |paddle| paddle.goes_forth());
        if forth >= self.tank_length_m {
            let allowed = format!(
                "must be more than {}, as far as the paddle goes in water of still_water_depth_m = {}",
                rounded_up(forth, DIGITS),
                self.still_water_depth_m
            );
            return error("tank_length_m", self.tank_length_m, &allowed);
        }
        Ok(())
    }

    /// The period at which regular waves of this height have the largest allowed length: (kh)² =
    /// 3/2 H/h.
    fn longest_period_s(&self) -> f64 {
        let long = (1.5 * self.wave_height_ratio).sqrt();
        let rate = self.gravity_m_per_s2 / self.still_water_depth_m * long * libm::tanh(long);
        std::f64::consts::TAU / rate.sqrt()
    }

    fn validate_wall(&self) -> Result<(), ConfigError> {
        let angle = self.wall_angle_deg;
        if self.wall.moves() && angle != 90.0 {
            let allowed = format!(
                "a {} is vertical: leave it out, or set scene.wall = \"fixed\"",
                self.wall.words()
            );
            return error("wall_angle_deg", angle, &allowed);
        }
        if !self.wall.has_threshold() {
            let keys = [
                ("threshold_ratio", self.threshold_ratio, THRESHOLD_RATIO),
                ("force_coupling", self.force_coupling, FORCE_COUPLING),
            ];
            if let Some((key, value, _)) = keys.iter().find(|(_, value, default)| value != default)
            {
                let allowed = format!("is not for a {}: leave it out", self.wall.words());
                return error(key, value, &allowed);
            }
        }
        self.caisson.as_deref().map_or(Ok(()), CaissonKeys::validate)?;
        leaning::validate(angle, self.still_water_depth_m, self.tank_length_m)
    }

    /// Still water depth at the wall, metres; 0 if the wall is dry.
    pub fn depth_at_wall_m(&self) -> f64 {
        let toe = self.bed.as_ref().map_or(0.0, |bed| bed.end()[1]);
        (self.still_water_depth_m - toe).max(0.0)
    }

    /// The depth whose hydrostatic force scales F*, metres: that at the wall, or that of the still
    /// water if the wall is dry.
    pub fn force_depth_m(&self) -> f64 {
        let at_wall = self.depth_at_wall_m();
        if at_wall > 0.0 { at_wall } else { self.still_water_depth_m }
    }

    /// The smaller of the still water's depths at the paddle and, if there is any, at the wall,
    /// metres.
    pub fn least_depth_m(&self) -> f64 {
        self.force_depth_m().min(self.still_water_depth_m)
    }

    /// The least depth of still water on the way to the wall, metres, if the bed is under water all
    /// the way. Otherwise the smaller of the depths at its ends.
    pub fn least_depth_on_way_m(&self) -> f64 {
        let highest = self.bed.as_ref().map_or(0.0, |bed| bed.range()[1]);
        let over = self.still_water_depth_m - highest;
        if over > 0.0 { over } else { self.least_depth_m() }
    }

    /// How far the paddle goes, metres.
    pub(super) fn stroke_m(&self) -> f64 {
        match (&self.paddle, &self.recorded) {
            (_, Some(keys)) => keys.recorded_stroke.reach(),
            _ => self.paddle().map_or(0.0, |paddle| {
                let end = self.end_time_s.unwrap_or(LONGEST).min(LONGEST);
                // A train repeats itself once it is blended in.
                let single = [0.0, paddle.still_from().min(end)];
                let [from, span] = paddle.period().map_or(single, |period| [period; 2]);
                let step = span / f64::from(INSTANTS);
                let reach = |k| paddle.motion(from + f64::from(k) * step).offset.abs();
                (0..=INSTANTS).map(reach).fold(0.0, f64::max)
            }),
        }
    }

    /// Checks absorption against scheme and end.
    pub(super) fn validate_absorption(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let told = |allowed: &str| error("absorption", "true", allowed);
        if self.absorption && numerics.scheme == Scheme::Isph {
            return told("is for scheme = \"wcsph\"");
        }
        if self.absorption && numerics.stop_when_settled {
            return told("is not for stop_when_settled = true: the paddle never stands");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::CaseConfig;

    fn refused(scene: &str) -> Option<String> {
        let case = CaseConfig::from_tables(&scene.parse().unwrap(), &toml::Table::new());
        case.err().map(|error| error.to_string())
    }

    /// A bed once had to be level up to 0.376 m, and one that was got the same message.
    #[test]
    fn a_bound_that_is_told_is_allowed() {
        let bed = |level: &str| refused(&format!("bed = [[0, 0], [{level}, 0], [2.5, 0.1]]"));
        let told = bed("0.1").unwrap();
        let least = told.split("up to ").nth(1).unwrap().split(' ').next().unwrap();
        assert_eq!((least, bed(least)), ("0.3763", None), "{told}");
        assert!(bed("0.3762").is_some());
        let train = |period: &str| {
            refused(&format!(
                "paddle = \"wave-train\"\nwave_height_ratio = 0.2\nend_time_s = 5\nwave_period_s = {period}"
            ))
        };
        let told = train("10").unwrap();
        let most = told.split("must be ").nth(1).unwrap().split(' ').next().unwrap();
        assert_eq!((most, train(most)), ("1.716", None), "{told}");
        assert!(train("1.717").is_some());
        let tank = |length: &str| {
            refused(&format!(
                "still_water_depth_m = 2\nwave_gauge_m = 0.5\ntank_length_m = {length}"
            ))
        };
        let told = tank("1").unwrap();
        let least = told.split("more than ").nth(1).unwrap().split(',').next().unwrap();
        assert_eq!(tank(&format!("{least}1")), None, "{told}");
    }
}
