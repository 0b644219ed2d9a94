//! One run, from the plunge to the lift: the polyline with its overlaps becomes a curve, the curve a motion, the motion
//! samples, and the samples are certified.

use super::certify::{EXCESS_EPSILON, excess_of, excess_of_derivatives};
use crate::analysis::plunge::Deviation;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::{Heading, Point, Rotation, Vector, polyline};
use crate::ir::motion::{Kind, Phase, Poses, Shares, Spell, StraightCut};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;
use crate::machine::kinematics::Move;
use crate::plan::orientation::TooTight;
use crate::plan::orientation::{Blade, Course, Entry, WAY_EPSILON, Way};
use crate::plan::spline::{self, Curve, LEAD, Smooth, has_room, smooth};
use crate::plan::spline::{Blocks, Extended};
use crate::plan::spline::{JUNCTION_SHARES, Near, ToleranceBand};
use crate::plan::timing::Cutting;
use crate::plan::timing::Feed;
use crate::plan::timing::{Bounds, profile};
use crate::source::Span;
use crate::units::number::fixed;

/// Fraction of the speed of the slower axis below which a run crawls: its line winds tighter than any real cut.
const CRAWL: f64 = 1e-4;
/// Time that every run may take, s.
const PATIENCE: f64 = 10.0;

/// A run as it will be cut.
#[derive(Debug)]
pub struct Cut {
    /// Poses at its ticks, without the last.
    poses: Poses,
    /// Number of periods; 0 when the blade plunges and lifts without moving.
    ticks: u32,
    /// Pose at its end.
    end: Pose,
    /// Source blocks being cut, in order; at least one.
    pub(super) spells: Vec<Spell>,
    /// Time from rest to rest before rounding up to whole periods, s.
    pub duration: f64,
    /// Length of the tip's path, mm.
    pub length: f64,
    /// Greatest chord sagitta used by the curve, mm.
    pub sagitta: f64,
    /// Number of ticks bound by each limit.
    pub shares: Shares,
}

impl Cut {
    /// A run planned elsewhere: the poses at its ticks, including the last, and the blocks being cut.
    pub fn sampled(mut poses: Vec<Pose>, spells: Vec<Spell>, period: f64) -> Self {
        let length = poses.windows(2).map(|pair| (pair[1].centre - pair[0].centre).norm()).sum();
        let end = poses.pop().expect("a run has an end");
        let ticks = poses.len() as u32;
        let duration = f64::from(ticks) * period;
        let (poses, shares) = (Poses::Samples(poses), Shares::default());
        Self { poses, ticks, end, spells, duration, length, sagitta: 0.0, shares }
    }

    /// Source blocks being cut, in order; at least one.
    pub fn spells(&self) -> &[Spell] {
        &self.spells
    }

    /// Poses at its ticks, including the last.
    pub fn poses(&self) -> impl Iterator<Item = Pose> + '_ {
        (0..self.ticks).map(|i| self.poses.at(i, self.ticks)).chain([self.end])
    }

    /// Pose at its start.
    pub(super) fn start(&self) -> Pose {
        if self.ticks == 0 { self.end } else { self.poses.at(0, self.ticks) }
    }

    /// Translates the cut by a vector, mm.
    pub(super) fn shift(&mut self, by: Vector) {
        self.poses.shift(by);
        self.end.centre += by;
    }

    /// Adds an angle to C along the whole cut, rad.
    pub(super) fn turn(&mut self, by: f64) {
        self.poses.turn(by);
        self.end.c = Rotation(self.end.c.0 + by);
    }

    /// The phase of the cut, and the pose at its end; `None` when it has no length.
    pub(super) fn phase(self) -> Option<(Phase, Pose)> {
        let Self { poses, ticks, end, spells, duration, length, .. } = self;
        (ticks > 0).then_some((Phase { kind: Kind::Cut, ticks, poses, spells, duration, length, station: 0 }, end))
    }

    fn plunge_only(pose: Pose, block: u32) -> Self {
        let (poses, spells) = (Poses::Still(pose), vec![Spell { first: 0, block }]);
        let shares = Shares::default();
        Self { poses, ticks: 0, end: pose, spells, duration: 0.0, length: 0.0, sagitta: 0.0, shares }
    }
}

