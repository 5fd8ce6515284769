//! The contract between the sweep and the physics that does its work.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Failure, FailureKind, Monitor, Stopped, TrunkResult};

/// Runs trunks and cases. The same configuration gives the same answer, from any checkpoint of its
/// trunk.
pub trait Runner: Sync {
    /// Runs a trunk to the last step before its branches differ.
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped>;

    /// Runs a case, from rest or from its trunk's checkpoint.
    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped>;

    /// The same with each piece of work in a process of its own; `None` if that is not possible.
    fn apart(&self) -> Option<Box<dyn Runner>> {
        None
    }
}

/// Does a piece of work. A panic in it is a failure of that case alone.
///
/// # Errors
/// The work's own, or an internal failure with the message and the place of a panic.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Stopped>) -> Result<T, Stopped> {
    catch_panics_quietly();
    let before = GUARD.replace(Some(String::new()));
    let result = catch_unwind(AssertUnwindSafe(work));
    let place = GUARD.replace(before).unwrap_or_default();
    result.unwrap_or_else(|payload| {
        let detail = format!("panicked{place}: {}", message(&*payload));
        Err(Stopped::Failed(Failure { kind: FailureKind::Internal, time_s: 0.0, detail }))
    })
}

thread_local! {
    /// `Some` while this thread is inside [`guarded`]: the place of a panic, ` at file:line`.
    static GUARD: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Panics inside [`guarded`] are recorded and not printed.
fn catch_panics_quietly() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let default = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            let guarded = GUARD.with_borrow_mut(|guard| {
                let Some(place) = guard else { return false };
                if let Some(location) = info.location() {
                    *place = format!(" at {}:{}", location.file(), location.line());
                }
                true
            });
            if !guarded {
                default(info);
            }
        }));
    });
}

fn message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_failure_with_its_message() {
        let result: Result<(), _> = guarded(|| panic!("lost {}", "it"));
        let told = result.unwrap_err().to_string();
        assert!(told.starts_with("internal at t = 0.0000 s: panicked at src/"), "{told}");
        assert!(told.ends_with(": lost it"), "{told}");
        assert_eq!(guarded(|| Ok(3)), Ok(3));
    }
}
