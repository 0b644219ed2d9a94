//! Notch: recognises the notches that outlines make, and lists them with their piece. The outlines keep them.
//!
//! Needs: welded contours without narrow boxes and spurs, which are slits. A notch is a stretch of a closed contour for which
//! all of this is true, to rounding:
//!
//! - it is a V (mouth 1 to 12 mm), a castle or a U (mouth 1.5 to 12 mm), 1.5 to 15 mm deep along its axis;
//! - its axis, from the middle of the mouth to that of the bottom, leans up to 60 degrees from the square to the mouth;
//! - the walls of a castle or U follow the axis within 10 degrees, its bottom is square to them or along the mouth;
//! - the outline comes to the mouth and leaves it within 30 degrees of the mouth's direction; at a V it may bend there, as a
//!   corner of the part does or where another notch begins, and turns by more than a right angle into the notch;
//! - it does not belong to a row of four or more with gaps narrower than their mouths: the teeth of a pinked hem;
//! - at least three vertices belong to none of the contour's notches.
//!
//! A stroke that a drawing draws from edge to edge is a notch whatever its measures; the pass `stroke` has listed it.
//!
//! So the point of a dart (too deep, or too wide), a corner, a row of teeth, a strap and a triangular cut-out are not notches.
//! A notch goes inwards if it is on the inner side of a contour that lies within none or two others of its piece, or on the
//! outer side of a cut-out. Any other protrudes; there is a warning if it protrudes over another piece.

mod mouth;

use std::borrow::Cow;
use std::cell::OnceCell;

use rayon::prelude::*;

use self::mouth::Mouth;
use super::pass::MarkerPass;
use super::search::{in_parts, search_ended};
use crate::analysis::nesting::Nesting;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::budget::Budget;
use crate::geom::region::Regions;
use crate::geom::{Point, polyline, ring};
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::{Marker, OutlineNotch};
use crate::machine::Job;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "notch", about: "finds the notches that outlines make, and leaves them there", run };

/// Vertices that must belong to no notch.
const LEAST_OTHERS: usize = 3;
/// Greatest number of notches in a row with gaps narrower than their mouths: double and triple notches tell a back from a
/// front.
const MOST_BESIDE: usize = 3;
/// Cost of a vertex when cut-outs are told from parts, relative to the comparison of two boxes. When the budget of a drawing
/// made to be slow is spent, the rest counts as parts.
const VERTEX: usize = 4;
/// Depth of a notch in another piece without a warning, mm, in addition to the diagonal of the file's unit: pieces that touch.
const TOUCH: f64 = 0.2;
/// Decimals of depths in messages, mm.
const DEPTH_DECIMALS: u32 = 1;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { pieces, list, unit, .. } = marker;
    let size = in_parts(pieces.len()).size;
    pieces.par_chunks_mut(size).for_each(|pieces| {
        let mut found: Vec<Found> = Vec::with_capacity(pieces.len());
        for piece in &mut *pieces {
            let said = std::mem::take(&mut piece.outline_notches);
            let nesting = OnceCell::new();
            for (k, contour) in piece.contours.iter().enumerate().filter(|(_, contour)| contour.closed) {
                let outline = Outline::of(list, contour.range, *unit, &said);
                if outline.mouths.is_empty() && outline.said.is_empty() {
                    continue;
                }
                let counter_clockwise = ring::area(outline.ring()) > 0.0;
                // Cut-outs are found within the piece alone: two jobs in one file may overlap.
                let nesting = nesting.get_or_init(|| Nesting::of_piece(list, piece));
                let is_left = counter_clockwise != nesting.is_inner(k);
                let mouths = outline.notches(is_left);
                if mouths.is_empty() {
                    continue;
                }
                piece.outline_notches.reserve_exact(mouths.len());
                piece.outline_notches.extend(mouths.iter().map(|mouth| outline.notch(mouth, is_left)));
                let tips = mouths.iter().map(|mouth| mouth.deepest).collect();
                found.push(Found { spans: list.spans(outline.range), tips });
            }
        }
        // Spans are read in one sweep: blocks are far from points in memory, and this way no read waits for another.
        let spans = found.iter().flat_map(Found::spans);
        let notches = pieces.iter_mut().flat_map(|piece| &mut piece.outline_notches);
        notches.zip(spans).for_each(|(notch, span)| notch.span = span);
    });
    warn_of_neighbours(marker, diagnostics);
}

