//! The recipes of containers. They install what the scripts install, build with the compiler that the manifest asks
//! for, and try what they have built. This machine need not be able to build them.

use std::collections::BTreeSet;
use std::path::Path;

const RECIPES: [&str; 2] = ["containers/Dockerfile", "containers/seawall.def"];

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What the scripts install for a build with MPI.
fn packages() -> BTreeSet<String> {
    let setup = read("scripts/lib/setup.sh");
    let function = |name: &str| {
        let body = setup.split_once(&format!("\n{name}() {{\n")).unwrap().1;
        body.split_once("\n}\n").unwrap().0
    };
    let compiler = function("need_compiler");
    let of_compiler =
        compiler.split_once("install_packages ").unwrap().1.split_once(" ||").unwrap().0;
    let missing = function("need_mpi").split("missing+=(").skip(1);
    let of_mpi = missing.map(|rest| rest.split_once(')').unwrap().0);
    of_compiler.split(' ').chain(of_mpi).map(str::to_owned).collect()
}

/// The packages of each `apt-get install` of a recipe.
fn installed(recipe: &str) -> Vec<BTreeSet<String>> {
    let joined = recipe.replace("\\\n", " ");
    let lines = joined.lines().filter_map(|line| line.split_once("apt-get install "));
    let of = |rest: &str| {
        let words = rest.split("&&").next().unwrap().split_whitespace();
        words.filter(|word| !word.starts_with('-')).map(str::to_owned).collect()
    };
    lines.map(|(_, rest)| of(rest)).collect()
}

#[test]
fn recipes_install_what_the_scripts_install() {
    let wanted = packages();
    assert!(wanted.len() >= 5 && wanted.contains("libopenmpi-dev"), "{wanted:?}");
    for path in RECIPES {
        let installed = installed(&read(path));
        assert_eq!(installed.first(), Some(&wanted), "{path}");
        // What runs needs no more than the launcher and its libraries.
        assert!(installed[1..].iter().all(|later| later.is_subset(&wanted)), "{path}");
    }
}

#[test]
fn recipes_build_with_mpi_and_try_what_they_have_built() {
    let manifest: toml::Table = read("Cargo.toml").parse().unwrap();
    let rust = manifest["package"]["rust-version"].as_str().unwrap();
    for path in RECIPES {
        let recipe = read(path).replace("\\\n", " ");
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let text = recipe.lines().map(words).collect::<Vec<_>>().join("\n");
        assert!(text.contains(&format!("rust:{rust}-bookworm")), "{path}");
        for step in [
            "cargo build --release --locked --features mpi",
            "seawall --version",
            "seawall sweep /usr/local/share/seawall/sweeps/smoke.toml",
        ] {
            assert!(text.contains(step), "{path}: {step}");
        }
        assert!(text.contains("mpirun -n 2 "), "{path}");
    }
    read("sweeps/smoke.toml");
    assert!(read(".dockerignore").lines().any(|line| line == "target"));
}

#[test]
fn the_docs_name_them() {
    let docs = read("docs/files.md");
    for path in RECIPES {
        assert!(docs.contains(path), "{path}");
    }
}
