//! No circles: two files never need each other, but a folder's `mod.rs` and the files in it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module: the names from the crate's root to it.
type Module = Vec<String>;

#[test]
fn no_two_files_need_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    read(&root, &root, &mut files);
    assert!(files.len() > 100, "the scan found no sources");
    let circles = circles(&Sources::new(files));
    assert!(circles.is_empty(), "files that need each other: {circles:#?}");
}

#[test]
fn a_circle_is_found_through_a_folder_that_hands_on_a_name() {
    let files = [
        ("lib", "pub mod a; pub mod b; pub mod c;"),
        ("a/mod", "mod x;\nmod y;\npub use x::Name;\npub use y::{self, Other as Another};"),
        ("a/x", "use super::Another;\nuse crate::{b::{self}, c};"),
        ("a/y", "//! crate::c\n#[cfg(test)]\nmod tests {\n use super::super::x::Name;\n}"),
        ("b", "use crate::{a::{y, Name}};"),
        ("c", "fn f() -> crate::a::Another { super::b::g() }"),
    ];
    let files = files.map(|(name, text)| (name.to_owned(), text.to_owned()));
    let circle = ["a/x", "b", "c"].map(str::to_owned).to_vec();
    assert_eq!(circles(&Sources::new(files)), BTreeSet::from([circle]));
}

/// Adds the sources of a folder, each with its path from the root without the ending, and its text.
/// Beside some of them lies a script or a style of the same name.
fn read(root: &Path, folder: &Path, files: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            read(root, &path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let name = path.strip_prefix(root).unwrap().with_extension("");
            files.push((name.to_str().unwrap().to_owned(), fs::read_to_string(&path).unwrap()));
        }
    }
}

/// Groups of files that all need each other.
fn circles(sources: &Sources) -> BTreeSet<Vec<String>> {
    let needs: BTreeMap<_, _> =
        sources.0.keys().map(|file| (file, sources.reached_from(file))).collect();
    let circle = |file: &Module, others: &BTreeSet<Module>| -> Vec<String> {
        others.iter().filter(|other| needs[*other].contains(file)).map(|m| m.join("/")).collect()
    };
    let circles = needs.iter().map(|(file, others)| circle(file, others));
    circles.filter(|circle| circle.len() > 1).collect()
}

/// A path that a file names, and what the file calls it.
struct Import {
    path: Vec<String>,
    name: String,
}

/// What each module's file names.
struct Sources(BTreeMap<Module, Vec<Import>>);

impl Sources {
    fn new(files: impl IntoIterator<Item = (String, String)>) -> Sources {
        let files = files.into_iter().map(|(name, text)| (module(&name), imports(&text)));
        Sources(files.collect())
    }

    /// Every file that this one needs, whether it says so itself or those that it needs do.
    fn reached_from(&self, file: &Module) -> BTreeSet<Module> {
        let (mut found, mut open) = (BTreeSet::new(), vec![file.clone()]);
        while let Some(from) = open.pop() {
            for import in &self.0[&from] {
                let to = self.resolve(&from, &import.path, 0).filter(|to| !is_family(&from, to));
                open.extend(to.filter(|to| found.insert(to.clone())));
            }
        }
        found
    }

    /// The module of this crate that a path written in `from` leads into.
    fn resolve(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let mut at = from.clone();
        let mut names = path.iter().peekable();
        match path.first()?.as_str() {
            "crate" => at.clear(),
            "self" | "super" => {}
            first if self.has(from, first) => {}
            first => {
                // A name that another `use` of the same file brought in.
                let known = self.0[from].iter().find(|i| i.name == first && i.path[0] != first)?;
                let whole = [&known.path, &path[1..]].concat();
                return if depth < 8 { self.resolve(from, &whole, depth + 1) } else { None };
            }
        }
        while let Some(name) = names.next_if(|n| ["crate", "self", "super"].contains(&n.as_str())) {
            if name == "super" {
                at.pop();
            }
        }
        let rest: Vec<_> = names.cloned().collect();
        for (k, name) in rest.iter().enumerate() {
            if self.has(&at, name) {
                at.push(name.clone());
                continue;
            }
            let handed_on = self.0[&at].iter().find(|import| import.name == *name && depth < 8);
            let through = handed_on.and_then(|import| {
                self.resolve(&at, &[&import.path, &rest[k + 1..]].concat(), depth + 1)
            });
            return Some(through.unwrap_or(at));
        }
        Some(at)
    }

    fn has(&self, module: &Module, child: &str) -> bool {
        self.0.contains_key(&[&module[..], &[child.to_owned()]].concat())
    }
}

fn module(name: &str) -> Module {
    let parts = name.split('/').filter(|part| !["mod", "lib"].contains(part));
    parts.map(str::to_owned).collect()
}

/// A file itself, or a folder and a file of it.
fn is_family(a: &Module, b: &Module) -> bool {
    a == b
        || a.split_last().is_some_and(|(_, a)| a == b)
        || b.split_last().is_some_and(|(_, b)| a == b)
}

/// All paths into this crate that a file names, but for comments and tests at its end.
fn imports(text: &str) -> Vec<Import> {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    let text = lines.take_while(|line| *line != "mod tests {").collect::<Vec<_>>().join("\n");
    let mut found = Vec::new();
    for start in ["use ", "crate::", "super::", "self::"] {
        for (at, _) in text.match_indices(start) {
            if !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
                tree(text[at..].trim_start_matches("use "), Vec::new(), &mut found);
            }
        }
    }
    found
}

/// Takes a path, or several in braces, off the text.
fn tree<'a>(mut text: &'a str, mut path: Vec<String>, found: &mut Vec<Import>) -> &'a str {
    loop {
        text = text.trim_start();
        if let Some(group) = text.strip_prefix('{') {
            text = group;
            while !text.is_empty() && !text.starts_with(['}', ';']) {
                text = tree(text, path.clone(), found);
                text = text.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
            }
            return text.get(1..).unwrap_or("");
        }
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
        let name = &text[..end];
        if !name.is_empty() && (name != "self" || path.is_empty()) {
            path.push(name.to_owned());
        }
        text = text[end..].trim_start_matches('*');
        match text.strip_prefix("::") {
            Some(rest) => text = rest,
            None => break,
        }
    }
    let alias =
        text.trim_start().strip_prefix("as ").and_then(|rest| rest.split([';', ',', '}']).next());
    let name = alias.map(|alias| alias.trim().to_owned()).or(path.last().cloned());
    found.extend(name.map(|name| Import { path, name }));
    text.find([',', '}', ';']).map_or("", |end| &text[end..])
}
