//! Where strokes take over from each other along a line: how far both cut.
//!
//! What a head cuts without leaving the line is judged as one: where it lifts its blade at a bend, the strokes before and
//! behind that are as good as one to the head that takes over from it, and to its own start where it comes round to that.

use super::cover::Cover;
use super::ground::Ground;
use super::lines::Line;
use super::rules::Rule;
use super::worst::{Place, Worst};

/// How far smoothing and rounding may draw the end of a stroke back from where it should be, mm.
const END: f64 = 0.3;
/// Part of the angle of a corner by which its turn may be less: rounding.
const CORNER_EPSILON: f64 = 1e-6;

/// A stroke in its chain: those that a head makes behind each other without leaving a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chained {
    /// What it cuts.
    pub(super) cover: Cover,
    /// The number of the first stroke of the chain.
    first: usize,
    /// The least and the greatest place of the chain, mm along the line as the stroke's own.
    whole: [f64; 2],
}

impl Chained {
    /// The least and the greatest place of the stroke along the line, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        self.cover.span()
    }

    /// The same as it is counted elsewhere along a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { cover: self.cover.moved(by), whole: self.whole.map(|station| station + by), ..self }
    }

    /// Whether both are of one chain.
    fn is_of(&self, other: &Self) -> bool {
        (self.cover.place.head, self.first) == (other.cover.place.head, other.first)
    }

    /// The same, and neither is counted a turn farther round a closed line.
    fn is_beside(&self, other: &Self) -> bool {
        self.is_of(other) && (self.whole[0] - other.whole[0]).abs() < END
    }
}

/// Finds the chains of the strokes along a line, which has a length when it is closed: each stroke of one begins no more than
/// `uncut` mm from what the one before has cut.
pub(super) fn chained(covers: &[Cover], round: Option<f64>, uncut: f64) -> Vec<Chained> {
    let mut strokes: Vec<Chained> = Vec::new();
    for &cover in covers {
        let alone = Chained { cover, first: cover.number, whole: cover.span() };
        let before = strokes
            .last()
            .filter(|last| (last.cover.place.head, last.cover.number + 1) == (cover.place.head, cover.number));
        let Some(before) = before else {
            strokes.push(alone);
            continue;
        };
        // Round a closed line it is counted on from where the stroke before it ends.
        let turn = round.map_or(0.0, |length| ((before.cover.ends[1] - cover.ends[0]) / length).round() * length);
        let next = alone.moved(turn);
        let ([low, high], [from, to]) = (before.span(), next.span());
        let goes_on = from <= high + uncut && to >= low - uncut;
        strokes.push(if goes_on { Chained { first: before.first, ..next } } else { alone });
    }
    for one in strokes.chunk_by_mut(Chained::is_of) {
        let spans = one.iter().map(Chained::span);
        let whole = spans.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or_default();
        for stroke in one {
            stroke.whole = whole;
        }
    }
    strokes
}

/// Where two strokes meet on a line.
pub(super) struct Join<'a> {
    pub(super) line: &'a Line,
    /// The one that ends there, and the one that goes on.
    pub(super) strokes: [Chained; 2],
    /// How much both cut, mm.
    pub(super) overlap: f64,
}

