//! How a blade lies over the start of a run, where it plunges as a chord.

use super::chord::{Tight, least_radius, radius, stands_across};
use super::nibble::NIBBLE_SHARE;
use super::overlap;
use super::scene::Around;
use super::stretch::{REJOINED, Way};
use crate::geom::polyline;
use crate::ir::toolpath::{Run, Shape};

/// Part of the tolerance that the polyline may take here; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.45;
/// The same of the polyline as it is seen without what came before it, which no more may add to.
const SEEN_SHARE: f64 = 0.95;
/// Greatest part of all the turn under a blade that one vertex of a curve makes; one that makes more is a bend.
const BEND_SHARE: f64 = 0.7;
/// Length of a run, in widths of the blade, that is looked at from where it plunges: on any curve that it lies on it spans
/// less.
const REACH: f64 = 4.0;

/// A blade plunged at the start of an open run, its tail where the heel overlap begins, its tip on the run or at its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bow {
    /// The vertex of the run under the blade that lies farthest beside it.
    pub(super) at: usize,
    /// How far that is, mm.
    pub(super) away: f64,
    /// Whether that is no more than on an arc that turns as much, and the blade does not stand across it.
    pub(super) fits: bool,
    /// Whether it covers all of the run.
    pub(super) is_whole: bool,
    /// Whether what lies under it turns little by little, and not at one bend.
    pub(super) is_curve: bool,
    /// How much that turns in all, rad: what it turns to the one side less what it turns to the other, which may be rounding.
    pub(super) turned: f64,
}

impl Bow {
    /// `None` when there is no vertex under the blade, or the run hardly turns there.
    pub(super) fn new(run: &Run, around: &Around) -> Option<Self> {
        if !may_bow(run, around) {
            return None;
        }
        let mut run = run.clone();
        overlap::give(&mut run, around);
        let extended = run.extended();
        let reached = polyline::first_at_distance(&extended, around.knife().width_mm);
        // What covers all of a run is a chord of that alone.
        let (path, skipped) =
            if reached.is_some() { (extended, usize::from(run.heel > 0.0)) } else { (run.points.clone(), 0) };
        let (tip, chord) = reached.unwrap_or((path[path.len() - 1], path.len() - 2));
        // The chord that is being left counts, too: a curve turns along its chords, not at its vertices.
        let signed: Vec<f64> = path.windows(3).take(chord + 1).map(|w| polyline::turn_at(w[0], w[1], w[2])).collect();
        let turns: Vec<f64> = signed.iter().map(|turn| turn.abs()).collect();
        let turned: f64 = turns.iter().sum();
        let is_curve = turns.iter().all(|&turn| turn <= BEND_SHARE * turned);
        // A curve turns along the halves of the chords at its ends, too.
        let last = (run.points.len() - 2 + skipped).min(turns.len());
        let inner_turns = &turns[skipped.min(last)..last];
        let outer = match inner_turns {
            [first, .., last] if is_curve && chord - skipped + 2 >= run.points.len() => f64::midpoint(*first, *last),
            [first, ..] if is_curve => first / 2.0,
            _ => 0.0,
        };
        let blade = tip - path[0];
        let is_across = polyline::direction(path[0], path[1]).is_some_and(|first| stands_across(blade, first));
        let arc = |turn: f64| if is_across { 0.0 } else { polyline::sagitta(blade.norm(), turn) };
        // A single vertex under the blade tells nobody that the curve begins before it.
        let under = &turns[..chord.min(turns.len())];
        let sharpest = under.iter().copied().fold(0.0, f64::max);
        let seen = if sharpest <= BEND_SHARE * under.iter().sum::<f64>() { turned + outer } else { turned };
        let away = |i: usize| polyline::distance_to_segment(path[i], path[0], tip);
        let inner = (skipped + 1..=chord).filter(|&i| i - skipped + 1 < run.points.len());
        let worst = inner.max_by(|&a, &b| away(a).total_cmp(&away(b)))?;
        Some(Self {
            at: worst - skipped,
            away: away(worst),
            fits: away(worst) <= arc(turned + outer) + SHARE * around.tolerance()
                && away(worst) <= arc(seen) + SEEN_SHARE * around.tolerance(),
            is_whole: reached.is_none(),
            is_curve,
            turned: signed.iter().sum::<f64>().abs(),
        })
    }

    /// Whether the blade lies no farther beside its path than is worth a word.
    pub(super) fn is_slight(&self, around: &Around) -> bool {
        self.away <= around.knife().max_bow_mm
    }

    /// Whether it may plunge like that: it enters its path and lies slightly beside it, or cuts all of it as it should.
    fn is_good(&self, around: &Around) -> bool {
        self.fits && self.is_slight(around) && (!self.is_whole || self.away <= NIBBLE_SHARE * around.tolerance())
    }
}

/// A run that begins on a curve which the blade that plunges there lies too far beside.
#[derive(Debug)]
pub(super) struct BowedStart {
    /// How that blade lies.
    pub(super) bow: Bow,
    /// The curve: up to the vertex from which on a blade could plunge well.
    pub(super) curve: Tight,
}

/// How an open run begins on a curve that the plunged blade cannot enter, or would lie more than `knife.max_bow_mm` beside,
/// or more than its tolerance when it covers all of it; `None` when it does not.
pub(super) fn bowed_start(run: &Run, around: &Around) -> Option<BowedStart> {
    if run.shape == Shape::Ring {
        return None;
    }
    // Nearly always that is all.
    if Bow::new(run, around).is_none_or(|bow| !bow.is_curve || bow.is_good(around)) {
        return None;
    }
    let way = Way::new(run);
    let from = |vertex: usize| {
        let station = way.station(vertex.cast_signed());
        let to = station + REACH * around.knife().width_mm;
        let start = if vertex == 0 { run.ends[0] } else { REJOINED };
        let end = if to < way.length() { REJOINED } else { run.ends[1] };
        let bow = Bow::new(&way.part(station, to.min(way.length()), [start, end]), around)?;
        let bow = Bow { is_whole: bow.is_whole && to >= way.length(), ..bow };
        (bow.is_curve && !bow.is_good(around)).then_some(bow)
    };
    let bow = from(0)?;
    let end = (1..way.chords()).find(|&vertex| from(vertex).is_none()).unwrap_or(way.chords());
    let radius = |vertex: usize| radius(&run.points, vertex);
    let under = 1..=end.saturating_sub(1).max(1);
    let at = under.clone().min_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let radius = least_radius(&run.points, under, around.knife().width_mm);
    Some(BowedStart { bow, curve: Tight { vertices: 0..=end, radius, at } })
}

/// Whether a run turns enough near its start to lie anything but well beside the blade: a path that turns by a under a blade
/// of the width w lies beside it by at most w/2 tan(a/2), an arc that turns as much by about half of that, and the
/// difference may be a part of the tolerance.
fn may_bow(run: &Run, around: &Around) -> bool {
    let knife = around.knife();
    let turned = polyline::turn_within(&run.points, knife.width_mm).min(std::f64::consts::PI);
    knife.width_mm / 2.0 * (turned / 2.0).tan() > knife.max_bow_mm.min(2.0 * SHARE * around.tolerance())
}
