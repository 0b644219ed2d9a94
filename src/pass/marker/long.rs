//! Pieces longer than a window of the conveyor, and the places where they are split.
//!
//! Splits are looked for on a grid along X. From the far end back, the best continuation of each place is computed: the fewest
//! sections, then the least cost of the splits between them (dynamic programming). Going forward, a window takes the section
//! that leaves the best rest; among equals, the longest.

use std::collections::BTreeMap;

use super::split::{Lap, Lines, Ring};
use crate::analysis::nesting::Nesting;
use crate::geom::{Point, ring};
use crate::ir::marker::{Marker, Notch, Piece};
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
        let is_plain = |i: &usize| is_plain(&marker.pieces[*i], job) && is_alone(*i, &nesting);
        let long = |i: usize| Some((i, Self::new(i, marker, (stretches[i]?, length), &lines, job)));
        longs.into_iter().filter(is_plain).filter_map(long).collect()
    }

    fn new(piece: usize, marker: &Marker, (stretch, length): (Stretch, f64), lines: &Lines, job: &Job) -> Self {
        let Stretch { from, to } = stretch;
        let lap = Lap::of(job, marker.unit);
        let range = marker.pieces[piece].contours[0].range;
        let ring = Ring::new(&marker.list, range, ring::area(&marker.list.points(range)) > 0.0);
        let extent = marker.list.extent(range);
        let ends = [extent.min.x, extent.max.x];
        let reach = lap.length() + job.profile.knife.reach();
        let grid = ((ends[0] / GRID).ceil() as i64)..((ends[1] / GRID).ceil() as i64);
        let borders = grid.map(|step| step as f64 * GRID);
        let notches = &marker.pieces[piece].notches;
        let place = |x: f64| {
            let cost = lines.cost(&ring, piece, x, lap).filter(|_| holds_slits(x, notches, lap.length()))?;
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
        Self { ends, places, next: 0, window: None, reach }
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

/// True if each slit stays with the section of its root: no end lies farther beyond the border than the halves reach, mm.
fn holds_slits(border: f64, notches: &[Notch], reach: f64) -> bool {
    let holds = |notch: &Notch| {
        let is_early = notch.root.x < border;
        let beyond = |at: Point| if is_early { at.x - border } else { border - at.x };
        notch.strokes().flat_map(|stroke| [stroke.from, stroke.to]).all(|at| beyond(at) <= reach)
    };
    notches.iter().all(holds)
}

/// True if a piece has only a closed outline, slits and holes, all of which a section can have in its window.
fn is_plain(piece: &Piece, job: &Job) -> bool {
    let is_as_drawn = piece.outline_notches.is_empty() || job.profile.notch.style == NotchStyle::AsDrawn;
    let is_drilled_aside = !piece.drills.is_empty() && job.profile.drill.offset_mm != [0.0; 2];
    piece.contours.len() == 1 && piece.contours[0].closed && is_as_drawn && !is_drilled_aside
}

/// True if a piece is in no other, and no other is in it.
fn is_alone(piece: usize, nesting: &Nesting) -> bool {
    let own = nesting.of_group(piece);
    let is_in = |line: usize| nesting.around(line).any(|outer| own.contains(&outer));
    own.clone().all(|line| nesting.around(line).len() == 0) && !(0..nesting.lines().len()).any(is_in)
}