/// Fraction of the tolerance within which a polyline counts as straight.
const STRAIGHT_SHARE: f64 = 0.9;
/// Fraction of the tolerance kept in reserve for the distance of the path beside the plunged blade, because output has
/// decimals.
const RESERVE_SHARE: f64 = 0.03;
/// Fractions of the tolerance to smooth within when the path otherwise takes the plunged blade too far off its line.
const NARROWER: [f64; 2] = [0.4, 0.15];
/// Turn below which a vertex is straight, rad.
const TURN_EPSILON: f64 = 1e-6;
/// Maximum number of laps before the start and after the end of a ring.
const LEADS: u32 = 4;
/// Maximum rounds of stretching before a run is refused; measured need is 1, by less than 1 %.
const ROUNDS: usize = 12;
/// Number of steps towards the seam of a ring, and their maximum length, mm. The gap is below two tolerances, and a step closes
/// nearly all of it because the parameter nearly equals the length.
const SEAM_STEPS: usize = 8;
const SEAM_STEP: f64 = 1.0;
/// Fraction of a period by which a duration may exceed a whole number of periods: rounding.
const PERIOD_EPSILON: f64 = 1e-9;

/// A run being solved.
pub(super) struct Order<'a> {
    run: &'a Run,
    job: &'a Job,
    blocks: Blocks,
    bounds: Bounds,
}

/// Solves one run; `near` limits the deviation of its tip at its start and at its end.
pub(super) fn solve(run: &Run, near: [Near; 2], tolerance: f64, job: &Job) -> Result<Cut, Diagnostic> {
    let extended = extended(run, tolerance, job.profile.knife.width_mm);
    let Extended { points, junctions, .. } = &extended;
    let order = Order::new(run, &extended, job);
    let ends = [points[0], points[points.len() - 1]];
    let is_straight = run.shape == Shape::Open
        && polyline::is_straight(points, straight_share(junctions) * tolerance)
        && passes_ends(points, near, tolerance);
    if is_straight && order.has_one_feed() {
        return order.straight(ends);
    }
    let found = if is_straight {
        Smooth { curve: straight_curve(extended.end, ends), sagitta: 0.0 }
    } else {
        let band = || ToleranceBand::new(points.clone(), tolerance, &job.profile).with_lap(extended.lap(run));
        let nearer = || band().with_ends(near);
        let found = if near == [Near::default(); 2] { None } else { smoothed(&nearer, junctions).ok() };
        found.map_or_else(|| smoothed(&band, junctions), Ok).map_err(|tight| order.too_tight(tolerance, tight))?
    };
    let mut curved = order.curved(&extended, &found)?;
    let most = order.most_beside(tolerance);
    for share in NARROWER {
        if curved.beside > most || order.bows_back(&extended, curved.lead, tolerance) {
            let band = || ToleranceBand::plain(points.clone(), share * tolerance);
            let nearer = near.map(|near| Near { share: (near.share / share).min(1.0), ..near });
            let found = smooth(&band().with_ends(nearer)).or_else(|_| smooth(&band()));
            let found = found.map_err(|tight| order.too_tight(share * tolerance, tight))?;
            curved = order.curved(&extended, &found)?;
        }
    }
    Ok(curved.cut)
}

/// Fraction of the tolerance within which a polyline counts as straight, given its junctions with other cuts.
pub(super) fn straight_share(junctions: &[bool]) -> f64 {
    if junctions.is_empty() { STRAIGHT_SHARE } else { JUNCTION_SHARES[0] }
}

/// True if the straight line between the ends of a run with its overlaps keeps the reduced tolerance near each end.
pub(super) fn passes_ends(points: &[Point], near: [Near; 2], tolerance: f64) -> bool {
    if near == [Near::default(); 2] {
        return true;
    }
    let stations = polyline::stations(points);
    let [first, .., last] = points else { return true };
    let length = stations[stations.len() - 1];
    let stretches = [[0.0, near[0].length], [length - near[1].length, length]];
    near.into_iter().zip(stretches).filter(|(near, _)| near.length > 0.0).all(|(near, stretch)| {
        let inner = points.iter().zip(&stations).filter(|(_, at)| stretch[0] <= **at && **at <= stretch[1]);
        let ends = stretch.map(|at| polyline::place(points, &stations, at.clamp(0.0, length)));
        let is_near = |at: &Point| polyline::distance_to_segment(*at, *first, *last) <= near.share * tolerance;
        inner.map(|(at, _)| at).chain(&ends).all(is_near)
    })
}

/// The curve of a straight run of a length, mm.
pub(super) fn straight_curve(length: f64, ends: [Point; 2]) -> Curve {
    Curve::line([0.0, length], ends.map(|point| [point.x, point.y]))
}

