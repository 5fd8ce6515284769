//! The sweep files that the figures need, inside the program.

macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../", $path)))),*]
    };
}

const ALL: &[(&str, &str)] = files![
    "sweeps/liang2017.toml",
    "sweeps/fixed_wall.toml",
    "sweeps/liang2017/surface.toml",
    "sweeps/liang2017/fixed_wall.toml",
    "sweeps/liang2017/hydrostatic.toml",
    "sweeps/liang2017/single_wall.toml",
    "sweeps/liang2017/stiffness.toml",
    "sweeps/liang2017/mass.toml",
    "sweeps/liang2017/wave_height.toml",
    "sweeps/boundary_comparison/hydrostatic_full.toml",
    "sweeps/boundary_comparison/dam_break.toml",
    "sweeps/boundary_comparison/inclined_wall.toml",
    "sweeps/huang2019/movable_wall.toml",
    "sweeps/huang2019/step_time_still_water.toml",
    "sweeps/huang2019/step_time_dam_break.toml",
    "sweeps/huang2019/step_time_inclined_wall.toml",
];

/// The text of a shipped file, by its path in the repository.
pub fn text(path: &str) -> Option<&'static str> {
    ALL.iter().find(|(name, _)| *name == path).map(|(_, text)| *text)
}