/// The notches of an outline.
struct Found<'a> {
    /// Source spans of its segments.
    spans: Cow<'a, [Span]>,
    /// Indices of the vertices at their tips.
    tips: Vec<usize>,
}

impl Found<'_> {
    /// Source spans of the segments that lead to the tips.
    fn spans(&self) -> impl Iterator<Item = Span> {
        self.tips.iter().map(|tip| self.spans[tip.checked_sub(1).unwrap_or(self.spans.len() - 1)])
    }
}

/// A closed contour.
struct Outline<'a> {
    range: Range,
    /// Its points; the last is the first again.
    points: Cow<'a, [Point]>,
    /// Candidates for notches, on either side.
    mouths: Vec<Mouth>,
    /// Notches that the drawing declares.
    said: Vec<Mouth>,
}

impl<'a> Outline<'a> {
    fn of(list: &'a SegmentList, range: Range, unit: f64, said: &[OutlineNotch]) -> Self {
        let points = list.points(range);
        let mouths = if points.len() > LEAST_OTHERS + 3 { mouth::find(&points, unit) } else { Vec::new() };
        let mut outline = Self { range, points, mouths, said: Vec::new() };
        let found = said.iter().filter_map(|notch| mouth::said(&outline.points, unit, outline.place(notch)?));
        outline.said = found.collect();
        outline
    }

    /// First vertex and number of segments of a notch; `None` if other passes have changed it.
    fn place(&self, notch: &OutlineNotch) -> Option<[usize; 2]> {
        let count = self.points.len() - 1;
        let first = (0..count).find(|&i| self.points[i] == notch.mouth[0])?;
        let segments = (2..count).find(|k| self.at(first + k) == notch.mouth[1])?;
        (segments <= notch.segments as usize).then_some([first, segments])
    }

    /// Its vertices, the first not repeated.
    fn ring(&self) -> &[Point] {
        &self.points[..self.points.len() - 1]
    }

    /// A vertex; indices may be up to three times the count.
    fn at(&self, i: usize) -> Point {
        let count = self.points.len() - 1;
        self.points[if i < count { i } else { i % count }]
    }

    /// A notch, given whether the part is on the left.
    fn notch(&self, mouth: &Mouth, is_left: bool) -> OutlineNotch {
        let Mouth { first, segments, form, tip, is_left: notch_is_left, .. } = *mouth;
        OutlineNotch {
            form,
            outwards: notch_is_left != is_left,
            mouth: [self.at(first), self.at(first + segments)],
            tip,
            segments: u32::try_from(segments).expect("a notch has few segments"),
            span: Span::default(),
        }
    }

    /// Its notches in order, given whether its part is on the left.
    fn notches(&self, is_left: bool) -> Vec<Mouth> {
        let count = self.points.len() - 1;
        let [inward, outward] = [true, false].map(|is_inward| {
            let there = self.mouths.iter().filter(|mouth| (mouth.is_left == is_left) == is_inward);
            self.apart(there.copied())
        });
        let mut kept: Vec<Mouth> = match [&inward[..], &outward[..]] {
            // In nearly all outlines all notches go one way.
            [all, []] | [[], all] => self.alone(all).into_iter().flatten().collect(),
            [inward, outward] => {
                let selected = selected([inward, outward], count);
                let kept = [inward, outward].map(|all| self.alone(all)).concat().into_iter().zip(selected.concat());
                kept.filter_map(|(mouth, is_selected)| mouth.filter(|_| is_selected)).collect()
            }
        };
        kept.sort_by_key(|mouth| mouth.first);
        let touching = kept.iter().zip(kept.iter().cycle().skip(1));
        let touching = touching.filter(|(one, next)| (one.first + one.segments) % count == next.first).count();
        if kept.iter().map(|mouth| mouth.segments + 1).sum::<usize>() - touching + LEAST_OTHERS > count {
            kept.clear();
        }
        if !self.said.is_empty() {
            kept.retain(|mouth| !self.said.iter().any(|said| said.overlaps(mouth, count)));
            kept.extend(&self.said);
            kept.sort_by_key(|mouth| mouth.first);
        }
        kept
    }

