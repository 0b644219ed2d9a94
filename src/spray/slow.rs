//! Edges that the jet passes too slowly, so that their coat is too thick.

use super::course::Pace;
use super::figures::{Followed, OnEdge, on_edges};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::Job;
use crate::units::number::fixed;

/// Length of the jet's path over which its speed is measured, and minimum length to report, mm.
const WAY: f64 = 10.0;

/// Slowness to report, as a multiple of the permitted excess of speed. Planners pass bends at a little less than their limit.
const SLOWER: f64 = 2.0;

/// Slow stretches of an edge.
struct Slow {
    /// Total length, mm.
    length: f64,
    /// Minimum speed of the jet, mm/s, and the position of the head there.
    least: f64,
    at: Point,
}

/// Reports the length of edges on which the jet is slower than its speed by more than twice `tool.edge_speed_percent`. The ends
/// of each edge, where the head comes from rest or from a corner, are left out.
pub(super) fn report(followed: Followed, job: &Job, out: &mut Diagnostics) {
    let tool = &job.profile.tool;
    let least = tool.edge_speed_mm_s * (1.0 - SLOWER * tool.edge_speed_percent / 100.0);
    let found: Vec<Slow> =
        on_edges(followed).iter().filter_map(|edge| slow(edge, followed.period, least, job)).collect();
    let Some(worst) = found.iter().min_by(|a, b| a.least.total_cmp(&b.least)) else { return };
    let message = format!(
        "{} mm of {} are passed by the jet more slowly than at {} mm/s, down to {} mm/s",
        fixed(found.iter().map(|slow| slow.length).sum(), 1),
        if found.len() == 1 { "one edge".to_owned() } else { format!("{} edges", found.len()) },
        fixed(least, 1),
        fixed(worst.least, 1)
    );
    let hint = "its coat is thicker there: take a smaller `tool.edge_speed_mm_s`, or give the axes more";
    out.push(Diagnostic::new(&code::SPRAY_SLOW, message).hint(hint).on_cloth(worst.at));
}

/// The stretches of an edge, apart from its ends, on which the jet is slower than `least`, mm/s; `None` if they are negligible.
fn slow(edge: &OnEdge, period: f64, least: f64, job: &Job) -> Option<Slow> {
    let OnEdge { legs, rows, .. } = edge;
    let distance = job.profile.tool.distance_mm;
    let spots: Vec<Point> = rows.iter().map(|row| row.pose.centre + row.pose.c.unit() * distance).collect();
    let mut ways = vec![0.0];
    for pair in spots.windows(2) {
        ways.push(ways[ways.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let pace = Pace::of(job);
    let [start, end] = [&legs[0], &legs[legs.len() - 1]].map(|leg| pace.reach.run_up(leg.speed.max(pace.corner_speed)));
    let all = ways[ways.len() - 1];
    let mut slow = Slow { length: 0.0, least: f64::INFINITY, at: spots[0] };
    let mut from = 0;
    for i in 1..ways.len() {
        while ways[i] - ways[from + 1] >= WAY {
            from += 1;
        }
        let speed = (ways[i] - ways[from]) / ((i - from) as f64 * period);
        if ways[from] < start || ways[i] > all - end || speed >= least {
            continue;
        }
        slow.length += ways[i] - ways[i - 1];
        if speed < slow.least {
            (slow.least, slow.at) = (speed, rows[i].pose.centre);
        }
    }
    (slow.length > WAY).then_some(slow)
}
