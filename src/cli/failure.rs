//! From an error to one line on standard error and an exit code.

use std::io::{ErrorKind, Write};

use super::{BAD_INPUT, INTERNAL, SUCCESS};
use crate::execute::Launcher;
use crate::results::SweepError;

/// Something that the user can put right.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(super) struct BadInput(pub(super) String);

/// Tells an error, on rank 0 only, and turns it into the exit code.
pub(super) fn exit_code(result: anyhow::Result<u8>, launcher: Launcher) -> u8 {
    let error = match result {
        Ok(code) => return code,
        Err(error) => error,
    };
    if launcher.rank > 0 || is_broken_pipe(&error) {
        return SUCCESS;
    }
    let line = told(&error).replace('\n', " ");
    // Where nobody listens there is nobody to tell.
    let _ = writeln!(std::io::stderr(), "error: {line}");
    let refused = error.downcast_ref::<SweepError>().is_some_and(SweepError::is_refusal);
    if refused || error.is::<BadInput>() { BAD_INPUT } else { INTERNAL }
}

/// An error and its causes, without those that it names itself.
fn told(error: &anyhow::Error) -> String {
    let mut line = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if !line.ends_with(&cause) {
            let gap = if line.is_empty() { "" } else { ": " };
            line.push_str(gap);
            line.push_str(&cause);
        }
    }
    line
}

/// The reader has left, as `head` does: nothing is wrong.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let system = error.downcast_ref::<std::io::Error>();
    system.is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_their_codes() {
        let code = |error: anyhow::Error| exit_code(Err(error), Launcher::default());
        assert_eq!(code(BadInput("x".into()).into()), BAD_INPUT);
        assert_eq!(code(SweepError::Refused("x".into()).into()), BAD_INPUT);
        assert_eq!(code(SweepError::Executor("x".into()).into()), INTERNAL);
        assert_eq!(code(std::io::Error::from(ErrorKind::BrokenPipe).into()), SUCCESS);
        assert_eq!(code(anyhow::anyhow!("x")), INTERNAL);
    }

    #[test]
    fn a_cause_is_told_once() {
        let error = anyhow::anyhow!("disk full").context("cannot write a: disk full");
        assert_eq!(told(&error), "cannot write a: disk full");
        assert_eq!(told(&anyhow::anyhow!("b").context("a")), "a: b");
    }
}
