//! Walls and paddles. Each turns time or the water's force into motion, without any data of
//! particles. [`WallLaw`] and [`PaddleLaw`] say what a run asks of them.
//!
//! A new member needs one file here with its keys, and a line of [`Wall`] or [`Paddle`]. The scene
//! of the seawall names both.

mod contract;
mod fixed_wall;
mod goring_paddle;
mod place;
mod recorded_stroke;
mod sliding_caisson;
mod spring_wall;
mod wave_train;

use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};

pub use contract::{BodyMotion, PaddleLaw, Restraint, WallLaw, WallState, WallStep};
pub use fixed_wall::FixedWall;
pub use goring_paddle::GoringPaddle;
pub use place::{MOST_BODIES, Motions, Place};
pub use recorded_stroke::{RecordedStroke, RecordedStrokeKeys, Stroke};
pub use sliding_caisson::{CaissonKeys, SlidingCaisson};
pub use spring_wall::SpringWall;
pub use wave_train::{SecondStroke, WaveTrain, WaveTrainKeys};

/// Declares a family: a variant for each member, which derefs to its law.
macro_rules! family {
    ($(#[$about:meta])* $name:ident: $law:ident; $($(#[$doc:meta])* $variant:ident($member:ty);)+) => {
        $(#[$about])*
        pub enum $name {
            $($(#[$doc])* $variant($member),)+
        }

        impl Deref for $name {
            type Target = dyn $law;

            fn deref(&self) -> &Self::Target {
                match self {
                    $($name::$variant(member) => member,)+
                }
            }
        }

        impl DerefMut for $name {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $($name::$variant(member) => member,)+
                }
            }
        }
    };
}

family! {
    /// The wall at the end of a tank.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    Wall: WallLaw;
    /// It stands still.
    Fixed(FixedWall);
    /// It is mounted on a spring.
    Spring(SpringWall);
    /// It slides on its bed with friction.
    Caisson(SlidingCaisson);
}

family! {
    /// What moves the water at the start of a tank.
    #[derive(Debug, Clone, PartialEq)]
    Paddle: PaddleLaw;
    /// A piston that makes a solitary wave.
    Goring(GoringPaddle);
    /// A piston that makes regular waves.
    WaveTrain(WaveTrain);
    /// It plays a stroke from a file.
    Recorded(RecordedStroke);
}
