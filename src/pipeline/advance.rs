//! Progress of a compile, for a status line.

use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of cuts that a compile has planned. Several threads update it.
#[derive(Debug, Default)]
pub struct Advance {
    cuts: AtomicUsize,
    planned: AtomicUsize,
}

impl Advance {
    /// Sets the number of cuts, once the marker is read.
    pub(super) fn read(&self, cuts: usize) {
        self.cuts.store(cuts, Ordering::Relaxed);
    }

    /// Adds planned cuts.
    pub(super) fn plan(&self, cuts: usize) {
        self.planned.fetch_add(cuts, Ordering::Relaxed);
    }
}

impl fmt::Display for Advance {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match [&self.planned, &self.cuts].map(|count| count.load(Ordering::Relaxed)) {
            [_, 0] => f.write_str("reading"),
            [planned, cuts] if planned < cuts => write!(f, "planned {planned} of {cuts} cuts"),
            [_, cuts] => write!(f, "planned {cuts} cuts, verifying"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_how_far_a_compile_is() {
        let advance = Advance::default();
        assert_eq!(advance.to_string(), "reading");
        advance.read(3);
        advance.plan(1);
        assert_eq!(advance.to_string(), "planned 1 of 3 cuts");
        advance.plan(2);
        assert_eq!(advance.to_string(), "planned 3 cuts, verifying");
    }
}
