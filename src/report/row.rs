//! One row of `summary.csv`, as far as the report needs it.

use std::collections::BTreeSet;

use serde::Deserialize;

use super::number;
use super::study::Key;

/// Columns without which there is no report.
pub(super) const REQUIRED: &[&str] = &[
    "case_id",
    "status",
    "reason",
    "wave_height_ratio",
    "spring_stiffness_n_per_m",
    "seawall_mass_kg_per_m",
    "log10_k_star",
    "m_star",
    "measured_wave_height_ratio",
    "displacement_max",
    "first_force_max",
    "first_runup_max",
    "displacement_truncated",
    "stops",
    "force_gap_percent",
    "energy_gap_percent",
    "particles_lost",
    "steps",
    "particles",
    "scheme",
    "boundary",
    "kernel",
    "particle_spacing_m",
    "force_coupling",
];

/// What the report reads of one case: see `docs/files.md` for the columns. Empty cells are `None`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default)]
#[allow(missing_docs, reason = "the fields are the columns of summary.csv")]
pub struct Row {
    pub case_id: String,
    pub status: String,
    pub reason: String,
    pub wave_height_ratio: Option<f64>,
    pub spring_stiffness_n_per_m: Option<f64>,
    pub seawall_mass_kg_per_m: Option<f64>,
    pub log10_k_star: Option<f64>,
    pub m_star: Option<f64>,
    pub measured_wave_height_ratio: Option<f64>,
    pub force_max: Option<f64>,
    pub runup_max: Option<f64>,
    pub displacement_max: Option<f64>,
    pub first_force_max: Option<f64>,
    pub first_runup_max: Option<f64>,
    pub displacement_truncated: Option<bool>,
    pub stops: Option<u64>,
    pub force_gap_percent: Option<f64>,
    pub energy_gap_percent: Option<f64>,
    pub particles_lost: Option<u64>,
    pub stop_impulse: Option<f64>,
    pub doubtful: Option<bool>,
    pub doubtful_reason: String,
    pub force_error: Option<f64>,
    pub runup_error: Option<f64>,
    pub displacement_error: Option<f64>,
    pub steps: Option<u64>,
    pub particles: Option<u64>,
    pub scheme: String,
    pub boundary: String,
    pub kernel: String,
    pub particle_spacing_m: Option<f64>,
    pub force_coupling: Option<f64>,
    /// Of a fixed wall; upright where nothing says otherwise.
    pub wall_angle_deg: Option<f64>,
    /// Which of several runs with the same wave and wall this is, such as `boundary = sfdi`;
    /// empty where the sweep holds only one.
    #[serde(skip)]
    pub variant: String,
}

impl Row {
    /// The case ran to its end.
    pub fn is_ok(&self) -> bool {
        self.status == "ok"
    }

    /// The wall does not move: it has neither spring nor mass.
    pub fn is_fixed(&self) -> bool {
        self.spring_stiffness_n_per_m.is_none() && self.seawall_mass_kg_per_m.is_none()
    }

    /// The wall stands upright.
    pub fn is_vertical(&self) -> bool {
        self.wall_angle_deg.is_none_or(|angle| angle == 90.0)
    }

