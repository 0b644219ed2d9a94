//! Laying stitches: the lines of a pattern become needle points, locked at their ends, in sewing order.
//!
//! Receives seams in mm. Promises a needle point on every corner and an even pitch between corners, at most the one of the
//! profile. Ignores speeds.

mod element;
mod ends;
mod order;
mod pitch;
mod satin;

use super::pattern::{Pattern, SAME_EPSILON, Seam};
use super::stitches::{Op, Step, Stitches};
use crate::geom::Point;
use crate::machine::Sewing;

/// Lays the stitches of a pattern.
pub(super) fn lay(pattern: &Pattern, sewing: &Sewing) -> Stitches {
    let mut work = Work { sewing, steps: Vec::new(), at: Point::origin(), thread: 1, is_sewn: false };
    for seam in order::order(pattern, sewing) {
        work.seam(seam);
    }
    work.trim(0);
    Stitches { steps: work.steps }
}

/// Stitches laid so far, and state of the needle.
struct Work<'a> {
    sewing: &'a Sewing,
    steps: Vec<Step>,
    at: Point,
    thread: u16,
    /// True if anything was sewn since the last thread cut.
    is_sewn: bool,
}

impl Work<'_> {
    fn push(&mut self, op: Op, to: Point, (is_tie, record): (bool, u32)) {
        self.steps.push(Step { op, to, is_tie, record });
        self.at = to;
    }

    /// Cuts the thread, if trims are enabled and there is a thread to cut.
    fn trim(&mut self, record: u32) {
        if std::mem::take(&mut self.is_sewn) && self.sewing.trim {
            self.push(Op::Trim, self.at, (false, record));
        }
    }

    fn seam(&mut self, seam: &Seam) {
        let record = seam.span.block;
        let points = element::needle_points(seam, self.sewing);
        let Some(&start) = points.first() else { return };
        if seam.thread != self.thread {
            self.trim(record);
            self.thread = seam.thread;
            self.push(Op::Color(seam.thread), self.at, (false, record));
        }
        if seam.stop {
            self.push(Op::Stop, self.at, (false, record));
        }
        if (start - self.at).norm() > SAME_EPSILON {
            self.trim(record);
            self.push(Op::Jump, start, (false, record));
        }
        if self.steps.last().is_none_or(|step| step.op.ends_run()) {
            // The needle goes down without motion: the first needle point of the seam.
            self.push(Op::Stitch, start, (true, record));
        }
        let ends = seam.ends.map(|ends| ends.unwrap_or(self.sewing.ends));
        let line = element::line(seam, &points);
        for (to, is_tie) in ends::locked(&points, &line, ends, self.sewing) {
            self.push(Op::Stitch, to, (is_tie, record));
        }
        self.is_sewn = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::sewing::Ends;
    use crate::source::Span;

    fn seam(points: &[[f64; 2]]) -> Seam {
        Seam::plain(points.iter().map(|&[x, y]| Point::new(x, y)).collect(), Span::default())
    }

    fn text(pattern: &Pattern, sewing: &Sewing) -> String {
        let line = |step: &Step| {
            format!("{:?} {:.2} {:.2}{}\n", step.op, step.to.x, step.to.y, if step.is_tie { " tie" } else { "" })
        };
        lay(pattern, sewing).steps.iter().map(line).collect()
    }

    #[test]
    fn seams_are_jumped_to_locked_and_trimmed() {
        let mut second = seam(&[[20.0, 0.0], [24.0, 0.0]]);
        second.thread = 2;
        second.ends = [Some(Ends::Open); 2];
        let pattern = Pattern { seams: vec![seam(&[[0.0, 0.0], [5.0, 0.0]]), second] };
        insta::assert_snapshot!(text(&pattern, &Sewing::default()), @r"
        Stitch 0.00 0.00 tie
        Stitch 0.70 0.00 tie
        Stitch 0.00 0.00 tie
        Stitch 0.70 0.00 tie
        Stitch 2.50 0.00
        Stitch 4.30 0.00
        Stitch 5.00 0.00 tie
        Stitch 4.30 0.00 tie
        Stitch 5.00 0.00 tie
        Trim 5.00 0.00
        Color(2) 5.00 0.00
        Jump 20.00 0.00
        Stitch 20.00 0.00 tie
        Stitch 22.00 0.00
        Stitch 24.00 0.00
        Trim 24.00 0.00
        ");
    }
}
