//! Slit: converts short strokes at an outline to slit notches, and a short stroke over the tip of a slit to its crossbar.
//!
//! Needs: welded contours. Files also write slits as separate strokes: before the contour, at a vertex or within a segment of
//! it, or there and back. A stroke is a contour of two places at most [`Notch::LONGEST`] apart.
//!
//! - One that starts on an outline of its piece is a slit.
//! - A stroke divided by the tip of a slit is the crossbar of a T, even if the file calls it a slit; it then touches no
//!   outline.
//! - Any other stroke stays an open contour, as do all longer ones: internal lines, darts, outlines with a gap. One that is
//!   drawn there and back is cut once.
//!
//! A slit that starts up to [`Notch::MISS`] inside its edge is extended to it along its own line. Leaves true: notches in the
//! order of the file; none without length, and no slit twice in either direction.

use std::collections::BTreeSet;

use super::pass::MarkerPass;
use super::retrace::{Found, there_and_back};
use super::search::search_ended;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::near::{Near, sorted};
use crate::geom::{Point, bits, cross, polyline};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Marker, Notch, NotchKind, NotchStroke, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "slit", about: "makes notches of short strokes at an outline, and cuts none twice", run };

/// Least gap between a slit and its edge that is closed if the file has no grid, mm; otherwise it is half a unit.
const MISS_EPSILON: f64 = 0.01;
/// Slack in place of a unit if there is no grid, mm: such files are written with two or three decimals.
const NO_GRID: f64 = 0.01;
/// Additional gap due to rounding, mm: the diagonal of the coarsest unit.
const ROUNDED: f64 = 0.36;
/// Sine of the least angle between a slit and its edge: 20 degrees.
const LEAST_ANGLE: f64 = 0.34;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, unit, .. } = marker;
    let grid = if *unit > 0.0 { *unit } else { NO_GRID };
    let (near, around) = (Near::on_grid(grid), Near::on_grid(grid + Notch::MISS));
    let mut search = Search { list, near, around, least_miss: (*unit / 2.0).max(MISS_EPSILON), diagnostics };
    for piece in pieces.iter_mut() {
        let contours = piece.contours.iter().zip(0..);
        let mut shorts: Vec<Short> = contours.filter_map(|(contour, i)| short(search.list, contour, i)).collect();
        if shorts.is_empty() && piece.notches.is_empty() {
            continue; // the usual case
        }
        search.take_slits(piece, &mut shorts);
        search.reach_edges(piece);
        drop_doubles(piece, search.diagnostics);
        search.take_crossbars(piece, &mut shorts);
        let mut taken = shorts.iter().filter(|short| short.taken).map(|short| short.contour).peekable();
        let mut place = 0..;
        piece.contours.retain(|_| taken.next_if_eq(&place.next().expect("it never ends")).is_none());
    }
    let mut lines = Found::default();
    for piece in pieces.iter_mut() {
        there_and_back(piece, search.list, 0.0, &mut lines);
    }
    lines.say_there_and_back(search.diagnostics);
    if search.near.is_cut_short() || search.around.is_cut_short() {
        search.diagnostics.push(search_ended("more of the short ones may be notches, and are cut as lines"));
    }
}

/// Contour that is a stroke.
#[derive(Debug, Clone, Copy)]
struct Short {
    stroke: NotchStroke,
    percent: u8,
    /// Index among the contours of the piece.
    contour: usize,
    /// True if it has become part of a notch.
    taken: bool,
}

/// Stroke of a contour that goes only between two near places; `None` for any other.
fn short(list: &SegmentList, contour: &Contour, place: usize) -> Option<Short> {
    let points = list.points(contour.range);
    if points.iter().any(|&point| point != points[0] && point != points[1]) {
        return None; // the usual case, at the third point
    }
    let (_, first) = list.walk(contour.range).next()?;
    let stroke = NotchStroke { from: first.from, to: first.to, span: first.span };
    let percent = list.walk(contour.range).map(|(_, segment)| segment.percent).min()?;
    (stroke.length() <= Notch::LONGEST).then_some(Short { stroke, percent, contour: place, taken: false })
}

