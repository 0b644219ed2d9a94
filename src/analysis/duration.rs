//! Estimated duration of the cuts of a marker, without a plan: enough to compare two ways of cutting the same parts.

use std::borrow::Cow;

use super::air::Air;
use crate::geom::corner::Corners;
use crate::geom::{Point, polyline};
use crate::ir::Marker;
use crate::ir::marker::Cut;
use crate::machine::kinematics::Move;
use crate::machine::{Job, Limits};

/// Total time from the first plunge to the last lift of each cut, s, including plunges and lifts. A stretch between two corners
/// counts as a move from rest to rest: of X and Y over its length, less the length that the standing blade covers, and of C
/// through all its turns.
pub fn of_cuts(marker: &Marker, job: &Job) -> f64 {
    let runs = Runs::new(marker, job);
    marker.cuts.iter().map(|cut| runs.of_cut(cut)).sum()
}

/// Durations of the runs of cuts.
struct Runs<'a> {
    marker: &'a Marker,
    air: Air,
    /// Greatest turn that is not a corner, rad.
    corner: f64,
    /// Limits along a run.
    line: Limits,
    c: Limits,
    /// Length that the standing blade covers, mm.
    width: f64,
    /// Duration of a plunge and a lift, s.
    through: f64,
}

impl<'a> Runs<'a> {
    fn new(marker: &'a Marker, job: &Job) -> Self {
        let knife = &job.profile.knife;
        let [x, y, c] = job.profile.axes.limits();
        let mut line = x.min(y);
        line.speed = line.speed.min(knife.feed_mm_s.unwrap_or(f64::INFINITY));
        let (corner, through) = (job.profile.corner_angle(), knife.clear() + knife.plunge());
        Self { marker, air: Air::new(job), corner, line, c, width: knife.width_mm, through }
    }

    fn of_cut(&self, cut: &Cut) -> f64 {
        let points = self.begun_at_corner(self.marker.list.points(cut.range));
        let last = points.len() - 1;
        let (mut time, mut first) = (0.0, 0);
        let corners = self.corners(&points, false);
        for i in (1..last).filter(|&i| corners.is_at(i)) {
            let turn = [self.air.up(points[i - 1], points[i]), self.air.down(points[i], points[i + 1])];
            time += self.of_run(&points[first..=i]) + self.air.time(&turn[0], &turn[1]);
            first = i;
        }
        time + self.of_run(&points[first..])
    }

    fn first_corner(&self, ring: &[Point]) -> Option<usize> {
        let corners = self.corners(ring, true);
        (0..ring.len()).find(|&i| corners.is_at(i))
    }

    fn corners(&self, points: &[Point], is_ring: bool) -> Corners<impl Fn(usize) -> Point> {
        let (limit, unit) = (self.corner, self.marker.unit);
        Corners { point: |i| points[i], count: points.len(), is_ring, limit, unit }
    }

    /// Moves the start of a closed cut that begins amid a line to its next corner: a start amid the line would cost a lift.
    fn begun_at_corner<'p>(&self, points: Cow<'p, [Point]>) -> Cow<'p, [Point]> {
        let last = points.len() - 1;
        let first = if points[0] == points[last] { self.first_corner(&points[..last]) } else { None };
        let Some(first) = first.filter(|&first| first > 0) else { return points };
        Cow::Owned([&points[first..last], &points[..=first]].concat())
    }

    fn of_run(&self, points: &[Point]) -> f64 {
        let length = (polyline::length(points) - self.width).max(0.0);
        let turned: f64 = points.windows(3).map(|p| polyline::turn_at(p[0], p[1], p[2]).abs()).sum();
        Move::new(length, self.line).duration().max(Move::new(turned, self.c).duration()) + self.through
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::marker::CutKind;
    use crate::ir::text;

    /// Estimated duration of a line as one cut, s.
    fn time(line: &str) -> f64 {
        let text = format!("marker unit-mm 0.1\npiece 1\ncontour open\n  from {line}\n");
        let mut marker = text::read_marker(&text).expect("sound");
        let range = marker.pieces[0].contours[0].range;
        marker.cuts.push(Cut { kind: CutKind::Line, piece: 0, sides: [None; 2], range });
        of_cuts(&marker, &Job::default())
    }

    #[test]
    fn a_corner_costs_a_lift_and_a_turn_and_a_start_costs_more_than_its_length() {
        let straight = time("0 0 to 1000 0\n  to 2000 0");
        let bent = time("0 0 to 1000 0\n  to 1000 1000");
        let knife = &Job::default().profile.knife;
        assert!(bent > straight + knife.clear() + knife.plunge(), "{bent} {straight}");
        let [half, whole] = [time("0 0 to 50 0"), time("0 0 to 100 0")];
        assert!(half > whole / 2.0 + 0.1, "{half} {whole}");
        // The length that the standing blade covers takes only the time of a plunge and a lift.
        assert!((time("0 0 to 5 0") - knife.clear() - knife.plunge()).abs() < 1e-9);
    }
}
