//! Pieces longer than a window of the conveyor, and the places where they are split.
//!
//! Splits are looked for on a grid along X. From the far end back, the best continuation of each place is computed: the fewest
//! sections, then the least cost of the splits between them (dynamic programming). Going forward, a window takes the section
//! that leaves the best rest; among equals, the longest.

use std::collections::BTreeMap;

use super::split::{Lap, Lines, Ring};
use crate::analysis::nesting::Nesting;
use crate::geom::{Extent, ring};
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::{Contour, Marker, Notch, Piece};
use crate::machine::{Bite, Job, NotchStyle};

/// Distance of the borders that are tried, mm.
const GRID: f64 = 5.0;
/// Least length of a section, mm, so that two joins on an edge are at least that far apart.
const SHORTEST: f64 = 60.0;
/// Least difference of a section and its window, mm: advances of the cloth are whole mm.
const ROOM: f64 = 1.0;

/// Stretch along X that the blade, or the axis of a drill, may need for a piece, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
}

/// A piece that is longer than a window.
#[derive(Debug)]
pub(super) struct Long {
    /// Its outline in the list of segments.
    outline: Range,
    /// Ends of the piece along X, mm.
    ends: [f64; 2],
    /// Places where a section may begin: the start of the piece, then the possible splits.
    places: Vec<Place>,
    /// Index of the place where the next section begins.
    next: usize,
    /// Window of the section before that, if there is one.
    window: Option<u32>,
    /// Greatest reach of the blade beyond a border, mm.
    reach: f64,
}

/// A place where a section may begin.
#[derive(Debug, Clone, Copy)]
struct Place {
    x: f64,
    /// Start of the stretch that the blade may need, mm.
    from: f64,
    /// Cost of a split here, of [`Lines::cost`].
    cost: u32,
    /// Fewest sections from here to the end, and the cost of the splits between them; `None` where the end cannot be reached.
    rest: Option<(u32, u32)>,
}

impl Long {
    /// Pieces of a marker that are longer than a window and may be split, by their indices.
    pub(super) fn of(marker: &Marker, stretches: &[Option<Stretch>], job: &Job) -> BTreeMap<usize, Self> {
        let length = job.profile.bite.length_mm.unwrap_or(f64::INFINITY) - ROOM;
        let is_long = |i: usize| {
            let is_long = stretches[i].is_some_and(|Stretch { from, to }| to - from > length);
            is_long && job.selection.has(marker.pieces[i].number)
        };
        let longs: Vec<usize> = (0..marker.pieces.len()).filter(|&i| is_long(i)).collect();
        if longs.is_empty() {
            return BTreeMap::new();
        }
        let nesting = Nesting::of(marker, job.profile.band(marker.unit));
        let lines = Lines::of(marker);
        let long = |i: usize| {
            let outline = outline(i, marker, &nesting).filter(|_| is_plain(&marker.pieces[i], job))?;
            let piece = (&marker.pieces[i], outline);
            Some((i, Self::new(piece, marker, (stretches[i]?, length), &lines, job)))
        };
        longs.into_iter().filter_map(long).collect()
    }

    fn new(
        (piece, outline): (&Piece, Range),
        marker: &Marker,
        (Stretch { from, to }, length): (Stretch, f64),
        lines: &Lines,
        job: &Job,
    ) -> Self {
        let lap = Lap::of(job, marker.unit);
        let ring = Ring::new(&marker.list, outline, ring::area(&marker.list.points(outline)) > 0.0);
        let extent = marker.list.extent(outline);
        let ends = [extent.min.x, extent.max.x];
        let reach = lap.length() + job.profile.knife.reach();
        let grid = ((ends[0] / GRID).ceil() as i64)..((ends[1] / GRID).ceil() as i64);
        let borders = grid.map(|step| step as f64 * GRID);
        let inside = Inside::all(piece, outline, &marker.list);
        let place = |x: f64| {
            let is_held = |one: &Inside| one.beyond(x) <= lap.length();
            let cost = lines.cost(&ring, x, lap).filter(|_| inside.iter().all(is_held))?;
            Some(Place { x, from: x - reach, cost, rest: None })
        };
        let start = Place { x: ends[0], from, cost: 0, rest: None };
        let mut places: Vec<Place> = std::iter::once(start).chain(borders.filter_map(place)).collect();
        for i in (0..places.len()).rev() {
            let begin = places[i];
            let next = places[i + 1..].iter().take_while(|next| next.x + reach - begin.from <= length);
            let ways = next.filter(|next| next.x - begin.x >= SHORTEST).filter_map(Place::with_rest);
            places[i].rest = if to - begin.from <= length { Some((1, 0)) } else { ways.min() };
        }
        Self { outline, ends, places, next: 0, window: None, reach }
    }

