//! The compiler, each stage named once, in order.

mod report;

pub use report::{Axes, Notches, Peak, Peaks, Program, Report};

use std::io;

use crate::back::{Output, Target};
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

/// Compiles a source to the bytes of a target. `None`, and `out` is to be thrown away, when the diagnostics hold errors.
pub fn compile(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    _target: &Target,
    _out: &mut dyn Output,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Report>> {
    let input = read(source, from, job, diagnostics);
    Ok(input.map(|input| Report::of(&input.marker, input.dialect.name)).filter(|_| !diagnostics.has_errors()))
}

/// The form that a pass leaves, as text.
pub fn dump(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    _pass: &str,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    read(source, from, job, diagnostics).map(|input| format!("{:?}\n", input.marker))
}
