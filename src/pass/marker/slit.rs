//! Slit: short strokes at an outline become slit notches, and a short stroke over the tip of one becomes its crossbar.
//!
//! Needs: welded contours. Files write slits as strokes of their own, too: before the contour, at a vertex or within a
//! segment of it, or there and back. A stroke is a contour of two places that are [`Notch::LONGEST`] apart at most.
//!
//! - One that starts on an outline of its piece is a slit.
//! - One that the tip of a slit divides is the crossbar of a T.
//! - Any other stays an open contour, as do all longer ones: internal lines, darts, outlines with a gap.
//!
//! Leaves true: notches in the order of the file; none without length, and no slit twice, whichever way round. Plain
//! polylines, which lie on no grid, have no notches.

use std::collections::BTreeSet;

use super::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, bits, polyline};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Marker, Notch, NotchKind, Piece, Stroke};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "slit", about: "makes notches of short strokes at an outline, and cuts none twice", run };

/// Distances that one marker may cost: far more than real ones need. In a drawing made to be slow, the strokes that are
/// left stay open contours, which is how they are cut anyway.
const MOST_WORK: usize = 20_000_000;
/// How far the rounding of two points to a grid may move one against the other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, unit, .. } = marker;
    let mut near = Near { slack: ROUNDING * *unit, work: MOST_WORK };
    for piece in pieces {
        let mut shorts: Vec<Short> = if *unit > 0.0 {
            piece.contours.iter().zip(0..).filter_map(|(contour, i)| short(list, contour, i)).collect()
        } else {
            Vec::new()
        };
        take_slits(list, piece, &mut shorts, &mut near);
        drop_doubles(piece, diagnostics);
        take_crossbars(piece, &mut shorts, &mut near, diagnostics);
        let mut taken = shorts.iter().filter(|short| short.taken).map(|short| short.contour).peekable();
        let mut place = 0..;
        piece.contours.retain(|_| taken.next_if_eq(&place.next().expect("it never ends")).is_none());
    }
}

/// A contour that is a stroke.
#[derive(Debug, Clone, Copy)]
struct Short {
    stroke: Stroke,
    percent: u8,
    /// Its place among the contours of the piece.
    contour: usize,
    /// Whether it is part of a notch now.
    taken: bool,
}

/// A contour as a stroke, if it goes between two near places only.
fn short(list: &SegmentList, contour: &Contour, place: usize) -> Option<Short> {
    let (_, first) = list.walk(contour.range).next()?;
    let stroke = Stroke { from: first.from, to: first.to, span: first.span };
    let mut percent = first.percent;
    for (_, segment) in list.walk(contour.range) {
        if segment.to != stroke.from && segment.to != stroke.to {
            return None;
        }
        percent = percent.min(segment.percent);
    }
    (stroke.length() <= Notch::LONGEST).then_some(Short { stroke, percent, contour: place, taken: false })
}

/// Makes slits of the strokes that start on a closed contour.
fn take_slits(list: &SegmentList, piece: &mut Piece, shorts: &mut [Short], near: &mut Near) {
    if shorts.is_empty() {
        return;
    }
    let starts = sorted(shorts.iter().map(|short| short.stroke.from));
    let outlines = piece.contours.iter().filter(|contour| contour.closed && short(list, contour, 0).is_none());
    for (_, segment) in outlines.flat_map(|contour| list.walk(contour.range)) {
        near.each(&starts, [segment.from, segment.to], |i| shorts[i].taken = true);
    }
    for Short { stroke, percent, .. } in shorts.iter().filter(|short| short.taken) {
        let Stroke { from: root, to: tip, span } = *stroke;
        piece.notches.push(Notch { kind: NotchKind::Slit, root, tip, percent: *percent, span });
    }
    piece.notches.sort_by_key(|notch| notch.span); // stable: what comes from no block keeps its order
}

/// Gives the strokes that the tip of a slit divides to that slit.
fn take_crossbars(piece: &mut Piece, shorts: &mut [Short], near: &mut Near, diagnostics: &mut Diagnostics) {
    let tips = sorted(piece.notches.iter().map(|notch| notch.tip));
    for short in shorts.iter_mut().filter(|short| !short.taken) {
        let Short { stroke: bar, percent, .. } = *short;
        let slack = near.slack;
        near.each(&tips, [bar.from, bar.to], |i| {
            let notch = &mut piece.notches[i];
            let divides = (notch.tip - bar.from).norm().min((notch.tip - bar.to).norm()) > slack;
            if short.taken || !divides {
                return;
            }
            match notch.kind {
                NotchKind::Slit => {
                    (notch.kind, notch.percent) = (NotchKind::T(bar), notch.percent.min(percent));
                    short.taken = true;
                }
                NotchKind::T(other) if ends(bar.from, bar.to) == ends(other.from, other.to) => {
                    let message = format!("the same crossbar stands twice in piece {}; it is cut once", piece.number);
                    diagnostics.push(Diagnostic::new(&code::MARKER_SLIT_TWICE, message).at(bar.span));
                    short.taken = true;
                }
                NotchKind::T(_) => {}
            }
        });
    }
}

/// Takes out slits without length and slits that stand twice, whichever way round.
fn drop_doubles(piece: &mut Piece, diagnostics: &mut Diagnostics) {
    let mut seen = BTreeSet::new();
    let number = piece.number;
    piece.notches.retain(|notch| {
        let ends = ends(notch.root, notch.tip);
        let is_new = seen.insert(ends);
        let finding = if ends[0] == ends[1] {
            Diagnostic::new(&code::MARKER_SLIT_NO_LENGTH, format!("a slit of piece {number} has no length"))
        } else if !is_new && notch.kind == NotchKind::Slit {
            let message = format!("the same slit stands twice in piece {number}; it is cut once");
            Diagnostic::new(&code::MARKER_SLIT_TWICE, message)
        } else {
            return true;
        };
        diagnostics.push(finding.at(notch.span));
        false
    });
}

/// Two places, the same whichever comes first.
fn ends(a: Point, b: Point) -> [[u64; 2]; 2] {
    let mut ends = [a, b].map(bits);
    ends.sort_unstable();
    ends
}

/// Points by their X, each with its place in the order that they came in.
fn sorted(points: impl Iterator<Item = Point>) -> Vec<(Point, usize)> {
    let mut points: Vec<(Point, usize)> = points.zip(0..).collect();
    points.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    points
}

/// Looks for points near segments.
struct Near {
    /// Farthest from the segment, mm.
    slack: f64,
    /// Distances that may still be taken.
    work: usize,
}

impl Near {
    /// Calls `found` with the place of each point that lies on the segment between two ends.
    fn each(&mut self, points: &[(Point, usize)], [a, b]: [Point; 2], mut found: impl FnMut(usize)) {
        let (least, greatest) = (a.x.min(b.x) - self.slack, a.x.max(b.x) + self.slack);
        let first = points.partition_point(|point| point.0.x < least);
        for &(point, place) in points[first..].iter().take_while(|point| point.0.x <= greatest) {
            self.work = self.work.saturating_sub(1);
            if self.work == 0 {
                return;
            }
            if polyline::distance_to_segment(point, a, b) <= self.slack {
                found(place);
            }
        }
    }
}
