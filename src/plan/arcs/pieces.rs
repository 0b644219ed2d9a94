//! Pieces of a path, one per motion of the tip that is long enough to be written.

use super::tip::LENGTH_EPSILON;
use crate::geom::{Point, Vector, angle, cross, left};
use crate::ir::arcs::{Arc, Path, Piece};
use crate::ir::toolpath::Pose;

/// Turn below which an arc becomes a line, rad: controllers take arcs of a millionth for full circles.
const TURN_MIN: f64 = 2e-5;
/// Chord sagitta below which an arc becomes a line, mm.
const SAGITTA_MIN: f64 = 1e-5;

/// A motion of the tip along one arc or line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tip {
    /// Start and end point.
    pub(super) ends: [Point; 2],
    /// Unit vector along it at the start.
    pub(super) along: Vector,
    /// Turn, rad.
    pub(super) turn: f64,
    /// Additional turn of the path of the C axis, rad, while the blade fades from chord to tangent.
    pub(super) more: f64,
    /// Length, mm.
    pub(super) length: f64,
    /// Maximum speed, mm/s.
    pub(super) feed: f64,
}

/// Limits for merging pieces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joining {
    /// Length below which a piece is merged if that costs little, mm.
    pub(super) length_min: f64,
    /// Length below which a piece is always merged, mm.
    pub(super) length_least: f64,
    /// Direction error above which a piece is merged with the one before it, if that is better than the one after, rad.
    pub(super) askew_max: f64,
    /// Maximum direction error from merging a piece that could be written by itself, rad.
    pub(super) askew_fair: f64,
    /// Maximum distance from the tip's path that such a merge may cause, mm.
    pub(super) off_fair: f64,
}

/// Errors caused by merging two motions of the tip.
#[derive(Debug, Clone, Copy)]
struct Joined {
    /// Direction error, rad.
    askew: f64,
    /// Maximum distance from the original path at the joint and at the middle of each motion, mm.
    off: f64,
}

/// Merges pieces that are too short to be written with the following piece. At the end, and where one common arc has a smaller
/// direction error, the previous piece is used. A short piece stays as it is where both merges would leave the tip's path.
pub(super) struct Pieces {
    path: Path,
    /// Start of the last piece, and the motion of the tip on it.
    last: Option<(Pose, Tip)>,
    /// Start of the next piece.
    next: Pose,
    /// Pending motion that is too short to be written, and its end.
    short: Option<(Pose, Tip)>,
    joining: Joining,
}

/// The piece of the axis path from `from` to `to` that corresponds to a motion of the tip.
fn piece(from: Pose, to: Pose, tip: Tip) -> Piece {
    let chord = to.centre - from.centre;
    let turn = tip.turn + tip.more;
    let (width, half) = (chord.norm(), 0.5 * turn);
    let is_bent = width * half.abs() / 4.0 > SAGITTA_MIN && turn.abs() > TURN_MIN;
    let (arc, length) = if width > LENGTH_EPSILON && is_bent {
        let centre = from.centre + chord * 0.5 + left(chord) * (0.5 / half.tan());
        (Some(Arc { centre, turn }), width * half / half.sin())
    } else {
        (None, width)
    };
    Piece { to, arc, length, speed: tip.feed * length / tip.length, feed: tip.feed }
}

impl Pieces {
    /// An empty path with capacity for `pieces` pieces.
    pub(super) fn with_room(pieces: usize, start: Pose, joining: Joining) -> Self {
        let path = Path { pieces: Vec::with_capacity(pieces), ..Path::plunge(start) };
        Self { path, last: None, next: start, short: None, joining }
    }

    pub(super) fn push(&mut self, to: Pose, tip: Tip) {
        let mut tip = tip;
        if let Some((end, short)) = self.short.take() {
            let forward = short.joined(tip);
            let backward = self.last.map(|(_, last)| last.joined(short));
            let Joining { askew_max, .. } = self.joining;
            let is_better = |back: &Joined| {
                let is_straighter = forward.askew > askew_max && back.askew < forward.askew;
                if self.is_fair(&forward) {
                    is_straighter && self.is_fair(back)
                } else {
                    is_straighter || self.is_fair(back)
                }
            };
            if self.is_told(end) && !self.is_fair(&forward) && !backward.as_ref().is_some_and(|back| self.is_fair(back))
            {
                self.add(end, short);
            } else if backward.as_ref().is_some_and(is_better) {
                self.join(end, short);
            } else {
                tip = short.and(tip);
            }
        }
        if (to.centre - self.next.centre).norm() < self.joining.length_min {
            self.short = Some((to, tip));
        } else {
            self.add(to, tip);
        }
    }

