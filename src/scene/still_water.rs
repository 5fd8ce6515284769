//! Still water up to a wall, over a bed of any kind.

use super::filling::{Basin, Filling};
use super::frame::Frame;
use super::lattice::Lattice;
use super::numerics::Numerics;
use crate::boundary::Profile;
use crate::theory::hydrostatics::StillColumn;

/// Still water up to the wall: a compressible column with the pressure, level and weight of the
/// incompressible one.
pub(super) fn still_water(frame: &Frame, lattice: Lattice, numerics: &Numerics) -> Filling {
    let (surface_density, densities) = still_densities(frame, numerics);
    let points = lattice.points(|y, _| densities(y));
    Filling { balanced: true, ..Filling::of(lattice, points, surface_density) }
}

/// Still water up to the wall over a bed that is not level.
pub(super) fn still_water_over(
    profile: &Profile,
    frame: &Frame,
    lattice: Lattice,
    numerics: &Numerics,
) -> Filling {
    let (surface_density, densities) = still_densities(frame, numerics);
    let mut filling = Filling::of(lattice, Vec::new(), surface_density);
    let points = filling.bed_lattice(profile, frame.depth).points();
    let particle = |[x, y, area]: [f64; 3]| {
        let [of_state, of_mass] = densities(y);
        [x, y, of_state, of_mass * area]
    };
    filling.points = points.into_iter().map(particle).collect();
    Filling { profile: Some(profile.clone()), balanced: true, ..filling }
}

/// Still water at another level, metres, on a floor that begins at x = `start`. The state equation
/// is that of the tank.
pub(super) fn basin(
    frame: &Frame,
    lattice: Lattice,
    [start, floor, level]: [f64; 3],
    numerics: &Numerics,
) -> Basin {
    let (_, densities) = still_densities(frame, numerics);
    let below = level - frame.depth;
    let mut points = lattice.points(|y, _| densities(floor + y - below));
    for [x, y, ..] in &mut points {
        (*x, *y) = (start + *x, floor + *y);
    }
    Basin { rows: lattice.rows, points }
}

/// ρ_s of still water, and its densities at a height, for the state and for the mass, kg/m³.
fn still_densities(frame: &Frame, numerics: &Numerics) -> (f64, impl Fn(f64) -> [f64; 2] + use<>) {
    let sound_speed = frame.sound_speed(numerics);
    let still = StillColumn::new(frame.depth, frame.density, frame.gravity, sound_speed);
    let state = frame.state_equation(numerics, still.surface_density);
    let densities = move |y: f64| {
        let density = still.density(y);
        let pressure = sound_speed * sound_speed * (density - still.surface_density);
        [state.density(pressure), density]
    };
    (still.surface_density, densities)
}
