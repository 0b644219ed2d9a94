//! Spikes of outlines: ways that go out and straight back, as some plots draw slits.

use std::f64::consts::FRAC_PI_2;

use super::drawing::{Vertex, led_on, led_to, moments};
use super::shape::{LEAST_CORNERS, ROUNDING, SHORTEST_NOTCH, is_near};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, angle};

/// A straight stretch of a spike, to be cut by itself: from the side of the outline, and to its innermost place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spike {
    pub(super) root: Point,
    pub(super) tip: Vertex,
}

/// An outline without its spikes.
#[derive(Debug)]
pub(super) struct Pruned {
    pub(super) vertices: Vec<Vertex>,
    pub(super) spikes: Vec<Spike>,
    /// Drawn beyond what is left and one cut a spike: places, and moments.
    pub(super) points: isize,
    pub(super) moments: Moments,
    /// The box around what was taken out.
    pub(super) bounds: Extent,
}

/// How spikes are told from what else lies near itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Longest spike whose way back misses its root by rounding, mm.
    pub(super) longest: f64,
}

/// A way out and back that is not judged yet. Its root is the last place of the outline that it is taken out of.
#[derive(Debug, Default)]
struct Way {
    /// The places that it went out by, its tip first.
    out: Vec<Vertex>,
    /// Those that it came back by, the one at its root last.
    back: Vec<Vertex>,
}

struct Pruning {
    measure: Measure,
    pruned: Pruned,
    way: Way,
}

/// Takes the spikes out of a closed line. A way that comes back to its root to the bit is a spike however long it is; one
/// that misses it by rounding is bridged, and is a spike when it is as long as a notch. Shorter ones are the jitter of a
/// digitiser and are dropped. A way in many steps is judged as a whole, and cut by its straight stretches.
pub(super) fn prune(vertices: &[Vertex], measure: Measure) -> Pruned {
    let pruned = Pruned {
        vertices: Vec::with_capacity(vertices.len()),
        spikes: Vec::new(),
        points: 0,
        moments: Moments::default(),
        bounds: Extent::EMPTY,
    };
    let mut pruning = Pruning { measure, pruned, way: Way::default() };
    for &vertex in vertices {
        if !pruning.goes_back(vertex) {
            pruning.judge(Some(vertex));
            if !pruning.goes_back(vertex) {
                pruning.pruned.vertices.push(vertex);
            }
        }
    }
    pruning.judge(None);
    pruning.unwind();
    pruning.pruned
}

impl Pruning {
    /// Goes back one step, if the last but one place of the outline is where this one is.
    fn goes_back(&mut self, vertex: Vertex) -> bool {
        let [.., root, tip] = self.pruned.vertices[..] else { return false };
        if !is_near(root.at, vertex.at, self.measure.unit) {
            return false;
        }
        self.pruned.vertices.pop();
        self.way.out.push(tip);
        self.way.back.push(vertex);
        true
    }

    /// Decides what the way is, now that it goes no farther back; `next` is drawn behind it.
    fn judge(&mut self, next: Option<Vertex>) {
        let Way { out, back } = std::mem::take(&mut self.way);
        let (Some(&root), Some(&end)) = (self.pruned.vertices.last(), back.last()) else { return };
        let outwards: Vec<Vertex> = std::iter::once(root).chain(out.into_iter().rev()).collect();
        let is_exact = end.at == root.at;
        let length = moments(&outwards).length();
        if !is_exact && !(SHORTEST_NOTCH..=self.measure.longest).contains(&length) {
            // It stays what was drawn.
            self.pruned.vertices.extend(outwards.into_iter().skip(1).chain(back));
            return;
        }
        let slits = self.cut(&outwards);
        let drawn: Vec<Vertex> = outwards.iter().chain(&back).copied().collect();
        let bridge = if is_exact { &[][..] } else { &[end] };
        let left: Vec<Vertex> = std::iter::once(root).chain(bridge.iter().copied()).collect();
        // Nothing has led to the first place of all.
        let before = (self.pruned.vertices.len() > 1).then_some(root.span);
        let places = |vertices: &[Vertex]| led_on(before, vertices[1..].iter().chain(&next));
        self.pruned.points += places(&drawn) - places(&left) - slits;
        self.pruned.moments += moments(&drawn);
        self.pruned.moments -= moments(&left);
        self.pruned.vertices.extend(bridge);
    }

