//! Output of a compile: its programs and their destinations.

use std::io::{Read, Seek, Write};

use crate::back::Target;

/// Block size for reading a program back, bytes.
pub(super) const BLOCK: usize = 1 << 16;

/// Destination of a program, from which it is read back.
pub trait Medium: Read + Write + Seek {}

impl<T: Read + Write + Seek> Medium for T {}

/// Program that a compile writes.
pub struct Product<'a> {
    /// Name of its file; empty where it has none.
    pub name: String,
    /// Target.
    pub target: &'static Target,
    /// Destination.
    pub out: &'a mut dyn Medium,
    /// True if the compile fails and this is a picture of the refused job: that is worth keeping, a program is not.
    pub shows_refusal: bool,
}

impl<'a> Product<'a> {
    /// Program that is not written yet, without a file of its own.
    pub fn new(target: &'static Target, out: &'a mut dyn Medium) -> Self {
        Self { name: String::new(), target, out, shows_refusal: false }
    }

    /// The program with the name of its file.
    #[must_use]
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }
}
