//! Files of registration marks: CSV with the header `x_mm,y_mm,found_x_mm,found_y_mm` and one row for each mark.
//!
//! The marks that are returned are consistent: at least four, not collinear, each within `map.max_mm` of its position by the
//! map of the others, and the map stretches and skews no more than usable cloth. All faults of rows are reported in one run.

use std::ops::RangeInclusive;
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::{AffineMap, Mark, Marks};
use crate::source::{CsvFault, Source, Span, csv_fields, csv_number, csv_rows};
use crate::units::number::{counted, fixed, short, up};

/// The first row.
const HEADER: &str = "x_mm,y_mm,found_x_mm,found_y_mm";
/// Hint on faulty rows.
const ROW: &str = "a row is four numbers in mm, with decimal points and a comma between them: X and Y of a mark in the drawing, \
                   then where it lies on the table";
/// Minimum number of marks. Three always fit an affine map, so that no fault would be seen.
const LEAST: usize = 4;
/// Maximum coordinate, mm: a kilometre, far beyond any table.
const FARTHEST: f64 = 1e6;
/// Decimals of distances, mm.
const DECIMALS: u32 = 2;
/// Permitted stretch of cloth: a fifth either way (as `sheet.scale_x`).
const STRETCH: RangeInclusive<f64> = 0.8..=1.2;
/// Maximum skew of usable cloth, deg.
const MOST_SKEWED_DEG: f64 = 10.0;
/// Maximum number of marks that are left out in turn to find a misread one.
const MOST_TRIED: usize = 1000;

/// Reads marks; `None` if there are faults, which are reported. `most` is the permitted distance of a mark from its position by
/// the map of the others, mm.
pub fn read(source: &Arc<Source>, most: f64, out: &mut Diagnostics) -> Option<Marks> {
    let read =
        csv_rows(source.bytes(), HEADER, parse).map_err(|faults| faults.into_iter().map(told).collect::<Vec<_>>());
    let fitted = read.and_then(|rows| {
        let (marks, spans): (Vec<Mark>, Vec<Span>) = rows.into_iter().unzip();
        fit(&marks, &spans, most, source).map_err(|fault| vec![fault])
    });
    match fitted {
        Ok(marks) => Some(marks),
        Err(faults) => {
            for fault in faults {
                out.push(fault);
            }
            None
        }
    }
}

/// Parses a row.
fn parse(text: &str) -> Result<Mark, String> {
    let [x, y, found_x, found_y] = csv_fields(text)?;
    let place = |field: &str| csv_number(field, "place in mm", FARTHEST);
    Ok(Mark { drawn: [place(x)?, place(y)?], found: [place(found_x)?, place(found_y)?] })
}

/// Diagnostic for a fault of the file.
fn told(fault: CsvFault) -> Diagnostic {
    let (span, message) = match fault {
        CsvFault::Header(span) => (span, format!("the first row is not the header `{HEADER}`")),
        CsvFault::Row(span, message) => (span, message),
    };
    Diagnostic::new(&code::MARKS_ROW, message).at(span).hint(ROW)
}

/// Fits the map of the marks. The error describes why there is none.
fn fit(marks: &[Mark], spans: &[Span], most: f64, source: &Arc<Source>) -> Result<Marks, Diagnostic> {
    let fault = |message: &str| Diagnostic::new(&code::MARKS_FIT, message);
    if marks.len() < LEAST {
        let message = format!("{} are too few: a map needs {LEAST}", counted(marks.len(), "mark"));
        return Err(fault(&message).hint("with three marks every wrong reading fits: find a fourth"));
    }
    let Some(fitted) = Marks::new(marks.to_vec(), Arc::clone(source)) else {
        let hint = "find marks on both sides of the cloth and at both of its ends";
        return Err(fault("the marks lie on a line: across it nothing says how the cloth lies").hint(hint));
    };
    let (worst, off) = fitted.farthest();
    if off.is_infinite() {
        let finding = fault("a wrong reading of this mark would not be seen: the others lie on a line");
        return Err(finding.at(spans[worst]).hint("find one more mark, away from that line"));
    }
    if fitted.map().is_mirrored() {
        let hint = "have two marks changed places, or X and Y? Y of the drawing goes up";
        return Err(fault("the marks say that the cloth lies mirrored").hint(hint));
    }
    let map = fitted.map();
    let is_odd = |stretch: &f64| !STRETCH.contains(stretch);
    if map.stretch().iter().any(is_odd) || map.skewed_deg().abs() > MOST_SKEWED_DEG {
        let [along, across] = map.stretch().map(|stretch| fixed(stretch, 3));
        let skewed = fixed(map.skewed_deg(), 1);
        let message =
            format!("the marks stretch the drawing by {along} x {across} and skew it by {skewed} deg, as no cloth is");
        return Err(fault(&message).hint("are all four numbers in mm, and do they belong to this drawing?"));
    }
    if off <= most {
        return Ok(fitted);
    }
    let (off, allowed) = (up(off, DECIMALS), short(most));
    let finding = fault(&format!("a mark lies {off} mm from where the map of the others has it ({allowed} allowed)"));
    let finding = finding.hint("the limit is the profile's `map.max_mm`");
    let tried = 0..marks.len().min(MOST_TRIED);
    let misread: Vec<usize> = tried.filter(|&mark| fits(marks, mark, most)).collect();
    Err(match misread[..] {
        _ if marks.len() == LEAST => {
            let hint = "of four marks none can be told to be the wrong one: find all of them again, or a fifth";
            finding.at(spans[worst]).hint(hint)
        }
        [] => {
            let hint = "leaving out no single mark makes the others fit: find all of them again";
            finding.at(spans[worst]).hint(hint)
        }
        [mark] => finding.at(spans[mark]).hint("without this mark the others fit: find it again"),
        [first, ..] => {
            let lines: Vec<String> = misread.iter().map(|&mark| spans[mark].block.to_string()).collect();
            let lines = lines.join(", ");
            let hint = format!("without any one of the marks in lines {lines} the others fit: find these again");
            finding.at(spans[first]).hint(hint)
        }
    })
}

