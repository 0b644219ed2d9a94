//! Notch: recognises V notches by their shape and lists them with their piece. The outline keeps them.
//!
//! Needs: welded contours. A V notch is three vertices of a closed contour, of which all of this is true:
//!
//! - the middle one, the apex, lies 2 to 15 mm from the middle of the mouth, and inside the part: on the inner side of a
//!   contour that lies within none or two others of its piece, on the outer side of a cut-out;
//! - the mouth is no wider than that depth, and the legs are equal within a quarter;
//! - the outline comes to the mouth and leaves it within 30 degrees of the mouth's direction;
//! - on either side the next notch is farther than the mouth is wide: closer ones are the teeth of a pinked hem;
//! - three vertices at least belong to none of the contour's notches.
//!
//! So the point of a dart (too deep, or too wide), a corner, a row of teeth and a triangular cut-out are none.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::f64::consts::PI;

use rayon::prelude::*;

use super::{MarkerPass, in_parts};
use crate::diagnostic::Diagnostics;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, angle, cross, ring};
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::{Marker, Vee};
use crate::machine::Job;
use crate::source::Span;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "notch", about: "finds V notches by their shape, and leaves them on the outline", run };

/// How far the outline may turn where the mouth begins or ends, rad.
const MOUTH_TURN: f64 = PI / 6.0;
/// Vertices that must belong to no notch.
const LEAST_OTHERS: usize = 3;
/// How many vertices are looked at for the direction at a mouth: a guard against outlines that are a tangle.
const MOST_STEPS: usize = 64;
/// What a vertex that is looked at to tell cut-outs from parts costs beside the comparison of two boxes. In a drawing made to
/// be slow, what is left counts as a part.
const VERTEX: usize = 4;
/// How far the rounding of two points to a grid may move one against the other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;

fn run(marker: &mut Marker, _: &Job, _: &mut Diagnostics) {
    let Marker { pieces, list, unit, .. } = marker;
    let parts = in_parts(pieces.len());
    pieces.par_chunks_mut(parts.size).for_each(|pieces| {
        let mut outlines: Vec<Outline> = Vec::new();
        let mut found: Vec<Found> = Vec::with_capacity(pieces.len());
        let mut work = parts.budget();
        for piece in &mut *pieces {
            outlines.clear();
            let closed = piece.contours.iter().filter(|contour| contour.closed);
            outlines.extend(closed.map(|contour| Outline::of(list, contour.range, *unit)));
            piece.vees.clear();
            for (k, outline) in outlines.iter().enumerate().filter(|(_, outline)| !outline.apexes.is_empty()) {
                let counter_clockwise = ring::area(outline.ring()) > 0.0;
                let is_left = counter_clockwise != is_cut_out(&outlines, k, &mut work);
                let part = if is_left { Side::Left } else { Side::Right };
                let vees = outline.vees(part);
                if vees.is_empty() {
                    continue;
                }
                piece.vees.reserve_exact(vees.len());
                piece.vees.extend(vees.iter().map(|(_, vee)| vee));
                let apexes = vees.iter().map(|&(apex, _)| apex).collect();
                found.push(Found { spans: list.spans(outline.range), apexes });
            }
        }
        // All in a row, since blocks stand far from points in memory: then none waits for the one before.
        let spans = found.iter().flat_map(Found::spans);
        pieces.iter_mut().flat_map(|piece| &mut piece.vees).zip(spans).for_each(|(vee, span)| vee.span = span);
    });
}

/// The notches of an outline.
struct Found<'a> {
    /// The blocks of its segments.
    spans: Cow<'a, [Span]>,
    /// The vertices that are apexes.
    apexes: Vec<usize>,
}

impl Found<'_> {
    /// The blocks that the apexes came from: those of the segments that lead there.
    fn spans(&self) -> impl Iterator<Item = Span> {
        self.apexes.iter().map(|apex| self.spans[apex.checked_sub(1).unwrap_or(self.spans.len() - 1)])
    }
}

/// The side of an outline, seen along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// A closed contour.
struct Outline<'a> {
    range: Range,
    /// Its points; the last is the first again.
    points: Cow<'a, [Point]>,
    /// The box around it, once it was asked for.
    extent: OnceCell<Extent>,
    /// Vertices that may be an apex, whichever side the part is on.
    apexes: Vec<usize>,
}

impl<'a> Outline<'a> {
    fn of(list: &'a SegmentList, range: Range, unit: f64) -> Self {
        let points = list.points(range);
        let apexes = apexes(&points, unit);
        Self { range, extent: OnceCell::new(), apexes, points }
    }

    fn extent(&self) -> &Extent {
        self.extent.get_or_init(|| Extent::of(&self.points))
    }

    /// Its vertices, the first not repeated.
    fn ring(&self) -> &[Point] {
        &self.points[..self.points.len() - 1]
    }

