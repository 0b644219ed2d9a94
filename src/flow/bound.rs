//! Upper bounds on the performance of heads and conveyor in closed form, without accelerations.
//!
//! The lag q of a head is the distance by which it has been carried along the feed. Along a chain it grows by v t and falls by
//! the distance that the chain advances against the feed. A chord takes t = max(|dy|/Vy, L/Vcut, dx/(v + Vx) or -dx/(Vx - v),
//! turn/Wc). A corner takes the time of lift, turn and plunge. A head that is early waits: q := max(0, q + v t - dx). A chain
//! can be cut if and only if its maximum lag does not exceed the travel of the head along the feed.

use crate::geom::{Point, Vector, polyline};
use crate::machine::{Limits, MachineProfile};

/// Speed limits of a head.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Maximum speeds of x and y, mm/s, and of C, rad/s.
    pub speeds: [f64; 3],
    /// Maximum speed of the tip, mm/s; infinite without a limit.
    pub feed: f64,
    /// Time of lift and plunge at a corner, s.
    pub lift: f64,
}

impl Bounds {
    /// The limits of a machine.
    pub fn of(profile: &MachineProfile) -> Self {
        let speed = |limits: Limits| limits.speed;
        Self {
            speeds: profile.axes.limits().map(speed),
            feed: profile.knife.feed_mm_s.unwrap_or(f64::INFINITY),
            lift: profile.knife.clear() + profile.knife.plunge(),
        }
    }

    /// Maximum lag along a path at a speed of the conveyor, mm.
    pub fn lag(&self, way: &[Step], speed: f64) -> f64 {
        let [x, y, c] = self.speeds;
        let (mut lag, mut most) = (0.0_f64, 0.0_f64);
        for step in way {
            let advance = -step.along.x;
            let along = if advance >= 0.0 { advance / (speed + x) } else { -advance / (x - speed) };
            let time = (step.along.y.abs() / y).max(step.tip / self.feed).max(along).max(step.turned / c);
            let lift = if step.lifted { self.lift } else { 0.0 };
            lag = (lag + speed * (time + lift) - advance).max(0.0);
            most = most.max(lag);
        }
        most
    }

    /// Maximum speed of the conveyor, at most `most`, at which a path stays within `travel` mm of travel, mm/s.
    pub fn fastest(&self, way: &[Step], travel: f64, most: f64) -> f64 {
        let fits = |speed: f64| self.lag(way, speed) <= travel;
        let [mut slow, mut fast] = [0.0, most.min(self.speeds[0])];
        if fits(fast) {
            return fast;
        }
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(slow, fast);
            if fits(middle) { slow = middle } else { fast = middle }
        }
        slow
    }
}

/// Bisection steps for a speed. The result is far more exact than its printed form.
const BISECTIONS: u32 = 40;

/// A step of a path: a chord, or a turn on the spot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Displacement of the head over the cloth, mm.
    pub along: Vector,
    /// Distance covered by the tip, mm.
    pub tip: f64,
    /// Absolute turn of C, rad.
    pub turned: f64,
    /// True if the knife is lifted for the step and lowered again.
    pub lifted: bool,
}

/// The path along a polyline as drawn. `is_corner` is true for the points at which the knife is lifted.
pub(super) fn drawn(points: &[Point], is_corner: impl Fn(usize) -> bool) -> Vec<Step> {
    let turn = |at: usize| polyline::turn_at(points[at - 1], points[at], points[at + 1]).abs();
    let inner = 1..points.len() - 1;
    // Without a corner between two chords, C makes half of the turn along each.
    let half = |at: usize| if inner.contains(&at) && !is_corner(at) { turn(at) / 2.0 } else { 0.0 };
    let mut way = Vec::with_capacity(points.len());
    for (i, ends) in points.windows(2).enumerate() {
        if inner.contains(&i) && is_corner(i) {
            way.push(Step { along: Vector::zeros(), tip: 0.0, turned: turn(i), lifted: true });
        }
        let along = ends[1] - ends[0];
        way.push(Step { along, tip: along.norm(), turned: half(i) + half(i + 1), lifted: false });
    }
    way
}

