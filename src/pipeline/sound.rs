//! Checks of the invariants after passes, where they cost users nothing.

use crate::ir::check;

/// Asserts in tests and debug builds that a pass has kept the invariants.
pub(super) fn assert_sound(pass: &str, faults: impl FnOnce() -> check::Faults) {
    if cfg!(debug_assertions) {
        let faults = faults();
        assert!(faults.is_empty(), "after pass {pass}: {faults:?}");
    }
}
