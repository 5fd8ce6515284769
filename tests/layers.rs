//! The order of the layers, kept by a scan of the sources: a file imports only from its own layer
//! or from below, MPI stays in one module, reports stay clear of solvers, and files stay short.

use std::fs;
use std::path::{Path, PathBuf};

/// The layers from the ground up; modules of one layer may use each other.
const LAYERS: &[&[&str]] = &[
    &["math", "theory", "keys", "disk"],
    &["kernel"],
    &["pairs"],
    &["boundary", "body"],
    &["water"],
    &["scheme"],
    &["scene"],
    &["simulation"],
    &["quantities", "papers"],
    &["study"],
    &["schedule"],
    &["results"],
    &["film"],
    &["execute"],
    &["accuracy"],
    &["report"],
    &["cli"],
];

/// What the report must never know, though it stands above it.
const NOT_FOR_REPORTS: &[&str] = &[
    "boundary",
    "pairs",
    "scheme",
    "simulation",
    "study",
    "schedule",
    "results",
    "film",
    "execute",
    "accuracy",
];

/// Exported macros stand at the crate's root: the modules they belong to.
const MACROS: &[(&str, &str)] = &[("with_kernel", "kernel")];

/// The most lines of a file, by the folder that it is in.
const LONGEST: [(&str, usize); 3] = [("src", 250), ("tests", 400), ("examples", 400)];

#[test]
fn files_import_from_their_own_layer_or_below() {
    let mut wrong = Vec::new();
    for (path, text) in sources("src") {
        let Some(module) = module_of(&path) else { continue };
        let layer = layer_of(&module);
        for import in imports(&text) {
            if layer_of(&import) > layer {
                wrong.push(format!("{}: {module} uses {import}", path.display()));
            }
            if module == "report" && NOT_FOR_REPORTS.contains(&import.as_str()) {
                wrong.push(format!("{}: reports read files only, not {import}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn one_module_names_the_mpi_crate() {
    let allowed = Path::new("src/execute/mpi");
    let wrong: Vec<_> = sources("src")
        .into_iter()
        .filter(|(path, text)| {
            !path.with_extension("").starts_with(allowed) && names_mpi_crate(text)
        })
        .map(|(path, _)| path.display().to_string())
        .collect();
    assert!(wrong.is_empty(), "only {} may name it: {wrong:?}", allowed.display());
}

/// The story: five files compared kinds of walls, so that whoever added one had to find them. They ask the wall now.
#[test]
fn kinds_of_walls_are_named_where_they_are_declared() {
    let own = [Path::new("src/scene/seawall.rs"), Path::new("src/scene/wall_choice.rs")];
    let names = |text: &str| {
        let text = code(text.split("#[cfg(test)]").next().unwrap());
        let mut kinds = text.match_indices("WallChoice::").map(|(at, of)| &text[at + of.len()..]);
        kinds.any(|kind| kind.starts_with(char::is_uppercase))
    };
    let others = sources("src").into_iter().filter(|(path, _)| !own.contains(&path.as_path()));
    let others = others.filter(|(path, _)| !path.ends_with("tests.rs"));
    let wrong: Vec<_> = others.filter(|(_, text)| names(text)).map(|(path, _)| path).collect();
    assert!(wrong.is_empty(), "give the wall a question in src/scene/wall_choice.rs: {wrong:?}");
}

#[test]
fn no_file_is_too_long() {
    for (folder, longest) in LONGEST {
        let lengths = sources(folder).into_iter().map(|(path, text)| (path, text.lines().count()));
        let wrong: Vec<_> = lengths.filter(|(_, lines)| *lines > longest).collect();
        assert!(wrong.is_empty(), "longer than {longest} lines: {wrong:?}");
    }
}

/// A file of tests that no program has would never run.
#[test]
fn every_file_of_tests_is_in_one_program() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let all = sources("tests");
    let own = |path: &Path| path.parent() == Some(Path::new("tests"));
    for (path, _) in all.iter().filter(|(path, _)| own(path)) {
        let name = path.file_name().unwrap().to_str().unwrap();
        let alone = manifest.matches(&format!("path = \"tests/{name}\"")).count();
        let joined = |text: &String| text.contains(&format!("#[path = \"../{name}\"]"));
        let joined =
            all.iter().filter(|(path, text)| path.starts_with("tests/programs") && joined(text));
        assert_eq!(alone + joined.count(), 1, "{name}: name it in tests/programs or in Cargo.toml");
    }
}

#[test]
fn the_scan_sees_what_it_should() {
    let text =
        "use crate::{math::simd, scene::{Scene, x}};\n//! crate::cli\nlet a = crate::body::f();";
    assert_eq!(imports(text), ["math", "scene", "body"]);
    assert!(
        names_mpi_crate("use mpi::traits::*;") && names_mpi_crate("let u = ::mpi::initialize();")
    );
    assert!(!names_mpi_crate("mod mpi;\nmpi::run()") && !names_mpi_crate("super::mpi::run()"));
    assert!(!names_mpi_crate("use crate::x::{y, mpi, z};\nmpi::run()"));
    assert!(names_mpi_crate("use crate::x::{y, z};\nmpi::run()"));
    assert!(layer_of("theory") < layer_of("kernel"));
    assert_eq!(layer_of("with_kernel"), layer_of("kernel"));
}

fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    let mut open = vec![root.join(folder)];
    while let Some(folder) = open.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                found.push((path.strip_prefix(root).unwrap().to_owned(), text));
            }
        }
    }
    assert!(folder != "src" || found.len() > 10, "the scan found no sources");
    found.sort();
    found
}