    /// Where the line starts at a tip, its two ends are the way back and out.
    fn unwind(&mut self) {
        let vertices = &self.pruned.vertices;
        let count = vertices.len();
        let most = count.saturating_sub(LEAST_CORNERS) / 2;
        let steps = (0..most).take_while(|k| vertices[k + 1].at == vertices[count - 2 - k].at).count();
        if steps == 0 {
            return;
        }
        let rest = vertices[steps..count - steps].to_vec();
        let drawn = std::mem::replace(&mut self.pruned.vertices, rest);
        let [back, outwards] = [&drawn[..=steps], &drawn[count - 1 - steps..]];
        let slits = self.cut(outwards);
        self.pruned.points += led_to(&drawn) - led_to(&self.pruned.vertices) - slits;
        self.pruned.moments += moments(back);
        self.pruned.moments += moments(outwards);
    }

    /// Cuts a way from its root to its tip, unless it is shorter than a notch: how many cuts that makes. They are no longer
    /// among what is drawn beside the cuts.
    fn cut(&mut self, outwards: &[Vertex]) -> isize {
        for vertex in outwards {
            self.pruned.bounds.add(vertex.at);
        }
        if moments(outwards).length() < SHORTEST_NOTCH {
            return 0;
        }
        let stretches = stretches(outwards, ROUNDING * self.measure.unit);
        for &[first, last] in &stretches {
            let (root, tip) = (outwards[first].at, outwards[last]);
            self.pruned.spikes.push(Spike { root, tip });
            self.pruned.moments -= Moments::line(root, tip.at);
        }
        stretches.len().cast_signed()
    }
}

