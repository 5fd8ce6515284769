//! Gauges: pressure at a point of the wall or in the water, level of the surface, voids at a wall.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::frame::Frame;
use crate::boundary::Profile;
use crate::keys::{ConfigError, Range, read_alone, section};
use crate::math::decimal::significant;

/// Columns that follow those of the probes where the wall has a crest. They hold what has gone over (m³ per metre of
/// width), the discharge (m²/s), and thickness (m) and speed (m/s) on the crest.
pub const CREST_COLUMNS: [&str; 4] = [
    "overtopping_volume_m2",
    "overtopping_discharge_m2_per_s",
    "crest_thickness_m",
    "crest_speed_m_per_s",
];

/// Columns of every case's history besides its time. A probe of such a name could not be told from them.
pub const HISTORY_COLUMNS: [&str; 4] = ["force", "runup", "displacement", "wall_velocity_m_per_s"];

/// What a probe measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProbeKind {
    /// Pressure, Pa.
    Pressure,
    /// Level of the free surface over the bed at the left wall, m.
    Level,
    /// The free surface over still water, m.
    Elevation,
    /// The largest void at a wall: what the water leaves empty of the kernel's support around the
    /// emptiest point of the wetted face, as a share of what the walls leave of it.
    Void,
    /// Volume of the water beyond an upright section per metre of width, m². Water that an outflow took
    /// away counts.
    Volume,
    /// Discharge through an upright section per metre of width, m²/s.
    Discharge,
}

