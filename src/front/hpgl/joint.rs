//! Which ends of strokes continue each other. Where two meet nobody doubts it; where more do, a line follows the one that
//! closes an outline, and else the one that goes straightest.

use std::collections::{BTreeSet, VecDeque};
use std::f64::consts::FRAC_PI_2;

use super::drawing::{Drawing, Stroke};
use super::shape::SHORTEST_OUTLINE;
use crate::geom::{Point, Vector, angle, bits};

/// Most ends at one place among which a continuation is looked for: more are the middle of a star or a hatching.
const MOST_ENDS: usize = 8;
/// A line that turns by more than this does not go on, rad.
const SHARPEST: f64 = FRAC_PI_2;
/// The stretch of a line that its direction at an end is taken from, mm: shorter segments have that of the grid. And how many
/// places are looked at for it.
const STRETCH: f64 = 1.0;
const MOST_STEPS: usize = 64;

/// An end of a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct End {
    pub(super) stroke: u32,
    /// Whether it is the last place, not the first.
    pub(super) is_last: bool,
}

impl End {
    /// The end of a stroke at its last place or at its first.
    pub(super) const fn last(stroke: usize) -> Self {
        Self { stroke: stroke as u32, is_last: true }
    }

    pub(super) const fn first(stroke: usize) -> Self {
        Self { stroke: stroke as u32, is_last: false }
    }

    /// The other end of its stroke.
    pub(super) fn other(self) -> Self {
        Self { is_last: !self.is_last, ..self }
    }

    /// The index of its place.
    #[inline]
    pub(super) fn vertex(self, strokes: &[Stroke]) -> usize {
        let stroke = &strokes[self.stroke as usize];
        (if self.is_last { stroke.end - 1 } else { stroke.first }) as usize
    }

    /// Its index in a list of two for each stroke.
    fn index(self) -> usize {
        2 * self.stroke as usize + usize::from(self.is_last)
    }
}

/// What each end of the strokes is continued by.
#[derive(Debug, Default)]
pub(super) struct Links {
    of: Vec<Option<End>>,
    /// Places where three or more lines meet, by their bits.
    pub(super) joints: BTreeSet<[u64; 2]>,
}

impl Links {
    /// The end that continues another one.
    pub(super) fn at(&self, end: End) -> Option<End> {
        self.of[end.index()]
    }

    /// Whether nothing continues anything.
    pub(super) fn is_empty(&self) -> bool {
        self.of.iter().all(Option::is_none)
    }
}

/// A place where ends meet.
struct Node {
    ends: Vec<End>,
}

/// Strokes as a graph, while it is decided which ends are linked.
struct Graph<'a> {
    drawing: &'a Drawing,
    links: Links,
    nodes: Vec<Node>,
    /// Of each end, as its index: the place where it meets others.
    node: Vec<Option<u32>>,
    /// Of each end of a chain of linked strokes: its other end, and its length, mm.
    far: Vec<End>,
    length: Vec<f64>,
    /// Places where something has changed.
    queue: VecDeque<u32>,
}

/// Finds the ends that continue each other, among strokes of one pen whose ends meet to the bit. Marks with a free end, for
/// which `is_spur` holds, are continued by nothing where more than two meet.
pub(super) fn links(drawing: &Drawing, is_spur: impl Fn(&Drawing, &Stroke) -> bool) -> Links {
    type Key = (u16, [u64; 2]);
    let strokes = &drawing.strokes;
    let mut ends: Vec<(Key, End)> = Vec::new();
    for (i, stroke) in strokes.iter().enumerate() {
        let both = [End::first(i), End::last(i)];
        let at = both.map(|end| drawing.vertices[end.vertex(strokes)].at);
        if at[0] != at[1] {
            ends.extend(both.iter().zip(at).map(|(end, at)| ((stroke.pen, bits(at)), *end)));
        }
    }
    ends.sort_unstable_by_key(|(key, end)| (*key, end.stroke, end.is_last));
    let groups = || ends.chunk_by(|a, b| a.0 == b.0);
    let mut is_alone = vec![false; strokes.len()];
    for group in groups().filter(|group| group.len() == 1) {
        is_alone[group[0].1.stroke as usize] = true;
    }
    let mut links = Links { of: vec![None; 2 * strokes.len()], joints: BTreeSet::new() };
    let (mut nodes, mut joints): (Vec<Node>, _) = (Vec::new(), BTreeSet::new());
    let mut pair = |a: End, b: End| (links.of[a.index()], links.of[b.index()]) = (Some(b), Some(a));
    for group in groups().filter(|group| group.len() > 1) {
        if let [(_, a), (_, b)] = group {
            pair(*a, *b);
            continue;
        }
        let is_free = |end: &End| {
            let stroke = end.stroke as usize;
            is_alone[stroke] && is_spur(drawing, &strokes[stroke])
        };
        let through: Vec<End> = group.iter().map(|(_, end)| *end).filter(|end| !is_free(end)).collect();
        match through[..] {
            [] | [_] => {}
            [a, b] => pair(a, b),
            _ => {
                joints.insert(group[0].0.1);
                if through.len() <= MOST_ENDS {
                    nodes.push(Node { ends: through });
                }
            }
        }
    }
    links.joints = joints;
    if nodes.is_empty() {
        return links;
    }
    let mut graph = Graph::new(drawing, links, nodes);
    graph.run();
    graph.links
}

