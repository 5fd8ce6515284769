//! Units of reported quantities.

/// What a quantity's numbers count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Words, flags and pure numbers.
    Pure,
    /// F* = F/(½ρgh²), per unit width.
    Force,
    /// R* = R/h: the surface at the wall above still water.
    Runup,
    /// X* = X/h.
    Displacement,
    /// Over ½ρgh² √(h/g).
    Impulse,
    /// %.
    Percent,
    /// s.
    Seconds,
    /// m.
    Metres,
    /// m/s.
    MetresPerSecond,
    /// N/m.
    NewtonsPerMetre,
    /// kg/m.
    KilogramsPerMetre,
    /// J/m.
    JoulesPerMetre,
}

impl Unit {
    /// As it is written.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Pure => "",
            Unit::Force => "½ρgh²",
            Unit::Runup | Unit::Displacement => "h",
            Unit::Impulse => "½ρgh² √(h/g)",
            Unit::Percent => "%",
            Unit::Seconds => "s",
            Unit::Metres => "m",
            Unit::MetresPerSecond => "m/s",
            Unit::NewtonsPerMetre => "N/m",
            Unit::KilogramsPerMetre => "kg/m",
            Unit::JoulesPerMetre => "J/m",
        }
    }

    /// Whether its symbols already say what the quantity was divided by: F*, R*, X*.
    pub fn is_ratio(self) -> bool {
        matches!(self, Unit::Force | Unit::Runup | Unit::Displacement | Unit::Impulse)
    }

    /// The title of an axis.
    pub fn axis(self) -> &'static str {
        match self {
            Unit::Force => "F / (½ρgh²)",
            Unit::Runup => "R / h",
            Unit::Displacement => "X / h",
            Unit::Seconds => "t, s",
            other => other.symbol(),
        }
    }
}

/// Endings of columns and keys that tell their unit; longer ones before those that they end in.
const ENDINGS: [(&str, &str); 10] = [
    ("_n_per_m", "N/m"),
    ("_kg_per_m", "kg/m"),
    ("_kg_per_m3", "kg/m³"),
    ("_m_per_s2", "m/s²"),
    ("_m_per_s", "m/s"),
    ("_percent", "%"),
    ("_deg", "°"),
    ("_j", "J"),
    ("_m", "m"),
    ("_s", "s"),
];

/// A name without its unit, and the unit.
pub(super) fn split(name: &str) -> (&str, &'static str) {
    let known = ENDINGS.iter().find_map(|(ending, unit)| Some((name.strip_suffix(ending)?, *unit)));
    known.unwrap_or((name, ""))
}
