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
    /// M* = M/(ρgh³/6), per unit width.
    Moment,
    /// Over ½ρgh² √(h/g).
    Impulse,
    /// %.
    Percent,
    /// s.
    Seconds,
    /// m.
    Metres,
    /// m².
    SquareMetres,
    /// m²/s.
    SquareMetresPerSecond,
    /// m/s.
    MetresPerSecond,
    /// N/m.
    NewtonsPerMetre,
    /// kg/m.
    KilogramsPerMetre,
    /// J/m.
    JoulesPerMetre,
    /// Pa.
    Pascal,
}

impl Unit {
    /// As it is written.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Pure => "",
            Unit::Force => "½ρgh²",
            Unit::Runup | Unit::Displacement => "h",
            Unit::Moment => "ρgh³/6",
            Unit::Impulse => "½ρgh² √(h/g)",
            Unit::Percent => "%",
            Unit::Seconds => "s",
            Unit::Metres => "m",
            Unit::SquareMetres => "m²",
            Unit::SquareMetresPerSecond => "m²/s",
            Unit::MetresPerSecond => "m/s",
            Unit::NewtonsPerMetre => "N/m",
            Unit::KilogramsPerMetre => "kg/m",
            Unit::JoulesPerMetre => "J/m",
            Unit::Pascal => "Pa",
        }
    }

    /// Whether its symbols already say what the quantity was divided by: F*, R*, X*.
    pub fn is_ratio(self) -> bool {
        matches!(
            self,
            Unit::Force | Unit::Runup | Unit::Displacement | Unit::Moment | Unit::Impulse
        )
    }

    /// What stands behind a number or a heading: nothing where a star says what it was divided by. An impulse
    /// has none.
    pub fn suffix(self) -> &'static str {
        if self.is_ratio() && self != Unit::Impulse { "" } else { self.symbol() }
    }

    /// The title of an axis.
    pub fn axis(self) -> &'static str {
        match self {
            Unit::Force => "F / (½ρgh²)",
            Unit::Runup => "R / h",
            Unit::Displacement => "X / h",
            Unit::Moment => "M / (ρgh³/6)",
            Unit::Seconds => "t, s",
            other => other.symbol(),
        }
    }
}

/// Endings of columns and keys that tell their unit; longer ones before those that they end in.
pub(super) const ENDINGS: [(&str, &str); 18] = [
    ("_kn_m_per_m", "kN m/m"),
    ("_kn_s_per_m", "kN s/m"),
    ("_kn_per_m", "kN/m"),
    ("_kpa", "kPa"),
    ("_n_per_m", "N/m"),
    ("_kg_per_m", "kg/m"),
    ("_j_per_m", "J/m"),
    ("_kg_per_m3", "kg/m³"),
    ("_m_per_s2", "m/s²"),
    ("_m2_per_s", "m²/s"),
    ("_m_per_s", "m/s"),
    ("_per_s", "1/s"),
    ("_percent", "%"),
    ("_deg", "°"),
    ("_pa", "Pa"),
    ("_m2", "m²"),
    ("_m", "m"),
    ("_s", "s"),
];

/// A name without its unit, and the unit.
pub(super) fn split(name: &str) -> (&str, &'static str) {
    let known = ENDINGS.iter().find_map(|(ending, unit)| Some((name.strip_suffix(ending)?, *unit)));
    known.unwrap_or((name, ""))
}

#[cfg(test)]
mod tests {
    use super::super::{energy, envelope, history, summary};
    use super::*;

    #[test]
    fn a_name_ends_in_its_unit() {
        let summary = summary::ALL.iter().map(|column| (column.name, column.unit));
        let history = history::ALL.iter().map(|column| (column.name, column.unit));
        let energy = energy::ALL.iter().map(|term| (term.name, term.unit));
        let envelope = envelope::ALL.iter().map(|column| (column.name, column.unit));
        for (name, unit) in summary.chain(history).chain(energy).chain(envelope) {
            let told = if unit.is_ratio() { "" } else { unit.symbol() };
            assert_eq!(split(name).1, told, "{name}");
        }
        let keys = ["kinematic_viscosity_m2_per_s", "rotation_rate_per_s", "gravity_m_per_s2"];
        assert_eq!(keys.map(|key| split(key).1), ["m²/s", "1/s", "m/s²"]);
    }
}
