//! Coverage of each cut, and parts that are cut more than once.

use super::chain::{Chained, Cover, chained};
use super::ground::Ground;
use super::join::Join;
use super::lines::Lines;
use super::rules;
use crate::ir::verdict::{Sighting, WorstByRule};

/// Covers of all lines.
pub(super) struct Covers<'a> {
    lines: &'a Lines,
    ground: &'a Ground<'a>,
    of: Vec<Vec<Cover>>,
}

impl<'a> Covers<'a> {
    pub(super) fn new(lines: &'a Lines, ground: &'a Ground<'a>) -> Self {
        Self { lines, ground, of: lines.all.iter().map(|_| Vec::new()).collect() }
    }

    pub(super) fn add(&mut self, line: usize, cover: Cover) {
        self.of[line].push(cover);
    }

    /// Length of a stretch of a line that is already cut, mm, counted once per cover.
    pub(super) fn doubled(&self, line: usize, span: [f64; 2]) -> f64 {
        let length = self.lines.all[line].length();
        let mut sum = 0.0;
        for turn in turns(self.lines.all[line].closed) {
            let by = turn * length;
            let of = self.of[line].iter().map(|cover| cover.moved(by).span());
            sum += of.map(|[from, to]| (span[1].min(to) - span[0].max(from)).max(0.0)).sum::<f64>();
        }
        sum
    }

    /// Verifies all lines.
    pub(super) fn judge(&self, worst: &mut WorstByRule) {
        for line in 0..self.of.len() {
            self.judge_line(line, worst);
        }
    }

    /// Greatest distance between two strokes that leaves no stretch uncut, mm.
    fn uncut(&self) -> f64 {
        self.ground.profile.verify.max_uncut_mm + self.ground.tolerance()
    }

    fn judge_line(&self, line: usize, worst: &mut WorstByRule) {
        let (of, uncut) = (&self.lines.all[line], self.uncut());
        let length = of.length();
        if self.of[line].is_empty() {
            worst.see_under(&rules::UNCUT, length, uncut, Sighting::missing(of.points[0], 0));
            return;
        }
        let mut strokes = chained(&self.of[line], of.closed.then_some(length), uncut);
        for pair in strokes.windows(2).filter(|pair| pair[0].is_of(&pair[1])) {
            Join::within(of, [pair[0], pair[1]]).judge_overlap(self.ground, worst);
        }
        if of.closed {
            for stroke in &mut strokes {
                *stroke = stroke.moved(-(stroke.span()[0] / length).floor() * length);
            }
        }
        strokes.sort_by(|a, b| {
            let [a, b] = [a.span(), b.span()];
            a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1]))
        });
        // On a closed line, the first stroke is preceded by the last one, one turn back.
        let mut last: Option<Chained> = if of.closed {
            let last = strokes.iter().max_by(|a, b| a.span()[1].total_cmp(&b.span()[1]));
            last.map(|last| last.moved(-length))
        } else {
            None
        };
        for &stroke in &strokes {
            let [from, to] = stroke.span();
            let reached = last.map_or(0.0, |last| last.span()[1]);
            let overlap = reached.min(to) - from;
            worst.see_under(&rules::UNCUT, -overlap, uncut, stroke.cover.place);
            if let Some(before) = last.filter(|_| overlap > -uncut) {
                let join = Join { line: of, strokes: [before, stroke], overlap };
                join.judge_twice(self.ground, worst);
                if !before.is_beside(&stroke) {
                    join.judge_overlap(self.ground, worst);
                }
            }
            if last.is_none_or(|last| to > last.span()[1]) {
                last = Some(stroke);
            }
        }
        if let Some(last) = last.filter(|_| !of.closed) {
            worst.see_under(&rules::UNCUT, length - last.span()[1], uncut, last.cover.place);
        }
    }
}

/// Numbers of turns by which covers of a line may be shifted against each other.
fn turns(closed: bool) -> impl Iterator<Item = f64> {
    (if closed { -2..=2 } else { 0..=0 }).map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Rotation};
    use crate::ir::Marker;
    use crate::machine::MachineProfile;
    use crate::verify::{Capped, Required, RequiredCut};

    /// Stroke: head, index, start and end, and true if the blade only plunges.
    type Stroke = (u32, usize, [f64; 2], bool);

    /// Length of the edge of a part with 18 sides, mm.
    const ROUND: f64 = 18.0 * 40.0;

    /// Rules that strokes break along that edge, which bends by 20 degrees every 40 mm; strokes must overlap by 4 mm.
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
            let place = Sighting { head, ..Sighting::missing(Point::origin(), 0) };
            covers.add(0, Cover { ends, number, plunge, place });
        }
        let mut worst = WorstByRule::default();
        covers.judge(&mut worst);
        worst.findings().iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect()
    }

    #[test]
    fn a_head_that_comes_round_overlaps_its_own_start() {
        let round = |from: f64, to: f64| broken(&[(1, 0, [from, to], false)]);
        assert_eq!(round(10.0, ROUND + 14.0), [""; 0]);
        assert_eq!(round(10.0, ROUND + 12.0), ["flow-verify/overlap"]);
        // The head plunges before a bend, lifts there and continues from there.
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
    fn what_another_head_cuts_there_hides_no_lift_amid_a_smooth_line() {
        let lifted = |from: f64| [(1, 0, [10.0, 300.0], false), (1, 1, [from, ROUND + 14.0], false)];
        let other = (2, 0, [298.0, 302.0], false);
        assert_eq!(broken(&[lifted(300.0), [other; 2]].concat()[..3]), ["flow-verify/overlap"]);
        // A plunge does not hide it either, where the line is straight.
        let plunge = (1, 1, [300.0, 306.6], true);
        let plunged = [(1, 0, [10.0, 300.0], false), plunge, (1, 2, [306.6, ROUND + 14.0], false)];
        assert_eq!(broken(&plunged), ["flow-verify/overlap"]);
        // Two strokes from both sides are not a chain.
        assert_eq!(broken(&[(1, 0, [-2.0, 362.0], false), (1, 1, [2.0, -358.0], false)]), ["flow-verify/overlap"]);
    }

    #[test]
    fn heads_overlap_by_all_that_each_cuts_without_leaving_the_line() {
        let first = (1, 0, [-2.0, 362.0], false);
        let last = |number: usize, from: f64| (2, number, [from, ROUND + 2.0], false);
        assert_eq!(broken(&[first, last(0, 358.0)]), [""; 0]);
        assert_eq!(broken(&[first, last(0, 360.0)]), ["flow-verify/overlap"]);
        let plunge = (2, 0, [353.4, 360.0], true);
        assert_eq!(broken(&[first, plunge, last(1, 360.0)]), [""; 0]);
        // The head cuts something else in between.
        assert_eq!(broken(&[first, plunge, last(2, 360.0)]), ["flow-verify/overlap"]);
    }
}
