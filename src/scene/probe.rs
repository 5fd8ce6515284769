//! Gauges: pressure at a point of the wall or in the water, level of the surface, voids at a wall.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::check::Check;
use super::error::ConfigError;
use super::frame::Frame;
use super::wording::{read_table, serde_keys};

/// What a probe measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProbeKind {
    /// Pressure, Pa.
    Pressure,
    /// Level of the free surface over the bed, m.
    Level,
    /// The largest void at a wall: what the water leaves empty of the kernel's support around the
    /// emptiest point of the wetted face, as a share of what the walls leave of it.
    Void,
}

/// The wall that a probe sits in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// The left wall: the paddle, where there is one.
    Left,
    /// The right wall: the seawall.
    Right,
}

/// One `[[probe]]` table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// Column of the output.
    pub name: String,
    /// Pressure, level or void.
    pub kind: ProbeKind,
    /// The wall that it sits in and moves with; without one it stands at `x_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<Side>,
    /// Place along the tank, metres from the left wall at rest; for probes in no wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_m: Option<f64>,
    /// Height above the bed, metres; for pressure probes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y_m: Option<f64>,
    /// Diameter of the disc over which pressure is averaged, metres; 0 for a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter_m: Option<f64>,
}

impl Probe {
    /// Unit of its readings.
    pub fn unit(&self) -> &'static str {
        match self.kind {
            ProbeKind::Pressure => "Pa",
            ProbeKind::Level => "m",
            ProbeKind::Void => "1",
        }
    }

    /// How and where it measures, in a few words.
    pub fn method(&self) -> String {
        let y = self.y_m.unwrap_or(0.0);
        let place = match (self.kind, self.wall, self.x_m) {
            (ProbeKind::Level, _, x) => {
                let x = x.unwrap_or(0.0);
                return format!(
                    "surface over the bed where kernel coverage falls to 1/2; x = {x} m"
                );
            }
            (ProbeKind::Void, ..) => {
                return "largest empty share of the kernel at the wall, from its toe to a support \
                        radius below the highest contact"
                    .to_owned();
            }
            (_, Some(Side::Left), _) => format!("left wall; y = {y} m"),
            (_, Some(Side::Right), _) => format!("right wall; y = {y} m"),
            (_, None, x) => format!("x = {} m; y = {y} m", x.unwrap_or(0.0)),
        };
        let mean = match self.diameter_m {
            Some(diameter) if diameter > 0.0 => format!("; mean over a disc of {diameter} m"),
            _ => String::new(),
        };
        format!("kernel-weighted mean with hydrostatic correction; {place}{mean}")
    }

    /// Reads the file's `[[probe]]` tables.
    ///
    /// # Errors
    /// The first unknown key or value that does not fit, with the probe that it is of.
    pub(super) fn read_all(tables: &[Table]) -> Result<Vec<Probe>, ConfigError> {
        let known = serde_keys::<Probe>();
        let read = |(place, table): (usize, &Table)| {
            read_table("probe", table.clone(), &known).map_err(|error| {
                let name = table.get("name").and_then(Value::as_str);
                let number = format!("number {}", place + 1);
                of_probe(error, name.unwrap_or(&number))
            })
        };
        tables.iter().enumerate().map(read).collect()
    }

    pub(super) fn validate_all(probes: &[Probe], frame: &Frame) -> Result<(), ConfigError> {
        for (number, probe) in probes.iter().enumerate() {
            probe.validate(frame)?;
            if probes[..number].iter().any(|earlier| earlier.name == probe.name) {
                let allowed = "is taken by an earlier probe";
                return Err(ConfigError::new("probe.name", format!("{:?}", probe.name), allowed));
            }
        }
        Ok(())
    }

    fn validate(&self, frame: &Frame) -> Result<(), ConfigError> {
        let check = Check::section("probe");
        let fits = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        if self.name.is_empty() || !self.name.chars().all(fits) || self.name == "time_s" {
            let allowed = "must be a word of ASCII letters, digits, '-', '_' and '.', not time_s";
            return Err(check.error("name", format!("{:?}", self.name), allowed));
        }
        let name = &self.name;
        let missing = |key: &str, why: &str| Err(check.error(key, "", &format!("{name} {why}")));
        let surplus = |key: &str, value: f64, why: &str| {
            Err(check.error(key, value, &format!("{name} {why}: leave it out")))
        };
        match (self.wall, self.x_m) {
            (None, None) => return missing("x_m", "needs a place: x_m, or wall"),
            (Some(_), Some(x)) => return surplus("x_m", x, "sits in a wall"),
            (None, Some(x)) if !(x >= 0.0 && x <= 2.0 * frame.length) => {
                let allowed = format!("{name} must stand in the tank, 0 to {} m", frame.length);
                return Err(check.error("x_m", x, &allowed));
            }
            _ => {}
        }
        match (self.kind, self.wall, self.y_m, self.diameter_m) {
            (ProbeKind::Void, None, ..) => {
                missing("wall", "looks for voids at a wall and needs it")
            }
            (ProbeKind::Void, _, Some(y), _) => surplus("y_m", y, "looks at the whole wall"),
            (ProbeKind::Void, _, _, Some(d)) => surplus("diameter_m", d, "looks at the whole wall"),
            (ProbeKind::Void, ..) => Ok(()),
            (ProbeKind::Level, Some(_), ..) => {
                let allowed = format!("{name} measures a level: give x_m instead");
                Err(check.error("wall", "", &allowed))
            }
            (ProbeKind::Level, _, Some(y), _) => surplus("y_m", y, "measures a level"),
            (ProbeKind::Level, _, _, Some(d)) => surplus("diameter_m", d, "measures a level"),
            (ProbeKind::Level, ..) => Ok(()),
            (ProbeKind::Pressure, _, None, _) => missing("y_m", "measures pressure and needs it"),
            (ProbeKind::Pressure, _, Some(y), diameter) => {
                let highest = super::filling::WALL_HEIGHT * frame.depth;
                check
                    .range("y_m", y, 0.0, highest)
                    .and_then(|()| {
                        check.range("diameter_m", diameter.unwrap_or(0.0), 0.0, frame.depth)
                    })
                    .map_err(|error| of_probe(error, name))
            }
        }
    }
}

/// Says which probe an error is about.
fn of_probe(error: ConfigError, probe: &str) -> ConfigError {
    ConfigError { allowed: format!("{} (probe {probe})", error.allowed), ..error }
}
