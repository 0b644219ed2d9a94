//! Notches: marks that stand on an outline, and spikes in it that go out and straight back.

use std::collections::BTreeMap;

use super::drawing::{Drawing, Vertex};
use super::shape::{Mark, ROUNDING, SHORTEST_NOTCH, Shape, is_near, mark};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, polyline, ring};

/// How far from an outline a mark may end and still stand on it, mm, beside what rounding does.
const TOUCH: f64 = 0.1;
/// Comparisons that one plot may cost: a guard against drawings that are made to be slow.
const MOST_WORK: usize = 400_000_000;

/// A mark that stands on an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    /// Index of the mark among the shapes.
    pub(super) mark: usize,
    /// Index of the outline in the list that was searched.
    pub(super) outline: usize,
    /// The cut from the edge; `None` for two legs.
    pub(super) cut: Option<[Point; 2]>,
}

/// An end of a mark, and the outlines that it stands on.
struct End {
    at: Point,
    /// The nearest outline with its distance, mm, and a second one: pieces lie edge to edge.
    on: [Option<(f64, usize)>; 2],
}

/// What is searched for marks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) drawing: &'a Drawing,
    pub(super) shapes: &'a [Shape],
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Shapes that may be marks, and those that may be outlines, by their indices.
    pub(super) candidates: &'a [usize],
    pub(super) outlines: &'a [usize],
}

/// The marks that stand on outlines.
#[derive(Debug)]
pub(super) struct Marks {
    pub(super) found: Vec<Found>,
    /// Whether the search ended before its time.
    pub(super) is_cut_short: bool,
}

/// The marks among some shapes that stand on outlines.
pub(super) fn on_outlines(search: Search) -> Marks {
    let Search { drawing, shapes, unit, candidates, outlines } = search;
    let marks: Vec<(usize, Mark)> =
        candidates.iter().filter_map(|&i| Some((i, mark(shapes[i].vertices(drawing), unit)?))).collect();
    let mut ends: Vec<End> = Vec::with_capacity(2 * marks.len());
    for (_, mark) in &marks {
        ends.extend(mark.ends().map(|at| End { at, on: [None; 2] }));
    }
    // Ends by x, so that the few beside a segment are found fast.
    let mut order: Vec<usize> = (0..ends.len()).collect();
    order.sort_by(|&a, &b| ends[a].at.x.total_cmp(&ends[b].at.x));
    let touch = TOUCH + ROUNDING * unit;
    let mut work = MOST_WORK;
    for (k, &outline) in outlines.iter().enumerate() {
        let extent = grown(*shapes[outline].extent(), touch);
        let in_reach = in_reach(&order, &ends, &extent);
        work = work.saturating_sub(in_reach.len());
        let near: Vec<usize> = in_reach.iter().copied().filter(|&end| extent.holds(ends[end].at)).collect();
        if near.is_empty() {
            continue;
        }
        for pair in shapes[outline].vertices(drawing).windows(2) {
            let mut extent = Extent::EMPTY;
            extent.add(pair[0].at);
            extent.add(pair[1].at);
            let extent = grown(extent, touch);
            let first = near.partition_point(|&end| ends[end].at.x < extent.min.x);
            for &end in &near[first..] {
                let end = &mut ends[end];
                if end.at.x > extent.max.x {
                    break;
                }
                work = work.saturating_sub(1);
                if !extent.holds(end.at) {
                    continue;
                }
                let distance = polyline::distance_to_segment(end.at, pair[0].at, pair[1].at);
                if distance <= touch {
                    end.meet(k, distance);
                }
            }
        }
        if work == 0 {
            break;
        }
    }
    let mut rings: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
    let mut is_in = |k: usize, at: Point| {
        let ring = rings
            .entry(k)
            .or_insert_with(|| shapes[outlines[k]].vertices(drawing).iter().map(|vertex| vertex.at).collect());
        work = work.saturating_sub(ring.len());
        work > 0 && ring::contains(ring, at)
    };
    let found = marks
        .iter()
        .enumerate()
        .filter_map(|(n, (index, mark))| {
            let [a, b] = [&ends[2 * n], &ends[2 * n + 1]];
            // On the edge of two parts the notch belongs to the one that it leads into.
            let mut belongs = |[nearest, second]: [Option<usize>; 2], tip: Point| {
                let mut leads_in = |outline: Option<usize>| outline.filter(|&outline| is_in(outline, tip));
                if second.is_some() { leads_in(nearest).or_else(|| leads_in(second)).or(nearest) } else { nearest }
            };
            let (outline, cut) = match *mark {
                Mark::Vee { apex, .. } => (belongs(a.common(b), apex)?, None),
                Mark::Line(_) => {
                    let distance = |end: &End| end.on[0].map_or(f64::INFINITY, |on| on.0);
                    let (root, tip) = if distance(b) < distance(a) { (b, a) } else { (a, b) };
                    // A line from edge to edge is a chord, such as the cross in a circle.
                    if root.common(tip) != [None; 2] {
                        return None;
                    }
                    (belongs(root.on.map(|on| on.map(|on| on.1)), tip.at)?, Some([root.at, tip.at]))
                }
            };
            Some(Found { mark: *index, outline, cut })
        })
        .collect();
    Marks { found, is_cut_short: work == 0 }
}

