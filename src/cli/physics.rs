//! Which physics and numerics are on, for `seawall check`.

use crate::boundary::SfdiMatrix;
use crate::scene::{BoundaryChoice, CaseConfig, Numerics, Scene, Scheme};
use crate::scheme::wcsph::{DensityDiffusion, Shifting};
use crate::study::Study;

/// A line's name, and what a case has of it: `None` where it is off or means nothing to the case.
type Line = (&'static str, fn(&CaseConfig) -> Option<String>);

/// What is on, in the order of [`LINES`], each line with the values that occur among the cases.
pub(super) fn physics(study: &Study) -> Vec<(&'static str, Vec<String>)> {
    let values = |value: fn(&CaseConfig) -> Option<String>| {
        let mut seen = Vec::new();
        let mut add = |value: String| {
            if !seen.contains(&value) {
                seen.push(value);
            }
        };
        let all: Vec<_> = study.cases.iter().map(|case| value(&case.config)).collect();
        let on = all.iter().any(Option::is_some);
        for value in all.into_iter().filter(|_| on) {
            add(value.unwrap_or_else(|| "none".to_owned()));
        }
        seen
    };
    let lines = LINES.iter().map(|&(name, value)| (name, values(value)));
    lines.filter(|(_, values)| !values.is_empty()).collect()
}

const LINES: &[Line] = &[
    ("scene", |case| Some(case.scene.kind().to_owned())),
    ("wall", |case| wall(&case.scene)),
    ("scheme", |case| name(case.numerics.scheme)),
    ("kernel", |case| name(case.numerics.kernel)),
    ("support radius", |case| Some(format!("{} spacings", case.numerics.support_radius_ratio))),
    ("boundary", |case| name(weakly(case)?.boundary)),
    ("boundary weights", |case| weights(weakly(case)?)),
    ("ghost gravity", |case| name(weakly(case)?.ghost_gravity)),
    ("slip", |case| name(weakly(case)?.slip)),
    ("density diffusion", |case| name(weakly(case)?.density_diffusion)),
    ("δ", |case| {
        let numerics = weakly(case)?;
        let on = numerics.density_diffusion != DensityDiffusion::None;
        on.then(|| numerics.density_diffusion_coefficient.to_string())
    }),
    ("shifting", |case| name(case.numerics.shifting)),
    ("shifting strength", |case| {
        let on = case.numerics.shifting != Shifting::None;
        on.then(|| case.numerics.shifting_coefficient.to_string())
    }),
    ("gradients", |case| {
        let corrected = weakly(case)?.corrected_gradients;
        Some(if corrected { "corrected" } else { "as they are" }.to_owned())
    }),
    ("viscosity", |case| Some(case.numerics.artificial_viscosity.to_string())),
    ("ν, m²/s", |case| above_zero(case.numerics.kinematic_viscosity_m2_per_s?)),
    ("steps per full step", |case| Some(weakly(case)?.acoustic_substeps.to_string())),
    ("bulk damping", |case| above_zero(weakly(case)?.bulk_damping)),
    ("state equation", |case| name(weakly(case)?.state_equation)),
    ("sound speed ratio", |case| Some(weakly(case)?.sound_speed_ratio.to_string())),
    ("c0 Δt/Δx", |case| Some(weakly(case)?.courant_number.to_string())),
    ("precision", |case| name(weakly(case)?.precision)),
    ("laplacian", |case| name(case.numerics.laplacian?)),
    ("preconditioner", |case| name(case.numerics.preconditioner?)),
    ("solver tolerance", |case| Some(case.numerics.solver_tolerance?.to_string())),
    ("volume relaxation", |case| above_zero(case.numerics.volume_relaxation?)),
    ("pressure memory", |case| above_zero(case.numerics.pressure_memory?)),
    ("compact share", |case| Some(case.numerics.compact_share?.to_string())),
    ("Δt/√(Δx/g)", |case| Some(case.numerics.gravity_courant_number?.to_string())),
    ("u Δt/Δx", |case| Some(case.numerics.flow_courant_number?.to_string())),
    ("time step bound, s", |case| Some(case.numerics.time_step_s?.to_string())),
    ("particle spacing, m", |case| Some(case.numerics.particle_spacing_m.to_string())),
    ("stops when settled", |case| case.numerics.stop_when_settled.then(|| "yes".to_owned())),
    ("retries", |case| (case.numerics.retries > 0).then(|| case.numerics.retries.to_string())),
    ("probes", |case| {
        let names: Vec<_> = case.probes.iter().map(|probe| probe.name.as_str()).collect();
        (!names.is_empty()).then(|| names.join(" "))
    }),
];

/// The numerics of a case of δ-SPH: the lines of what it alone reads.
fn weakly(case: &CaseConfig) -> Option<&Numerics> {
    Some(&case.numerics).filter(|numerics| numerics.scheme == Scheme::Wcsph)
}

fn wall(scene: &Scene) -> Option<String> {
    match scene {
        Scene::Seawall(scene) => Some(scene.wall_in_words()),
        Scene::Hydrostatic(scene) => Some(format!("fixed, {}°", scene.wall_angle_deg)),
        Scene::DamBreak(_) | Scene::StandingWave(_) | Scene::TaylorGreen(_) => {
            Some("fixed".to_owned())
        }
        Scene::RotatingPatch(_) | Scene::OscillatingDrop(_) => None,
    }
}

/// What the chosen way of taking ghosts' values reads.
fn weights(numerics: &Numerics) -> Option<String> {
    let limit = format!("amplification limit {}", numerics.amplification_limit);
    match numerics.boundary {
        BoundaryChoice::ImprovedShepard => {
            Some(format!("λ {}, σ {}", numerics.shepard_lambda, numerics.shepard_sigma))
        }
        BoundaryChoice::Sfdi if numerics.sfdi_matrix == SfdiMatrix::Full => {
            Some(format!("full matrix, {limit}"))
        }
        BoundaryChoice::Sfdi => Some(format!("diagonal matrix, {limit}")),
        BoundaryChoice::MlsLinear | BoundaryChoice::MlsQuadratic => Some(limit),
        BoundaryChoice::Normalized | BoundaryChoice::Dummy => None,
    }
}

/// The name that a file gives a choice.
fn name(choice: impl serde::Serialize) -> Option<String> {
    serde_json::to_value(choice).ok()?.as_str().map(str::to_owned)
}

fn above_zero(value: f64) -> Option<String> {
    (value > 0.0).then(|| value.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::SweepFile;

    fn told(text: &str) -> Vec<(&'static str, Vec<String>)> {
        let text = format!("name = \"a\"\n{text}");
        physics(&Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap())
    }

    #[test]
    fn what_is_on_is_told_and_only_that() {
        let value = |text: &str, name: &str| {
            let lines = told(text);
            lines.into_iter().find(|line| line.0 == name).map(|line| line.1.join(", "))
        };
        let some = |text: &str| Some(text.to_owned());
        for off in ["ν, m²/s", "retries", "stops when settled", "probes", "laplacian"] {
            assert_eq!(value("", off), None, "{off}");
        }
        let on = "[numerics]\nkinematic_viscosity_m2_per_s = 1e-6\nretries = 2\n\
                  stop_when_settled = true\nprecision = \"f32\"\n\
                  [[probe]]\nname = \"P1\"\nkind = \"level\"\nx_m = 1";
        assert_eq!(value(on, "ν, m²/s"), some("0.000001"));
        assert_eq!(value(on, "retries"), some("2"));
        assert_eq!(value(on, "stops when settled"), some("yes"));
        assert_eq!(value(on, "precision"), some("f32"));
        assert_eq!(value(on, "probes"), some("P1"));
        let isph = "[numerics]\nscheme = \"isph\"";
        assert_eq!(value(isph, "laplacian"), some("exact"));
        assert_eq!(value(isph, "preconditioner"), some("multigrid"));
        for other in ["boundary", "density diffusion", "bulk damping", "sound speed ratio"] {
            assert_eq!(value(isph, other), None, "{other}");
            assert!(value("", other).is_some(), "{other}");
        }
        let both = "[grid]\nscheme = [\"wcsph\", \"isph\"]";
        assert_eq!(value(both, "scheme"), some("wcsph, isph"));
        assert_eq!(value(both, "laplacian"), some("none, exact"));
        assert_eq!(value("[scene]\nkind = \"rotating-patch\"", "wall"), None);
    }
}
