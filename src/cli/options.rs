//! Values of options that several commands share. Refusals say what is allowed.

use std::fmt::Display;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, ValueEnum};

use super::failure::BadInput;
use crate::keys::named;
use crate::report::Print;

/// A function that reads an option's value.
pub(super) trait Read<T>:
    Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
{
}

impl<T, F: Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static> Read<T> for F {}

/// A whole number within bounds.
pub(super) fn whole<T>(least: T, most: T) -> impl Read<T>
where
    T: FromStr + PartialOrd + Display + Copy + Send + Sync + 'static,
{
    within("a whole number", least, most)
}

/// A number of threads.
pub(super) fn threads() -> impl Read<u16> {
    whole(1, u16::MAX)
}

/// A time within bounds.
pub(super) fn seconds(least: f64, most: f64) -> impl Read<f64> {
    within("a number of seconds", least, most)
}

fn within<T>(what: &'static str, least: T, most: T) -> impl Read<T>
where
    T: FromStr + PartialOrd + Display + Copy + Send + Sync + 'static,
{
    move |text: &str| {
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| format!("must be {what} from {least} to {most}"))
    }
}

/// A time above 0.
pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| "must be a finite number of seconds above 0".to_owned())
}

/// The default.
pub(super) const EVERY_S: f64 = 300.0;

#[derive(Debug, Clone, Copy, Args)]
pub(super) struct KeepArgs {
    /// A long case keeps a checkpoint every so many seconds. After a kill it goes on from there, to the same
    /// bits. 0 keeps none.
    #[arg(long, value_name = "SECONDS", default_value_t = EVERY_S, value_parser = not_negative)]
    #[arg(allow_negative_numbers = true)]
    pub(super) checkpoint_every_s: f64,
}

fn not_negative(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
    value.ok_or_else(|| {
        "must be a finite number of seconds above 0, or 0 for no checkpoints".to_owned()
    })
}

/// The formats that figures are written in; SVG files are always written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum FigureFormat {
    Svg,
    Pdf,
    Png,
}

impl FigureFormat {
    fn print(self) -> Option<Print> {
        match self {
            FigureFormat::Svg => None,
            FigureFormat::Pdf => Some(Print::Pdf),
            FigureFormat::Png => Some(Print::Png),
        }
    }
}

/// The formats for print; refused where this build of the program cannot write them.
pub(super) fn for_print(formats: &[FigureFormat]) -> Result<Vec<Print>, BadInput> {
    let formats: Vec<_> = formats.iter().filter_map(|format| format.print()).collect();
    if let Some(format) = formats.first().filter(|_| !Print::BUILT) {
        let reason = "this build of seawall writes svg alone: build it with --features print";
        return Err(BadInput(format!("--figures {}: {reason}", format.ending())));
    }
    Ok(formats)
}

/// What a script has to know of a sweep's end, in a file: launchers lose exit codes, and the process
/// may be gone before it has one.
#[derive(Debug, Clone, Args)]
pub(super) struct EndingArgs {
    /// Leave a word here for the script that has started this: a line `out DIR` and, once it is known, a
    /// line `code N`.
    #[arg(long, value_name = "FILE", hide = true)]
    ending: Option<PathBuf>,
}

impl EndingArgs {
    /// Writes that results go to this directory.
    pub(super) fn begin(&self, directory: &Path) -> Result<(), BadInput> {
        let Some(file) = &self.ending else { return Ok(()) };
        let line = [b"out ", directory.as_os_str().as_encoded_bytes(), b"\n"].concat();
        fs::write(file, line)
            .map_err(|error| BadInput(format!("--ending {}: {error}", named(file))))
    }

    /// Writes the exit code. If this fails, the launcher's exit code has to do.
    pub(super) fn end(&self, code: u8) {
        let open = |file| fs::OpenOptions::new().append(true).create(true).open(file);
        if let Some(Ok(mut file)) = self.ending.as_ref().map(open) {
            let _ = writeln!(file, "code {code}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_within_their_bounds() {
        let read = whole(1_u16, 300);
        assert_eq!([read("1"), read("300")], [Ok(1), Ok(300)]);
        for bad in ["0", "301", "-1", "1.5", "", "a", "1e2", "99999999999999999999"] {
            assert_eq!(read(bad), Err("must be a whole number from 1 to 300".to_owned()), "{bad}");
        }
        let read = seconds(0.1, 1e6);
        assert_eq!([read("0.1"), read("1e6")], [Ok(0.1), Ok(1e6)]);
        for bad in ["0", "1e7", "-1", "inf", "nan", "a"] {
            let told = "must be a number of seconds from 0.1 to 1000000";
            assert_eq!(read(bad), Err(told.to_owned()), "{bad}");
        }
    }
}
