//! The closing of a line: how a line returns to its start, and the ring that results.
//!
//! Drawing programs close an outline in several ways:
//!
//! - The last place is the first.
//! - The line stops a little before its start.
//! - The line runs on past its start, because other software adds an overcut: along its own head, from where a closing segment
//!   may lead back, or straight on where the head turns.
//! - The line goes round twice in one stroke, or there and back.

use crate::geom::{Point, cross, polyline, ring};

/// Maximum length of an overcut that goes straight on from the start of an outline at a corner, mm.
pub const LONGEST_STRAIGHT: f64 = 10.0;
/// Minimum distance within which the tail of a line counts as lying on its head, mm. Programs that compute an overcut from
/// rounded places miss the head by as much.
pub const LEAST_REACH: f64 = 0.2;
/// Maximum distance between two places due to rounding to the grid of a file, in units: the diagonal.
const DIAGONAL: f64 = std::f64::consts::SQRT_2;
/// Maximum number of compared places, as a multiple of those of the line. Later rounds may have fewer places than the first.
const MOST_COMPARED: usize = 64;
/// Maximum number of returns to the start that are tested. A line returns there once per round.
const MOST_RETURNS: usize = 8;
/// Tolerance on the length along two courses: multiples of the reach, and a fraction of the length.
const SLIP_REACHES: f64 = 2.0;
const SLIP_SHARE: f64 = 0.002;
/// Minimum number of segments of a ring.
const LEAST_SEGMENTS: usize = 3;

/// A line that closes into a ring and continues along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Retrace {
    /// Index of the last place of the ring. A straight segment closes the ring from there to the first place.
    pub last: usize,
    /// Number of rounds, in either direction.
    pub rounds: usize,
    /// True if one of the rounds runs backwards.
    pub is_back: bool,
    /// Length of the line past its start after the last whole round, mm.
    pub past: f64,
}

/// Distance within which the tail of a line counts as lying on its head, mm, in a file with that unit.
pub fn reach(unit: f64) -> f64 {
    (DIAGONAL * unit).max(LEAST_REACH)
}

/// Detects a line of `count` places that runs past its start or goes round again; `None` for every other line. A line that
/// comes near its start only at its end costs a few comparisons per place.
pub fn retrace(count: usize, at: impl Fn(usize) -> Point, reach: f64) -> Option<Retrace> {
    if count <= LEAST_SEGMENTS {
        return None;
    }
    let line = Line { count, at, reach };
    if (line.at)(0) == (line.at)(count - 1) {
        let open = Line { count: count - 1, at: &line.at, reach };
        return open.run_back().or_else(|| line.whole_rounds());
    }
    line.returns().take(MOST_RETURNS).find_map(|last| line.followed(last).or_else(|| line.straight_on(last)))
}

/// True if the line through three places turns back at the middle one.
pub fn turns_back([before, at, behind]: [Point; 3]) -> bool {
    (at - before).dot(&(behind - at)) < 0.0
}

struct Line<F> {
    count: usize,
    at: F,
    reach: f64,
}

impl<F: Fn(usize) -> Point> Line<F> {
    /// Rounds of a line that ends at its start, if it also passed its start before.
    fn whole_rounds(&self) -> Option<Retrace> {
        let first = (self.at)(0);
        // A plain loop over all places except the ends: every closed line runs through it.
        let is_near = |k: usize| {
            let at = (self.at)(k);
            (at.x - first.x).abs() <= self.reach && (at.y - first.y).abs() <= self.reach
        };
        let mut k = (1..self.count).find(|&k| !is_near(k))?;
        let end = (k..self.count).rev().find(|&k| !is_near(k))?;
        for _ in 0..MOST_RETURNS {
            k = (k..end).find(|&k| is_near(k))?;
            let behind = (k..end).find(|&k| !is_near(k)).unwrap_or(end);
            let distance = |k: &usize| ((self.at)(*k) - first).norm_squared();
            let at = (k..behind).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            if let Some(found) = self.followed(at - 1) {
                return Some(found);
            }
            k = behind;
        }
        None
    }

    /// Overrun of a line whose closing segment leads straight back over its tail.
    fn run_back(&self) -> Option<Retrace> {
        if self.count <= LEAST_SEGMENTS || !turns_back([self.count - 2, self.count - 1, 0].map(&self.at)) {
            return None;
        }
        let closing = [(self.at)(self.count - 1), (self.at)(0)];
        let is_on_closing =
            |k: usize| polyline::distance_to_segment((self.at)(k), closing[0], closing[1]) <= self.reach;
        let is_overrun = |found: &Retrace| found.past > self.reach && (found.last + 1..self.count).all(is_on_closing);
        let found = self.returns().take(MOST_RETURNS).find_map(|last| self.followed(last));
        found.filter(is_overrun)
    }