    /// True if a merge costs so little that the piece need not be written by itself.
    fn is_fair(&self, joined: &Joined) -> bool {
        joined.askew <= self.joining.askew_fair && joined.off <= self.joining.off_fair
    }

    /// True if a piece from the end of the last one to a pose is long enough to be written.
    fn is_told(&self, to: Pose) -> bool {
        (to.centre - self.next.centre).norm() >= self.joining.length_least
    }

    /// Appends a piece.
    fn add(&mut self, to: Pose, tip: Tip) {
        self.path.pieces.push(piece(self.next, to, tip));
        (self.last, self.next) = (Some((self.next, tip)), to);
    }

    /// Merges a motion that ends at a pose into the last piece.
    fn join(&mut self, to: Pose, tip: Tip) {
        let (from, tip) = self.last.map_or((self.next, tip), |(from, last)| (from, last.and(tip)));
        self.path.pieces.pop();
        self.path.pieces.push(piece(from, to, tip));
        (self.last, self.next) = (Some((from, tip)), to);
    }

    pub(super) fn finish(mut self) -> Path {
        if let Some((to, tip)) = self.short {
            let is_fair = self.last.is_none_or(|(_, last)| self.is_fair(&last.joined(tip)));
            if is_fair || !self.is_told(to) { self.join(to, tip) } else { self.add(to, tip) }
        }
        self.path
    }
}

impl Tip {
    fn and(self, next: Self) -> Self {
        Self {
            ends: [self.ends[0], next.ends[1]],
            along: self.along,
            turn: self.turn + next.turn,
            more: self.more + next.more,
            length: self.length + next.length,
            feed: self.feed.min(next.feed),
        }
    }

    /// Errors of merging it with the next motion.
    fn joined(self, next: Self) -> Joined {
        let both = self.and(next);
        let off = [next.ends[0], self.middle(), next.middle()].map(|place| both.off(place));
        Joined { askew: both.askew(), off: off.into_iter().fold(0.0, f64::max) }
    }

    /// Point at its middle.
    fn middle(&self) -> Point {
        let chord = self.ends[1] - self.ends[0];
        self.ends[0] + chord * 0.5 - left(chord) * (self.turn / 8.0)
    }

    /// Direction error at both ends of a single arc from its start to its end, rad; 0 for an exact arc.
    fn askew(&self) -> f64 {
        let chord = self.ends[1] - self.ends[0];
        angle::wrap(angle::turn(self.along, chord) - 0.5 * self.turn).abs()
    }

    /// Distance of a place from a single arc with its ends and its turn, mm.
    fn off(&self, place: Point) -> f64 {
        let [start, end] = self.ends;
        let chord = end - start;
        let width = chord.norm();
        let away = place - start;
        if width <= LENGTH_EPSILON {
            return away.norm();
        }
        // Approximate the arc by a parabola: its middle is an eighth of the turn times the chord away from the chord.
        let share = away.dot(&chord) / (width * width);
        let sagitta = -0.5 * self.turn * share * (1.0 - share) * width;
        (cross(chord, away) / width - sagitta).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::arcs::fit;

    #[test]
    fn what_is_too_short_to_be_told_is_joined_to_what_it_lies_along() {
        let check = |curvatures: [f64; 3], expected: f64| {
            let (mut at, mut along) = (Point::origin(), Vector::new(1.0, 0.0));
            let joining =
                Joining { length_min: 0.04, length_least: 0.005, askew_max: 0.002, askew_fair: 0.1, off_fair: 0.01 };
            let mut pieces = Pieces::with_room(3, Pose::default(), joining);
            for (length, curvature) in [0.66, 0.02, 0.68].into_iter().zip(curvatures) {
                let arc = fit::Arc { from: at, along, length, curvature, chord: 0, stops: false };
                let ends = [at, arc.at(length)];
                pieces.push(
                    Pose { centre: ends[1], ..Pose::default() },
                    Tip { ends, along, turn: arc.turn(), more: 0.0, length, feed: 1.0 },
                );
                (at, along) = (ends[1], arc.along_at(length));
            }
            let path = pieces.finish();
            assert_eq!((path.pieces.len(), path.pieces[1].to.centre), (2, at));
            assert!((path.pieces[0].length - expected).abs() < 1e-6, "{}", path.pieces[0].length);
        };
        // One arc for the end of a left turn and a right turn would be skewed to both.
        check([0.5, 0.5, -0.5], 0.68);
        check([-0.5, 0.5, 0.5], 0.66);
        // With a small error, it is merged with the following piece.
        check([0.01, 0.01, -0.01], 0.66);
    }
}
