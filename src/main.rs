//! `cutc`: runs the command line, prints, exits. The only file that prints and exits.

use std::io::{self, Write as _};
use std::process::ExitCode;

use cutc::cli;

/// A marker is millions of small things: this allocator takes large pages for them and is quick on both cores.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    #[cfg(unix)]
    signals::obey();
    let finished = cli::run(std::env::args_os(), &mut cli::Console { out: &mut io::stdout(), err: &mut io::stderr() });
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

#[cfg(unix)]
mod signals {
    //! Who is stopped leaves nothing half-made.

    use std::io::{self, Write as _};

    use cutc::cli;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    /// Ends the program as `cli` says when a signal asks for it. What its parent had it ignore, as `nohup` does, it still
    /// ignores.
    pub(super) fn obey() {
        let ignored = ignored();
        let heeded = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
        // Without them the next process has more to sweep: no reason not to begin.
        let Ok(mut signals) = Signals::new(heeded) else { return };
        std::thread::spawn(move || {
            for signal in signals.forever() {
                if let Some(code) = cli::stop(signal) {
                    let _ = writeln!(io::stderr(), "{}", cli::STOPPED);
                    std::process::exit(code.into());
                }
            }
        });
    }

    /// The signals that this process ignores, a bit each, where the system tells.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }
}
