//! Progress of a batch, shown on a terminal.

use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Updates of the line per second.
const RATE_HZ: u8 = 4;

/// A line on standard error with the files done and failed, the rate and the time left. Hidden if standard error is not a
/// terminal.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
    failed: AtomicUsize,
}

impl Progress {
    pub(super) fn new(files: usize, quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(RATE_HZ) };
        let bar = ProgressBar::with_draw_target(Some(files as u64), target);
        let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} files{msg}, {per_sec}, {eta} left");
        let bar = bar.with_style(style.expect("the template is sound"));
        Self { bar, failed: AtomicUsize::new(0) }
    }

    /// Counts a finished file.
    pub(super) fn step(&self, is_failed: bool) {
        if is_failed {
            let failed = self.failed.fetch_add(1, Ordering::Relaxed) + 1;
            self.bar.set_message(format!(", {failed} failed"));
        }
        self.bar.inc(1);
    }

    /// Hides the line while `print` runs.
    pub(super) fn aside(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    /// Removes the line.
    pub(super) fn end(self) {
        self.bar.finish_and_clear();
    }
}
