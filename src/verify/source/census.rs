//! Statistics of everything that is cut: counted from a marker and, by other means, from the bytes that it was read from.

use std::collections::BTreeMap;

use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, bits, polyline};
use crate::ir::Marker;
use crate::ir::drawing::{Account, Aside, Redrawn, Vertex};
use crate::ir::marker::Notch;

/// Greatest distance of the chords of an arc from the arc, as a fraction of the tolerance: a coarser approximation leaves the
/// knife no room.
pub(in crate::verify) const ARC_SAGITTA: f64 = 0.25;
/// Greatest distance by which a place of a drawing may be moved to make lines meet, mm: a third of a millimetre is invisible on
/// any part.
const REDRAWN: f64 = 0.3;

/// Statistics of everything that is cut: points reached with the knife down, holes, length and bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Census {
    /// Number of points that the knife reaches while it is down.
    pub points: usize,
    /// Number of holes.
    pub drills: usize,
    /// Path length of the knife while it is down, mm.
    pub length: f64,
    /// Bounding box.
    pub bounds: Extent,
    /// Unit of which the numbers of the file are multiples, mm.
    pub unit: f64,
    /// Moments of the lines, which detect a stroke moved inside the box; the other numbers do not. Only for plots.
    pub(in crate::verify) moments: Moments,
}

impl Census {
    /// Empty census of a file with numbers that are multiples of `unit` mm.
    pub(in crate::verify) fn empty(unit: f64) -> Self {
        Self { points: 0, drills: 0, length: 0.0, bounds: Extent::EMPTY, unit, moments: Moments::default() }
    }

    /// Census of a marker as read, before any pass.
    pub fn of(marker: &Marker) -> Self {
        let mut census = Self { length: marker.drawn_length(), ..Self::empty(marker.unit) };
        let is_plot = marker.drawing.is_some();
        for piece in &marker.pieces {
            // A stroke without length cuts nothing.
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
                    // The chords of an arc come from one place of the file and count as one point.
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

    /// Adds the lines of a plot that are not cut: the marker keeps all of them.
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
        // An edge that two parts share may be drawn only once; discount it only if it stands twice.
        for places in doubled {
            let moments = Moments::of(places.iter().map(|vertex| vertex.at));
            self.length -= moments.length();
            self.moments -= moments;
        }
        // Lines that were added to close outlines are not in the file.
        for places in &aside.moved.closed {
            let moments = Moments::of(places.iter().copied());
            self.length -= moments.length();
            self.moments -= moments;
        }
        // A line that was moved too far counts as a different one, whatever the account says.
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

/// Bits of the ends of a chord, independent of its direction.
type Chord = [[u64; 2]; 2];

fn chord_of(from: Point, to: Point) -> Chord {
    let mut ends = [from, to].map(bits);
    ends.sort_unstable();
    ends
}

/// Number of occurrences of each chord among the lines that a marker cuts and those that it keeps besides.
fn standing(marker: &Marker, aside: &Aside) -> BTreeMap<Chord, usize> {
    let mut standing = BTreeMap::new();
    let cut = marker.pieces.iter().flat_map(|piece| &piece.contours);
    let cut = cut.flat_map(|contour| marker.list.walk(contour.range)).map(|(_, line)| chord_of(line.from, line.to));
    let kept = aside.each().flat_map(|(_, places)| places.windows(2)).map(|ends| chord_of(ends[0].at, ends[1].at));
    cut.chain(kept).for_each(|chord| *standing.entry(chord).or_default() += 1);
    standing
}

/// True if every place of a drawn line is near its present position, and its ends are near the present ends.
fn is_redrawn_nearby(Redrawn { drawn, now: [from, to] }: &Redrawn) -> bool {
    let [Some(first), Some(last)] = [drawn.first(), drawn.last()] else { return false };
    let off = |place: &Point| polyline::distance_to_segment(*place, *from, *to);
    let ends = [(first - from).norm(), (last - to).norm()];
    drawn.iter().map(off).chain(ends).all(|distance| distance <= REDRAWN)
}

/// Permitted differences due to chords of arcs, mm.
pub(in crate::verify) struct Slack {
    /// Greatest distance of a chord from its arc.
    pub(in crate::verify) sagitta: f64,
    pub(in crate::verify) length: f64,
    pub(in crate::verify) bounds: f64,
    /// Permitted difference of moments; compared only for plots.
    pub(in crate::verify) moments: Moments,
}
