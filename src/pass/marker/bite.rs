//! Bite: windows of a conveyor, and the advances of the cloth between them.
//!
//! Needs: the pieces on the table, the content of a part before the part. Without `bite.length_mm` changes nothing. Leaves
//! true: every piece, or section of a piece longer than a window, is in one window with all that the blade reaches beyond its
//! lines; windows come in the order of their places along X; before the first piece of each window stands the advance of the
//! cloth, in whole mm. Within a window pieces keep their order, and early sections come last. Requests to the operator stay
//! between the same pieces.
//!
//! A window takes every piece that ends in it, and the next window begins at the first of the others. If no piece is split and
//! nothing is asked between pieces, no other choice needs fewer windows, since a window that begins farther back ends farther
//! back. A longer piece is split into the fewest sections possible, at the places of least cost ([`Long`]). Its first section
//! waits for a window of its own only if it would need more sections otherwise. If the file advances the cloth itself (M69),
//! its own windows are kept.

use std::collections::BTreeMap;
use std::ops::Range;

use super::long::{Long, Stretch};
use super::pass::MarkerPass;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Vector};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Event, Marker, Notch, Piece};
use crate::ir::toolpath;
use crate::machine::Job;
use crate::units::number::{fixed, up};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "bite", about: "parts a marker into the windows of a conveyor", run };

/// Decimals of lengths in messages, mm.
const DECIMALS: u32 = 1;
/// Distance by which a piece may begin before its window, mm: rounding of a sum.
const PLACE_EPSILON: f64 = 1e-6;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let Some(length) = job.profile.bite.length_mm else { return };
    let mut stretches: Vec<Option<Stretch>> = marker.pieces.iter().map(|piece| stretch(marker, piece, job)).collect();
    wait_for_held(marker, &mut stretches, job);
    let Some(least) = stretches.iter().flatten().map(|stretch| stretch.from).reduce(f64::min) else { return };
    let start = job.profile.table.x_mm.map_or(least, |[start, _]| start);
    let longs = Long::of(marker, &stretches, job);
    let mut windows = Windows { length, start, advance: 0, number: 0, is_begun: false, longs };
    let (mut order, blocks) = (Vec::with_capacity(stretches.len()), blocks(&marker.pieces));
    let firsts = firsts(&stretches);
    for block in &blocks {
        let moves_on = marker.pieces[block.start].events.iter().any(is_advance);
        let later = firsts[block.end];
        // A piece that is left out needs no window.
        let is_cut = |&i: &usize| job.selection.has(marker.pieces[i].number);
        let left = block.clone().map(|i| (i, stretches[i].filter(|_| is_cut(&i)))).collect();
        if let Err(misfit) = windows.take(left, (moves_on, later), &mut order) {
            diagnostics.push(misfit.told(marker, length));
            return;
        }
    }
    let end = stretches.iter().flatten().map(|stretch| stretch.to).fold(start, f64::max);
    let end = (end - start).ceil().max(0.0) as u32;
    if let Some(idle) = lay(marker, &blocks, (&order, &windows.longs), end) {
        diagnostics.push(idle);
    }
}

/// Least start of the stretches from each index on; infinite after the last.
fn firsts(stretches: &[Option<Stretch>]) -> Vec<f64> {
    let mut firsts = vec![f64::INFINITY; stretches.len() + 1];
    for (i, stretch) in stretches.iter().enumerate().rev() {
        firsts[i] = stretch.map_or(firsts[i + 1], |stretch| stretch.from.min(firsts[i + 1]));
    }
    firsts
}

/// True if the file advances the cloth.
fn is_advance(event: &Event) -> bool {
    event.kind == toolpath::Event::Advance
}

/// A piece, or a section of one, in a window.
struct Placed {
    /// Index of the piece.
    piece: usize,
    /// Advance of the cloth by then, mm.
    advance: u32,
    /// Stretch of the section along X, mm, and whether it is the last one; `None` for a whole piece.
    section: Option<([f64; 2], bool)>,
}

/// Stretch of a piece; `None` if nothing of it is cut.
fn stretch(marker: &Marker, piece: &Piece, job: &Job) -> Option<Stretch> {
    let mut extent = Extent::EMPTY;
    piece.contours.iter().for_each(|contour| extent.join(&marker.list.extent(contour.range)));
    for stroke in piece.notches.iter().flat_map(Notch::strokes) {
        extent.join(&Extent::between(stroke.from, stroke.to));
    }
    let [x, y] = job.profile.drill.offset_mm;
    piece.drills.iter().flat_map(|drill| [drill.at, drill.at - Vector::new(x, y)]).for_each(|at| extent.add(at));
    let reach = job.profile.knife.reach();
    (!extent.is_empty()).then_some(Stretch { from: extent.min.x - reach, to: extent.max.x + reach })
}

