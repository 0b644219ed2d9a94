//! HPGL plots: HP-GL and HP-GL/2 as written by garment CAD (a subset is ASTM D6959).
//!
//! Receives bytes: two-letter instructions with numbers, in all the spellings that plotters tolerate, compact encodings,
//! curves, scales. Promises a drawing in mm: strokes with their pen numbers, texts, and the kind of end of the file. Equal
//! points have equal bits; curves are chords within a quarter of the tolerance. Never decides what is cut.
//!
//! [`reader`] parses statements with [`syntax`], [`escape`], [`label`] and [`encoded`]. [`instruction`] is the table of their
//! meanings. [`decimal_comma`] detects files with decimal commas. [`mod@lower`] executes the statements with the [`plotter`],
//! its [`scale`] and [`curve`]. [`mod@unit`] checks the size, [`page`] finds overlapping pages, [`tally`] counts ignored
//! statements. [`lost`] handles lost characters, [`parameters`] finds changed mnemonics, [`ending`] files that are cut
//! short.

mod count;
mod curve;
mod decimal_comma;
mod encoded;
mod ending;
mod escape;
mod instruction;
mod label;
mod lost;
mod lower;
mod page;
mod parameters;
mod plotter;
mod reader;
mod scale;
mod syntax;
mod tally;
mod unit;
mod words;

use self::instruction::Instruction;
use self::lower::{Measure, lower};
use self::reader::{Flaw, Reader, Statement};
use super::{Dialect, Likeness, Read};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Drawing;
use crate::machine::Job;
use crate::source::Source;

pub(super) const DIALECT: Dialect = Dialect {
    name: "hpgl",
    about: "HPGL plot of garment CAD: `PU`, `PD` and coordinates; outermost closed lines are cut",
    extensions: &["plt", "hpgl", "hpg", "hgl"],
    sniff,
    syntax: check_syntax,
    read: Read::Drawing(read),
    words: words::WORDS,
};

/// Number of statements and of bytes examined to recognise a file.
const SNIFFED_STATEMENTS: usize = 64;
const SNIFFED_BYTES: usize = 4096;
/// Number of known instructions from which a file is recognised for certain.
const SURE_INSTRUCTIONS: usize = 3;
/// Maximum deviation of chords from their curve, as a fraction of the tolerance.
const SAGITTA: f64 = 0.25;

fn sniff(bytes: &[u8]) -> Likeness {
    // A raster picture may precede the lines; its data are counted and skipped.
    let most = if bytes.starts_with(b"\x1b") { bytes.len() } else { SNIFFED_BYTES };
    let mut reader = Reader::new(&bytes[..bytes.len().min(most)]);
    let (mut known, mut all, mut moves) = (0, 0, false);
    while all < SNIFFED_STATEMENTS
        && let Some((statement, _)) = reader.next()
    {
        all += 1;
        let Statement::Instruction(instruction, _) = statement else { continue };
        moves |= matches!(
            instruction,
            Instruction::Down
                | Instruction::Up
                | Instruction::Absolute
                | Instruction::Relative
                | Instruction::Encoded
                | Instruction::Label
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

/// Checks that the bytes are statements.
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

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Drawing {
    let unit = &job.profile.hpgl.unit;
    if decimal_comma::has(source.bytes(), unit.mm()) {
        let message = "the numbers of this plot have commas for decimal points";
        let finding = Diagnostic::new(&code::HPGL_DECIMAL_COMMA, message);
        out.push(
            finding.hint("let the program write points: set the language of the computer to English for the export"),
        );
        return Drawing::default();
    }
    let sagitta = job.profile.tolerance(unit.mm()) * SAGITTA;
    let drawing = lower(source, Measure { unit: unit.mm(), sagitta }, out);
    unit::check_plausible(unit::Sized { unit, extent: &drawing.extent(), source, labels: &drawing.texts }, out);
    drawing
}
