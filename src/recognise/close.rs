//! Lines that do not close by their last place: they run past their start or go round again, stop a little before it, or end at
//! the edge of the cloth, which only the frame draws.
//!
//! A line with a wider gap stays open but still contains others: a seam line must not become a part because the outline around
//! it has a fault.

use arrayvec::ArrayVec;

use super::line::{Class, Closing, Line, SMALL_OUTLINE};
use crate::geom::closing;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;
use crate::machine::Job;

/// Greatest gap of a line that goes around something, as a share of its length: a tenth of a square with straight sides is less
/// than half of one side.
const WIDEST_OPEN: f64 = 0.1;
/// Least number of places of a line that goes around something.
const LEAST_PLACES: usize = 3;

/// Greatest distances of places over which a line closes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// Distance of a tail from the head that it retraces, mm.
    retraced: f64,
    /// Widest gap that is closed, mm.
    close: f64,
}

impl Reach {
    pub(super) fn of(unit: f64, job: &Job) -> Self {
        Self { retraced: closing::reach(unit), close: job.profile.drawing.close_mm }
    }

    /// True if the edge of a rectangle would close an open line to a ring with an inside.
    pub(super) fn is_edged(&self, frame: &Extent, line: &Line, vertices: &[Vertex]) -> bool {
        let drawn = line.as_drawn(vertices);
        let ends = [drawn[0].at, drawn[drawn.len() - 1].at];
        along(frame, ends, self.close).is_some() && line.area > line.length * self.close.max(self.retraced)
    }
}

/// Determines how each line closes, and appends the rings to the vertices.
pub(super) fn close(lines: &mut [Line], vertices: &mut Vec<Vertex>, reach: Reach) {
    for line in lines.iter_mut() {
        if line.is_set_aside() {
            continue;
        }
        let drawn = line.as_drawn(vertices);
        if let Some(retrace) = closing::retrace(drawn.len(), |k| drawn[k].at, reach.retraced) {
            let ring: Vec<Vertex> = drawn[..=retrace.last].to_vec();
            *line = with_ring(line, vertices, Ring { places: ring, along: &[], closing: Closing::Retraced });
            continue;
        }
        // A gap in a small line is the mouth of a notch, or part of a letter.
        let gap = (drawn[drawn.len() - 1].at - drawn[0].at).norm();
        if line.size() <= SMALL_OUTLINE
            || gap == 0.0
            || drawn.len() < LEAST_PLACES
            || gap > reach.close.max(WIDEST_OPEN * line.length)
        {
            continue;
        }
        let closing = if gap <= reach.close { Closing::Gap(gap) } else { Closing::Open(gap) };
        // The area of an open line is that of its ring.
        if line.area > (line.length + gap) * gap.min(reach.close).max(reach.retraced) {
            let places = drawn.to_vec();
            *line = with_ring(line, vertices, Ring { places, along: &[], closing });
        }
    }
}

/// Closes lines whose ends lie on the same side of a frame, or on two adjacent sides: the frame draws the rest of them.
pub(super) fn close_along_frames(lines: &mut [Line], vertices: &mut Vec<Vertex>, reach: Reach) {
    let frames: Vec<Extent> = lines.iter().filter(|line| line.class == Class::Frame).map(|line| line.extent).collect();
    if frames.is_empty() {
        return;
    }
    for line in lines.iter_mut() {
        let is_open = matches!(line.closing, Closing::Drawn | Closing::Open(_)) && !line.is_closed;
        if !is_open || line.class != Class::Other || line.size() <= SMALL_OUTLINE {
            continue;
        }
        let drawn = line.as_drawn(vertices);
        let ends = [drawn[0].at, drawn[drawn.len() - 1].at];
        let Some(corners) = frames.iter().find_map(|frame| along(frame, ends, reach.close)) else { continue };
        let length = polyline::length(&[&[ends[1]][..], &corners, &[ends[0]]].concat());
        let ring = Ring { places: drawn.to_vec(), along: &corners, closing: Closing::Edge(length) };
        let before = vertices.len();
        let closed = with_ring(line, vertices, ring);
        if drawn_is_wide(&closed, reach) {
            *line = closed;
        } else {
            vertices.truncate(before);
        }
    }
}

/// True if a ring is more than a line along the edge.
fn drawn_is_wide(ring: &Line, reach: Reach) -> bool {
    ring.is_closed && ring.area > ring.length * reach.close.max(reach.retraced)
}

/// Corners between two places on a frame, along it: none or one. `None` if a place lies elsewhere, or if their sides are not
/// adjacent.
pub(super) fn along(frame: &Extent, ends: [Point; 2], reach: f64) -> Option<ArrayVec<Point, 1>> {
    let sides = ends.map(|at| {
        let off = [at.x - frame.min.x, frame.max.x - at.x, at.y - frame.min.y, frame.max.y - at.y];
        off.map(|mm| mm.abs() <= reach)
    });
    if !frame.grown(reach).holds(ends[0]) || !frame.grown(reach).holds(ends[1]) {
        return None;
    }
    if (0..4).any(|side| sides[0][side] && sides[1][side]) {
        return Some(ArrayVec::new());
    }
    let x = |on: [bool; 4]| [on[0], on[1]].iter().position(|&is| is).map(|k| [frame.min.x, frame.max.x][k]);
    let y = |on: [bool; 4]| [on[2], on[3]].iter().position(|&is| is).map(|k| [frame.min.y, frame.max.y][k]);
    let corner = |a: [bool; 4], b: [bool; 4]| Some(Point::new(x(a)?, y(b)?));
    corner(sides[0], sides[1]).or_else(|| corner(sides[1], sides[0])).map(|at| ArrayVec::from([at]))
}

/// Ring made of a line.
struct Ring<'a> {
    /// Places of the line in the ring.
    places: Vec<Vertex>,
    /// Places on the way back to the first of them.
    along: &'a [Point],
    closing: Closing,
}

/// Line with its ring, which is appended to the vertices. The closing segments get the span of the end of the line.
fn with_ring(line: &Line, vertices: &mut Vec<Vertex>, Ring { places, along, closing }: Ring) -> Line {
    let first = vertices.len() as u32;
    let (start, span) = (places[0].at, places[places.len() - 1].span);
    vertices.extend(places);
    vertices.extend(along.iter().copied().chain([start]).map(|at| Vertex { at, span }));
    line.as_ring(&vertices[first as usize..], first, closing)
}
