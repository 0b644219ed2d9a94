//! Lines that retrace themselves behind their start: the overcut of another cutter, and further rounds. This is an independent
//! implementation of the reader's rule. A line is walked from its first place. Where it returns there, everything behind must
//! coincide with the walk at the same distance from its start (or, on whole rounds, from its end), or continue straight out of
//! the ring. A last stretch that closes the line may lead straight back over it.

use std::f64::consts::TAU;
use std::ops::Range;

use super::lines::{MEETS, Path, Round};
use crate::geom::{Point, cross, polyline, ring};
use crate::machine::patterns::Dxf;

/// Greatest difference in length between two walks along a line: in mm, and relative.
const SLIP: f64 = 0.2;
const SLIP_SHARE: f64 = 0.002;
/// Maximum number of returns to the start that are examined.
const MOST_RETURNS: usize = 8;
/// Maximum number of lines that are walked as one: their ends are compared with each other.
const MOST_PATHS: usize = 2000;
/// Maximum number of compared stretches, as a multiple of those of the walk.
const MOST_COMPARED: usize = 64;
/// Number of sampled places of a curve.
const SAMPLES: usize = 16;

/// Lines that belong together, without the parts that retrace them.
pub(super) fn once(paths: Vec<Path>) -> Vec<Path> {
    let Some(walk) = walk(&paths) else { return paths };
    let legs = Legs::of(&walk);
    let last = legs.closing().or_else(|| legs.closing_before_last().filter(|_| walk[0].is_closed));
    let Some(last) = last else { return paths };
    let mut kept = walk;
    let (path, edge) = legs.owner[last];
    kept.truncate(path + 1);
    kept[path].end_at(edge, legs.start(), path == 0);
    kept
}

/// Lines in walking order, each in the direction of the walk, beginning with the first one or with those that lead to its
/// start; `None` if they branch.
pub(super) fn walk(paths: &[Path]) -> Option<Vec<Path>> {
    let [first, others @ ..] = paths else { return None };
    if others.is_empty() {
        return (first.points.len() > 1).then(|| vec![first.clone()]);
    }
    if paths.len() > MOST_PATHS || paths.iter().any(|path| path.is_closed) {
        return None;
    }
    let mut left: Vec<&Path> = others.iter().collect();
    let mut walked = vec![first.clone()];
    // Continue from the end of the first line, then from its start; reverse the whole walk each time.
    for _ in 0..2 {
        loop {
            let at = *walked.last()?.points.last()?;
            let meets = |end: Option<&Point>| end.is_some_and(|end| (end - at).norm() <= MEETS);
            let [starts, ends] = [
                left.iter().position(|path| meets(path.points.first())),
                left.iter().position(|path| meets(path.points.last())),
            ];
            let next = match (starts, ends) {
                (Some(k), _) => left.remove(k).clone(),
                (None, Some(k)) => left.remove(k).turned(),
                (None, None) => break,
            };
            walked.push(next);
        }
        walked = walked.iter().rev().map(Path::turned).collect();
    }
    left.is_empty().then_some(walked)
}

impl Path {
    /// Path in the opposite direction.
    fn turned(&self) -> Self {
        let turned = |round: &Round| Round { start: round.start + round.sweep, sweep: -round.sweep, ..*round };
        let curves = self.curves.iter().rev().map(|curve| curve.as_ref().map(turned)).collect();
        Self { points: self.points.iter().rev().copied().collect(), curves, ..self.clone() }
    }

    /// Ends a line inside an edge at a point; a line that is a ring by itself becomes closed.
    fn end_at(&mut self, edge: usize, at: Point, is_ring: bool) {
        self.points.truncate(edge + 1);
        self.curves.truncate(edge + 1);
        if let Some(Some(round)) = self.curves.last_mut() {
            round.sweep *= round.share(at);
        }
        self.is_closed = is_ring;
        if !is_ring {
            self.points.push(at);
        }
    }
}

impl Round {
    /// Fraction of the curve, 0 to 1, up to its place nearest to a point.
    fn share(&self, at: Point) -> f64 {
        let spoke = at - self.centre;
        let angle = (spoke.y.atan2(spoke.x) - self.start) * self.sweep.signum();
        let share = angle.rem_euclid(TAU) / self.sweep.abs();
        match share {
            _ if share <= 1.0 => share,
            _ if (at - self.at(0.0)).norm() <= (at - self.at(1.0)).norm() => 0.0,
            _ => 1.0,
        }
    }
}

