//! The pattern-sewing machine: patterns to stitches, feed pulses and stitch files.
//!
//! A small pipeline, similar to that of the cutter; the modules are listed in its order:
//!
//! ```text
//! bytes -> read -> curve -> Pattern -> sheet -> lay -> Stitches -> fit -> speed -> Program -> write -> bytes -> verify
//! ```
//!
//! A *Pattern* is a list of lines with an element along each. *Stitches* are needle points and the events between them. A
//! *Program* adds a speed for each run. A stitch file contains stitches directly. Pulses are computed while they are written
//! (`train`), so that the length of a program does not matter. `verify` knows the file formats but is independent of the code
//! that writes them.

mod asked;
mod curve;
mod estimate;
mod fifo;
mod fit;
mod lay;
mod pace;
mod pattern;
mod program;
mod read;
mod sheet;
mod speed;
mod stitches;
mod tell;
mod train;
pub mod verify;
mod write;

pub use asked::Asked;
pub use estimate::{Estimate, estimate};
pub use fifo::{Fifo, simulate};
pub use pattern::{Element, Pattern, Seam, Shape};
pub use program::{Move, Program};
pub use read::{FORMATS, Format, Input};
pub use speed::{Limit, Run};
pub use stitches::{Op, Step, Stitches};
pub use train::{Drive, Train};
pub use write::{TARGETS, Target};

use std::io::{self, BufRead};

use self::fit::Fit;
use self::read::Reading;
use self::speed::Limits;
use self::verify::{Bytes, Ground, Original};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::verdict::Verdict;
use crate::machine::sewing::OnLong;
use crate::machine::{Job, Sewing};
use crate::source::Source;
use crate::units::number::fixed;

/// Reads a source and plans its sewing. `None` if nothing can be sewn; faults of the data are diagnostics.
pub fn plan(source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Option<Program> {
    let sewing = &job.profile.sewing;
    let Reading { format, record_word, mut input } = read::read(source, asked, job, out)?;
    if let Input::Pattern(pattern) = &mut input {
        curve::trace(pattern, job.profile.tolerance(0.0), sewing, out);
    }
    let drawn = if let Input::Pattern(pattern) = &input { Some(pattern.clone()) } else { None };
    sheet::place(&mut input, job, out);
    let (pattern, stitches, speeds) = match input {
        Input::Pattern(pattern) => {
            let stitches = laid(&pattern, sewing, out);
            (Some(pattern), stitches, Vec::new())
        }
        Input::Stitches(stitches, speeds) => (None, stitches, speeds),
    };
    if out.has_errors() {
        return None;
    }
    if stitches.count() == 0 {
        let hint = "a pattern needs a line of two points, a stitch file a stitch";
        out.push(Diagnostic::new(&code::SEW_NOTHING, "the file holds nothing to sew").hint(hint));
        return None;
    }
    let limits = Limits::new(sewing, pattern.as_ref());
    let stitches = Fit::new(&limits, record_word).fit(&stitches, out);
    sheet::hold_against_field(&stitches, &job.profile, out);
    let runs = speed::runs(&stitches, &limits);
    let program = Program { format, record_word, pattern, drawn, stitches, runs };
    if !out.has_errors() {
        tell::tell(&program, &speeds, sewing, out);
    }
    (!out.has_errors()).then_some(program)
}

/// The stitches of a pattern. If long stitches are to be split, seams are laid with a shorter pitch instead: parts of a stitch
/// would lie on its chord, beside a curved seam.
fn laid(pattern: &Pattern, sewing: &Sewing, out: &mut Diagnostics) -> Stitches {
    let stitches = lay::lay(pattern, sewing);
    let pitch = fit::longest(sewing);
    let closer_seams = Pattern { seams: pattern.seams.iter().map(|seam| closer_seam(seam, pitch)).collect() };
    let closer = Sewing {
        pitch_mm: sewing.pitch_mm.min(pitch),
        zigzag_pitch_mm: sewing.zigzag_pitch_mm.min(pitch),
        tack_pitch_mm: sewing.tack_pitch_mm.min(pitch),
        ..sewing.clone()
    };
    let is_same = closer == *sewing && closer_seams == *pattern;
    if sewing.on_long != OnLong::Split
        || is_same
        || !Fit::new(&Limits::new(sewing, Some(pattern)), "").splits(&stitches)
    {
        return stitches;
    }
    let closer = lay::lay(&closer_seams, &closer);
    let added = closer.count().saturating_sub(stitches.count());
    if added > 0 {
        let pitch = fixed(pitch, 2);
        let message = format!(
            "{added} penetrations are added: seams are laid at {pitch} mm at the most, as longer stitches do not fit at full speed"
        );
        let hint = "needle holes weaken leather and coated cloth; `--on-long slow` keeps the pitch";
        out.push(Diagnostic::new(&code::SEW_SPLIT, message).hint(hint));
    }
    closer
}

/// A seam with a pitch of its own that is no longer than another, mm.
fn closer_seam(seam: &Seam, pitch: f64) -> Seam {
    Seam { pitch: seam.pitch.map(|own| own.min(pitch)), ..seam.clone() }
}

/// A program with its origin.
#[derive(Debug, Clone, Copy)]
pub struct Made<'a> {
    /// The program.
    pub program: &'a Program,
    /// The file it was made from.
    pub source: &'a Source,
    /// The profile and choices of the machine.
    pub job: &'a Job,
}

impl Made<'_> {
    /// Verifies bytes that were written for the program.
    pub fn judge(&self, bytes: Bytes, input: &mut dyn BufRead) -> io::Result<Verdict> {
        let Self { program, source, job } = *self;
        let original = Original::of(program.format, source.bytes());
        let ground = Ground {
            stitches: &program.stitches,
            pattern: program.pattern.as_ref(),
            drawn: program.drawn.as_ref(),
            profile: &job.profile,
            sewing: &job.profile.sewing,
            original,
        };
        verify::judge(input, bytes, &ground)
    }
}
