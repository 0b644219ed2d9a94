//! Progress of a compile, shown on a terminal.

use std::sync::Arc;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::pipeline::Advance;

/// Interval between updates of the line. Shorter jobs show none.
const PERIOD: Duration = Duration::from_millis(700);

/// The line on standard error, hidden if that is not a terminal. Dropping it removes the line.
pub(super) struct Shown {
    advance: Arc<Advance>,
    bar: ProgressBar,
}

impl Shown {
    pub(super) fn new(quiet: bool) -> Self {
        let advance = Arc::new(Advance::default());
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let of = Arc::clone(&advance);
        let style = ProgressStyle::with_template("{spinner} {advance}, {elapsed}").expect("the template is sound");
        let style = style.with_key("advance", move |_: &ProgressState, out: &mut dyn std::fmt::Write| {
            // Ignore errors: a line that cannot be drawn must not stop the job.
            let _ = write!(out, "{of}");
        });
        let bar = ProgressBar::with_draw_target(None, target).with_style(style);
        bar.enable_steady_tick(PERIOD);
        Self { advance, bar }
    }

    /// The progress that the compile updates.
    pub(super) fn advance(&self) -> &Advance {
        &self.advance
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
