//! What a script has to know of a sweep's end, in a file: launchers lose exit codes, and the process
//! may be gone before it has one.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::failure::BadInput;
use crate::keys::named;

#[derive(Debug, Clone, Args)]
pub(super) struct EndingArgs {
    /// Leave a word here for the script that has started this: a line `out DIR` and, once it is known, a
    /// line `code N`.
    #[arg(long, value_name = "FILE", hide = true)]
    ending: Option<PathBuf>,
}

impl EndingArgs {
    /// Results go to this directory.
    pub(super) fn begin(&self, directory: &Path) -> Result<(), BadInput> {
        let Some(file) = &self.ending else { return Ok(()) };
        let line = [b"out ", directory.as_os_str().as_encoded_bytes(), b"\n"].concat();
        fs::write(file, line)
            .map_err(|error| BadInput(format!("--ending {}: {error}", named(file))))
    }

    /// This is the exit code. Where it cannot be written, the launcher's has to do.
    pub(super) fn end(&self, code: u8) {
        let open = |file| fs::OpenOptions::new().append(true).create(true).open(file);
        if let Some(Ok(mut file)) = self.ending.as_ref().map(open) {
            let _ = writeln!(file, "code {code}");
        }
    }
}
