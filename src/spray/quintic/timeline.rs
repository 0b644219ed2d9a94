//! Motion of a pass over time: the fits, joined by transitions of order 5 that keep position, speed and acceleration at both
//! ends.

use super::polynomial::{Polynomial, State};
use super::split::{Fit, worst};
use crate::machine::Limits;
use crate::spray::clock::Timed;

/// Fractions of the shorter of two adjoining pieces that a transition may replace on either side. The first one that the axes
/// can follow is used.
const WINDOWS: [f64; 5] = [0.1, 0.16, 0.25, 0.36, 0.5];
/// Fraction of the axis limits that transitions may use.
const SHARE: f64 = 0.8;
/// Number of steps at which a transition is checked.
const PLACES: usize = 24;
/// Time below which two pieces adjoin, s.
const MEETING_EPSILON: f64 = 1e-9;

/// A motion from rest to rest.
#[derive(Debug)]
pub(super) struct Timeline {
    /// Each piece with its end time, s.
    pieces: Vec<(f64, Polynomial)>,
}

/// An anchor of transitions: a fit, or rest at an end.
enum Anchor<'a> {
    Rest(Timed),
    Fit(&'a Polynomial),
}

impl Anchor<'_> {
    fn ends(&self) -> [f64; 2] {
        match self {
            Self::Rest(at) => [at.time; 2],
            Self::Fit(polynomial) => polynomial.ends,
        }
    }

    /// Duration, s; 0 for rest.
    fn room(&self) -> f64 {
        match self {
            Self::Rest(_) => 0.0,
            Self::Fit(polynomial) => polynomial.ends[1] - polynomial.ends[0],
        }
    }

    fn at(&self, time: f64) -> State {
        match self {
            Self::Rest(Timed { node, .. }) => [node.at.x, node.at.y, node.aim].map(|place| [place, 0.0, 0.0]),
            Self::Fit(polynomial) => polynomial.at(time),
        }
    }
}

impl Timeline {
    /// Joins consecutive fits, from rest at the first place to rest at the last. `None` if a transition cannot be solved.
    pub(super) fn new<'a>(
        fits: impl Iterator<Item = &'a Fit>,
        [first, last]: [Timed; 2],
        limits: &[Limits; 3],
    ) -> Option<Self> {
        let mut anchors = vec![Anchor::Rest(first)];
        anchors.extend(fits.map(|fit| Anchor::Fit(&fit.polynomial)));
        anchors.push(Anchor::Rest(last));
        let mut pieces = Vec::new();
        for pair in anchors.windows(2) {
            let [before, behind] = pair else { unreachable!("windows are pairs") };
            let transition = transition(before, behind, limits)?;
            if let Anchor::Fit(polynomial) = before {
                pieces.push((transition.ends[0], (*polynomial).clone()));
            }
            pieces.push((transition.ends[1], transition));
        }
        Some(Self { pieces })
    }

    /// State at a time.
    pub(super) fn at(&self, time: f64) -> State {
        let piece = self.pieces.partition_point(|(until, _)| *until < time).min(self.pieces.len() - 1);
        self.pieces[piece].1.at(time)
    }

    /// Maximum deviation from samples at their times, mm and rad.
    pub(super) fn worst<'a>(&self, samples: impl Iterator<Item = &'a Timed>) -> [f64; 2] {
        worst(|time| self.at(time), samples)
    }
}

/// The transition between two anchors. It fills the time between them; if they adjoin, it replaces the smallest fraction of
/// both with which the axes can follow.
fn transition(before: &Anchor, behind: &Anchor, limits: &[Limits; 3]) -> Option<Polynomial> {
    let between = |ends: [f64; 2]| Polynomial::between(ends, [before.at(ends[0]), behind.at(ends[1])]);
    let (end, start) = (before.ends()[1], behind.ends()[0]);
    if start - end > MEETING_EPSILON {
        return between([end, start]);
    }
    let (back, on) = (before.room(), behind.room());
    let room = if back > 0.0 && on > 0.0 { back.min(on) } else { back.max(on) };
    let mut transition = None;
    for share in WINDOWS {
        transition = between([end - (share * room).min(back), end + (share * room).min(on)]);
        if transition.as_ref().is_some_and(|transition| is_gentle(transition, limits)) {
            break;
        }
    }
    transition
}

/// True if the axes can follow a polynomial.
fn is_gentle(polynomial: &Polynomial, limits: &[Limits; 3]) -> bool {
    let [from, to] = polynomial.ends;
    let step = (to - from) / PLACES as f64;
    let states: Vec<State> = (0..=PLACES).map(|i| polynomial.at(from + step * i as f64)).collect();
    let is_gentle = |pair: &[State]| {
        (0..3).all(|axis| {
            let [before, behind] = [pair[0][axis], pair[1][axis]];
            behind[1].abs() <= SHARE * limits[axis].speed
                && behind[2].abs() <= SHARE * limits[axis].acceleration
                && (behind[2] - before[2]).abs() <= SHARE * limits[axis].jerk * step
        })
    };
    states.windows(2).all(is_gentle)
}
