//! Which scenes have which other defaults.

use super::super::contract::Walls;
use super::super::frame::Frame;
use super::super::kind::Scene;
use super::super::preset::Preset;
use super::{Suited, sound_speed_ratio};
use crate::boundary::{BoundaryChoice, GhostGravity};
use crate::scheme::wcsph::Shifting;

/// Time for still water to come to rest before a shore, in √(h/g).
const RELAXES_OVER: f64 = 40.0;

const DEFAULT: &[Preset] = &[Preset::Default];

/// Where several hold, later ones count.
pub const SUITED: &[Suited] = &[
    Suited {
        presets: &[Preset::Default, Preset::Huang2019, Preset::Isph],
        scenes: "dam breaks, and boxes that water fills",
        keys: &[("acoustic_substeps", "1")],
        why: "Where a front hits a wall there is no time in which pairs could hold their geometry. In a full box no \
              surface lets sound escape, and full steps would feed resonances.",
        holds: |a| matches!(a.scene, Scene::DamBreak(_)) || a.scene.walls() == Walls::Closed,
        set: |n, _| n.acoustic_substeps = 1,
    },
    Suited {
        presets: &[Preset::Isph],
        scenes: "dam breaks by `isph`",
        keys: &[("volume_feedback", "0.006")],
        why: "After a splash the particles are too far apart.",
        holds: |a| matches!(a.scene, Scene::DamBreak(_)),
        set: |n, _| n.volume_feedback = 0.006,
    },
    Suited {
        presets: &[Preset::Isph],
        scenes: "solitary waves at upright walls by `isph`",
        keys: &[("support_radius_ratio", "5.0")],
        why: "In narrower supports the lattice that a crest has strained breaks up. Low waves lose less in them.",
        holds: |a| a.scene.has_solitary_wave_at_upright_wall(),
        set: |n, _| n.support_radius_ratio = 5.0,
    },
    Suited {
        presets: DEFAULT,
        scenes: "boxes that water fills, and before shores no steeper than 1:2 trains and runs of more than 200 √(h/g)",
        keys: &[("courant_number", "0.9")],
        why: "Long steps add energy to water that tears, and to tongues.",
        holds: |a| a.scene.stirs_at_gentle_shore() || a.scene.walls() == Walls::Closed,
        set: |n, _| n.courant_number = 0.9,
    },
    Suited {
        presets: DEFAULT,
        scenes: "dam breaks, water that falls behind a wall, and walls that stand dry, up to 2 H over the still water",
        keys: &[("courant_number", "0.6")],
        why: "Long steps add energy to water that is hit all at once.",
        holds: |a| a.scene.hits_at_once(),
        set: |n, _| n.courant_number = 0.6,
    },
    Suited {
        presets: DEFAULT,
        scenes: "all but waves at upright walls and standing waves",
        keys: &[
            ("support_radius_ratio", "4.0"),
            ("artificial_viscosity", "0.1"),
            ("shifting_coefficient", "0.25"),
        ],
        why: "A wide support helps where a crest strains the lattice. Thin sheets and wedges lose by it, and water at \
              rest starts to creep after some ten seconds.",
        holds: |a| !a.scene.has_crest_at_upright_wall(),
        set: |n, _| {
            n.support_radius_ratio = 4.0;
            n.artificial_viscosity = 0.1;
            n.shifting_coefficient = 0.25;
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "solitary waves at upright walls over beds no steeper than 1:2",
        keys: &[("artificial_viscosity", "0.09")],
        why: "The middle of 0.08 to 0.1. With these the runup of H/h = 0.6 at 8 mm is best at all sound speeds.",
        holds: |a| a.scene.has_solitary_wave_at_upright_wall(),
        set: |n, _| n.artificial_viscosity = 0.09,
    },
    Suited {
        presets: DEFAULT,
        scenes: "trains, standing waves, and solitary waves at upright walls over beds no steeper than 1:2",
        keys: &[("extrapolated_correction", "true"), ("limited_viscosity", "false")],
        why: "On the way to the wall small gains and losses of energy add up.",
        holds: |a| a.scene.has_solitary_wave_at_upright_wall() || a.scene.has_waves_that_go_on(),
        set: |n, _| {
            n.extrapolated_correction = true;
            n.limited_viscosity = false;
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "solitary waves above H/h = 0.7 at upright walls over beds no steeper than 1:2, and dam breaks of more \
                 than 8 √(H/g) or 4 L/√(gH), less where the wall is nearer than 3.3 H",
        keys: &[("surface_relief", "true")],
        why: "Single particles beside a cavity would keep it open.",
        holds: |a| {
            let falls = a.scene.has_solitary_wave_at_upright_wall() && a.scene.falls_free();
            falls || a.scene.plunges_on_water()
        },
        set: |n, _| n.surface_relief = true,
    },
    Suited {
        presets: DEFAULT,
        scenes: "solitary waves at upright walls over level beds",
        keys: &[("sound_speed_ratio", "8 √(h/(12.5 Δx))")],
        why: "The error by sound then falls as the spacing does.",
        holds: |a| {
            a.scene.has_solitary_wave_at_upright_wall() && a.scene.is_upright_over_level_bed()
        },
        set: |n, a| {
            n.sound_speed_ratio = sound_speed_ratio(a.scene.frame().depth, a.particle_spacing);
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "trains, standing waves, uneven beds, walls with a crest, and waves that come back to a wall that leans",
        keys: &[("boundary", "\"normalized\"")],
        why: "Water creeps along slopes, and along walls that waves keep meeting. Under trains before a crest the forces \
              on face and ghosts would differ by up to 3.5 % at ten rows.",
        holds: |a| {
            let uneven = a.scene.bed().is_some() || a.scene.has_crested_wall();
            a.scene.has_waves_that_go_on() || uneven || a.stirs_at_wall_that_leans()
        },
        set: |n, _| n.boundary = BoundaryChoice::Normalized,
    },
    Suited {
        presets: DEFAULT,
        scenes: "trains, standing waves, and uneven beds",
        keys: &[("ghost_gravity", "\"falling\"")],
        why: "Ghosts that take all water to be at rest take energy from waves at the wall. Over beds they throw steep \
              waves up to 0.01 h too high at fine spacings.",
        holds: |a| a.scene.has_waves_that_go_on() || a.scene.bed().is_some(),
        set: |n, _| n.ghost_gravity = GhostGravity::Falling,
    },
    Suited {
        presets: DEFAULT,
        scenes: "walls with a crest",
        keys: &[("conservative_crest", "true")],
        why: "Ghosts end at a crest, and their pressure would make or take energy there.",
        holds: |a| a.scene.has_crested_wall(),
        set: |n, _| n.conservative_crest = true,
    },
    Suited {
        presets: DEFAULT,
        scenes: "trains, standing waves, and waves that come back; shores steeper than 1:2, and beds as steep that end \
                 less than one and a half rows under the still water; shores from 1:5 on in runs of more than 70 \
                 √(h/g), and all shores in runs of more than 200 √(h/g)",
        keys: &[("shifting", "\"deep\""), ("volume_feedback", "0.002")],
        why: "Water that is stirred for so long would sink through itself.",
        holds: |a| {
            let again = a.timed && a.scene.hits_again();
            let shore = a.scene.stirs_at_shore(a.particle_spacing);
            a.scene.has_waves_that_go_on() || shore || again
        },
        set: |n, _| {
            n.shifting = Shifting::Deep;
            n.volume_feedback = 0.002;
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "still water before walls that lean, in runs of more than 30 √(h/g)",
        keys: &[
            ("boundary", "\"normalized\""),
            ("artificial_viscosity", "0.3"),
            ("shifting", "\"deep\""),
            ("volume_feedback", "0.01"),
        ],
        why: "In the corners water would begin to turn, and sink.",
        holds: |a| a.scene.stirs_at_leaning_wall(),
        set: |n, _| {
            n.boundary = BoundaryChoice::Normalized;
            n.artificial_viscosity = 0.3;
            n.shifting = Shifting::Deep;
            n.volume_feedback = 0.01;
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "beds that come out of the still water; still water before seawalls that lean, in runs of more than 30 \
                 √(h/g)",
        keys: &[("relaxation_time_s", "40 √(h/g)")],
        why: "Still water there needs a while to come to rest.",
        holds: |a| {
            let calms = a.scene.stirs_at_leaning_wall() && a.scene.seawall().is_some();
            a.scene.has_shore() || calms
        },
        set: |n, a| {
            let Frame { depth, gravity, .. } = a.scene.frame();
            n.relaxation_time_s = RELAXES_OVER * (depth / gravity).sqrt();
        },
    },
    Suited {
        presets: DEFAULT,
        scenes: "beds steeper than 1:2 somewhere under the still water, and from 1:5 on in runs of more than 30 √(h/g); \
                 trains before shores; shores no steeper than 1:2 in runs of more than 200 √(h/g)",
        keys: &[("shifting", "\"deep\""), ("conservative_bed", "true")],
        why: "Where the bed bends down, water that moves round the bend would gain energy by shifting.",
        holds: |a| a.scene.stirs_over_bed(),
        set: |n, _| {
            n.shifting = Shifting::Deep;
            n.conservative_bed = true;
        },
    },
];
