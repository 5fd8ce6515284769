//! What holds of the sources, and of the files that come with them.
//!
//! One program for all of them: each links the whole library, and in one of them the short tests fill the time of
//! the long ones. `cargo test --test house circles::` asks one file alone.

#[path = "../circles.rs"]
mod circles;
#[path = "../containers.rs"]
mod containers;
#[path = "../key_tables.rs"]
mod key_tables;
#[path = "../layers.rs"]
mod layers;
#[path = "../shipped_files.rs"]
mod shipped_files;
