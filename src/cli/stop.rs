//! What is done about a signal that ends the program: at once, or, in a hot folder, behind the file in hand.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

use super::draft;

/// Set by who would rather finish the file in hand.
static FINISHES: AtomicBool = AtomicBool::new(false);
/// The signal that asked for the end; 0 = none yet.
static ASKED: AtomicI32 = AtomicI32::new(0);
/// What shells add to the number of the signal that ended a program.
const BY_SIGNAL: i32 = 128;

/// What is said of that.
pub const STOPPED: &str = "stopped: nothing is left half-written";

/// Takes note of a signal. With an exit code the program must end at once, and all that it had in the making is gone;
/// without one it ends by itself, soon. A second signal never waits.
pub fn stop(signal: i32) -> Option<u8> {
    let first = ASKED.swap(signal, Ordering::SeqCst) == 0;
    if first && FINISHES.load(Ordering::SeqCst) {
        return None;
    }
    draft::abandon();
    Some(code(signal))
}

/// From now on the first signal waits for the file in hand.
pub(super) fn finish_first() {
    FINISHES.store(true, Ordering::SeqCst);
}

/// The exit code of who was asked to end.
pub(super) fn asked() -> Option<u8> {
    let signal = ASKED.load(Ordering::SeqCst);
    (signal != 0).then(|| code(signal))
}

fn code(signal: i32) -> u8 {
    u8::try_from(BY_SIGNAL + signal).unwrap_or(u8::MAX)
}
