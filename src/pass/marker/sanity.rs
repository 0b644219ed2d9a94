//! Sanity: warns of outlines that cross and of holes outside every part, and refuses parts that lie in each other. Changes
//! nothing.
//!
//! Needs: welded contours. Reports each of these once per piece or pair, at the first place in cut order:
//!
//! - An outline crosses itself, or another one of its piece.
//! - The outlines of two pieces overlap by more than the distance within which edges of different parts merge (`nest.band_mm`).
//!   Pieces edge to edge, or one inside the other, do not overlap. Deeper than `nest.overlap_mm`, or by a large share of one,
//!   it is an error: cloth cannot lie in two parts.
//! - A slit reaches another one of its piece, or an edge on the other side.
//! - A slit leads out of its part.
//! - A stroke of the length of a slit begins on no edge.
//! - A hole lies in no part. Without closed contours there are no parts to check.
//! - The number of a piece is repeated.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;

use rayon::prelude::*;

use super::pass::MarkerPass;
use super::search::{in_parts, search_ended};
use super::severed::severing;
use super::stray::strays;
use crate::analysis::depth::{Depth, depth, share};
use crate::analysis::outlines::{Outlines, slack};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::monotone::{Chain, Crossing, come_near, crossing};
use crate::geom::{Extent, Point, polyline};
use crate::ir::marker::{Drill, Marker, Notch};
use crate::machine::Job;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: MarkerPass = MarkerPass {
    name: "sanity",
    about: "warns of outlines that cross and of holes outside every part, refuses deep overlaps",
    run,
};

/// Number of places on an outline that are tested for lying in another.
const PROBES: usize = 16;
/// Cost of reporting that two pieces overlap, besides the comparison of two boxes.
const SAYING: usize = 500;
/// Least distance from the part of the middle of a slit that leads out of it, mm.
const OUTSIDE: f64 = 0.3;
/// Share of the smaller one of two parts from which on it is as much another's: parts of one shape that nearly lie on each
/// other, and a narrow part across an edge, overlap by little depth.
const LARGEST_SHARE: f64 = 0.25;
/// Longest side of a closed line, mm, that is a notch or a hole: it is no cloth that somebody sews.
const LARGEST_MARK: f64 = 15.0;
/// Hint with the key that allows overlaps.
const ALL_THE_SAME: &str =
    "`--set nest.overlap_mm=off` cuts both all the same; a number is the depth in mm that is allowed";
/// Decimals of the depth of overlaps, mm.
const DEPTH_DECIMALS: u32 = 2;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    numbers(marker, diagnostics);
    let parts = in_parts(marker.pieces.len());
    let alone: Vec<Alone> = marker
        .pieces
        .par_chunks(parts.size)
        .enumerate()
        .map(|(k, pieces)| Alone::of(marker, k * parts.size..k * parts.size + pieces.len(), parts.budget()))
        .collect();
    let mut boxes = Vec::with_capacity(marker.pieces.len());
    let mut loose: Vec<(usize, Drill)> = Vec::new();
    let (mut stray, mut any_closed, mut ended) = (Vec::new(), false, None);
    for part in alone {
        part.findings.into_iter().for_each(|finding| diagnostics.push(finding));
        loose.extend(part.loose);
        stray.extend(part.stray);
        any_closed |= part.any_closed;
        ended = earlier(ended, part.ended);
        boxes.extend(part.boxes);
    }
    let mut search = Search::new(marker, Boxes::new(boxes), job);
    let mut work = Budget::of_a_marker();
    ended = earlier(ended, search.overlaps(&mut work, diagnostics));
    stray.into_iter().filter(|_| any_closed).for_each(|finding| diagnostics.push(finding));
    // Without closed contours there are no parts to check.
    if let Some(&(first, _)) = loose.first().filter(|_| any_closed) {
        search.make_room();
        loose.retain(|(_, drill)| !search.is_in_a_part(drill, &mut work));
        search.report_drills(&loose, diagnostics);
        ended = earlier(ended, work.is_spent().then_some(first));
    }
    if let Some(i) = ended {
        let finding = search_ended("from this piece on outlines may cross, or holes lie outside every part, unsaid");
        diagnostics.push(finding.at(marker.pieces[i].span));
    }
}

/// Earlier one of two pieces.
fn earlier(one: Option<usize>, other: Option<usize>) -> Option<usize> {
    one.into_iter().chain(other).min()
}

/// Findings about pieces by themselves.
#[derive(Default)]
struct Alone {
    findings: Vec<Diagnostic>,
    /// Holes outside of their own piece, with the index of that.
    loose: Vec<(usize, Drill)>,
    /// Strokes that begin on no edge of their piece.
    stray: Vec<Diagnostic>,
    any_closed: bool,
    /// Piece at which the budget was spent.
    ended: Option<usize>,
    boxes: Vec<Extent>,
}

