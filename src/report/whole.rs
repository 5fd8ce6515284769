//! Files that readers find complete or not at all.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use super::error::ReportError;
use crate::keys::partial;

/// Fills a file under another name, then gives it its own. A failure leaves nothing behind. `fill`
/// gets a function that wraps an error of the system.
pub fn write<T>(
    path: &Path,
    fill: impl FnOnce(&File, &dyn Fn(io::Error) -> ReportError) -> Result<T, ReportError>,
) -> Result<T, ReportError> {
    let wrong = |error| ReportError::Write { path: path.to_owned(), error };
    let temporary = partial(path);
    let file = File::create(&temporary).map_err(wrong)?;
    let renamed = |filled| fs::rename(&temporary, path).map_err(wrong).map(|()| filled);
    fill(&file, &wrong).and_then(renamed).inspect_err(|_| {
        let _ = fs::remove_file(&temporary);
    })
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn a_failure_leaves_what_was_there() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a.svg");
        let put = |text: &str| {
            write(&path, |mut file, wrong| file.write_all(text.as_bytes()).map_err(wrong)).unwrap();
        };
        put("one");
        put("two");
        let full = || io::Error::other("the disk is full, says a test");
        let failed = write(&path, |mut file, wrong| {
            file.write_all(b"thr").map_err(wrong)?;
            Err::<(), _>(wrong(full()))
        });
        assert!(matches!(failed, Err(ReportError::Write { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }
}
