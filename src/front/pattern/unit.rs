//! Unit of a set of patterns: by the profile, the texts or the header of the file.

use super::choice::Asked;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::dxf::syntax;
use crate::front::dxf::unit::{NO_UNIT, UNITS};
use crate::machine::LONGEST_PART_MM;
use crate::source::Span;
use crate::units::MM_PER_INCH;

/// Names of units in English, German, French, Italian, Spanish, Portuguese and Chinese, in capitals, and their lengths, mm. The
/// metric system is mm, the English one inches.
#[rustfmt::skip] // a table: a row a unit
const NAMES: [(f64, &[&str]); 3] = [
    (1.0, &["METRIC", "MM", "MILLIMETER", "MILLIMETERS", "MILLIMETRE", "MILLIMETRES", "METRISCH", "MÉTRIQUE", "METRIQUE", "MILLIMÈTRE", "MILLIMÈTRES", "METRICO", "MILLIMETRO", "MILLIMETRI", "MÉTRICO", "MILÍMETRO", "MILÍMETROS", "MILIMETRO", "MILIMETROS", "公制", "米制", "毫米"]),
    (10.0, &["CM", "CENTIMETER", "CENTIMETERS", "CENTIMETRE", "CENTIMETRES", "ZENTIMETER", "CENTIMÈTRE", "CENTIMÈTRES", "CENTIMETRO", "CENTIMETRI", "CENTÍMETRO", "CENTÍMETROS", "CENTIMETROS", "厘米"]),
    (MM_PER_INCH, &["ENGLISH", "IMPERIAL", "INCH", "INCHES", "IN", "ENGLISCH", "ZOLL", "ANGLAIS", "IMPÉRIAL", "POUCE", "POUCES", "INGLESE", "IMPERIALE", "POLLICE", "POLLICI", "INGLÉS", "INGLES", "PULGADA", "PULGADAS", "INGLÊS", "POLEGADA", "POLEGADAS", "英制", "英寸"]),
];
/// Number of letters of a text that a message shows.
const SHOWN: usize = 24;
/// Hint if the unit is unknown.
const SAY_WHICH: &str = "say which it is: `--set dxf.unit=mm`, `cm` or `inch`";

/// Greatest length of a line in the unit of the header, mm: no part has a longer outline.
const LONGEST_LINE: f64 = 3e4;
/// Largest side of the largest of several pieces, mm, below which the unit is doubted: no garment is so small, and trousers of
/// 1.2 m that are drawn in cm would be.
const SMALLEST: f64 = 120.0;
/// Greatest width of cloth, mm, that of wide decoration fabric: no piece is wider both ways.
const WIDEST_CLOTH: f64 = 3300.0;

/// Lengths of the cuts of a file, in its own unit: of all, and of the longest line.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lengths {
    pub(super) all: f64,
    pub(super) longest: f64,
}

/// Length of the unit that the texts name, else the header, mm. If the cuts, which `lengths` finds, would be too long in the
/// unit of the header, a library has written the header without regard to the drawing: then the unit is mm.
pub(super) fn unit(
    Asked { source, job, letters, file }: &Asked,
    of_header: Option<Span>,
    lengths: impl FnOnce() -> Lengths,
    out: &mut Diagnostics,
) -> f64 {
    if let Some(mm) = job.profile.dxf.unit.mm() {
        return mm;
    }
    let Some(first) = file.units.first else {
        if let Some(span) = of_header.filter(|span| syntax::whole(source.slice(*span)) != Some(NO_UNIT)) {
            let named = shown(&letters.text(source.slice(span)));
            return of_number(syntax::whole(source.slice(span)), span, &named, lengths, out);
        }
        let message = "the file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm";
        let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
        out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
        return 1.0;
    };
    let told = [Some(first), file.units.other].into_iter().flatten().map(|span| {
        let text = letters.text(source.slice(span));
        unit_of(&text).ok_or_else(|| {
            let message = format!("`{}` is no unit that pattern DXF knows", shown(&text));
            Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(SAY_WHICH)
        })
    });
    match told.collect::<Result<Vec<f64>, Diagnostic>>().as_deref() {
        Ok(&[mm]) => mm,
        Ok(units) => {
            if let (Some(other), true) = (file.units.other, units.windows(2).any(|pair| pair[0] != pair[1])) {
                let text = |span: Span| shown(&letters.text(source.slice(span)));
                let message = format!("the file has two units, `{}` and `{}`", text(first), text(other));
                out.push(Diagnostic::new(&code::DXF_SAID_TWICE, message).at(other).hint(SAY_WHICH));
            }
            units.first().copied().unwrap_or(1.0)
        }
        Err(fault) => {
            out.push(fault.clone());
            1.0
        }
    }
}