/// The top-level module that a file of `src` belongs to; none for `lib.rs` and `main.rs`.
fn module_of(path: &Path) -> Option<String> {
    let first = path.strip_prefix("src").ok()?.components().next()?.as_os_str().to_str()?;
    let module = first.strip_suffix(".rs").unwrap_or(first);
    (!["lib", "main"].contains(&module)).then(|| module.to_owned())
}

/// Unknown modules are an error, so that none escapes the scan.
fn layer_of(module: &str) -> usize {
    let of_macro = MACROS.iter().find(|(name, _)| *name == module);
    let module = of_macro.map_or(module, |(_, module)| module);
    LAYERS
        .iter()
        .position(|layer| layer.contains(&module))
        .unwrap_or_else(|| panic!("{module} has no layer: add it to tests/layers.rs"))
}

/// The text without comments.
fn code(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// Top-level modules after each `crate::`, in braces or not.
fn imports(text: &str) -> Vec<String> {
    let text = code(text);
    let mut modules = Vec::new();
    for rest in text.split("crate::").skip(1) {
        match rest.strip_prefix('{') {
            Some(group) => modules.extend(heads(group)),
            None => modules.push(word(rest)),
        }
    }
    modules.retain(|module| module.chars().next().is_some_and(char::is_lowercase));
    modules
}

/// The first words of a brace group's items.
fn heads(group: &str) -> Vec<String> {
    let (mut depth, mut starts) = (1, vec![0]);
    for (at, character) in group.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => starts.push(at + 1),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    starts.into_iter().map(|at| word(group[at..].trim_start())).collect()
}

fn word(text: &str) -> String {
    text.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect()
}

/// True where a `use` of this crate brings in one of its own modules by the name `mpi`.
fn uses_own_mpi_module(text: &str) -> bool {
    let uses = text.split("use ").skip(1).filter_map(|rest| rest.split(';').next());
    uses.filter(|path| ["crate::", "self::", "super::"].iter().any(|own| path.starts_with(own)))
        .any(|path| path.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == "mpi"))
}

/// True where a path starts at the crate `mpi`, and not at a module of that name.
fn names_mpi_crate(text: &str) -> bool {
    let text = code(text);
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let has_module = text.contains("mod mpi;") || uses_own_mpi_module(&text);
    text.match_indices("mpi").any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + 3..]);
        if before.ends_with(is_word) || after.starts_with(is_word) {
            return false;
        }
        if before.ends_with("extern crate ") {
            return true;
        }
        let in_use = before.ends_with("use ");
        match before.strip_suffix("::") {
            Some(path) => !path.ends_with(is_word) && after.starts_with("::"),
            None if in_use => !has_module,
            None => after.starts_with("::") && !has_module,
        }
    })
}
