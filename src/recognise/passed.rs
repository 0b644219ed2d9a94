//! Outlines that the pen passes in the air, around lines that are cut as parts: their PD is lost. Such a line is the seam line
//! or a cut-out of the part.

use super::line::{Class, Line};
use super::pens::Use;
use super::piece::owners;
use super::sheet::Sheet;
use super::{doubts, seam};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, ring};
use crate::ir::drawing::Vertex;

/// Number of parts in a row of places at which it is the way around a page, and no outline with cut-outs.
const PAGE: usize = 4;

/// The error on outlines that are passed in the air. A line that is explicitly a cut needs no outline around it.
pub(super) fn outlines(sheet: &Sheet) -> Option<Diagnostic> {
    let is_part = |line: &Line| line.class == Class::Part && line.is_cut && line.usage == Use::Unsaid;
    let parts = sheet.indices(is_part);
    let boxes = Boxes::new(parts.iter().map(|&i| sheet.lines[i].extent).collect());
    let mut work = Budget::of_a_marker();
    let mut found = sheet.passed.iter().filter_map(|row| {
        let outline: Vec<Point> = row.iter().map(|vertex| vertex.at).collect();
        let held = held(&outline, &parts, &boxes, sheet, &mut work);
        (!held.is_empty()).then_some((row, held))
    });
    let (row, mut lines) = found.next()?;
    let more: Vec<Vec<usize>> = found.map(|(_, held)| held).collect();
    lines.extend(more.iter().flatten());
    let message = match (more.len(), lines.len()) {
        (0, 1) => "an outline is passed with the pen up, and a line in it would be cut".to_owned(),
        (0, _) => "an outline is passed with the pen up, and lines in it would be cut".to_owned(),
        (more, _) => format!("{} outlines are passed with the pen up, and lines in them would be cut", more + 1),
    };
    let span = row.get(1).map(|vertex: &Vertex| vertex.span)?;
    let finding = Diagnostic::new(&code::DRAWING_PASSED_OUTLINE, message).at(span);
    let finding = finding.about(doubts::numbers(&owners(sheet), &lines)).on_cloth(row[0].at);
    Some(
        finding
            .hint("a PD is lost or has become PU: transfer the file again")
            .hint("if they are no outlines, `--cut-pens` with the pen of the lines: what it draws is cut"),
    )
}

/// The parts that lie in a row of places which is their outline: one of them follows it, or they lie in it, and other lines do
/// not.
fn held(outline: &[Point], parts: &[usize], boxes: &Boxes, sheet: &Sheet, work: &mut Budget) -> Vec<usize> {
    let extent = Extent::of(outline);
    let mut held = Vec::new();
    let mut is_seam = false;
    for part in boxes.near(extent).filter(|&part| extent.covers(&boxes.all()[part])) {
        if !work.spend(seam::COST * outline.len()) {
            return Vec::new();
        }
        let line = sheet.lines[parts[part]].points(&sheet.vertices);
        if ring::contains(outline, line[0]) {
            is_seam |= seam::follows(&line, outline);
            held.push(parts[part]);
        }
    }
    if held.is_empty() || is_seam {
        return held;
    }
    let is_page = held.len() >= PAGE
        || !work.spend(sheet.lines.len())
        || sheet.lines.iter().all(|line| extent.covers(&line.extent));
    if is_page { Vec::new() } else { held }
}
