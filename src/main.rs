//! `cutc`: runs the command line, prints, exits. The only file that prints and exits.

use std::io::{self, Write as _};
use std::process::ExitCode;

use cutc::cli;

/// A marker consists of millions of small objects. This allocator uses large pages for them and is fast with several threads.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    #[cfg(unix)]
    signals::obey();
    let words: Vec<_> = std::env::args_os().collect();
    let finished = cli::run(&words, &mut cli::Console { out: &mut io::stdout(), err: &mut io::stderr() });
    // Ignore errors on standard error: the reader has closed it.
    let _ = io::stderr().lock().write_all(finished.stderr.as_bytes());
    match finished.stdout.copy_to(&mut io::stdout().lock()) {
        Ok(()) => ExitCode::from(finished.code),
        // The reader, such as `head`, has closed the pipe: no error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::from(finished.code),
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: cannot write to standard output: {error}");
            ExitCode::from(cli::USAGE)
        }
    }
}

#[cfg(unix)]
mod signals {
    //! Signals that stop the program leave no unfinished files.

    use std::io::{self, Write as _};

    use cutc::cli;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    /// Ends the program as `cli` requires when a signal arrives. Signals that the parent process ignored, as `nohup` does, stay
    /// ignored.
    pub(super) fn obey() {
        let ignored = ignored();
        let heeded = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
        // Without handlers the next process has more to clean up. That is no reason not to begin.
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

    /// Mask of the signals that this process ignores, one bit each; 0 if the system does not tell.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }
}
