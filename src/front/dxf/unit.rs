//! The unit of a plain drawing, and the table of header units.

use super::syntax;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::machine::patterns::Dxf;
use crate::source::{Source, Span};
use crate::units::MM_PER_INCH;

/// Header units: number and length, mm (DXF reference, `$INSUNITS`).
pub(in crate::front) const UNITS: [(i64, f64); 7] =
    [(1, MM_PER_INCH), (2, 304.8), (4, 1.0), (5, 10.0), (6, 1000.0), (10, 914.4), (14, 100.0)];
/// Number for an unspecified unit.
pub(in crate::front) const NO_UNIT: i64 = 0;
/// Maximum side of a drawing in the unit of its header, mm: no table is longer.
const LONGEST: f64 = 3e4;
/// Width of cloth, mm, that of wide decoration fabric. A drawing larger than this in both directions is doubted.
const WIDEST_CLOTH: f64 = 3300.0;
/// Minimum of the longer side of a drawing, mm; a smaller drawing is doubted.
const SMALLEST: f64 = 20.0;
/// Hint for a drawing with an unknown unit.
const SAY_WHICH: &str = "say which it is: `--set dxf.unit=mm`, `cm` or `inch`";

/// Unit of a drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unit {
    /// Length of the unit, mm.
    pub(super) mm: f64,
    is_unsaid: bool,
}

/// The unit of the profile, otherwise that of the header, otherwise mm. A header unit that would make the drawing longer than
/// any table is replaced by mm. `extent` computes the box of the drawing in its own unit.
pub(super) fn unit(
    dxf: &Dxf,
    of_header: Option<Span>,
    source: &Source,
    extent: impl FnOnce() -> Extent,
    out: &mut Diagnostics,
) -> Unit {
    if let Some(mm) = dxf.unit.mm() {
        return Unit { mm, is_unsaid: false };
    }
    let number = of_header.map(|span| syntax::whole(source.slice(span)));
    let (Some(span), Some(number)) = (of_header, number.filter(|number| *number != Some(NO_UNIT))) else {
        return Unit { mm: 1.0, is_unsaid: true };
    };
    let Some(&(_, mm)) = number.and_then(|number| UNITS.iter().find(|unit| unit.0 == number)) else {
        let message = "the unit of the header ($INSUNITS) is none in which parts are drawn";
        out.push(Diagnostic::new(&code::DXF_UNIT, message).at(span).hint(SAY_WHICH));
        return Unit { mm: 1.0, is_unsaid: false };
    };
    let longest = if mm > MM_PER_INCH { longest(&extent()) } else { 0.0 };
    if mm * longest <= LONGEST {
        return Unit { mm, is_unsaid: false };
    }
    let message =
        format!("the header's unit ($INSUNITS) would make a drawing of {:.0} m; taken for mm", mm * longest / 1e3);
    let finding = Diagnostic::new(&code::DXF_UNIT_DOUBTED, message).at(span);
    out.push(finding.hint("compare the extent that is printed with the parts; inches are `--set dxf.unit=inch`"));
    Unit { mm: 1.0, is_unsaid: false }
}

impl Unit {
    /// Reports the size of a drawing without a unit, and doubts one that is larger or smaller than parts are.
    pub(super) fn doubt(&self, extent: &Extent, out: &mut Diagnostics) {
        if extent.is_empty() {
            return;
        }
        let (width, height) = extent.size();
        let is_strange = width.min(height) > WIDEST_CLOTH || longest(extent) < SMALLEST;
        let size = format!("{width:.1} x {height:.1} mm");
        if self.is_unsaid {
            let message = format!("the file does not say its unit; it is taken for mm: is the drawing {size}?");
            let finding = Diagnostic::new(&code::DXF_NO_UNIT, message);
            out.push(finding.hint("inches are `--set dxf.unit=inch`, cm `dxf.unit=cm`; `dxf.unit=mm` if it is mm"));
        } else if is_strange {
            let message = format!("the drawing is {size}: is the unit right?");
            out.push(Diagnostic::new(&code::DXF_UNIT_DOUBTED, message).hint(SAY_WHICH));
        }
    }
}

fn longest(extent: &Extent) -> f64 {
    if extent.is_empty() { 0.0 } else { extent.size().0.max(extent.size().1) }
}
