//! Programs made from a marker alone, without a source: passed, planned and written as setpoints.

use std::io::Cursor;

use cutc::analysis::cloth::Cloth;
use cutc::analysis::declare;
use cutc::back::{Context, SETPOINTS};
use cutc::ir::declaration::Declaration;
use cutc::ir::marker::Cut;
use cutc::ir::toolpath::Step;
use cutc::ir::{Marker, Toolpath};
use cutc::machine::Job;
use cutc::pipeline::Declared;
use cutc::plan::{self, Planner};
use cutc::source::Source;

/// The setpoints of a marker.
pub(crate) fn setpoints(marker: &Marker, job: &Job) -> Vec<u8> {
    let source = Source::new("none", Vec::new()).expect("small");
    let context = Context { source: &source, job, marker };
    let mut out = Cursor::new(Vec::new());
    let mut planner = Planner::new(job).over(marker.moved_on);
    (SETPOINTS.head)(&context, &mut out).expect("memory takes it");
    for toolpath in super::toolpaths(marker, job) {
        let cuts = plan::solve(&toolpath, job).unwrap_or_else(|refused| panic!("{refused:?}"));
        (SETPOINTS.body)(&planner.join(&toolpath, cuts), &context, &mut out).expect("memory takes it");
    }
    (SETPOINTS.body)(&planner.finish(), &context, &mut out).expect("memory takes it");
    out.into_inner()
}

/// What the program of a marker says that it does beside the drawing.
pub(crate) fn declared(marker: &Marker, job: &Job) -> Declared {
    Declared::new(declarations(marker, job))
}

/// The same, one by one.
pub(crate) fn declarations(marker: &Marker, job: &Job) -> Vec<Declaration> {
    let marker = super::with_cuts(marker, job);
    let cloth = Cloth::new(&marker, &job.profile);
    let is_cut =
        |toolpath: &Toolpath| toolpath.steps.iter().any(|step| matches!(step, Step::Run(_) | Step::PlungeCut(_)));
    let cuts = super::toolpaths(&marker, job).into_iter().filter(is_cut);
    let of_cut = |(toolpath, (cut, index)): (Toolpath, (&Cut, u32))| {
        let drawn = marker.list.points(cut.range);
        let knife = &job.profile.knife;
        declare::declarations(&toolpath, (index, &drawn), &|_| None, knife, &cloth)
    };
    cuts.zip(marker.cuts.iter().zip(0..)).flat_map(of_cut).collect()
}