impl Join<'_> {
    /// Judges how far both go on.
    pub(super) fn judge(&self, ground: &Ground, worst: &mut Worst) {
        let knife = &ground.profile.knife;
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let due = 2.0 * ground.profile.flow.overlap_mm;
        let rejoined = knife.corner_heel_overlap_mm + knife.corner_front_overlap_mm;
        let blade = if a.plunge || b.plunge { knife.width_mm } else { 0.0 };
        worst.see(Rule::Twice, self.overlap, due.max(rejoined).max(blade) + 2.0 * END, Some(b.place));
        let at = f64::midpoint(a.span()[1].min(b.span()[1]), b.span()[0]);
        let reach = due + END;
        if self.line.corner_near(at) > reach && !self.is_tight([at - reach, at + reach], ground) {
            let place = Place { point: self.line.place(at), ..b.place };
            worst.see(Rule::Overlap, due - self.of_all(), END, Some(place));
        }
    }

    /// Whether a head goes round a bend there that is too tight for its blade: it lifts it, or plunges chord by chord, and the
    /// blade is longer than each.
    fn is_tight(&self, about: [f64; 2], ground: &Ground) -> bool {
        let [a, b] = &self.strokes;
        let limit = ground.profile.corner.angle() * (1.0 - CORNER_EPSILON);
        a.is_beside(b) && (a.cover.plunge || b.cover.plunge || self.line.turns_between(about) >= limit)
    }

    /// How much is cut twice there, mm: by strokes of one head behind each other these two alone, else all that goes with
    /// either.
    fn of_all(&self) -> f64 {
        let [a, b] = &self.strokes;
        if a.is_beside(b) { self.overlap } else { a.whole[1].min(b.whole[1]) - b.whole[0] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::verify::cover::Covers;
    use crate::flow::verify::lines::Lines;
    use crate::geom::{Point, Rotation};
    use crate::ir::Marker;
    use crate::machine::MachineProfile;
    use crate::verify::{Capped, Required, RequiredCut};

    /// A stroke: its head, its number, from where to where, and whether the blade only plunges.
    type Stroke = (usize, usize, [f64; 2], bool);

    /// Length of the edge of a part that has 18 sides, mm.
    const ROUND: f64 = 18.0 * 40.0;

    /// The rules that strokes break along that, which bends by 20 degrees each 40 mm, where strokes overlap by 4 mm.
    fn broken(strokes: &[Stroke]) -> Vec<&'static str> {
        let mut points = vec![Point::origin()];
        for side in 0..18 {
            let along = Rotation(f64::from(side) * 20_f64.to_radians()).unit();
            points.push(points[points.len() - 1] + along * 40.0);
        }
        let caps = vec![Capped { to: ROUND, speeds: [300.0; 2] }];
        let cut = RequiredCut { points, closed: true, blocks: vec![1], caps, corners: Vec::new(), drawn: true };
        let lines = Lines::new(&Required { cuts: vec![cut], edges: Vec::new(), common: 0.0 });
        let mut profile = MachineProfile::default();
        (profile.flow.overlap_mm, profile.knife.width_mm) = (2.0, 6.6);
        let marker = Marker::default();
        let ground = Ground { marker: &marker, profile: &profile };
        let mut covers = Covers::new(&lines, &ground);
        for &(head, number, ends, plunge) in strokes {
            let place = Place { head, row: 0, time: 0.0, point: Point::origin() };
            covers.add(0, Cover { ends, number, plunge, place });
        }
        let mut worst = Worst::new();
        covers.judge(&mut worst);
        worst.findings().iter().filter(|seen| !seen.finding.holds()).map(|seen| seen.finding.rule).collect()
    }

    #[test]
    fn a_head_that_comes_round_overlaps_its_own_start() {
        let round = |from: f64, to: f64| broken(&[(1, 0, [from, to], false)]);
        assert_eq!(round(10.0, ROUND + 14.0), [""; 0]);
        assert_eq!(round(10.0, ROUND + 12.0), ["flow-verify/overlap"]);
        // It plunges before a bend, lifts there, and goes on from there.
        let lifted = |to: f64| broken(&[(1, 0, [-6.6, 0.0], true), (1, 1, [0.0, to], false)]);
        assert_eq!(lifted(ROUND + 2.0), [""; 0]);
        assert_eq!(lifted(ROUND - 3.5), ["flow-verify/overlap"]);
    }

    #[test]
    fn a_blade_that_is_lifted_amid_a_smooth_line_overlaps_what_it_has_cut() {
        let lifted = |to: f64, from: f64| broken(&[(1, 0, [10.0, to], false), (1, 1, [from, ROUND + 14.0], false)]);
        assert_eq!(lifted(302.0, 298.0), [""; 0]);
        assert_eq!(lifted(300.0, 300.0), ["flow-verify/overlap"]);
    }

    #[test]
    fn heads_overlap_by_all_that_each_cuts_without_leaving_the_line() {
        let first = (1, 0, [-2.0, 362.0], false);
        let last = |number: usize, from: f64| (2, number, [from, ROUND + 2.0], false);
        assert_eq!(broken(&[first, last(0, 358.0)]), [""; 0]);
        assert_eq!(broken(&[first, last(0, 360.0)]), ["flow-verify/overlap"]);
        let plunge = (2, 0, [353.4, 360.0], true);
        assert_eq!(broken(&[first, plunge, last(1, 360.0)]), [""; 0]);
        // It cuts something else in between.
        assert_eq!(broken(&[first, plunge, last(2, 360.0)]), ["flow-verify/overlap"]);
    }
}