impl<'a> Graph<'a> {
    fn new(drawing: &'a Drawing, links: Links, nodes: Vec<Node>) -> Self {
        let strokes = &drawing.strokes;
        let far = (0..strokes.len()).flat_map(|i| [End::last(i), End::first(i)]).collect();
        let length = |stroke: &Stroke| -> f64 {
            drawing.vertices[stroke.range()].windows(2).map(|pair| (pair[1].at - pair[0].at).norm()).sum()
        };
        let length = strokes.iter().map(length).flat_map(|length| [length; 2]).collect();
        let mut node = vec![None; 2 * strokes.len()];
        for (i, end) in nodes.iter().enumerate().flat_map(|(i, node)| node.ends.iter().map(move |end| (i, end))) {
            node[end.index()] = Some(i as u32);
        }
        let queue = (0..nodes.len() as u32).collect();
        let given = links;
        let links = Links { of: vec![None; 2 * strokes.len()], joints: given.joints };
        let mut graph = Self { drawing, links, nodes, node, far, length, queue };
        for i in 0..strokes.len() {
            for end in [End::first(i), End::last(i)] {
                if let Some(next) = given.of[end.index()].filter(|next| end.index() < next.index()) {
                    graph.link([end, next]);
                }
            }
        }
        graph
    }

    fn run(&mut self) {
        self.close();
        for node in 0..self.nodes.len() {
            while let Some(pair) = self.straightest(node) {
                self.link(pair);
                self.close();
            }
        }
    }

    /// Links what closes outlines, until nothing more does.
    fn close(&mut self) {
        while let Some(node) = self.queue.pop_front() {
            while let Some((pair, opposite)) = self.closing(node as usize) {
                self.link(pair);
                if let Some(pair) = opposite {
                    self.link(pair);
                }
            }
        }
    }

    /// Makes one chain of two.
    fn link(&mut self, [a, b]: [End; 2]) {
        let [start, end] = [a, b].map(|end| self.far[end.index()]);
        let length = self.length[a.index()] + self.length[b.index()];
        (self.links.of[a.index()], self.links.of[b.index()]) = (Some(b), Some(a));
        if start == b {
            // The chain is a ring.
            return;
        }
        (self.far[start.index()], self.far[end.index()]) = (end, start);
        (self.length[start.index()], self.length[end.index()]) = (length, length);
        // What is left alone at this place leads nowhere, seen from its other end.
        let left = self.node[a.index()].and_then(|node| self.open(node as usize).next());
        let left = left.map(|end| self.far[end.index()]);
        for end in [Some(start), Some(end), left].into_iter().flatten() {
            self.queue.extend(self.node[end.index()]);
        }
    }

    /// The ends at a place that nothing continues yet.
    fn open(&self, node: usize) -> impl Iterator<Item = End> {
        self.nodes[node].ends.iter().copied().filter(|end| self.links.at(*end).is_none())
    }

    /// Whether a chain that starts here may come back: others go on where it ends.
    fn leads_on(&self, end: End) -> bool {
        let far = self.far[end.index()];
        self.node[far.index()].is_some_and(|node| self.open(node as usize).nth(1).is_some())
    }

    /// Two ends at a place, and those at another, whose links close an outline or are the only ones that may.
    fn closing(&self, node: usize) -> Option<([End; 2], Option<[End; 2]>)> {
        let open: Vec<End> = self.open(node).collect();
        let pairs = || open.iter().enumerate().flat_map(|(i, &a)| open[i + 1..].iter().map(move |&b| [a, b]));
        // A chain that comes back to where it starts is closed as it is.
        if let Some(ring) = pairs().find(|[a, b]| self.far[a.index()] == *b) {
            return Some((ring, None));
        }
        let live: Vec<End> = open.iter().copied().filter(|&end| self.leads_on(end)).collect();
        if let [a, b] = live[..] {
            return Some(([a, b], None));
        }
        // Two chains between the same two places; the legs of a mark and its mouth are such, too.
        let opposite = |[a, b]: [End; 2]| {
            let far = [self.far[a.index()], self.far[b.index()]];
            let [c, d] = far.map(|end| self.node[end.index()]);
            let length = self.length[a.index()] + self.length[b.index()];
            (c == d && c.is_some_and(|c| c as usize != node) && length >= SHORTEST_OUTLINE).then_some(far)
        };
        let rings = pairs().filter_map(|pair| Some((pair, opposite(pair)?)));
        let turn = |&(pair, opposite): &([End; 2], [End; 2])| self.turn(pair) + self.turn(opposite);
        let best = rings.min_by(|a, b| turn(a).total_cmp(&turn(b)));
        best.map(|(pair, opposite)| (pair, Some(opposite)))
    }

    /// The two ends at a place that continue each other with the least turn; of equal ones the first in the file.
    fn straightest(&self, node: usize) -> Option<[End; 2]> {
        let open: Vec<End> = self.open(node).collect();
        let pairs = open.iter().enumerate().flat_map(|(i, &a)| open[i + 1..].iter().map(move |&b| [a, b]));
        let best = pairs
            .map(|pair| (self.turn(pair), pair))
            .filter(|(turn, _)| *turn <= SHARPEST)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, pair)| pair)
    }

    /// How far a line turns that goes from one end to another, rad.
    fn turn(&self, [a, b]: [End; 2]) -> f64 {
        angle::turn(-self.way(a), self.way(b)).abs()
    }

    /// The way from an end into its stroke.
    fn way(&self, end: End) -> Vector {
        let stroke = &self.drawing.strokes[end.stroke as usize];
        let vertices = &self.drawing.vertices[stroke.range()];
        let at = |i: usize| -> Point { if end.is_last { vertices[vertices.len() - 1 - i].at } else { vertices[i].at } };
        let ways = (1..vertices.len().min(MOST_STEPS)).map(|i| at(i) - at(0));
        let mut last = Vector::zeros();
        for way in ways {
            last = way;
            if way.norm() >= STRETCH {
                break;
            }
        }
        last
    }
}
