//! How far a batch is, for whoever watches a terminal.

use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Times a second that the line is drawn.
const RATE_HZ: u8 = 4;

/// A line on standard error with what is done, what failed, the rate and the time left; nothing where that is no terminal.
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

    /// Counts a file.
    pub(super) fn step(&self, is_failed: bool) {
        if is_failed {
            let failed = self.failed.fetch_add(1, Ordering::Relaxed) + 1;
            self.bar.set_message(format!(", {failed} failed"));
        }
        self.bar.inc(1);
    }

    /// Takes the line away while something else is printed.
    pub(super) fn aside(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    /// Takes the line away for good.
    pub(super) fn end(self) {
        self.bar.finish_and_clear();
    }
}
