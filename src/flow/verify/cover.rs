//! What of each cut is cut, how often, and how far strokes overlap.

use super::ground::Ground;
use super::lines::{Line, Lines};
use super::rules::Rule;
use super::worst::{Place, Worst};

/// What a stroke cuts of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// From where to where, mm along the line; round a closed one it goes on.
    pub(super) span: [f64; 2],
    /// The head, from 1.
    pub(super) head: usize,
    /// Whether the blade only plunges.
    pub(super) plunge: bool,
    /// Where it starts in the program.
    pub(super) place: Place,
}

/// What is cut of every line.
pub(super) struct Covers<'a> {
    lines: &'a Lines,
    ground: &'a Ground<'a>,
    of: Vec<Vec<Cover>>,
}

/// How far smoothing and rounding may draw the end of a stroke back from where it should be, mm.
const END: f64 = 0.3;

impl<'a> Covers<'a> {
    pub(super) fn new(lines: &'a Lines, ground: &'a Ground<'a>) -> Self {
        Self { lines, ground, of: lines.all.iter().map(|_| Vec::new()).collect() }
    }

    pub(super) fn add(&mut self, line: usize, cover: Cover) {
        self.of[line].push(cover);
    }

    /// How much of a stretch of a line is cut already, mm.
    pub(super) fn doubled(&self, line: usize, span: [f64; 2]) -> f64 {
        let length = self.lines.all[line].length();
        let mut sum = 0.0;
        for turn in turns(self.lines.all[line].closed) {
            let by = turn * length;
            sum += self.of[line]
                .iter()
                .map(|cover| (span[1].min(cover.span[1] + by) - span[0].max(cover.span[0] + by)).max(0.0))
                .sum::<f64>();
        }
        sum
    }

    /// Judges all lines.
    pub(super) fn judge(&self, worst: &mut Worst) {
        for line in 0..self.of.len() {
            self.judge_line(line, worst);
        }
    }

    /// Strokes that are no farther from each other leave nothing uncut between them, mm.
    fn uncut(&self) -> f64 {
        self.ground.profile.verify.max_uncut_mm + self.ground.tolerance()
    }

    fn judge_line(&self, line: usize, worst: &mut Worst) {
        let (of, uncut) = (&self.lines.all[line], self.uncut());
        let length = of.length();
        let mut covers = self.of[line].clone();
        if covers.is_empty() {
            let place = Place { head: 0, row: 0, time: 0.0, point: of.points[0] };
            worst.see(Rule::Uncut, length, uncut, Some(place));
            return;
        }
        if of.closed {
            for cover in &mut covers {
                let turn = (cover.span[0] / length).floor() * length;
                cover.span = cover.span.map(|station| station - turn);
            }
        }
        covers.sort_by(|a, b| a.span[0].total_cmp(&b.span[0]).then(b.span[1].total_cmp(&a.span[1])));
        // Before the first one on a closed line is the last, a turn back.
        let mut last = if of.closed {
            let last = covers.iter().copied().max_by(|a, b| a.span[1].total_cmp(&b.span[1]));
            last.map(|last| Cover { span: last.span.map(|station| station - length), ..last })
        } else {
            None
        };
        for &cover in &covers {
            let reached = last.map_or(0.0, |last| last.span[1]);
            let overlap = reached.min(cover.span[1]) - cover.span[0];
            worst.see(Rule::Uncut, -overlap, uncut, Some(cover.place));
            if let Some(before) = last.filter(|_| overlap > -uncut) {
                self.judge_join(&Join { line: of, strokes: [before, cover], overlap, covers: &covers, uncut }, worst);
            }
            if last.is_none_or(|last| cover.span[1] > last.span[1]) {
                last = Some(cover);
            }
        }
        if let Some(last) = last.filter(|_| !of.closed) {
            worst.see(Rule::Uncut, length - last.span[1], uncut, Some(last.place));
        }
    }

    /// Whether a head goes round a bend there that is too tight for its blade: it lifts it, or plunges chord by chord, and the
    /// blade is longer than each.
    fn is_tight(&self, join: &Join, about: [f64; 2]) -> bool {
        let [a, b] = join.strokes;
        let limit = self.ground.profile.corner.angle() * (1.0 - CORNER_EPSILON);
        a.head == b.head && (a.plunge || b.plunge || join.line.turns_between(about) >= limit)
    }

    /// Judges the overlap of two strokes that follow each other along a line.
    fn judge_join(&self, join: &Join, worst: &mut Worst) {
        let knife = &self.ground.profile.knife;
        let [a, b] = join.strokes;
        let due = 2.0 * self.ground.profile.flow.overlap_mm;
        let rejoined = knife.corner_heel_overlap_mm + knife.corner_front_overlap_mm;
        let blade = if a.plunge || b.plunge { knife.width_mm } else { 0.0 };
        worst.see(Rule::Twice, join.overlap, due.max(rejoined).max(blade) + 2.0 * END, Some(b.place));
        let at = f64::midpoint(a.span[1].min(b.span[1]), b.span[0]);
        let reach = due + END;
        let about = [at - reach, at + reach];
        if join.line.corner_near(at) > reach && !self.is_tight(join, about) {
            let place = Place { point: join.line.place(at), ..b.place };
            worst.see(Rule::Overlap, due - join.of_heads(due), END, Some(place));
        }
    }
}

/// Part of the angle of a corner by which its turn may be less: rounding.
const CORNER_EPSILON: f64 = 1e-6;

/// How many times round a line something may lie beside where it is counted.
fn turns(closed: bool) -> impl Iterator<Item = f64> {
    (if closed { -2..=2 } else { 0..=0 }).map(f64::from)
}

/// Where two strokes meet on a line.
struct Join<'a> {
    line: &'a Line,
    /// The one that ends there, and the one that goes on.
    strokes: [Cover; 2],
    /// How much both cut, mm.
    overlap: f64,
    /// All that is cut of the line.
    covers: &'a [Cover],
    /// Strokes that are no farther from each other leave nothing uncut between them, mm.
    uncut: f64,
}

impl Join<'_> {
    /// How much both cut there, mm. Where heads take over from each other and that is less than it should be, all that each cuts
    /// without a gap is taken together: a head that lifts its blade at a bend near the end of what it cuts has two strokes
    /// there.
    fn of_heads(&self, due: f64) -> f64 {
        let [a, b] = self.strokes;
        if a.head == b.head || self.overlap >= due {
            return self.overlap;
        }
        let round = self.line.closed.then(|| self.line.length());
        let [a, b] = [a, b].map(|stroke| self.together(stroke, round));
        a[1].min(b[1]) - b[0]
    }

    /// What the head of a stroke cuts without a gap about it; on a closed line of a length round and round.
    fn together(&self, stroke: Cover, round: Option<f64>) -> [f64; 2] {
        let [mut low, mut high] = stroke.span;
        loop {
            let known = high - low;
            let of_head = self.covers.iter().filter(|other| other.head == stroke.head);
            let turned = |span: [f64; 2]| {
                turns(round.is_some()).map(move |turn| span.map(|at| at + turn * round.unwrap_or(0.0)))
            };
            for [from, to] in of_head.flat_map(|other| turned(other.span)) {
                if from <= high + self.uncut && to >= low - self.uncut {
                    (low, high) = (low.min(from), high.max(to));
                }
            }
            if high - low <= known || round.is_some_and(|length| high - low >= length) {
                return [low, high];
            }
        }
    }
}
