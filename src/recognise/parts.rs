//! Parts by their place, and a test for lines in them.

use std::cell::RefCell;

use super::line::{Class, Line};
use super::sheet::Sheet;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::ring;

/// Parts by their place.
pub(super) struct Parts<'a> {
    sheet: &'a Sheet,
    lines: Vec<usize>,
    boxes: Boxes,
    /// Work budget: once it is spent, lines count as lying in parts, and nothing is reported of them.
    work: RefCell<Budget>,
}

/// Number of samples of a line, and of parts that are tested for each.
const PROBES: usize = 5;
const MOST_PARTS: usize = 16;

impl<'a> Parts<'a> {
    pub(super) fn of(sheet: &'a Sheet) -> Self {
        let lines = sheet.indices(|line| line.class == Class::Part);
        let boxes = Boxes::new(lines.iter().map(|&i| sheet.lines[i].extent).collect());
        Self { sheet, lines, boxes, work: RefCell::new(Budget::of_a_marker()) }
    }

    /// True if most of a line is in parts.
    pub(super) fn hold(&self, line: &Line) -> bool {
        let vertices = line.vertices(&self.sheet.vertices);
        let probe = |k: usize| {
            let place = k * (vertices.len() - 1) / PROBES;
            let share = (k as f64 + 0.5) / PROBES as f64 * (vertices.len() - 1) as f64 - place as f64;
            vertices[place].at + (vertices[place + 1].at - vertices[place].at) * share.clamp(0.0, 1.0)
        };
        let is_in = |k: &usize| {
            let at = probe(*k);
            let mut around = self.boxes.at(at).take(MOST_PARTS);
            around.any(|part| {
                let part = &self.sheet.lines[self.lines[part]];
                let cost = (part.end - part.first) as usize;
                !self.work.borrow_mut().spend(cost) || ring::contains(&part.points(&self.sheet.vertices), at)
            })
        };
        2 * (0..PROBES).filter(is_in).count() > PROBES
    }
}