/// Length of the unit for a number of the header, mm, if the cuts allow it.
fn of_number(
    number: Option<i64>,
    span: Span,
    named: &str,
    lengths: impl FnOnce() -> Lengths,
    out: &mut Diagnostics,
) -> f64 {
    let Some(&(_, mm)) = number.and_then(|number| UNITS.iter().find(|unit| unit.0 == number)) else {
        let message = format!("`{named}` ($INSUNITS) is no unit of patterns");
        out.push(Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(SAY_WHICH));
        return 1.0;
    };
    let lengths = if mm > MM_PER_INCH { lengths() } else { Lengths::default() };
    if mm * lengths.longest <= LONGEST_LINE {
        return mm;
    }
    let (all, longest) = (mm * lengths.all / 1e6, mm * lengths.longest / 1e3);
    let message = format!(
        "the header's unit ($INSUNITS) would make {all:.1} km of cuts, the longest of {longest:.0} m; taken for mm"
    );
    let finding = Diagnostic::new(&code::DXF_UNIT_DOUBTED, message).at(span);
    out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
    1.0
}

/// Doubts the unit by the sizes of pieces, mm: the largest is longer than [`LONGEST_PART_MM`], one is wider than [`WIDEST_CLOTH`] both
/// ways, or the largest of several is below [`SMALLEST`]; a single small one may be a label.
pub(super) fn doubt(
    sizes: impl Iterator<Item = (f64, f64)>,
    is_one: bool,
    Asked { job, .. }: &Asked,
    out: &mut Diagnostics,
) {
    let [mut largest, mut widest] = [f64::NEG_INFINITY; 2];
    for (width, height) in sizes {
        (largest, widest) = (largest.max(width.max(height)), widest.max(width.min(height)));
    }
    let is_small = !is_one && (0.0..SMALLEST).contains(&largest);
    if job.profile.dxf.unit.mm().is_some() || !is_small && largest <= LONGEST_PART_MM && widest <= WIDEST_CLOTH {
        return;
    }
    let message = if !is_small && largest <= LONGEST_PART_MM {
        format!("a piece is {widest:.0} mm wide and longer, wider than cloth; is the unit right?")
    } else {
        format!("the largest piece is {largest:.0} mm long; is the unit right?")
    };
    let hint = if is_small {
        "METRIC may stand over cm or inches: `--set dxf.unit=cm`; `--set dxf.unit=mm` if it is mm"
    } else {
        "numbers in mm may stand under another unit: `--set dxf.unit=mm`; say the unit if it is right"
    };
    out.push(Diagnostic::new(&code::DXF_UNIT_DOUBTED, message).hint(hint));
}

/// The beginning of a text in a message.
fn shown(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// Length of a unit by its name, mm.
fn unit_of(text: &str) -> Option<f64> {
    let text = text.trim().to_uppercase();
    NAMES.iter().find(|(_, names)| names.contains(&text.as_str())).map(|(mm, _)| *mm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_known_in_the_languages_of_the_keys() {
        for (names, mm) in [
            (["metric", "Millimetre", "métrique", "METRICO", "公制"], 1.0),
            (["Zentimeter", "centimètre", "centimetri", "centímetros", "厘米"], 10.0),
            (["Englisch", "pouces", "Pollici", "pulgadas", "英制"], MM_PER_INCH),
        ] {
            assert_eq!(names.map(unit_of), [Some(mm); 5], "{names:?}");
        }
        assert_eq!(["MILES", "", "公"].map(unit_of), [None; 3]);
    }
}
