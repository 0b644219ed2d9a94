//! One run, from the plunge to the lift: overlaps join the polyline, the polyline becomes a curve, the curve a motion,
//! the motion samples, and the samples are certified.

use super::bound;
use super::certify::{EXCESS_EPSILON, excess_of};
use super::chord::TooTight;
use super::feed::Feed;
use super::law::{Blade, Course, Entry, WAY_EPSILON, Way};
use super::profile::{Bounds, profile};
use super::smooth::{Curve, Smooth, smooth};
use super::tube::Tube;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::{Heading, Point, Rotation, Vector, polyline};
use crate::ir::motion::Shares;
use crate::ir::toolpath::{Law, Pose, Run, Shape};
use crate::machine::Job;
use crate::machine::kinematics::Move;
use crate::source::Span;
use crate::units::number::fixed;

/// A run as it will be cut.
#[derive(Debug)]
pub struct Cut {
    /// The poses at its ticks, the one at its end included; one alone when the blade plunges and lifts without a way.
    pub poses: Vec<Pose>,
    /// The source block being cut at each of them.
    pub blocks: Vec<u32>,
    /// Time from rest to rest before it was stretched to whole periods, s.
    pub duration: f64,
    /// Way of the tip, mm.
    pub length: f64,
    /// Greatest bulge of the tube that the curve uses, mm.
    pub bulge: f64,
    /// What keeps it from being faster, in ticks.
    pub shares: Shares,
}

/// Part of the tolerance within which a polyline counts as straight.
const STRAIGHT_SHARE: f64 = 0.9;
/// Rounds of stretching before a run is refused; measured need is 1, by less than 1 %.
const ROUNDS: usize = 12;
/// Steps towards the seam of a ring, and the longest of them, mm: the gap is below two tolerances, and a step closes nearly
/// all of it because the parameter is nearly the way.
const SEAM_STEPS: usize = 8;
const SEAM_STEP: f64 = 1.0;
/// Part of a period by which a duration may exceed a whole number of them without taking one more: rounding.
const PERIOD_EPSILON: f64 = 1e-9;

/// The polyline that the tip and, in the plunge, the tail follow: the run with its overlaps.
struct Extended {
    points: Vec<Point>,
    /// The block of each chord.
    blocks: Vec<u32>,
    /// Greatest speed of the tip on each chord, mm/s.
    feeds: Vec<f64>,
    /// Station at which the run proper starts.
    start: f64,
    /// Station at which the tip is lifted.
    end: f64,
}

/// Solves one run.
pub(super) fn solve(run: &Run, tolerance: f64, job: &Job) -> Result<Cut, Diagnostic> {
    let knife = &job.profile.knife;
    let extended = extend(run, knife.width_mm);
    let blocks = Blocks::new(&extended);
    let period = job.profile.time.period();
    let feed = Feed::new(&blocks.stations, &extended.feeds);
    let bounds = Bounds { axes: job.profile.axes.limits(), feed };
    let is_straight = run.shape == Shape::Open && polyline::is_straight(&extended.points, STRAIGHT_SHARE * tolerance);
    if is_straight && bounds.feed.constant().is_some() {
        return straight(run, &extended, &blocks, &bounds, job);
    }
    let smooth = if is_straight {
        Smooth { curve: chord(&extended), bulge: 0.0 }
    } else {
        smooth(&Tube::new(extended.points, tolerance, &job.profile)).map_err(|e| {
            let least = fixed(e.deviation, 4);
            refuse(
                run,
                &code::PLAN_SMOOTH,
                &format!("no smooth curve inside {} mm (least deviation {least} mm)", fixed(tolerance, 4)),
            )
        })?
    };
    let (entry, end) = match run.shape {
        Shape::Open => (Entry::Plunge, extended.end),
        Shape::Ring => (Entry::Steady(extended.start), closed(&smooth.curve, extended.start, extended.end)),
    };
    let blade = Blade { width: knife.width_mm, radius: run.edge.lead(knife.ends()) };
    let near = Rotation(run.start.c.0 - run.edge.turn());
    let course = Course { law: run.law, entry, to: end, blade, near };
    let way = Way::new(&smooth.curve, &course).map_err(|TooTight { at }| {
        let (x, y) = (fixed(at.x, 2), fixed(at.y, 2));
        let reason = format!("the blade cannot be a chord of its curve at X {x} Y {y} mm");
        refuse(run, &code::PLAN_CHORD, &reason).hint("set `knife.follow = \"tangent\"` for this file")
    })?;
    let pose = |u: f64| {
        let pose = way.pose(u);
        Pose { c: Rotation(pose.c.0 + run.edge.turn()), ..pose }
    };
    if way.to - way.from < WAY_EPSILON {
        return Ok(plunge_only(pose(way.to), blocks.at(way.to)));
    }
    let timing = profile(&way, &bounds)
        .map_err(|_| refuse(run, &code::PLAN_PROFILE, "no motion within the limits was found"))?;
    let mut cut = certified(run, timing.duration(), period, &bounds, |count| {
        let places = timing.sample(count);
        let tips: Vec<Point> = places.iter().map(|&u| way.point(u)).collect();
        let (poses, blocks) = places.iter().map(|&u| (pose(u), blocks.at(u))).unzip();
        let ways = tips.windows(2).map(|w| (w[1] - w[0]).norm()).collect();
        let feeds = places.windows(2).map(|w| bounds.feed.greatest(w[0], w[1])).collect();
        Samples { poses, blocks, ways, feeds }
    })?;
    cut.bulge = smooth.bulge;
    Ok(cut)
}