    /// Its notches, when its part lies on the given side, each with the vertex that is its apex.
    fn vees(&self, part: Side) -> Vec<(usize, Vee)> {
        let points = self.ring();
        let count = points.len();
        let vee = |&i: &usize| {
            let at = Around { points, i };
            (i, Vee { apex: points[i], mouth: [at.back(1), at.ahead(1)], span: Span::default() })
        };
        let is_inside = |vee: &Vee| {
            let apex_is_left = cross(vee.mouth[1] - vee.mouth[0], vee.apex - vee.mouth[0]) > 0.0;
            apex_is_left == (part == Side::Left)
        };
        let all: Vec<(usize, Vee)> = self.apexes.iter().map(vee).filter(|(_, vee)| is_inside(vee)).collect();
        // Whether the notch `k` and the next one, round the ring, are teeth in a row.
        let is_crowded = |k: usize| {
            let ((i, vee), (next, following)) = (all[k], all[(k + 1) % all.len()]);
            let steps = (next + count - i - 1) % count + 1;
            let width = vee.width().max(following.width());
            // The flat between them has `steps - 2` segments; a notch alone has the whole ring before itself.
            let at = Around { points, i };
            let flat = (1..steps.saturating_sub(1)).map(|s| (at.ahead(s + 1) - at.ahead(s)).norm());
            flat.scan(0.0, |sum, length| {
                *sum += length;
                Some(*sum)
            })
            .all(|length| length < width)
        };
        let crowded: Vec<bool> = (0..all.len()).map(is_crowded).collect();
        let alone = |k: usize| !crowded[k] && !crowded[(k + all.len() - 1) % all.len()];
        let mut kept: Vec<(usize, Vee)> = (0..all.len()).filter(|&k| alone(k)).map(|k| all[k]).collect();
        // Notches that stand apart share no vertex.
        if 3 * kept.len() + LEAST_OTHERS > count {
            kept.clear();
        }
        kept
    }
}

/// Whether an outline bounds a hole: an odd number of others of the piece hold it. Other pieces do not matter, since two
/// jobs in one file may lie on each other.
fn is_cut_out(outlines: &[Outline], k: usize, work: &mut Budget) -> bool {
    let point = outlines[k].points[0];
    let holds = |(i, other): &(usize, &Outline)| {
        let is_near = *i != k && other.extent().holds(point);
        work.spend(VERTEX * if is_near { other.ring().len() } else { 1 })
            && is_near
            && ring::contains(other.ring(), point)
    };
    outlines.iter().enumerate().filter(holds).count() % 2 == 1
}

/// The vertices of a ring, whose last point is the first again, that have the shape of an apex.
fn apexes(points: &[Point], unit: f64) -> Vec<usize> {
    let mut apexes = Vec::new();
    let count = points.len() - 1;
    if count < 3 + LEAST_OTHERS {
        return apexes;
    }
    let mut from = points[count - 1];
    for (i, ends) in points.windows(2).enumerate() {
        let (apex, to) = (ends[0], ends[1]);
        let vee = Vee { apex, mouth: [from, to], span: Span::default() };
        if may_be_legs(from - apex, to - apex) && vee.has_shape() && is_on_edge(&points[..count], i, unit) {
            apexes.push(i);
        }
        from = apex;
    }
    apexes
}

/// Whether two segments may be the legs of a notch, from its apex: by their squares alone, where nearly all end.
fn may_be_legs(back: Vector, ahead: Vector) -> bool {
    // A notch turns by more than a right angle, since it is no wider than deep.
    if back.dot(&ahead) <= 0.0 {
        return false;
    }
    let (back, ahead) = (back.norm_squared(), ahead.norm_squared());
    let (shorter, longer) = if back < ahead { (back, ahead) } else { (ahead, back) };
    longer <= Vee::LEG_RATIO.powi(2) * shorter && shorter >= Vee::LEAST_DEPTH.powi(2)
}

/// Whether the outline comes to the legs at a vertex, and leaves them, as it does at an apex.
fn is_on_edge(points: &[Point], i: usize, unit: f64) -> bool {
    let at = Around { points, i };
    let (before, after) = (at.back(1), at.ahead(1));
    let mouth = after - before;
    let width = mouth.norm();
    let most = MOUTH_TURN + (ROUNDING * unit).atan2(width);
    // Near the mouth an outline may have very short segments, whose direction is that of the grid; a stretch as long as
    // the mouth is wide has its own.
    let goes_on = |from: Point, next: &dyn Fn(usize) -> Point, sign: f64| {
        (1..(points.len() - 2).min(MOST_STEPS))
            .map(|step| (next(step) - from) * sign)
            .scan(false, |far, way: Vector| {
                let was_far = std::mem::replace(far, way.norm() >= width);
                (!was_far).then_some(way)
            })
            .any(|way| !angle::is_turned(way, mouth, most))
    };
    goes_on(before, &|step| at.back(1 + step), -1.0) && goes_on(after, &|step| at.ahead(1 + step), 1.0)
}

/// The vertices of a ring, seen from one of them: once round it at the most, either way.
struct Around<'a> {
    points: &'a [Point],
    i: usize,
}

impl Around<'_> {
    fn ahead(&self, steps: usize) -> Point {
        let place = self.i + steps;
        self.points[place.checked_sub(self.points.len()).unwrap_or(place)]
    }

    fn back(&self, steps: usize) -> Point {
        self.points[self.i.checked_sub(steps).unwrap_or(self.i + self.points.len() - steps)]
    }
}
