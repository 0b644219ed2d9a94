//! Reading: a source becomes a marker, and passes edit that.

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

/// A file as read and passed: what is cut, in which order.
#[derive(Debug)]
pub struct Input {
    /// What it was read as.
    pub dialect: &'static Dialect,
    /// What it says, as far as the job wants it cut.
    pub marker: Marker,
    /// Whether the source was read without errors: then there is something to show, whatever passes say of it.
    pub is_whole: bool,
}

/// An input that programs are judged against.
#[derive(Debug)]
pub struct Judged {
    /// What is cut.
    pub input: Input,
    /// What is known of how it was read.
    pub reading: Reading,
}

/// What a file says in all, as it was read, and what passes kept of that.
#[derive(Debug)]
pub struct Reading {
    /// Before any pass.
    pub census: Census,
    /// Where the patterns of a set are cut, likewise; `None` of any other file.
    pub patterns: Option<CutPlaces>,
    /// What is cut of a drawing, likewise.
    pub drawing: Option<DrawingCuts>,
    /// Whether all of it is still cut behind them.
    pub kept: Finding,
    /// Whether that lies where the sheet of the profile has it; `None` where it lies as the file has it.
    pub laid: Option<Finding>,
}

/// Reads a source as `from`, or as what its content looks like, and runs the marker passes. `None` when nothing can be
/// read; faults of the data are diagnostics.
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

/// The same, with what it takes to judge a program.
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
    // What a sheet or the cloth moves cannot be compared with the file, but only with what was drawn.
    let is_moved = !job.profile.sheet.is_plain() || job.centre.is_some() || job.marks.is_some();
    let drawn = is_moved.then(|| (works.kept(&input.marker, &job.profile), Drawn::of(&input.marker)));
    run_passes(laying, &mut input.marker, source, job, diagnostics);
    let (kept, laid) = match drawn {
        Some((kept, drawn)) => (kept, Some(drawn.laid(&input.marker, job))),
        None => (works.kept(&input.marker, &job.profile), None),
    };
    Some(Judged { input, reading: Reading { census, patterns, drawing, kept, laid } })
}

/// Reads a source with what it takes to judge a program, where that is wanted, or else without.
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

/// The marker as the source says it, before any pass.
pub(super) fn read_alone(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let extension = Path::new(source.name()).extension().and_then(|e| e.to_str());
    let dialect = front::choose(source, from, extension, diagnostics)?;
    let marker = marker_of(dialect, source, job, diagnostics);
    // Only a drawing leaves it to others which of its lines are cut.
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

/// What a source says is cut, as a dialect reads it, or as it is recognised in what the dialect says is drawn.
pub fn marker_of(dialect: &Dialect, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> Marker {
    match dialect.read {
        Reader::Marker(read) | Reader::Patterns { cut: read, .. } => read(source, job, diagnostics),
        Reader::Drawing(read) => {
            let drawing = read(source, job, diagnostics);
            // What is not read to its end would only be recognised wrongly.
            if diagnostics.has_errors() { Marker::default() } else { recognise::marker(drawing, job, diagnostics) }
        }
    }
}

/// The passes that say what is drawn, and those that say how it is cut.
fn marker_passes() -> (&'static [MarkerPass], &'static [MarkerPass]) {
    MARKER_PASSES.split_at(MARKER_PASSES.len() - CUTTING_PASSES)
}

/// Makes the cuts of what was read.
pub fn make_cuts(input: &mut Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) {
    run_passes(marker_passes().1, &mut input.marker, source, job, diagnostics);
}

/// Runs marker passes. What they find is placed before a pass can take it away.
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