    /// Among notches that share a segment, keeps the one with the shortest length.
    fn apart(&self, mouths: impl Iterator<Item = Mouth>) -> Vec<Mouth> {
        let count = self.points.len() - 1;
        let length = |mouth: &Mouth| {
            (mouth.first..mouth.first + mouth.segments).map(|i| (self.at(i + 1) - self.at(i)).norm()).sum::<f64>()
        };
        let mut kept: Vec<Mouth> = Vec::new();
        for mouth in mouths {
            match kept.last_mut() {
                Some(last) if mouth.first < last.first + last.segments => {
                    if length(&mouth) < length(last) {
                        *last = mouth;
                    }
                }
                Some(_) | None => kept.push(mouth),
            }
        }
        // The last may reach over the start of the outline to the first.
        if let [first, .., last] = kept[..]
            && last.first + last.segments > count + first.first
        {
            if length(&last) < length(&first) {
                kept.remove(0);
            } else {
                kept.pop();
            }
        }
        kept
    }

    /// Notches of one side without rows of teeth.
    fn alone(&self, all: &[Mouth]) -> Vec<Option<Mouth>> {
        let count = self.points.len() - 1;
        // True if a notch and the next one, round the ring, have a gap narrower than their mouths.
        let is_crowded = |k: usize| {
            let (mouth, next) = (all[k], all[(k + 1) % all.len()]);
            let width = |mouth: &Mouth| (self.at(mouth.first + mouth.segments) - self.at(mouth.first)).norm();
            let end = mouth.first + mouth.segments;
            // A notch alone has the whole ring before itself.
            let flat = (next.first + 2 * count - end - 1) % count + 1;
            let flat = if next.first == end % count { 0 } else { flat };
            let most = width(&mouth).max(width(&next));
            let mut length = 0.0;
            (0..flat).all(|step| {
                length += (self.at(end + step + 1) - self.at(end + step)).norm();
                length < most
            })
        };
        let crowded: Vec<bool> = (0..all.len()).map(is_crowded).collect();
        // A row ends with a notch that is far from the next one; without such a notch all are one row.
        let start = crowded.iter().rposition(|is| !is).map_or(0, |k| k + 1);
        let mut kept = vec![None; all.len()];
        let mut row = Vec::new();
        for k in (0..all.len()).map(|k| (start + k) % all.len()) {
            row.push(k);
            if !crowded[k] || row.len() == all.len() {
                let is_few = row.len() <= MOST_BESIDE;
                row.drain(..).filter(|_| is_few).for_each(|k| kept[k] = Some(all[k]));
            }
        }
        kept
    }
}

/// Selection among notches of both sides. The edge between two notches looks like a notch to the other side, so in a row that
/// shares segments the sides alternate and one side is kept: that of both ends where they agree, else that of the end with the
/// straighter edge.
fn selected(sides: [&[Mouth]; 2], count: usize) -> [Vec<bool>; 2] {
    let mut all: Vec<(usize, usize)> = (0..2).flat_map(|side| (0..sides[side].len()).map(move |k| (side, k))).collect();
    let mouth = |(side, k): (usize, usize)| sides[side][k];
    all.sort_by_key(|&place| mouth(place).first);
    // True if a segment is shared with the next notch, by this one or by a longer one before it, round the ring.
    let mut reach = 0;
    let shares = |i: usize| {
        let [this, next] = [all[i], all[(i + 1) % all.len()]].map(mouth);
        let start = if i + 1 < all.len() { next.first } else { next.first + count };
        reach = reach.max(this.first + this.segments);
        all.len() > 1 && start < reach
    };
    let shared: Vec<bool> = (0..all.len()).map(shares).collect();
    let mut selected = sides.map(|side| vec![true; side.len()]);
    // A row begins after a notch that shares nothing; a gear, in which all share, begins anywhere.
    let begin = shared.iter().rposition(|shares| !shares).map_or(0, |i| i + 1);
    let mut row: Vec<(usize, usize)> = Vec::new();
    for i in (0..all.len()).map(|i| (begin + i) % all.len()) {
        row.push(all[i]);
        if shared[i] && row.len() < all.len() {
            continue;
        }
        let ends = [row[0], row[row.len() - 1]];
        let [first, last] = ends.map(|place| mouth(place).askew);
        let is_first = ends[0].0 == ends[1].0 || first < last || first == last && ends[0].0 == 0;
        let side = if is_first { ends[0].0 } else { ends[1].0 };
        row.drain(..).filter(|place| place.0 != side).for_each(|(side, k)| selected[side][k] = false);
    }
    selected
}

