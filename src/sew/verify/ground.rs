//! References for the verification of a program.

use super::decoders;
use super::records::{self, Decoded};
use crate::geom::Point;
use crate::ir::verdict::Sighting;
use crate::machine::{MachineProfile, Sewing};
use crate::sew::pattern::Pattern;
use crate::sew::stitches::Stitches;

/// References for the verification of a program.
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a> {
    /// The required stitches, entry by entry.
    pub stitches: &'a Stitches,
    /// The pattern from which they were laid; `None` if the file contained stitches.
    pub pattern: Option<&'a Pattern>,
    /// The pattern as the file draws it; `None` if the file contained stitches.
    pub drawn: Option<&'a Pattern>,
    /// The profile, which places the pattern in the field.
    pub profile: &'a MachineProfile,
    /// The machine.
    pub sewing: &'a Sewing,
    /// The source file, if it contains stitches.
    pub original: Original<'a>,
}

/// A source file with stitches, to be decoded independently.
#[derive(Debug, Clone, Copy)]
pub enum Original<'a> {
    /// A stitch file, and the decoder of its format.
    File(&'a [u8], fn(&[u8]) -> Decoded),
    /// A queue as rows of text.
    Queue(&'a [u8]),
    /// Another kind of source; its pattern is the reference.
    Other,
}

impl<'a> Original<'a> {
    /// The source file of a format.
    pub fn of(format: &str, bytes: &'a [u8]) -> Self {
        match format {
            "dst" => Self::File(bytes, records::dst),
            "exp" => Self::File(bytes, records::exp),
            "pes" | "pec" => Self::File(bytes, decoders::pec),
            "jef" => Self::File(bytes, decoders::jef),
            "vp3" => Self::File(bytes, decoders::vp3),
            "xxx" => Self::File(bytes, decoders::xxx),
            "u01" => Self::File(bytes, decoders::u01),
            "queue" => Self::Queue(bytes),
            _ => Self::Other,
        }
    }
}

/// The needle position at an entry, counted from 1; 0 for no entry.
pub(super) fn sighting(entry: u32, point: Point) -> Sighting {
    Sighting { line: Some(entry.into()), ..Sighting::missing(point, 0) }
}
