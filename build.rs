//! Embeds what the program was built from, for provenance: the git commit, "unknown" where there is no
//! git, and a sum over its sources, which tells two builds of one commit apart.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};

/// What decides the program besides the compiler.
const SOURCES: [&str; 5] = ["src", "data", "Cargo.toml", "Cargo.lock", "build.rs"];

fn main() {
    for path in SOURCES.into_iter().chain([".git/HEAD", ".git/refs/heads"]) {
        if Path::new(path).exists() {
            println!("cargo:rerun-if-changed={path}");
        }
    }
    println!("cargo:rustc-env=SEAWALL_GIT_COMMIT={}", commit());
    println!("cargo:rustc-env=SEAWALL_SOURCES={}", sum());
}

fn commit() -> String {
    let output = Command::new("git").args(["rev-parse", "HEAD"]).output().ok();
    let output = output.filter(|output| output.status.success());
    let text = output.and_then(|output| String::from_utf8(output.stdout).ok());
    text.map_or_else(|| "unknown".to_owned(), |text| text.trim().to_owned())
}

/// The start of SHA-256 over all sources, 16 hex digits.
fn sum() -> String {
    let mut files = Vec::new();
    SOURCES.iter().for_each(|path| gather(Path::new(path), &mut files));
    files.sort();
    let mut hash = Sha256::new();
    for path in files {
        hash.update(path.to_string_lossy().as_bytes());
        hash.update(fs::read(&path).unwrap_or_default());
    }
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

fn gather(path: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(path) else { return files.push(path.to_owned()) };
    entries.flatten().for_each(|entry| gather(&entry.path(), files));
}
