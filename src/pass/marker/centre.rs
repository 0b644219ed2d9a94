//! Centre: moves the marker with a cloth that wanders on its conveyor.
//!
//! Needs: the marker as it lies on the table, X along the feed. Leaves true: the same pieces in the same order, each place
//! moved across by the offset of the centre of the cloth from the middle when the conveyor is at its X. A straight line on the
//! cloth is bent on a machine past which the cloth wanders: lines are split where the centre line bends, so that they follow it
//! within a share of the tolerance. All places use one line of few rows, so that touching edges still touch.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::{Marker, OutlineNotch, Piece};
use crate::machine::{CentreLine, Job};
use crate::units::number::{fixed, up};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "centre", about: "moves the marker with the cloth that wanders", run };

/// Share of the tolerance by which lines may deviate from the centre line; the knife may deviate from the lines by all of it.
const PART: f64 = 0.25;
/// Deviation from the centre line below which a line is not split, mm: no file resolves it.
const STRAIGHT_EPSILON: f64 = 0.001;
/// Steepest course of a cloth across the feed without a warning, per length of feed.
const STEEP: f64 = 0.5;
/// Decimals of positions of the conveyor, mm.
const DECIMALS: u32 = 1;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let Some(centre) = &job.centre else { return };
    let extent = marker.extent();
    if extent.is_empty() {
        return;
    }
    tell(&centre.line, [extent.min.x, extent.max.x], diagnostics);
    let shift = Shift(centre.line.simplified(PART * job.profile.tolerance(marker.unit)));
    steep(&shift, [extent.min.x, extent.max.x], diagnostics);
    bent(&shift, marker, job.profile.tolerance(marker.unit), diagnostics);
    for piece in &mut marker.pieces {
        for contour in &mut piece.contours {
            part(&mut marker.list, &mut contour.range, &shift);
        }
        recount(piece, &marker.list);
        shift.piece(piece);
    }
    marker.list.move_points(|at| shift.place(at));
    for vertex in marker.drawing.iter_mut().flat_map(|account| &mut account.aside.vertices) {
        shift.move_place(&mut vertex.at);
    }
}

/// Reports the length by which a marker extends beyond the ends of the centre line.
fn tell(centre: &CentreLine, [from, to]: [f64; 2], diagnostics: &mut Diagnostics) {
    let [start, end] = centre.range();
    let beyond = (start - from).max(to - end);
    if beyond <= 0.0 {
        return;
    }
    let place = |x| fixed(x, DECIMALS);
    let message = format!(
        "the marker lies from X {} to {} mm, the centre line is known from {} to {}: beyond its ends the cloth is taken to lie \
         as it does there",
        place(from),
        place(to),
        place(start),
        place(end)
    );
    let hint = format!("record {} mm more of the cloth, or move the marker (`sheet.origin`)", up(beyond, DECIMALS));
    diagnostics.push(Diagnostic::new(&code::CENTRE_BEYOND, message).by(beyond).hint(hint));
}

/// Warns of a cloth that would run across implausibly steeply: the file has another unit, or damage was followed.
fn steep(Shift(line): &Shift, [from, to]: [f64; 2], diagnostics: &mut Diagnostics) {
    let across = |ends: &[[f64; 2]]| [ends[1][0] - ends[0][0], (ends[1][1] - ends[0][1]).abs()];
    let on = line.rows().windows(2).filter(|ends| ends[1][0] > from && ends[0][0] < to);
    let slope = |ends: &[[f64; 2]]| across(ends)[1] / across(ends)[0];
    let Some(worst) = on.max_by(|a, b| slope(a).total_cmp(&slope(b))).filter(|ends| slope(ends) > STEEP) else {
        return;
    };
    let [way, off] = across(worst).map(|length| up(length, DECIMALS));
    let message = format!(
        "the centre of the cloth goes {off} mm across within {way} mm of the conveyor, at {} mm",
        fixed(worst[0][0], DECIMALS)
    );
    let hint = "look at the centre line there: both columns are in mm, and damage longer than `track.debounce_ms` is no wander";
    diagnostics.push(Diagnostic::new(&code::CENTRE_STEEP, message).by(slope(worst)).hint(hint));
}