impl End {
    fn meet(&mut self, outline: usize, distance: f64) {
        let slot = match self.on {
            [Some(first), _] if first.1 == outline => 0,
            [_, Some(second)] if second.1 == outline => 1,
            [None, _] => 0,
            _ => 1,
        };
        if self.on[slot].is_none_or(|(before, _)| distance < before) {
            self.on[slot] = Some((distance, outline));
        }
        let far = |on: Option<(f64, usize)>| on.map_or(f64::INFINITY, |on| on.0);
        if far(self.on[1]) < far(self.on[0]) {
            self.on.swap(0, 1);
        }
    }

    /// The outlines that both ends stand on.
    fn common(&self, other: &Self) -> [Option<usize>; 2] {
        let is_shared = |outline: &usize| other.on.iter().flatten().any(|on| on.1 == *outline);
        let mut shared = self.on.iter().flatten().map(|on| on.1).filter(is_shared);
        [shared.next(), shared.next()]
    }
}

fn grown(mut extent: Extent, by: f64) -> Extent {
    extent.min -= crate::geom::Vector::new(by, by);
    extent.max += crate::geom::Vector::new(by, by);
    extent
}

/// Of the ends in the order of their x those in the columns of a box.
fn in_reach<'a>(order: &'a [usize], ends: &[End], extent: &Extent) -> &'a [usize] {
    let first = order.partition_point(|&end| ends[end].at.x < extent.min.x);
    let last = order.partition_point(|&end| ends[end].at.x <= extent.max.x);
    &order[first..last]
}

/// A spike that was taken out of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spike {
    pub(super) root: Point,
    pub(super) tip: Vertex,
}

/// An outline without its spikes.
#[derive(Debug, Default)]
pub(super) struct Pruned {
    pub(super) vertices: Vec<Vertex>,
    pub(super) spikes: Vec<Spike>,
    /// Drawn beyond what is left and one cut a spike: places, and moments.
    pub(super) points: isize,
    pub(super) moments: Moments,
    /// Tips that are too near to be notches: they are dropped.
    pub(super) dropped: Vec<Point>,
}

/// Takes the spikes out of a closed line. A way that comes back to its root to the bit is a spike however long it is;
/// one that misses it by rounding is bridged, and is a spike when it is as long as a notch. Shorter ones are the jitter of
/// a digitiser and are dropped.
pub(super) fn prune(vertices: &[Vertex], unit: f64, longest: f64) -> Pruned {
    let mut pruned = Pruned { vertices: Vec::with_capacity(vertices.len()), ..Pruned::default() };
    for &vertex in vertices {
        // Few vertices come back to the last but one, so nothing is measured before that is known.
        if let [.., root, tip] = &pruned.vertices[..]
            && is_near(root.at, vertex.at, unit)
        {
            let (root, tip) = (root.at, *tip);
            let depth = (tip.at - root).norm();
            if root == vertex.at {
                pruned.vertices.pop();
                pruned.add(root, tip);
                continue;
            }
            if (SHORTEST_NOTCH..=longest).contains(&depth) {
                pruned.vertices.pop();
                pruned.spikes.push(Spike { root, tip });
                pruned.moments += Moments::line(vertex.at, tip.at) - Moments::line(vertex.at, root);
            }
        }
        pruned.vertices.push(vertex);
    }
    // Where the line starts at a tip, its two ends are the way out and back.
    while let [tip, root, .., before, _] = pruned.vertices[..]
        && root.at == before.at
        && pruned.vertices.len() > 4
    {
        pruned.vertices.pop();
        let tip = Vertex { span: root.span, ..tip };
        pruned.vertices.remove(0);
        pruned.add(root.at, tip);
    }
    pruned
}

impl Pruned {
    /// A spike whose way back is drawn beside its cut.
    fn add(&mut self, root: Point, tip: Vertex) {
        let way = Moments::line(root, tip.at);
        if way.length() < SHORTEST_NOTCH {
            self.dropped.push(tip.at);
            self.points += 2;
            self.moments += way * 2.0;
            return;
        }
        self.spikes.push(Spike { root, tip });
        self.points += 1;
        self.moments += way;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    const UNIT: f64 = 0.025;

    fn check(points: &[(f64, f64)], left: &[(f64, f64)], tips: &[(f64, f64)]) {
        let vertex = |(i, &(x, y)): (usize, &(f64, f64))| Vertex {
            at: Point::new(x, y),
            span: Span { start: i as u32, end: i as u32, block: 1 },
        };
        let vertices: Vec<Vertex> = points.iter().enumerate().map(vertex).collect();
        let pruned = prune(&vertices, UNIT, 25.0);
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

    #[test]
    fn a_spike_is_taken_out_wherever_it_stands() {
        let ring = [(0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        check(&ring, &ring, &[]);
        check(&[(0., 0.), (50., 0.), (50., 50.), (45., 45.), (50., 50.), (0., 50.), (0., 0.)], &ring, &[(45., 45.)]);
        check(&[(0., 0.), (5., 5.), (0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)], &ring, &[(5., 5.)]);
        check(&[(0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (5., 5.), (0., 0.)], &ring, &[(5., 5.)]);
        check(&[(5., 5.), (0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (5., 5.)], &ring, &[(5., 5.)]);
    }

    #[test]
    fn a_gap_of_rounding_is_bridged_and_a_wider_one_is_no_spike() {
        let bridged = [(0., 0.), (25., 0.), (25.025, 0.), (50., 0.), (50., 50.), (0., 0.)];
        let drawn = [(0., 0.), (25., 0.), (25., 5.), (25.025, 0.), (50., 0.), (50., 50.), (0., 0.)];
        check(&drawn, &bridged, &[(25., 5.)]);
        let wide = [(0., 0.), (25., 0.), (25., 5.), (25.1, 0.), (50., 0.), (50., 50.), (0., 0.)];
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
}