/// A notch over another piece.
struct Over {
    depth: f64,
    notch: OutlineNotch,
    /// Indices of its own piece and of the piece that it is cut into.
    pieces: [usize; 2],
}

/// Reports the number of protruding notches over other pieces, and the deepest of them.
fn warn_of_neighbours(marker: &Marker, diagnostics: &mut Diagnostics) {
    let stands_out = |notch: &&OutlineNotch| notch.outwards;
    let notches = marker.pieces.iter().enumerate();
    let out = notches.flat_map(|(i, piece)| piece.outline_notches.iter().filter(stands_out).map(move |n| (i, *n)));
    let out: Vec<(usize, OutlineNotch)> = out.collect();
    if out.is_empty() {
        return; // as in most files
    }
    let closed = |i: usize| marker.pieces[i].contours.iter().filter(|contour| contour.closed);
    let rings = |i: u32| closed(i as usize).map(|contour| marker.list.points(contour.range)).collect();
    let regions = Regions::new(0..marker.pieces.len() as u32, rings);
    let mut work = Budget::of_a_marker();
    let depth_in = |piece: usize, at: Point| {
        let edges = closed(piece).flat_map(|contour| marker.list.lines(contour.range));
        edges.map(|[a, b]| polyline::distance_to_segment(at, a, b)).fold(f64::INFINITY, f64::min)
    };
    let mut over: Vec<Over> = Vec::new();
    for (own, notch) in out {
        let at = notch.tip;
        if !work.spend(regions.cost_at(at)) {
            diagnostics.push(search_ended("more notches may stand out into other pieces, unsaid"));
            break;
        }
        let others = regions.owners_at(at).into_iter().map(|owner| owner as usize).filter(|&other| other != own);
        let others: Vec<usize> = others.collect();
        work.spend(
            others.iter().flat_map(|&piece| closed(piece)).map(|c| VERTEX * marker.list.points(c.range).len()).sum(),
        );
        let others = others.into_iter();
        let deepest = others.map(|other| (depth_in(other, at), other)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((depth, other)) =
            deepest.filter(|(depth, _)| *depth > TOUCH.max(std::f64::consts::SQRT_2 * marker.unit))
        {
            // The depth is at most that of the notch.
            over.push(Over { depth: depth.min(notch.depth()), notch, pieces: [own, other] });
        }
    }
    let Some(worst) = over.iter().reduce(|a, b| if b.depth > a.depth { b } else { a }) else { return };
    let [own, other] = worst.pieces.map(|i| marker.pieces[i].number);
    let depth = fixed(worst.depth, DEPTH_DECIMALS);
    let message = if over.len() == 1 {
        format!("a notch that stands out of piece {own} lies {depth} mm deep in piece {other}")
    } else {
        let count = over.len();
        format!(
            "{count} notches stand out into other pieces, farthest that of piece {own}: {depth} mm deep in piece {other}"
        )
    };
    let finding = Diagnostic::new(&code::MARKER_NOTCH_OVER, message)
        .at(worst.notch.span)
        .by(worst.depth)
        .on_cloth(worst.notch.tip);
    diagnostics
        .push(finding.hint("move the pieces apart, or have notches cut into their own part: notch.style = \"slit\""));
}