    /// What tells this case from the sweep's others; empty where it is the only one.
    pub fn words(&self) -> String {
        let part = |name: &str, value: Option<f64>, unit: &str| {
            value.map(|value| format!("{name} = {}{unit}", number::plain(value)))
        };
        let parts = [
            part("H/h", self.wave_height_ratio, ""),
            part("k", self.spring_stiffness_n_per_m, " N/m"),
            part("m", self.seawall_mass_kg_per_m, " kg/m"),
            (!self.variant.is_empty()).then(|| self.variant.clone()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Wave, stiffness and mass as bits, so that they can be compared and sorted on.
    fn place(&self) -> [u64; 3] {
        [self.wave_height_ratio, self.spring_stiffness_n_per_m, self.seawall_mass_kg_per_m]
            .map(|value| value.unwrap_or(f64::NAN).to_bits())
    }
}

/// Columns that say where and how a case was computed, and never what.
const PROVENANCE: &[&str] =
    &["host", "rank", "ranks", "threads", "executor", "simd", "version", "git_commit"];

/// Fills in [`Row::variant`] where several rows share wave, stiffness and mass, from the choices
/// that differ: those the report knows, and swept keys behind the columns of every sweep.
pub(super) fn name_variants(rows: &mut [Row], swept: &[Key]) {
    let mut places: Vec<_> = rows.iter().map(Row::place).collect();
    places.sort_unstable();
    if places.windows(2).all(|pair| pair[0] != pair[1]) {
        return;
    }
    let number = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let column = |read: &dyn Fn(&Row) -> String| rows.iter().map(read).collect::<Vec<_>>();
    let mut choices = vec![
        ("scheme".to_owned(), column(&|row| row.scheme.clone())),
        ("boundary".to_owned(), column(&|row| row.boundary.clone())),
        ("kernel".to_owned(), column(&|row| row.kernel.clone())),
        ("particle_spacing_m".to_owned(), column(&|row| number(row.particle_spacing_m))),
        ("force_coupling".to_owned(), column(&|row| number(row.force_coupling))),
    ];
    choices.extend(swept.iter().map(|key| (key.name.clone(), key.cells.clone())));
    choices.retain(|(name, values)| {
        !PROVENANCE.contains(&name.as_str()) && values.iter().any(|value| *value != values[0])
    });
    for (_, values) in &mut choices {
        shorten(values);
    }
    for (index, row) in rows.iter_mut().enumerate() {
        let parts: Vec<_> =
            choices.iter().map(|(name, values)| format!("{name} = {}", values[index])).collect();
        row.variant = parts.join(", ");
    }
}

/// Rounds numbers for the eye, unless that would make two of them one.
fn shorten(values: &mut [String]) {
    let count = |values: &[String]| values.iter().collect::<BTreeSet<_>>().len();
    let short: Vec<_> = values
        .iter()
        .map(|cell| {
            let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
            value.map_or(cell.clone(), |value| number::significant(value, 4).to_string())
        })
        .collect();
    if count(&short) == count(values) {
        values.clone_from_slice(&short);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(boundary: &str, wave: f64) -> Row {
        Row { wave_height_ratio: Some(wave), boundary: boundary.to_owned(), ..Row::default() }
    }

    #[test]
    fn one_run_per_place_needs_no_variant() {
        let mut rows = vec![row("sfdi", 0.2), row("normalized", 0.3)];
        name_variants(&mut rows, &[]);
        assert!(rows.iter().all(|row| row.variant.is_empty()));
    }

    #[test]
    fn runs_at_one_place_are_told_apart_by_what_differs() {
        let mut rows = vec![row("sfdi", 0.2), row("normalized", 0.2)];
        let key = |name: &str, cells: [&str; 2]| Key {
            name: name.to_owned(),
            cells: cells.map(str::to_owned).to_vec(),
        };
        let swept = [key("slip", ["free", "no"]), key("host", ["a", "b"])];
        name_variants(&mut rows, &swept);
        assert_eq!(rows[0].variant, "boundary = sfdi, slip = free");
        assert_eq!(rows[1].variant, "boundary = normalized, slip = no");
    }

    #[test]
    fn numbers_of_a_variant_are_short_as_long_as_they_differ() {
        let cells = |texts: [&str; 2]| texts.map(str::to_owned);
        let mut far = cells(["0.012345678", "21544.3469003188"]);
        shorten(&mut far);
        assert_eq!(far, ["0.01235", "21540"]);
        let mut near = cells(["1.00001", "1.00002"]);
        shorten(&mut near);
        assert_eq!(near, ["1.00001", "1.00002"]);
    }
}
