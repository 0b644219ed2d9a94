//! The compiler, each stage named once, in order.

mod report;

pub use report::{Axes, Notches, Peak, Peaks, Program, Report};

use crate::diagnostic::Diagnostics;
use crate::front::Dialect;
use crate::ir::Marker;
use crate::machine::Job;
use crate::pass::marker::MARKER_PASSES;
use crate::source::Source;

/// A file as read and passed: what is cut, in which order.
#[derive(Debug)]
pub struct Input {
    /// What it was read as.
    pub dialect: &'static Dialect,
    /// What it says.
    pub marker: Marker,
}

/// Reads a source as `from`, or as what its content looks like, and runs the marker passes. `None` when nothing can be
/// read; faults of the data are diagnostics.
pub fn read(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let dialect = from?;
    let mut marker = (dialect.read)(source, job, diagnostics);
    for pass in MARKER_PASSES {
        (pass.run)(&mut marker, job, diagnostics);
    }
    Some(Input { dialect, marker })
}
