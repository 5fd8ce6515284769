//! Every file of `tests/bad_inputs`, beside the message that it must give: `NAME.txt` has what follows
//! `error: NAME.toml: `. Messages that are to change are renewed with `RENEW_DOCS=1`, and read over.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::seawall;

/// As many as there are at least.
const FEWEST: usize = 80;
/// Longer ones are not read.
const LONGEST: usize = 600;

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_inputs");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension() == Some("toml".as_ref())).collect();
    files.sort();
    files
}

#[test]
fn every_bad_input_gives_its_message_and_writes_nothing() {
    let renew = std::env::var_os("RENEW_DOCS").is_some();
    let mut wrong = Vec::new();
    let files = files();
    for file in &files {
        let room = tempfile::tempdir().unwrap();
        let name = file.file_name().unwrap();
        fs::copy(file, room.path().join(name)).unwrap();
        let output = seawall().arg("check").arg(name).current_dir(room.path()).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        let start = format!("error: {}: ", name.display());
        let message = told.strip_prefix(&start).unwrap_or(&told);
        let beside = file.with_extension("txt");
        let sound = output.status.code() == Some(2)
            && message.len() <= LONGEST
            && message.lines().count() == 1
            && told.starts_with(&start)
            && !told.contains('\u{1b}')
            && fs::read_dir(room.path()).unwrap().count() == 1;
        if renew && sound {
            fs::write(&beside, message).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if !sound || message != expected {
            let code = output.status;
            wrong.push(format!(
                "{}: {code}\n  told     {told}  expected {expected}",
                name.display()
            ));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), files.len(), wrong.join("\n"));
    assert!(files.len() >= FEWEST, "{} files", files.len());
}