/// Where a kind of probe may stand, and why nowhere else.
enum Stands {
    Anywhere,
    AtWall(&'static str),
    AtPlace(&'static str),
}

impl ProbeKind {
    fn stands(self) -> Stands {
        match self {
            ProbeKind::Pressure => Stands::Anywhere,
            ProbeKind::Level | ProbeKind::Elevation => {
                Stands::AtPlace("measures a level: give x_m instead")
            }
            ProbeKind::Void => Stands::AtWall("looks for voids at a wall and needs it"),
            ProbeKind::Volume | ProbeKind::Discharge => {
                Stands::AtPlace("measures at a section: give x_m instead")
            }
        }
    }
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

section! {
    /// One `[[probe]]` table.
    pub struct Probe in "probe" {
        /// Column of the output, and none that histories or crests have of themselves.
        name: String, plain();
        /// `pressure`, Pa. `level`: the surface over the bed at the left wall, m. `elevation`: the surface over
        /// still water, m. Where there is no water both are the ground, and under a wall that leans over the water at
        /// most its face. `void`: the largest share of the kernel that water leaves empty at a wall, from its toe
        /// to a support radius below the highest contact (0.5 at a free surface). `volume`: of all water beyond an
        /// upright section, m², also of what an outflow took away. `discharge`: through such a section, m²/s.
        kind: ProbeKind, plain();
        /// The wall that a pressure probe sits in and moves with, or that is searched for voids.
        wall: Option<Side> = None, plain();
        /// Place along the tank from the left wall at rest, of a probe in no wall. A pressure probe reads up to half a
        /// support radius behind a wall's face.
        x_m: Option<f64> = None, unit("m");
        /// Height over the paddle's foot, where the bed is level the height above it.
        y_m: Option<f64> = None, unit("m").only("kind", &["pressure"]);
        /// Diameter of the disc over which pressure is averaged.
        diameter_m: Option<f64> = None, unit("m").only("kind", &["pressure"]).otherwise("0, a point");
    }
}

/// How the method of an elevation begins.
pub const OVER_STILL_WATER: &str = "surface over still water";

impl Probe {
    /// Unit of its readings.
    pub fn unit(&self) -> &'static str {
        match self.kind {
            ProbeKind::Pressure => "Pa",
            ProbeKind::Level | ProbeKind::Elevation => "m",
            ProbeKind::Void => "1",
            ProbeKind::Volume => "m2",
            ProbeKind::Discharge => "m2/s",
        }
    }

    /// How and where it measures, in a few words.
    pub fn method(&self) -> String {
        let x = self.x_m.unwrap_or(0.0);
        let level = |over: &str| format!("{over} where kernel coverage falls to 1/2; x = {x} m");
        match self.kind {
            ProbeKind::Pressure => self.method_of_pressure(),
            ProbeKind::Level => level("surface over the paddle's foot"),
            ProbeKind::Elevation => level(OVER_STILL_WATER),
            ProbeKind::Volume => format!("mass beyond x = {x} m over the density"),
            ProbeKind::Discharge => {
                format!("momentum within three spacings of x = {x} m over the density")
            }
            ProbeKind::Void => "largest empty share of the kernel at the wall, from its toe to a \
                                support radius below the highest contact"
                .to_owned(),
        }
    }

    fn method_of_pressure(&self) -> String {
        let y = self.y_m.unwrap_or(0.0);
        let place = match self.wall {
            Some(Side::Left) => format!("left wall; y = {y} m"),
            Some(Side::Right) => format!("right wall; y = {y} m"),
            None => format!("x = {} m; y = {y} m", self.x_m.unwrap_or(0.0)),
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
        let read = |(place, table): (usize, &Table)| {
            read_alone::<Probe>(table).map_err(|error| {
                let name = table.get("name").and_then(Value::as_str);
                let number = format!("number {}", place + 1);
                of_probe(error, name.unwrap_or(&number))
            })
        };
        tables.iter().enumerate().map(read).collect()
    }

    /// The bed's height, if the probe is under the bed before the wall, where there is never water,
    /// metres.
    pub(super) fn bed_over_it(&self, bed: &Profile) -> Option<f64> {
        let [end, toe] = bed.end();
        let height = match (self.wall, self.x_m) {
            (Some(Side::Left), _) => bed.height(0.0),
            (Some(Side::Right), _) => toe,
            (None, at) => bed.height(at.filter(|x| *x <= end)?),
        };
        self.y_m.filter(|y| *y < height).map(|_| height)
    }

    /// `behind`: how far the scene extends behind the wall's face, and how far down there, metres.
    pub(super) fn validate_all(
        probes: &[Probe],
        frame: &Frame,
        behind: [f64; 2],
    ) -> Result<(), ConfigError> {
        for (number, probe) in probes.iter().enumerate() {
            probe.validate(frame, behind)?;
            if probes[..number].iter().any(|earlier| earlier.name == probe.name) {
                let allowed = "is taken by an earlier probe";
                return Err(ConfigError::new("probe.name", format!("{:?}", probe.name), allowed));
            }
        }
        Ok(())
    }

    fn validate(&self, frame: &Frame, [behind, lowest]: [f64; 2]) -> Result<(), ConfigError> {
        let error = |key: &str, value: String, allowed: &str| {
            Err(ConfigError::new(&format!("probe.{key}"), value, allowed))
        };
        let fits = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        if self.name.is_empty() || !self.name.chars().all(fits) || self.name == "time_s" {
            let allowed = "must be a word of ASCII letters, digits, '-', '_' and '.', not time_s";
            return error("name", format!("{:?}", self.name), allowed);
        }
        if CREST_COLUMNS.contains(&self.name.as_str()) {
            let allowed = "is the name of a column that walls with a crest have of themselves";
            return error("name", format!("{:?}", self.name), allowed);
        }
        if HISTORY_COLUMNS.contains(&self.name.as_str()) {
            let allowed = "is the name of a column of every history";
            return error("name", format!("{:?}", self.name), allowed);
        }
        let name = &self.name;
        // If a wall leans or moves, water goes farther than the wall.
        let farthest = (2.0 * frame.length).max(frame.length + behind);
        let wrong =
            |key: &str, value: String, why: &str| error(key, value, &format!("{name} {why}"));
        let none = String::new();
        match (self.kind.stands(), self.wall, self.x_m) {
            (Stands::AtWall(why), None, _) | (Stands::AtPlace(why), Some(_), _) => {
                return wrong("wall", none, why);
            }
            (_, None, None) => return wrong("x_m", none, "needs a place: x_m, or wall"),
            (_, Some(_), Some(x)) => {
                return wrong("x_m", x.to_string(), "sits in a wall: leave it out");
            }
            (_, None, Some(x)) if !(x >= 0.0 && x <= farthest) => {
                let end = significant(frame.length + behind, 9);
                let why = format!("must stand in the tank, 0 to {end} m");
                return wrong("x_m", x.to_string(), &why);
            }
            _ => {}
        }
        let highest = super::filling::WALL_HEIGHT * frame.depth;
        let (height, disc) = (Range::Within(lowest, highest), Range::Within(0.0, frame.depth));
        match self.y_m {
            None if self.kind == ProbeKind::Pressure => {
                wrong("y_m", none, "measures pressure and needs it")
            }
            height_m => height
                .check("probe.y_m", height_m.unwrap_or(0.0))
                .and_then(|()| disc.check("probe.diameter_m", self.diameter_m.unwrap_or(0.0)))
                .map_err(|error| of_probe(error, name)),
        }
    }
}

/// Names the probe of an error.
fn of_probe(error: ConfigError, probe: &str) -> ConfigError {
    ConfigError { allowed: format!("{} (probe {probe})", error.allowed), ..error }
}
