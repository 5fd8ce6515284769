//! The program's words and files from outside: what its subcommands print, write and refuse.
//!
//! One program for all of them: each links the whole library, and in one of them the short tests fill the time of
//! the long ones. `cargo test --test cli art::` asks one file alone.

#[path = "../art.rs"]
mod art;
#[path = "../bad_inputs.rs"]
mod bad_inputs;
#[path = "../branches.rs"]
mod branches;
#[path = "../cli_beds.rs"]
mod cli_beds;
#[path = "../cli_damage.rs"]
mod cli_damage;
#[path = "../cli_film.rs"]
mod cli_film;
#[path = "../cli_find.rs"]
mod cli_find;
#[path = "../cli_input.rs"]
mod cli_input;
#[path = "../cli_interrupted.rs"]
mod cli_interrupted;
#[path = "../cli_loads.rs"]
mod cli_loads;
#[path = "../cli_making.rs"]
mod cli_making;
#[path = "../cli_matrix.rs"]
mod cli_matrix;
#[path = "../cli_messages.rs"]
mod cli_messages;
#[path = "../cli_papers.rs"]
mod cli_papers;
#[path = "../cli_refine.rs"]
mod cli_refine;
#[path = "../cli_scenes.rs"]
mod cli_scenes;
#[path = "../cli_terminal.rs"]
mod cli_terminal;
#[path = "../cli_told_files.rs"]
mod cli_told_files;
#[path = "../common/mod.rs"]
mod common;
#[path = "../limits.rs"]
mod limits;
#[path = "../schema.rs"]
mod schema;
