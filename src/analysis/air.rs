//! Moves with the knife up: their duration, and a lower bound of it for a marker.

use rayon::prelude::*;

use crate::geom::boxes::Boxes;
use crate::geom::corner::Corners;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::ir::Marker;
use crate::ir::marker::{Cut, CutKind};
use crate::machine::kinematics::Move;
use crate::machine::{Job, Limits};

/// Greatest number of starts tried on a closed line.
const MOST_STARTS: usize = 64;
/// First search radius around the start of a cut for ends of others, mm.
const FIRST_REACH: f64 = 10.0;
/// Greatest search radius, mm: longer than any table.
const LAST_REACH: f64 = 1.0e6;

/// Position of the axes when the knife comes down or up.
#[derive(Debug, Clone, Copy)]
pub struct Stop {
    /// C axis.
    pub at: Point,
    /// Direction of the blade, a unit vector; `None` = any, for a drill.
    pub along: Option<Vector>,
}

impl Stop {
    /// Stop with any direction of the blade.
    pub fn anyhow(at: Point) -> Self {
        Self { at, along: None }
    }
}

/// Durations of moves with the knife up.
#[derive(Debug, Clone, Copy)]
pub struct Air {
    limits: [Limits; 3],
    /// Distance from the C axis to the tip and to the heel, mm.
    ends: [f64; 2],
    is_double_edged: bool,
    /// Position of the drill relative to the C axis, mm.
    drill: Vector,
}

impl Air {
    /// Durations on the machine of a job.
    pub fn new(job: &Job) -> Self {
        let knife = &job.profile.knife;
        let [x, y] = job.profile.drill.offset_mm;
        let (limits, is_double_edged) = (job.profile.axes.travel_limits(), knife.edges == 2);
        Self { limits, ends: knife.ends(), is_double_edged, drill: Vector::new(x, y) }
    }

    /// Position of the axes when a hole is drilled.
    pub fn drill(&self, at: Point) -> Stop {
        Stop::anyhow(at - self.drill)
    }

    /// Position of the axes when the blade comes down at the start `from` of a cut that goes on to `to`: its heel is at `from`.
    pub fn down(&self, from: Point, to: Point) -> Stop {
        let along = polyline::direction(from, to);
        Stop { at: from + along.unwrap_or_default() * self.ends[1], along }
    }

    /// Position of the axes when the blade comes up at the end `to` of a cut that comes from `from`: its tip is at `to`.
    pub fn up(&self, from: Point, to: Point) -> Stop {
        let along = polyline::direction(from, to);
        Stop { at: to - along.unwrap_or_default() * self.ends[0], along }
    }

    /// Duration from rest to rest, s: X and Y move along a line, while C turns the shorter way round. With two edges the one
    /// that turns less leads, so that a cut needs no state besides its start and direction.
    pub fn time(&self, from: &Stop, to: &Stop) -> f64 {
        let [x, y, c] = self.limits;
        let way = to.at - from.at;
        let length = way.norm();
        let line = if length > 0.0 {
            Move::new(length, x.along(way.x / length).min(y.along(way.y / length))).duration()
        } else {
            0.0
        };
        let turn = match (from.along, to.along) {
            (Some(from), Some(to)) => {
                let cosine = from.dot(&to);
                let cosine = if self.is_double_edged { cosine.abs() } else { cosine };
                Move::new(cosine.clamp(-1.0, 1.0).acos(), c).duration()
            }
            _ => 0.0,
        };
        line.max(turn)
    }

    /// Least duration over a distance in any direction, s.
    fn least_over(&self, distance: f64) -> f64 {
        let [x, y, _] = self.limits;
        let most = |x: f64, y: f64| x.hypot(y);
        let both = Limits {
            speed: most(x.speed, y.speed),
            acceleration: most(x.acceleration, y.acceleration),
            jerk: most(x.jerk, y.jerk),
        };
        Move::new(distance, both).duration()
    }
}

/// Duration of the moves between the cuts and holes of a marker in their order, s, including the move from home, without lifts
/// amid a cut.
pub fn spent(marker: &Marker, job: &Job) -> f64 {
    let air = Air::new(job);
    let [x, y, _] = job.profile.home;
    let (mut time, mut at) = (0.0, Stop::anyhow(Point::new(x, y)));
    let mut go = |down: Stop, up: Stop| time += air.time(&std::mem::replace(&mut at, up), &down);
    for (piece, part) in marker.pieces.iter().zip(0..) {
        piece.drills.iter().map(|drill| air.drill(drill.at)).for_each(|stop| go(stop, stop));
        for cut in marker.cuts_of(part) {
            let points = marker.list.points(cut.range);
            let last = points.len() - 1;
            go(air.down(points[0], points[1]), air.up(points[last - 1], points[last]));
        }
    }
    time
}

/// Cut or hole that may come anywhere in the order, with all positions where the knife may come down for it and up.
struct Item {
    downs: Vec<Stop>,
    ups: Vec<Stop>,
}