    /// Takes out of the rest of the piece what goes with the section before a border.
    pub(super) fn split_off(&self, rest: &mut Piece, border: f64, list: &SegmentList) -> Piece {
        let is_before = |contour: &mut Contour| {
            contour.range != self.outline && Inside::of_contour(contour, list).is_before(border)
        };
        Piece {
            contours: rest.contours.extract_if(.., is_before).collect(),
            drills: rest.drills.extract_if(.., |drill| drill.at.x < border).collect(),
            notches: rest.notches.extract_if(.., |notch| Inside::of_notch(notch).is_before(border)).collect(),
            ..Piece { number: rest.number, copy: rest.copy, span: rest.span, feed: rest.feed, ..Piece::default() }
        }
    }

    /// Start of the stretch that the blade may need for the rest, mm.
    pub(super) fn begins(&self) -> f64 {
        self.places[self.next].from
    }

    /// True if a section in a window would be too many advances behind the one before it: each of them may be off.
    pub(super) fn is_late(&self, window: u32) -> bool {
        self.window.is_some_and(|before| window - before > Bite::MOST_ADVANCES)
    }

    /// Ends of the rest along X, mm.
    pub(super) fn rest(&self) -> [f64; 2] {
        [self.places[self.next].x, self.ends[1]]
    }

    /// Takes the next section in a window, by the number and the end of the window, and returns the ends of the section along
    /// X, mm. `None` if a window of its own would need fewer sections for the rest, or cheaper splits.
    pub(super) fn take(&mut self, window: u32, end: f64) -> Option<[f64; 2]> {
        let begin = self.places[self.next];
        let fits = |next: &&(usize, Place)| next.1.x + self.reach <= end && next.1.x - begin.x >= SHORTEST;
        let all: Vec<(usize, Place)> = self.places.iter().copied().enumerate().skip(self.next + 1).collect();
        let ways = all.iter().filter(fits).filter_map(|&(i, next)| Some((next.with_rest()?, i)));
        let (way, next) = ways.min_by(|a, b| a.0.cmp(&b.0).then(b.1.cmp(&a.1)))?;
        if way > begin.rest? {
            return None;
        }
        (self.next, self.window) = (next, Some(window));
        Some([begin.x, self.places[next].x])
    }
}

impl Place {
    /// Sections and cost of a continuation with a split here, counted from the split before it.
    fn with_rest(&self) -> Option<(u32, u32)> {
        self.rest.map(|(sections, cost)| (sections + 1, cost + self.cost))
    }
}

/// A slit or an inner contour of a piece, which goes whole with one of its sections.
struct Inside {
    /// Place along X that decides between two sections, mm.
    anchor: f64,
    /// Ends along X, mm.
    ends: [f64; 2],
}

impl Inside {
    fn of_notch(notch: &Notch) -> Self {
        let mut extent = Extent::of(&[notch.root]);
        notch.strokes().for_each(|stroke| extent.join(&Extent::between(stroke.from, stroke.to)));
        Self { anchor: notch.root.x, ends: [extent.min.x, extent.max.x] }
    }

    fn of_contour(contour: &Contour, list: &SegmentList) -> Self {
        let Extent { min, max } = list.extent(contour.range);
        Self { anchor: f64::midpoint(min.x, max.x), ends: [min.x, max.x] }
    }

    /// The slits and inner contours of a piece.
    fn all(piece: &Piece, outline: Range, list: &SegmentList) -> Vec<Self> {
        let contours = piece.contours.iter().filter(|contour| contour.range != outline);
        let contours = contours.map(|contour| Self::of_contour(contour, list));
        piece.notches.iter().map(Self::of_notch).chain(contours).collect()
    }

    /// True if it goes with the section before a border.
    fn is_before(&self, border: f64) -> bool {
        self.anchor < border
    }

    /// Distance by which it protrudes from its section at a border, mm.
    fn beyond(&self, border: f64) -> f64 {
        if self.is_before(border) { self.ends[1] - border } else { border - self.ends[0] }
    }
}

/// The outline of a piece that may be split: the closed contour around all its others, in no other piece.
fn outline(piece: usize, marker: &Marker, nesting: &Nesting) -> Option<Range> {
    let own = nesting.of_group(piece);
    let outer = own.clone().find(|&line| nesting.around(line).len() == 0)?;
    let is_in_it = |line: usize| line == outer || nesting.outermost(line) == Some(outer);
    let outline = &marker.pieces[piece].contours[outer - own.start];
    (outline.closed && own.into_iter().all(is_in_it)).then_some(outline.range)
}

/// True if a section of a piece can have the slits and holes in its stretch.
fn is_plain(piece: &Piece, job: &Job) -> bool {
    let is_as_drawn = piece.outline_notches.is_empty() || job.profile.notch.style == NotchStyle::AsDrawn;
    let is_drilled_aside = !piece.drills.is_empty() && job.profile.drill.offset_mm != [0.0; 2];
    is_as_drawn && !is_drilled_aside
}
