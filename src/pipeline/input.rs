//! Reading: a source becomes a marker, and passes edit it.

use std::path::Path;

use super::place;
use super::sound::assert_sound;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::{self, Dialect, Read as Reader};
use crate::ir::{Finding, Marker, check};
use crate::machine::patterns::Patterns;
use crate::machine::{Job, plot};
use crate::pass::marker::{CUTTING_PASSES, DRAWN_PASSES, MARKER_PASSES, MarkerPass};
use crate::recognise;
use crate::source::Source;
use crate::verify::{Census, CutPlaces, DrawingCuts, Drawn, Works};

/// A file as read, after passes: the cuts in their order.
#[derive(Debug)]
pub struct Input {
    /// Dialect that it was read as.
    pub dialect: &'static Dialect,
    /// Its content, as far as the job wants it cut.
    pub marker: Marker,
    /// True if the source was read without errors: then there is something to show, whatever passes report.
    pub is_whole: bool,
}

/// An input that programs are judged against.
#[derive(Debug)]
pub struct Judged {
    /// The input.
    pub input: Input,
    /// Data about how it was read.
    pub reading: Reading,
}

/// Content of a file as it was read, and the part of it that passes kept.
#[derive(Debug)]
pub struct Reading {
    /// Counts before any pass.
    pub census: Census,
    /// Places of the cuts of a set of patterns, before any pass; `None` for any other file.
    pub patterns: Option<CutPlaces>,
    /// Cuts of a drawing, before any pass; `None` for any other file.
    pub drawing: Option<DrawingCuts>,
    /// Finding that all of it is still cut after the passes.
    pub kept: Finding,
    /// Finding that it lies where the sheet of the profile has it; `None` if it lies where the file has it.
    pub laid: Option<Finding>,
}

/// Reads a source as `from`, or as the dialect of its content, and runs the marker passes. `None` when nothing can be read;
/// faults of the data are diagnostics.
pub fn read(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let mut input = read_alone(source, from, job, diagnostics)?;
    run_passes(marker_passes().0, &mut input.marker, source, job, diagnostics);
    Some(input)
}

/// Reads a source with the data for judging a program; see [`read`].
pub fn read_to_judge(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Judged> {
    let mut input = read_alone(source, from, job, diagnostics)?;
    let (census, works) = rayon::join(|| Census::of(&input.marker), || Works::of(&input.marker));
    let is_of_patterns = matches!(input.dialect.read, Reader::Patterns { .. });
    let patterns = is_of_patterns.then(|| CutPlaces::of(&input.marker));
    let is_drawing = matches!(input.dialect.read, Reader::Drawing(_));
    let drawing = is_drawing.then(|| DrawingCuts::of(&input.marker));
    let (finding, laying) = marker_passes().0.split_at(DRAWN_PASSES);
    run_passes(finding, &mut input.marker, source, job, diagnostics);
    // After a sheet or the cloth has moved the marker, it can be compared only with the marker before that, not with the file.
    let is_moved = !job.profile.sheet.is_plain() || job.centre.is_some() || job.marks.is_some();
    let drawn = is_moved.then(|| (works.kept(&input.marker, &job.profile), Drawn::of(&input.marker)));
    run_passes(laying, &mut input.marker, source, job, diagnostics);
    let (kept, laid) = match drawn {
        Some((kept, drawn)) => (kept, Some(drawn.laid(&input.marker, job))),
        None => (works.kept(&input.marker, &job.profile), None),
    };
    Some(Judged { input, reading: Reading { census, patterns, drawing, kept, laid } })
}

/// Reads a source, with the data for judging a program if `verify` is set.
pub fn read_for(
    (from, verify): (Option<&'static Dialect>, bool),
    source: &Source,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<(Input, Option<Reading>)> {
    if verify {
        read_to_judge(source, from, job, diagnostics).map(|Judged { input, reading }| (input, Some(reading)))
    } else {
        read(source, from, job, diagnostics).map(|input| (input, None))
    }
}

/// The marker of a source before any pass.
pub(super) fn read_alone(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let extension = Path::new(source.name()).extension().and_then(|e| e.to_str());
    let dialect = front::choose(source, from, extension, diagnostics)?;
    let marker = cuts_of(dialect, source, job, diagnostics);
    // Only a drawing leaves open which of its lines are cut.
    let is_plot = matches!(dialect.read, Reader::Drawing(_));
    if !is_plot && job.lines != plot::Lines::default() && !diagnostics.has_errors() {
        let message = "`--cut-pens`, `--inner` and `--cut-all` choose among the lines of a plot, and this is none: they change nothing";
        let finding = Diagnostic::new(&code::SOURCE_NO_PLOT, message);
        diagnostics.push(finding.hint("leave them out; `--pieces` and `--skip` choose pieces of any file"));
    }
    let is_of_patterns = matches!(dialect.read, Reader::Patterns { .. });
    if !is_of_patterns && job.patterns != Patterns::default() && !diagnostics.has_errors() {
        let message =
            "`--size` and `--quantity` choose among the pieces of a pattern DXF, and this is none: they change nothing";
        let finding = Diagnostic::new(&code::SOURCE_NO_PATTERNS, message);
        diagnostics.push(finding.hint("leave them out; `--pieces` and `--skip` choose pieces of any file"));
    }
    place::place(diagnostics, 0, &marker, source, job);
    Some(Input { dialect, marker, is_whole: !diagnostics.has_errors() })
}

/// Cuts of a source that is to be read as a dialect; none where it is plainly something else, which is an error.
pub fn marker_of(dialect: &Dialect, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> Marker {
    let chosen = front::choose(source, Some(dialect), None, diagnostics);
    chosen.map_or_else(Marker::default, |dialect| cuts_of(dialect, source, job, diagnostics))
}

/// Cuts of a source, as its dialect reads them, or as they are recognised in the drawing of the dialect.
fn cuts_of(dialect: &Dialect, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> Marker {
    match dialect.read {
        Reader::Marker(read) | Reader::Patterns { cut: read, .. } => read(source, job, diagnostics),
        Reader::Drawing(read) => {
            let drawing = read(source, job, diagnostics);
            // A drawing that was not read to its end would be recognised wrongly.
            if diagnostics.has_errors() { Marker::default() } else { recognise::marker(drawing, job, diagnostics) }
        }
    }
}

/// The passes that edit the drawing, and those that make its cuts.
fn marker_passes() -> (&'static [MarkerPass], &'static [MarkerPass]) {
    MARKER_PASSES.split_at(MARKER_PASSES.len() - CUTTING_PASSES)
}

/// Makes the cuts of an input.
pub fn make_cuts(input: &mut Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) {
    run_passes(marker_passes().1, &mut input.marker, source, job, diagnostics);
}

/// Runs marker passes. Findings get their places before a later pass can remove them.
pub(super) fn run_passes(
    passes: &[MarkerPass],
    marker: &mut Marker,
    source: &Source,
    job: &Job,
    diagnostics: &mut Diagnostics,
) {
    for pass in passes {
        if diagnostics.has_errors() {
            break;
        }
        let known = diagnostics.iter().len();
        (pass.run)(marker, job, diagnostics);
        place::place(diagnostics, known, marker, source, job);
        assert_sound(pass.name, || check::marker(marker));
    }
}
