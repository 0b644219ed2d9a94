//! HPGL plots: HP-GL and HP-GL/2 as garment CAD writes them (a subset is ASTM D6959).
//!
//! Receives bytes: instructions of two letters with numbers, in all the spellings that plotters tolerate, compact encodings,
//! curves, scales. Promises a marker in mm like that of a cut file: parts with their cut-outs, slits as notches, equal
//! places equal to the bit, texts never cut; and an account of every line, what it was taken for. Curves are chords within
//! a quarter of the tolerance. Never closes an outline that the file leaves open, but for what rounding has parted.
//!
//! [`reader`] makes statements of bytes with [`syntax`], [`escape`], [`label`] and [`encoded`]; [`instruction`] is the table
//! of what they mean; [`mod@lower`] follows them with the [`plotter`], its [`scale`] and [`curve`], into a [`drawing`].
//! [`classify`] then decides what is cut: [`chain`] joins strokes as [`joint`] pairs their ends, [`shape`] measures them,
//! [`nest`], [`notch`], [`spike`] and [`text`] recognise, [`beside`] finds what may be missed, [`piece`] makes the marker
//! with [`vee`] to lead outlines into V notches. [`mod@unit`] doubts the size; [`tally`] counts what was not obeyed;
//! [`nothing`] says why nothing is cut.

mod beside;
mod chain;
mod classify;
mod curve;
mod drawing;
mod encoded;
mod escape;
mod instruction;
mod joint;
mod label;
mod lower;
mod nest;
mod notch;
mod nothing;
mod piece;
mod plotter;
mod reader;
mod scale;
mod shape;
mod spike;
mod syntax;
mod tally;
mod text;
mod unit;
mod vee;

use self::instruction::Instruction;
use self::lower::{Measure, lower};
use self::reader::{Flaw, Reader, Statement};
use super::{Dialect, Likeness, foreign};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::ir::Marker;
use crate::machine::Job;
use crate::source::Source;

pub(super) const DIALECT: Dialect = Dialect {
    name: "hpgl",
    about: "HPGL plot of garment CAD: `PU`, `PD` and coordinates; closed lines are cut",
    extensions: &["plt", "hpgl", "hpg", "hgl"],
    sniff,
    syntax: check_syntax,
    read,
};

/// Statements that are looked at to recognise a file, and bytes of it.
const SNIFFED_STATEMENTS: usize = 64;
const SNIFFED_BYTES: usize = 4096;
/// Instructions that must be known for a file to be recognised without doubt.
const SURE_INSTRUCTIONS: usize = 3;
/// Farthest that the chords of a curve may lie off it, as a part of the tolerance.
const SAGITTA: f64 = 0.25;

fn sniff(bytes: &[u8]) -> Likeness {
    let mut reader = Reader::new(&bytes[..bytes.len().min(SNIFFED_BYTES)]);
    let (mut known, mut all, mut moves) = (0, 0, false);
    while all < SNIFFED_STATEMENTS
        && let Some((statement, _)) = reader.next()
    {
        all += 1;
        let Statement::Instruction(instruction, _) = statement else { continue };
        moves |= matches!(
            instruction,
            Instruction::Down | Instruction::Up | Instruction::Absolute | Instruction::Relative | Instruction::Encoded
        );
        reader.pass_over(instruction.tail());
        known += usize::from(instruction != Instruction::Unknown);
    }
    match known {
        SURE_INSTRUCTIONS.. if moves && 2 * known > all => Likeness::Sure,
        1.. if moves && 2 * known >= all => Likeness::Maybe,
        _ => Likeness::No,
    }
}

/// Whether the bytes are statements.
fn check_syntax(source: &Source, out: &mut Diagnostics) {
    let mut reader = Reader::new(source.bytes());
    while let Some((statement, span)) = reader.next() {
        let finding = match statement {
            Statement::Instruction(Instruction::Unknown, _) => {
                Diagnostic::new(&code::HPGL_UNKNOWN, "this instruction is not known").at(span)
            }
            Statement::Instruction(instruction, _) => match reader.pass_over(instruction.tail()) {
                None => continue,
                Some(Flaw::Overflow(at)) => {
                    Diagnostic::new(&code::HPGL_OVERFLOW, "a number is beyond any table").at(at)
                }
                Some(Flaw::Damaged(at)) => {
                    Diagnostic::new(&code::HPGL_PE_DAMAGED, "an encoded polyline is damaged").at(at)
                }
                Some(Flaw::Open(at)) => {
                    Diagnostic::new(&code::HPGL_PE_OPEN, "an encoded polyline has no semicolon").at(at)
                }
            },
            Statement::Junk => Diagnostic::new(&code::HPGL_JUNK, "what stands here is no instruction").at(span),
            Statement::Reset => continue,
        };
        out.push(finding);
    }
}

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Marker {
    if foreign::refuse_unread(source, out) {
        return Marker::default();
    }
    let unit = &job.profile.hpgl.unit;
    let sagitta = job.profile.tolerance(unit.mm()) * SAGITTA;
    let plot = lower(source, Measure { unit: unit.mm(), sagitta }, out);
    let mut extent = Extent::EMPTY;
    for stroke in &plot.drawing.strokes {
        extent.add(stroke.extent.min);
        extent.add(stroke.extent.max);
    }
    let pens = nothing::pens(&plot.drawing);
    unit::check_plausible(unit::Sized { unit, extent: &extent, source, labels: &plot.labels }, out);
    let marker = classify::classify(plot.drawing, plot.labels, job, out);
    if marker.pieces.is_empty() && !out.has_errors() {
        out.push(nothing::finding(&pens, job));
    }
    marker
}
