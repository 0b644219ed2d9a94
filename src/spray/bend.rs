//! Bends of the curves that chords stand for: their turn about each vertex, and their curvature.

use super::edge::Ring;

/// Ratio of neighbouring chords above which the longer one is straight and not part of the curve that begins at their vertex.
const SAME_CURVE: f64 = 4.0;
/// Length to either side of a vertex over which the curvature is averaged, mm: roughly what a jet covers at once.
const MEAN_WAY: f64 = 15.0;
/// Gap between two bends, as a fraction of the chord, that counts as rounding.
const JOINED_EPSILON: f64 = 1e-6;
/// Length below which a path is empty, mm.
const WAY_EPSILON: f64 = 1e-7;

/// The part of a curve about a vertex, on which the direction turns uniformly. A curve that begins or ends at a corner has half
/// a bend there: its direction at the corner differs from that of its chord by half the turn of a bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bend {
    /// Inward normal of the curve at the start of the bend, rad.
    pub(super) start: f64,
    /// Turn, rad; positive to the left.
    pub(super) turn: f64,
    /// Lengths of the bend along the chords before and behind the vertex, mm.
    pub(super) reach: [f64; 2],
    /// Curvature, 1/mm.
    pub(super) curvature: f64,
}

impl Bend {
    /// Length of the head's path through the bend at a distance from the edge, mm.
    pub(super) fn way(&self, distance: f64) -> f64 {
        self.reach[0] + distance * self.turn + self.reach[1]
    }

    /// Inward normal of the curve, rad, at a length of the head's path through the bend, mm.
    pub(super) fn aim(&self, way: f64, distance: f64) -> f64 {
        let all = self.way(distance);
        let share = if all > WAY_EPSILON { (way / all).clamp(0.0, 1.0) } else { 0.5 };
        self.start + self.turn * share
    }
}

impl Ring {
    /// The bends of the curves that arrive at a vertex and leave it; both are the same unless the vertex is a corner.
    pub(super) fn bends(&self, vertex: usize) -> [Bend; 2] {
        if !self.is_corner(vertex) {
            let start = self.inwards(self.before(vertex));
            let bend =
                Bend { start, turn: self.turns[vertex], reach: self.reach(vertex), curvature: self.curvature(vertex) };
            return [bend; 2];
        }
        let halves = [0, 1].map(|side| self.half(vertex, side));
        // A corner that turns inwards, or less than the two half bends, leaves the head no path around it.
        let has_room = halves[0].turn + halves[1].turn <= self.turns[vertex];
        if has_room { halves } else { [self.before(vertex), vertex].map(|chord| self.straight(chord)) }
    }

    /// An empty bend at an end of a chord.
    fn straight(&self, chord: usize) -> Bend {
        Bend { start: self.inwards(chord), turn: 0.0, reach: [0.0; 2], curvature: 0.0 }
    }

    /// The half bend of a curve that ends at a corner (`side` 0) or begins there (1). Only curves that turn outwards have one;
    /// the head reaches the start of an inward curve straight along its chord.
    fn half(&self, corner: usize, side: usize) -> Bend {
        let before = self.before(corner);
        let [chord, other] = if side == 0 { [before, before] } else { [corner, self.behind(corner)] };
        let (mut bend, reach) = (self.straight(chord), 0.5 * self.length(chord));
        let is_of_curve = self.reach(other)[1 - side] >= reach * (1.0 - JOINED_EPSILON);
        if is_of_curve && self.turns[other] > 0.0 {
            bend.turn = 0.5 * self.turns[other];
            bend.curvature = self.curvature(other);
            bend.reach[side] = reach;
            bend.start -= if side == 0 { 0.0 } else { bend.turn };
        }
        bend
    }

    /// Lengths of the curve through a vertex before and behind it, mm: half of each chord, limited by the length of the other
    /// one; 0 at a corner.
    fn reach(&self, vertex: usize) -> [f64; 2] {
        if self.is_corner(vertex) {
            return [0.0; 2];
        }
        let [before, behind] = [self.length(self.before(vertex)), self.length(vertex)];
        [before.min(SAME_CURVE * behind), behind.min(SAME_CURVE * before)].map(|length| 0.5 * length)
    }

    /// Curvature about a vertex, 1/mm: the mean over adjoining bends on both sides, up to the next corner. The curvature of a
    /// single bend would carry the rounding of three vertices.
    fn curvature(&self, vertex: usize) -> f64 {
        let n = self.points.len();
        let (mut turn, mut way) = (self.turns[vertex], self.reach(vertex).iter().sum::<f64>());
        for (step, side) in [(1, 1), (n - 1, 0)] {
            let (mut last, mut left) = (vertex, MEAN_WAY);
            for _ in 1..n {
                let next = (last + step) % n;
                let reach = self.reach(next);
                let between = self.length(if side == 1 { last } else { next });
                let together = self.reach(last)[side] + reach[1 - side];
                left -= reach[0] + reach[1];
                if left < 0.0 || between - together > JOINED_EPSILON * between {
                    break;
                }
                turn += self.turns[next];
                way += reach[0] + reach[1];
                last = next;
            }
        }
        if way > 0.0 { turn / way } else { 0.0 }
    }
}
