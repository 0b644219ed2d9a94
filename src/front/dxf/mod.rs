//! DXF: groups, entities and blocks of any DXF file, and plain drawings of CAD systems.
//!
//! Receives bytes: pairs of lines in sections, with entities on named layers and insertions that place blocks anywhere.
//! Promises a drawing in mm: strokes with their layers as pens, curves as chords, and texts. Layers are names without a
//! convention; [`pattern`](super::pattern) reads files with one and uses [`group`], [`syntax`], [`entity`] and [`arc`] of this
//! module. Never decides what is cut. Never draws hidden content: frozen layers, paper space, blocks without an insertion.
//!
//! [`lower`] follows the entities, [`insert`] places inserted blocks, [`conic`] and [`nurbs`] convert curves to chords, `fit`
//! lays a curve through points, [`mod@unit`] has the table of units, [`told`] reports the parts that are not drawn, [`stray`]
//! groups with codes that their entities do not have.

pub(in crate::front) mod arc;
mod conic;
pub(in crate::front) mod entity;
mod fit;
pub(in crate::front) mod group;
mod insert;
mod lower;
mod nurbs;
pub(in crate::front) mod page;
pub(in crate::front) mod stray;
pub(in crate::front) mod syntax;
mod told;
pub(in crate::front) mod unit;
mod words;

use super::{Dialect, Likeness, Read, foreign};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Drawing;
use crate::machine::Job;
use crate::source::Source;

pub(super) const DIALECT: Dialect = Dialect {
    name: "dxf",
    about: "plain DXF drawing: lines, arcs and curves on named layers, at their true size",
    extensions: &["dxf"],
    sniff,
    syntax: check_syntax,
    read: Read::Drawing(read),
    words: words::WORDS,
};

fn sniff(bytes: &[u8]) -> Likeness {
    if foreign::is_dxf(bytes) { Likeness::Sure } else { Likeness::No }
}

/// Checks that the bytes are groups whose values have the type of their codes.
pub(super) fn check_syntax(source: &Source, out: &mut Diagnostics) {
    for group in group::groups(source, out) {
        if !syntax::fits(group.code, source.slice(group.value)) {
            let message = format!("the value of a group {} must be a number", group.code);
            out.push(Diagnostic::new(&code::DXF_NUMBER, message).at(group.value));
        }
    }
}

fn read(source: &Source, job: &Job, out: &mut Diagnostics) -> Drawing {
    lower::lower(source, job, out)
}
