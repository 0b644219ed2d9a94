//! The curves that chords stand for: how far they turn about each vertex, and their curvature there.

use super::edge::Ring;

/// A chord that is longer than the next by more than this factor is straight, and no chord of the curve that begins there.
const SAME_CURVE: f64 = 4.0;
/// How far to both sides of a vertex its curvature is the mean of, mm: about what a jet covers at once.
const MEAN_WAY: f64 = 15.0;
/// Share of a chord by which what is left between two bends is rounding.
const JOINED_EPSILON: f64 = 1e-6;
/// Ways that are shorter are none, mm.
const WAY_EPSILON: f64 = 1e-7;

/// The part of a curve about a vertex, over which its direction turns evenly. A curve that ends or begins at a corner has
/// half of one there: its own direction at the corner is half a turn off that of its chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bend {
    /// The direction across the curve, to the inside, where the bend begins, rad.
    pub(super) start: f64,
    /// How far it turns, rad: to the left is positive.
    pub(super) turn: f64,
    /// How far it reaches along the chords before and behind the vertex, mm.
    pub(super) reach: [f64; 2],
    /// Its curvature, 1/mm.
    pub(super) curvature: f64,
}

impl Bend {
    /// The way of a head at a distance through the bend, mm.
    pub(super) fn way(&self, distance: f64) -> f64 {
        self.reach[0] + distance * self.turn + self.reach[1]
    }

    /// The direction across the curve, rad, when a head at a distance is so far into the bend, mm.
    pub(super) fn aim(&self, way: f64, distance: f64) -> f64 {
        let all = self.way(distance);
        let share = if all > WAY_EPSILON { (way / all).clamp(0.0, 1.0) } else { 0.5 };
        self.start + self.turn * share
    }
}

impl Ring {
    /// How the curve turns that comes to a vertex, and that which leaves it: but at a corner the same.
    pub(super) fn bends(&self, vertex: usize) -> [Bend; 2] {
        if !self.is_corner(vertex) {
            let start = self.inwards(self.before(vertex));
            let bend =
                Bend { start, turn: self.turns[vertex], reach: self.reach(vertex), curvature: self.curvature(vertex) };
            return [bend; 2];
        }
        let halves = [0, 1].map(|side| self.half(vertex, side));
        // What turns as little as the curves themselves, or inwards, gives the head no way around the corner.
        let has_room = halves[0].turn + halves[1].turn <= self.turns[vertex];
        if has_room { halves } else { [self.before(vertex), vertex].map(|chord| self.straight(chord)) }
    }

    /// No bend at an end of a chord.
    fn straight(&self, chord: usize) -> Bend {
        Bend { start: self.inwards(chord), turn: 0.0, reach: [0.0; 2], curvature: 0.0 }
    }

    /// The half bend of a curve that ends at a corner (`side` 0), or begins there (1). Only of a curve outwards: to the
    /// start of one inwards the head comes straight along its chord.
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

    /// How far the curve through a vertex reaches before and behind it, mm: half of each chord, as far as the other is one of
    /// the same curve; nothing at a corner.
    fn reach(&self, vertex: usize) -> [f64; 2] {
        if self.is_corner(vertex) {
            return [0.0; 2];
        }
        let [before, behind] = [self.length(self.before(vertex)), self.length(vertex)];
        [before.min(SAME_CURVE * behind), behind.min(SAME_CURVE * before)].map(|length| 0.5 * length)
    }

    /// The curvature about a vertex, 1/mm: the mean over the bends to both sides that go on in each other, not across a corner.
    /// Of one bend alone it would carry the rounding of three vertices.
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