/// Lower bound of the duration of the moves between the cuts and holes of a marker, s: the sum of the shortest move to each of
/// them from the end of any other. In general no order reaches it. Overlaps are left out; they may shorten a move by their
/// lengths.
pub fn least(marker: &Marker, job: &Job) -> f64 {
    let air = Air::new(job);
    let cuts = marker.cuts.par_iter().map(|cut| Item::of_cut(cut, marker, job, &air));
    let mut items: Vec<Item> = cuts.collect();
    let drills = marker.pieces.iter().flat_map(|piece| &piece.drills).map(|drill| air.drill(drill.at));
    items.extend(drills.map(|stop| Item { downs: vec![stop], ups: vec![stop] }));
    let ups: Vec<(usize, Stop)> =
        items.iter().enumerate().flat_map(|(i, item)| item.ups.iter().map(move |&up| (i, up))).collect();
    let boxes = Boxes::new(ups.iter().map(|(_, up)| Extent::between(up.at, up.at)).collect());
    let shortest = |(i, item): (usize, &Item)| {
        let mut least = f64::INFINITY;
        for down in &item.downs {
            let mut reach = FIRST_REACH;
            while reach < LAST_REACH {
                for k in boxes.near(Extent::between(down.at, down.at).grown(reach)) {
                    let (other, up) = &ups[k];
                    if *other != i {
                        least = least.min(air.time(up, down));
                    }
                }
                if least <= air.least_over(reach) {
                    break;
                }
                reach *= 2.0;
            }
        }
        least
    };
    let mut all: Vec<f64> = items.par_iter().enumerate().map(shortest).filter(|least| least.is_finite()).collect();
    // One of them is reached from home; the longest move is left out for it.
    all.sort_by(f64::total_cmp);
    all.pop();
    all.iter().sum()
}

impl Item {
    fn of_cut(cut: &Cut, marker: &Marker, job: &Job, air: &Air) -> Self {
        let points = marker.list.points(cut.range);
        let last = points.len() - 1;
        let is_closed = matches!(cut.kind, CutKind::Outline | CutKind::Inner) && points[0] == points[last];
        if !is_closed {
            // It can be cut from either end.
            return Self {
                downs: vec![air.down(points[0], points[1]), air.down(points[last], points[last - 1])],
                ups: vec![air.up(points[last - 1], points[last]), air.up(points[1], points[0])],
            };
        }
        let at = |i: usize| points[i % last];
        let (limit, unit) = (job.profile.corner_angle(), marker.unit);
        let corners = Corners { point: at, count: last, is_ring: true, limit, unit };
        let mut starts: Vec<usize> = (0..last).filter(|&i| corners.is_at(i)).collect();
        // A line without corners is treated as if it could start anywhere.
        if starts.is_empty() {
            starts.extend(0..last);
        }
        let step = starts.len().div_ceil(MOST_STARTS);
        starts = starts.into_iter().step_by(step).collect();
        if starts[0] != 0 {
            starts.insert(0, 0);
        }
        let around = |i: usize| [at(i + last - 1), at(i), at(i + 1)];
        let downs =
            starts.iter().map(|&i| around(i)).flat_map(|[before, at, next]| [air.down(at, next), air.down(at, before)]);
        let ups =
            starts.iter().map(|&i| around(i)).flat_map(|[before, at, next]| [air.up(before, at), air.up(next, at)]);
        Self { downs: downs.collect(), ups: ups.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Least duration of the moves between cuts, each from its start to its end, when either edge of the blade may lead in
    /// each: tries every choice of edges.
    fn least_by_edges(cuts: &[[Stop; 2]], air: &Air) -> f64 {
        let turned = |stop: Stop| Stop { along: stop.along.map(|along| -along), ..stop };
        let chosen = |choice: usize| {
            let with_edge = |(i, cut): (usize, &[Stop; 2])| if choice >> i & 1 == 0 { *cut } else { cut.map(turned) };
            let cuts: Vec<[Stop; 2]> = cuts.iter().enumerate().map(with_edge).collect();
            cuts.windows(2).map(|pair| air.time(&pair[0][1], &pair[1][0])).sum::<f64>()
        };
        (0..1 << cuts.len()).map(chosen).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn with_two_edges_each_cut_is_made_with_the_one_that_turns_less() {
        let mut job = Job::default();
        // The axis is in the middle: both edges are at the same distance from it.
        (job.profile.knife.width_mm, job.profile.knife.back_mm) = (6.0, Some(3.0));
        let single = Air::new(&job);
        job.profile.knife.edges = 2;
        let double = Air::new(&job);
        for seed in 0..20 {
            let mut rng = fastrand::Rng::with_seed(seed);
            let mut place = || Point::new(30.0 * rng.f64(), 30.0 * rng.f64());
            let cuts: Vec<[Stop; 2]> = (0..6)
                .map(|_| [place(), place(), place()])
                .map(|[a, b, c]| [single.down(a, b), single.up(b, c)])
                .collect();
            let time: f64 = cuts.windows(2).map(|pair| double.time(&pair[0][1], &pair[1][0])).sum();
            assert!((time - least_by_edges(&cuts, &single)).abs() < 1e-12, "seed {seed}");
        }
    }
}