/// The smoothest curve in a band that is reduced at junctions. If all reduced bands are too tight, the curve uses the full
/// band, and the verifier measures whether the cuts cross.
pub(super) fn smoothed(band: &dyn Fn() -> ToleranceBand, junctions: &[bool]) -> Result<Smooth, spline::TooTight> {
    let mut shares = JUNCTION_SHARES.iter().filter(|_| !junctions.is_empty());
    let nearer = |&share: &f64| smooth(&band().with_junctions(junctions, share)).ok();
    shares.find_map(nearer).map_or_else(|| smooth(&band()), Ok)
}

/// A run along a smooth curve.
pub(super) struct Curved {
    pub(super) cut: Cut,
    /// Maximum distance of its polyline from the plunged blade, mm.
    pub(super) beside: f64,
    /// Turn from the plunged blade to the curve, left positive, rad.
    pub(super) lead: f64,
}

/// The run with its overlaps. A ring is extended by as many laps as closing its curve takes.
pub(super) fn extended(run: &Run, tolerance: f64, width: f64) -> Extended {
    let most = f64::from(LEADS) * polyline::length(&run.points);
    let mut lead = LEAD;
    loop {
        let extended = Extended::new(run, width, lead);
        let Some(lap) = extended.lap(run) else { return extended };
        let band = ToleranceBand::plain(extended.points.clone(), tolerance).with_lap(Some(lap));
        if has_room(&band) || lead > most {
            return extended;
        }
        lead *= 2.0;
    }
}

/// The curve of a ring ends before it returns to its start.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OpenSeam {
    /// Remaining gap, mm.
    missing: f64,
}

/// Parameter at which a ring closes, near the end of its lap, `end`. Smoothing may shorten the end of the curve, and the tip
/// must advance until it is level with the start. Sideways, the band keeps both at one place. Behind the lap the overlap goes on
/// round the ring, where the tip may be far behind its start in that direction.
fn closed(curve: &Curve, start: f64, end: f64) -> Result<f64, OpenSeam> {
    reaching(curve, curve.derivatives::<2>(start), end)
}

/// The first parameter from `end` on at which the curve is level with a place, along the direction given there.
fn reaching(curve: &Curve, place: [[f64; 2]; 2], end: f64) -> Result<f64, OpenSeam> {
    let [from, along] = place.map(|v| Vector::new(v[0], v[1]));
    let short = |u: f64| {
        let [at] = curve.derivatives::<1>(u);
        (from - Vector::new(at[0], at[1])).dot(&along) / along.norm()
    };
    let last = curve.breaks()[curve.breaks().len() - 1];
    let mut end = end;
    for _ in 0..SEAM_STEPS {
        end = (end + short(end).clamp(0.0, SEAM_STEP)).min(last);
    }
    let missing = short(end);
    if missing <= WAY_EPSILON { Ok(end) } else { Err(OpenSeam { missing }) }
}

impl<'a> Order<'a> {
    /// The problem of a run with its overlaps.
    pub(super) fn new(run: &'a Run, Extended { points, blocks, feeds, .. }: &Extended, job: &'a Job) -> Self {
        let stations = polyline::stations(points);
        let bounds = Bounds { axes: job.profile.axes.limits(), feed: Feed::new(&stations, feeds) };
        Self { run, job, blocks: Blocks::new(&stations, blocks), bounds }
    }

    /// True if its speed cap is constant.
    pub(super) fn has_one_feed(&self) -> bool {
        self.bounds.feed.constant().is_some()
    }

    /// Maximum distance of its polyline from the plunged blade, mm.
    pub(super) fn most_beside(&self, tolerance: f64) -> f64 {
        let Self { run, job, .. } = self;
        let most = match run.shape {
            Shape::Ring => f64::INFINITY,
            Shape::Open => {
                let deviation = Deviation::placed(run, &job.profile.knife, tolerance);
                deviation.map_or(tolerance, |deviation| deviation.most)
            }
        };
        most - RESERVE_SHARE * tolerance
    }

    /// True if a curve bows away from the first bend of its line by more than it may; its tangent leads the plunged blade by
    /// `lead` rad. A path within t of a straight line of length l has at most the curvature 16 t / l^2, and leads the blade by
    /// half of that times the blade's width.
    fn bows_back(&self, extended: &Extended, lead: f64, tolerance: f64) -> bool {
        let (points, width) = (&extended.points, self.job.profile.knife.width_mm);
        let turns = extended.stations().skip(1).zip(points.windows(3));
        let mut bends = turns.map(|((_, station), ends)| (station, polyline::turn_at(ends[0], ends[1], ends[2])));
        let Some((straight, turn)) = bends.find(|(_, turn)| turn.abs() > TURN_EPSILON) else { return false };
        let may_bow = 8.0 * tolerance * width / (straight * straight);
        self.run.shape == Shape::Open && straight > width && lead * turn < 0.0 && lead.abs() > may_bow
    }

