//! The `seawall` command: see [`seawall::cli`].

#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: seawall::math::large_pages::LargePages = seawall::math::large_pages::LargePages;

fn main() -> std::process::ExitCode {
    seawall::cli::main()
}
