//! The unit of a set of patterns: as the profile, the texts or the header of the file have it.

use super::choice::Asked;
use super::syntax;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;
use crate::units::MM_PER_INCH;

/// Units of the header by their numbers, and their lengths, mm (DXF reference, `$INSUNITS`).
const UNITS: [(i64, f64); 7] =
    [(1, MM_PER_INCH), (2, 304.8), (4, 1.0), (5, 10.0), (6, 1000.0), (10, 914.4), (14, 100.0)];
/// The number that names none.
const NO_UNIT: i64 = 0;
/// What to do where nobody knows which it is.
const SAY_WHICH: &str = "say which it is: `--set dxf.unit=mm` or `--set dxf.unit=inch`";

/// Length of the unit that the texts name, else the header, mm.
pub(super) fn unit(Asked { source, job, file }: &Asked, of_header: Option<Span>, out: &mut Diagnostics) -> f64 {
    if let Some(mm) = job.profile.dxf.unit.mm() {
        return mm;
    }
    let Some(first) = file.units.first else {
        if let Some(span) = of_header.filter(|span| syntax::whole(source.slice(*span)) != Some(NO_UNIT)) {
            let known = syntax::whole(source.slice(span)).and_then(|number| UNITS.iter().find(|unit| unit.0 == number));
            if let Some((_, mm)) = known {
                return *mm;
            }
            let message = format!("`{}` ($INSUNITS) is no unit of patterns", source.slice(span).escape_ascii());
            out.push(Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(SAY_WHICH));
            return 1.0;
        }
        let message = "the file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm";
        let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
        out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
        return 1.0;
    };
    let told = [Some(first), file.units.other].into_iter().flatten().map(|span| {
        let text = source.slice(span);
        unit_of(text).ok_or_else(|| {
            let message = format!("`{}` is no unit that pattern DXF knows", text.escape_ascii());
            Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(SAY_WHICH)
        })
    });
    match told.collect::<Result<Vec<f64>, Diagnostic>>().as_deref() {
        Ok(&[mm]) => mm,
        Ok(units) => {
            if let (Some(other), true) = (file.units.other, units.windows(2).any(|pair| pair[0] != pair[1])) {
                let text = |span: Span| source.slice(span).escape_ascii();
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

/// Length of a unit that a text names, mm.
fn unit_of(text: &[u8]) -> Option<f64> {
    match text.to_ascii_uppercase().as_slice() {
        b"METRIC" | b"MM" | b"MILLIMETERS" | b"MILLIMETRES" => Some(1.0),
        b"ENGLISH" | b"INCH" | b"INCHES" | b"IN" | b"IMPERIAL" => Some(MM_PER_INCH),
        _ => None,
    }
}