/// Where a ring that should end at parameter `end` really closes: smoothing may have drawn its end back from its start, and
/// the tip must come as far as that.
fn closed(curve: &Curve, start: f64, end: f64) -> f64 {
    let [from, along] = curve.derivatives::<2>(start).map(|v| Vector::new(v[0], v[1]));
    let short = |u: f64| {
        let [at] = curve.derivatives::<1>(u);
        (from - Vector::new(at[0], at[1])).dot(&along) / along.norm()
    };
    let last = curve.breaks()[curve.breaks().len() - 1];
    let mut end = end;
    for _ in 0..SEAM_STEPS {
        end = (end + short(end).clamp(0.0, SEAM_STEP)).min(last);
    }
    end
}

/// The chord from end to end of a straight run, as a curve over its own length.
fn chord(extended: &Extended) -> Curve {
    let ends = [extended.points[0], extended.points[extended.points.len() - 1]];
    Curve::line([0.0, extended.end], ends.map(|point| [point.x, point.y]))
}

/// A straight run in closed form: the tightest axis decides.
fn straight(run: &Run, extended: &Extended, blocks: &Blocks, bounds: &Bounds, job: &Job) -> Result<Cut, Diagnostic> {
    let knife = &job.profile.knife;
    let (first, last) = (extended.points[0], extended.points[extended.points.len() - 1]);
    let whole = (last - first).norm();
    let u = (last - first) / whole;
    let c = run.start.c.nearest(Heading::new(Heading::of(u).radians() + run.edge.turn()));
    let lead = run.edge.lead(knife.ends());
    let pose = |reach: f64| Pose { centre: first + u * (reach - lead), c };
    let way = whole - knife.width_mm;
    if way < WAY_EPSILON {
        return Ok(plunge_only(pose(whole.max(knife.width_mm)), blocks.at(whole)));
    }
    let mut limits = bounds.axes[0].along(u.x).min(bounds.axes[1].along(u.y));
    limits.speed = limits.speed.min(bounds.feed.at(0.0));
    let motion = Move::new(way, limits);
    certified(run, motion.duration(), job.profile.time.period(), bounds, |count| {
        let reach = |i: usize| knife.width_mm + motion.at(i as f64, (count - 1) as f64);
        let (poses, blocks) = (0..count).map(|i| (pose(reach(i)), blocks.at(reach(i)))).unzip();
        let ways = (1..count).map(|i| reach(i) - reach(i - 1)).collect();
        Samples { poses, blocks, ways, feeds: vec![bounds.feed.at(0.0); count - 1] }
    })
}

/// A motion at the ticks of a run.
struct Samples {
    poses: Vec<Pose>,
    blocks: Vec<u32>,
    /// Way of the tip from each tick to the next, mm.
    ways: Vec<f64>,
    /// Greatest speed of the tip from each tick to the next, mm/s.
    feeds: Vec<f64>,
}

fn plunge_only(pose: Pose, block: u32) -> Cut {
    Cut { poses: vec![pose], blocks: vec![block], duration: 0.0, length: 0.0, bulge: 0.0, shares: Shares::default() }
}

