//! Where the values of a case are read.

use crate::scene::{CaseConfig, Scheme, SeawallScene};
use crate::simulation::{Maximum, Outcome};

/// Fewer rows of particles over the depth are coarse.
const ROWS: f64 = 10.0;
/// Quotients of decimals have smaller errors than this.
const ROUNDING: f64 = 1e-9;

/// What follows from few rows over a level bed, where that was measured.
const OVER_LEVEL_BED: &str = "forces are up to 3 %, displacements 9 % off, runups 0.25 h low";
/// What follows elsewhere.
const OVER_OTHERS: &str =
    "numbers are further off over a bed that is not level: see the known limits";

/// What `coarse_spacing` says of several cases: the sentence of one, with the rows of all. A case
/// over a bed that is not level has the word.
pub fn coarse_spacings<'a>(told: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let mut told: Vec<_> = told.into_iter().filter_map(|why| why.split_once(' ')).collect();
    let rows = |rows: &str| rows.parse().unwrap_or(f64::INFINITY);
    told.sort_by(|(a, _), (b, _)| rows(a).total_cmp(&rows(b)));
    let (&(fewest, first), &(most, _)) = (told.first()?, told.last()?);
    let rest = told.iter().map(|(_, rest)| *rest).find(|rest| rest.contains(OVER_OTHERS));
    let rest = rest.unwrap_or(first);
    let span = if fewest == most { String::new() } else { format!(" to {most}") };
    Some(format!("{fewest}{span} {rest}"))
}

/// Estimated absolute errors; `None` where the case has no such reading or no companion has.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bars {
    /// Of `first_force_max`.
    pub force: Option<f64>,
    /// Of `first_runup_max`.
    pub runup: Option<f64>,
    /// Of `displacement_max`.
    pub displacement: Option<f64>,
    /// Of `force_max`.
    pub whole_force: Option<f64>,
    /// Of `runup_max`.
    pub whole_runup: Option<f64>,
    /// Of `first_moment_max`.
    pub moment: Option<f64>,
    /// Of `moment_max`.
    pub whole_moment: Option<f64>,
    /// Of `overtopping_volume_m2`.
    pub overtopping: Option<f64>,
}

/// What one case was and has left.
#[derive(Debug, Clone)]
pub struct Case<'a> {
    /// Its identity.
    pub id: String,
    /// What was computed.
    pub config: &'a CaseConfig,
    /// Its results; `None` where it failed.
    pub outcome: Option<&'a Outcome>,
    /// Why it failed, or what it recovered from.
    pub reason: &'a str,
    /// Error bars.
    pub bars: Bars,
    /// Wall time, seconds; a trunk's is not included.
    pub wall_time_s: f64,
}

/// A value, before it becomes text.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number in the quantity's unit.
    Number(f64),
    /// A count.
    Count(u64),
    /// A flag.
    Flag(bool),
    /// Words.
    Text(String),
}

