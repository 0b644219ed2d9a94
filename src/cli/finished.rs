//! Result of a command: its output and exit code, or the reason why it failed.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, Read as _, Seek as _, Write};

use tempfile::SpooledTempFile;
use thiserror::Error;

/// Exit code: success.
pub const DONE: u8 = 0;
/// Exit code: the data has errors, or a program failed its verification.
pub const FAULTY: u8 = 1;
/// Exit code: the arguments are wrong, or a file cannot be read or written.
pub const USAGE: u8 = 2;

/// Output streams on which a long command reports while it runs.
pub struct Console<'a> {
    /// Standard output.
    pub out: &'a mut dyn Write,
    /// Standard error.
    pub err: &'a mut dyn Write,
}

/// The command line itself, for a command that ends with another one.
pub(super) type Run = fn(&[OsString], &mut Console) -> Finished;

/// Output of a command, and its exit code.
#[derive(Debug)]
pub struct Finished {
    /// Text or program for standard output.
    pub stdout: Stdout,
    /// Text for standard error.
    pub stderr: String,
    /// [`DONE`], [`FAULTY`] or [`USAGE`]; after a signal 128 plus its number, as in shells.
    pub code: u8,
}

/// Content for standard output.
#[derive(Debug)]
pub enum Stdout {
    /// Text; may be empty.
    Text(String),
    /// A whole program, to be copied from its start.
    Program(SpooledTempFile),
}

impl Stdout {
    /// Copies the content to a writer.
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
    /// A result that consists of text.
    pub(super) fn text(stdout: String, stderr: String, code: u8) -> Self {
        Self { stdout: Stdout::Text(stdout), stderr, code }
    }
}

/// A fault of arguments or files that ends the command, with a hint.
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

/// Appends a line to a text.
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