/// Calls `edge` for each of the sorted points on an outline of a piece, with the segment that it is on.
fn each_edge(
    list: &SegmentList,
    piece: &Piece,
    near: &mut Near,
    points: &[(Point, usize)],
    mut edge: impl FnMut(usize, [Point; 2]),
) {
    for contour in piece.contours.iter().filter(|contour| contour.closed && short(list, contour, 0).is_none()) {
        let line = list.points(contour.range);
        for (chain, extent) in list.chains(contour.range).each() {
            if !near.may_be_in(points, *extent) {
                continue; // the usual case: few chains have a notch
            }
            for ends in line[chain.first as usize..=chain.last as usize].windows(2) {
                let ends = [ends[0], ends[1]];
                near.each(points, ends, |place| edge(place, ends));
            }
        }
    }
}

/// Possible crossbar.
struct Bar {
    stroke: NotchStroke,
    percent: u8,
    origin: Origin,
}

/// Origin of a crossbar, with its index there.
enum Origin {
    Notches(usize),
    Shorts(usize),
}

fn is_short_slit(notch: &Notch) -> bool {
    notch.kind == NotchKind::Slit && notch.depth() <= Notch::LONGEST
}

/// State of the search in all pieces.
struct Search<'a> {
    list: &'a mut SegmentList,
    near: Near,
    /// Proximity test that includes the distance by which a slit may miss its edge.
    around: Near,
    /// Least extension of a slit to its edge, mm.
    least_miss: f64,
    diagnostics: &'a mut Diagnostics,
}

impl Search<'_> {
    /// Makes slits of the strokes that start on a closed contour.
    fn take_slits(&mut self, piece: &mut Piece, shorts: &mut [Short]) {
        if shorts.is_empty() {
            return;
        }
        let starts = sorted(shorts.iter().map(|short| short.stroke.from));
        // A stroke divided by a tip is a crossbar, even if it ends beside an edge.
        let tips =
            sorted(piece.notches.iter().map(|notch| notch.tip).chain(shorts.iter().map(|short| short.stroke.to)));
        let slack = self.near.slack();
        let mut is_divided = vec![false; shorts.len()];
        for (short, is_divided) in shorts.iter().zip(&mut is_divided) {
            let NotchStroke { from, to, .. } = short.stroke;
            let tip_of = |k: usize| piece.notches.get(k).map(|notch| notch.tip);
            let tip = |k: usize| tip_of(k).unwrap_or_else(|| shorts[k - piece.notches.len()].stroke.to);
            self.near.each(&tips, [from, to], |k| {
                *is_divided |= (tip(k) - from).norm().min((tip(k) - to).norm()) > slack;
            });
        }
        each_edge(self.list, piece, &mut self.near, &starts, |i, _| shorts[i].taken = true);
        each_edge(self.list, piece, &mut self.around, &starts, |i, ends| {
            shorts[i].taken |= !is_divided[i] && back_to(&shorts[i].stroke, ends).is_some();
        });
        for Short { stroke, percent, .. } in shorts.iter().filter(|short| short.taken) {
            let NotchStroke { from: root, to: tip, span } = *stroke;
            piece.notches.push(Notch { kind: NotchKind::Slit, root, tip, percent: *percent, span });
        }
        piece.notches.sort_by_key(|notch| notch.span); // stable: notches without a block keep their order
    }

    /// Extends slits that start inside their edge back to it, along their own lines.
    fn reach_edges(&mut self, piece: &mut Piece) {
        let slit = |notch: &Notch| NotchStroke { from: notch.root, to: notch.tip, span: notch.span };
        let starts = sorted(piece.notches.iter().map(|notch| notch.root));
        let mut missed: Vec<Option<f64>> = vec![Some(f64::INFINITY); piece.notches.len()];
        each_edge(self.list, piece, &mut self.around, &starts, |i, ends| {
            let stroke = slit(&piece.notches[i]);
            // At a vertex rounding may hide both edges.
            if polyline::distance_to_segment(stroke.from, ends[0], ends[1]) <= self.least_miss {
                missed[i] = None;
            }
            if let Some(back) = back_to(&stroke, ends) {
                // A slit that crosses an edge has reached it.
                missed[i] = missed[i].filter(|_| back >= self.least_miss).map(|least| least.min(back));
            }
        });
        for (notch, missed) in piece.notches.iter_mut().zip(missed) {
            let back = missed.filter(|&back| back <= Notch::MISS + self.near.slack() && notch.depth() > 0.0);
            if let Some(back) = back {
                notch.root -= (notch.tip - notch.root) * (back / notch.depth());
            }
        }
    }

    /// Possible crossbars: slits that touch no outline, then contours.
    fn bars(&mut self, piece: &Piece, shorts: &[Short]) -> Vec<Bar> {
        let slits: Vec<(usize, &Notch)> = piece.notches.iter().enumerate().filter(|(_, n)| is_short_slit(n)).collect();
        let mut touches = vec![false; slits.len()];
        // A single slit has no other that could be its crossbar, or the reverse.
        if slits.len() > 1 {
            let ends = sorted(slits.iter().flat_map(|(_, notch)| [notch.root, notch.tip]));
            each_edge(self.list, piece, &mut self.near, &ends, |i, _| touches[i / 2] = true);
        }
        let free = slits.iter().zip(touches).filter(|(_, touches)| slits.len() > 1 && !touches);
        let notches = free.map(|((i, notch), _)| {
            let stroke = NotchStroke { from: notch.root, to: notch.tip, span: notch.span };
            Bar { stroke, percent: notch.percent, origin: Origin::Notches(*i) }
        });
        let shorts = shorts.iter().enumerate().filter(|(_, short)| !short.taken);
        let contours =
            shorts.map(|(i, short)| Bar { stroke: short.stroke, percent: short.percent, origin: Origin::Shorts(i) });
        notches.chain(contours).collect()
    }

    /// Assigns the strokes divided by the tip of a slit to that slit.
    fn take_crossbars(&mut self, piece: &mut Piece, shorts: &mut [Short]) {
        let tips = sorted(piece.notches.iter().map(|notch| notch.tip));
        let mut is_bar = vec![false; piece.notches.len()];
        for Bar { stroke: bar, percent, origin } in self.bars(piece, shorts) {
            if let Origin::Notches(i) = origin
                && piece.notches[i].kind != NotchKind::Slit
            {
                continue; // it has a crossbar itself by now
            }
            let slack = self.near.slack();
            let mut taken = false;
            self.near.each(&tips, [bar.from, bar.to], |i| {
                let notch = &mut piece.notches[i];
                let divides = (notch.tip - bar.from).norm().min((notch.tip - bar.to).norm()) > slack;
                if taken || is_bar[i] || !divides {
                    return;
                }
                match notch.kind {
                    NotchKind::Slit => {
                        (notch.kind, notch.percent) = (NotchKind::T(bar), notch.percent.min(percent));
                        taken = true;
                    }
                    NotchKind::T(other) if ends(bar.from, bar.to) == ends(other.from, other.to) => {
                        let message =
                            format!("the same crossbar stands twice in piece {}; it is cut once", piece.number);
                        self.diagnostics.push(Diagnostic::new(&code::MARKER_SLIT_TWICE, message).at(bar.span));
                        taken = true;
                    }
                    NotchKind::T(_) => {}
                }
            });
            match origin {
                Origin::Notches(i) => is_bar[i] = taken,
                Origin::Shorts(i) => shorts[i].taken = taken,
            }
        }
        let mut place = 0..;
        piece.notches.retain(|_| !is_bar[place.next().expect("it never ends")]);
    }
}