/// Stretch of a walk.
#[derive(Debug, Clone, Copy)]
struct Leg {
    ends: [Point; 2],
    curve: Option<Round>,
}

impl Leg {
    fn share(&self, at: Point) -> f64 {
        self.curve.map_or_else(|| polyline::foot(at, self.ends[0], self.ends[1]), |round| round.share(at))
    }

    fn at(&self, share: f64) -> Point {
        self.curve.map_or_else(|| self.ends[0] + (self.ends[1] - self.ends[0]) * share, |round| round.at(share))
    }

    fn distance(&self, at: Point) -> f64 {
        (self.at(self.share(at)) - at).norm()
    }
}

/// Part of a walk behind the first round: a further round, or the beginning of one.
#[derive(Debug, Clone, Copy)]
struct Lap {
    /// Stretch that closes the first round, and length of that round, mm.
    last: usize,
    round: f64,
    /// Start and end, mm behind the first round.
    from: f64,
    to: f64,
    /// True if it runs in the opposite direction.
    is_back: bool,
}

/// Walk divided into stretches.
struct Legs {
    all: Vec<Leg>,
    /// Path and edge of each stretch.
    owner: Vec<(usize, usize)>,
    /// Length from the start to the start of each stretch, and total length, mm.
    stations: Vec<f64>,
}

impl Legs {
    fn of(walk: &[Path]) -> Self {
        let mut legs = Self { all: Vec::new(), owner: Vec::new(), stations: vec![0.0] };
        for (k, path) in walk.iter().enumerate() {
            for edge in 0..path.curves.len() {
                legs.all.push(Leg { ends: path.edge(edge), curve: path.curves[edge] });
                legs.owner.push((k, edge));
                legs.stations.push(legs.length() + path.length(edge));
            }
        }
        legs
    }

