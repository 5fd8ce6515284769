//! The largest number of particles of a scene.

use super::kind::Scene;
use super::numerics::Numerics;
use super::seawall::SeawallScene;
use crate::keys::ConfigError;
use crate::math::decimal::{rounded_down, rounded_up, significant};

/// Largest number of water particles: some 30 GB, and weeks on one core.
pub(super) const MOST_PARTICLES: f64 = 20e6;

/// Largest number of ghosts of a bed, of a crest or of the floor behind it. A tank of
/// [`MOST_PARTICLES`] has far fewer.
const MOST_GHOSTS: f64 = 2e6;

/// Largest number of steps: thousands of years on one core.
const MOST_STEPS: f64 = 1e13;

/// Digits of bounds in messages.
const DIGITS: usize = 3;

/// Number of particles of a scene from its area of water, without placing them.
pub(super) fn particles(scene: &Scene, numerics: &Numerics) -> f64 {
    let spacing = numerics.particle_spacing_m;
    scene.water_area() / spacing / spacing
}

/// Refuses more particles than a machine can hold, and more steps than anybody waits for.
///
/// # Errors
/// More than [`MOST_STEPS`] or [`MOST_PARTICLES`]. The latter names the smallest possible spacing
/// for this water.
pub(super) fn validate(scene: &Scene, numerics: &Numerics) -> Result<(), ConfigError> {
    let (count, area) = (particles(scene, numerics), scene.water_area());
    if count <= MOST_PARTICLES {
        return demand_an_end(scene, numerics);
    }
    let remedy = match rounded_up((area / MOST_PARTICLES).sqrt(), DIGITS) {
        smallest if smallest.is_finite() => format!("choose {} m or more", written(smallest)),
        _ => "make the tank smaller".to_owned(),
    };
    let allowed = format!(
        "would cut {} m² of water into {} particles, and {} are the most: {remedy}",
        written(significant(area, DIGITS)),
        whole(count),
        whole(MOST_PARTICLES)
    );
    let spacing = written(numerics.particle_spacing_m);
    Err(ConfigError::new("numerics.particle_spacing_m", spacing, allowed))
}

/// A number, with an exponent if it has many zeros.
fn written(value: f64) -> String {
    if (1e-6..1e9).contains(&value) { value.to_string() } else { format!("{value:e}") }
}