/// Samples a motion over a whole number of periods, stretched until every difference keeps its limit, and the tip its
/// feed.
fn certified(
    run: &Run,
    duration: f64,
    period: f64,
    bounds: &Bounds,
    sample: impl Fn(usize) -> Samples,
) -> Result<Cut, Diagnostic> {
    let mut stretch = 1.0;
    let mut rho = 1.0;
    for _ in 0..ROUNDS {
        let ticks = whole_periods(duration * stretch, period);
        let Samples { poses, blocks, ways, feeds } = sample(ticks + 1);
        let too_fast = ways.iter().zip(&feeds).map(|(way, feed)| way / (feed * period)).fold(0.0, f64::max);
        rho = excess_of(&poses, period, &bounds.axes).max(too_fast);
        if rho <= 1.0 + EXCESS_EPSILON {
            let shares = bound::shares(&poses, &ways, &feeds, period, &bounds.axes);
            return Ok(Cut { poses, blocks, duration, length: ways.iter().sum(), bulge: 0.0, shares });
        }
        stretch = ticks as f64 * period / duration * rho;
    }
    let percent = fixed((rho - 1.0) * 100.0, 2);
    Err(refuse(run, &code::PLAN_CERTIFY, &format!("its samples still exceed a limit by {percent} % of time")))
}

/// The least number of periods, at least 1, that last `duration`.
pub(super) fn whole_periods(duration: f64, period: f64) -> usize {
    ((duration / period - PERIOD_EPSILON).ceil() as usize).max(1)
}

fn refuse(run: &Run, code: &'static code::Code, reason: &str) -> Diagnostic {
    let (first, last) = (run.spans[0], run.spans[run.spans.len() - 1]);
    let span = Span { end: last.end.max(first.end), ..first };
    Diagnostic::new(code, format!("the run of blocks {} to {}: {reason}", first.block, last.block)).at(span)
}

/// The run with its overlaps, as one polyline.
fn extend(run: &Run, width: f64) -> Extended {
    match (run.shape, run.law) {
        (Shape::Open, _) => extend_open(run),
        (Shape::Ring, Law::Tangent) => extend_ring(run, 0.0),
        (Shape::Ring, Law::Chord) => extend_ring(run, TAIL_REACH * width),
    }
}

/// Overlaps run straight on along the end chords.
fn extend_open(run: &Run) -> Extended {
    let points = run.extended();
    let mut blocks: Vec<u32> = run.spans.iter().map(|s| s.block).collect();
    let mut feeds = run.feeds.clone();
    if run.heel > 0.0 {
        blocks.insert(0, blocks[0]);
        feeds.insert(0, feeds[0]);
    }
    blocks.resize(points.len() - 1, blocks[blocks.len() - 1]);
    feeds.resize(points.len() - 1, feeds[feeds.len() - 1]);
    let end = polyline::length(&points);
    Extended { points, blocks, feeds, start: 0.0, end }
}

/// Length of contour before the start and behind the end of a ring that joins the polyline, so that the curve there is
/// what it is elsewhere, mm; and the fewest chords of it.
const LEAD: f64 = 8.0;
const LEAD_CHORDS: usize = 3;

/// How far behind its tip along a curve the tail of a blade may lie, in widths of the blade: on the tightest curve whose
/// chord it can be, with the radius of 0.55 widths, it is 1.26.
const TAIL_REACH: f64 = 1.3;

/// A ring overlaps along itself: it starts in full motion law, its tail on the path by at most `tail` mm behind, and goes
/// past its start by the front overlap.
fn extend_ring(run: &Run, tail: f64) -> Extended {
    let n = run.points.len() - 1;
    let chord = |i: usize| (run.points[i % n + 1] - run.points[i % n]).norm();
    // Chords of the contour, walked on and on until they are as long as asked, or twice round: enough for any overlap.
    let lead = |length: f64, next: &dyn Fn(usize) -> usize| {
        let (mut chords, mut sum) = (0, 0.0);
        while (sum < length || chords < LEAD_CHORDS) && chords < 2 * n {
            sum += chord(next(chords));
            chords += 1;
        }
        (chords, sum)
    };
    let (before, start) = lead(LEAD + tail, &|i| n - 1 - i % n);
    let (after, _) = lead(run.front + LEAD, &|i| i);
    let first = n - before % n;
    let chords = before + n + after;
    let points = (0..=chords).map(|i| run.points[(first + i) % n]).collect();
    let blocks = (0..chords).map(|i| run.spans[(first + i) % n].block).collect();
    let feeds = (0..chords).map(|i| run.feeds[(first + i) % n]).collect();
    let end = start + polyline::length(&run.points) + run.front;
    Extended { points, blocks, feeds, start, end }
}

/// The source block at each station of an extended run.
struct Blocks {
    stations: Vec<f64>,
    blocks: Vec<u32>,
}

impl Blocks {
    fn new(extended: &Extended) -> Self {
        Self { stations: polyline::stations(&extended.points), blocks: extended.blocks.clone() }
    }

    fn at(&self, u: f64) -> u32 {
        self.blocks[crate::geom::spline::span(&self.stations, u)]
    }
}
