//! What a program is held against, and why it may not be read.

use crate::geom::Point;
use crate::ir::verdict::Sighting;
use crate::machine::Sewing;
use crate::sew::pattern::Pattern;
use crate::sew::stitches::Stitches;

/// What a program is held against.
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a> {
    /// What must be sewn, entry by entry.
    pub stitches: &'a Stitches,
    /// The lines that these were laid on; `None` where the file had the stitches.
    pub pattern: Option<&'a Pattern>,
    /// The machine.
    pub sewing: &'a Sewing,
    /// The file itself, where it has stitches.
    pub original: Original<'a>,
}

/// A file that stitches were read from, to be decoded a second time.
#[derive(Debug, Clone, Copy)]
pub enum Original<'a> {
    /// A DST file.
    Dst(&'a [u8]),
    /// An EXP file.
    Exp(&'a [u8]),
    /// A queue, rows of text.
    Queue(&'a [u8]),
    /// Another, of which the pattern tells.
    Other,
}

/// A place of the needle at an entry, from 1; 0 = at none.
pub(super) fn sighting(entry: u32, point: Point) -> Sighting {
    Sighting { line: Some(entry.into()), ..Sighting::missing(point, 0) }
}
