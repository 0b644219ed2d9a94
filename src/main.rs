//! `cutc`: parses the arguments, runs, prints, exits. The only file that prints and exits.

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Parser as _;
use cutc::cli::{self, Arguments};

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(usage) => {
            // Help and version come this way too, with the code 0. Nothing is left to say where printing fails.
            let _ = usage.print();
            return ExitCode::from(if usage.use_stderr() { cli::USAGE } else { cli::DONE });
        }
    };
    let finished = cli::run(&arguments);
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