/// Maximum number of spans that share one place. A span is given as its upper and its lower end.
pub(super) fn abreast(spans: impl Iterator<Item = [f64; 2]>) -> usize {
    let mut ends: Vec<(f64, bool)> = spans.flat_map(|[most, least]| [(least, true), (most, false)]).collect();
    // Spans that only touch do not overlap.
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (mut now, mut most) = (0_usize, 0);
    for (_, begins) in ends {
        now = if begins { now + 1 } else { now.saturating_sub(1) };
        most = most.max(now);
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::heads::{Links, Schedule, Start, Task};
    use crate::flow::rows::{Conflicts, colour};

    const BOUNDS: Bounds = Bounds { speeds: [1000.0, 1000.0, 25.132_741_228_718_345], feed: f64::INFINITY, lift: 0.15 };

    /// The path along points, with a corner at each turn of more than 20 degrees.
    fn way(points: &[Point]) -> Vec<Step> {
        drawn(points, |at| {
            polyline::turn_at(points[at - 1], points[at], points[at + 1]).abs() > 0.349_065_850_398_865_9
        })
    }

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn a_rectangle_is_cut_at_the_speeds_that_its_edge_across_the_feed_allows() {
        let chain = points(&[(300.0, 0.0), (300.0, 200.0), (0.0, 200.0)]);
        for (travel, expected) in [(50.0, 121.212), (200.0, 484.848), (500.0, 1000.0)] {
            let speed = BOUNDS.fastest(&way(&chain), travel, 1e4);
            assert!((speed - expected).abs() < 1e-3, "{travel} mm: {speed} mm/s");
        }
    }

    #[test]
    fn a_corner_takes_the_travel_of_its_lift_its_turn_and_its_plunge() {
        // Both edges run straight against the feed, where no head lags. All of the lag comes from the corner.
        let (speed, turn) = (100.0, std::f64::consts::FRAC_PI_3);
        let chain = points(&[(200.0, 0.0), (100.0, 0.0), (50.0, 50.0 * 3.0_f64.sqrt())]);
        let free = Bounds { speeds: [1e9, 1e9, BOUNDS.speeds[2]], ..BOUNDS };
        let travel = free.lag(&way(&chain), speed);
        assert!((travel - speed * (0.15 + turn / BOUNDS.speeds[2])).abs() < 1e-5, "{travel}");
        // Without a corner, C turns while the blade moves.
        assert!(free.lag(&drawn(&chain, |_| false), speed) < 0.1 * travel);
    }

    #[test]
    fn a_circle_takes_the_travel_that_its_ends_across_the_feed_take() {
        let angle = |i: u32| std::f64::consts::PI * f64::from(i) / 20_000.0;
        let half: Vec<Point> =
            (0..=20_000).map(|i| Point::new(100.0 * angle(i).cos(), 100.0 * angle(i).sin())).collect();
        let bounds = Bounds { speeds: [1e9, 1000.0, 1e9], ..BOUNDS };
        let travel = bounds.lag(&way(&half), 200.0);
        assert!((travel - 100.0 * (1.04_f64.sqrt() - 1.0)).abs() < 2e-3, "{travel}");
    }

    /// The two chains of a diamond of 200 x 120 mm with its centre at (x, y).
    fn diamond(x: f64, y: f64) -> [Vec<Point>; 2] {
        [60.0, -60.0].map(|side| points(&[(x + 100.0, y), (x, y + side), (x - 100.0, y)]))
    }

    /// Links between tasks with these y, mm. A change takes 0.3 s and the travel across the feed at 1000 mm/s.
    struct Change(Vec<f64>);

    impl Links for Change {
        fn ticks(&self, from: Start, to: Start) -> i64 {
            ((0.3 + (self.0[to.task] - self.0[from.task]).abs() / 1000.0) * 1e6) as i64
        }
        fn cost(&self, from: usize, to: usize) -> f64 {
            (self.0[to] - self.0[from]).abs()
        }
        fn side(&self, _: Start, _: Start) -> Option<f64> {
            None
        }
    }

    /// Number of heads and of rows for three diamonds. Each chain starts at the moment at which it passes its station.
    fn diamonds(speed: f64) -> [usize; 2] {
        let (overlap, width) = (2.0, 80.0);
        let chains: Vec<Vec<Point>> =
            [diamond(0.0, 0.0), diamond(20.0, 200.0), diamond(-260.0, 0.0)].into_iter().flatten().collect();
        let tick = |way: f64| (way / speed * 1e6).round() as i64;
        let tasks: Vec<Task> = chains
            .iter()
            .map(|chain| {
                let [start, end] = [-chain[0].x - overlap, -chain[2].x + overlap].map(tick);
                Task { window: [start; 2], ticks: end - start }
            })
            .collect();
        let links = Change(chains.iter().map(|chain| chain[0].y).collect());
        let heads = Schedule { tasks: &tasks, links: &links }.heads();
        let y = |chain: &[Point], x: f64| {
            let ends = chain.windows(2).find(|ends| ends[0].x >= x && ends[1].x <= x)?;
            Some(ends[0].y + (ends[1].y - ends[0].y) * (ends[0].x - x) / (ends[0].x - ends[1].x))
        };
        let too_near = |a: usize, b: usize| {
            let pairs = heads[a].iter().flat_map(|a| heads[b].iter().map(move |b| (a.task, b.task)));
            pairs.into_iter().any(|(a, b)| {
                (-400..=140).any(|x| {
                    let ys = [a, b].map(|chain| y(&chains[chain], f64::from(x)));
                    matches!(ys, [Some(a), Some(b)] if (a - b).abs() < width)
                })
            })
        };
        let (rows, _) = colour(&Conflicts::new(heads.len(), too_near));
        [heads.len(), rows.iter().max().map_or(0, |most| most + 1)]
    }

    #[test]
    fn three_diamonds_take_four_heads_in_two_rows_up_to_the_speed_of_their_change_and_six_beyond() {
        let spans = [0.0, 0.0, 20.0, 20.0, -260.0, -260.0].map(|x| [x + 100.0, x - 100.0]);
        assert_eq!(abreast(spans.into_iter()), 4);
        assert_eq!(diamonds(50.0), [4, 2]);
        assert_eq!(diamonds(186.6), [4, 2]);
        assert_eq!(diamonds(186.8), [6, 2]);
        assert_eq!(diamonds(200.0), [6, 2]);
    }
}
