//! The compiler, each stage named once, in order.

mod report;

pub use report::{Axes, Notches, Peak, Peaks, Program, Report};

use std::io;

use rayon::prelude::*;

use crate::back::{Context, Emit, Output, Target};
use crate::diagnostic::Diagnostics;
use crate::front::Dialect;
use crate::ir::motion::Kind;
use crate::ir::{Marker, Motion, Toolpath, check, text};
use crate::machine::Job;
use crate::pass::marker::MARKER_PASSES;
use crate::pass::toolpath::{TOOLPATH_PASSES, trace};
use crate::plan::{self, Planner};
use crate::source::Source;
use crate::units::MM_PER_M;

/// Toolpaths that are planned at a time: enough to keep all cores busy, few enough to keep memory small.
const WINDOW: usize = 128;

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
        if diagnostics.has_errors() {
            break;
        }
        assert_sound(pass.name, &check::marker(&marker));
    }
    Some(Input { dialect, marker })
}

/// Compiles a source to a target. `None` when the diagnostics hold errors: what `out` then holds must be thrown away.
pub fn compile(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    target: &Target,
    out: &mut dyn Output,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Report>> {
    let Some(Input { dialect, marker }) = read(source, from, job, diagnostics) else { return Ok(None) };
    let mut report = Report::of(&marker, dialect.name);
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let context = Context { job, marker: &marker };
    match &target.emit {
        Emit::Marker(emit) => emit(&context, out)?,
        Emit::Toolpath(parts) => {
            (parts.head)(&context, out)?;
            for toolpath in toolpaths(&marker, job, diagnostics) {
                (parts.body)(&toolpath, &context, out)?;
            }
            (parts.tail)(&context, &[], out)?;
        }
        Emit::Motion(parts) => {
            (parts.head)(&context, out)?;
            let mut tally = Tally::default();
            let mut planner = Planner::new(job);
            let steps = toolpaths(&marker, job, diagnostics);
            for window in steps.chunks(WINDOW) {
                let solved: Vec<_> = window.par_iter().map(|toolpath| plan::solve(toolpath, job)).collect();
                for (toolpath, cuts) in window.iter().zip(solved) {
                    match cuts {
                        Err(refused) => refused.into_iter().for_each(|d| diagnostics.push(d)),
                        Ok(cuts) => {
                            let motion = planner.join(toolpath, cuts);
                            tally.add(&motion);
                            (parts.body)(&motion, &context, out)?;
                        }
                    }
                }
                if diagnostics.has_errors() {
                    return Ok(None);
                }
            }
            let end = planner.finish();
            tally.add(&end);
            (parts.body)(&end, &context, out)?;
            (parts.tail)(&context, &[], out)?;
            if let Err(diagnostic) = planner.certify() {
                diagnostics.push(diagnostic);
            }
            report.program = tally.program(&planner, job);
        }
    }
    Ok((!diagnostics.has_errors()).then_some(report))
}

/// The form after a pass, as text; `None` when no pass has that name or nothing could be read.
pub fn dump(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    pass: &str,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let dialect = from?;
    let mut marker = (dialect.read)(source, job, diagnostics);
    for marker_pass in MARKER_PASSES {
        (marker_pass.run)(&mut marker, job, diagnostics);
        if marker_pass.name == pass {
            return Some(text::print_marker(&marker));
        }
    }
    let last = TOOLPATH_PASSES.iter().position(|p| p.name == pass)?;
    let mut text = String::new();
    let mut pose = plan::home(job);
    for mut toolpath in trace(&marker, job) {
        toolpath.entry = pose;
        for toolpath_pass in &TOOLPATH_PASSES[..=last] {
            (toolpath_pass.run)(&mut toolpath, job, diagnostics);
        }
        pose = toolpath.exit();
        text.push_str(&text::print_toolpath(&toolpath));
    }
    Some(text)
}

/// The toolpath of every drill, notch and contour after all passes, in cut order.
fn toolpaths(marker: &Marker, job: &Job, diagnostics: &mut Diagnostics) -> Vec<Toolpath> {
    let mut pose = plan::home(job);
    let pass = |mut toolpath: Toolpath| {
        toolpath.entry = pose;
        for pass in TOOLPATH_PASSES {
            (pass.run)(&mut toolpath, job, diagnostics);
            assert_sound(pass.name, &check::toolpath(&toolpath));
        }
        pose = toolpath.exit();
        toolpath
    };
    trace(marker, job).map(pass).collect()
}

/// In tests and debug builds a pass that breaks an invariant is found at once.
fn assert_sound(pass: &str, faults: &check::Faults) {
    debug_assert!(faults.is_empty(), "after pass {pass}: {faults:?}");
}

/// Counts what a program does.
#[derive(Default)]
struct Tally {
    travel: f64,
    plunges: usize,
    stabs: usize,
    lifts: usize,
    ticks: u64,
}

impl Tally {
    fn add(&mut self, motion: &Motion) {
        self.ticks += motion.ticks();
        let mut before = None;
        for phase in &motion.phases {
            match phase.kind {
                Kind::Travel | Kind::Turn => self.travel += phase.length,
                Kind::Plunge => self.plunges += 1,
                Kind::Lift => {
                    self.lifts += 1;
                    self.stabs += usize::from(before == Some(Kind::Plunge));
                }
                Kind::Cut | Kind::Rest | Kind::Drill(_) | Kind::Event(_) => {}
            }
            before = Some(phase.kind);
        }
    }

    fn program(&self, planner: &Planner, job: &Job) -> Program {
        Program {
            travel_m: Some(self.travel / MM_PER_M),
            runs: Some(self.plunges),
            stabs: Some(self.stabs),
            lifts: Some(self.lifts),
            // The last setpoint stands at the last tick, and rows count from tick 0.
            time_s: Some((self.ticks - 1) as f64 * job.profile.time.period()),
            axes: Some(Axes::new(&planner.peaks(), &job.profile.axes.limits())),
        }
    }
}
