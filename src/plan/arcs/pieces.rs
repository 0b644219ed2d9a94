//! Pieces of a path, one for each way of the tip that is long enough to be told.

use super::tip::LENGTH_EPSILON;
use crate::geom::{Point, Vector, angle, cross, left};
use crate::ir::arcs::{Arc, Path, Piece};
use crate::ir::toolpath::Pose;

/// An arc that turns by less is a line, rad: controllers take those of a millionth for whole turns.
const TURN_MIN: f64 = 2e-5;
/// An arc with a smaller chord sagitta is a line, mm.
const SAGITTA_MIN: f64 = 1e-5;

/// A way of the tip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tip {
    /// Where it starts and ends.
    pub(super) ends: [Point; 2],
    /// Unit vector along it where it starts.
    pub(super) along: Vector,
    /// How far it turns, rad.
    pub(super) turn: f64,
    /// How much more the way of the C axis turns beside it, rad: where the blade fades from chord to tangent.
    pub(super) more: f64,
    /// mm.
    pub(super) length: f64,
    /// Its greatest speed, mm/s.
    pub(super) feed: f64,
}

/// What joining pieces may cost, and which are joined.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joining {
    /// Shorter pieces are joined when that costs little, mm.
    pub(super) length_min: f64,
    /// Shorter ones always are, mm.
    pub(super) length_least: f64,
    /// One that would lie farther askew to the way of the tip is joined with what is before it if that is better, rad.
    pub(super) askew_max: f64,
    /// By how much a joined piece may lie askew to the way of the tip where it could be told by itself, rad.
    pub(super) askew_fair: f64,
    /// By how much that may leave the way of the tip, mm.
    pub(super) off_fair: f64,
}

/// What joining two ways of the tip costs.
#[derive(Debug, Clone, Copy)]
struct Joined {
    /// By how much it lies askew to the way of the tip, rad.
    askew: f64,
    /// How far it leaves that where they are joined and in the middle of each, mm.
    off: f64,
}

/// Joins what is too short to be told with what comes behind it; with what is before it at the end, and where one arc for
/// both would lie less askew to them. Where either would leave the way of the tip it is told as short as it is.
pub(super) struct Pieces {
    path: Path,
    /// Where the last piece begins, and what the tip does on it.
    last: Option<(Pose, Tip)>,
    /// Where the next piece begins.
    next: Pose,
    /// What the tip did since, and where that ends: too short to be told.
    short: Option<(Pose, Tip)>,
    joining: Joining,
}

/// The piece from a pose along which the tip goes a way that turns.
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
    /// None yet, with room for so many.
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

    /// Whether joining costs so little that a piece need not be told.
    fn is_fair(&self, joined: &Joined) -> bool {
        joined.askew <= self.joining.askew_fair && joined.off <= self.joining.off_fair
    }

    /// Whether a piece from the last one to a pose is long enough to be told.
    fn is_told(&self, to: Pose) -> bool {
        (to.centre - self.next.centre).norm() >= self.joining.length_least
    }

    /// Adds a piece.
    fn add(&mut self, to: Pose, tip: Tip) {
        self.path.pieces.push(piece(self.next, to, tip));
        (self.last, self.next) = (Some((self.next, tip)), to);
    }

    /// Makes what the tip does up to a pose part of the last piece.
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

    /// What joining it with the next one costs.
    fn joined(self, next: Self) -> Joined {
        let both = self.and(next);
        let off = [next.ends[0], self.middle(), next.middle()].map(|place| both.off(place));
        Joined { askew: both.askew(), off: off.into_iter().fold(0.0, f64::max) }
    }

    /// The place in its middle.
    fn middle(&self) -> Point {
        let chord = self.ends[1] - self.ends[0];
        self.ends[0] + chord * 0.5 - left(chord) * (self.turn / 8.0)
    }

    /// By how much one arc from its start to its end lies askew to it at both, rad: none when it is that arc.
    fn askew(&self) -> f64 {
        let chord = self.ends[1] - self.ends[0];
        angle::wrap(angle::turn(self.along, chord) - 0.5 * self.turn).abs()
    }

    /// How far a place on it lies beside one arc from its start to its end that turns as it does, mm.
    fn off(&self, place: Point) -> f64 {
        let [start, end] = self.ends;
        let chord = end - start;
        let width = chord.norm();
        let away = place - start;
        if width <= LENGTH_EPSILON {
            return away.norm();
        }
        // A parabola of that turn: its middle lies beside the chord by an eighth of the turn.
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
        // One arc for the end of a turn to the left and a turn to the right would be askew to both.
        check([0.5, 0.5, -0.5], 0.68);
        check([-0.5, 0.5, 0.5], 0.66);
        // Where it hardly would, it is joined with what comes.
        check([0.01, 0.01, -0.01], 0.66);
    }
}