/// Warns of a bend of the cloth within a notch that its straight stroke does not follow.
fn bent(shift: &Shift, marker: &Marker, tolerance: f64, diagnostics: &mut Diagnostics) {
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches);
    let off = notches.map(|notch| (shift.bend(notch.root.x, notch.tip.x), notch.root));
    let Some((off, at)) = off.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(off, _)| *off > tolerance) else { return };
    let message = format!("the cloth bends by {} mm within a notch, which is cut straight", up(off, 2));
    let hint = "look at the centre line there, or take a longer `track.centre_mm` when you make it";
    diagnostics.push(Diagnostic::new(&code::CENTRE_STEEP, message).on_cloth(at).by(off).hint(hint));
}

/// Displacement of places across the feed, by a line of few rows.
struct Shift(CentreLine);

impl Shift {
    fn place(&self, at: Point) -> Point {
        Point::new(at.x, at.y + self.0.at(at.x))
    }

    fn move_place(&self, at: &mut Point) {
        *at = self.place(*at);
    }

    /// Positions of the bends of the line between two positions of the conveyor, in the direction from one to the other.
    fn bends(&self, from: f64, to: f64) -> Vec<f64> {
        let Self(line) = self;
        let (rows, [least, most]) = (line.rows(), [from.min(to), from.max(to)]);
        let first = rows.partition_point(|[place, _]| *place <= least);
        let end = first + rows[first..].partition_point(|[place, _]| *place < most);
        let mut bends: Vec<f64> = Vec::new();
        for i in first..end {
            let [place, centre] = rows[i];
            let before = bends.last().copied().unwrap_or(least);
            let next = if i + 1 < end { rows[i + 1][0] } else { most };
            let share = (place - before) / (next - before);
            let straight = line.at(before) + (line.at(next) - line.at(before)) * share;
            if (centre - straight).abs() > STRAIGHT_EPSILON {
                bends.push(place);
            }
        }
        if from > to {
            bends.reverse();
        }
        bends
    }

    /// Greatest deviation of the line from the straight one between two positions of the conveyor, mm.
    fn bend(&self, from: f64, to: f64) -> f64 {
        let Self(line) = self;
        let straight = |at: f64| line.at(from) + (line.at(to) - line.at(from)) * ((at - from) / (to - from));
        self.bends(from, to).into_iter().map(|at| (line.at(at) - straight(at)).abs()).fold(0.0, f64::max)
    }

    /// Moves the parts of a piece besides its contours. Strokes of notches are short: they are not split, and the resulting
    /// error is reported.
    fn piece(&self, piece: &mut Piece) {
        piece.places_mut().for_each(|at| self.move_place(at));
        piece.labels.iter_mut().filter_map(|label| label.at.as_mut()).for_each(|at| self.move_place(at));
    }
}

/// Splits the lines of a contour where the centre line bends.
fn part(list: &mut SegmentList, range: &mut Range, shift: &Shift) {
    if list.lines(*range).all(|[from, to]| shift.bends(from.x, to.x).is_empty()) {
        return;
    }
    let mut cursor = list.cursor(range);
    loop {
        let segment = cursor.segment();
        let step = segment.to - segment.from;
        for x in shift.bends(segment.from.x, segment.to.x) {
            cursor.split(Point::new(x, segment.from.y + step.y * ((x - segment.from.x) / step.x)));
            cursor.advance();
        }
        if !cursor.advance() {
            break;
        }
    }
}

/// Recounts the segments of the notches in the contours of a piece: some may have been split.
fn recount(piece: &mut Piece, list: &SegmentList) {
    let Piece { contours, outline_notches, .. } = piece;
    for OutlineNotch { mouth, segments, .. } in outline_notches {
        let counted = contours.iter().find_map(|contour| {
            let points = list.points(contour.range);
            let ring = if contour.closed { &points[..points.len() - 1] } else { &points[..] };
            let first = ring.iter().position(|at| *at == mouth[0])?;
            (1..ring.len()).find(|k| ring[(first + k) % ring.len()] == mouth[1])
        });
        *segments = (*segments).max(counted.map_or(0, |count| count as u32));
    }
}
