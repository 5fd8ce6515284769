//! Turns an error into one line on standard error, an object for programs, and an exit code.

use std::io::ErrorKind::{
    self, AlreadyExists, IsADirectory, NotADirectory, PermissionDenied, ReadOnlyFilesystem,
};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::output::json_path;
use super::{BAD_INPUT, INTERNAL, SUCCESS};
use crate::execute::Launcher;
use crate::keys::{named, shown};
use crate::math::words::in_words;
use crate::report::ReportError;
use crate::results::SweepError;
use crate::scene::ConfigError;

/// A fault that the user can put right.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(super) struct BadInput(pub(super) String);

impl BadInput {
    /// A fault in a file or directory.
    pub(super) fn of(path: &Path, reason: impl std::fmt::Display) -> BadInput {
        BadInput(format!("{}: {reason}", named(path)))
    }

    /// A fault in the sweep file that an output directory was made from.
    pub(super) fn of_stored(directory: &Path, error: &ConfigError) -> BadInput {
        BadInput::of(directory, format_args!("sweep_file in manifest.json: {error}"))
    }
}

/// Something in the way of a study's file is bad input: no command can go on until the user removes
/// it. All other kinds of errors are the machine's, and the place is not at fault.
pub(super) fn in_the_way(error: anyhow::Error) -> anyhow::Error {
    told_as_bad_input(error, |kind| matches!(kind, AlreadyExists | IsADirectory | NotADirectory))
}

/// The same, and also for a directory that must not be written.
pub(super) fn not_writable(error: impl Into<anyhow::Error>) -> anyhow::Error {
    let error = in_the_way(error.into());
    told_as_bad_input(error, |kind| matches!(kind, PermissionDenied | ReadOnlyFilesystem))
}

fn told_as_bad_input(error: anyhow::Error, is_bad: fn(ErrorKind) -> bool) -> anyhow::Error {
    let (path, reason) = match (error.downcast_ref(), error.downcast_ref()) {
        (Some(SweepError::Io { path, error }), _) => (path, error),
        (_, Some(ReportError::Write { path, error })) => (path, error),
        _ => return error,
    };
    if !is_bad(reason.kind()) {
        return error;
    }
    let told = format_args!(
        "cannot be written: {}; a study's directory must be writable, with nothing else in the way of \
         its files",
        in_words(reason)
    );
    BadInput::of(path, told).into()
}

/// A fault in a file's value that the user can put right.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}{}", named(path), if *set { " (given by --set)" } else { "" })]
pub(super) struct BadFile {
    path: PathBuf,
    /// Whether `--set` gave the value, and not the file.
    set: bool,
    error: ConfigError,
}

impl BadFile {
    /// Wraps an error with the file that it is in.
    pub(super) fn of(path: &Path) -> impl Fn(ConfigError) -> BadFile + '_ {
        move |error| BadFile { path: path.to_owned(), set: false, error }
    }

    /// The same where `is_set` tells of a key that `--set` gave it.
    pub(super) fn unless_set(
        path: &Path,
        is_set: impl Fn(&str) -> bool,
    ) -> impl Fn(ConfigError) -> BadFile {
        move |error| BadFile { path: path.to_owned(), set: is_set(&error.key), error }
    }
}

/// Reports an error, on rank 0 only, and turns it into the exit code.
pub(super) fn exit_code(result: anyhow::Result<u8>, launcher: Launcher, as_json: bool) -> u8 {
    let error = match result {
        Ok(code) => return code,
        Err(error) => in_the_way(error),
    };
    if launcher.rank > 0 || is_broken_pipe(&error) {
        return SUCCESS;
    }
    let line = shown(&message(&error).replace('\n', " "));
    let code = if is_bad_input(&error) { BAD_INPUT } else { INTERNAL };
    if as_json {
        print(&object(&error, &line, code));
    }
    // If standard error is closed, nobody can be told.
    let _ = writeln!(std::io::stderr(), "error: {line}");
    code
}

/// Reports a command line that was not understood to a program that reads JSON.
pub(super) fn print_usage(message: &str) {
    let lines = message.lines().map(str::trim).take_while(|line| {
        !line.starts_with("Usage:") && !line.starts_with("For more information")
    });
    let words: Vec<_> = lines.filter(|line| !line.is_empty()).collect();
    let message = words.join(" ");
    let message = message.trim_start_matches("error: ");
    print(&json!({ "error": { "kind": "usage", "message": message, "exit_code": BAD_INPUT } }));
}

/// Reports a panic to a program that reads JSON.
pub(super) fn print_internal(message: &str) {
    print(&json!({ "error": { "kind": "internal", "message": message, "exit_code": INTERNAL } }));
}

/// An answer for a program that reads JSON, where there is no [`super::output::Output`] yet.
pub(super) fn print(value: &Value) {
    let _ = writeln!(std::io::stdout(), "{value:#}");
}

fn is_bad_input(error: &anyhow::Error) -> bool {
    let refused = error.downcast_ref::<SweepError>().is_some_and(SweepError::is_refusal);
    let damaged = error.downcast_ref::<ReportError>().is_some_and(ReportError::is_of_the_files);
    refused || damaged || error.is::<BadInput>() || error.is::<BadFile>()
}

