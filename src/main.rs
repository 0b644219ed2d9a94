//! `cutc`: runs the command line, prints, exits. The only file that prints and exits.

use std::io::{self, Write as _};
use std::process::ExitCode;

use cutc::cli;

/// A marker is millions of small things: this allocator takes large pages for them and is quick on both cores.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let finished = cli::run(std::env::args_os());
    // Who closed standard error does not want to read it.
    let _ = io::stderr().lock().write_all(finished.stderr.as_bytes());
    match finished.stdout.copy_to(&mut io::stdout().lock()) {
        Ok(()) => ExitCode::from(finished.code),
        // The reader has seen enough, as `head` does: no error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::from(finished.code),
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: cannot write to standard output: {error}");
            ExitCode::from(cli::USAGE)
        }
    }
}