/// Extends the stretch of each part to cover those of the pieces in it, which are cut before it comes free. The axis of an
/// offset drill reaches farther than the part around the hole, and a piece may protrude by the band of the nest.
fn wait_for_held(marker: &Marker, stretches: &mut [Option<Stretch>], job: &Job) {
    let nesting = Nesting::of(marker, job.profile.band(marker.unit));
    let extent = |piece: &Piece| {
        let mut extent = Extent::EMPTY;
        piece.contours.iter().for_each(|contour| extent.join(&marker.list.extent(contour.range)));
        extent
    };
    let boxes = Boxes::new(marker.pieces.iter().map(extent).collect());
    for (i, piece) in marker.pieces.iter().enumerate() {
        let Some(Stretch { to, .. }) = stretches[i] else { continue };
        let holders = if piece.contours.is_empty() {
            let around = piece.drills.iter().flat_map(|drill| boxes.at(drill.at));
            around.filter(|&part| part > i).collect()
        } else {
            nesting.holders(i)
        };
        for part in holders {
            if let Some(stretch) = &mut stretches[part] {
                stretch.to = stretch.to.max(to);
            }
        }
    }
}

/// Ranges of pieces between requests.
fn blocks(pieces: &[Piece]) -> Vec<Range<usize>> {
    let mut starts: Vec<usize> = (0..pieces.len()).filter(|&i| i == 0 || !pieces[i].events.is_empty()).collect();
    starts.push(pieces.len());
    starts.windows(2).map(|ends| ends[0]..ends[1]).collect()
}

/// Windows under construction.
struct Windows {
    /// Length of each, mm.
    length: f64,
    /// Start of the first one, mm.
    start: f64,
    /// Advance of the cloth so far, whole mm.
    advance: u32,
    /// Number of the present window, from 0.
    number: u32,
    /// True if anything was cut so far.
    is_begun: bool,
    /// The pieces that are longer than a window.
    longs: BTreeMap<usize, Long>,
}

/// Reason that a piece fits no window.
enum Misfit {
    /// It is longer than a window: its length with the room that the blade needs, mm.
    Long(usize, f64),
    /// It begins before a window that has passed: by that distance, mm.
    Behind(usize, f64),
}

impl Windows {
    /// Start of the present window, mm.
    fn begins(&self) -> f64 {
        self.start + f64::from(self.advance)
    }

    /// Assigns the pieces of a block to windows: appends their order, with the advance of the cloth by then. An advance of the
    /// file starts a new window; `later` is the start of the first piece of later blocks.
    fn take(
        &mut self,
        mut left: Vec<(usize, Option<Stretch>)>,
        (moves_on, later): (bool, f64),
        order: &mut Vec<Placed>,
    ) -> Result<(), Misfit> {
        let mut is_next = moves_on && self.is_begun;
        while !left.is_empty() {
            let cut = left.iter().filter_map(|&(i, stretch)| Some((i, stretch?)));
            let first = cut.min_by(|(_, a), (_, b)| a.from.total_cmp(&b.from));
            if let Some((i, first)) = first {
                // The first window is judged by the pass `table`.
                let behind = self.begins() - first.from;
                if behind > PLACE_EPSILON && self.advance > 0 {
                    return Err(Misfit::Behind(i, behind));
                }
                if is_next {
                    // A section begins at the start of its window.
                    let section = self.longs.get(&i).map(|_| first.from + self.length - 1.0);
                    let to = section.map_or(first.to, |to| to.min(first.to));
                    let next = self.next(Stretch { to, ..first }, later);
                    let next = next.ok_or(Misfit::Long(i, first.to - first.from))?;
                    self.number += u32::from(next > self.advance);
                    self.advance = next;
                }
            }
            let count = order.len();
            self.fill(&mut left, order);
            let is_late = |(i, _): &&(usize, Option<Stretch>)| {
                self.longs.get(i).is_some_and(|long| long.is_late(self.number + 1))
            };
            let late = left.iter().find(is_late).and_then(|&(i, stretch)| Some((i, stretch?)));
            if let Some((i, first)) = late.or(first.filter(|_| order.len() == count && is_next)) {
                return Err(Misfit::Long(i, first.to - first.from));
            }
            is_next = true;
        }
        Ok(())
    }

    /// Takes the pieces that fit in the present window: whole pieces, and sections of longer ones.
    fn fill(&mut self, left: &mut Vec<(usize, Option<Stretch>)>, order: &mut Vec<Placed>) {
        let (begin, end) = (self.begins(), self.begins() + self.length + PLACE_EPSILON);
        left.retain(|&(piece, stretch)| {
            let is_in = stretch.is_none_or(|stretch| stretch.to <= end);
            if is_in {
                let section = self.longs.get(&piece).map(|long| (long.rest(), true));
                order.push(Placed { piece, advance: self.advance, section });
                self.is_begun |= stretch.is_some();
            }
            !is_in
        });
        for (piece, stretch) in left {
            let (Some(long), Some(stretch)) = (self.longs.get_mut(piece), stretch) else { continue };
            let Some(section) = (stretch.from >= begin - PLACE_EPSILON).then(|| long.take(self.number, end)).flatten()
            else {
                continue;
            };
            order.push(Placed { piece: *piece, advance: self.advance, section: Some((section, false)) });
            stretch.from = long.begins();
            self.is_begun = true;
        }
    }