    /// A straight run in closed form, limited by the tightest axis and certified by its peak derivatives.
    pub(super) fn straight(&self, [first, last]: [Point; 2]) -> Result<Cut, Diagnostic> {
        let Self { run, job, blocks, bounds } = self;
        let knife = &job.profile.knife;
        let whole = (last - first).norm();
        let u = (last - first) / whole;
        let c = run.start.c.nearest(Heading::new(Heading::of(u).radians() + run.edge.turn()));
        let lead = run.edge.lead(knife.ends());
        let way = whole - knife.width_mm;
        if way < WAY_EPSILON {
            let pose = Pose { centre: first + u * (whole.max(knife.width_mm) - lead), c };
            return Ok(Cut::plunge_only(pose, blocks.at(whole)));
        }
        let feed = bounds.feed.at(0.0);
        let mut limits = bounds.axes[0].along(u.x).min(bounds.axes[1].along(u.y));
        limits.speed = limits.speed.min(feed);
        let stroke = StraightCut { from: first, along: u, start: knife.width_mm, lead, c, way: Move::new(way, limits) };
        let (duration, period) = (stroke.way.duration(), job.profile.time.period());
        let ticks = whole_periods(duration, period);
        let (poses, count) = (Poses::StraightCut(stroke), f64::from(ticks));
        let bounded = poses.derivatives(count * period).map(|bounds| excess_of_derivatives(&bounds, &self.bounds.axes));
        let rho = bounded.unwrap_or(f64::INFINITY).max(stroke.way.derivatives(count * period)[0] / feed);
        if rho > 1.0 + EXCESS_EPSILON {
            return Err(self.too_fast(rho));
        }
        let reach = |i: usize| stroke.reach(i as f64, count);
        let cutting = Cutting {
            ticks: ticks as usize,
            period,
            limits: &bounds.axes,
            pose: &|i| stroke.at(i as f64, count),
            way: &|i| reach(i + 1) - reach(i),
            feed: &|_| feed,
        };
        let shares = cutting.shares_of_cruise((stroke.way.rise() * count) as usize);
        let spells = blocks.spells(ticks, |i| reach(i as usize));
        Ok(Cut { end: stroke.at(count, count), poses, ticks, spells, duration, length: way, sagitta: 0.0, shares })
    }

    fn too_tight(&self, tolerance: f64, tight: spline::TooTight) -> Diagnostic {
        let (within, least) = (fixed(tolerance, 4), fixed(tight.deviation, 4));
        self.refuse(&code::PLAN_SMOOTH, &format!("no smooth curve inside {within} mm (least deviation {least} mm)"))
    }

    /// The run along a smooth curve.
    pub(super) fn curved(&self, extended: &Extended, smooth: &Smooth) -> Result<Curved, Diagnostic> {
        let Self { run, job, .. } = self;
        let Smooth { curve, sagitta } = smooth;
        let (entry, end) = match run.shape {
            Shape::Open => (Entry::Plunge, extended.end),
            Shape::Ring => {
                let seam =
                    closed(curve, extended.start, extended.end - run.front).map_err(|OpenSeam { missing }| {
                        let missing = fixed(missing, 4);
                        self.refuse(&code::PLAN_SMOOTH, &format!("its smooth curve ends {missing} mm before it closes"))
                    })?;
                (Entry::Steady(extended.start), seam.max(extended.end))
            }
        };
        let knife = &job.profile.knife;
        let blade = Blade { width: knife.width_mm, radius: run.edge.lead(knife.ends()) };
        let near = Rotation(run.start.c.0 - run.edge.turn());
        let course = Course { orientation: run.orientation, entry, to: end, blade, near };
        let way = Way::new(curve, &course).map_err(|TooTight { at }| {
            let (x, y) = (fixed(at.x, 2), fixed(at.y, 2));
            let reason = format!("the blade cannot be a chord of its curve at X {x} Y {y} mm");
            self.refuse(&code::PLAN_CHORD, &reason).hint("set `knife.follow = \"tangent\"` for this file")
        })?;
        let [heel] = curve.derivatives::<1>(0.0);
        let plunged = [Point::new(heel[0], heel[1]), way.point(way.from)];
        let under = extended.stations().take_while(|(_, station)| *station < way.from);
        let beside = under.map(|(point, _)| polyline::distance_to_segment(point, plunged[0], plunged[1]));
        let beside = beside.fold(0.0, f64::max);
        Ok(Curved { cut: Cut { sagitta: *sagitta, ..self.along(&way)? }, beside, lead: way.lead() })
    }

