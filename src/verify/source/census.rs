//! What is cut, as numbers: counted of a marker and, by other means, of the bytes that it was read from.

use std::collections::BTreeMap;

use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, bits, polyline};
use crate::ir::Marker;
use crate::ir::drawing::{Account, Aside, Redrawn, Vertex};
use crate::ir::marker::Notch;

/// Farthest that the chords of an arc may lie off it, as a part of the tolerance: a curve that is drawn coarser leaves the
/// knife no room.
pub(in crate::verify) const ARC_SAGITTA: f64 = 0.25;
/// Farthest that a place of a drawing may be moved so that lines meet, mm: a third of a millimetre shows on no part.
const REDRAWN: f64 = 0.3;

/// What is cut: points reached with the knife down, holes, length and bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Census {
    /// Points that the knife is led to while it is down.
    pub points: usize,
    /// Holes.
    pub drills: usize,
    /// Way of the knife while it is down, mm.
    pub length: f64,
    /// The box around all of it.
    pub bounds: Extent,
    /// What the numbers of the file are multiples of, mm.
    pub unit: f64,
    /// Where it lies: a stroke that is moved within the box keeps all of the above. Of plots only.
    pub(in crate::verify) moments: Moments,
}

impl Census {
    /// Nothing yet of a file whose numbers are multiples of that many mm.
    pub(in crate::verify) fn empty(unit: f64) -> Self {
        Self { points: 0, drills: 0, length: 0.0, bounds: Extent::EMPTY, unit, moments: Moments::default() }
    }

    /// The census of a marker as it was read, before any pass.
    pub fn of(marker: &Marker) -> Self {
        let mut census = Self { length: marker.drawn_length(), ..Self::empty(marker.unit) };
        let is_plot = marker.drawing.is_some();
        for piece in &marker.pieces {
            // What has no length cuts nothing.
            for stroke in piece.notches.iter().flat_map(Notch::strokes).filter(|stroke| stroke.from != stroke.to) {
                census.points += 1;
                census.bounds.add(stroke.from);
                census.bounds.add(stroke.to);
                if is_plot {
                    census.moments += Moments::line(stroke.from, stroke.to);
                }
            }
            piece.drills.iter().for_each(|drill| census.bounds.add(drill.at));
            census.drills += piece.drills.len();
            for contour in &piece.contours {
                let mut span = None;
                if is_plot {
                    census.moments += Moments::of(marker.list.points(contour.range).iter().copied());
                }
                for (_, segment) in marker.list.walk(contour.range) {
                    census.bounds.add(segment.from);
                    census.bounds.add(segment.to);
                    // The chords of an arc come from one place and are one point of the file.
                    let is_new = segment.span.block == 0 || span.replace(segment.span) != Some(segment.span);
                    census.points += usize::from(is_new && segment.from != segment.to);
                }
            }
        }
        if let Some(account) = &marker.drawing {
            census.add_aside(marker, account);
        }
        census
    }

    /// Adds what a plot draws beyond what is cut: its marker keeps all of it.
    fn add_aside(&mut self, marker: &Marker, Account { aside, .. }: &Account) {
        let standing = if aside.moved.doubled.is_empty() { BTreeMap::new() } else { standing(marker, aside) };
        let stands_twice =
            |chord: &[Vertex]| standing.get(&chord_of(chord[0].at, chord[1].at)).is_some_and(|&count| count > 1);
        let doubled = aside.moved.doubled.iter().filter(|places| places.windows(2).all(stands_twice));
        for (_, vertices) in aside.each() {
            let mut span = None;
            let moments = Moments::of(vertices.iter().map(|vertex| vertex.at));
            self.length += moments.length();
            self.moments += moments;
            for vertex in vertices {
                self.bounds.add(vertex.at);
            }
            self.points +=
                vertices.iter().skip(1).filter(|vertex| span.replace(vertex.span) != Some(vertex.span)).count();
        }
        self.points = (self.points + aside.moved.points).saturating_sub(aside.moved.repeated);
        // An edge that two parts share may be drawn once; what does not stand twice does not.
        for places in doubled {
            let moments = Moments::of(places.iter().map(|vertex| vertex.at));
            self.length -= moments.length();
            self.moments -= moments;
        }
        // Nobody drew the lines that close outlines.
        for places in &aside.moved.closed {
            let moments = Moments::of(places.iter().copied());
            self.length -= moments.length();
            self.moments -= moments;
        }
        // What was drawn elsewhere is another line, whatever the account says.
        for Redrawn { drawn, now: [from, to] } in aside.moved.redrawn.iter().filter(|line| is_redrawn_nearby(line)) {
            let moments = [Moments::of(drawn.iter().copied()), Moments::line(*from, *to)];
            self.length += moments[0].length() - moments[1].length();
            self.moments += moments[0];
            self.moments -= moments[1];
            for &place in drawn {
                self.bounds.add(place);
            }
        }
    }
}

/// The bits of the ends of a chord, in either direction.
type Chord = [[u64; 2]; 2];

fn chord_of(from: Point, to: Point) -> Chord {
    let mut ends = [from, to].map(bits);
    ends.sort_unstable();
    ends
}

/// How often each chord stands in what a marker cuts and what it keeps beside that.
fn standing(marker: &Marker, aside: &Aside) -> BTreeMap<Chord, usize> {
    let mut standing = BTreeMap::new();
    let cut = marker.pieces.iter().flat_map(|piece| &piece.contours);
    let cut = cut.flat_map(|contour| marker.list.walk(contour.range)).map(|(_, line)| chord_of(line.from, line.to));
    let kept = aside.each().flat_map(|(_, places)| places.windows(2)).map(|ends| chord_of(ends[0].at, ends[1].at));
    cut.chain(kept).for_each(|chord| *standing.entry(chord).or_default() += 1);
    standing
}

/// Whether every place of a line as it was drawn lies near to what it is now, and its ends near to the ends.
fn is_redrawn_nearby(Redrawn { drawn, now: [from, to] }: &Redrawn) -> bool {
    let [Some(first), Some(last)] = [drawn.first(), drawn.last()] else { return false };
    let off = |place: &Point| polyline::distance_to_segment(*place, *from, *to);
    let ends = [(first - from).norm(), (last - to).norm()];
    drawn.iter().map(off).chain(ends).all(|distance| distance <= REDRAWN)
}

/// What the chords of arcs may change, mm.
pub(in crate::verify) struct Slack {
    /// Farthest that a chord may lie off its arc.
    pub(in crate::verify) sagitta: f64,
    pub(in crate::verify) length: f64,
    pub(in crate::verify) bounds: f64,
    /// What moments may differ; compared for plots.
    pub(in crate::verify) moments: Moments,
}
