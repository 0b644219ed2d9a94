//! Plausibility of sizes: a lost decimal point or a doubled digit makes a part or a drawing longer than any table. Plots, plain
//! DXF and SVG drawings are checked here; cut files and patterns by their readers.

use super::doubts::{finding, numbers};
use super::line::{Class, Line};
use super::piece::owners;
use super::sheet::Sheet;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::machine::{LONGEST_LAY_MM, LONGEST_PART_MM};
use crate::units::number::fixed;

/// Warns of a part longer than parts are, or of a drawing longer than any lay.
pub(super) fn say(sheet: &Sheet, out: &mut Diagnostics) {
    let is_part = |line: &&Line| line.class == Class::Part && line.is_cut;
    let longest = sheet.lines.iter().filter(is_part).max_by(|a, b| a.size().total_cmp(&b.size()));
    let size = |extent: &Extent| {
        let (width, height) = extent.size();
        format!("{} x {} mm", fixed(width, 1), fixed(height, 1))
    };
    let hint = "a decimal point may be lost, a digit doubled, or the unit wrong: compare it with the marker";
    if let Some(line) = longest.filter(|line| line.size() > LONGEST_PART_MM) {
        let limit = fixed(LONGEST_PART_MM / 1e3, 0);
        let message = format!("a part is {}: longer than {limit} m", size(&line.extent));
        let found = finding(&code::DRAWING_SIZE, message, line, sheet).on_cloth(line.extent.min);
        let long = sheet.indices(|line| is_part(&line) && line.size() > LONGEST_PART_MM);
        out.push(found.about(numbers(&owners(sheet), &long)).hint(hint));
        return;
    }
    let mut extent = Extent::EMPTY;
    sheet.lines.iter().for_each(|line| extent.join(&line.extent));
    let (width, height) = extent.size();
    if !extent.is_empty() && width.max(height) > LONGEST_LAY_MM {
        let message = format!("the drawing is {}: longer than any table", size(&extent));
        out.push(Diagnostic::new(&code::DRAWING_SIZE, message).hint(hint));
    }
}
