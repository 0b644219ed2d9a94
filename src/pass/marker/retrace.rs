//! Retrace: an outline that runs past its own start, or goes round again, becomes one closed contour, and a line there and back
//! becomes the line that it draws.
//!
//! Needs: welded contours. Other software adds an overcut at the end of an outline; plotters draw bold lines by going round
//! twice, or there and back. The knife has overlaps of its own, so the retraced stretch is left out, and the area counts once.
//! Leaves true: such a contour ends at its start, and keeps its start and direction; every edge of an open line is there once,
//! except for short straight lines, which the pass that finds slits needs as drawn.

use super::pass::MarkerPass;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code, pieces};
use crate::geom::again::{Step, course};
use crate::geom::closing::{self, Retrace};
use crate::geom::monotone::Chain;
use crate::geom::{Extent, Point};
use crate::ir::Chains;
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, Notch, Piece};
use crate::machine::Job;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "retrace", about: "leaves out what runs past the start of an outline or round again", run };

/// Decimals of lengths in messages, mm.
const DECIMALS: u32 = 1;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let reach = closing::reach(marker.unit);
    let [mut past, mut again, mut back, mut lines] = [(); 4].map(|()| Found::default());
    for piece in &mut marker.pieces {
        there_and_back(piece, &mut marker.list, Notch::LONGEST, &mut lines);
        for contour in &mut piece.contours {
            let points = marker.list.points(contour.range);
            let points: &[Point] = &points;
            if never_returns(points, &marker.list.chains(contour.range), reach) {
                continue;
            }
            let Some(found) = closing::retrace(points.len(), |k| points[k], reach) else { continue };
            let Retrace { last, rounds, is_back, past: length } = found;
            let mut ring: Vec<Segment> =
                marker.list.walk(contour.range).map(|(_, segment)| segment).take(last + 2).collect();
            let behind = ring[ring.len() - 1].span;
            ring.truncate(last + 1);
            let start = points[0];
            if let Some(closing) = ring.last_mut() {
                closing.to = start;
            }
            let Some(range) = marker.list.append(ring.clone()) else { continue };
            (contour.range, contour.closed) = (range, true);
            if length > 0.0 {
                past.add(piece.number, length, behind);
            }
            if rounds > 1 {
                let found = if is_back { &mut back } else { &mut again };
                found.add(piece.number, rounds as f64, behind);
            }
        }
    }
    past.say(&code::MARKER_OVERRUN, "outline", diagnostics, |longest| {
        format!("past the start, by up to {} mm", fixed(longest, DECIMALS))
    });
    let round = |most| format!("round {} times in one stroke", fixed(most, 0));
    again.say(&code::MARKER_ROUND_AGAIN, "outline", diagnostics, round);
    back.say(&code::MARKER_ROUND_AGAIN, "outline", diagnostics, |_| "round and back in one stroke".to_owned());
    lines.say_there_and_back(diagnostics);
}

/// Replaces a line there and back by the lines that it draws, except for straight ones up to `longest_slit` mm, which may be
/// slits.
pub(super) fn there_and_back(piece: &mut Piece, list: &mut SegmentList, longest_slit: f64, found: &mut Found) {
    for k in 0..piece.contours.len() {
        let range = piece.contours[k].range;
        let points = list.points(range);
        let Some(course) = course(&points) else { continue };
        let step = |ends: &[Step]| (points[ends[1].place] - points[ends[0].place]).norm();
        let length = |row: &Vec<Step>| row.windows(2).map(step).sum::<f64>();
        if course.straight(&points).is_some_and(|length| length <= longest_slit) {
            continue;
        }
        let again: f64 = course.again.iter().map(length).sum();
        let all: Vec<Segment> = list.walk(range).map(|(_, segment)| segment).collect();
        let segment = |ends: &[Step]| {
            let [from, to] = [ends[0], ends[1]].map(|step| points[step.place]);
            Segment { from, to, ..all[ends[1].led - 1] }
        };
        let paths: Vec<Vec<Segment>> = course.paths.iter().map(|path| path.windows(2).map(segment).collect()).collect();
        found.add(piece.number, again, all[0].span);
        let ranges = paths.into_iter().filter_map(|path| list.append(path));
        let mut contours = ranges.map(|range| Contour { range, closed: false });
        piece.contours.splice(k..=k, contours.next());
        piece.contours.extend(contours);
    }
}

/// True if a line ends at its start, does not turn back on its way there and has not been near it before, like nearly all
/// lines.
fn never_returns(points: &[Point], chains: &Chains, reach: f64) -> bool {
    let [first, inner @ .., last] = points else { return true };
    let is_near = |at: &Point| (at.x - first.x).abs() <= reach && (at.y - first.y).abs() <= reach;
    // Twice the reach, so that rounding hides no place.
    let around = Extent::between(*first, *first).grown(2.0 * reach);
    let returns = |(chain, extent): (&Chain, &Extent)| {
        let places = chain.first as usize..inner.len().min(chain.last as usize);
        extent.meets(&around) && inner[places].iter().any(is_near)
    };
    let runs_back = matches!(points, [.., before, at, last] if closing::turns_back([*before, *at, *last]));
    first == last && !runs_back && !chains.each().any(returns)
}

/// Outlines or lines of one finding.
#[derive(Default)]
pub(super) struct Found {
    pieces: Vec<u32>,
    count: usize,
    worst: f64,
    first: Option<Span>,
}

impl Found {
    pub(super) fn add(&mut self, piece: u32, worst: f64, span: Span) {
        self.count += 1;
        self.worst = self.worst.max(worst);
        self.first.get_or_insert(span);
        if self.pieces.last() != Some(&piece) {
            self.pieces.push(piece);
        }
    }

    /// Reports lines there and back.
    pub(super) fn say_there_and_back(&self, diagnostics: &mut Diagnostics) {
        self.say(&code::MARKER_ROUND_AGAIN, "line", diagnostics, |longest| {
            format!("there and back, for up to {} mm", fixed(longest, DECIMALS))
        });
    }

    /// Reports spurs of outlines that are longer than slits.
    pub(super) fn say_out_and_back(&self, diagnostics: &mut Diagnostics) {
        self.say(&code::MARKER_ROUND_AGAIN, "outline", diagnostics, |longest| {
            format!("out and back on one line of up to {} mm", fixed(longest, DECIMALS))
        });
    }

    fn say(&self, code: &'static Code, noun: &str, diagnostics: &mut Diagnostics, how: impl Fn(f64) -> String) {
        let Some(first) = self.first else { return };
        let (plural, verb) = if self.count == 1 { ("", "runs") } else { ("s", "run") };
        let pieces = pieces::listed(&self.pieces);
        let message = format!("{} {noun}{plural} {verb} {}, {pieces}: cut once", self.count, how(self.worst));
        diagnostics.push(Diagnostic::new(code, message).at(first));
    }
}