impl Case<'_> {
    /// The scene, where it is a seawall.
    pub(super) fn seawall(&self) -> Option<&SeawallScene> {
        self.config.scene.seawall()
    }

    /// Whether an interpolator fills the ghosts of its walls.
    pub(super) fn has_interpolator(&self) -> bool {
        self.config.numerics.scheme == Scheme::Wcsph
    }

    /// The scene, where it is a seawall that moves.
    pub(super) fn movable(&self) -> Option<&SeawallScene> {
        self.seawall().filter(|scene| scene.wall.moves())
    }

    /// What to expect of a wave of few rows of particles; `None` where there are enough.
    pub(super) fn coarse_spacing(&self) -> Option<String> {
        let scene = self.seawall().filter(|scene| scene.wave_height_ratio > 0.0)?;
        let depth = scene.least_depth_m();
        let rows = depth / self.config.numerics.particle_spacing_m;
        let place = if depth < scene.still_water_depth_m { " at the wall" } else { "" };
        let bars = if self.bars == Bars::default() { "" } else { "; one bar in four may miss" };
        (rows < ROWS - ROUNDING).then(|| {
            // Rounded down: 9.97 rows are not 10.0.
            let rows = (10.0 * (rows + ROUNDING)).floor() / 10.0;
            let off = scene.uneven_bed().map_or(OVER_LEVEL_BED, |_| OVER_OTHERS);
            format!("{rows:.1} rows over the depth{place}; below {ROWS}, {off}{bars}")
        })
    }

    /// log10(k/(ρ h² g)); `None` for k = 0.
    pub(super) fn log10_k_star(&self) -> Option<f64> {
        let scene = self.movable()?;
        let stiffness = scene.spring_stiffness_n_per_m.filter(|&stiffness| stiffness > 0.0)?;
        let depth = scene.still_water_depth_m;
        let scale = scene.water_density_kg_per_m3 * depth * depth * scene.gravity_m_per_s2;
        Some(libm::log10(stiffness / scale))
    }

    /// k X/(½ρgh²) of the largest X; `None` without a spring.
    pub(super) fn spring_force_max(&self) -> Option<Maximum> {
        let scene = self.movable()?;
        let farthest = self.outcome?.displacement_max?;
        let depth = scene.still_water_depth_m;
        let unit = self.config.scene.force_unit_n_per_m();
        let value = scene.spring_stiffness_n_per_m? * farthest.value * depth / unit;
        Some(Maximum { value, ..farthest })
    }

    /// m/(ρ h²).
    pub(super) fn m_star(&self) -> Option<f64> {
        let scene = self.movable()?;
        let depth = scene.still_water_depth_m;
        let scale = scene.water_density_kg_per_m3 * depth * depth;
        scene.seawall_mass_kg_per_m.map(|mass| mass / scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coarse_cases_are_told_with_the_rows_of_all() {
        let rows =
            ["8.0 rows over the depth", "9.9 rows over the depth", "6.7 rows over the depth"];
        assert_eq!(coarse_spacings(rows).unwrap(), "6.7 to 9.9 rows over the depth");
        assert_eq!(coarse_spacings([rows[0], rows[0]]).unwrap(), rows[0]);
        assert_eq!(coarse_spacings([]), None);
        let uneven = format!("9.0 rows over the depth; below 10, {OVER_OTHERS}");
        let all = coarse_spacings([rows[0], &uneven]).unwrap();
        assert!(all.starts_with("8.0 to 9.0 rows ") && all.ends_with(OVER_OTHERS), "{all}");
    }

    fn coarse(scene: &str, spacing: f64, bars: Bars) -> Option<String> {
        let config = &CaseConfig::of(scene, &format!("particle_spacing_m = {spacing}"));
        let id = String::new();
        Case { id, config, outcome: None, reason: "", bars, wall_time_s: 0.0 }.coarse_spacing()
    }

    /// The story: 9.97 rows were told as "10.0 rows over the depth; below 10", and a case without
    /// error bars was told that one in four may miss.
    #[test]
    fn rows_are_rounded_down_and_bars_are_told_where_there_are_some() {
        let told = |spacing: f64| coarse("", spacing, Bars::default()).unwrap();
        assert!(told(0.02006).starts_with("9.9 rows over the depth; below 10, "));
        assert!(told(0.025).starts_with("8.0 rows ") && told(0.03).starts_with("6.6 rows "));
        assert_eq!(coarse("", 0.02, Bars::default()), None);
        assert!(told(0.025).ends_with("runups 0.25 h low"), "{}", told(0.025));
        let bars = Bars { force: Some(0.1), ..Bars::default() };
        let told = coarse("", 0.025, bars).unwrap();
        assert!(told.ends_with("runups 0.25 h low; one bar in four may miss"), "{told}");
    }

    #[test]
    fn rows_count_where_the_water_is_shallow() {
        let told = |bed: &str| {
            coarse(&format!("still_water_depth_m = 0.2\nbed = {bed}"), 0.02, Bars::default())
        };
        let step = told("[[0, 0], [1.5, 0], [1.5, 0.06], [2.5, 0.06]]").unwrap();
        assert!(step.starts_with("7.0 rows over the depth at the wall; below 10, "), "{step}");
        // The story: over a slope with a low wall at its end forces were 30 % off, and "up to 3 %"
        // was told.
        assert!(!step.contains('%') && step.contains("known limits"), "{step}");
        let level =
            coarse("still_water_depth_m = 0.15\nbed = [[0, 0], [2.5, 0]]", 0.02, Bars::default());
        assert!(level.unwrap().contains("forces are up to 3 %"));
        assert_eq!(told("[[0, 0], [2.5, 0]]"), None);
        assert_eq!(told("[[0, 0], [1.5, 0], [2.5, 0.3]]"), None, "a dry wall has no depth");
    }
}