    fn start(&self) -> Point {
        self.all[0].ends[0]
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Point at a station.
    fn at(&self, station: f64) -> Point {
        let k = self.stations.partition_point(|&at| at <= station).clamp(1, self.all.len()) - 1;
        let length = self.stations[k + 1] - self.stations[k];
        let share = if length > 0.0 { (station - self.stations[k]) / length } else { 0.0 };
        self.all[k].at(share.clamp(0.0, 1.0))
    }

    /// Stretch that closes the ring, if the walk retraces itself behind it or continues straight.
    fn closing(&self) -> Option<usize> {
        self.first_return(|k, round| self.goes_again(k, round) || self.goes_straight_on(k))
    }

    /// Stretch that closes the ring of a line whose last stretch leads straight back over the whole retraced part.
    fn closing_before_last(&self) -> Option<usize> {
        let ([others @ .., back], [stations @ .., _]) = (&self.all[..], &self.stations[..]) else { return None };
        if others.is_empty() || back.curve.is_some() {
            return None;
        }
        let open = Self { all: others.to_vec(), owner: Vec::new(), stations: stations.to_vec() };
        let last = open.first_return(|k, round| open.goes_again(k, round))?;
        let is_on_back = |leg: &Leg| leg.curve.is_none() && back.distance(leg.ends[1]) <= Dxf::RETRACE_OFF;
        open.all[last..].iter().all(is_on_back).then_some(last)
    }

    /// First stretch that returns to the start and for which `ends_ring` is true.
    fn first_return(&self, ends_ring: impl Fn(usize, f64) -> bool) -> Option<usize> {
        let start = self.start();
        let comes_back = |k: &usize| self.all[*k].distance(start) <= Dxf::RETRACE_OFF;
        let returns = (1..self.all.len()).filter(comes_back).filter(|k| !self.is_flat(*k)).take(MOST_RETURNS);
        returns.into_iter().find(|&k| {
            let round = self.stations[k] + (self.stations[k + 1] - self.stations[k]) * self.all[k].share(start);
            ends_ring(k, round)
        })
    }

    /// True if everything behind a stretch that returns to the start continues straight from there, out of the ring.
    fn goes_straight_on(&self, last: usize) -> bool {
        let (start, behind) = (self.start(), &self.all[last..]);
        let Some(along) = (start - behind[0].ends[0]).try_normalize(Dxf::RETRACE_OFF) else { return false };
        let is_on_ray = |at: Point| {
            let way = at - start;
            along.dot(&way) >= -Dxf::RETRACE_OFF && cross(along, way).abs() <= Dxf::RETRACE_OFF
        };
        let end = behind[behind.len() - 1].ends[1];
        let ring: Vec<Point> = self.all[..=last].iter().map(|leg| leg.ends[0]).collect();
        (Dxf::RETRACE_OFF..=Dxf::PAST_CORNER).contains(&(end - start).norm())
            && behind.iter().all(|leg| leg.curve.is_none() && is_on_ray(leg.ends[1]))
            && !ring::contains(&ring, end)
    }

    /// True if the walk up to a stretch encloses no area.
    fn is_flat(&self, last: usize) -> bool {
        let start = self.start();
        let places = self.all[..=last].iter().flat_map(|leg| {
            let count = if leg.curve.is_some() { SAMPLES } else { 1 };
            (0..count).map(move |k| leg.at(k as f64 / count as f64))
        });
        let places: Vec<Point> = places.chain([start]).collect();
        let doubled: f64 = places.windows(2).map(|ends| cross(ends[0] - start, ends[1] - start)).sum();
        doubled.abs() <= Dxf::RETRACE_OFF * polyline::length(&places)
    }

    /// True if everything behind the first `round` mm, which end on stretch `last`, coincides with the walk one round earlier;
    /// a whole round may run in the opposite direction.
    fn goes_again(&self, last: usize, round: f64) -> bool {
        let again = self.length() - round;
        if again <= Dxf::RETRACE_OFF {
            return false;
        }
        let laps = ((again - Dxf::RETRACE_OFF) / round).ceil().max(1.0) as usize;
        laps.saturating_mul(last) <= MOST_COMPARED.saturating_mul(self.all.len())
            && (0..laps).all(|k| {
                let from = k as f64 * round;
                let lap = Lap { last, round, from, to: again.min(from + round), is_back: false };
                let is_whole = again >= from + round - SLIP - SLIP_SHARE * (from + round);
                self.goes_along(lap) || is_whole && self.goes_along(Lap { is_back: true, ..lap })
            })
    }

    /// True if the walk on a further round coincides with the first round.
    fn goes_along(&self, lap: Lap) -> bool {
        let Lap { last, round, from, to, is_back } = lap;
        let first = |station: f64| if is_back { round - (station - from) } else { station - from };
        let mut stations = vec![from, to];
        for k in (0..=last).chain(self.near(round + from, 0.0).start..self.near(round + to, 0.0).end) {
            let ends = [self.stations[k], self.stations[k + 1]];
            let count = if self.all[k].curve.is_some() { SAMPLES } else { 1 };
            let own = (0..count).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / count as f64);
            // Stations of the first round, and of the lap itself.
            stations.extend(own.clone().map(|at| from + if is_back { round - at } else { at }));
            stations.extend(own.map(|at| at - round));
        }
        stations.retain(|at| (from..=to).contains(at));
        stations.into_iter().all(|station| {
            let [place, before] = [self.at(round + station), self.at(first(station))];
            let slip = SLIP + SLIP_SHARE * station;
            let ways = [0.0, round, -round].map(|turn| self.near(first(station) + turn, slip));
            let is_on_head = || ways.into_iter().flatten().any(|k| k <= last && self.is_on(k, place));
            let mut tail = self.near(round + station, slip);
            (place - before).norm() <= slip && is_on_head() && tail.any(|k| k >= last && self.is_on(k, before))
        })
    }

    /// Stretches around a station of the walk.
    fn near(&self, station: f64, slip: f64) -> Range<usize> {
        let first = self.stations.partition_point(|&at| at < station - slip).saturating_sub(1);
        first..self.stations.partition_point(|&at| at <= station + slip).min(self.all.len())
    }

    fn is_on(&self, k: usize, place: Point) -> bool {
        self.all[k].distance(place) <= Dxf::RETRACE_OFF
    }
}