/// The straight stretches of a line, by their ends: none of their places is farther off them than `slack`, mm.
fn stretches(line: &[Vertex], slack: f64) -> Vec<[usize; 2]> {
    let mut stretches = Vec::new();
    let mut first = 0;
    while first + 1 < line.len() {
        let along = line[first + 1].at - line[first].at;
        // The directions that pass all places so far within the slack, against that of the first step, rad.
        let (mut least, mut greatest) = (-FRAC_PI_2, FRAC_PI_2);
        let (mut last, mut reached) = (first, 0.0);
        for (k, vertex) in line.iter().enumerate().skip(first + 1) {
            let way = vertex.at - line[first].at;
            let (turn, distance) = (angle::turn(along, way), way.norm());
            if last > first && (distance <= reached || !(least..=greatest).contains(&turn)) {
                break;
            }
            let spread = (slack / distance).min(1.0).asin();
            (least, greatest) = (least.max(turn - spread), greatest.min(turn + spread));
            (last, reached) = (k, distance);
        }
        stretches.push([first, last]);
        first = last;
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    const UNIT: f64 = 0.025;
    const RING: [(f64, f64); 5] = [(0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];

    fn check(points: &[(f64, f64)], left: &[(f64, f64)], tips: &[(f64, f64)]) {
        let vertex = |(i, &(x, y)): (usize, &(f64, f64))| Vertex {
            at: Point::new(x, y),
            span: Span { start: i as u32, end: i as u32, block: 1 },
        };
        let vertices: Vec<Vertex> = points.iter().enumerate().map(vertex).collect();
        let pruned = prune(&vertices, Measure { unit: UNIT, longest: 25.0 });
        let of = |p: &Point| (p.x, p.y);
        assert_eq!(pruned.vertices.iter().map(|v| of(&v.at)).collect::<Vec<_>>(), left);
        assert_eq!(pruned.spikes.iter().map(|s| of(&s.tip.at)).collect::<Vec<_>>(), tips);
        let length = |points: &[(f64, f64)]| -> f64 {
            points.windows(2).map(|w| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1)).sum()
        };
        let cuts: f64 = pruned.spikes.iter().map(|s| (s.tip.at - s.root).norm()).sum();
        assert!((length(points) - length(left) - cuts - pruned.moments.length()).abs() < 1e-9);
        assert_eq!(points.len(), (left.len() + tips.len()).saturating_add_signed(pruned.points));
    }

    /// The ring with a way at the middle of its first side.
    fn with_way(way: &[(f64, f64)]) -> Vec<(f64, f64)> {
        RING[..1].iter().chain(way).chain(&RING[1..]).copied().collect()
    }

    #[test]
    fn a_spike_is_taken_out_wherever_it_stands() {
        let ring = RING;
        check(&ring, &ring, &[]);
        check(&[(0., 0.), (50., 0.), (50., 50.), (45., 45.), (50., 50.), (0., 50.), (0., 0.)], &ring, &[(45., 45.)]);
        check(&[(0., 0.), (5., 5.), (0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)], &ring, &[(5., 5.)]);
        check(&[(0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (5., 5.), (0., 0.)], &ring, &[(5., 5.)]);
        check(&[(5., 5.), (0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (5., 5.)], &ring, &[(5., 5.)]);
    }

    #[test]
    fn a_gap_of_rounding_is_bridged_and_a_wider_one_is_no_spike() {
        check(&with_way(&[(25., 0.), (25., 5.), (25.025, 0.)]), &with_way(&[(25., 0.), (25.025, 0.)]), &[(25., 5.)]);
        let wide = with_way(&[(25., 0.), (25., 5.), (25.1, 0.)]);
        check(&wide, &wide, &[]);
    }

    #[test]
    fn a_step_out_and_back_that_is_shorter_than_a_notch_is_dropped() {
        let left = [(0., 0.), (25., 0.), (50., 0.), (50., 50.), (0., 0.)];
        check(&[(0., 0.), (25., 0.), (25., 0.025), (25., 0.), (50., 0.), (50., 50.), (0., 0.)], &left, &[]);
        check(
            &[(25., 0.9), (25., 0.), (50., 0.), (50., 50.), (0., 0.), (25., 0.), (25., 0.9)],
            &[(25., 0.), (50., 0.), (50., 50.), (0., 0.), (25., 0.)],
            &[],
        );
    }

    #[test]
    fn a_way_in_many_steps_is_one_spike() {
        for step in [0.8, 2.5] {
            let count = (5.0 / step) as usize;
            let out: Vec<(f64, f64)> = (0..=count).map(|i| (25., step * i as f64)).collect();
            let tip = out[count];
            let back = |x: f64| out.iter().rev().skip(1).map(move |place| (x, place.1));
            let way: Vec<(f64, f64)> = out.iter().copied().chain(back(25.)).collect();
            check(&with_way(&way), &with_way(&[(25., 0.)]), &[tip]);
            let way: Vec<(f64, f64)> = out.iter().copied().chain(back(25.025)).collect();
            check(&with_way(&way), &with_way(&[(25., 0.), (25.025, 0.)]), &[tip]);
            // Rounding may part the two on the way.
            let mut way: Vec<(f64, f64)> = out.iter().copied().chain(back(25.025)).collect();
            way.last_mut().expect("a root").0 = 25.;
            check(&with_way(&way), &with_way(&[(25., 0.)]), &[tip]);
            // The line starts at its tip.
            let rest = [(25., 0.), (50., 0.), (50., 50.), (0., 0.), (25., 0.)];
            let start: Vec<(f64, f64)> = out.iter().rev().chain(&rest[1..4]).chain(&out).copied().collect();
            check(&start, &rest, &[tip]);
        }
    }

    #[test]
    fn a_way_that_bends_is_cut_by_its_straight_stretches_however_short_they_are() {
        let way = [(25., 0.), (25., 0.6), (25.6, 0.6), (25.6, 1.2), (25.6, 0.6), (25., 0.6), (25., 0.)];
        check(&with_way(&way), &with_way(&[(25., 0.)]), &[(25., 0.6), (25.6, 0.6), (25.6, 1.2)]);
        // Ways of their own, where it parts.
        let way = [(25., 0.), (25., 5.), (22., 5.), (25., 5.), (28., 5.), (25., 5.), (25., 0.)];
        check(&with_way(&way), &with_way(&[(25., 0.)]), &[(22., 5.), (25., 5.), (28., 5.)]);
    }

    #[test]
    fn a_long_way_that_misses_itself_by_rounding_stays_as_it_is_drawn() {
        let way = [(25., 0.), (25., 15.), (25., 30.), (25.025, 15.), (25.025, 0.)];
        check(&with_way(&way), &with_way(&way), &[]);
    }
}
