//! Pattern DXF: sets of patterns as garment CAD exchanges them (AAMA DXF, ASTM D6673).
//!
//! Receives bytes: pairs of lines in sections, one block per piece and size, with layers by convention, and drawings of other
//! CAD systems that follow it. Promises a marker in mm of the pieces of one size or several: half pieces unfolded, outlines
//! closed, notches in forms that the passes know, laid in a row unless the file places them; and an account of every line that
//! is not cut. Never cuts lines that no layer marks as cut, and never guesses the size.
//!
//! [`likeness`] distinguishes such files from plain drawings. [`dxf`] makes groups, sections and blocks, [`shape`] lines and
//! points in mm in the [`mod@unit`]. [`text`] reads facts from texts in their [`letters`](mod@letters), by their [`key`]s and
//! with [`markup`], and [`choice`] selects the blocks to cut. [`unknown`] names keys that may be quantities, [`namesakes`]
//! pieces that may be sizes. [`piece`] makes a piece of a block: [`outline`]s from [`chain`]s and each [`spur`], each traversed
//! once ([`retrace`]), unfolded at their [`fold`], along their [`curves`], with each [`mod@notch`] by the table of [`layer`]s
//! that is not [`drawn`] already. [`set`] does all of this for a file, [`placing`] and [`lay`] position the pieces on the
//! cloth, and [`over`] checks that none overlaps another. [`mod@marker`] makes the marker; [`tally`] and [`told`] report
//! deviations from the file.

mod chain;
mod choice;
mod curves;
mod doubts;
mod drawn;
mod fold;
mod key;
mod lay;
mod layer;
mod letters;
mod likeness;
mod marker;
mod markup;
mod namesakes;
mod notch;
mod outline;
mod over;
mod piece;
mod placing;
mod quantity;
mod retrace;
mod set;
mod shape;
mod spur;
mod tally;
mod text;
mod told;
mod tree;
mod unit;
mod unknown;
mod words;

use super::{Dialect, Read, dxf};
use crate::diagnostic::Diagnostics;
use crate::ir::{Drawing, Marker};
use crate::machine::Job;
use crate::source::Source;

pub(super) const DIALECT: Dialect = Dialect {
    name: "pattern",
    about: "pattern DXF of garment CAD (AAMA, ASTM D6673): a block a piece, outlines on layer 1",
    extensions: &["dxf"],
    sniff: likeness::sniff,
    syntax: dxf::check_syntax,
    read: Read::Patterns { cut: read, drawn: read_lines, seams: layer::SEAMS },
    words: words::WORDS,
};

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Marker {
    let set = set::read(source, job, out);
    set.see_cuts(out);
    if out.has_errors() { Marker::default() } else { marker::marker(&set) }
}

fn read_lines(source: &Source, job: &Job, out: &mut Diagnostics) -> Drawing {
    let set = set::read(source, job, out);
    if out.has_errors() { Drawing::default() } else { marker::drawing(&set) }
}