    /// Advance of the cloth at the next window, which holds `first`: as far as that piece and `later` ones allow. `None` if the
    /// piece is too long.
    fn next(&self, first: Stretch, later: f64) -> Option<u32> {
        let most = (first.from - self.start + PLACE_EPSILON).floor();
        let least = (first.to - self.length - self.start - PLACE_EPSILON).ceil();
        let wanted = first.from.min(later) - self.start;
        (least <= most).then(|| wanted.floor().max(least).min(most).max(f64::from(self.advance)) as u32)
    }
}

impl Misfit {
    fn told(&self, marker: &Marker, length: f64) -> Diagnostic {
        let has = fixed(length, DECIMALS);
        let (piece, message, hint) = match *self {
            Self::Long(i, long) => {
                let (number, long) = (marker.pieces[i].number, up(long, DECIMALS));
                let message = format!(
                    "piece {number} takes {long} mm along X with its overlaps, more than a bite of {has} mm holds"
                );
                let hint =
                    "it cannot be split: that takes straight edges beside waste, and an outline around all its lines";
                (i, message, hint)
            }
            Self::Behind(i, by) => {
                let (number, by) = (marker.pieces[i].number, up(by, DECIMALS));
                let message = format!("piece {number} begins {by} mm before the bite in which the file has it");
                (i, message, "put it before the stop or the advance in the file, or leave it out (`--skip`)")
            }
        };
        let numbers = vec![marker.pieces[piece].number];
        let finding =
            Diagnostic::new(&code::MARKER_BITE, message).at(marker.pieces[piece].span).about(numbers).hint(hint);
        match self {
            Self::Long(..) => finding.hint("turn the marker, or leave the piece out (`--skip`)"),
            Self::Behind(..) => finding,
        }
    }
}

/// Puts pieces in order, with the advances of the cloth before the first piece of each window. Events before a block stay
/// before it; an advance at the end moves everything off the table. Advances of the file that move nothing are left out and
/// reported.
fn lay(
    marker: &mut Marker,
    blocks: &[Range<usize>],
    (order, longs): (&[Placed], &BTreeMap<usize, Long>),
    end: u32,
) -> Option<Diagnostic> {
    let of_block = |block: &Range<usize>| (block.start, std::mem::take(&mut marker.pieces[block.start].events));
    let mut asked = blocks.iter().map(of_block).collect::<Vec<_>>().into_iter().peekable();
    let mut pieces: Vec<Option<Piece>> = std::mem::take(&mut marker.pieces).into_iter().map(Some).collect();
    let (mut at, mut idle, mut place) = (0, Vec::new(), 0);
    for &Placed { piece, advance, section } in order {
        let mut piece = placed(&mut pieces[piece], section, longs.get(&piece), &marker.list);
        if let Some((_, events)) = asked.next_if(|&(start, _)| start == place) {
            piece.events = events;
        }
        let plain = Event { kind: toolpath::Event::Advance, span: piece.span };
        idle.extend(put(&mut piece.events, advance - at, plain));
        at = advance;
        place += usize::from(section.is_none_or(|(_, is_last)| is_last));
        marker.pieces.push(piece);
    }
    if marker.closing.iter().any(is_advance) {
        let span = marker.closing[0].span;
        idle.extend(put(&mut marker.closing, end.saturating_sub(at), Event { kind: toolpath::Event::Advance, span }));
    }
    let first = idle.first()?;
    let message = match idle.len() {
        1 => "an advance of the file moves nothing and is left out".to_owned(),
        count => format!("{count} advances of the file move nothing and are left out"),
    };
    let hint = "what comes behind them lies in the window before them; `cutc info` lists the windows";
    Some(Diagnostic::new(&code::MARKER_IDLE_ADVANCE, message).at(first.span).hint(hint))
}

/// A piece, or the next section of it with what is in it; the last section also has the rest of the piece.
fn placed(
    piece: &mut Option<Piece>,
    section: Option<([f64; 2], bool)>,
    long: Option<&Long>,
    list: &SegmentList,
) -> Piece {
    if let (Some((stretch, false)), Some(long)) = (section, long) {
        let rest = piece.as_mut().expect("each piece is in one window");
        return Piece { section: Some(stretch), ..long.split_off(rest, stretch[1], list) };
    }
    let section = section.map(|(stretch, _)| stretch);
    Piece { section, ..piece.take().expect("each piece is in one window") }
}

/// Replaces the first advance among some events by an advance of `way` mm, or inserts one before all, and returns the other
/// advances.
fn put(events: &mut Vec<Event>, way: u32, plain: Event) -> Vec<Event> {
    if way > 0 {
        if !events.iter().any(is_advance) {
            events.insert(0, plain);
        }
        let first = events.iter_mut().find(|event| is_advance(event)).expect("it was put there");
        first.kind = toolpath::Event::AdvanceBy(way);
    }
    events.extract_if(.., |event| is_advance(event)).collect()
}