/// Lengths of bed, crest and the floor behind it along their faces, metres.
fn lengths(scene: &SeawallScene) -> [(&'static str, Option<f64>); 3] {
    let bed = scene.bed.as_ref().map(|bed| bed.stretches().map(|one| one.length).sum::<f64>());
    let crest = scene.crest.as_ref().map(|crest| crest.crest_width_m);
    let floor = scene.floor.as_ref().map(|floor| floor.floor_length_m);
    [("bed", bed), ("crest_width_m", crest), ("floor_length_m", floor)]
}

impl SeawallScene {
    /// Number of ghosts below its bed, its crest and the floor behind it. These have ghosts even
    /// where there is no water.
    pub fn wall_ghosts(&self, numerics: &Numerics) -> f64 {
        let length: f64 = lengths(self).iter().filter_map(|(_, length)| *length).sum();
        length / numerics.particle_spacing_m * numerics.support_radius_ratio
    }
}

/// Refuses beds, crests and floors so long that their ghosts alone fill a machine.
///
/// # Errors
/// The key, and its largest value with these particles.
pub(super) fn validate_walls(scene: &SeawallScene, numerics: &Numerics) -> Result<(), ConfigError> {
    let (spacing, rows) = (numerics.particle_spacing_m, numerics.support_radius_ratio);
    let longest = rounded_down(MOST_GHOSTS * spacing / rows, DIGITS);
    for (key, length) in lengths(scene) {
        let Some(length) = length.filter(|length: &f64| *length > longest) else { continue };
        let (subject, value) = match key {
            "bed" => (format!("is {length} m long along its face; "), String::new()),
            _ => (String::new(), length.to_string()),
        };
        let allowed = format!(
            "{subject}must be {longest} m or less: with particles {spacing} m apart it would have \
             more than {} ghosts",
            whole(MOST_GHOSTS)
        );
        return Err(ConfigError::new(&format!("scene.{key}"), value, allowed));
    }
    Ok(())
}

/// Refuses more steps than anybody waits for.
fn demand_an_end(scene: &Scene, numerics: &Numerics) -> Result<(), ConfigError> {
    let frame = scene.frame();
    // From 0, wherever a recorded clock begins: that clock could not resolve shorter steps.
    let steps = frame.end_time / frame.time_step(numerics);
    if steps > MOST_STEPS {
        let allowed = format!(
            "would take {steps:.1e} steps, and {MOST_STEPS:e} are the most; where no end_time_s is given, a \
             low wave is a long one"
        );
        return Err(ConfigError::new("scene.end_time_s", frame.end_time, allowed));
    }
    Ok(())
}

/// A count in groups of three digits, or with an exponent if it is very long.
fn whole(count: f64) -> String {
    if count.is_infinite() {
        return "uncountably many".to_owned();
    }
    if count >= 1e12 {
        return format!("{count:.1e}");
    }
    let digits = format!("{count:.0}");
    let starts_group = |at: usize| at > 0 && (digits.len() - at).is_multiple_of(3);
    let pieces = digits.char_indices().map(|(at, digit)| (starts_group(at), digit));
    pieces.fold(String::new(), |told, (gap, digit)| {
        told + if gap { "," } else { "" } + &digit.to_string()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{CaseConfig, Kind};

    fn case(scene: &str, spacing: &str) -> Result<CaseConfig, ConfigError> {
        let numerics = format!("particle_spacing_m = {spacing}");
        CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap())
    }

    #[test]
    fn the_smallest_spacing_that_is_named_is_taken() {
        let kinds = Kind::ALL.iter().map(|kind| format!("kind = \"{}\"", kind.name()));
        let leaning = [60, 120].map(|angle| format!("wall_angle_deg = {angle}"));
        for scene in kinds.chain(leaning) {
            for spacing in ["1e-300", "0.00001"] {
                let told = case(&scene, spacing).unwrap_err();
                assert_eq!(told.value, spacing);
                assert!(!told.allowed.contains("inf"), "{told}");
                assert_eq!(told.key, "numerics.particle_spacing_m");
                let words: Vec<_> = told.allowed.split(' ').collect();
                let smallest = words[words.len() - 4];
                case(&scene, smallest).unwrap();
            }
        }
    }

    /// The spacing once had to be NaN m, or a number of 150 digits.
    #[test]
    fn water_that_no_spacing_fits_is_told_so() {
        for (depth, told) in [
            (
                "1e308",
                "would cut inf m² of water into uncountably many particles, and 20,000,000 are the most: make the tank smaller",
            ),
            (
                "1e300",
                "would cut 2.5e300 m² of water into 9.8e303 particles, and 20,000,000 are the most: choose 3.54e146 m or more",
            ),
        ] {
            let error = case(&format!("still_water_depth_m = {depth}"), "0.016").unwrap_err();
            assert_eq!(error.allowed, told);
        }
    }

    #[test]
    fn walls_longer_than_any_machine_are_refused() {
        let over = "behind = \"floor\"\ncrest_freeboard_m = 0.1";
        for (scene, key) in [
            (&*format!("{over}\ncrest_width_m = 1e9\nfloor_length_m = 1"), "crest_width_m"),
            (&*format!("{over}\ncrest_width_m = 0.2\nfloor_length_m = 1e12"), "floor_length_m"),
            ("bed = [[0, 0], [2, 0], [2.5, 1e9]]", "bed"),
        ] {
            let told = case(scene, "0.02").unwrap_err();
            assert_eq!(told.key, format!("scene.{key}"));
            assert!(told.allowed.contains("must be 8000 m or less"), "{told}");
        }
        case(&format!("{over}\ncrest_width_m = 7999\nfloor_length_m = 7999"), "0.02").unwrap();
    }

    #[test]
    fn the_estimate_is_near_the_lattice() {
        for scene in ["wall_angle_deg = 60", "wall_angle_deg = 120", "kind = \"oscillating-drop\""]
        {
            let config = case(scene, "0.02").unwrap();
            let laid_out = config.scene.particles(&config.numerics) as f64;
            assert!(
                (particles(&config.scene, &config.numerics) / laid_out - 1.0).abs() < 0.01,
                "{scene}"
            );
        }
    }
}
