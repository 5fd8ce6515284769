//! Files that readers find complete or not at all: one gets its name once it is complete.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// The end of the name of a file on its way. What a killed process leaves under one is removed by
/// who writes next.
pub(crate) const PARTIAL: &str = ".partial";

/// Where a file is written before it gets its name.
fn partial(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(PARTIAL);
    path.with_file_name(name)
}

/// Fills a file under another name, then gives it its own. A failure leaves what was there.
///
/// # Errors
/// Those of `fill`, and those of the system, which `wrong` wraps.
pub(crate) fn write_whole<T, E>(
    path: &Path,
    wrong: impl Fn(io::Error) -> E,
    fill: impl FnOnce(&File) -> Result<T, E>,
) -> Result<T, E> {
    let temporary = partial(path);
    let file = super::create(&temporary).map_err(&wrong)?;
    let renamed = |filled| super::rename(&temporary, path).map_err(&wrong).map(|()| filled);
    fill(&file).and_then(renamed).inspect_err(|_| {
        // If this fails too, who writes next removes it.
        let _ = super::remove_file(&temporary);
    })
}

/// Writes such a file in one go.
pub(crate) fn put(path: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    write_whole(path, |error| error, |file| super::write(file, content.as_ref()))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Write;

    use super::*;

    #[test]
    fn a_failure_leaves_what_was_there() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a.svg");
        let put = |text: &str, then: io::Result<()>| {
            write_whole(&path, |error| error, |mut file| file.write_all(text.as_bytes()).and(then))
        };
        put("one", Ok(())).unwrap();
        put("two", Ok(())).unwrap();
        let full = put("thr", Err(io::Error::other("the disk is full, says a test")));
        assert!(full.unwrap_err().to_string().contains("full"));
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }
}
