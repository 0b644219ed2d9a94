//! Measures how fast files are read into markers, passes not counted:
//! `cargo run --release --features bench --example read -- marker.plt`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Parser;
use cutc::diagnostic::Diagnostics;
use cutc::front;
use cutc::machine::Job;
use cutc::source::Source;

/// The fastest of a few readings of each file: what else the machine does only makes them slower.
#[derive(Parser)]
#[command(name = "read")]
struct Arguments {
    /// What to read.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Readings of each file.
    #[arg(long, default_value_t = 9, value_parser = clap::value_parser!(u32).range(1..))]
    times: u32,
}

const BYTES_PER_MB: f64 = 1e6;

/// The allocator of `cutc` itself.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> io::Result<()> {
    let arguments = Arguments::parse();
    for path in &arguments.files {
        let source = Source::new(path.display().to_string(), std::fs::read(path)?).map_err(io::Error::other)?;
        let extension = path.extension().and_then(|extension| extension.to_str());
        let Some(dialect) = front::choose(&source, None, extension, &mut Diagnostics::default()) else {
            return Err(io::Error::other(format!("{}: of no dialect", path.display())));
        };
        let seconds = (0..arguments.times).map(|_| reading(&source, dialect)).fold(f64::INFINITY, f64::min);
        let speed = source.bytes().len() as f64 / BYTES_PER_MB / seconds;
        writeln!(io::stdout(), "{}: {}, {speed:.0} MB/s", name(path), dialect.name)?;
    }
    Ok(())
}

/// Duration of one reading, s; that of giving the memory back is not in it.
fn reading(source: &Source, dialect: &front::Dialect) -> f64 {
    let mut found = Diagnostics::default();
    let start = Instant::now();
    let marker = cutc::pipeline::marker_of(dialect, source, &Job::default(), &mut found);
    let duration = start.elapsed().as_secs_f64();
    drop(marker);
    duration
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
