//! Writes a made-up garment marker of any size to standard output, to measure the compiler with:
//! `cargo run --release --features bench --example marker -- --pieces 40 > marker.cut`.

mod garment;

use std::io::{self, BufWriter, Write};

use clap::{Parser, ValueEnum};
use garment::Order;

/// A garment marker of any size, made up from bodices, sleeves, trouser legs, collars, pockets and waistbands, on standard
/// output. The same arguments give the same bytes.
#[derive(Parser)]
#[command(name = "marker")]
struct Arguments {
    /// Number of pieces.
    #[arg(long, default_value_t = 12)]
    pieces: usize,
    /// As many pieces as have this many vertices, in place of --pieces.
    #[arg(long, conflicts_with = "pieces")]
    vertices: Option<usize>,
    /// Shape of the file.
    #[arg(long, value_enum, default_value_t = Dialect::G71)]
    dialect: Dialect,
    /// Farthest of a curve from its chords, mm.
    #[arg(long, default_value_t = 0.05, value_parser = |text: &str| within(text, 0.0001, 10.0))]
    tol: f64,
    /// Width of the cloth, mm.
    #[arg(long, default_value_t = 1500.0, value_parser = |text: &str| within(text, 1.0, 100_000.0))]
    width: f64,
    /// Gap between pieces, mm.
    #[arg(long, default_value_t = 4.0, value_parser = |text: &str| within(text, 0.0, 1000.0))]
    gap: f64,
    /// Contours inside bodices and trouser legs.
    #[arg(long)]
    cutouts: bool,
    /// What sizes, mirroring, notches and senses are drawn from.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Clone, Copy, ValueEnum)]
enum Dialect {
    /// 0.1 mm under G71, V notches, labels behind their place.
    G71,
    /// 0.254 mm, slit notches behind M19, labels before their place.
    Inch,
    /// 0.1 mm, blanks behind blocks, lifts at corners, no pieces.
    Spaced,
    /// An HPGL plot in 1/40 mm, slits as spikes of the outlines.
    Plot,
}

/// A number of a range.
fn within(text: &str, least: f64, most: f64) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (least..=most).contains(&value) => Ok(value),
        Ok(_) | Err(_) => Err(format!("a number from {least} to {most} is wanted")),
    }
}

fn main() -> io::Result<()> {
    let arguments = Arguments::parse();
    let order = Order {
        dialect: match arguments.dialect {
            Dialect::G71 => garment::Dialect::G71,
            Dialect::Inch => garment::Dialect::Inch,
            // A plot has a writer of its own.
            Dialect::Spaced | Dialect::Plot => garment::Dialect::Spaced,
        },
        pieces: arguments.pieces,
        vertices: arguments.vertices,
        tolerance: arguments.tol,
        width: arguments.width,
        gap: arguments.gap,
        cutouts: arguments.cutouts,
        seed: arguments.seed,
    };
    let mut out = BufWriter::new(io::stdout().lock());
    let written = match arguments.dialect {
        Dialect::Plot => garment::write_plot(&order, &mut out),
        Dialect::G71 | Dialect::Inch | Dialect::Spaced => garment::write(&order, &mut out),
    };
    match written.and_then(|()| out.flush()) {
        // The reader has seen enough, as `head` does: no error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}
