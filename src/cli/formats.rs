//! `--figures`: the formats that figures are written in.

use clap::ValueEnum;

use super::failure::BadInput;
use crate::report::Print;

/// SVG files are always written.
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

/// Those for print; refused where this build of the program cannot write them.
pub(super) fn for_print(formats: &[FigureFormat]) -> Result<Vec<Print>, BadInput> {
    let formats: Vec<_> = formats.iter().filter_map(|format| format.print()).collect();
    if let Some(format) = formats.first().filter(|_| !Print::BUILT) {
        let reason = "this build of seawall writes svg alone: build it with --features print";
        return Err(BadInput(format!("--figures {}: {reason}", format.ending())));
    }
    Ok(formats)
}
