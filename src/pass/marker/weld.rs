//! Weld: joins chains of segments that the file interrupts into the intended contours.
//!
//! Needs: contours as the reader left them, walked in list order, with `closed` undefined. Leaves true: no segment of length
//! zero; within a piece no open contour that a later open one continues exactly; `closed` exactly if the ends meet. Contours
//! keep the order of their first chains. Chains that make a ring in either direction, except for a unit of the file, are joined and
//! meet halfway ([`sides`]).

use std::collections::BTreeSet;

use super::pass::MarkerPass;
use super::sides;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, Vector, bits};
use crate::ir::list::{Joint, Range, SegmentList};
use crate::ir::marker::{Contour, Marker, Piece};
use crate::machine::Job;
use crate::source::Span;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "weld", about: "drops equal points and joins what the file interrupts", run };

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let mut dropped = Dropped {
        longest: if marker.unit > 0.0 {
            LENGTH_EPSILON
        } else {
            OFF_GRID.min(OFF_GRID_PART * job.profile.tolerance(0.0))
        },
        ..Dropped::default()
    };
    for piece in &mut marker.pieces {
        let number = piece.number;
        piece.contours.retain_mut(|contour| {
            let before = dropped.count;
            let kept = drop_equal_points(&mut marker.list, &mut contour.range, &mut dropped);
            // Some files move the knife by a single point; several points suggest that something was drawn there.
            if !kept && dropped.count - before > 1 {
                let (_, first) = marker.list.walk(contour.range).next().expect("a range is never empty");
                let message = format!("a contour of piece {number} has no length: all its points are the same");
                diagnostics.push(Diagnostic::new(&code::MARKER_NO_LENGTH, message).at(first.span));
            }
            kept
        });
        join(&mut marker.list, piece);
        if piece.contours.iter().any(|contour| !contour.closed) {
            sides::join(&mut marker.list, piece, marker.unit.max(OFF_GRID), seam);
        }
    }
    dropped.report(diagnostics);
}

/// Greatest length of an empty segment, mm: rounding of computed places, such as the ends of arcs.
const LENGTH_EPSILON: f64 = 1e-6;
/// Distance within which points merge if numbers are on no grid, mm, and its limit as a share of the tolerance. Such files are
/// written with two or three decimals; programs that offset, join or mirror outlines leave points there that go a few
/// micrometres on or back, each of which would be a corner.
const OFF_GRID: f64 = 0.01;
const OFF_GRID_PART: f64 = 0.25;

/// Removed segments without length.
#[derive(Default)]
struct Dropped {
    /// Greatest length, mm.
    longest: f64,
    count: usize,
    first: Option<Span>,
}

impl Dropped {
    fn add(&mut self, span: Span) {
        self.count += 1;
        self.first.get_or_insert(span);
    }

    fn report(&self, diagnostics: &mut Diagnostics) {
        let Some(first) = self.first else { return };
        let (points, verb) = if self.count == 1 { ("point", "repeats") } else { ("points", "repeat") };
        let within = if self.longest > LENGTH_EPSILON { format!(" within {} mm", self.longest) } else { String::new() };
        let message =
            format!("{} {points} {verb} the one before{within}; the first is in block {}", self.count, first.block);
        diagnostics.push(Diagnostic::new(&code::MARKER_EQUAL_POINTS, message).at(first));
    }
}

