//! Lines beside outlines that are not cut and may be missed: edges that two parts share, and marks that are no notches.

use super::drawing::Vertex;
use super::notch::{Search, TOUCH, grown};
use super::shape::{Class, ROUNDING, SHORTEST_OUTLINE};
use crate::geom::{Extent, Point, Vector, cross, polyline};

/// How far from an outline the end of a shared edge may lie, mm: as wide as the gap of an outline that is cut.
const END_REACH: f64 = 1.0;
/// How far from an outline a mark may stand that was meant to be on it, mm: users report up to 1 mm.
pub(super) const MARK_REACH: f64 = 2.0;
/// Shortest mark that is named, mm: shorter ones are ticks of the drawing.
const SHORTEST_MARK: f64 = 2.0;
/// Greatest side of the box of a mark that is named, mm: a notch of 30 mm, as rounding leaves it.
const LARGEST_MARK: f64 = 30.5;
/// Farthest that the middle of a mark lies from an outline in its reach, mm along an axis.
const WIDEST_REACH: f64 = LARGEST_MARK / 2.0 + MARK_REACH;
/// Comparisons that one plot may cost: a guard against drawings that are made to be slow.
const MOST_WORK: usize = 50_000_000;

/// What stands beside outlines, as indices of shapes.
#[derive(Debug, Default)]
pub(super) struct Beside {
    /// Long lines from one place of an outline to another.
    pub(super) dividing: Vec<usize>,
    /// Short lines near or across an outline, or on the tip of a notch.
    pub(super) marks: Vec<usize>,
    /// Whether the search ended before its time; then nothing was found.
    pub(super) is_cut_short: bool,
}

/// A mark, or one end of a long line.
#[derive(Debug)]
struct Probe<'a> {
    /// Index of the line among the shapes.
    line: usize,
    places: &'a [Vertex],
    extent: Extent,
    middle: Point,
    /// Whether it reaches an outline.
    is_met: bool,
    /// Whether it is a mark that is drawn over an edge, which is cut.
    is_over: bool,
}

impl<'a> Probe<'a> {
    fn new(line: usize, places: &'a [Vertex]) -> Self {
        let mut extent = Extent::EMPTY;
        for vertex in places {
            extent.add(vertex.at);
        }
        let middle = extent.min + (extent.max - extent.min) / 2.0;
        Self { line, places, extent, middle, is_met: false, is_over: false }
    }

    fn is_end(&self) -> bool {
        self.places.len() == 1
    }

    /// Whether all of it lies so near to a segment, mm.
    fn lies_on(&self, [from, to]: [Point; 2], touch: f64) -> bool {
        self.places.iter().all(|vertex| polyline::distance_to_segment(vertex.at, from, to) <= touch)
    }

    /// Whether it comes as near to a segment as `reach`, mm.
    fn reaches(&self, [from, to]: [Point; 2], reach: f64) -> bool {
        let is_near = |vertex: &Vertex| polyline::distance_to_segment(vertex.at, from, to) <= reach;
        let is_met = |pair: &[Vertex]| {
            let [a, b] = [pair[0].at, pair[1].at];
            let mut ends = [from, to].into_iter();
            ends.any(|end| polyline::distance_to_segment(end, a, b) <= reach) || is_crossed([a, b], [from, to])
        };
        self.places.iter().any(is_near) || self.places.windows(2).any(is_met)
    }
}

/// Lines among the candidates that stand beside the outlines; notches among those have a tip that a mark may stand on.
pub(super) fn find(search: Search) -> Beside {
    let Search { drawing, shapes, unit, candidates, outlines } = search;
    let mut probes: Vec<Probe> = Vec::new();
    for &line in candidates {
        let (shape, vertices) = (&shapes[line], shapes[line].vertices(drawing));
        let last = vertices.len() - 1;
        if shape.length >= SHORTEST_OUTLINE && vertices[0].at != vertices[last].at {
            probes.extend([Probe::new(line, &vertices[..1]), Probe::new(line, &vertices[last..])]);
        } else if shape.length >= SHORTEST_MARK && shape.size() <= LARGEST_MARK {
            probes.push(Probe::new(line, vertices));
        }
    }
    probes.sort_by(|a, b| a.middle.x.total_cmp(&b.middle.x));
    let mut work = MOST_WORK;
    for &outline in outlines {
        let shape = &shapes[outline];
        let is_notch = shape.class == Class::Notch;
        let extent = grown(*shape.extent(), WIDEST_REACH);
        let first = probes.partition_point(|probe| probe.middle.x < extent.min.x);
        let end = probes.partition_point(|probe| probe.middle.x <= extent.max.x);
        work = work.saturating_sub(end - first);
        if work == 0 {
            break;
        }
        let may_meet = |probe: &Probe| extent.holds(probe.middle) && !(is_notch && probe.is_end());
        let near: Vec<usize> = (first..end).filter(|&k| may_meet(&probes[k])).collect();
        if near.is_empty() {
            continue;
        }
        for pair in shape.vertices(drawing).windows(2) {
            let segment = [pair[0].at, pair[1].at];
            let mut extent = Extent::EMPTY;
            extent.add(segment[0]);
            extent.add(segment[1]);
            let extent = grown(extent, MARK_REACH);
            let first = near.partition_point(|&k| probes[k].middle.x < extent.min.x - WIDEST_REACH);
            for &k in &near[first..] {
                let probe = &mut probes[k];
                if probe.middle.x > extent.max.x + WIDEST_REACH {
                    break;
                }
                work = work.saturating_sub(1);
                if !extent.overlaps(&probe.extent) {
                    continue;
                }
                work = work.saturating_sub(probe.places.len());
                let touch = TOUCH + ROUNDING * unit;
                let reach = match (is_notch, probe.is_end()) {
                    (true, _) => touch,
                    (false, true) => END_REACH,
                    (false, false) => MARK_REACH,
                };
                probe.is_met |= probe.reaches(segment, reach);
                probe.is_over |= !probe.is_end() && probe.lies_on(segment, touch);
            }
            if work == 0 {
                break;
            }
        }
    }
    if work == 0 {
        return Beside { is_cut_short: true, ..Beside::default() };
    }
    let mut met: Vec<&Probe> = probes.iter().filter(|probe| probe.is_met && !probe.is_over).collect();
    met.sort_by_key(|probe| probe.line);
    let marks = met.iter().filter(|probe| !probe.is_end()).map(|probe| probe.line).collect();
    let ends: Vec<usize> = met.iter().filter(|probe| probe.is_end()).map(|probe| probe.line).collect();
    let dividing = ends.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
    Beside { dividing, marks, is_cut_short: false }
}

/// Whether two segments cross within both.
fn is_crossed([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let parts = |way: Vector, from: Point, [p, q]: [Point; 2]| cross(way, p - from) * cross(way, q - from) < 0.0;
    parts(b - a, a, [c, d]) && parts(d - c, c, [a, b])
}
