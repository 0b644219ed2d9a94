//! Reaction to a signal that ends the program: it exits at once, or in a hot folder after the current file.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

use super::draft;

/// True if the first signal waits for the current file.
static FINISHES: AtomicBool = AtomicBool::new(false);
/// The latest signal received; 0 if there was none.
static ASKED: AtomicI32 = AtomicI32::new(0);
/// Offset that shells add to a signal number to form an exit code.
const BY_SIGNAL: i32 = 128;

/// Message after a signal.
pub const STOPPED: &str = "stopped: nothing is left half-written";

/// Handles a signal. `Some` holds the exit code with which the program must end at once; its unfinished files are already
/// removed. `None` means that it will soon end by itself. A second signal never waits.
pub fn stop(signal: i32) -> Option<u8> {
    let first = ASKED.swap(signal, Ordering::SeqCst) == 0;
    if first && FINISHES.load(Ordering::SeqCst) {
        return None;
    }
    draft::abandon();
    Some(code(signal))
}

/// Makes the first signal wait for the current file.
pub(super) fn finish_first() {
    FINISHES.store(true, Ordering::SeqCst);
}

/// The exit code after a signal; `None` if there was none.
pub(super) fn asked() -> Option<u8> {
    let signal = ASKED.load(Ordering::SeqCst);
    (signal != 0).then(|| code(signal))
}

fn code(signal: i32) -> u8 {
    u8::try_from(BY_SIGNAL + signal).unwrap_or(u8::MAX)
}