    /// Samples the fastest motion along a path over a whole number of periods, stretched until every difference and the tip
    /// keep their limits.
    fn along(&self, way: &Way) -> Result<Cut, Diagnostic> {
        let Self { run, job, blocks, bounds } = self;
        let turned = |pose: Pose| Pose { c: Rotation(pose.c.0 + run.edge.turn()), ..pose };
        if way.to - way.from < WAY_EPSILON {
            return Ok(Cut::plunge_only(turned(way.pose(way.to)), blocks.at(way.to)));
        }
        let clock = profile(way, bounds)
            .map_err(|_| self.refuse(&code::PLAN_PROFILE, "no motion within the limits was found"))?;
        let (duration, period) = (clock.duration(), job.profile.time.period());
        let [x, y, _] = bounds.axes;
        let longest = PATIENCE + (way.to - way.from) / (CRAWL * x.speed.min(y.speed));
        if duration.is_nan() || duration > longest {
            let (seconds, length) = (fixed(duration, 0), fixed(way.to - way.from, 2));
            let reason = format!("within the limits it would take {seconds} s for {length} mm: it winds too tightly");
            return Err(self.refuse(&code::PLAN_PROFILE, &reason));
        }
        let mut stretch = 1.0;
        let mut rho = 1.0;
        for _ in 0..ROUNDS {
            let ticks = whole_periods(duration * stretch, period);
            let places = clock.sample(ticks as usize + 1);
            let mut walk = way.walk(way.from);
            let tips: Vec<Point> = places.iter().map(|&u| walk.point(u)).collect();
            let ways: Vec<f64> = tips.windows(2).map(|tips| (tips[1] - tips[0]).norm()).collect();
            let mut walk = way.walk(way.from);
            let mut poses: Vec<Pose> = places.iter().map(|&u| turned(walk.at(u).pose())).collect();
            let feed = |i: usize| bounds.feed.greatest(places[i], places[i + 1]);
            let too_fast = ways.iter().enumerate().map(|(i, way)| way / (feed(i) * period)).fold(0.0, f64::max);
            rho = excess_of(&poses, period, &bounds.axes).max(too_fast);
            if rho <= 1.0 + EXCESS_EPSILON {
                let pose = |i: usize| poses[i];
                let (ticks_there, limits) = (ways.len(), &bounds.axes);
                let cutting =
                    Cutting { ticks: ticks_there, period, limits, pose: &pose, way: &|i| ways[i], feed: &feed };
                let shares = cutting.shares();
                let spells = blocks.spells(ticks, |i| places[i as usize]);
                let length = ways.iter().sum();
                let end = poses.pop().expect("a tick has two ends");
                let poses = Poses::Samples(poses);
                return Ok(Cut { poses, ticks, end, spells, duration, length, sagitta: 0.0, shares });
            }
            stretch = f64::from(ticks) * period / duration * rho;
        }
        Err(self.too_fast(rho))
    }

    fn too_fast(&self, rho: f64) -> Diagnostic {
        let percent = fixed((rho - 1.0) * 100.0, 2);
        self.refuse(&code::PLAN_CERTIFY, &format!("its samples still exceed a limit by {percent} % of time"))
    }

    fn refuse(&self, code: &'static code::Code, reason: &str) -> Diagnostic {
        let spans = &self.run.spans;
        let (first, last) = (spans[0], spans[spans.len() - 1]);
        let span = Span { end: last.end.max(first.end), ..first };
        Diagnostic::new(code, format!("the run of blocks {} to {}: {reason}", first.block, last.block)).at(span)
    }
}

/// The smallest number of periods, at least 1, that lasts `duration`.
pub(super) fn whole_periods(duration: f64, period: f64) -> u32 {
    ((duration / period - PERIOD_EPSILON).ceil() as u32).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_ends_where_it_closes_and_is_refused_when_it_does_not() {
        let line = Curve::line([0.0, 20.0], [[-10.0, 0.0], [10.0, 0.0]]);
        assert!((closed(&line, 10.0, 9.6).expect("it closes") - 10.0).abs() < 1e-9);
        assert_eq!(closed(&line, 10.0, 10.8), Ok(10.8), "an overlap stays");
        let missing = reaching(&line, [[10.4, 0.0], [1.0, 0.0]], 19.0).expect_err("the line ends before").missing;
        assert!((missing - 0.4).abs() < 1e-9);
    }
}