impl Alone {
    fn of(marker: &Marker, pieces: Range<usize>, mut work: Budget) -> Self {
        let mut alone = Self { boxes: Vec::with_capacity(pieces.len()), ..Self::default() };
        let mut part = Outlines::default();
        for i in pieces {
            part.gather(marker, i);
            if let Some(crossing) = part.self_crossing(marker, &mut work) {
                let [one, other] = crossing.segments.map(|segment| part.contour_of(segment));
                let piece = name(marker, i);
                let message = if one == other {
                    format!("an outline of {piece} crosses itself")
                } else {
                    format!("two outlines or lines of {piece} cross")
                };
                let span = span(marker, i, &part, crossing.segments[1]);
                let finding = Diagnostic::new(&code::MARKER_SELF_CROSSING, message);
                let hint = "see in the picture (`-t svg`) which side is the part, and mend the line in the CAD";
                alone.findings.push(finding.at(span).on_cloth(crossing.at).hint(hint));
            }
            if let Some(slit) = severing(&marker.pieces[i], &part, &mut work) {
                let message =
                    format!("a slit of {} comes to another cut of it: the part is severed there", name(marker, i));
                let hint = "shorten it, or move it along the edge; `notch.depth_mm` gives slits another depth";
                let finding = Diagnostic::new(&code::MARKER_SEVERED, message).at(slit.span).on_cloth(slit.tip);
                alone.findings.push(finding.hint(hint));
            }
            alone.findings.extend(slits_outwards(marker, i, &part, &mut work));
            alone.stray.extend(strays(marker, i, &part, &mut work));
            // A hole is most likely in its own piece.
            let outside = marker.pieces[i].drills.iter().filter(|drill| !part.may_hold(drill, &mut work));
            alone.loose.extend(outside.map(|drill| (i, *drill)));
            alone.any_closed |= part.closed().next().is_some();
            alone.boxes.push(part.extent);
            if work.is_spent() {
                alone.ended.get_or_insert(i);
            }
        }
        alone
    }
}

/// Warns of slits that lead out of a piece. One that ends at the mouth of a notch of its piece does not: it is the side that two
/// notches beside each other have in common.
fn slits_outwards(marker: &Marker, piece: usize, part: &Outlines, work: &mut Budget) -> Option<Diagnostic> {
    // Without closed contours there is no part to leave.
    part.closed().next()?;
    let is_common_side = |slit: &Notch| {
        let mut mouths = marker.pieces[piece].outline_notches.iter().map(|notch| notch.mouth);
        mouths.any(|[from, to]| polyline::distance_to_segment(slit.tip, from, to) <= Notch::MISS)
    };
    let leads_out = |slit: &&Notch| {
        let middle = slit.root + (slit.tip - slit.root) / 2.0;
        work.spend(3 * part.points.len())
            && !part.holds(middle)
            && part.distance(middle) > OUTSIDE
            && part.distance(slit.root) <= Notch::MISS
            && !is_common_side(slit)
    };
    let mut outwards = marker.pieces[piece].notches.iter().filter(leads_out);
    let first = outwards.next()?;
    let (slits, lead) = match outwards.count() {
        0 => ("a slit".to_owned(), "leads"),
        more => (format!("{} slits", more + 1), "lead"),
    };
    let message = format!("{slits} of {} {lead} out of the part", name(marker, piece));
    let finding = Diagnostic::new(&code::MARKER_SLIT_OUTWARDS, message).at(first.span).on_cloth(first.tip);
    Some(finding.hint("slits are cut as the file says, into waste or another part: check in the CAD for swapped ends"))
}

/// Warns of numbers that start again or repeat.
fn numbers(marker: &Marker, diagnostics: &mut Diagnostics) {
    if marker.pieces.is_sorted_by(|before, after| before.number < after.number) {
        return; // the usual case
    }
    let mut seen = BTreeSet::new();
    let mut repeated = BTreeSet::new();
    let mut before = 0;
    for piece in &marker.pieces {
        let is_new = seen.insert(piece.number);
        if !is_new && piece.number <= before && repeated.insert(piece.number) {
            let message = if piece.number < before {
                format!("piece numbers start again: piece {} comes a second time", piece.number)
            } else {
                format!("piece {} comes twice in a row", piece.number)
            };
            let finding = Diagnostic::new(&code::MARKER_NUMBER_TWICE, message).at(piece.span);
            diagnostics.push(finding.hint("if two jobs stand in one file, cut it in two"));
        }
        before = piece.number;
    }
}

/// Name of a piece in messages.
fn name(marker: &Marker, piece: usize) -> String {
    format!("piece {}", marker.pieces[piece].number)
}