    /// Indices of the segments at which the line returns to its start, each by its first place.
    fn returns(&self) -> impl Iterator<Item = usize> {
        let first = (self.at)(0);
        let left = (1..self.count).find(|&k| ((self.at)(k) - first).amax() > self.reach).unwrap_or(self.count);
        let from = left.max(LEAST_SEGMENTS - 1);
        // Outcode of a place relative to the box around the start. A segment with both ends beyond one side misses the box.
        let (low, high) = (first.map(|value| value - self.reach), first.map(|value| value + self.reach));
        let sides = move |at: Point| {
            u8::from(at.x < low.x)
                | u8::from(at.x > high.x) << 1
                | u8::from(at.y < low.y) << 2
                | u8::from(at.y > high.y) << 3
        };
        let mut before = sides((self.at)(from.min(self.count - 1)));
        (from..self.count - 1).filter(move |&k| {
            let next = sides((self.at)(k + 1));
            let is_beside = std::mem::replace(&mut before, next) & next != 0;
            !is_beside && polyline::distance_to_segment(first, (self.at)(k), (self.at)(k + 1)) <= self.reach
        })
    }

    /// The ring that ends at place `last`, if the rest of the line follows that ring: whole rounds in either direction, then
    /// less than one round forwards.
    fn followed(&self, last: usize) -> Option<Retrace> {
        let ring = last + 1;
        if ring < LEAST_SEGMENTS || self.is_flat(ring) {
            return None;
        }
        let start = (self.at)(0);
        let head = Course::of((0..ring).map(&self.at).chain([start]));
        let tail = Course::of(std::iter::once(start).chain((ring..self.count).map(&self.at)));
        let (round, length) = (head.length(), tail.length());
        let (mut rounds, mut is_back, mut from) = (1, false, 0.0);
        let mut turned = None;
        while length - from > self.reach {
            if rounds * ring > MOST_COMPARED * self.count {
                return None;
            }
            let end = tail.passing(start, [from, round], self.reach);
            let lap = tail.between([from, end.unwrap_or(length)]);
            if !lap.goes_along(&head, self.reach) {
                let turned = turned.get_or_insert_with(|| head.turned());
                if end.is_none() || !lap.goes_along(turned, self.reach) {
                    return None;
                }
                is_back = true;
            }
            let Some(end) = end else { break };
            (rounds, from) = (rounds + 1, end);
        }
        let is_at_start = (self.at)(self.count - 1) == start;
        let past = if is_at_start { 0.0 } else { length - from };
        // True if the ring's end passes the start by more than its distance beside it.
        let passes_start = || {
            let [from, to] = [last, ring].map(&self.at);
            let foot = from + (to - from) * polyline::foot(start, from, to);
            (to - foot).norm() > (start - foot).norm()
        };
        let has_more = rounds > 1 || past > self.reach || (self.at)(ring) == start || past > 0.0 && passes_start();
        has_more.then_some(Retrace { last, rounds, is_back, past })
    }

    /// The ring that ends at place `last`, if the rest of the line goes straight on past the start and out of the ring.
    fn straight_on(&self, last: usize) -> Option<Retrace> {
        let (count, start, before) = (last + 1, (self.at)(0), (self.at)(last));
        let along = (start - before).try_normalize(self.reach)?;
        let past = |at: Point| along.dot(&(at - start));
        let end = (self.at)(self.count - 1);
        let is_on_ray = |k: usize| {
            let at = (self.at)(k);
            past(at) >= -self.reach && cross(along, at - start).abs() <= self.reach
        };
        let is_overcut = (self.reach..=LONGEST_STRAIGHT).contains(&past(end)) && (count..self.count).all(is_on_ray);
        if count < LEAST_SEGMENTS || !is_overcut || self.is_flat(count) {
            return None;
        }
        let ring: Vec<Point> = (0..count).map(&self.at).collect();
        (!ring::contains(&ring, end)).then_some(Retrace { last, rounds: 1, is_back: false, past: past(end) })
    }

    /// True if the ring of the first `ring` places encloses nothing.
    fn is_flat(&self, ring: usize) -> bool {
        let first = (self.at)(0);
        let (mut doubled, mut length) = (0.0, 0.0);
        for k in 1..ring {
            let [a, b] = [k - 1, k].map(&self.at);
            doubled += cross(a - first, b - first);
            length += (b - a).norm();
        }
        doubled.abs() <= self.reach * length
    }
}

/// A polyline with the length up to each place, mm.
struct Course {
    places: Vec<Point>,
    stations: Vec<f64>,
}

