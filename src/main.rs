//! The `seawall` command: see [`seawall::cli`].

fn main() -> std::process::ExitCode {
    seawall::cli::main()
}