/// Removes the segments without length from a range; returns `false`, with one segment left, if there are no others.
///
/// Codes of the file at a removed segment apply at that point, where the next segment starts. The end of the contour has no
/// segment of its own: its joint is the first segment's.
fn drop_equal_points(list: &mut SegmentList, range: &mut Range, dropped: &mut Dropped) -> bool {
    let longest = dropped.longest;
    let has_length = |way: Vector| has_length(way, longest);
    // Nearly all segments have a length, and already along X.
    let is_long = |(from, to): (&Point, &Point)| (to.x - from.x).abs() > longest || has_length(to - from);
    let points = list.points(*range);
    if points.iter().zip(&points[1..]).all(is_long) {
        return true;
    }
    let mut cursor = list.cursor(range);
    let mut carried = Joint::default();
    loop {
        let segment = cursor.segment();
        if has_length(segment.to - segment.from) {
            carry(cursor.joint_mut(), carried);
            carried = Joint::default();
            if !cursor.advance() {
                return true;
            }
            continue;
        }
        dropped.add(segment.span);
        carry(&mut carried, segment.joint);
        let was_last = cursor.is_last();
        if !cursor.remove() {
            return false;
        }
        // The remaining segments stay connected.
        if was_last {
            *cursor.to_mut() = segment.to;
            break;
        }
        *cursor.from_mut() = segment.from;
    }
    let end = cursor.segment().to;
    let mut first = list.cursor(range);
    let closed = first.segment().from == end;
    // At the end of an open contour the knife is lifted anyway and does not come down again: only the overcut matters.
    carry(
        first.joint_mut(),
        if closed { carried } else { Joint { no_overcut: carried.no_overcut, ..Joint::default() } },
    );
    true
}

/// True if a vector is longer than `longest`, mm; the components are tested first.
fn has_length(way: Vector, longest: f64) -> bool {
    (way.x.abs() > longest) | (way.y.abs() > longest) || way.norm() > longest
}

fn carry(joint: &mut Joint, carried: Joint) {
    joint.lift |= carried.lift;
    joint.full_advance |= carried.full_advance;
    joint.no_overcut |= carried.no_overcut;
}

/// Marks the closed chains of a piece, and joins the others.
fn join(list: &mut SegmentList, piece: &mut Piece) {
    for contour in &mut piece.contours {
        let [start, end] = list.ends_of(contour.range);
        contour.closed = start == end;
    }
    if piece.contours.iter().filter(|contour| !contour.closed).count() > 1 {
        join_open(list, piece);
    }
}

/// Start of a chain, by the bits of its coordinates, and its index among the contours.
type Start = ([u64; 2], usize);

/// Joins the open chains of a piece. A chain takes the first later one that starts at its end, until it closes or none does. A
/// chain that runs into an earlier one stays separate, since the file wants the earlier one cut first.
fn join_open(list: &mut SegmentList, piece: &mut Piece) {
    let chains: Vec<([Point; 2], Range)> = piece.contours.iter().map(|c| (list.ends_of(c.range), c.range)).collect();
    let open = |i: usize| chains[i].0[0] != chains[i].0[1];
    let mut starts: BTreeSet<Start> =
        (0..chains.len()).filter(|&i| open(i)).map(|i| (bits(chains[i].0[0]), i)).collect();
    let mut taken = vec![false; chains.len()];
    piece.contours.clear();
    for (i, &([start, mut end], mut range)) in chains.iter().enumerate() {
        if taken[i] {
            continue;
        }
        starts.remove(&(bits(start), i));
        while start != end {
            let here = bits(end);
            let Some(&(_, next)) = starts.range((here, i)..=(here, usize::MAX)).next() else { break };
            let Some(joined) = list.join(range, chains[next].1) else { break };
            seam(list, range, chains[next].1);
            starts.remove(&(here, next));
            taken[next] = true;
            range = joined;
            end = chains[next].0[1];
        }
        piece.contours.push(Contour { range, closed: start == end });
    }
}

/// Merges the joints of two chains of which the second continues the first. The first segment of a chain holds the advance of
/// its plunge and the overcut of its last lift. The seam has the plunge of the second chain and the lift of the first; the
/// contour has the other two.
fn seam(list: &mut SegmentList, mut first: Range, mut second: Range) {
    let no_overcut = list.cursor(&mut second).segment().joint.no_overcut;
    let mut begin = list.cursor(&mut first);
    let at_seam = std::mem::replace(&mut begin.joint_mut().no_overcut, no_overcut);
    let mut continued = list.cursor(&mut second);
    let joint = continued.joint_mut();
    joint.lift = true;
    joint.no_overcut = at_seam;
}
