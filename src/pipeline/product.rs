//! What a compile writes, and where.

use std::io::{Read, Seek, Write};

use crate::back::Target;

/// Bytes of a program that are read back at a time.
pub(super) const BLOCK: usize = 1 << 16;

/// Where a program is written, and read back from.
pub trait Medium: Read + Write + Seek {}

impl<T: Read + Write + Seek> Medium for T {}

/// One of the programs that a compile writes.
pub struct Product<'a> {
    /// What is written.
    pub target: &'static Target,
    /// Where it goes.
    pub out: &'a mut dyn Medium,
    /// Set where the compile fails and this is a picture of what was refused: it is worth keeping, a program is not.
    pub shows_refusal: bool,
}

impl<'a> Product<'a> {
    /// A program that is not written yet.
    pub fn new(target: &'static Target, out: &'a mut dyn Medium) -> Self {
        Self { target, out, shows_refusal: false }
    }
}
