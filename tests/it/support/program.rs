//! Programs made from a marker alone, without a source: passed, planned and written as setpoints.

use std::io::Cursor;

use cutc::back::{Context, SETPOINTS};
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::plan::{self, Planner};
use cutc::source::Source;

/// The setpoints of a marker.
pub(crate) fn setpoints(marker: &Marker, job: &Job) -> Vec<u8> {
    let source = Source::new("none", Vec::new()).expect("small");
    let context = Context { source: &source, job, marker };
    let mut out = Cursor::new(Vec::new());
    let mut planner = Planner::new(job);
    (SETPOINTS.head)(&context, &mut out).expect("memory takes it");
    for toolpath in super::toolpaths(marker, job) {
        let cuts = plan::solve(&toolpath, job).unwrap_or_else(|refused| panic!("{refused:?}"));
        (SETPOINTS.body)(&planner.join(&toolpath, cuts), &context, &mut out).expect("memory takes it");
    }
    (SETPOINTS.body)(&planner.finish(), &context, &mut out).expect("memory takes it");
    out.into_inner()
}
