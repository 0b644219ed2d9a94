//! Lines of the cloth as drawn on the page: outlines and notches of pieces, and lines that are drawn but not cut.

use crate::back::target::Context;
use crate::geom::Point;
use crate::ir::marker::{Notch, NotchKind, OutlineNotch};
use crate::picture::Columns;

/// Unit of coordinates, mm.
const UNIT: f64 = 1e-3;
/// Codes of the kinds of lines.
const CLOSED: i64 = 0;
const OPEN: i64 = 1;
const NOTCH: i64 = 2;
const ASIDE: i64 = 3;
const HOLE: i64 = 4;

/// Lines, with their points in one array.
#[derive(Debug, Default)]
pub(super) struct Lines {
    kinds: Vec<i64>,
    /// Index in the marker of the piece of each line; for lines that are not cut the index of their class.
    parts: Vec<u32>,
    counts: Vec<u32>,
    points: Vec<Point>,
    /// Classes of the lines that are not cut.
    pub(super) classes: Vec<&'static str>,
}

impl Lines {
    pub(super) fn of(context: &Context) -> Self {
        let mut lines = Self::default();
        for (part, piece) in (0..).zip(&context.marker.pieces) {
            for contour in &piece.contours {
                let kind = if contour.closed { CLOSED } else { OPEN };
                let points = context.marker.points(contour);
                for notch in &piece.outline_notches {
                    lines.add_notch(notch, part, &points);
                }
                lines.add(kind, part, points);
            }
            for notch in &piece.notches {
                lines.add(NOTCH, part, strokes(notch));
            }
            for drill in &piece.drills {
                lines.add(HOLE, part, vec![drill.at]);
            }
        }
        for (class, vertices) in context.marker.drawing.iter().flat_map(|account| account.aside.each()) {
            // The way back of a mark lies on the mark itself.
            let Some(class) = class else { continue };
            let known = lines.classes.iter().position(|other| *other == class);
            let number = known.unwrap_or_else(|| {
                lines.classes.push(class);
                lines.classes.len() - 1
            });
            lines.add(ASIDE, number as u32, vertices.iter().map(|vertex| vertex.at).collect());
        }
        lines
    }

    fn add(&mut self, kind: i64, part: u32, points: Vec<Point>) {
        self.kinds.push(kind);
        self.parts.push(part);
        self.counts.push(points.len() as u32);
        self.points.extend(points);
    }

    /// Adds the stretch of an outline that a notch of it makes, from one end of its mouth to the other.
    fn add_notch(&mut self, notch: &OutlineNotch, part: u32, outline: &[Point]) {
        let ring = &outline[..outline.len().saturating_sub(1)];
        let place = |first: usize, on: usize| ring[(first + on) % ring.len()];
        let segments = notch.segments as usize;
        let is_at = |at: Point, mouth: Point| (at - mouth).norm() < UNIT;
        let starts =
            |&first: &usize| is_at(place(first, 0), notch.mouth[0]) && is_at(place(first, segments), notch.mouth[1]);
        if let Some(first) = (0..ring.len()).find(starts) {
            self.add(NOTCH, part, (0..=segments).map(|on| place(first, on)).collect());
        }
    }

    /// Adds the columns.
    pub(super) fn write(self, columns: &mut Columns) {
        let in_units = |value: f64| (value / UNIT).round() as i64;
        columns.add("line_kind", 1.0, self.kinds);
        columns.add("line_part", 1.0, self.parts.into_iter().map(i64::from));
        columns.add("line_points", 1.0, self.counts.into_iter().map(i64::from));
        columns.add("line_x", UNIT, self.points.iter().map(|point| in_units(point.x)));
        columns.add("line_y", UNIT, self.points.iter().map(|point| in_units(point.y)));
    }
}

/// A notch that is cut by itself, as one line; the crossbar is connected to the tip.
fn strokes(notch: &Notch) -> Vec<Point> {
    match notch.kind {
        NotchKind::Slit => vec![notch.root, notch.tip],
        NotchKind::T(bar) => vec![notch.root, notch.tip, bar.from, bar.to],
    }
}
