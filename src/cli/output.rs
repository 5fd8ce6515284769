//! What goes to standard output (results) and to standard error (notes).

use std::io::{BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::ValueEnum;
use serde::Serialize;

use super::Global;
use crate::execute::{Launcher, ProgressStyle};
use crate::keys::shown;

/// How results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Tables.
    Human,
    /// One JSON object.
    Json,
}

/// What the user wants to see, and how.
#[derive(Debug, Clone)]
pub(super) struct Output {
    quiet: bool,
    format: Format,
    pub(super) verbose: bool,
    under_launcher: bool,
}

impl Output {
    pub(super) fn new(global: &Global, launcher: Launcher) -> Output {
        Output {
            quiet: global.quiet,
            format: global.format,
            verbose: global.verbose,
            under_launcher: launcher.present,
        }
    }

    /// Prints a result: text for people, or the value as JSON.
    pub(super) fn result(&self, text: &str, value: &impl Serialize) -> anyhow::Result<()> {
        let mut out = std::io::stdout().lock();
        let written = match self.format {
            Format::Human if self.quiet => Ok(()),
            Format::Human => out.write_all(text.as_bytes()),
            Format::Json => pretty(&mut out, value),
        };
        written.and_then(|()| out.flush()).context("standard output")
    }

    /// Prints a result of several: as JSON it is one line.
    pub(super) fn line(&self, text: &str, value: &impl Serialize) -> anyhow::Result<()> {
        if !self.is_json() {
            return self.result(text, value);
        }
        let mut out = std::io::stdout().lock();
        let written = writeln!(out, "{}", serde_json::to_string(value)?);
        written.and_then(|()| out.flush()).context("standard output")
    }

    /// A result as JSON, made only if it is going to be printed. Making that of a large study takes more time than all
    /// else that is printed.
    pub(super) fn value(&self, make: impl FnOnce() -> serde_json::Value) -> serde_json::Value {
        if self.is_json() { make() } else { serde_json::Value::Null }
    }

    /// Whether a program reads the results.
    pub(super) fn is_json(&self) -> bool {
        self.format == Format::Json
    }

    /// Prints a note.
    pub(super) fn note(&self, text: impl std::fmt::Display) {
        if !self.quiet {
            // A note that nobody reads must not end a sweep.
            let _ = writeln!(std::io::stderr(), "{}", shown(&text.to_string()));
        }
    }

    /// Prints a failure that stands in a result, where results are left out.
    pub(super) fn failure(&self, text: impl std::fmt::Display) {
        if self.quiet && !self.is_json() {
            let _ = writeln!(std::io::stderr(), "error: {}", shown(&text.to_string()));
        }
    }

    pub(super) fn progress_style(&self) -> ProgressStyle {
        if self.quiet {
            ProgressStyle::Quiet
        } else if std::io::stderr().is_terminal() && !self.under_launcher {
            ProgressStyle::Bar
        } else {
            ProgressStyle::Lines
        }
    }
}

/// Prints a value piece by piece: that of a million cases has hundreds of megabytes.
fn pretty(out: impl Write, value: &impl Serialize) -> std::io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, out);
    serde_json::to_writer_pretty(&mut out, value)?;
    writeln!(out)?;
    out.flush()
}

/// Seconds for people: `4.2 s` where they are few, `42 s`, `3 min 20 s`, `3.5 days`.
pub(super) fn duration(seconds: f64) -> String {
    if seconds < 9.5 {
        return format!("{:.1} s", seconds.max(0.0));
    }
    crate::execute::duration(seconds)
}

pub(super) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if (-4.0..7.0).contains(&magnitude) {
        let digits = (3.0 - magnitude).max(0.0) as usize;
        return format!("{value:.digits$}");
    }
    format!("{value:.3e}")
}

/// A number with its error bar, rounded as the bar allows. Very small or large numbers have a power
/// of ten after both.
pub(super) fn with_bar(value: f64, bar: f64) -> String {
    if value == 0.0 || (1e-2..1e5).contains(&value.abs()) {
        return crate::report::with_error(value, bar);
    }
    let power = value.abs().log10().floor() as i32;
    let unit = 10_f64.powi(power);
    format!("{} e{power}", crate::report::with_error(value / unit, bar / unit))
}

/// A number with its error bar, if any, and a sign before it if it is a lower bound.
pub(super) fn with_marks(value: f64, bar: Option<f64>, bound: bool) -> String {
    let told = bar.map_or_else(|| short(value), |bar| with_bar(value, bar));
    if bound { format!("≥ {told}") } else { told }
}

/// The first items of a list, or all of them, and a line with the number of further ones.
pub(super) fn first<T>(items: &[T], most: usize, all: bool) -> (&[T], String) {
    let (shown, rest) = items.split_at(if all { items.len() } else { items.len().min(most) });
    let more = match rest.len() {
        0 => String::new(),
        left => format!("... and {left} more (-v shows all)\n"),
    };
    (shown, more)
}

/// A path for JSON, which allows only UTF-8.
pub(super) fn json_path(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Paths for JSON.
pub(super) fn json_paths(paths: &[PathBuf]) -> Vec<String> {
    paths.iter().map(|path| json_path(path)).collect()
}

/// A text in lines of at most so many characters, broken between words.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is always a line");
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= width {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let told = [3.06171, 0.0012345, 123456.0, 1e-9, -0.5, 0.0].map(short);
        assert_eq!(told, ["3.062", "0.001234", "123456", "1.000e-9", "-0.5000", "0"]);
        assert_eq!(
            [4.25, 59.0, 200.0, 7500.0, 3e5, 1e9].map(duration),
            ["4.2 s", "59 s", "3 min 20 s", "2 h 05 min", "3.5 days", "32 years"]
        );
    }

    #[test]
    fn bars_stand_beside_their_numbers() {
        let told = [(3.3328, 0.0241), (0.00011444, 0.0000012), (0.0, 0.1)];
        let told = told.map(|(value, bar)| with_bar(value, bar));
        assert_eq!(told, ["3.33 ± 0.02", "1.144 ± 0.012 e-4", "0.00 ± 0.10"]);
    }

    #[test]
    fn lines_are_broken_between_words() {
        assert_eq!(wrapped("one two  three", 7), ["one two", "three"]);
        assert_eq!(wrapped("", 7), [""]);
    }
}
