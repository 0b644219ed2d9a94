//! The unit of a set of patterns: as the profile, the texts or the header of the file have it.

use super::choice::Asked;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;
use crate::units::MM_PER_INCH;

/// Length of the unit that the texts name, else the header, mm.
pub(super) fn unit(Asked { source, job, file }: &Asked, of_header: Option<Span>, out: &mut Diagnostics) -> f64 {
    if let Some(mm) = job.profile.dxf.unit.mm() {
        return mm;
    }
    let Some(first) = file.units.first else {
        if let Some(mm) = of_header.and_then(|span| unit_of_header(source.slice(span))) {
            return mm;
        }
        let message = "the file does not say its unit (UNITS: METRIC or ENGLISH); it is taken for mm";
        let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
        out.push(finding.hint("compare the extent that is printed with the pieces; inches are `--set dxf.unit=inch`"));
        return 1.0;
    };
    let say_which = "say which it is: `--set dxf.unit=mm` or `--set dxf.unit=inch`";
    let told = [Some(first), file.units.other].into_iter().flatten().map(|span| {
        let text = source.slice(span);
        unit_of(text).ok_or_else(|| {
            let message = format!("`{}` is no unit that pattern DXF knows", text.escape_ascii());
            Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(say_which)
        })
    });
    match told.collect::<Result<Vec<f64>, Diagnostic>>().as_deref() {
        Ok(&[mm]) => mm,
        Ok(units) => {
            if let (Some(other), true) = (file.units.other, units.windows(2).any(|pair| pair[0] != pair[1])) {
                let text = |span: Span| source.slice(span).escape_ascii();
                let message = format!("the file has two units, `{}` and `{}`", text(first), text(other));
                out.push(Diagnostic::new(&code::DXF_SAID_TWICE, message).at(other).hint(say_which));
            }
            units.first().copied().unwrap_or(1.0)
        }
        Err(fault) => {
            out.push(fault.clone());
            1.0
        }
    }
}

/// Length of the unit of a number in the header, mm (DXF reference, `$INSUNITS`); `None` for none and for those in which no
/// garment is drawn.
fn unit_of_header(number: &[u8]) -> Option<f64> {
    match number {
        b"1" => Some(MM_PER_INCH),
        b"4" => Some(1.0),
        b"5" => Some(10.0),
        b"6" => Some(1000.0),
        _ => None,
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
