//! What passes leave is checked where that costs nobody anything.

use crate::ir::check;

/// In tests and debug builds a pass that breaks an invariant is found at once.
pub(super) fn assert_sound(pass: &str, faults: impl FnOnce() -> check::Faults) {
    if cfg!(debug_assertions) {
        let faults = faults();
        assert!(faults.is_empty(), "after pass {pass}: {faults:?}");
    }
}