/// Distance behind the start of a stroke at which its line meets a segment, mm; negative, by at most the length of the stroke,
/// if it meets it ahead of the start.
fn back_to(stroke: &NotchStroke, [a, b]: [Point; 2]) -> Option<f64> {
    let (way, edge) = (stroke.to - stroke.from, b - a);
    let length = way.norm();
    let across = cross(edge, way / length);
    if length == 0.0 || across.abs() < LEAST_ANGLE * edge.norm() {
        return None; // it runs along the edge
    }
    let back = cross(edge, stroke.from - a) / across;
    let place = (stroke.from - way * (back / length) - a).dot(&edge) / edge.norm_squared();
    ((0.0..=1.0).contains(&place) && back >= -length && back <= Notch::MISS + ROUNDED).then_some(back)
}

/// Removes slits without length and slits that are repeated in either direction.
fn drop_doubles(piece: &mut Piece, diagnostics: &mut Diagnostics) {
    let mut seen = BTreeSet::new();
    let number = piece.number;
    piece.notches.retain(|notch| {
        let ends = ends(notch.root, notch.tip);
        let is_new = seen.insert(ends);
        let finding = if ends[0] == ends[1] {
            Diagnostic::new(&code::MARKER_SLIT_NO_LENGTH, format!("a slit of piece {number} has no length"))
                .hint("give it a depth in the CAD system if the sewer needs it")
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

/// Key of two places in any order.
fn ends(a: Point, b: Point) -> [[u64; 2]; 2] {
    let mut ends = [a, b].map(bits);
    ends.sort_unstable();
    ends
}
