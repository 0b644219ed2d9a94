//! What of each cut is cut, and how often.

use super::ground::Ground;
use super::join::{Chained, Join, chained};
use super::lines::Lines;
use super::rules::Rule;
use super::worst::{Place, Worst};

/// What a stroke cuts of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// From where to where, mm along the line; round a closed one it goes on.
    pub(super) ends: [f64; 2],
    /// Which stroke of its head it is, from 0.
    pub(super) number: usize,
    /// Whether the blade only plunges.
    pub(super) plunge: bool,
    /// Where it starts in the program.
    pub(super) place: Place,
}

impl Cover {
    /// The least and the greatest place along the line, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        [a.min(b), a.max(b)]
    }

    /// The same as it is counted elsewhere along a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { ends: self.ends.map(|station| station + by), ..self }
    }
}

/// What is cut of every line.
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

    /// How much of a stretch of a line is cut already, mm.
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
        if self.of[line].is_empty() {
            let place = Place { head: 0, row: 0, time: 0.0, point: of.points[0] };
            worst.see(Rule::Uncut, length, uncut, Some(place));
            return;
        }
        let mut strokes = chained(&self.of[line], of.closed.then_some(length), uncut);
        if of.closed {
            for stroke in &mut strokes {
                *stroke = stroke.moved(-(stroke.span()[0] / length).floor() * length);
            }
        }
        strokes.sort_by(|a, b| {
            let [a, b] = [a.span(), b.span()];
            a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1]))
        });
        // Before the first one on a closed line is the last, a turn back.
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
            worst.see(Rule::Uncut, -overlap, uncut, Some(stroke.cover.place));
            if let Some(before) = last.filter(|_| overlap > -uncut) {
                Join { line: of, strokes: [before, stroke], overlap }.judge(self.ground, worst);
            }
            if last.is_none_or(|last| to > last.span()[1]) {
                last = Some(stroke);
            }
        }
        if let Some(last) = last.filter(|_| !of.closed) {
            worst.see(Rule::Uncut, length - last.span()[1], uncut, Some(last.cover.place));
        }
    }
}

/// How many times round a line something may lie beside where it is counted.
fn turns(closed: bool) -> impl Iterator<Item = f64> {
    (if closed { -2..=2 } else { 0..=0 }).map(f64::from)
}
