//! Time of the jet at a place: a jet that stands still floods it.

use super::rows::{EPSILON, Row, WAY};
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;
use crate::machine::{Job, Limits};
use crate::units::rad;

/// Permitted ratio of the jet's time to the time at its speeds: axes are shared, and bends demand more of them.
const PATIENCE: f64 = 2.0;

/// Verifies the time of the jet at each place, over any stretch of at most a centimetre.
pub(super) fn judge(rows: &[Row], spots: &[Point], job: &Job, worst: &mut WorstByRule) {
    let (period, allowed) = (job.profile.time.period(), Allowed::of(job));
    let step = |i: usize| (spots[i] - spots[i - 1]).norm();
    // Sums from row `from` to the current row: path of the jet, path of the head, turn of C.
    let (mut from, mut way, mut head, mut turn) = (0, 0.0, 0.0, 0.0);
    let moved = |i: usize| (rows[i].head - rows[i - 1].head).norm();
    let turned = |i: usize| rad((rows[i].c_deg - rows[i - 1].c_deg).abs());
    for i in 1..rows.len() {
        if !(rows[i].jet && rows[i - 1].jet) {
            (from, way, head, turn) = (i, 0.0, 0.0, 0.0);
            continue;
        }
        (way, head, turn) = (way + step(i), head + moved(i), turn + turned(i));
        while way > WAY && from + 1 < i {
            from += 1;
            (way, head, turn) = (way - step(from), head - moved(from), turn - turned(from));
        }
        let time = (i - from) as f64 * period;
        worst.see_under(&rules::DWELL, time, allowed.time(head, turn) + EPSILON, rows[from].sighting());
    }
}

/// Permitted time of a head that moves at its intended speeds.
struct Allowed {
    /// Time of the jet on a centimetre plus the time to stop and start again, s.
    always: f64,
    /// Speed of the head, mm/s, and of C, rad/s.
    speeds: [f64; 2],
}

impl Allowed {
    fn of(job: &Job) -> Self {
        let (tool, [x, y, c]) = (&job.profile.tool, job.profile.axes.limits());
        let slower = if x.speed < y.speed { x } else { y };
        let speed = |asked: f64| asked.min(slower.speed);
        let [edge, corner] = [tool.edge_speed_mm_s, tool.corner_speed_mm_s].map(speed);
        // Time to reach a speed and to stop from it, at constant jerk and acceleration.
        let rest = |limits: Limits, speed: f64| 2.0 * (speed / limits.acceleration + limits.acceleration / limits.jerk);
        let rests = rest(x, edge.max(corner)).max(rest(y, edge.max(corner))) + rest(c, c.speed);
        Self { always: PATIENCE * WAY / edge + rests, speeds: [corner, c.speed] }
    }

    /// Permitted time for a path of the head, mm, and a turn of C, rad, in s.
    fn time(&self, head: f64, turn: f64) -> f64 {
        self.always + PATIENCE * (head / self.speeds[0] + turn / self.speeds[1])
    }
}
