//! Waves before walls of every kind, asked through the library and the program.
//!
//! One program for all of them: each links the whole library, and in one of them the short tests fill the time of
//! the long ones. `cargo test --test waves absorption::` asks one file alone.

#[path = "../absorption.rs"]
mod absorption;
#[path = "../beach.rs"]
mod beach;
#[path = "../bed.rs"]
mod bed;
#[path = "../bed_rest.rs"]
mod bed_rest;
#[path = "../common/beds.rs"]
mod beds;
#[path = "../behind.rs"]
mod behind;
#[path = "../breaking.rs"]
mod breaking;
#[path = "../common/mod.rs"]
mod common;
#[path = "../crest.rs"]
mod crest;
#[path = "../shores.rs"]
mod shores;
#[path = "../threads.rs"]
mod threads;
#[path = "../trains.rs"]
mod trains;