impl Course {
    fn of(places: impl Iterator<Item = Point>) -> Self {
        let places: Vec<Point> = places.collect();
        let stations = polyline::stations(&places);
        Self { places, stations }
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// The course in reverse.
    fn turned(&self) -> Self {
        Self::of(self.places.iter().rev().copied())
    }

    /// The stretch between two stations.
    fn between(&self, [from, to]: [f64; 2]) -> Self {
        let place = |station: f64| polyline::place(&self.places, &self.stations, station);
        let inner = self.stations.partition_point(|&at| at <= from)..self.stations.partition_point(|&at| at < to);
        let inner = self.places.get(inner).unwrap_or_default();
        Self::of([place(from)].into_iter().chain(inner.iter().copied()).chain([place(to)]))
    }

    /// True if the whole course follows `other` from its start.
    fn goes_along(&self, other: &Self, reach: f64) -> bool {
        let length = self.length();
        self.lies_on(other, length, reach) && other.lies_on(self, length, reach)
    }

    /// True if each place of the first `length` mm lies on `other`, at about the same length along it.
    fn lies_on(&self, other: &Self, length: f64, reach: f64) -> bool {
        let places = self.places.iter().zip(&self.stations).take_while(|(_, station)| **station <= length);
        places.into_iter().all(|(place, station)| other.passes(*place, *station, reach))
    }

    /// Station, about `length` mm past `from`, at which the course passes nearest to a place; `None` if it misses the place by
    /// more than `reach`.
    fn passing(&self, place: Point, [from, length]: [f64; 2], reach: f64) -> Option<f64> {
        let (slip, about) = (SLIP_REACHES * reach + SLIP_SHARE * length, from + length);
        let first = self.stations.partition_point(|&at| at < about - slip).saturating_sub(1);
        let near = (first..self.places.len() - 1).take_while(|&k| self.stations[k] <= about + slip);
        let passings = near.into_iter().map(|k| {
            let [a, b] = [self.places[k], self.places[k + 1]];
            let share = polyline::foot(place, a, b);
            let station = self.stations[k] + (self.stations[k + 1] - self.stations[k]) * share;
            ((a + (b - a) * share - place).norm(), station)
        });
        let passings = passings.filter(|(distance, at)| *distance <= reach && (at - about).abs() <= slip);
        passings.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, station)| station)
    }

    /// True if the course passes a place about `station` mm from its start.
    fn passes(&self, place: Point, station: f64, reach: f64) -> bool {
        let slip = SLIP_REACHES * reach + SLIP_SHARE * station;
        let first = self.stations.partition_point(|&at| at < station - slip).saturating_sub(1);
        let mut near = (first..self.places.len() - 1).take_while(|&k| self.stations[k] <= station + slip);
        near.any(|k| polyline::distance_to_segment(place, self.places[k], self.places[k + 1]) <= reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(places: &[[f64; 2]], expected: Option<(usize, usize, f64)>) {
        let found = retrace(places.len(), |k| places[k].into(), reach(0.1));
        let found = found.map(|Retrace { last, rounds, past, .. }| (last, rounds, (past * 1e3).round() / 1e3));
        assert_eq!(found, expected, "{places:?}");
    }

    const A: [f64; 2] = [0.0, 0.0];
    const B: [f64; 2] = [100.0, 0.0];
    const C: [f64; 2] = [100.0, 50.0];
    const D: [f64; 2] = [0.0, 50.0];

    #[test]
    fn rounds_of_irregular_outlines_are_counted_whole() {
        let mut random = fastrand::Rng::with_seed(44);
        for rounds in [2, 3, 4, 5, 7, 12, 40] {
            for case in 0..100 {
                let count = random.usize(5..24);
                let place = |k: usize, reach: f64| {
                    let angle = std::f64::consts::TAU * k as f64 / count as f64;
                    [(300.0 + reach * angle.cos()) * 10.0, (300.0 + reach * angle.sin()) * 10.0]
                        .map(|v| v.round() / 10.0)
                };
                let ring: Vec<[f64; 2]> = (0..count).map(|k| place(k, 60.0 + 90.0 * random.f64())).collect();
                let mut places = ring.repeat(rounds);
                places.push(ring[0]);
                let found = retrace(places.len(), |k| places[k].into(), reach(0.1));
                let found = found.map(|Retrace { last, rounds, is_back, .. }| (last, rounds, is_back));
                assert_eq!(found, Some((count - 1, rounds, false)), "case {case}");
                // The rounds alternate in direction.
                let back: Vec<[f64; 2]> = [ring[0]].into_iter().chain(ring[1..].iter().rev().copied()).collect();
                let directions: Vec<bool> = (1..rounds).map(|_| random.bool()).collect();
                let laps = directions.iter().flat_map(|&is_back| if is_back { &back } else { &ring });
                let places: Vec<[f64; 2]> = ring.iter().chain(laps).chain(&ring[..1]).copied().collect();
                let found = retrace(places.len(), |k| places[k].into(), reach(0.1));
                let found = found.map(|Retrace { last, rounds, is_back, .. }| (last, rounds, is_back));
                assert_eq!(found, Some((count - 1, rounds, directions.contains(&true))), "case {case}");
            }
        }
    }

    #[test]
    fn a_line_that_runs_past_its_start_is_a_ring_however_it_passes_it() {
        check(&[A, B, C, D, A, [5.0, 0.0]], Some((3, 1, 5.0)));
        check(&[A, B, C, D, A, [0.1, 0.0]], Some((3, 1, 0.1)));
        check(&[A, B, C, D, [0.0, -0.1]], Some((3, 1, 0.1)));
        check(&[A, B, C, D, [0.0, 0.1]], None);
        check(&[A, B, C, D, [-0.1, 0.0]], None);
        // Beside the head by a unit; past a corner; with a start inside an edge that the end does not repeat.
        check(&[A, B, C, D, [0.1, 0.0], [5.0, 0.1]], Some((3, 1, 5.001)));
        check(&[[90.0, 0.0], B, C, D, A, [90.0, 0.0], B, [100.0, 5.0]], Some((4, 1, 15.0)));
        check(&[[50.0, 0.0], B, C, D, A, [70.0, 0.0]], Some((4, 1, 20.0)));
    }

    #[test]
    fn a_line_that_runs_straight_past_a_corner_is_a_ring() {
        check(&[A, B, C, D, A, [0.0, -3.0]], Some((3, 1, 3.0)));
        check(&[A, B, C, D, [0.0, -3.0]], Some((3, 1, 3.0)));
        check(&[A, B, C, D, [0.0, -1.0], [0.1, -6.0]], Some((3, 1, 6.0)));
    }

    #[test]
    fn a_line_that_goes_round_again_is_a_ring() {
        check(&[A, B, C, D, A, B, C, D, A], Some((3, 2, 0.0)));
        check(&[A, B, C, D, A, B, C, D, A, B, C, D, A], Some((3, 3, 0.0)));
        check(&[A, B, C, D, A, [40.0, 0.0], B, C, D, A], Some((3, 2, 0.0)));
        check(&[A, B, C, D, A, B, C, D, A, [5.0, 0.0]], Some((3, 2, 5.0)));
        check(&[A, B, C, D, A, D, C, B, A], Some((3, 2, 0.0)));
        check(&[A, B, C, D, [0.1, 0.0], D, [50.0, 50.1], C, B, [0.0, 0.1]], Some((3, 2, 0.0)));
        check(&[A, B, C, D, A, D, C, B, A, [5.0, 0.0]], Some((3, 2, 5.0)));
        check(&[A, B, C, D, [0.1, 0.1], B, C, D, A], Some((3, 2, 0.0)));
        // Two triangles that meet at the start, twice.
        let eight = [A, B, C, A, [-50.0, 0.0], [-50.0, -50.0]];
        check(&[&eight[..], &eight, &[A]].concat(), Some((5, 2, 0.0)));
    }

    #[test]
    fn a_line_that_runs_past_its_start_and_back_is_a_ring() {
        check(&[A, B, C, D, A, [5.0, 0.0], A], Some((3, 1, 5.0)));
        check(&[A, B, C, D, [0.1, 0.0], [5.0, 0.1], A], Some((3, 1, 5.001)));
        check(&[[50.0, 0.0], B, C, D, A, [70.0, 0.0], [50.0, 0.0]], Some((4, 1, 20.0)));
        check(&[A, B, C, D, A, B, C, D, A, [5.0, 0.0], A], Some((3, 2, 0.0)));
        check(&[A, B, C, D, [0.1, 0.0], A], None);
        // The line goes back across the ring.
        check(&[A, B, C, D, A, B, [100.0, 20.0], A], None);
    }

    #[test]
    fn any_other_line_stays_as_it_is() {
        check(&[A, B, C, D, A], None);
        check(&[A, B, C, D], None);
        check(&[A, B, C, D, A, D, C, B], None);
        check(&[A, B, C, D, A, D, [0.0, 40.0], D, C, B, A], None);
        check(&[A, B, C, D, A, D, A], None);
        check(&[A, B, C, B, A], None);
        check(&[A, B, C, D, A, [5.0, 5.0]], None);
        check(&[A, B, A, [5.0, 0.0]], None);
        check(&[A, B, C, D, [0.0, 1.0]], None);
        check(&[A, B, C, D, A, [0.0, 5.0]], None);
        check(&[A, B, C, D, A, [0.0, -15.0]], None);
        check(&[A, B, C, D, A, [3.0, -5.0]], None);
        // The line goes straight on into the ring, at a bay: a slit.
        check(&[[50.0, 10.0], A, D, C, B, [50.0, 10.0], [45.0, 11.0]], None);
        check(&[A, B, C, D, A, B, [100.0, 5.0], [95.0, 5.0]], None);
    }
}