/// The error as an object: file, key, value and allowed values, as far as known.
fn object(error: &anyhow::Error, message: &str, code: u8) -> Value {
    let kind = if code == BAD_INPUT { "bad-input" } else { "internal" };
    let mut told = json!({ "kind": kind, "message": message, "exit_code": code });
    if let Some(BadFile { path, set, error }) = error.downcast_ref() {
        // The line is in the file itself, or in the file that a value names.
        let (line, key) = line_and_rest(&error.key);
        let (line_there, allowed) = line_and_rest(&error.allowed);
        told["file"] = json!(json_path(path));
        if *set {
            told["given_by"] = json!("--set");
        }
        told["key"] = json!(key);
        told["value"] = json!(error.value);
        told["allowed"] = json!(allowed);
        if let Some(line) = line.or(line_there) {
            told["line"] = json!(line);
        }
    }
    if let Some(SweepError::Io { path, .. }) = error.downcast_ref() {
        told["file"] = json!(json_path(path));
    }
    json!({ "error": told })
}

/// The line number at the start of a text, and the rest of the text.
fn line_and_rest(text: &str) -> (Option<u64>, &str) {
    let (line, rest) = text.split_once(": ").unwrap_or((text, ""));
    match line.strip_prefix("line ").and_then(|line| line.parse().ok()) {
        Some(line) => (Some(line), rest),
        None => (None, text),
    }
}

/// An error and its causes, without causes that the line ends with already.
fn message(error: &anyhow::Error) -> String {
    let mut line = String::new();
    for cause in error.chain() {
        let cause = cause.downcast_ref().map_or_else(|| cause.to_string(), in_words);
        if !line.ends_with(&cause) {
            let gap = if line.is_empty() { "" } else { ": " };
            line.push_str(gap);
            line.push_str(&cause);
        }
    }
    line
}

/// Whether the reader has left, as `head` does. This is no fault.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let system = error.downcast_ref::<std::io::Error>();
    system.is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_their_codes() {
        let code = |error: anyhow::Error| exit_code(Err(error), Launcher::default(), false);
        assert_eq!(code(BadInput("x".into()).into()), BAD_INPUT);
        let bad_file = BadFile::of(Path::new("a"))(ConfigError::new("k", 1, "must be 2"));
        assert_eq!(code(bad_file.into()), BAD_INPUT);
        assert_eq!(code(SweepError::Refused("x".into()).into()), BAD_INPUT);
        assert_eq!(code(SweepError::Executor("x".into()).into()), INTERNAL);
        let damaged = ReportError::MissingColumn { path: "a".into(), column: "b" };
        assert_eq!(code(damaged.into()), BAD_INPUT);
        let io = |number| SweepError::io(Path::new("a"))(std::io::Error::from_raw_os_error(number));
        // A directory in the way; a full disk; no right to write, after hours of a sweep and for a report.
        assert_eq!(code(io(21).into()), BAD_INPUT);
        assert_eq!(code(io(28).into()), INTERNAL);
        assert_eq!(code(io(13).into()), INTERNAL);
        assert_eq!(code(not_writable(io(13))), BAD_INPUT);
        let left = || anyhow::Error::from(std::io::Error::from(ErrorKind::BrokenPipe));
        assert_eq!(code(left()), SUCCESS);
        assert_eq!(code(left().context("standard output")), SUCCESS);
        assert_eq!(code(anyhow::anyhow!("x")), INTERNAL);
    }

    #[test]
    fn a_line_is_no_key() {
        assert_eq!(line_and_rest("line 4"), (Some(4), ""));
        assert_eq!(
            line_and_rest("line 12: still_water_depth_m"),
            (Some(12), "still_water_depth_m")
        );
        assert_eq!(line_and_rest("scene.wall"), (None, "scene.wall"));
        let field = |key: &str, allowed: &str, field: &str| {
            let error = BadFile::of(Path::new("a"))(ConfigError::new(key, 1, allowed));
            object(&error.into(), "", BAD_INPUT)["error"].get(field).cloned()
        };
        assert_eq!(field("scene.wall", "must be 2", "line"), None, "rather than null");
        assert_eq!(field("line 3: wall", "must be 2", "line"), Some(json!(3)));
        let of_stroke = |name| field("scene.recorded_stroke", "line 3: is no number", name);
        assert_eq!(of_stroke("line"), Some(json!(3)));
        assert_eq!(of_stroke("allowed"), Some(json!("is no number")));
    }

    #[test]
    fn a_cause_is_told_once() {
        let error = anyhow::anyhow!("disk full").context("cannot write a: disk full");
        assert_eq!(message(&error), "cannot write a: disk full");
        assert_eq!(message(&anyhow::anyhow!("b").context("a")), "a: b");
        let full = anyhow::Error::from(std::io::Error::from_raw_os_error(28));
        assert_eq!(
            message(&full.context("standard output")),
            "standard output: no space left on device"
        );
    }
}
