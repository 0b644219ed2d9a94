//! What heads and conveyor can do at the best, in closed form: bounds that no acceleration enters.
//!
//! Along a chain the lag q of a head, how far it has been carried along the feed, grows by v t and falls by the way that
//! the chain advances against the feed. A chord takes t = max(|dy|/Vy, L/Vcut, dx/(v + Vx) or -dx/(Vx - v), turn/Wc); a
//! corner takes the time of lift, turn and plunge. A head that is early waits: q := max(0, q + v t - dx). A chain can be cut
//! iff the greatest lag is no more than the travel of the head along the feed.

use crate::geom::{Point, polyline};
use crate::machine::{Limits, MachineProfile};

/// What bounds a head.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Speeds of x, y (mm/s) and c (rad/s).
    pub speeds: [f64; 3],
    /// Speed of the tip, mm/s.
    pub feed: f64,
    /// Time of lift and plunge at a corner, s.
    pub lift: f64,
    /// A turn that is more is a corner, rad.
    pub corner: f64,
}

impl Bounds {
    /// Those of a machine.
    pub fn of(profile: &MachineProfile) -> Self {
        let speed = |limits: Limits| limits.speed;
        Self {
            speeds: profile.axes.limits().map(speed),
            feed: profile.knife.feed_mm_s.unwrap_or(f64::INFINITY),
            lift: profile.knife.clear() + profile.knife.plunge(),
            corner: profile.corner.angle(),
        }
    }

    /// The greatest lag along a chain at a speed of the conveyor, mm.
    pub fn lag(&self, points: &[Point], speed: f64) -> f64 {
        let [x, y, c] = self.speeds;
        let (mut lag, mut most) = (0.0_f64, 0.0_f64);
        let mut pass = |time: f64, advance: f64| {
            lag = (lag + speed * time - advance).max(0.0);
            most = most.max(lag);
        };
        for (i, ends) in points.windows(2).enumerate() {
            let way = ends[1] - ends[0];
            let advance = -way.x;
            let turn = |at: usize| polyline::turn_at(points[at - 1], points[at], points[at + 1]).abs();
            let mut turned = 0.0;
            if i > 0 {
                if turn(i) > self.corner {
                    pass(self.lift + turn(i) / c, 0.0);
                } else {
                    turned += turn(i) / 2.0;
                }
            }
            if i + 2 < points.len() && turn(i + 1) <= self.corner {
                turned += turn(i + 1) / 2.0;
            }
            let along = if advance >= 0.0 { advance / (speed + x) } else { -advance / (x - speed) };
            let time = (way.y.abs() / y).max(way.norm() / self.feed).max(along).max(turned / c);
            pass(time, advance);
        }
        most
    }

    /// The greatest speed of the conveyor at which a chain takes no more travel than that, up to `most`; mm and mm/s.
    pub fn fastest(&self, points: &[Point], travel: f64, most: f64) -> f64 {
        let fits = |speed: f64| self.lag(points, speed) <= travel;
        let [mut slow, mut fast] = [0.0, most.min(self.speeds[0])];
        if fits(fast) {
            return fast;
        }
        for _ in 0..60 {
            let middle = f64::midpoint(slow, fast);
            if fits(middle) { slow = middle } else { fast = middle }
        }
        slow
    }
}

/// The least number of heads: the most chains, of which each is a greatest and a least x, that one place along the feed is
/// on.
pub(super) fn heads(spans: impl Iterator<Item = [f64; 2]>) -> usize {
    let mut ends: Vec<(f64, bool)> = spans.flat_map(|[most, least]| [(least, true), (most, false)]).collect();
    // Where one ends another may begin.
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
    use crate::flow::heads::{Links, Start, Task, assign};
    use crate::flow::rows::{Conflicts, colour};

    const BOUNDS: Bounds = Bounds {
        speeds: [1000.0, 1000.0, 25.132_741_228_718_345],
        feed: f64::INFINITY,
        lift: 0.15,
        corner: 0.349_065_850_398_865_9,
    };

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn a_rectangle_is_cut_at_the_speeds_that_its_edge_across_the_feed_allows() {
        let chain = points(&[(300.0, 0.0), (300.0, 200.0), (0.0, 200.0)]);
        for (travel, expected) in [(50.0, 121.212), (200.0, 484.848), (500.0, 1000.0)] {
            let speed = BOUNDS.fastest(&chain, travel, 1e4);
            assert!((speed - expected).abs() < 1e-3, "{travel} mm: {speed} mm/s");
        }
    }

    #[test]
    fn a_circle_takes_the_travel_that_its_ends_across_the_feed_take() {
        let angle = |i: u32| std::f64::consts::PI * f64::from(i) / 20_000.0;
        let half: Vec<Point> =
            (0..=20_000).map(|i| Point::new(100.0 * angle(i).cos(), 100.0 * angle(i).sin())).collect();
        let bounds = Bounds { speeds: [1e9, 1000.0, 1e9], ..BOUNDS };
        let travel = bounds.lag(&half, 200.0);
        assert!((travel - 100.0 * (1.04_f64.sqrt() - 1.0)).abs() < 2e-3, "{travel}");
    }

    /// A diamond of 200 x 120 with its middle there: its two chains.
    fn diamond(x: f64, y: f64) -> [Vec<Point>; 2] {
        [60.0, -60.0].map(|side| points(&[(x + 100.0, y), (x, y + side), (x - 100.0, y)]))
    }

    /// A change takes 0.3 s, and the way across the feed between the tasks, whose y these are (mm), at 1000 mm/s.
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

    /// Heads and rows of three diamonds, each chain at the moment at which it passes its station.
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
        let heads = assign(&tasks, &Change(chains.iter().map(|chain| chain[0].y).collect()));
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
        assert_eq!(heads(spans.into_iter()), 4);
        assert_eq!(diamonds(50.0), [4, 2]);
        assert_eq!(diamonds(186.6), [4, 2]);
        assert_eq!(diamonds(186.8), [6, 2]);
        assert_eq!(diamonds(200.0), [6, 2]);
    }
}
