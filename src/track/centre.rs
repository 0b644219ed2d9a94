//! Centre lines as files: CSV with the header `conv_mm,centre_mm`, one row per position of the conveyor.
//!
//! A line that is read without faults has at least two rows, finite numbers, and increasing conveyor positions. All faults of a
//! file are reported in one run.

use std::io::{self, Write};

use super::row::FARTHEST;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::CentreLine;
use crate::source::{CsvFault, Source, csv_fields, csv_number, csv_rows};
use crate::units::number::{push_fixed, short};

/// The first row.
const HEADER: &str = "conv_mm,centre_mm";
/// Number of decimals of values in mm.
const DECIMALS: u32 = 3;
/// Hint on faulty rows.
const ROW: &str =
    "a row is two numbers in mm, as in `125.5,-0.75`, and `conv_mm` is greater in each than in the one before";

/// Reads a centre line; `None` if there are faults, which are diagnostics.
pub fn read(source: &Source, out: &mut Diagnostics) -> Option<CentreLine> {
    let mut last = None;
    let row = |text: &str| {
        let row = parse(text, last)?;
        last = Some(row);
        Ok(row)
    };
    let rows = match csv_rows(source.bytes(), HEADER, row) {
        Ok(rows) => rows,
        Err(faults) => {
            for fault in faults {
                out.push(told(fault));
            }
            return None;
        }
    };
    if rows.len() < 2 {
        let message = format!("the centre line has fewer than two rows: {}", rows.len());
        let hint = "give two at the least: where the conveyor begins, and where it ends";
        out.push(Diagnostic::new(&code::CENTRE_SHORT, message).hint(hint));
    }
    CentreLine::new(rows.into_iter().map(|(row, _)| row).collect())
}

/// Diagnostic of a fault.
fn told(fault: CsvFault) -> Diagnostic {
    match fault {
        CsvFault::Header(span) => {
            let message = format!("the first row is not `{HEADER}`");
            let hint = "`cutc track LOG.csv -t centre` writes such a file";
            Diagnostic::new(&code::CENTRE_HEADER, message).at(span).hint(hint)
        }
        CsvFault::Row(span, message) => Diagnostic::new(&code::CENTRE_ROW, message).at(span).hint(ROW),
    }
}

/// Parses a row; its conveyor position must be greater than that of the last row.
fn parse(text: &str, last: Option<[f64; 2]>) -> Result<[f64; 2], String> {
    let [conveyor, centre] = csv_fields(text)?;
    let place = |field: &str| csv_number(field, "place in mm", FARTHEST);
    let row = [place(conveyor)?, place(centre)?];
    match last {
        Some([before, _]) if row[0] <= before => {
            Err(format!("the conveyor does not go on: {} mm comes behind {} mm", short(row[0]), short(before)))
        }
        _ => Ok(row),
    }
}

/// Writes a centre line: positions of the conveyor and of the centre, mm. The conveyor positions must increase even after
/// rounding to [`DECIMALS`].
pub(super) fn write(rows: &[[f64; 2]], out: &mut dyn Write) -> io::Result<()> {
    let mut block = format!("{HEADER}\n").into_bytes();
    for [conveyor, centre] in rows {
        push_fixed(&mut block, *conveyor, DECIMALS);
        block.push(b',');
        push_fixed(&mut block, *centre, DECIMALS);
        block.push(b'\n');
    }
    out.write_all(&block)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let rows = [[0.0, -0.125], [2.5, 0.0], [1000.0, 7.25]];
        let mut bytes = Vec::new();
        write(&rows, &mut bytes).expect("a vector takes bytes");
        assert!(bytes.starts_with(b"conv_mm,centre_mm\n0.000,-0.125\n"));
        let mut out = Diagnostics::default();
        let read = read(&Source::new("centre.csv", bytes).expect("small"), &mut out).expect("a line");
        assert_eq!((read.rows(), out.iter().len()), (&rows[..], 0));
    }
}
