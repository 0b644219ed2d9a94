//! Notches: marks that stand on an outline.

use std::collections::BTreeMap;

use super::drawing::Drawing;
use super::shape::{Mark, ROUNDING, Shape, mark};
use crate::geom::{Extent, Point, polyline, ring};

/// How far from an outline a mark may end and still stand on it, mm, beside what rounding does.
pub(super) const TOUCH: f64 = 0.1;
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
        if work == 0 {
            break;
        }
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
            if work == 0 {
                break;
            }
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

/// A box with a margin on all sides, mm.
pub(super) fn grown(mut extent: Extent, by: f64) -> Extent {
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
