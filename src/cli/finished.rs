//! What a command leaves: what is to be printed and its exit code, or why it could not be done.

use std::fmt::Write as _;
use std::io::{self, Read as _, Seek as _, Write};

use tempfile::SpooledTempFile;
use thiserror::Error;

/// Exit code: done.
pub const DONE: u8 = 0;
/// Exit code: the data has errors, or a program is not what it should be.
pub const FAULTY: u8 = 1;
/// Exit code: the arguments are wrong, or a file cannot be read or written.
pub const USAGE: u8 = 2;

/// Where a command that takes long says what it has found so far.
pub struct Console<'a> {
    /// Standard output.
    pub out: &'a mut dyn Write,
    /// Standard error.
    pub err: &'a mut dyn Write,
}

/// What a command leaves to print, and its exit code.
#[derive(Debug)]
pub struct Finished {
    /// For standard output.
    pub stdout: Stdout,
    /// For standard error.
    pub stderr: String,
    /// [`DONE`], [`FAULTY`] or [`USAGE`]; of who was asked to end by a signal what shells make of that.
    pub code: u8,
}

/// What goes to standard output.
#[derive(Debug)]
pub enum Stdout {
    /// Text; may be empty.
    Text(String),
    /// A whole program, from its start.
    Program(SpooledTempFile),
}

impl Stdout {
    /// Copies it to a writer.
    pub fn copy_to(self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Text(text) => out.write_all(text.as_bytes())?,
            Self::Program(mut spool) => {
                spool.rewind()?;
                let mut block = vec![0; 1 << 16];
                loop {
                    match spool.read(&mut block)? {
                        0 => break,
                        n => out.write_all(&block[..n])?,
                    }
                }
            }
        }
        out.flush()
    }
}

impl Finished {
    /// Text alone.
    pub(super) fn text(stdout: String, stderr: String, code: u8) -> Self {
        Self { stdout: Stdout::Text(stdout), stderr, code }
    }
}

/// Something about arguments or files that ends the command: what, and what to do about it.
#[derive(Debug, Error)]
#[error("{message}\n  = hint: {hint}")]
struct Failure {
    message: String,
    hint: String,
}

/// An error of arguments or files.
pub(super) fn failure(message: impl Into<String>, hint: impl Into<String>) -> anyhow::Error {
    Failure { message: message.into(), hint: hint.into() }.into()
}

/// Adds a line to what is said.
pub(super) fn say(said: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing into a `String` cannot fail.
    let _ = writeln!(said, "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_copied_from_its_start() {
        let mut spool = SpooledTempFile::new(4);
        spool.write_all(b"t_s,x_mm\n0,1\n").expect("a spool takes bytes");
        let mut out = Vec::new();
        Stdout::Program(spool).copy_to(&mut out).expect("a vector takes bytes");
        assert_eq!(out, b"t_s,x_mm\n0,1\n");
    }
}