/// True if all marks except one fit each other within `most` mm, as far as they are redundant.
fn fits(marks: &[Mark], but: usize, most: f64) -> bool {
    let rest = [&marks[..but], &marks[but + 1..]].concat();
    AffineMap::fit(&rest).is_some_and(|map| !map.is_mirrored() && rest.iter().all(|mark| map.off(mark) <= most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The marks of some rows, or the codes, lines and hints of their faults.
    fn reading(rows: &str) -> Result<Marks, Vec<(&'static str, u32, String)>> {
        let source = Arc::new(Source::new("marks.csv", format!("{HEADER}\n{rows}").into_bytes()).expect("small"));
        let mut out = Diagnostics::default();
        let marks = read(&source, 1.0, &mut out);
        let told =
            |found: &Diagnostic| (found.code.name, found.span.map_or(0, |span| span.block), found.hints.join("; "));
        marks.ok_or_else(|| out.iter().map(told).collect())
    }

    const SOUND: &str = "0,0,100,50\n1000,0,1102,50\n1000,500,1102,551\n0,500,100,551\n";

    #[test]
    fn sound_marks_are_read() {
        let marks = reading(SOUND).expect("sound");
        assert_eq!(marks.count(), 4);
        assert!(marks.farthest().1 < 1e-9 && (marks.map().stretch()[0] - 1.002).abs() < 1e-9);
    }

    #[test]
    fn every_row_that_is_wrong_is_told() {
        let told = reading("0,0,100,50\n1,2,3\n1,2,3,4,5\n1,2,3,x\n1,2,3,nan\n1e7,0,0,0\n").expect_err("faulty");
        let rows: Vec<(&str, u32)> = told.iter().map(|(code, line, _)| (*code, *line)).collect();
        assert_eq!(rows, [3, 4, 5, 6, 7].map(|line| ("marks/row", line)));
    }

    #[test]
    fn marks_that_give_no_map_are_refused() {
        for rows in ["", "0,0,100,50\n1000,0,1102,50\n1000,500,1102,551\n"] {
            assert_eq!(reading(rows).expect_err("too few")[0].0, "marks/fit");
        }
        let told = reading("0,0,0,0\n1,0,1,0\n2,0,2,0\n3,0,3,0\n").expect_err("on a line");
        assert!(told[0].2.contains("both sides"), "{told:?}");
        let told = reading("0,0,0,0\n1000,0,1000,0\n1000,500,1000,-500\n0,500,0,-500\n").expect_err("mirrored");
        assert!(told[0].2.contains("changed places"), "{told:?}");
    }

    #[test]
    fn a_mark_that_no_other_checks_is_refused() {
        let on_a_line = "0,0,100,50\n500,0,601,50\n1000,0,1102,50\n";
        let told = reading(&format!("{on_a_line}500,500,600,950\n")).expect_err("unchecked");
        assert_eq!((told[0].0, told[0].1), ("marks/fit", 5), "{told:?}");
        let twice = "0,0,100,50\n0,0,100,50\n1000,0,1102,50\n500,500,600,551\n";
        assert_eq!(reading(twice).expect_err("three places")[0].0, "marks/fit");
    }

    #[test]
    fn marks_that_may_be_read_wrongly_are_named() {
        let told = reading(&SOUND.replace("1102,551", "1112,551")).expect_err("one of four");
        assert!(told[0].2.contains("of four marks none"), "{told:?}");
        let mut rng = fastrand::Rng::with_seed(4);
        let drawn: [[f64; 2]; 7] =
            [[0.0, 0.0], [1000.0, 0.0], [1000.0, 500.0], [0.0, 500.0], [480.0, 260.0], [210.0, 30.0], [700.0, 470.0]];
        for (count, wrong) in (5..=7).flat_map(|count| (0..count).map(move |wrong| (count, wrong))) {
            let row = |(k, [x, y]): (usize, &[f64; 2])| {
                let [noise_x, noise_y] = [0.2, 0.2].map(|most| most * (rng.f64() - 0.5));
                let off = if k == wrong { 12.0 } else { 0.0 };
                format!("{x},{y},{:.3},{:.3}\n", x + 100.0 + noise_x, y + 50.0 + off + noise_y)
            };
            let rows: String = drawn[..count].iter().enumerate().map(row).collect();
            let told = reading(&rows).expect_err("one is wrong");
            let line = wrong as u32 + 2;
            let is_named = told[0].1 == line || told[0].2.contains(&format!(" {line}"));
            assert!(is_named && told[0].2.contains("without"), "{count} marks, line {line}: {told:?}");
            // Seven marks are unambiguous.
            assert!(count < 7 || told[0].2.contains("without this mark"), "{told:?}");
        }
    }
}