/// Span of the segment of a piece that starts at a point.
fn span(marker: &Marker, piece: usize, part: &Outlines, point: usize) -> Span {
    let k = part.contour_of(point);
    let spans = marker.list.spans(marker.pieces[piece].contours[k].range);
    spans.get(point - part.contours[k].first).copied().unwrap_or_default()
}

/// Data shared by all searches.
struct Search<'a> {
    marker: &'a Marker,
    job: &'a Job,
    /// Boxes of the pieces.
    boxes: Boxes,
    /// Outlines of pieces, filled when they are compared with others: most pieces of a marker are apart. Empty until then.
    parts: Vec<OnceCell<Box<Outlines<'a>>>>,
    /// Greatest overlap of outlines that only touch, mm: by rounding, or by the band.
    touching: f64,
}

impl<'a> Search<'a> {
    fn new(marker: &'a Marker, boxes: Boxes, job: &'a Job) -> Self {
        let touching = job.profile.band(marker.unit).max(slack(marker));
        Self { marker, job, boxes, parts: Vec::new(), touching }
    }

    /// Allocates space for the outlines to compare.
    fn make_room(&mut self) {
        self.parts.resize_with(self.boxes.all().len(), OnceCell::new);
    }

    fn part(&self, piece: usize) -> &Outlines<'a> {
        self.parts[piece].get_or_init(|| Box::new(Outlines::of(self.marker, piece)))
    }

    /// Reports overlapping pieces; returns the piece at which the budget was spent.
    fn overlaps(&mut self, work: &mut Budget, diagnostics: &mut Diagnostics) -> Option<usize> {
        for i in 0..self.boxes.all().len() {
            let extent = self.boxes.all()[i];
            if !work.spend(self.boxes.cost_near(&extent)) {
                return Some(i);
            }
            let overlaps = |&k: &usize| extent.overlaps(&self.boxes.all()[k]);
            let mut later: Vec<usize> = self.boxes.near_from(i + 1, extent).filter(overlaps).collect();
            if later.is_empty() {
                continue;
            }
            later.sort_unstable();
            self.make_room();
            for k in later {
                let Some((place, span)) = self.overlap(i, k, work) else { continue };
                work.spend(SAYING);
                let depth = depth([i, k].map(|piece| self.part(piece)), work);
                if depth.is_whole && depth.by <= self.touching {
                    continue;
                }
                diagnostics.push(self.tell_overlap([i, k], &depth, place).at(span));
            }
            // All its pairs as the earlier one are done, and those as the later one came before.
            self.parts[i].take();
            if work.is_spent() {
                return Some(i);
            }
        }
        None
    }

    /// The finding that two pieces overlap, at a depth and at a place. It is an error where both are cut and too much cloth would
    /// lie in both.
    fn tell_overlap(&self, pieces: [usize; 2], depth: &Depth, place: Point) -> Diagnostic {
        let parts = pieces.map(|piece| self.part(piece));
        let (share, smaller) = share(parts);
        let (width, height) = parts[smaller].extent.size();
        let is_cut = |piece: usize| self.job.selection.has(self.marker.pieces[piece].number);
        let are_parts = share > 0.0 && width.max(height) > LARGEST_MARK && pieces.into_iter().all(is_cut);
        let most = self.job.profile.nest.overlap_mm.filter(|_| are_parts && self.job.profile.tool.kind.severs());
        let is_deep = most.is_some_and(|most| depth.of_outlines > most || share >= LARGEST_SHARE);
        let numbers = pieces.map(|piece| self.marker.pieces[piece].number);
        let [one, other] = numbers;
        let by = fixed(depth.by, DEPTH_DECIMALS);
        let finding = if is_deep {
            let at_least = if depth.is_whole { "" } else { "at least " };
            let mut message = format!("pieces {one} and {other} lie over each other by {at_least}{by} mm");
            if share >= LARGEST_SHARE {
                let _ = write!(message, ", {} % of piece {}", fixed(100.0 * share, 0), numbers[smaller]);
            }
            let finding = Diagnostic::new(&code::MARKER_DEEP_OVERLAP, message);
            finding
                .hint("move one of the two in the marker, or leave one out: `--skip` and its number")
                .hint(ALL_THE_SAME)
        } else {
            let by = if depth.is_whole { format!(" by {by} mm") } else { String::new() };
            let message = format!("the outlines of piece {one} and piece {other} overlap{by}");
            let finding = Diagnostic::new(&code::MARKER_OVERLAPPING, message);
            finding.hint("move one of the two in the marker: each is cut into the other")
        };
        let finding = finding.about(numbers.to_vec());
        if depth.is_whole { finding.by(depth.by).on_cloth(depth.at) } else { finding.on_cloth(place) }
    }

    /// Place where the outlines of two pieces overlap, and the span of the later one there.
    fn overlap(&self, i: usize, k: usize, work: &mut Budget) -> Option<(Point, Span)> {
        let (a, b) = (self.part(i), self.part(k));
        let common = |part: &Outlines, other: &Outlines| -> Vec<Chain> {
            let near = part.chains.each().filter(|(_, extent)| extent.overlaps(&other.extent));
            near.map(|(chain, _)| *chain).collect()
        };
        if !work.spend(a.chains.all.len() + b.chains.all.len()) {
            return None;
        }
        let (of_a, of_b) = (common(a, b), common(b, a));
        if of_a.is_empty() || of_b.is_empty() {
            return None;
        }
        let mut wanted = |crossing: &Crossing| {
            let [s, t] = crossing.segments;
            a.leads_across(s, [b.points[t], b.points[t + 1]], slack(self.marker))
                && b.leads_across(t, [a.points[s], a.points[s + 1]], slack(self.marker))
        };
        for &of_b in &of_b {
            for &of_a in &of_a {
                if work.is_spent() {
                    return None;
                }
                if let Some(found) = crossing([&a.points, &b.points], [of_a, of_b], work, &mut wanted) {
                    return Some((found.at, span(self.marker, k, b, found.segments[1])));
                }
            }
        }
        let is_near = self.are_near(a, b, work);
        // A line that is not near another is on one side of it.
        let may_straddle = |part: &Outlines| is_near || part.contours.len() > 1;
        let mut straddles = |part, other| if may_straddle(part) { self.straddles(part, other, work) } else { None };
        let place = straddles(b, a).map(|(place, point)| (place, span(self.marker, k, b, point)));
        place.or_else(|| straddles(a, b).map(|(place, _)| (place, self.marker.pieces[k].span)))
    }

    /// True if lines of two parts are so near to each other that rounding may have made them coincide.
    fn are_near(&self, a: &Outlines, b: &Outlines, work: &mut Budget) -> bool {
        let slack = slack(self.marker);
        let beside = |part: &Outlines, other: &Outlines| -> Vec<Chain> {
            let around = other.extent.grown(slack);
            let beside = part.chains.each().filter(|(_, extent)| extent.meets(&around));
            beside.map(|(chain, _)| *chain).collect()
        };
        let (of_a, of_b) = (beside(a, b), beside(b, a));
        let mut is_near =
            |a_chain| of_b.iter().any(|&b_chain| come_near([&a.points, &b.points], [a_chain, b_chain], slack, work));
        of_a.into_iter().any(&mut is_near)
    }

    /// Place of `part` well inside `other`, if another place of it is well outside, with the index of its point: the parts
    /// overlap without crossing segments, because lines of one run along lines of the other.
    fn straddles(&self, part: &Outlines, other: &Outlines, work: &mut Budget) -> Option<(Point, usize)> {
        let ends: Vec<usize> = (0..part.points.len().saturating_sub(1)).collect();
        let stride = ends.len().div_ceil(PROBES).max(1);
        let (mut inside, mut outside) = (None, false);
        for &start in ends.iter().step_by(stride) {
            if !work.spend(2 * other.points.len()) {
                return None;
            }
            let place = part.points[start] + (part.points[start + 1] - part.points[start]) / 2.0;
            let holds = other.holds(place);
            if (holds && inside.is_some()) || (!holds && outside) || other.distance(place) <= slack(self.marker) {
                continue;
            }
            if holds {
                inside = Some((place, start));
            } else {
                outside = true;
            }
        }
        inside.filter(|_| outside)
    }

    /// True if a hole lies in any part.
    fn is_in_a_part(&self, drill: &Drill, work: &mut Budget) -> bool {
        !work.spend(self.boxes.cost_at(drill.at))
            || self.boxes.at(drill.at).any(|piece| self.part(piece).may_hold(drill, work))
    }

    /// Reports holes outside of all parts, by piece.
    fn report_drills(&self, loose: &[(usize, Drill)], diagnostics: &mut Diagnostics) {
        for of_one in loose.chunk_by(|one, other| one.0 == other.0) {
            let (piece, first) = of_one[0];
            let more = match of_one.len() - 1 {
                0 => String::new(),
                more => format!(", and {more} more of this piece"),
            };
            let message = format!("a hole of {} lies outside every part{more}", name(self.marker, piece));
            let finding = Diagnostic::new(&code::MARKER_DRILL_OUTSIDE, message).at(first.span).on_cloth(first.at);
            diagnostics.push(finding.hint("look where it is in the picture (`-t svg`); its part may be missing"));
        }
    }
}
